#!/bin/sh
# ramify batch with the engines that need no cluster: same bits as one rendering, whatever happens in between; what is
# missing is named; plans, refusals. RAMIFY names the binary, RAMIFY_PEERS the folder of python/.
# shellcheck disable=SC2086
set -u
RAMIFY=${RAMIFY:-build/ramify}
RAMIFY=$(realpath "$RAMIFY")
RAMIFY_PEERS=${RAMIFY_PEERS:-$PWD/build/peers}
checks=$(realpath "$(dirname "$0")/checks.sh")
folder=$(mktemp -d)
trap 'umount "$folder/small" 2>/dev/null; rm -rf "$folder"' EXIT
cd "$folder" || exit 1
. "$checks"

mkdir scenes
cat >scenes/scene.yaml <<'END'
# a comment that pictures keep
film: {width: 90, height: 70, denoise: true}
render: {samples: 48, noise: 0.03, max_depth: 3}
sky: {kind: constant, color: 1}
objects:
  - {name: ball, shape: {envelope: [{shape: sphere, size: [1, 1, 1]}]}}
  - {name: card, mesh: {file: card.obj, position: [0, 0, -2]}}
END
printf 'v -3 0 0\nv 3 0 0\nv 3 2 0\nv -3 2 0\nf 1 2 3 4\n' >scenes/card.obj
scene=scenes/scene.yaml
check whole 0 "$RAMIFY" render $scene -o whole.png -q

# ---- tiles

check tiles 0 "$RAMIFY" batch $scene --tiles 3x2 --pack 2 --jobs 2 -o all.png
says tiles_says err 'tiles 2-3: done'
yes tiles_have_the_bits cmp whole.exr all.exr
yes tiles_have_the_display cmp whole.png all.png
yes nothing_is_left_begun [ "$(ls all.batch/parts | wc -l)" -eq 6 ]
check tiles_status 0 "$RAMIFY" batch status all.batch
says tiles_status_says out '6 of 6 tiles done'
rm all.batch/parts/000001.exr all.batch/parts/00000[345].exr all.exr
check misses_status 0 "$RAMIFY" batch status all.batch --json
says misses_status_says out '"done": 2, "begun": 0, "missing": [1, 3, 4, 5]'
check misses 1 "$RAMIFY" batch merge all.batch
says misses_says err '4 of 6 tiles are missing: 1, 3-5;'
yes misses_write_nothing [ ! -e all.exr ]
check one_part 0 "$RAMIFY" batch run all.batch --parts 3
yes one_part_is_there [ "$(ls all.batch/parts)" = "$(printf '00000%s.exr\n' 0 2 3)" ]
mv scenes/scene.yaml scenes/moved.yaml # the batch has its own
touch -r all.batch/parts/000000.exr before
check rest 0 "$RAMIFY" batch submit all.batch -q
yes rest_has_the_bits cmp whole.exr all.exr
yes rest_renders_no_tile_again [ "$(stat -c %Y all.batch/parts/000000.exr)" = "$(stat -c %Y before)" ]
mv scenes/moved.yaml scenes/scene.yaml
check again 0 "$RAMIFY" batch $scene --tiles 3x2 -o all.png -q

# ranges of samples

check ranges_whole 0 "$RAMIFY" render $scene --noise 0 -o ranges_whole.png -q
check ranges 0 "$RAMIFY" batch $scene --noise 0 --tiles 2x1 --sample-ranges 3 --pack 1 --jobs 2 -o ranges.png
says ranges_says err 'parts 5-5: done'
yes ranges_have_the_bits cmp ranges_whole.exr ranges.exr
yes ranges_have_the_display cmp ranges_whole.png ranges.png
rm ranges.batch/parts/000004.exr
check ranges_miss 1 "$RAMIFY" batch merge ranges.batch
says ranges_miss_says err '1 of 6 parts are missing: 4;'
check ranges_rest 0 "$RAMIFY" batch submit ranges.batch -q
yes ranges_rest_has_the_bits cmp ranges_whole.exr ranges.exr

