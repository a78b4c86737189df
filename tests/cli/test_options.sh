#!/bin/sh
# Command lines that are wrong in every way one can think of: each is refused at once with status 2 and one line that
# says what is wrong, and nothing is written. RAMIFY names the binary. Prints "ok NAME" or "not ok NAME" for each case.
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
mkdir "$folder/empty" && cd "$folder/empty" || exit 1
long=$(head -c 20000 /dev/zero | tr '\0' a)

# refused WORD...
wrong=0
refused() {
    "$RAMIFY" "$@" >"$folder/out" 2>"$folder/err"
    status=$?
    if [ $status -ne 2 ] || [ -s "$folder/out" ] || [ "$(wc -l <"$folder/err")" -ne 1 ] || [ "$(wc -c <"$folder/err")" -gt 1200 ]; then
        wrong=1
        echo "   status $status: $*" | head -c 300
        head -c 1000 "$folder/err"
    fi
}
verdict() {
    if [ $wrong -eq 0 ]; then echo "ok $1"; else echo "not ok $1"; fi
    wrong=0
}

for value in nan -1 1.5 '' 1x 1e400 "$long"; do
    refused render x.yaml "--samples=$value"
done
verdict numbers
for value in 1 1x1x1 0x1 1.5x2 65536x65536 "$long"; do
    refused render x.yaml --size "$value"
done
verdict sizes
for value in ,,, 0,0,1 0,0,nan,1 1,1,0,0 ''; do
    refused render x.yaml --crop "$value"
done
verdict crops
for word in -x --= --=x -qq -q=1 --json= -ofile.png -o "--$long"; do
    refused render x.yaml "$word"
done
refused render x.yaml --output ''
verdict options
refused
refused ''
refused -
refused "$long"
refused render
refused render --
refused render a b
refused render -- a --quiet
refused render "$long"
refused help a b
refused schema scene.yaml
set --
for i in 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16; do
    for j in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16; do set -- "$@" --set seed=$j; done
done
refused info x.yaml "$@" # 272 of them
verdict words
[ -z "$(ls -A)" ] || wrong=1
verdict nothing_written
