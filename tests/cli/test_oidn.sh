#!/bin/sh
# film.denoiser as a user meets it, with a stand-in for Open Image Denoise's library. RAMIFY names the binary.
# Prints "ok NAME" or "not ok NAME" for each case.
. "$(dirname "$0")/checks.sh"
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
fake=$(cd "$(dirname "$0")/../image" && pwd)/fake_oidn.c
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

cat >scene.yaml <<'END_OF_SCENE'
camera: {position: [0, 1.5, 5], target: [0, 0.5, 0], fov: 35}
film: {width: 48, height: 32, denoise: true, denoiser: oidn}
render: {samples: 2, max_depth: 3}
sky: {kind: constant, color: 1}
objects:
  - {name: ball, shape: {envelope: [{shape: sphere, size: 0.5, position: [0, 0.5, 0]}]}}
END_OF_SCENE
mkdir path
for version in 1 2; do
    "${CC:-cc}" -std=c17 -shared -fPIC -DVERSION=$version "$fake" -o "fake$version.so"
done
cp fake2.so path/libOpenImageDenoise.so.2
render() { # render FILE LIBRARY ARGUMENT...
    file=$1 library=$2
    shift 2
    RAMIFY_OIDN=$library "$RAMIFY" render scene.yaml -q -o "$file" "$@"
}

same() { # same NAME A B: the pictures' pixels are
    yes "$1" "$RAMIFY" compare "$2" "$3"
}
differs() {
    check "$1" 1 "$RAMIFY" compare "$2" "$3"
}

check raw 0 render raw.png none.so --no-denoise
check own 0 render own.png none.so --set film.denoiser=own
check version_2 0 render two.png ./fake2.so
check version_1 0 render one.png ./fake1.so
same versions_agree one.png two.png
differs own_denoises raw.png own.png
differs oidn_denoises raw.png two.png
differs oidn_is_another own.png two.png
check own_is_the_default 0 sh -c "sed 's/, denoiser: oidn//' scene.yaml >plain.yaml
    RAMIFY_OIDN=./fake2.so '$RAMIFY' render plain.yaml -q -o plain.png"
same default_is_own own.png plain.png
check loader_path 0 env -u RAMIFY_OIDN LD_LIBRARY_PATH="$folder/path" "$RAMIFY" render scene.yaml -q -o path.png
same loader_path_is_searched two.png path.png
check option_and_key 0 env RAMIFY_OIDN=./fake2.so "$RAMIFY" render plain.yaml -q -o set.png --denoise \
    --set film.denoiser=oidn
same key_can_be_set two.png set.png

cp two.png kept.png
check missing_library 2 render two.png ./none.so
says missing_library_place err "scene.yaml:2:56: film.denoiser is oidn, but Open Image Denoise cannot be loaded (./none.so: "
says missing_library_help err "install its library, version 1 or 2 (https://openimagedenoise.org), or name the file in the"
yes old_picture_unharmed cmp two.png kept.png
check missing_but_unused 0 render raw2.png ./none.so --no-denoise
same unused_is_raw raw.png raw2.png
check set_without_library 2 env RAMIFY_OIDN=./none.so "$RAMIFY" render plain.yaml -q -o x.png --set film.denoiser=oidn
check unknown_denoiser 2 render x.png ./fake2.so --set film.denoiser=nlm
check other_commands_need_no_library 0 env RAMIFY_OIDN=./none.so "$RAMIFY" export -q scene.yaml -o x.stl
yes nothing_written test ! -e x.png

check auto_with_library 0 render auto.png ./fake2.so --set film.denoiser=auto
same auto_takes_oidn auto.png two.png
check auto_without_library 0 env RAMIFY_OIDN=./none.so "$RAMIFY" render scene.yaml -o auto.png --set film.denoiser=auto
says auto_warns err "./none.so: cannot open shared object file"
says auto_warns_what_it_does err "ramify's own denoiser is used"
same auto_takes_own auto.png own.png

# What was traced stays in the EXR, with the denoised layer beside it; only when denoising is asked for.
same traced_layer_is_raw raw.exr two.exr
yes denoised_layer_is_beside grep -qaF denoised.R two.exr
check no_denoised_layer 1 grep -qaF denoised.R raw.exr
check only_an_exr 0 render three.exr ./fake2.so
yes same_exr cmp two.exr three.exr

# Previews are denoised, and so is what Ctrl-C leaves.
sed 's/samples: 2/samples: 1000000/' scene.yaml >long.yaml
RAMIFY_OIDN=./fake2.so "$RAMIFY" render long.yaml -q -o long.png 2>/dev/null &
process=$!
left=600
while [ $left -gt 0 ] && ! "$RAMIFY" compare two.png long.png --max-rmse 0.03 >/dev/null 2>&1; do
    sleep 0.1
    left=$((left - 1))
done
yes preview_is_denoised [ $left -gt 0 ]
kill -INT $process
wait $process
check interrupted_is_denoised 0 "$RAMIFY" compare two.png long.png --max-rmse 0.03
check interrupted_is_not_raw 1 "$RAMIFY" compare raw.png long.png --max-rmse 0.03
yes interrupted_has_the_layer grep -qaF denoised.R long.exr

# The rendering is not lost: the EXR is there, and the picture is the last preview.
rm two.exr
check library_fails 1 env FAKE_OIDN=execute RAMIFY_OIDN=./fake2.so "$RAMIFY" render scene.yaml -q -o two.png
says library_fails_message err "Open Image Denoise failed: not committed"
yes library_fails_after_exr test -s two.exr

# A film: every frame is denoised alike, and frames of another denoiser are not taken for these.
turn() { # turn LIBRARY ARGUMENT...
    library=$1
    shift
    RAMIFY_OIDN=$library "$RAMIFY" turntable scene.yaml -o 'f%d.png' --frames 2 --json "$@"
}
check turn_missing_library 2 turn ./none.so
says turn_missing_library_place err "scene.yaml:2:56: film.denoiser is oidn"
yes turn_no_frame test ! -e f0.png
check turn_own 0 turn ./none.so --set film.denoiser=auto
cp f0.png own0.png
check turn_oidn 0 turn ./fake2.so --set film.denoiser=auto
says turn_other_denoiser out '"rendered": 2, "skipped": 0'
differs turn_is_denoised_by_it f0.png own0.png
check turn_again 0 turn ./fake2.so --set film.denoiser=auto
says turn_same_denoiser out '"rendered": 0, "skipped": 2'