# single tiles, with settings of the command line, from a picture
check fine 0 "$RAMIFY" batch $scene --tiles 6x5 -o fine.png --samples 4 --set camera.fov=50 -q
check fine_whole 0 "$RAMIFY" render $scene -o one.png --samples 4 --set camera.fov=50 -q
yes fine_has_the_bits cmp one.exr fine.exr
check of_picture 0 "$RAMIFY" batch one.exr --tiles 2x1 -o again.png -q --set objects.1.mesh.file=scenes/card.obj
check picture_is_alike 0 "$RAMIFY" compare one.exr again.exr

# ---- killed, stopped, twice at once

check planned 0 "$RAMIFY" batch $scene --tiles 2x2 -o cut.png --samples 400 --noise 0 --checkpoint 0.01 --engine openjd -q
check long 0 "$RAMIFY" render $scene --samples 400 --noise 0 -o long.png -q
kills=0
for moment in 0.15 0.25 0.35 0.5; do
    timeout -s KILL $moment "$RAMIFY" batch run cut.batch -q --threads 1
    [ $? -ne 137 ] || kills=$((kills + 1))
done
yes some_were_killed [ $kills -ge 1 ]
yes no_part_is_half [ "$(find cut.batch -name '*.ramify-*' | wc -l)" -eq 0 ]
"$RAMIFY" batch run cut.batch --parts 0-2 -q &
one=$!
"$RAMIFY" batch run cut.batch --parts 0-3 -q &
other=$!
yes one_of_two wait $one
yes other_of_two wait $other
check cut_merge 0 "$RAMIFY" batch merge cut.batch -q
yes killed_has_the_bits cmp long.exr cut.exr

check slow 0 "$RAMIFY" batch $scene --tiles 1x1 -o slow.png --samples 2000 --noise 0 --engine openjd -q
"$RAMIFY" batch run slow.batch --threads 1 >out 2>err &
process=$!
sleep 1
kill -TERM $process
wait $process
status=$?
case $status in
130 | 0 | 143) echo "ok stopped_status" ;; # a fast machine is done, a loaded one does not listen yet
*) echo "not ok stopped_status: $status" ;;
esac
if [ $status -eq 130 ]; then
    says stopped_says err 'run it again to go on'
    check begun 0 "$RAMIFY" batch status slow.batch
    says begun_says out 'begun: 0'
fi
# a frame goes on with the samples it had
film="--frames 0-0/3 --samples 1000 --noise 0 --size 64x48"
check frame_planned 0 "$RAMIFY" batch $scene $film --checkpoint 0.05 -o film-%d.png --folder frame.batch --engine openjd -q
setsid "$RAMIFY" batch run frame.batch -q --threads 1 2>err &
process=$!
tries=0
while [ ! -e frame.batch/parts/000000.begun.exr ] && [ $tries -lt 600 ]; do sleep 0.05; tries=$((tries + 1)); done
kill -KILL $process
wait $process
check frame_begun 0 "$RAMIFY" batch status frame.batch
says frame_begun_says out 'begun: 0'
check frame_goes_on 0 "$RAMIFY" batch run frame.batch -q
yes frame_is_begun_no_more [ ! -e frame.batch/parts/000000.begun.exr ]
check frame_at_once 0 "$RAMIFY" turntable "$PWD/$scene" --frames 3 --end 0 --samples 1000 --noise 0 --size 64x48 -o once-%d.png -q
yes frame_has_the_bits [ "$(cksum <once-0.png)" = "$(cksum <frame.batch/parts/000000.png)" ]

check broken 0 "$RAMIFY" batch $scene --tiles 1x1 -o broken.png --engine openjd -q
printf 'no picture' >broken.batch/parts/000000.begun.exr
check broken_run 0 "$RAMIFY" batch run broken.batch
says broken_run_says err 'warning'
check broken_merge 0 "$RAMIFY" batch merge broken.batch -q
yes broken_checkpoint_loses_no_bits cmp whole.exr broken.exr

# ---- frames

frames="--samples 2 --size 32x24"
# A frame's mark holds the paths of the files that the scene names.
check turn 0 "$RAMIFY" turntable "$PWD/$scene" --frames 5 $frames -o turn-%02d.png -q
check frames 0 "$RAMIFY" batch $scene --frames 0-4 $frames -o f-%02d.png --pack 2 --jobs 2
says frames_says err '5 frames'
check frames_status 0 "$RAMIFY" batch status f.batch
says frames_status_says out 'f-%02d.png: there'
for i in 0 1 2 3 4; do
    yes frame_$i cmp turn-0$i.png f-0$i.png
