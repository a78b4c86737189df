#!/bin/sh
# ramify turntable as a user meets it: frames, films, interruptions, mistakes. RAMIFY names the binary.
# Prints "ok NAME", "not ok NAME" or "skipped NAME: why" for each case.
. "$(dirname "$0")/checks.sh"
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

cat >scene.yaml <<'END'
seed: 3
camera: {position: [0, 1.5, 7], target: [0, 1.4, 0], fov: 35}
film: {width: 33, height: 21}
render: {samples: 4, max_depth: 3}
sky: {kind: constant, color: 1}
objects:
  - {name: plant, lsystem: {generations: 3}}
  - {name: stone, shape: {envelope: [{shape: sphere, size: 0.5, position: [1.5, 0.5, 1]}]}}
END
cat >moves.yaml <<'END'
camera: {position: [0, 1.5, 7], target: [0, 0, 0], fov: 35}
film: {width: 32, height: 20}
render: {samples: 4, max_depth: 3}
sky: {kind: constant, color: 1}
animation:
  frames: 4
  fps: 12
  tracks:
    - {path: camera.fov, keys: [{at: 0, value: 20}, {at: 0.5, value: 40}]}
objects:
  - {name: stone, shape: {envelope: [{shape: box, size: [1, 1, 1]}]}}
END

no() {
    name=$1
    shift
    if "$@" >log 2>&1; then echo "not ok $name"; else echo "ok $name"; fi
}
count() { ls "$@" 2>/dev/null | wc -l; }
sum() { cat "$@" | cksum; }

# ---- frames
mkdir a b
check frames 0 "$RAMIFY" turntable scene.yaml --frames 6 -o a/f-%02d.png --json
says built_once out '"geometries": 1, "structures": 1'
yes all_frames [ "$(count a/f-0?.png)" -eq 6 ]
check again 0 "$RAMIFY" turntable scene.yaml --frames 6 -o a/f-%02d.png --json
says again_skips out '"rendered": 0, "skipped": 6'
check one_thread 0 "$RAMIFY" turntable scene.yaml --frames 6 -o b/f-%02d.png --threads 1 -q
yes same_bits [ "$(sum a/*)" = "$(sum b/*)" ]
check first_is_the_still 0 "$RAMIFY" render scene.yaml -o still.png -q
"$RAMIFY" render scene.yaml --frame 0 -o zero.png -q
yes frame_0_is_the_still cmp still.png zero.png

