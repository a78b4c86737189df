#!/bin/sh
# Plug-ins are loaded when first used, and a missing one is an error that names it. RAMIFY names the binary, beside which
# they lie. Prints "ok NAME" or "not ok NAME" for each case.
. "$(dirname "$0")/checks.sh"
RAMIFY=$(realpath "${RAMIFY:-build/ramify}")
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
cat >ball.yaml <<'END'
film: {width: 32, height: 24}
render: {samples: 1, max_depth: 2}
sky: {kind: constant, color: 1}
objects:
  - {name: ball, shape: {envelope: [{shape: sphere}]}}
END
sed 's/{shape: sphere}/{shape: sphere}, {shape: sphere, position: [0.5, 0, 0]}/' ball.yaml >two.yaml

# loads NAME PLUGINS COMMAND...: the command succeeds and has loaded just these plug-ins, in alphabetical order. The loader's
# notes go to standard error: a file of its own may have the number of a descriptor that a confined child takes for its result.
loads() {
    name=$1 plugins=$2
    shift 2
    if LD_DEBUG=files "$@" >out 2>err; then
        found=$(sed -n 's|.*calling init: .*/ramify-\([a-z]*\)\.so$|\1|p' err | sort -u | xargs)
        large=$(grep -c 'calling init: .*/lib\(OpenImageIO\|openvdb\|OpenColorIO\)\.so' err)
        [ "${plugins%write}" ] && large=0
        if [ "$found" = "$plugins" ] && [ "$large" -eq 0 ]; then echo "ok $name"; else
            echo "not ok $name: loaded '$found', not '$plugins', and $large large libraries"
        fi
    else
        echo "not ok $name: the command failed"
        grep '^ramify' err
    fi
}
loads version_loads_none '' "$RAMIFY" --version
loads help_loads_none '' "$RAMIFY" help render
loads schema_loads_none '' "$RAMIFY" schema
loads info_loads_none '' "$RAMIFY" info ball.yaml
loads mesh_of_a_ball_loads_none '' "$RAMIFY" export ball.yaml -q -o ball.stl
loads union_of_balls_loads_openvdb vdb "$RAMIFY" export two.yaml -q -o two.stl
for name in ball.png ball.jpg ball.exr; do
    loads "${name#*.}_loads_no_large_library" write "$RAMIFY" render ball.yaml -q -o "$name"
done
loads picture_read_loads_openimageio oiio "$RAMIFY" compare ball.png ball.png
loads picture_of_a_union_loads_both 'vdb write' "$RAMIFY" render two.yaml -q -o two.png

cat >views.ocio <<'END'
ocio_profile_version: 2
environment: {}
roles: {default: linear, scene_linear: linear}
displays: {Screen: [!<View> {name: Plain, colorspace: linear}]}
colorspaces: [!<ColorSpace> {name: linear}]
END
loads view_of_a_configuration_loads_opencolorio 'ocio write' "$RAMIFY" render ball.yaml -q -o view.png \
    --set film.color.config=views.ocio

cat >survey.yaml <<'END'
objects:
  - name: land
    terrain: {form: survey, size: 60, resolution: 16, survey: {file: land.asc}, forest: {count: 0}}
END
printf 'ncols 5\nnrows 5\nxllcorner 1000\nyllcorner 1000\ncellsize 20\n' >land.asc
seq 25 >>land.asc
loads survey_loads_gdal gdal "$RAMIFY" export survey.yaml -q -o survey.stl

# A copy of the program alone finds none.
cp "$RAMIFY" alone
check alone_starts 0 ./alone --version
check alone_exports 0 ./alone export ball.yaml -q -o alone.stl
yes alone_exports_the_same cmp alone.stl ball.stl
check alone_renders_nothing 2 ./alone render ball.yaml -q -o alone.png
says alone_names_the_file err 'ramify-write.so must lie beside the program'
yes alone_writes_nothing [ ! -e alone.png ]
check alone_makes_no_union 2 ./alone export two.yaml -q -o alone2.stl
says alone_names_the_object err "object 'ball'"
says alone_names_the_other_file err 'ramify-vdb.so must lie beside the program'
check alone_makes_no_film 2 ./alone turntable ball.yaml -q --frames 2 -o 'alone-%d.png'
says alone_names_it_before_the_film err 'ramify-write.so'

# Nor one whose plug-in comes from another build.
printf 'const unsigned long image_writer_write = 1;\n' | "${CC:-cc}" -shared -fPIC -x c - -o ramify-write.so
check other_build 2 ./alone render ball.yaml -q -o alone.png
says other_build_says err 'ramify-write.so belongs to another build'
