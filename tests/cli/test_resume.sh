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
check merge_without_output 2 "$RAMIFY" merge left.exr upper.exr
check merge_nothing 2 "$RAMIFY" merge
