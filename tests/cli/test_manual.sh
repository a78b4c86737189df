#!/bin/sh
# The manual: what is generated is up to date, links lead somewhere, examples run. RAMIFY names the binary.
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
root=$PWD
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
# verdict NAME: "ok" when the file `wrong` is empty, else what it holds.
verdict() {
    if [ -s wrong ]; then echo "not ok $1"; cat wrong; else echo "ok $1"; fi
}

# ---- docs/scene.md ----

"$RAMIFY" schema --markdown >scene.md
if diff "$root/docs/scene.md" scene.md >wrong; then :; else echo "docs/scene.md is stale: make docs" >>wrong; fi
verdict scene_reference_is_fresh

# Every key of the JSON Schema has a row; every row has all four cells.
"$RAMIFY" schema | awk '/"\$defs"/ {defs = 1} !(defs && /^    "/)' | sed -n 's/^ *"\([a-z0-9_]*\)": {"description".*/\1/p' | sort -u >keys
[ "$(wc -l <keys)" -gt 200 ] || echo "few keys in the schema" >keys
sed -n 's/^| `\([a-z0-9_]*\)` | .* | .* | ..* |$/\1/p' scene.md | sort -u >rows
comm -23 keys rows >wrong
verdict scene_reference_has_every_key

# Links of the documents: #sections as GitHub names them, and files.
for document in "$root"/README.md "$root"/docs/*.md; do
    sed -n 's/^##* //p' "$document" | tr 'A-Z ' 'a-z-' | tr -cd 'a-z0-9_\n-' | sort >sections
    sort -u sections | comm -23 sections - | sed "s|^|${document##*/}: two sections are called |"
    grep -oE '\]\([^)]+\)' "$document" | sed 's/^](//; s/)$//' | sort -u | while read -r link; do
        case $link in
        \#*) grep -qxF -- "${link#\#}" sections ;;
        http*) ;;
        *) [ -e "$(dirname "$document")/${link%%\#*}" ] ;;
        esac || echo "${document##*/}: no $link"
    done
done >wrong
verdict links_resolve

# Examples of the reference: pieces of a scene; what lacks objects gets one.
awk '/^```yaml$/ {n++; inside = 1; next} /^```$/ {inside = 0} inside {print > sprintf("example-%02d.yaml", n)}' scene.md
: >wrong
count=0
for example in example-*.yaml; do
    grep -q '^objects:' "$example" || printf 'objects: [{name: land, ground: {}}]\n' >>"$example"
    "$RAMIFY" info "$example" >out 2>&1 || cat out "$example" >>wrong
    count=$((count + 1))
done
[ "$count" -ge 20 ] || echo "only $count examples" >>wrong
verdict scene_reference_examples_are_valid
