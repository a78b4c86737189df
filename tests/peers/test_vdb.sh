#!/bin/sh
# OpenVDB grids read by Blender (`make peers` installs it). RAMIFY names the binary. Prints "ok NAME", "not ok NAME" or
# "skipped NAME: why".
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

result() { # result NAME: by the status of the command before
    if [ $? -eq 0 ]; then echo "ok $1"; else
        echo "not ok $1"
        cat log
    fi
}

cat >scene.yaml <<'END'
clouds: [{kind: stratus, size: 1000, thickness: 60}]
objects:
  - name: oak
    tree:
      height: 3
      grown_by: attractors
      crown: {fields: [{kind: vortex, vector: [0, 1, 0]}], growth: {field_weight: 0.4}}
      leaves: {max_count: 0}
  - {name: rock, shape: {envelope: [{shape: sphere, size: 1}]}}
END
"$RAMIFY" export -q scene.yaml -o scene.vdb >log 2>&1 && "$RAMIFY" export -q scene.yaml --threads 1 -o again.vdb >>log 2>&1 &&
    cmp scene.vdb again.vdb >>log 2>&1
result vdb_is_the_same_for_any_number_of_threads
"$RAMIFY" export -q scene.yaml --object rock -o rock.vdb >log 2>&1
[ $? -eq 2 ] && grep -q envelope log && [ ! -e rock.vdb ]
result vdb_of_what_does_not_grow_is_refused

if ! command -v blender >/dev/null; then
    echo "skipped vdb_blender: blender is not installed"
    exit 0
fi
cat >look.py <<'END'
import os

import bpy
volume = bpy.data.volumes.new("volume")
volume.filepath = os.path.abspath("scene.vdb")
loaded = volume.grids.load()
print("GRIDS", loaded, sorted((grid.name, grid.data_type) for grid in volume.grids))
END
blender -b --factory-startup -P look.py >log 2>&1
grep -qF "GRIDS True [('clouds/0/density', 'FLOAT'), ('oak/crown/envelope', 'FLOAT'), ('oak/crown/field', 'VECTOR_FLOAT'), ('oak/roots/envelope', 'FLOAT'), \
('oak/trunk/envelope', 'FLOAT')]" log
result vdb_blender_reads_all_grids
