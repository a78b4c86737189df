#!/bin/sh
# What a scene takes in memory is told beforehand, and refused where it cannot be. RAMIFY names the binary.
set -u
RAMIFY=${RAMIFY:-build/ramify}
RAMIFY=$(realpath "$RAMIFY")
checks=$(realpath "$(dirname "$0")/checks.sh")
neuron=$(realpath "$(dirname "$0")/../../scenes/neuron.swc")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
. "$checks"

scene() { # scene NAME OBJECT: a small picture of one object
    printf 'film: {width: 48, height: 32}\nrender: {samples: 1, max_depth: 2}\nsky: {kind: constant}\nobjects:\n  - name: a\n    %s\n' "$2" >"$1.yaml"
}

bytes() { # the number under "memory" in what the last command wrote
    sed -n 's/.*"memory": \([0-9]*\).*/\1/p' out
}

tells() { # tells NAME OBJECT [PERCENT]: `info` is right within a factor of 3, or of so many percent
    percent=${3:-300}
    scene "$1" "$2"
    check "$1_info" 0 "$RAMIFY" info "$1.yaml" --json
    told=$(bytes)
    check "$1_render" 0 "$RAMIFY" render "$1.yaml" -o "$1.png" -q --json
    taken=$(bytes)
    yes "$1_told_${told}_took_$taken" [ "$((100 * told))" -lt $((percent * taken)) -a "$((100 * taken))" -lt $((percent * told)) ]
}

refuses() { # refuses NAME KEY OBJECT: before anything is made, by name and line
    scene "$1" "$3"
    check "$1" 2 timeout 60 "$RAMIFY" render "$1.yaml" -o "$1.png" -q
    says "$1_place" err "$1.yaml:6:"
    says "$1_key" err "$2 needs about"
}

# AddressSanitizer takes memory of its own, and reserves more address space than any limit here leaves.
sanitized=no
nm "$RAMIFY" 2>/dev/null | grep -q __asan_init && sanitized=yes
if [ "$sanitized" = no ]; then
    tells grass 'ground: {grass_tufts: 150000}'
    tells leaves 'tree: {leaves: {max_count: 100000}}'
    tells sides 'frost: {sides: 120000}'
    tells particles 'dla: {particles: 2000}'
    tells grains 'frost: {sides: 1000, grains: 400000}'
    tells skeleton "skeleton: {file: $neuron, scale: 0.01, skin: {levels: 1}}" 160
    tells twigs 'tree: {crown: {growth: {levels: [{attractors: 4000}]}}, roots: {count: 0}, leaves: {max_count: 0}, radii: {tip: 0.004}, skin: {curve_radius: 0.006}}' 160
    tells rules 'lsystem: {height: 11.5, generations: 6, leaves: {max_count: 0}}'
    tells drawn 'lsystem: {height: 0.52, axiom: X, rules: "X -> [+FX][-FX]FX", generations: 5, elasticity: 0, radii: {exponent: 4, tip: 0.0016}, leaves: {max_count: 0}, skin: {curve_radius: 0}}' 130
    tells fan 'coral: {form: fan, levels: 3}' 130
    tells surface 'shape: {voxel: 0.007, envelope: [{shape: sphere}, {shape: sphere, position: [0.7, 0, 0]}]}' 160
    check surface_export 0 "$RAMIFY" export surface.yaml -o surface.stl -q
    tells mesh 'mesh: {file: surface.stl}' 160
fi
refuses tufts grass_tufts 'ground: {grass_tufts: 1000000000}'
refuses fallen fallen_leaves 'ground: {fallen_leaves: 1000000000}'
refuses many_sides sides 'frost: {sides: 2147483647}'
refuses many_terminals attractors 'coral: {attractors: 100000000}'
refuses trunk trunk.growth.levels 'tree: {grown_by: attractors, trunk: {growth: {levels: [{attractors: 2147483647}]}}}'
refuses wide radius 'forest: {radius: 100000, spacing: 0.01}'
refuses aggregate particles 'dla: {particles: 2147483647}'
if [ "$sanitized" = no ]; then
    scene small 'ground: {grass_tufts: 60000000}'
    check limit_of_address_space 2 sh -c "ulimit -v 2000000; exec '$RAMIFY' render small.yaml -o small.png -q"
    says limit_is_told err '2.0 GB are available'
    # Libraries allocate before main(), and those of plug-ins when they are loaded. The least limit under which the system's
    # loader maps the first suffices to start, and leaves no room for the others: an error, not an abort.
    limit=50000 status=127
    while [ "$status" -eq 127 ] && [ "$limit" -lt 1500000 ]; do
        limit=$((limit + 1000))
        sh -c "ulimit -v $limit; exec '$RAMIFY' --version" >/dev/null 2>&1
        status=$?
    done
    # With hardly more, the initializer of a library aborts before main() is called.
    [ "$status" -ne 134 ] || limit=$((limit + 1000))
    check start_in_little_memory 0 sh -c "ulimit -v $limit; exec '$RAMIFY' --version"
    scene little 'shape: {envelope: [{shape: sphere}]}'
    for limit in 200000 350000 400000 450000 500000; do
        check "render_in_$limit" 1 sh -c "ulimit -v $limit; exec '$RAMIFY' render little.yaml -o little.png -q"
        says "render_in_${limit}_says" err 'more to start'
    done
fi
