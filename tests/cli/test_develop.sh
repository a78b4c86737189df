#!/bin/sh
# `ramify develop` as a user meets it: the same bits without a change, other film settings without tracing, and what it refuses.
# RAMIFY names the binary. Prints "ok NAME" or "not ok NAME" for each case.
. "$(dirname "$0")/checks.sh"
RAMIFY=$(realpath "${RAMIFY:-build/ramify}")
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

cat >scene.yaml <<'END_OF_SCENE'
camera: {position: [0, 2, 5], target: [0, 0.5, 0], fov: 20}
film: {width: 48, height: 32, denoise: true}
render: {samples: 4, max_depth: 3}
sky: {kind: sun_sky, sun_elevation: 30}
objects: [{name: ground, ground: {radius: 20, flat_radius: 5}}]
END_OF_SCENE

check render 0 "$RAMIFY" render scene.yaml -o a.png -q
cp a.exr before.exr
check same 0 "$RAMIFY" develop a.exr -o same.png
says same_says err 'same.png: 48 x 32 pixels'
yes same_bits cmp a.png same.png
check render_other 0 "$RAMIFY" render scene.yaml --set film.contrast=1.4 --set film.grain=0.02 --exposure 1 -o b.png -q
check other 0 "$RAMIFY" develop a.exr --set film.contrast=1.4 --set film.grain=0.02 --exposure 1 -o other.png -q
yes other_as_rendered_so cmp b.png other.png
check plain 0 "$RAMIFY" develop a.exr --set film.contrast=1.4 --exposure 1 -o plain.png -q
check grain_is_seen 1 "$RAMIFY" compare plain.png other.png
check noise 0 "$RAMIFY" develop a.exr --no-denoise -o noise.jpg -q
yes film_is_as_it_was cmp a.exr before.exr
# a developed picture is a scene, too, with what was changed
check again 0 "$RAMIFY" render other.png -o c.png -q
yes again_as_rendered_so cmp b.png c.png

# a film of more than 512 MB is read in several goes
check large 0 "$RAMIFY" render scene.yaml --size 2000x1000 --samples 1 --no-denoise -o large.png -q
check large_developed 0 "$RAMIFY" develop large.exr -o same_large.png -q
yes large_bits cmp large.png same_large.png

check not_traced 2 "$RAMIFY" develop a.exr --set render.samples=9 -o x.png
says not_traced_says err "--set render.samples=9 needs new samples"
for key in width=96 height=9 filter=box filter_radius=2 'crop=[0, 0, 0.5, 1]' crop.0=0.5; do
    check "not_traced_$key" 2 "$RAMIFY" develop a.exr --set "film.$key" -o x.png
done
check bad_value 2 "$RAMIFY" develop a.exr --set film.grain=7 -o x.png
says bad_value_says err film.grain
check no_film 2 "$RAMIFY" develop a.png -o x.png
says no_film_says err "'a.png' holds no film"
check no_output 2 "$RAMIFY" develop a.exr
check exr_output 2 "$RAMIFY" develop a.exr -o a.exr
yes film_is_kept cmp a.exr before.exr
yes nothing_is_written [ ! -e x.png ]
