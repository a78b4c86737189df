#!/bin/sh
# Checks that data flows one way: no folder of src/ includes a header of a folder that docs/architecture.md does not
# allow it. Prints each breach; exits 1 when there is one.
cd "$(dirname "$0")/../src" || exit 1
allowed() {
    case $1 in
    base) echo base ;;
    shape | tree | image) echo "base $1" ;;
    field) echo "base shape field" ;;
    grow) echo "base shape field tree grow" ;;
    mesh) echo "base shape tree mesh" ;;
    model) echo "base shape field tree grow mesh model" ;;
    render) echo "base mesh image render" ;;
    export) echo "base shape tree mesh render image export" ;;
    scene) echo "base shape field tree grow mesh model render image export scene" ;;
    golden) echo "base render image scene golden" ;;
    animate) echo "base mesh model render image export scene animate" ;;
    api) echo "base shape field tree grow mesh model render image export scene golden animate api" ;;
    cli) echo cli ;; # and ramify.h, which is in no folder
    *) echo "" ;;
    esac
}
breaches=0
for folder in */; do
    folder=${folder%/}
    for file in "$folder"/*.[ch] "$folder"/*.cpp; do
        [ -f "$file" ] || continue
        for include in $(sed -n 's/^#include "\([a-z]*\)\/.*"/\1/p' "$file" | sort -u); do
            case " $(allowed "$folder") " in
            *" $include "*) ;;
            *) echo "src/$file includes $include/, which $folder/ may not"; breaches=1 ;;
            esac
        done
    done
done
exit $breaches
