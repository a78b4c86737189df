#!/bin/sh
# A rendering that is killed at any moment, or whose picture is rendered in parts, ends with the bits of an undisturbed
# one; pictures are scenes. RAMIFY names the binary.
set -u
RAMIFY=${RAMIFY:-build/ramify}
RAMIFY=$(realpath "$RAMIFY")
checks=$(realpath "$(dirname "$0")/checks.sh")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
. "$checks"

cat >scene.yaml <<'EOF'
# a comment that pictures keep
film: {width: 120, height: 90, denoise: true}
sky: {kind: constant, color: [0.6, 0.8, 1]}
render: {samples: 96, noise: 0.02}
objects:
  - name: meadow
    ground: {grass_tufts: 300, grass_radius: 6}
  - name: ball
    shape: {envelope: [{shape: sphere, size: [1, 1, 1]}]}
EOF

check whole 0 "$RAMIFY" render scene.yaml -o whole.png -q

# ---- killed, at moments that fall anywhere in start, tracing, writing

kills=0
for moment in 0.15 0.2 0.25 0.3 0.35 0.4 0.45 0.5 0.3 0.35 0.4 0.5; do
    timeout -s KILL $moment "$RAMIFY" render scene.yaml -o cut.png -q --resume --checkpoint 0.02 --threads 1
    if [ $? -eq 137 ]; then kills=$((kills + 1)); fi
done
yes some_were_killed [ $kills -ge 1 ] # a fast machine is done soon
check resumed 0 "$RAMIFY" render scene.yaml -o cut.png -q --resume
yes killed_is_the_same cmp whole.exr cut.exr
yes killed_is_the_same_display cmp whole.png cut.png
yes nothing_half_is_left [ "$(find . -name '*.part' | wc -l)" -eq 0 ]

# Killed in the first pass: the picture holds the first look where no sample has been.
slow='--size 320x240 --samples 3 --noise 0 --no-denoise'
check slow_whole 0 "$RAMIFY" render scene.yaml -o slow.png -q $slow
"$RAMIFY" render scene.yaml -o early.png -q $slow --checkpoint 0.001 --threads 1 &
early=$!
until [ -e early.exr ]; do sleep 0.005; done
kill -9 $early
wait $early 2>/dev/null
check resumed_first_pass 0 "$RAMIFY" render scene.yaml -o early.png -q $slow --resume
yes killed_first_pass_is_the_same cmp slow.exr early.exr
yes killed_first_pass_is_the_same_display cmp slow.png early.png

check resumed_when_done 0 "$RAMIFY" render scene.yaml -o cut.png -q --resume
yes done_is_the_same cmp whole.exr cut.exr
check resumed_from_nothing 0 "$RAMIFY" render scene.yaml -o new.png -q --resume --no-preview
yes from_nothing_is_the_same cmp whole.exr new.exr

# ---- what does not belong together

check other_settings 2 "$RAMIFY" render scene.yaml -o cut.png -q --resume --set camera.fov=21
says other_settings_says err "'fov: 21'"
check other_samples 2 "$RAMIFY" render scene.yaml -o cut.png -q --resume --samples 200
says other_samples_says err --add-samples
yes refusals_keep_the_file cmp whole.exr cut.exr
printf 'no picture' >cut.exr
check no_picture 2 "$RAMIFY" render scene.yaml -o cut.png -q --resume
says no_picture_says err cut.exr
head -c 3000 whole.exr >cut.exr
check cut_short 2 "$RAMIFY" render scene.yaml -o cut.png -q --resume
cp whole.exr cut.exr

# ---- pictures as scenes

check render_a_picture 0 "$RAMIFY" render whole.exr -o again.png -q
yes a_picture_makes_itself cmp whole.exr again.exr
check render_a_png 0 "$RAMIFY" render whole.png -o again.png -q
yes a_png_makes_itself cmp whole.png again.png
check info_of_a_picture 0 "$RAMIFY" info whole.exr
says info_of_a_picture_says out 'object 1  ball'
yes pictures_keep_the_comment grep -qaF 'a comment that pictures keep' again.exr

