#!/bin/sh
# USD files read by OpenUSD (`make peers` installs it): its own checks, and numbers held against those of ramify and of the
# scene. RAMIFY names the binary, RAMIFY_PEERS where the peers are. Prints "ok NAME", "not ok NAME" or "skipped NAME: why".
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
python=${RAMIFY_PEERS:-$PWD/build/peers}/python/bin/python
tests=$(cd "$(dirname "$0")/.." && pwd)
check=$tests/peers/usd_check.py
if ! "$python" -c 'import pxr.Usd, numpy' 2>/dev/null; then
    echo "skipped usd: usd-core is not installed"
    exit 0
fi
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

result() { # result NAME: by the status of the command before
    if [ $? -eq 0 ]; then echo "ok $1"; else
        echo "not ok $1"
        cat log
    fi
}
number() { # number FILE.json KEY
    sed -n "s/.*\"$2\": \([0-9]*\).*/\1/p" "$1"
}
stl() { # stl FILE: what usd_check.py measures, of an STL file
    "$python" - "$1" <<'END'
import sys
import numpy
record = numpy.dtype([("normal", "<3f4"), ("corner", "<9f4"), ("zero", "<u2")])
t = numpy.fromfile(sys.argv[1], record, offset=84)["corner"].reshape(-1, 3, 3).astype(float)
a, b, c = t[:, 0], t[:, 1], t[:, 2]
area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2
volume = (a * numpy.cross(b, c)).sum() / 6
low, high = (",".join(str(x) for x in f(t.reshape(-1, 3), 0)) for f in (numpy.min, numpy.max))
print(f"seen_triangles={len(t)} area={area}~2e-3 volume={volume}~2e-3 low={low}~1e-3 high={high}~1e-3")
END
}

# Bodies of every material, a quad and a ball as lamps, a sky of one colour; a camera with a lens and a shift.
sed -e 's/^camera: {/camera: {aperture: 0.02, focus_distance: 6.5, shift: [0.1, -0.25], /' \
    "$tests/golden/materials.yaml" >bodies.yaml
"$RAMIFY" export -q bodies.yaml -o bodies.usda >log 2>&1 && "$RAMIFY" export -q bodies.yaml -o bodies.stl >>log 2>&1 &&
    "$python" "$check" bodies.usda $(stl bodies.stl) meshes=7 instances=0 segments=0 >>log 2>&1
result usd_bodies_are_the_same_as_in_stl
"$python" "$check" bodies.usda fov=17~1e-5 aspect=2.6666667~1e-5 eye=0,1.5,7~1e-6 view=0,-0.1483404,-0.9889364~1e-5 \
    shift=0.1,-0.25~1e-5 focus=6.5~1e-6 lens=0.02~1e-6 >log 2>&1
result usd_camera_is_that_of_the_scene
"$python" "$check" bodies.usda Lamp_0=7,6.6,6~1e-6 Lamp_0.at=-1.25,3.5,0.75~1e-6 Lamp_0.shines=0,-0.9284767,0.3713907~1e-6 \
    Lamp_0.area=4.0388736~1e-6 Lamp_1=14,17,22~1e-6 Lamp_1.at=2.2,2.4,2~1e-6 Lamp_1.radius=0.3~1e-6 \
    Sky=0.09,0.1,0.13~1e-6 Sky.pictures=0 >log 2>&1
result usd_lights_are_those_of_the_scene

# A tree in leaf, grass: instances, curves, patterns; sun and sky.
cp "$tests/golden/leafy_tree.yaml" leafy.yaml
"$RAMIFY" export -q leafy.yaml -o leafy.usda >log 2>&1 && "$RAMIFY" export -q leafy.yaml -o leafy.stl >>log 2>&1 &&
    "$RAMIFY" render -q leafy.yaml --samples 1 --json -o leafy.png >json 2>>log &&
    "$python" "$check" leafy.usda triangles="$(number json triangles)" segments="$(number json curve_segments)" \
        instances="$(number json instances)" $(stl leafy.stl | grep -o '[a-z]*=[^ ]*~1e-3' | tr '\n' ' ') inward=0~20 >>log 2>&1
result usd_instances_and_curves_are_all_there
"$python" "$check" leafy.usda Sun.shines=-0.6791078,-0.5591929,-0.4755164~1e-5 Sun.angle=2~1e-4 Sky.pictures=1 Sky=1,1,1 \
    >log 2>&1
result usd_sun_and_sky_are_those_of_the_scene

"$RAMIFY" export -q leafy.yaml --object tree --colors none -o plain.usda >log 2>&1 &&
    "$python" "$check" plain.usda meshes=5 >>log 2>&1 && ! grep -q UsdPrimvarReader_float3 plain.usda &&
    grep -q UsdPrimvarReader_float3 leafy.usda
result usd_colours_of_patterns_can_be_left_out

# A texture, a cut-out, and names that USD does not take; the textures in another folder, an environment.
mkdir pictures out
cp "$tests/golden/bodies.png" "pictures/a b.png"
cp "$tests/golden/sky.hdr" pictures/sky.hdr
cat >names.yaml <<'END'
camera: {position: [0, 1, 5], target: [0, 1, 0]}
sky: {kind: environment, file: pictures/sky.hdr, rotation: 30, strength: 2}
materials:
  - {name: coat_a_2, kind: diffuse}
  - {name: coat-a, kind: principled, texture: "pictures/a b.png", alpha_texture: "pictures/a b.png", metallic: 0.5}
  - {name: coat a, kind: diffuse}
objects:
  - {name: Materials, material: coat-a, shape: {envelope: [{shape: sphere, size: 1}]}}
  - {name: box 1, material: coat a, shape: {envelope: [{shape: box, size: [1, 1, 1]}]}}
  - {name: box 2, material: coat_a_2, shape: {envelope: [{shape: box, size: [1, 1, 1]}]}}
  - {name: box-1, material: coat a, shape: {envelope: [{shape: box, size: [1, 1, 1]}]}}
END
"$RAMIFY" export -q names.yaml -o out/names.usda >log 2>&1 &&
    "$python" "$check" out/names.usda meshes=4 Sky=2,2,2 Sky.pictures=1 >>log 2>&1 &&
    [ "$(grep -c 'def Material' out/names.usda)" -eq "$(grep 'def Material' out/names.usda | sort -u | wc -l)" ]
result usd_names_and_textures_resolve

cp out/names.usda before
echo "no picture" >pictures/broken.png
"$RAMIFY" export -q names.yaml --set 'materials.coat-a.alpha_texture=pictures/broken.png' -o out/names.usda >log 2>&1
[ $? -eq 2 ] && grep -q broken.png log && cmp -s before out/names.usda && [ "$(ls -A out)" = names.usda ]
result usd_a_failure_leaves_the_old_file
"$RAMIFY" export -q names.yaml -o x.usd >log 2>&1
[ $? -eq 2 ] && grep -q '\.usda' log && [ ! -e x.usd ]
result usd_the_binary_format_is_refused
