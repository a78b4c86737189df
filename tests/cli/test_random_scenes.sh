#!/bin/sh
# Some random scenes, drawn from the schema of scene files (make random-scenes renders a thousand): each gives a picture,
# the same for any number of threads, or one error that names its place. RAMIFY names the binary.
RAMIFY=${RAMIFY:-build/ramify}
command -v python3 >/dev/null || { echo "skipped random_scenes: python3 is not installed"; exit 0; }
log=$(mktemp) && trap 'rm -f "$log"' EXIT
if python3 tests/fuzz/random_scenes.py "$RAMIFY" 8 40 >"$log" 2>&1; then echo "ok random_scenes"; else
    echo "not ok random_scenes"
    cat "$log"
fi