check replay 0 "$RAMIFY" replay whole.exr --pixel 60,56 --sample 3
says replay_says out 'ray 0: surface of ball, clay'
check replay_json 0 "$RAMIFY" replay scene.yaml --pixel 0,0 --json
says replay_json_says out '"end": "outside"'
check replay_no_pixel 2 "$RAMIFY" replay whole.exr --pixel 120,45
check replay_bad_pixel 2 "$RAMIFY" replay whole.exr --pixel 7
check replay_without_pixel 2 "$RAMIFY" replay whole.exr
check plain 0 "$RAMIFY" render scene.yaml --noise 0 -o plain.png -q
check add 0 "$RAMIFY" render plain.exr --add-samples 32 -o more.png
says add_says err '128 samples'
check added_differs 1 "$RAMIFY" compare plain.exr more.exr --max-rmse 0
check added_is_alike 0 "$RAMIFY" compare plain.exr more.exr --max-rmse 0.05
check add_more 0 "$RAMIFY" render more.exr --add-samples 32 -o more.png
says add_more_says err '160 samples'
check planned 0 "$RAMIFY" render scene.yaml --noise 0 --samples 160 --set render.planned_samples=96 -o planned.png -q
yes added_has_the_bits_of_all_at_once cmp planned.exr more.exr
check add_to_a_scene 2 "$RAMIFY" render scene.yaml --add-samples 32
says add_to_a_scene_says err PICTURE.exr

# ---- parts

half="film.width=120" # an override that changes nothing
check left 0 "$RAMIFY" render scene.yaml --crop 0,0,0.533334,1 -o left.exr -q --set $half
check upper 0 "$RAMIFY" render scene.yaml --crop 0.533334,0,1,0.533334 -o upper.exr -q --threads 1
check lower 0 "$RAMIFY" render scene.yaml --crop 0.533334,0.533334,1,1 -o lower.exr -q --threads 3
check merge 0 "$RAMIFY" merge left.exr upper.exr lower.exr -o merged.png
yes merged_is_the_same cmp whole.exr merged.exr
yes merged_is_the_same_display cmp whole.png merged.png
check merge_misses 1 "$RAMIFY" merge left.exr lower.exr -o missing.png
says merge_misses_says err 'are in none of the parts'
yes merge_writes_nothing [ ! -e missing.png ] && [ ! -e missing.exr ]
check merge_overlaps 2 "$RAMIFY" merge left.exr upper.exr left.exr lower.exr -o twice.png
says merge_overlaps_says err 'both have samples'
check other 0 "$RAMIFY" render scene.yaml --crop 0.533334,0.533334,1,1 -o other.exr -q --set camera.fov=21
check merge_strangers 2 "$RAMIFY" merge left.exr upper.exr other.exr -o strange.png
says merge_strangers_says err "'fov: 21'"

# Parts that lie apart from the files of their scene

mkdir shelf
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >shelf/leaf.obj
printf 'film: {width: 32, height: 32}\nrender: {samples: 2}\nobjects: [{name: a, mesh: {file: leaf.obj}}]\n' >shelf/leaf.yaml
check shelf_whole 0 "$RAMIFY" render shelf/leaf.yaml -o shelf.png -q
check shelf_left 0 "$RAMIFY" render shelf/leaf.yaml --crop 0,0,0.5,1 -o shelf-left.exr -q
check shelf_right 0 "$RAMIFY" render shelf/leaf.yaml --crop 0.5,0,1,1 -o shelf-right.exr -q
check shelf_merge 0 "$RAMIFY" merge shelf-left.exr shelf-right.exr -o shelf-both.png -q
yes shelf_merge_is_the_same cmp shelf.png shelf-both.png

# ---- ranges of samples, which end anywhere

