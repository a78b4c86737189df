#!/bin/sh
# Renders the pictures of docs/tutorial.md, docs/tutorial/NAME.jpg from NAME.yaml: all of them, or those named on the command line.
# usage: docs/tutorial.sh [NAME...]
set -e
cd "$(dirname "$0")/.."
ramify=${RAMIFY:-build/ramify}
parts=$(mktemp -d)
trap 'rm -rf "$parts"' EXIT
[ $# -gt 0 ] || set -- 2-tree 3-camera 4-light 5-wind 6-needles 7-materials 8-pine 9-veins
for name; do
    "$ramify" render "docs/tutorial/$name.yaml" -o "$parts/still.png" --size 480x300 --samples 64
    oiiotool "$parts/still.png" --ch R,G,B --compression jpeg:88 -o "docs/tutorial/$name.jpg"
    rm -f "$parts"/*
done
