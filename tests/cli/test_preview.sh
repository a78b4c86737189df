#!/bin/sh
# Previews of ramify render: a picture is there early, it is complete whenever it is read, and the
# last one has the same bits as without previews. RAMIFY names the binary.
set -u
RAMIFY=${RAMIFY:-build/ramify}
RAMIFY=$(realpath "$RAMIFY")
checks=$(realpath "$(dirname "$0")/checks.sh")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
. "$checks"

cat >scene.yaml <<END
film: {width: 96, height: 70}
render: {samples: 200}
sky: {kind: constant}
objects: [{name: a, shape: {envelope: [{shape: sphere, size: [1, 1, 1]}]}}]
END

complete() { # complete FILE: does the PNG end with its last chunk?
    [ "$(tail -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 49454e44ae426082 ]
}

# Pictures that were seen while it rendered. The samples are more than it gets to see, then Ctrl-C.
mkdir seen
"$RAMIFY" render scene.yaml -q -o live.png --samples 1000000 2>err &
process=$!
count=0
broken=0
tries=0
while [ $count -lt 3 ] && [ $tries -lt 3000 ]; do
    tries=$((tries + 1))
    if cp live.png snap.png 2>/dev/null; then
        complete snap.png || broken=$((broken + 1))
        name=$(cksum <snap.png | tr ' ' '-')
        [ -e "seen/$name" ] || cp snap.png "seen/$name"
        count=$(find seen -type f | wc -l)
    fi
    sleep 0.02
done
kill -INT $process
wait $process
yes previews_appear [ "$count" -ge 3 ]
yes previews_are_complete [ $broken -eq 0 ]

# The bits of the finished picture.
check with 0 "$RAMIFY" render scene.yaml -q -o with.png
check without 0 "$RAMIFY" render scene.yaml -q -o without.png --no-preview
check one_thread 0 "$RAMIFY" render scene.yaml -q -o one.png --threads 1
yes same_picture cmp with.png without.png
yes same_layers cmp with.exr without.exr
yes same_with_one_thread cmp with.exr one.exr

# Without previews there is no file before the end.
"$RAMIFY" render scene.yaml -q -o none.png --samples 1000000 --no-preview 2>err &
process=$!
sleep 2
yes no_preview [ ! -e none.png ]
kill -KILL $process
wait $process 2>/dev/null || true # it was killed