range() { # NAME A:B OPTION...
    name=$1 samples=$2
    shift 2
    check "range_$name" 0 "$RAMIFY" render scene.yaml --noise 0 --sample-range "$samples" -o "$name.exr" -q --no-preview "$@"
}
range first 0:7 --threads 1
range middle 7:50 --threads 2
range last 50:96 --threads 3
for order in "first middle last" "last first middle" "middle last first"; do
    set -- $order
    check "ranges_$1" 0 "$RAMIFY" merge "$1.exr" "$2.exr" "$3.exr" -o ranges.png -q
    yes "ranges_$1_have_the_bits" cmp plain.exr ranges.exr
    yes "ranges_$1_have_the_display" cmp plain.png ranges.png
done
range left_few 0:33 --crop 0,0,0.533334,1
range left_more 33:96 --crop 0,0,0.533334,1
check right 0 "$RAMIFY" render scene.yaml --noise 0 --crop 0.533334,0,1,1 -o right.exr -q
check ranges_and_crops 0 "$RAMIFY" merge left_more.exr right.exr left_few.exr -o ranges.png -q
yes ranges_and_crops_have_the_bits cmp plain.exr ranges.exr
for moment in 0.15 0.2 0.25 0.3 0.35 0.4; do
    timeout -s KILL $moment "$RAMIFY" render scene.yaml --noise 0 --sample-range 7:50 -o killed.exr -q --resume --checkpoint 0.02 --threads 1
done
range killed 7:50 --resume
yes killed_range_is_the_same cmp middle.exr killed.exr

check range_gap 2 "$RAMIFY" merge first.exr last.exr -o gap.png
says range_gap_says err 'samples 7 to 49 of pixel 0, 0 are in none of the 2 files'
check range_end 2 "$RAMIFY" merge middle.exr first.exr -o gap.png
says range_end_says err 'samples 50 to 95 '
range over 40:60
check range_overlap 2 "$RAMIFY" merge first.exr middle.exr over.exr last.exr -o gap.png
says range_overlap_says err "'middle.exr' has samples 7 to 49, 'over.exr' 40 to 59"
check range_and_whole 2 "$RAMIFY" merge first.exr plain.exr -o gap.png
says range_and_whole_says err 'both have samples'
check range_of_more 0 "$RAMIFY" render scene.yaml --noise 0 --samples 200 --set render.planned_samples=96 --sample-range 50:96 -o more.exr -q
check range_of_another 2 "$RAMIFY" merge first.exr middle.exr more.exr -o gap.png
says range_of_another_says err "'more.exr' has samples 50 to 95 of 200 a pixel"
check range_noise 2 "$RAMIFY" render scene.yaml --sample-range 0:7 -o gap.png
says range_noise_says err 'render.noise is 0.02'
check range_seconds 2 "$RAMIFY" render scene.yaml --noise 0 --seconds 9 --sample-range 0:7 -o gap.png
says range_seconds_says err 'render.seconds is 9'
check range_beyond 2 "$RAMIFY" render scene.yaml --noise 0 --sample-range 0:97 -o gap.png
says range_beyond_says err 'at most samples, 96'
check range_backward 2 "$RAMIFY" render scene.yaml --noise 0 --sample-range 7:7 -o gap.png
check range_resumes_another 2 "$RAMIFY" render scene.yaml --noise 0 --sample-range 7:51 -o middle.exr --resume
says range_resumes_another_says err 'has samples 7 to 49 of each pixel, the scene takes 7 to 50'
check range_adds 2 "$RAMIFY" render middle.exr --add-samples 4 -o gap.png
says range_adds_says err 'has samples 7 to 49 of 96 alone'
yes range_refusals_write_nothing [ ! -e gap.png ] && [ ! -e gap.exr ]

check merge_without_output 2 "$RAMIFY" merge left.exr upper.exr
check merge_nothing 2 "$RAMIFY" merge
