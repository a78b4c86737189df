#!/bin/sh
# Every key of the scene that a message names is there: what it tells people to change can be changed.
RAMIFY=${RAMIFY:-build/ramify}
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
"$RAMIFY" schema --paths >"$folder/paths"
# result NAME: prints the test's line; what was found wrong is in log.
result() {
    if [ -s "$folder/paths" ] && [ ! -s "$folder/log" ]; then echo "ok $1"; else
        echo "not ok $1"
        cat "$folder/log"
    fi
}
sources=$(find src -path src/cli -prune -o -name '*.c' -print -o -name '*.cpp' -print)
# shellcheck disable=SC2086
python3 tests/cli/message_keys.py "$folder/paths" $sources >"$folder/log" 2>&1
result messages_name_keys_that_exist

# A name that is none is found.
printf 'error_set(e, ERROR_INPUT, "lower growth.kill or raise "\n "growth.influence");\n' >"$folder/wrong.c"
python3 tests/cli/message_keys.py "$folder/paths" "$folder/wrong.c" >"$folder/log"
if grep -q "'growth.kill'" "$folder/log" && grep -q "'growth.influence'" "$folder/log"; then
    echo "ok names_that_do_not_exist_are_found"
else
    echo "not ok names_that_do_not_exist_are_found"
fi
