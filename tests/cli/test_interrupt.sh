#!/bin/sh
# Ctrl-C in every stage of rendering: the program ends soon and says so. RAMIFY names the binary.
# The bound on time is generous: without the checks in loops these scenes went on for minutes.
set -u
RAMIFY=${RAMIFY:-build/ramify}
RAMIFY=$(realpath "$RAMIFY")
checks=$(realpath "$(dirname "$0")/checks.sh")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
. "$checks"

caught() { # has the program begun to listen for SIGINT (bit 2 of the mask)?
    mask=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$1/status" 2>/dev/null)
    [ -z "$mask" ] || [ $((0x${mask#????????????} & 2)) -ne 0 ]
}

interrupt() { # interrupt NAME SECONDS OBJECT: Ctrl-C so long after it listens
    printf 'film: {width: 3000, height: 2000}\nrender: {samples: 4}\nobjects: [{name: a, %s}]\n' "$3" >"$1.yaml"
    "$RAMIFY" render "$1.yaml" -o "$1.png" -q 2>err &
    process=$!
    while ! caught $process; do sleep 0.1; done
    sleep "$2"
    kill -INT $process 2>/dev/null
    (sleep 60 && kill -KILL $process) 2>/dev/null &
    watch=$!
    wait $process
    status=$?
    kill $watch 2>/dev/null
    yes "$1" [ $status -eq 130 ]
    says "$1_says_so" err interrupted
}

interrupt places 1 'forest: {radius: 100000, height: 0.001, stands: 1, stand_trees: 1, density: 0.00000000000001}'
interrupt field 1 'tree: {crown: {fields: [{kind: grid, resolution: 1024}]}}'
interrupt cracks 1 'fracture: {impacts: 10000}'
interrupt veins 1 'venation: {detail: 2000}'
interrupt roots 4 'frost: {nuclei: 100000, spines: 1000000}'
interrupt first_pass 2 'shape: {envelope: [{shape: sphere, size: [1, 1, 1]}]}'
