#!/bin/sh
# ramify fit: finds parameters that meet targets, the same on any number of threads, writes the scene with them in place,
# and refuses what makes no sense. RAMIFY names the binary.
set -u
RAMIFY=$(realpath "${RAMIFY:-build/ramify}")
checks=$(realpath "$(dirname "$0")/checks.sh")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
. "$checks"

# The number of tips is 3^generations; the angle of the forks follows from `angle`.
cat >weed.yaml <<'END'
# a weed
objects:
  - name: weed
    # written
    lsystem:
      height: 12 # metres
      axiom: X
      rules: "X -> F[+X][-X]FX; F -> FF"
      generations: 6
targets:
  - {object: weed, measure: terminals, low: 60, high: 100}
  - {object: weed, measure: branch_angle, low: 30, high: 31}
END
ranges="--vary objects.weed.lsystem.generations=2:7 --vary objects.weed.lsystem.angle=15:60"
# shellcheck disable=SC2086 # word splitting is meant
check meets_targets 0 "$RAMIFY" fit weed.yaml $ranges -o fitted.yaml --picture way.svg --threads 1 -q
cp out table
matches marks_the_best out '^\*'
matches tells_the_best out '^best .*misfit 0: --set objects.weed.lsystem.generations=5 --set objects.weed.lsystem.angle='
check fitted_scene_meets_targets 0 "$RAMIFY" measure fitted.yaml -q
sed 's/generations: 6/generations: 5/' weed.yaml >wanted
yes only_values_change test -z "$(sed '/^      angle: [0-9.]*$/d' fitted.yaml | diff wanted -)"
matches missing_key_is_added fitted.yaml '^      angle: [0-9.]*$'
yes picture_is_xml python3 -c 'import xml.dom.minidom; xml.dom.minidom.parse("way.svg")'
points=$(grep -c '<circle' way.svg)
yes picture_has_every_evaluation [ "$points" -eq $((5 * $(grep -c '^[* ] *[0-9]' table))) ]

# shellcheck disable=SC2086
check on_two_threads 0 "$RAMIFY" fit weed.yaml $ranges -o again.yaml --threads 2 -q
yes same_way_on_two_threads cmp table out
yes same_scene_on_two_threads cmp fitted.yaml again.yaml

# shellcheck disable=SC2086
check as_json 0 "$RAMIFY" fit weed.yaml $ranges --json -q
yes json_tells_the_way python3 - <<'END'
import json
fit = json.load(open("out"))
best = fit["evaluations"][fit["best"] - 1]
assert fit["met"] and best["misfit"] == 0 and best["parameters"] == [p["value"] for p in fit["parameters"]]
assert all(t["met"] and t["low"] <= t["value"] <= t["high"] for t in fit["targets"])
assert all(e["parameters"][0] == int(e["parameters"][0]) and e["misfit"] >= 0 for e in fit["evaluations"])
END

# With all evaluations the angle moves on, toward the middle of its range.
check spends_all 0 "$RAMIFY" fit weed.yaml --vary objects.weed.lsystem.angle=15:60 --set objects.weed.lsystem.generations=5 \
    --until evaluations --evaluations 25 --json -q
yes moves_to_the_middle python3 - <<'END'
import json
fit = json.load(open("out"))
assert len(fit["evaluations"]) == 25 and abs(fit["targets"][1]["value"] - 30.5) < 0.3, fit["targets"]
END

# Targets that cannot be met: the best is written nevertheless.
check missed 1 "$RAMIFY" fit weed.yaml --vary objects.weed.lsystem.height=5:6 --evaluations 4 -o missed.yaml
says missed_says_so err "no scene of 4 evaluations meets all targets"
yes missed_is_written grep -q 'height: 5' missed.yaml
check logarithmic 1 "$RAMIFY" fit weed.yaml --vary objects.weed.lsystem.height=1:16:log --evaluations 2 -q
matches logarithmic_start out '^\*   1 .* 12 '

# A value behind an alias cannot be edited in place; the scene is written out whole.
cat >alias.yaml <<'END'
objects:
  - {name: a, lsystem: &same {height: 3, generations: 3}}
  - {name: b, lsystem: *same}
targets: [{object: b, measure: height, low: 3.9, high: 4.5}]
END
check alias 0 "$RAMIFY" fit alias.yaml --vary objects.b.lsystem.height=2:5 -o whole.yaml
says alias_says_so err "has all values written out"
check alias_meets_targets 0 "$RAMIFY" measure whole.yaml -q

# refused NAME TEXT WORD...: one line of error, status 2, nothing written.
refused() {
    name=$1 text=$2
    shift 2
    check "refuses_$name" 2 "$RAMIFY" fit weed.yaml -o refused.yaml "$@"
    says "${name}_says_so" err "$text"
    yes "one_line_for_$name" [ "$(wc -l <err)" -eq 1 ]
}
vary=objects.weed.lsystem
refused nothing_to_vary "nothing to vary"
refused unknown_key "did you mean 'angle'?" --vary $vary.angel=15:60
refused unknown_object "did you mean 'weed'?" --vary objects.wed.lsystem.angle=15:60
refused no_number "sky.kind" --vary sky.kind=1:2
refused mapping "must be a mapping" --vary $vary=1:2
refused empty_range "must be below its high one" --vary $vary.angle=60:15
refused half_a_range "PATH=LOW:HIGH" --vary $vary.angle=60
refused words "PATH=LOW:HIGH" --vary $vary.angle=low:high
refused not_finite "must be below its high one" --vary $vary.angle=nan:60
refused beyond_the_key "greater than 0" --vary $vary.step=-2:8
refused logarithm_of_nothing "above 0" --vary $vary.angle=0:60:log
refused no_whole_number "widen it" --vary $vary.generations=2.2:2.9
refused twice "varied twice" --vary $vary.angle=15:60 --vary $vary.angle=20:30
refused no_targets "has no targets" --vary $vary.angle=15:60 --set 'targets=[]'
refused unknown_measure "did you mean 'terminals'?" --vary $vary.angle=15:60 --set targets.0.measure=terminal
refused until "must be one of targets, evaluations" --vary $vary.angle=15:60 --until morning
refused picture "must be .svg" --vary $vary.angle=15:60 --picture way.png
yes nothing_was_written [ ! -e refused.yaml ]

# A file that the scene names is not found from another folder: said before the work.
mkdir sub
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
sed 's/^targets:/  - {name: x, mesh: {file: one.obj}}\ntargets:/' weed.yaml >files.yaml
check other_folder 2 "$RAMIFY" fit files.yaml --vary $vary.angle=15:60 -o sub/fitted.yaml
says other_folder_says_so err one.obj

# Ctrl-C keeps the best so far.
sed 's/generations: 6/generations: 9/; s/low: 60, high: 100/low: 1e8/' weed.yaml >slow.yaml
"$RAMIFY" fit slow.yaml --vary $vary.angle=15:60 --evaluations 10000 -o kept.yaml --picture kept.svg -q >out 2>err &
process=$!
while [ "$(grep -c '^[* ] *[0-9]' out)" -lt 2 ] && kill -0 $process 2>/dev/null; do sleep 0.1; done
kill -INT $process
wait $process
yes interrupted [ $? -eq 130 ]
says interrupted_says_so err "interrupted after"
matches interrupted_tells_the_best out '^best '
yes interrupted_keeps_the_best grep -q 'angle: ' kept.yaml
yes interrupted_draws grep -q '</svg>' kept.svg
