#!/bin/sh
# Checks that data flows one way: each folder of src/ includes headers of just those folders that the table of
# docs/architecture.md allows it, and the table allows none that no file uses and none from below. Prints each breach;
# exits 1 when there is one.
cd "$(dirname "$0")/.." || exit 1
{
    sed -n 's/^| `\([a-z]*\)\/` |.*| \([^|]*\) |$/row \1, \2/p' docs/architecture.md | tr -d ','
    for file in $(find src -mindepth 2 -name '*.[ch]' -o -mindepth 2 -name '*.cpp'); do
        folder=${file#src/}
        sed -n "s/^#include \"\([a-z]*\)\/.*\"/use ${folder%%/*} \1/p" "$file" | sort -u | sed "s|\$| $file|"
    done
} | awk '
    $1 == "row" {
        above[$2] = 1
        for (i = 3; i <= NF && !/nothing|alone/; i++) {
            allowed[$2, $i] = 1
            if (!($i in above)) complain("docs/architecture.md: " $2 "/ may include " $i "/, which is not above it")
        }
    }
    $1 == "use" && $2 != $3 {
        if (($2, $3) in allowed) used[$2, $3] = 1
        else complain($4 " includes " $3 "/, which " $2 "/ may not")
    }
    $1 == "use" && !($2 in above) { complain("docs/architecture.md has no row for " $2 "/") }
    function complain(text) { if (!(text in told)) print text; told[text] = breach = 1 }
    END {
        for (edge in allowed) {
            split(edge, of, SUBSEP)
            if (!(edge in used)) complain("docs/architecture.md: " of[1] "/ may include " of[2] "/, but no file does")
        }
        exit breach
    }'
