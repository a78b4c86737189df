#!/bin/sh
# What POV-Ray makes of our export: the same pixels covered, the same light, in every scene of tests/cross at small size.
# RAMIFY names the binary. Prints "ok NAME", "not ok NAME" or "skipped NAME: why" for each case. `make cross-check` is all of it.
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
COMPARE=${COMPARE:-$(dirname "$RAMIFY")/tests/cross/compare}
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
export RAMIFY COMPARE

result() { # result NAME: by the status of the command before
    if [ $? -eq 0 ]; then echo "ok $1"; else
        echo "not ok $1"
        grep -E '^ramify|Parse|Fatal error|coverage' "$folder/log"
    fi
}

for name in lamps tree twigs picture haze glass glow sky coral stand terrain; do
    case $name in        # as small as the limits still hold
    picture) shrink=1 ;; # small texels would need more rays
    tree) shrink=3 ;;
    twigs | glass | coral | sky | terrain) shrink=4 ;;
    *) shrink=2 ;;
    esac
    export CROSS_SHRINK=$shrink
    if command -v povray >/dev/null; then
        "$here/run" "$folder" "$here/$name.yaml" >"$folder/log" 2>&1
        result "POV-Ray covers the same pixels with the same light: $name"
    else
        echo "skipped $name: povray is not installed"
    fi
done

# Every kind of material, sky and medium is something that POV-Ray understands, without a warning.
cat >"$folder/night.yaml" <<'END_OF_SCENE'
camera: {position: [0, 1, 5], target: [0, 0.5, 0], aperture: 0.05}
sky: {kind: night, moon: 1, haze_distance: 100}
medium: {kind: layer, scattering: 0.01, height: 1, falloff: 2}
materials:
  - {name: soap, kind: thin_film}
  - {name: milk, kind: dielectric, ior: 1.3, scattering: [4, 5, 6], absorption: [1, 0, 0]}
  - {name: lamp, kind: emission, radiance: [3, 2, 1]}
objects:
  - {name: bubble, material: soap, shape: {envelope: [{shape: sphere, size: 0.4, position: [-1, 0.5, 0]}]}}
  - {name: drop, material: milk, shape: {envelope: [{shape: sphere, size: 0.4, position: [0, 0.5, 0]}]}}
  - {name: light, material: lamp, shape: {envelope: [{shape: sphere, size: 0.4, position: [1, 0.5, 0]}]}}
END_OF_SCENE
for scene in "$folder/night.yaml" "$here"/../golden/bodies.yaml "$here"/../golden/environment.yaml \
    "$here"/../golden/glow_in_fog.yaml "$here"/../golden/materials.yaml "$here"/../golden/underwater.yaml; do
    name=$(basename "$scene" .yaml)
    if command -v povray >/dev/null; then
        "$RAMIFY" export "$scene" -q -o "$folder/$name.pov" 2>"$folder/log" && (cd "$folder" &&
            povray +I"$name.pov" +O"$name.png" +W8 +H6 -A -D -V Declare=Radiosity=0 >log 2>&1) &&
            [ -s "$folder/$name.png" ] && ! grep -E 'Parse (Warning: [^T]|Error)|^Fatal error' "$folder/log"
        result "POV-Ray understands $name"
    else
        echo "skipped $name: povray is not installed"
    fi
done

cd "$folder" || exit 1
# A sky needs a picture; a file in the way of its folder must leave the old scene alone.
cat >day.yaml <<'END_OF_SCENE'
sky: {kind: sun_sky}
objects: [{name: ball, shape: {envelope: [{shape: sphere, size: 1}]}}]
END_OF_SCENE
echo old >day.pov
echo file >day-textures
"$RAMIFY" export day.yaml -q -o day.pov 2>log
[ $? -eq 1 ] && [ "$(cat day.pov)" = old ] && grep -q "^ramify: 'day-textures" log && [ "$(ls -A | grep -c part)" -eq 0 ]
result "a picture that cannot be written leaves the old scene alone"
rm day-textures
"$RAMIFY" export day.yaml -q -o day.pov 2>log && [ -s day-textures/sky.exr ] && mkdir elsewhere &&
    mv day.pov day-textures elsewhere && cd elsewhere && "$RAMIFY" export ../day.yaml -q --threads 1 -o again.pov 2>../log &&
    sed 's/again/day/g' again.pov | cmp -s - day.pov && cmp -s again-textures/sky.exr day-textures/sky.exr
result "the same scene gives the same bytes for any number of threads"
cd "$folder" || exit 1

# Light of the sky in leaves must stay affordable: rays that radiosity shoots a pixel, which no clock has to measure.
if command -v povray >/dev/null; then
    "$RAMIFY" export "$here/sky.yaml" -q -o leaves.pov 2>log &&
        povray +Ileaves.pov +Oleaves.png +W48 +H48 -A -D +WT1 >log 2>&1
    rays=$(tr '\r' '\n' <log | sed -n 's/^Radiosity sample rays shot: *\([0-9]*\)$/\1/p')
    [ "${rays:-0}" -gt 0 ] && [ "$rays" -lt $((30 * 48 * 48)) ]
    result "radiosity takes few rays a pixel in leaves"
else
    echo "skipped radiosity: povray is not installed"
fi
