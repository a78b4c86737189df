#!/bin/sh
# ramify golden and ramify compare as a user meets them. RAMIFY names the binary.
# Prints "ok NAME", "not ok NAME" or "skipped NAME: why" for each case.
here=$(cd "$(dirname "$0")/.." && pwd)
. "$(dirname "$0")/checks.sh"
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
folder=$(mktemp -d) && trap 'chmod -R u+w "$folder"; rm -rf "$folder"' EXIT
cd "$folder" || exit 1
mkdir g

# scene NAME COLOR MORE: a ball on a floor.
scene() {
    cat >"g/$1.yaml" <<END
camera: {position: [0, 1.2, 5], target: [0, 0.5, 0], fov: 32}
film: {width: 48, height: 32}
render: {samples: 8, max_depth: 4}
sky: {kind: constant, color: 0.6}
lights: [{kind: sphere, center: [2, 3, 2], radius: 0.4, radiance: 12}]
materials: [{name: paint, kind: diffuse, color: $2}]
objects:
  - {name: floor, material: paint, shape: {envelope: [{shape: box, size: [3, 0.1, 3], position: [0, -0.1, 0]}]}}
  - {name: ball, material: clay, shape: {envelope: [{shape: sphere, size: 0.6, position: [0, 0.6, 0]}]}}
$3
END
}

check empty_folder 2 "$RAMIFY" golden g
matches empty_folder_message err "no scene file in 'g'; NAME.yaml beside NAME.png would be one"
check no_folder 2 "$RAMIFY" golden nowhere
check golden_needs_a_folder 2 "$RAMIFY" golden
check golden_two_modes 2 "$RAMIFY" golden g --exact --statistical
check golden_wrong_isa 2 "$RAMIFY" golden g --isa sse9

