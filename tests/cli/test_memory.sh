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

foretells() { # foretells NAME PERCENT: `info` of NAME.yaml is right within so many percent
    check "$1_info" 0 "$RAMIFY" info "$1.yaml" --json
    told=$(bytes)
    check "$1_render" 0 "$RAMIFY" render "$1.yaml" -o "$1.png" -q --json
    taken=$(bytes)
    yes "$1_told_${told}_took_$taken" [ "$((100 * told))" -lt $(($2 * taken)) -a "$((100 * taken))" -lt $(($2 * told)) ]
}

tells() { # tells NAME OBJECT [PERCENT]: of a scene with this object; by default within a factor of 3
    scene "$1" "$2"
    foretells "$1" "${3:-300}"
}

estimates() { # estimates NAME OBJECT [OPTION...]: `info --estimate` is right within 1.3, in memory and number of paths
    file=$1
    scene "$file" "$2"
    shift 2
    check "${file}_estimate" 0 "$RAMIFY" info "$file.yaml" --estimate -q --json "$@"
    told=$(sed -n 's/.*"estimate": {"memory": \([0-9]*\).*/\1/p' out) paths=$(grep -o '"paths": [0-9]*' out)
    check "${file}_picture" 0 "$RAMIFY" render "$file.yaml" -o "$file.png" -q --json "$@"
    taken=$(bytes)
    yes "${file}_estimate_${told}_took_$taken" [ "$((100 * told))" -lt $((130 * taken)) -a "$((100 * taken))" -lt $((130 * told)) ]
    says "${file}_paths" out "$paths"
}

limits() { # limits NAME KEY LIMIT OBJECT: refuses before anything is made; the value that it names will do
    scene "$1" "$4"
    echo old >"$1.png"
    check "$1_limit" 2 timeout 60 "$RAMIFY" render "$1.yaml" -o "$1.png" -q --memory "$3"
    matches "$1_limit_place" err "^$1.yaml:6:.* GB of memory are needed, but .* allowed; $2 of object 'a' takes"
    value=$(sed -n 's/.*set it to \([0-9.]*\).*/\1/p' err)
    yes "$1_limit_keeps_files" [ "$(cat "$1.png")" = old -a ! -e "$1.exr" ]
    check "$1_fits" 0 "$RAMIFY" info "$1.yaml" --memory "$3" --set "objects.a.${4%%:*}.$2=$value"
    check "$1_turntable" 2 timeout 60 "$RAMIFY" turntable "$1.yaml" -o "$1-%03d.png" -q --memory "$3"
    yes "$1_turntable_makes_nothing" [ ! -e "$1-000.png" ]
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
    tells sides 'frost: {sides: 60000}'
    tells particles 'dla: {particles: 1000}'
    tells grains 'frost: {sides: 1000, grains: 150000}'
    tells skeleton "skeleton: {file: $neuron, scale: 0.01, skin: {levels: 1}}" 160
    tells twigs 'tree: {crown: {growth: {levels: [{attractors: 4000}]}}, roots: {count: 0}, leaves: {max_count: 0}, radii: {tip: 0.004}, skin: {curve_radius: 0.006}}' 160
    tells rules 'lsystem: {height: 11.5, generations: 6, leaves: {max_count: 0}}'
    tells drawn 'lsystem: {height: 0.52, axiom: X, rules: "X -> [+FX][-FX]FX", generations: 5, elasticity: 0, radii: {exponent: 4, tip: 0.0016}, leaves: {max_count: 0}, skin: {curve_radius: 0}}' 130
    tells fan 'coral: {form: fan, levels: 3}' 130
    tells surface 'shape: {voxel: 0.01, envelope: [{shape: sphere}, {shape: sphere, position: [0.7, 0, 0]}]}' 130
    check surface_export 0 "$RAMIFY" export surface.yaml -o surface.stl -q
    tells mesh 'mesh: {file: surface.stl}' 130
    # What reads pictures takes more than all the rest of so small a scene.
    scene pictured 'shape: {envelope: [{shape: sphere}]}'
    sed -i 's/sky: .*/sky: {kind: environment, file: mesh.png}/' pictured.yaml
    foretells pictured 130
    estimates many 'ground: {grass_tufts: 150000}'
    estimates large 'shape: {envelope: [{shape: sphere}]}' --size 720x480 --samples 2
    estimates quarter 'tree: {leaves: {max_count: 50000}}' --size 640x400 --crop 0,0,0.5,0.5 --samples 4
    # What counts do not rule out is refused once it is built, before the first path.
    scene built 'ground: {grass_tufts: 150000}'
    check built_limit 2 "$RAMIFY" render built.yaml -o built.png -q --memory 150M
    matches built_limit_key err "^built.yaml:6:.*grass_tufts of object 'a'"
    yes built_limit_makes_nothing [ ! -e built.png -a ! -e built.exr ]
    check built_estimate 2 "$RAMIFY" info built.yaml --estimate -q --memory 150M
fi
limits stalks grass_tufts 2G 'ground: {grass_tufts: 100000000}'
limits edges sides 1.5G 'frost: {sides: 20000000}'
limits crowd leaves.max_count 550M 'tree: {leaves: {max_count: 100000000}, grown_by: attractors, crown: {growth: {levels: [{attractors: 300000}]}}, radii: {tip: 0.004}, skin: {curve_radius: 0.05}}'
scene poster 'ground: {}'
check picture_limit 2 "$RAMIFY" info poster.yaml --size 10000x9000 --memory 3G
says picture_limit_size err 'set film.width and film.height to'
check picture_limit_tiny 2 "$RAMIFY" info poster.yaml --size 10000x9000 --memory 10M
says picture_limit_least err 'no scene takes less than'
for size in 0 8X G -1 2e16 '8 GB'; do
    check "bad_size_$size" 2 "$RAMIFY" info poster.yaml --memory "$size"
    says "bad_size_${size}_says" err "--memory $size; it must be a number of bytes, as in 512M or 8G"
done
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
