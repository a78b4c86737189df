#!/bin/sh
# Out-trees as GraphML read by networkx (`make peers` installs it), and the files that several objects get. RAMIFY names the
# binary, RAMIFY_PEERS where the peers are. Prints "ok NAME", "not ok NAME" or "skipped NAME: why".
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
python=${RAMIFY_PEERS:-$PWD/build/peers}/python/bin/python
check=$(cd "$(dirname "$0")" && pwd)/graphml_check.py
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

result() { # result NAME: by the status of the command before
    if [ $? -eq 0 ]; then echo "ok $1"; else
        echo "not ok $1"
        cat log
    fi
}

cat >two.yaml <<'END'
objects:
  - {name: oak, tree: {height: 3, leaves: {max_count: 0}}}
  - {name: rock, shape: {envelope: [{shape: sphere, size: 1}]}}
  - {name: elm tree, seed: 4, tree: {height: 2, leaves: {max_count: 0}}}
END
cat >one.yaml <<'END'
objects:
  - {name: oak, tree: {height: 3, leaves: {max_count: 0}}}
END
"$RAMIFY" export -q two.yaml -o two.graphml >log 2>&1 && "$RAMIFY" export -q two.yaml -o two.json >>log 2>&1 &&
    "$RAMIFY" export -q two.yaml -o two.swc >>log 2>&1 &&
    [ "$(ls | tr '\n' ' ')" = "log one.yaml two-elm tree.json two-elm tree.swc two-oak.json two-oak.swc two.graphml two.yaml " ]
result trees_of_several_objects_get_a_file_each
mkdir grown
for ending in graphml json swc; do "$RAMIFY" grow -q two.yaml -o grown/two.$ending >>log 2>&1; done
for file in two.graphml two-oak.json "two-elm tree.json" two-oak.swc "two-elm tree.swc"; do
    cmp "$file" "grown/$file" >>log 2>&1 || break
done
result grow_and_export_write_the_same
"$RAMIFY" export -q one.yaml -o one.json >log 2>&1 && cmp one.json two-oak.json >>log 2>&1 &&
    "$RAMIFY" export -q two.yaml --object oak -o only.json >>log 2>&1 && cmp only.json two-oak.json >>log 2>&1
result an_object_is_the_same_alone
"$RAMIFY" measure two-oak.swc --json >swc.json 2>log && "$RAMIFY" measure one.yaml --json >scene.json 2>>log &&
    sed -n 's/^  "\(length\|longest_path\|forks\|horton_number\)": {"value": \([^,]*\).*/\1 \2/p' swc.json >swc.txt &&
    sed -n 's/^  "\(length\|longest_path\|forks\|horton_number\)": {"value": \([^,]*\).*/\1 \2/p' scene.json >log &&
    [ "$(wc -l <swc.txt)" -ge 3 ] && cmp -s swc.txt log
result swc_measures_as_what_was_grown

if ! "$python" -c 'import networkx, numpy' 2>/dev/null; then
    echo "skipped graphml: networkx is not installed"
    exit 0
fi
"$python" "$check" two.graphml oak=two-oak.json "elm tree=two-elm tree.json" >log 2>&1
result networkx_reads_the_same_forest