scene plain 0.5
sed -i 's/width: 48, height: 32/width: 10000, height: 9000/' g/plain.yaml
check memory_limit 1 "$RAMIFY" golden g -q --memory 2G
matches memory_limit_message out 'plain  *failed .*GB of memory are needed, but 2.00 GB are allowed'
rm g/plain.yaml
scene plain 0.5
scene glow 0.3 'seed: 7'
scene noisy 0.5 'golden: {mode: statistical}'
check missing 1 "$RAMIFY" golden g -q
matches missing_message out "plain  *missing .*there is no g/plain.png; an update stores one"
yes missing_stores_nothing test ! -e g/plain.png
check update 0 "$RAMIFY" golden g -q --update
matches update_says_which out "plain  *stored"
yes update_stores test -s g/plain.png -a -s g/glow.png -a -s g/noisy.exr
cksum g/*.png g/*.exr >before
check alike 0 "$RAMIFY" golden g -q --threads 1
matches alike_counts out "^3 alike, 0 different, 0 missing, 0 failed, 0 stored, 0 orphans$"
check update_again 0 "$RAMIFY" golden g -q --update
cksum g/*.png g/*.exr >after
yes update_leaves_what_is_alike cmp before after
check exact 0 "$RAMIFY" golden g -q --exact --filter '[pg]*'
check other_seeds 0 "$RAMIFY" golden g -q --filter noisy --series 5
matches filter out "^1 alike, 0 different"
check native_is_alike 0 "$RAMIFY" golden g -q --isa native --max-rmse 0.002 --max-failing 0.005

# Everything that can go wrong at once.
scene plain 0.52
scene noisy 0.52 'golden: {mode: statistical}'
cp g/glow.png g/gone.png
printf 'sky: {file: kept.png}\n' >'g/bro<b>ken & "bad".yaml'
cp g/glow.png g/kept.png
scene hurried 0.5
sed -i 's/samples: 8/samples: 8, seconds: 3/' g/hurried.yaml
scene sized 0.5
cp g/glow.png g/sized.png
sed -i 's/width: 48/width: 40/' g/sized.yaml
scene harmed 0.5
echo "no picture" >g/harmed.png
scene piped 0.5
mkfifo g/piped.png # nobody ever writes to it
check different 1 "$RAMIFY" golden g -q --json --report r.html --junit j.xml
cp out results.json
yes json_is_json python3 -m json.tool results.json
check different_in_words 1 "$RAMIFY" golden g -q
matches changed_material out "plain  *different RMSE 0.0[0-9].* is allowed"
matches changed_material_in_noise out "noisy  *different .*blocks differ by more than noise"
matches orphan out "gone.png  *orphan "
yes named_picture_is_no_orphan sh -c '! grep -q "kept.png .*orphan" out'
matches broken_scene out 'bro<b>ken & "bad"  *failed  *g/bro.*key .file. does not apply'
matches time_limit out "hurried  *failed .*render.seconds is 3"
matches other_size out "sized  *different 40 x 32 pixels against 48 x 32"
matches harmed_picture out "harmed  *failed .*harmed.png' cannot be read"
matches pipe_as_picture out "piped  *failed .*piped.png' cannot be read: it is not a regular file"
matches counts out "^1 alike, 3 different, 0 missing, 4 failed, 0 stored, 1 orphans$"
cat >junit.py <<'END'
import sys, xml.etree.ElementTree as tree
suite = tree.parse("j.xml").getroot().find("testsuite")
cases = {case.get("name"): case for case in suite}
assert suite.get("tests") == "8" and suite.get("failures") == "3" and suite.get("errors") == "4", suite.attrib
assert cases["plain"].find("failure").get("message").startswith("RMSE"), cases["plain"]
assert len(cases["glow"]) == 0 and float(cases["glow"].get("time")) > 0
assert cases['bro<b>ken & "bad"'].find("error") is not None
assert "gone.png" in suite.find("system-out").text
END
yes junit python3 junit.py
if [ -d "$RAMIFY_PEERS/node_modules/playwright-core" ] && command -v node >/dev/null && command -v chromium >/dev/null; then
    node "$here/golden/report.js" "$PWD/r.html" "$PWD/results.json"
else
    echo "skipped report_in_a_browser: playwright-core, node or chromium is not installed"
fi
rm -f g/bro* g/hurried* g/sized* g/harmed* g/piped* g/gone.png g/kept.png
check update_changed 0 "$RAMIFY" golden g -q --update
matches update_tells_why out "plain  *stored .*is allowed"
cksum g/glow.png >after
yes update_only_what_changed sh -c 'grep -qF "$(cat after)" before'

check compare_same 0 "$RAMIFY" compare g/plain.png g/plain.png
matches compare_same_message out "^alike: RMSE 0, "
check compare_other 1 "$RAMIFY" compare g/plain.png g/glow.png --json --report c.html
matches compare_json out '"alike": false, "width": 48, "height": 32'
yes compare_report grep -q "data:image/png;base64" c.html
check compare_within 0 "$RAMIFY" compare g/plain.png g/glow.png --max-rmse 0.5
check compare_beyond 1 "$RAMIFY" compare g/plain.png g/glow.png --max-rmse 0.5 --max-failing 0.01
check compare_unreadable 2 "$RAMIFY" compare g/plain.png g/plain.yaml
check compare_absent 2 "$RAMIFY" compare g/plain.png nowhere.png
check compare_one 2 "$RAMIFY" compare g/plain.png
matches compare_one_message err "no pair of pictures is named; usage: ramify compare A B"
check compare_kinds 2 "$RAMIFY" compare g/plain.png g/noisy.exr
matches compare_kinds_message err "'g/noisy.exr' holds radiance and 'g/plain.png' display values"
check render 0 "$RAMIFY" render g/plain.yaml -o p.png -q
check compare_exr 1 "$RAMIFY" compare p.exr g/noisy.exr --report e.html
check compare_exr_alike 0 "$RAMIFY" compare p.exr p.exr
check compare_sizes 1 "$RAMIFY" compare p.png "$here/golden/twigs.png"
matches compare_sizes_message err "48 x 32 pixels against 144 x 108"

# FLIP as its authors' own program computes it.
if [ -x "$RAMIFY_PEERS/python/bin/python" ] && "$RAMIFY_PEERS/python/bin/python" -c "import flip_evaluator" 2>/dev/null; then
    "$RAMIFY" compare g/plain.png g/glow.png --json >out 2>err
    cat >flip.py <<'END'
import json, flip_evaluator
mean = flip_evaluator.evaluate("g/glow.png", "g/plain.png", "LDR", applyMagma=False)[1]
assert abs(json.load(open("out"))["perceptual"] - mean) < 2e-5, mean
END
    yes flip_is_that_of_its_authors "$RAMIFY_PEERS/python/bin/python" flip.py
else
    echo "skipped flip_is_that_of_its_authors: flip-evaluator is not installed"
fi
