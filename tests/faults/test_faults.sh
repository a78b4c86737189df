#!/bin/sh
# A sample of the allocations, readings, writings and starts of processes of small runs fails (make faults: one for each call stack). RAMIFY
# names the binary. Prints "ok NAME" or "not ok NAME" for each case.
RAMIFY=${RAMIFY:-build/ramify}
command -v python3 >/dev/null || { echo "skipped faults: python3 is not installed"; exit 0; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
${CC:-cc} -std=c17 -D_GNU_SOURCE -O1 -g -shared -fPIC -fexceptions -Wall -Wextra -Werror tests/faults/shim.c -o "$folder/shim.so" || {
    echo "not ok faults_shim"
    exit 1
}
python3 tests/faults/faults.py "$RAMIFY" "$folder/shim.so" "$@"