# a frame that is broken, from another scene or gone is made again, and only that
before=$(sum a/*)
head -c 600 a/f-01.png >cut && cp cut a/f-01.png && rm a/f-03.png
"$RAMIFY" turntable scene.yaml --frames 6 -o a/f-%02d.png -q --set seed=4 --start 4 --end 4
check mends 0 "$RAMIFY" turntable scene.yaml --frames 6 -o a/f-%02d.png --json
says mends_three out '"rendered": 3, "skipped": 3'
yes mends_to_the_same_bits [ "$(sum a/*)" = "$before" ]
check changed_scene 0 "$RAMIFY" turntable scene.yaml --frames 6 -o a/f-%02d.png --set camera.fov=30 --json
says changed_scene_renders out '"rendered": 6, "skipped": 0'

check other_isa 0 "$RAMIFY" turntable scene.yaml --frames 6 -o b/f-%02d.png --isa sse4.2 --end 1 --json
says other_isa_renders out '"rendered": 2, "skipped": 0'
"$RAMIFY" turntable scene.yaml --frames 6 -o b/f-%02d.png -q

# other endings know their frames, too
for ending in jpg exr; do
    check "$ending" 0 "$RAMIFY" turntable scene.yaml --frames 2 -o "x-%d.$ending" -q
    check "${ending}_again" 0 "$RAMIFY" turntable scene.yaml --frames 2 -o "x-%d.$ending" --json
    says "${ending}_skips" out '"rendered": 0, "skipped": 2'
done

# split over machines
mkdir c
check first_half 0 "$RAMIFY" turntable scene.yaml --frames 6 -o c/f-%02d.png --end 2 -q
yes first_half_only [ "$(count c/*)" -eq 3 ]
check second_half 0 "$RAMIFY" turntable scene.yaml --frames 6 -o c/f-%02d.png --start 3 -q
yes halves_make_the_whole [ "$(sum c/*)" = "$(sum b/*)" ]

# what does not move keeps every bit; with --vary-noise it does not
check still_camera 0 "$RAMIFY" turntable scene.yaml --frames 2 --turns 0 -o s-%d.exr -q
"$RAMIFY" turntable scene.yaml --frames 2 --turns 0 --vary-noise -o v-%d.exr -q
"$RAMIFY" turntable scene.yaml --frames 2 --turns 0 -o s-%d.png -q
"$RAMIFY" turntable scene.yaml --frames 2 --turns 0 --vary-noise -o v-%d.png -q
pixels() { ffmpeg -v error -i "$1" -f rawvideo -pix_fmt rgb24 - | cksum; }
yes no_flicker [ "$(pixels s-0.png)" = "$(pixels s-1.png)" ]
no grain [ "$(pixels v-0.png)" = "$(pixels v-1.png)" ]

# exposures: one for all frames, whichever are rendered
check exposed 0 "$RAMIFY" turntable moves.yaml --set film.auto_exposure=true -o e-%d.png -q
"$RAMIFY" turntable moves.yaml --set film.auto_exposure=true -o g-%d.png --start 2 --end 2 -q
yes exposure_is_of_all_frames cmp e-2.png g-2.png
says exposure_is_locked e-0.png 'auto_exposure: false'

# ---- animations
check moment 0 "$RAMIFY" render moves.yaml --frame 1 -o m1.png -q
"$RAMIFY" render moves.yaml --time 0.25 -o m2.png -q
"$RAMIFY" render moves.yaml --set camera.fov=30 -o m3.png -q
yes moment_is_its_value [ "$(pixels m1.png)" = "$(pixels m3.png)" ]
yes frame_1_of_4_is_a_quarter cmp m1.png m2.png
check no_such_frame 2 "$RAMIFY" render moves.yaml --frame 4 -o m.png
says no_such_frame_says err 'no frame 4; there are 4, counted from 0'
sed 's/value: 40/value: 400/' moves.yaml >bad.yaml
check bad_track 2 "$RAMIFY" turntable bad.yaml -o t-%d.png
says bad_track_names_its_line err 'bad.yaml:9:14: frame 1: camera.fov is 210'
sed 's/path: camera.fov/path: camera.fow/' moves.yaml >lost.yaml
for command in info 'render -o t.png'; do # tracks name what is there, also for a still
    check "lost_track_${command%% *}" 2 "$RAMIFY" $command lost.yaml
    says "lost_track_${command%% *}_says" err "lost.yaml:9:14: frame 0: unknown key 'fow' in camera; did you mean 'fov'?"
done

# a crop that moves leaves nothing of earlier frames beyond it
cat moves.yaml >crop.yaml
sed -i 's/{path: camera.fov.*/{path: film.crop, ease: step, keys: [{at: 0, value: [0, 0, 1, 1]}, {at: 0.25, value: [0.4, 0.4, 0.6, 0.6]}]}/' crop.yaml
check crops 0 "$RAMIFY" turntable crop.yaml -o w-%d.png -q
"$RAMIFY" turntable crop.yaml -o v2-%d.png --start 2 --end 2 -q
yes crop_is_of_its_frame cmp w-2.png v2-2.png
yes bad_track_before_any_frame [ "$(count t-*)" -eq 0 ]

# ---- films
check film 0 "$RAMIFY" turntable scene.yaml --frames 6 --fps 12.5 -o film.mp4 -q
no film_leaves_no_frames [ -e film.mp4.frames ]
probe() { ffprobe -v error -select_streams v -count_frames -show_entries "stream=$1" -of csv=p=0 film.mp4; }
yes film_is_h264 [ "$(probe codec_name,pix_fmt)" = h264,yuv420p ]
yes film_is_even [ "$(probe width,height)" = 32,20 ]
yes film_has_all_frames [ "$(probe nb_read_frames)" = 6 ]
yes film_has_its_speed [ "$(probe r_frame_rate)" = 25/2 ]
yes film_is_bt709 [ "$(probe color_space,color_transfer,color_primaries,color_range)" = tv,bt709,bt709,bt709 ]
check film_one_thread 0 "$RAMIFY" turntable scene.yaml --frames 6 --fps 12.5 -o film1.mp4 -q --threads 1
yes film_same_bits cmp film.mp4 film1.mp4
# It shows the frames, and from the last to the first is a step like any other.
ffmpeg -v error -i film.mp4 -f rawvideo -pix_fmt gray film.raw
i=0
while [ $i -lt 6 ]; do
    ffmpeg -v error -i b/f-0$i.png -vf crop=32:20:0:0 -f rawvideo -pix_fmt gray - && i=$((i + 1))
done >frames.raw
yes film_shows_the_frames_and_loops python3 - <<'END'
film, frames = open("film.raw", "rb").read(), open("frames.raw", "rb").read()
n = 32 * 20
def off(a, i, b, j):
    return sum(abs(x - y) for x, y in zip(a[i * n:i * n + n], b[j * n:j * n + n])) / n
assert len(film) == len(frames) == 6 * n
steps = [off(film, i, film, (i + 1) % 6) for i in range(6)]
print(steps, [off(film, i, frames, i) for i in range(6)])
assert all(off(film, i, frames, i) < 4 for i in range(6))
assert steps[5] < 1.5 * max(steps[:5]) and min(steps) > 1
END

# ---- interruptions: long enough to be met half way
long="$RAMIFY turntable scene.yaml --frames 30 --samples 60 --size 64x48"
interrupt() { # interrupt SIGNAL: when 5 frames are there
    mkdir -p i
    setsid sh -c 'exec "$@"' sh $long -o i/f-%02d.png -q 2>err &
    child=$!
    tries=0
    while [ "$(count i/f-??.png)" -lt 5 ] && [ $tries -lt 1200 ]; do sleep 0.05; tries=$((tries + 1)); done
    kill "-$1" $child
    wait $child
    status=$?
}
interrupt INT
yes interrupted_is_130 [ $status -eq 130 ]
says interrupted_says_how_to_go_on err 'run the same command again'
there=$(count i/f-??.png)
yes interrupted_half_way [ "$there" -ge 5 -a "$there" -lt 30 ]
no interrupted_leaves_nothing_half ls i/*.part
interrupt KILL
check goes_on 0 $long -o i/f-%02d.png --json
no goes_on_from_where_it_was grep -q '"skipped": [0-4],' out
yes goes_on_to_the_end [ "$(count i/f-??.png)" -eq 30 ]
mkdir j
check uninterrupted 0 $long -o j/f-%02d.png -q
yes interruptions_do_not_show [ "$(sum i/f-??.png)" = "$(sum j/f-??.png)" ]
mkdir -p k.mp4.frames && cp j/f-07.png k.mp4.frames/000007.png && cp j/f-08.png k.mp4.frames/000008.png
echo half >k.mp4.frames/000009.png.ramify-1-0.part
check film_goes_on 0 $long -o k.mp4 --json
says film_goes_on_from_its_frames out '"rendered": 28, "skipped": 2'
no film_clears_up [ -e k.mp4.frames ]

# A frame that takes long goes on with the samples it had, after Ctrl-C and after a kill.
slow="$RAMIFY turntable scene.yaml --frames 2 --end 0 --samples 600 --size 96x72 --checkpoint 0.1 -o l/f-%d.png"
stop_frame() { # stop_frame SIGNAL: while frame 0 is being traced, after it was saved by this run
    mkdir -p l
    touch started
    setsid sh -c 'exec "$@"' sh $slow -q 2>err &
    child=$!
    tries=0
    until [ l/f-0.begun.exr -nt started ] || [ $tries -ge 1200 ]; do sleep 0.05; tries=$((tries + 1)); done
    kill "-$1" $child
    wait $child
}
paths() { sed -n 's/.*"paths": \([0-9]*\).*/\1/p' "$1"; }
stop_frame KILL
yes killed_frame_is_saved [ -e l/f-0.begun.exr -a ! -e l/f-0.png ]
stop_frame INT
yes stopped_frame_is_saved [ -e l/f-0.begun.exr -a ! -e l/f-0.png ]
cp l/f-0.begun.exr begun.exr
check frame_goes_on 0 $slow --json
cp out goes_on
no frame_leaves_nothing ls l/*.begun.exr
mv l whole && mkdir l
check frame_uninterrupted 0 $slow --json
yes frame_has_the_same_bits [ "$(sum whole/f-?.png)" = "$(sum l/f-?.png)" ]
yes frame_went_on [ "$(paths goes_on)" -lt "$(paths out)" ]
rm l/f-0.png && cp begun.exr l/f-0.begun.exr
check other_frame 0 $slow --set camera.fov=31 --json
yes other_frame_starts_anew [ "$(paths out)" -eq "$((96 * 72 * 600))" ]
rm l/f-0.png && echo damaged >l/f-0.begun.exr
check damaged_frame 0 $slow --json
says damaged_frame_says err 'f-0.begun.exr'
yes damaged_frame_starts_anew [ "$(paths out)" -eq "$((96 * 72 * 600))" ]

# Two runs do not make one film: the later one says so, and harms nothing.
setsid sh -c 'exec "$@"' sh $long -o two.mp4 -q 2>first &
child=$!
tries=0
while [ "$(count two.mp4.frames/*.png)" -lt 2 ] && [ $tries -lt 1200 ]; do sleep 0.05; tries=$((tries + 1)); done
check second_run 1 "$RAMIFY" turntable scene.yaml --frames 2 -o two.mp4 -q
says second_run_says err "another run has its frames in 'two.mp4.frames'"
kill -KILL $child
wait $child
yes killed_run_leaves_frames [ "$(count two.mp4.frames/*.png)" -ge 2 ]
check after_a_killed_run 0 "$RAMIFY" turntable scene.yaml --frames 2 -o two.mp4 -q
no after_a_killed_run_clears_up [ -e two.mp4.frames ]
check one_frame 0 "$RAMIFY" turntable scene.yaml --frames 1 -o one.mp4 -q
yes one_frame_is_a_film [ "$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 one.mp4)" = 1 ]

# ---- mistakes
for bad in oak.png oak-%s.png oak-%n%d.png oak-%04d-%d.png oak-%04d.gif %04d oak; do
    check "bad_output_$bad" 2 "$RAMIFY" turntable scene.yaml -o "$bad"
done
check bad_folder 1 "$RAMIFY" turntable scene.yaml -o nowhere/f-%d.png
check bad_keys 2 "$RAMIFY" turntable scene.yaml --elevation 10:95 -o t-%d.png
says bad_keys_say err 'colons between'
check bad_ease 2 "$RAMIFY" turntable scene.yaml --ease bouncy -o t-%d.png
check no_sun 2 "$RAMIFY" turntable scene.yaml --sun 5:19 -o t-%d.png
check bad_range 2 "$RAMIFY" turntable scene.yaml --frames 6 --start 4 --end 6 -o t-%d.png
says bad_range_says err 'the last number 5'
check no_ffmpeg 1 env PATH=/nowhere "$RAMIFY" turntable scene.yaml -o no.mp4
says no_ffmpeg_names_it err 'ffmpeg is not installed'
no no_ffmpeg_before_any_frame [ -e no.mp4.frames ]
mkdir fake && printf '#!/bin/sh\necho "the disk is on fire" >&2\nexit 3\n' >fake/ffmpeg && chmod +x fake/ffmpeg
check ffmpeg_fails 1 env PATH="$PWD/fake:$PATH" "$RAMIFY" turntable scene.yaml --frames 2 -o fire.mp4 -q
says ffmpeg_fails_in_its_words err 'the disk is on fire'
yes ffmpeg_fails_and_frames_stay [ "$(count fire.mp4.frames/*.png)" -eq 2 ]
no ffmpeg_fails_without_a_film [ -e fire.mp4 ]

# A full disk ends it; what was finished stays.
if mkdir full && mount -t tmpfs -o size=64k tmpfs full 2>/dev/null; then
    trap 'umount "$folder/full"; rm -rf "$folder"' EXIT
    check full_disk 1 "$RAMIFY" turntable scene.yaml --frames 30 --size 96x64 -o full/f-%02d.png -q
    says full_disk_says err 'No space left'
    yes full_disk_keeps_frames [ "$(count full/f-??.png)" -ge 1 ]
    no full_disk_leaves_nothing_half ls full/*.part
else
    mkdir -p full && ln -s /dev/full full/f-1.png 2>/dev/null
    check full_device 1 "$RAMIFY" turntable scene.yaml --frames 2 -o full/f-%d.png -q
    yes full_device_keeps_frame_0 [ -s full/f-0.png ]
fi
