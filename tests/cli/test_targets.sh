#!/bin/sh
# Every scene of scenes/ that states targets is grown and measured and must meet them, and the command that says so
# does say so. A scene or a species whose growth takes long names lighter keys in a line "# small: path=value path=value".
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
out=$folder/out

# measures NAME STATUS ARGUMENT...: runs ramify measure, wants this exit status. By one thread: other tests have the rest of
# the processors, and several threads would wait for each other in the small grids of landscapes.
measures() {
    name=$1 wanted=$2
    shift 2
    "$RAMIFY" measure --threads 1 "$@" >"$out" 2>&1
    status=$?
    if [ "$status" -eq "$wanted" ]; then echo "ok $name"; else
        echo "not ok $name"
        echo "   exit status $status, not $wanted: ramify measure --threads 1 $*"
        cat "$out"
    fi
}
says() {
    if grep -qF -- "$2" "$out"; then echo "ok $1"; else
        echo "not ok $1"
        echo "   no '$2' in:"
        cat "$out"
    fi
}

for scene in scenes/*.yaml; do
    grep -q '^targets:' "$scene" || continue
    set --
    for change in $(sed -n 's/^# small: //p' "$scene"); do set -- "$@" --set "$change"; done
    name=$(basename "$scene" .yaml)
    measures "targets_of_$name" 0 "$scene" --targets --quiet "$@"
done

# So does every species of the library, as it stands alone.
for species in scenes/species/*.yaml; do
    name=$(basename "$species" .yaml)
    set --
    for change in $(sed -n 's/^# small: //p' "$species"); do set -- "$@" --set "objects.plant.$change"; done
    if grep -q '^climber:' "$species"; then
        plant="climber: {species: $name, climbs: wall, starts: [{position: [0, 0, 0.2]}]}}"
        plant="$plant, {name: wall, shape: {voxel: 0.1, envelope: [{shape: box, size: [5, 5, 0.2], position: [0, 5, 0]}]}"
    else
        plant="tree: {species: $name}"
    fi
    echo "objects: [{name: plant, $plant}]" >"$folder/species.yaml"
    measures "targets_of_species_$name" 0 "$folder/species.yaml" --quiet "$@"
done

cat >"$folder/bush.yaml" <<'END'
objects:
  - name: bush
    tree:
      height: 3
      crown: {lobes: 0, growth: {levels: [{attractors: 20, step: 0.1, kill: 0.4, influence: 4}, {attractors: 100}]}}
  - {name: floor, ground: {grass_tufts: 0}}
targets:
  - {object: bush, measure: height, low: 2, high: 4}
  - {object: bush, measure: terminals, low: 10}
END
measures met 0 "$folder/bush.yaml"
says met_targets "met"
measures missed 1 "$folder/bush.yaml" --set targets.1.low=1e6
says missed_target "MISSED"
says missed_message "1 of 2 targets missed"
measures unknown_measure 2 "$folder/bush.yaml" --set targets.0.measure=heigth
says unknown_measure_hint "did you mean 'height'?"
measures unknown_object 2 "$folder/bush.yaml" --set targets.0.object=bosh
says unknown_object_hint "did you mean 'bush'?"
measures not_of_this_kind 2 "$folder/bush.yaml" --set targets.0.object=floor --set targets.0.measure=terminals
measures targets_alone 0 "$folder/bush.yaml" --targets
if grep -q '^bush (tree)' "$out" && ! grep -q '^floor' "$out" && grep -q '^  bush height .*: met' "$out"; then
    echo "ok only_objects_with_targets"
else
    echo "not ok only_objects_with_targets"
    cat "$out"
fi
printf 'objects: [{name: floor, ground: {grass_tufts: 0}}]\n' >"$folder/floor.yaml"
measures no_targets 2 "$folder/floor.yaml" --targets
says no_targets_hint "the scene states no targets"
measures ground_too 0 "$folder/bush.yaml"
says ground_has_a_header "floor (ground)"
matches_line() { if grep -qE "$2" "$out"; then echo "ok $1"; else echo "not ok $1"; cat "$out"; fi; }
matches_line ground_triangles '^  triangles +[1-9]'
matches_line ground_extent '^  width +[1-9][0-9]* m'
for body in 'mesh: {file: one.obj}' 'shape: {envelope: [{shape: sphere}]}'; do
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$folder/one.obj"
    printf 'objects: [{name: x, %s}]\n' "$body" >"$folder/body.yaml"
    measures "body_${body%%:*}" 0 "$folder/body.yaml"
    matches_line "triangles_of_${body%%:*}" '^  triangles +[1-9]'
done
measures bounds_the_wrong_way_round 2 "$folder/bush.yaml" --set targets.0.low=5
measures as_json 0 "$folder/bush.yaml" --json --quiet
says json_value '"terminals": {"value": '
says json_target '"measure": "height", "value": '
"$RAMIFY" grow "$folder/bush.yaml" -q -o "$folder/bush.swc" || echo "not ok write_swc"
grep '"terminals": ' "$out" >"$folder/before"
measures a_file 0 "$folder/bush.swc" --json
grep '"terminals": ' "$out" >"$folder/after"
if cmp -s "$folder/before" "$folder/after"; then echo "ok file_measures_the_same"; else echo "not ok file_measures_the_same"; fi
measures half_grown 0 "$folder/bush.yaml" --grow-to 0.5 --set targets.1.low=0 --set targets.0.low=0
measures grow_to_beyond 2 "$folder/bush.yaml" --grow-to 1.5
