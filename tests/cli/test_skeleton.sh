#!/bin/sh
# SWC files of other programs through the command line: measured, grown, drawn, written again.
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

result() { # result NAME: by the status of the command before
    if [ $? -eq 0 ]; then echo "ok $1"; else
        echo "not ok $1"
        cat err
    fi
}

# The habits of such files in one: line ends of DOS, comments, blanks, a child before its parent, gaps in the numbers, a soma
# of three points, every type, micrometres.
printf '%s\r\n' "# ORIGINAL_SOURCE Neurolucida" "#" "# SCALE 1.0 1.0 1.0" "# \"soma\"" "" \
    "1 1 100 200 300 6 -1" "2 1 100 206 300 6 1" "3 1 100 194 300 6 1" " 50 4 101.5 260 3.0e2 1.5 40" \
    "40 4 100 207 300 2 1" "	6 4 90 320 300 1 50 " "7 4 115 320 300 1 50" "8 3 92 198 300 1 1" "9 3 40 180 310 .7 8" \
    "10 3 108 198 300 1 1" "11 3 170 180 290 0.7 10" "12 2 100 193 300 0.5 1" "13 2 104 100 300 0.4 12" >cell.swc
cat >cell.yaml <<'END_OF_SCENE'
camera: {position: [0, 0, 6], target: [0, 0, 0], fov: 30}
film: {width: 40, height: 40}
render: {samples: 4, max_depth: 2}
sky: {kind: constant, color: 1}
objects:
  - {name: cell, skeleton: {file: cell.swc, scale: 0.01, origin: middle}}
END_OF_SCENE

"$RAMIFY" measure cell.swc >out 2>err && grep -q '^ *terminals  *7$' out
result file_is_measured
"$RAMIFY" render cell.yaml -q -o cell.png 2>err && [ -s cell.png ]
result file_is_drawn
"$RAMIFY" measure cell.yaml -q >out 2>err && grep -q '^ *terminals  *5$' out # without those of the soma
result object_is_measured
"$RAMIFY" grow cell.yaml -q -o once.swc 2>err && [ "$(awk '$2 == 2' once.swc | wc -l)" -eq 2 ] &&
    [ "$(awk '$2 == 3' once.swc | wc -l)" -eq 4 ] && [ "$(awk '$2 == 4' once.swc | wc -l)" -eq 4 ]
result types_are_kept
sed 's/cell.swc, scale: 0.01, origin: middle/once.swc, soma: as_is/' cell.yaml >once.yaml
"$RAMIFY" grow once.yaml -q -o twice.swc 2>err && cmp once.swc twice.swc 2>>err
result round_trip_changes_nothing
"$RAMIFY" grow cell.yaml --grow-to 0.4 -q -o half.swc 2>err && [ "$(wc -l <half.swc)" -lt "$(wc -l <once.swc)" ]
result growth_is_cut
"$RAMIFY" export cell.yaml -q -o cell.stl 2>err && [ -s cell.stl ]
result file_is_exported
"$RAMIFY" grow cell.yaml -q -o a.json 2>err && "$RAMIFY" grow cell.yaml -q --threads 1 -o b.json 2>>err && cmp a.json b.json
result threads_change_nothing

echo "14 3 0 0 0 1 99" >>cell.swc
"$RAMIFY" render cell.yaml -o new.png 2>err
[ $? -eq 2 ] && grep -qF "cell.swc:19" err && grep -qF "parent 99 is no node" err && [ ! -e new.png ]
result broken_file_is_refused_with_its_line
rm cell.swc
"$RAMIFY" render cell.yaml -o new.png 2>err
[ $? -eq 2 ] && grep -qF "cell.yaml:6:" err && grep -qF "cell.swc" err
result absent_file_is_refused
