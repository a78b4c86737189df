#!/bin/sh
# Writes the render times beside the pictures of docs/gallery.md and README.md. It measures those of all pictures, or of
# those named, by docs/gallery.sh --times, which takes about as long as growing their scenes, and keeps them in
# docs/times.txt. --write: measures nothing. Exit status 1 when a picture is left without a time.
# usage: docs/times.sh [--write | NAME...]
set -e
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ "$1" != --write ]; then
    docs/gallery.sh --times "$@" | tee "$work/new"
    sed -n 's/^\(.*\): \([0-9]*\) s$/\1 \2/p' "$work/new" | # not those that were skipped
         cat docs/times.txt - | # a later line takes the place of an earlier one
        awk '{ seconds[$1] = $2 } END { for (name in seconds) print name, seconds[name] }' | LC_ALL=C sort >"$work/times"
    cp "$work/times" docs/times.txt
fi

# In the gallery a time is the line below the picture; in the table of README.md it ends the cell of the scene's name.
cat >"$work/write.awk" <<'END'
function text(seconds) {
    if (seconds < 60) return sprintf("%d s", seconds)
    if (seconds < 600) return sprintf("%.1f min", seconds / 60)
    return sprintf(seconds < 5970 ? "%d min" : "%.1f h", seconds < 5970 ? seconds / 60 + 0.5 : seconds / 3600)
}
FILENAME ~ /times.txt$/ { seconds[$1] = $2; next }
table && /^\| .*\.yaml\)/ {
    count = split($0, cell, / *\|/)
    line = ""
    for (i = 2; i < count; i++) {
        name = cell[i]
        sub(/.*\]\(scenes\//, "", name)
        sub(/\.yaml\).*/, "", name)
        if (name in seconds) {
            sub(/ \([0-9.]+ (s|min|h)\)$/, "", cell[i])
            cell[i] = cell[i] " (" text(seconds[name]) ")"
        }
        line = line "|" cell[i] " "
    }
    print line "|"
    next
}
/^!\[.*\]\(\.\.\/renders\/.*\)$/ {
    print
    name = $0
    sub(/.*\/renders\//, "", name)
    sub(/\.[a-z]*\)$/, "", name)
    below = (getline following) > 0
    had = below && following ~ /^\*[0-9.]+ (s|min|h) on two cores\*$/
    if (name in seconds) print "*" text(seconds[name]) " on two cores*"
    else if (had) print following
    if (below && !had) print following
    next
}
{ print }
END
for page in docs/gallery.md README.md; do
    table=$([ "$page" = docs/gallery.md ] || echo 1)
    awk -v table="$table" -f "$work/write.awk" docs/times.txt "$page" >"$work/page"
    cp "$work/page" "$page"
done
# figure 1 is a sheet of other pictures
! grep -A 1 '^!\[' docs/gallery.md | grep -B 1 '^$' | grep '^!\[' | grep -v figure-1.jpg