done
check some_frames 0 "$RAMIFY" batch $scene --frames 3-3/5 $frames -o g-%02d.png -q
yes some_frame cmp turn-03.png g-03.png
yes only_that [ "$(ls g-*.png)" = g-03.png ]
if command -v ffmpeg >/dev/null; then
    check film 0 "$RAMIFY" batch $scene --frames 0-4 $frames -o film.mp4 -q
    "$RAMIFY" turntable "$PWD/$scene" --frames 5 $frames -o other.mp4 -q
    yes film_is_the_same cmp film.mp4 other.mp4
    yes film_leaves_no_frames [ ! -e film.mp4.frames ]
    rm film.batch/parts/000002.png film.mp4
    check film_misses 1 "$RAMIFY" batch merge film.batch
    says film_misses_says err '1 of 5 frames are missing: 2;'
fi
printf 'animation: {frames: 3, tracks: [{path: camera.fov, keys: [{at: 0, value: 20}, {at: 0.5, value: 40}]}]}\n' |
    cat scenes/scene.yaml - >scenes/moves.yaml
check moves 0 "$RAMIFY" batch scenes/moves.yaml --frames 1-2 $frames -o m-%d.png -q
"$RAMIFY" render scenes/moves.yaml --frame 1 $frames -o m.png -q
check moves_is_the_still 0 "$RAMIFY" compare m.png m-1.png
check beyond 2 "$RAMIFY" batch scenes/moves.yaml --frames 0-3 $frames -o n-%d.png
says beyond_says err 'no frame 3; there are 3'

# ---- refusals: status 2, and nothing is written

refuse() { # NAME TEXT WORD...
    name=$1 text=$2
    shift 2
    check "$name" 2 "$RAMIFY" batch "$@"
    says "${name}_says" err "$text"
}
refuse nothing 'no scene file is named'
refuse neither 'neither --tiles nor --frames' $scene -o x.png
refuse both 'both --tiles and --frames' $scene -o x.png --tiles 1x1 --frames 0-1
refuse small_tiles 'at most 6x5' $scene -o x.png --tiles 7x5
refuse bad_tiles 'COLUMNSxROWS' $scene -o x.png --tiles 3
refuse bad_frames 'A <= B' $scene -o x-%d.png --frames 5-3
refuse frames_without_number 'holds no frame number' $scene -o x.png --frames 0-3
refuse half_film 'which a film needs' $scene -o x.mp4 --frames 1-3/5
refuse engine 'must be one of local, slurm, openjd' $scene -o x.png --tiles 1x1 --engine pbs --folder new.batch
rm -rf new.batch
refuse ending 'must be .png, .jpg or .exr' $scene -o x.gif --tiles 1x1
refuse seconds 'render.seconds' $scene -o x.png --tiles 1x1 --set render.seconds=5
refuse cropped 'film.crop' $scene -o x.png --tiles 1x1 --set 'film.crop=[0, 0, 0.5, 1]'
printf 'film: {widht: 3}\n' >scenes/wrong.yaml
refuse scene_place 'scenes/wrong.yaml:1:8: ' scenes/wrong.yaml -o x.png --tiles 1x1
refuse action 'must be status, run, merge or submit' stauts all.batch
refuse no_batch 'name the folder of a batch' status scenes
refuse options_of_plan "from the folder's plan" submit all.batch --samples 3
refuse parts 'within 0-5' run all.batch --parts 4-6
refuse other_plan "its plan has '--tiles=3x2'" $scene --tiles 2x2 -o all.png
yes refusals_write_nothing [ "$(ls -d x* 2>/dev/null | wc -l)" -eq 0 ]
sed 's/^ramify .*/ramify 0.0.1/' all.batch/plan >plan && cp plan all.batch/plan
refuse other_version 'was planned by ramify 0.0.1' status all.batch
printf 'x' >all.batch/plan
refuse damaged 'is damaged' status all.batch
check no_folder 1 "$RAMIFY" batch $scene --tiles 1x1 -o x.png --folder none/x.batch
says no_folder_says err "folder '$PWD/none/x.batch' cannot be made: No such file"

