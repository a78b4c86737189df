#!/bin/sh
# The film's colour as a user meets it: views, OpenColorIO's configurations, PNGs of 16 bits. RAMIFY names the binary.
# Prints "ok NAME", "not ok NAME" or "skipped NAME: what is missing" for each case.
. "$(dirname "$0")/checks.sh"
RAMIFY=$(realpath "${RAMIFY:-build/ramify}")
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

cat >views.ocio <<'END_OF_CONFIG'
ocio_profile_version: 2
environment: {}
roles: {default: linear, scene_linear: linear}
displays:
  Screen:
    - !<View> {name: Gamma, colorspace: gamma}
    - !<View> {name: Bright, colorspace: gamma, looks: double}
  Beamer:
    - !<View> {name: Dim, colorspace: linear}
looks:
  - !<Look> {name: double, process_space: linear, transform: !<CDLTransform> {slope: [2, 2, 2]}}
colorspaces:
  - !<ColorSpace> {name: linear}
  - !<ColorSpace> {name: gamma, from_scene_reference: !<ExponentTransform> {value: [2.4, 2.2, 2, 1], direction: inverse}}
END_OF_CONFIG
# All of the picture is one wall, so that no pixel has an edge.
cat >scene.yaml <<'END_OF_SCENE'
camera: {position: [0, 2, 5], target: [0, 0.5, 0], fov: 20}
film: {width: 48, height: 32, bloom: 0, vignette: 0, exposure: 0}
render: {samples: 4, max_depth: 3}
sky: {kind: sun_sky, sun_elevation: 30}
objects:
  - {name: ground, shape: {envelope: [{shape: box, size: [30, 1, 30], position: [0, -1, 0]}]}}
END_OF_SCENE
sed 's/exposure: 0/exposure: 0, color: {config: views.ocio, view: Bright}/' scene.yaml >ocio.yaml

check standard 0 "$RAMIFY" render scene.yaml -q -o scene.png
check ocio 0 "$RAMIFY" render ocio.yaml -q -o ocio.png --set film.png_depth=16
check views_differ 1 "$RAMIFY" compare scene.png ocio.png
check other_view 0 "$RAMIFY" render ocio.yaml -q -o dim.png --set film.color.display=Beamer --set film.color.view=Dim
check other_view_differs 1 "$RAMIFY" compare ocio.png dim.png
bits() { # of a PNG's channel
    od -An -tu1 -j24 -N1 "$1" | tr -d ' '
}
yes eight_bits [ "$(bits scene.png)" = 8 ]
yes sixteen_bits [ "$(bits ocio.png)" = 16 ]
# A PNG has fewer pixels than its film, which the .exr keeps.
big_endian() { od -An -tu1 -j"$2" -N4 "$1" | awk '{ print $3 * 256 + $4 }'; }
check downsample 0 "$RAMIFY" render scene.yaml -q -o small.png --set film.downsample=4
yes downsample_width [ "$(big_endian small.png 16)" = 12 ]
yes downsample_height [ "$(big_endian small.png 20)" = 8 ]
yes downsample_keeps_exr "$RAMIFY" compare small.exr scene.exr --max-rmse 0
check downsample_again 0 "$RAMIFY" render small.exr -q -o again.png
yes downsample_same "$RAMIFY" compare small.png again.png --max-rmse 0
check downsample_odd 2 "$RAMIFY" render scene.yaml -q -o wrong.png --set film.downsample=5
says downsample_odd_says err 'film.downsample is 5; it must divide the width of 48 and the height of 32 pixels'
if command -v oiiotool >/dev/null; then
    oiiotool ocio.exr --ch R,G,B --colorconfig views.ocio --ociodisplay:from=linear Screen Bright -d uint16 -o peer.png
    oiiotool ocio.png --ch R,G,B -o own.png
    yes equals_openimageio "$RAMIFY" compare own.png peer.png --max-rmse 0.00002 --threshold 0.0001
else
    echo "skipped equals_openimageio: oiiotool"
fi

check wrong_view 2 "$RAMIFY" render ocio.yaml -q -o wrong.png --set film.color.view=Film
says wrong_view_lists err "'Film' is no view of display 'Screen' of the configuration; it has Gamma, Bright"
sed 's/view: Bright/view: Film/' ocio.yaml >wrong.yaml
check wrong_place 2 "$RAMIFY" render wrong.yaml -q -o wrong.png
says wrong_place_is_told err "wrong.yaml:2:101: 'Film' is no view"
yes nothing_written [ ! -e wrong.png ]
check wrong_film 2 "$RAMIFY" turntable wrong.yaml -q --frames 2 -o 'wrong-%d.png'
says wrong_film_is_told err "wrong.yaml:2:101: 'Film' is no view"
sed 's/view: Bright/look: half/' ocio.yaml >wrong.yaml
check wrong_look 2 "$RAMIFY" render wrong.yaml -q -o wrong.png
says wrong_look_lists err "'half' is no look of the configuration; it has double"
sed 's/config: views/config: missing/' ocio.yaml >wrong.yaml
check missing_config 2 "$RAMIFY" render wrong.yaml -q -o wrong.png
says missing_config_place err "wrong.yaml:2:83: film.color.config: cannot read 'missing.ocio'"
sed 's/config: views.ocio/config: "ocio:\/\/nothing-of-this-name"/' ocio.yaml >wrong.yaml
check unknown_builtin 2 "$RAMIFY" render wrong.yaml -q -o wrong.png
says unknown_builtin_place err "wrong.yaml:2:83: OpenColorIO cannot use 'ocio://nothing-of-this-name'"
check no_need_of_it 0 "$RAMIFY" info wrong.yaml
printf 'ocio_profile_version: 2\ncolorspaces: [\n' >views.ocio
check broken_config 2 "$RAMIFY" render ocio.yaml -q -o wrong.png
says broken_config_place err "ocio.yaml:2:83: OpenColorIO cannot use"