# ---- a full disk

if mkdir small && mount -t tmpfs -o size=32k none small 2>/dev/null; then
    check full 1 "$RAMIFY" batch $scene --tiles 2x2 -o full.png --folder small/b
    says full_says err 'tiles are missing'
    yes full_says_why grep -q 'No space left' small/b/logs/*
    yes full_leaves_no_half [ "$(find small -name '*.ramify-*' | wc -l)" -eq 0 ]
    mount -o remount,size=20m small
    check room 0 "$RAMIFY" batch submit small/b -q
    yes room_has_the_bits cmp whole.exr full.exr
    umount small
else
    echo "skipped full: a tmpfs cannot be mounted here"
fi

# ---- Slurm: what it is told (tests/cluster has a real one)

mkdir bin
cat >bin/sbatch <<'END'
#!/bin/sh
[ "$1" = --version ] || echo "$*" >>"$CALLS"
[ ! -e "$CALLS.fails" ] || { echo "sbatch: error: invalid partition specified: q" >&2; exit 1; }
wc -l <"$CALLS"
END
chmod +x bin/sbatch
export CALLS="$PWD/calls"
: >calls
check slurm_missing 2 env PATH=/nowhere "$RAMIFY" batch $scene --tiles 2x2 -o none.png --engine slurm
says slurm_missing_says err "'sbatch' cannot be started"
PATH=$PWD/bin:$PATH
check slurm 0 "$RAMIFY" batch $scene --tiles 5x4 --pack 3 -o s.png --engine slurm --partition q --sbatch=--time=7 --threads 3
says slurm_says err 'submitted: tasks 1, merge 2'
says slurm_estimate err '20 tiles, 3 a task; about'
says slurm_array calls '--array=0-6 --output=logs/task-0%3a.log slurm/task.sh 0'
says slurm_merge calls '--dependency=afterany:1 slurm/merge.sh'
for line in '--cpus-per-task=3' '--partition=q' '--time=7' '--requeue' '--mem=500M'; do
    yes "slurm_directive_$line" grep -qx "#SBATCH $line" s.batch/slurm/task.sh
done
for task in 0 3 6; do
    SLURM_ARRAY_TASK_ID=$task SLURM_CPUS_PER_TASK=1 SLURM_RESTART_COUNT=9 sh s.batch/slurm/task.sh 0 >out 2>err
done
yes slurm_tasks [ "$(ls s.batch/parts | tr '\n' ' ')" = '000000.exr 000001.exr 000002.exr 000009.exr 000010.exr 000011.exr 000018.exr 000019.exr ' ]
: >calls
check slurm_rest 0 "$RAMIFY" batch submit s.batch --pack 3 --engine slurm -q
says slurm_rest_says calls '--array=1-2,4-5 '
: >calls
check many 0 "$RAMIFY" batch $scene --frames 0-2499 $frames -o n-%04d.png --pack 1 --engine slurm -q
says many_first calls '--array=0-999 --output=logs/task-0%3a.log slurm/task.sh 0'
says many_last calls '--array=0-499 --output=logs/task-2%3a.log slurm/task.sh 2000'
says many_merge calls 'afterany:1:2:3 '
: >calls.fails
check slurm_refuses 1 "$RAMIFY" batch submit s.batch --engine slurm
says slurm_refuses_says err 'invalid partition'

# ---- Open Job Description

check openjd 0 "$RAMIFY" batch $scene --tiles 3x2 --pack 2 -o o.png --engine openjd
says openjd_says err 'template.yaml: written'
"$RAMIFY" batch run o.batch --parts 1-2 -q
check openjd_rest 0 "$RAMIFY" batch submit o.batch --pack 2 --engine openjd -q
says openjd_range o.batch/template.yaml 'range: "0,3-5"'
openjd=$RAMIFY_PEERS/python/bin/openjd
if [ -x "$openjd" ]; then
    yes openjd_check "$openjd" check o.batch/template.yaml
    yes openjd_run "$openjd" run o.batch/template.yaml --step Merge --run-dependencies -p "Ramify=$RAMIFY"
    yes openjd_has_the_bits cmp whole.exr o.exr
else
    echo "skipped openjd: openjd-cli is not installed"
fi
