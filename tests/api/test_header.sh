#!/bin/sh
# src/ramify.h alone: it compiles in every language that it may be used from, the shared library shows exactly what it
# declares, and every declaration has its contract. RAMIFY names the binary, beside which the library is.
RAMIFY=${RAMIFY:-build/ramify}
header=src/ramify.h
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
log=$folder/log
verdict() { if [ "$2" -eq 0 ]; then echo "ok $1"; else echo "not ok $1"; cat "$log"; fi; }

printf '#include "ramify.h"\nint main(void) { return ramify_version() == 0; }\n' >"$folder/program.c"
cp "$folder/program.c" "$folder/program.cpp"
strict="-Wall -Wextra -Wconversion -Wshadow -Werror -pedantic -fsyntax-only -Isrc"
for standard in c99 c11 c17; do
    cc -std=$standard $strict -Wstrict-prototypes "$folder/program.c" >"$log" 2>&1
    verdict "header_is_$standard" $?
done
for standard in c++11 c++17; do
    c++ -std=$standard $strict "$folder/program.cpp" >"$log" 2>&1
    verdict "header_is_$standard" $?
done

# Function names: what stands before "(" and begins with ramify_, once comments are gone.
cc -E -P "$header" | grep -o '\bramify_[a-z0-9_]*(' | tr -d '(' | sort >"$folder/declared"
nm -D --defined-only "$(dirname "$RAMIFY")/libramify.so" | awk '{ print $NF }' | sed 's/@.*//' | sort >"$folder/shown"
diff "$folder/declared" "$folder/shown" >"$log" && [ "$(wc -l <"$folder/declared")" -gt 60 ]
verdict library_shows_what_the_header_declares $?

# A comment stands right above each function or its group (a group has no blank lines in it), or behind it. Functions
# that free a handle need none: the conventions say all there is.
awk '
/^\/\// { commented = 1 }
/^$/ { commented = 0 }
/RAMIFY_API/ && !/#define/ && !/_free\(/ && !/;.*\/\/ / && !commented { print "without a comment: " $0 }
' "$header" >"$log"
[ ! -s "$log" ]
verdict every_function_has_a_contract $?

# Members of structs are numbers of a fixed size, floats, texts in place, pointers and structs of such: the same for every
# compiler, and for callers that lay them out by hand.
awk '
/^typedef struct .*\{/ { inside = 1; next }
/^}/ { inside = 0 }
inside && !/^ *(const )?(u?int(32|64)_t|float|double|Ramify[A-Z][A-Za-z]*) [a-z]/ && !/^ *char [a-z]+\[/ && !/\*/ && !/^ *(\/\/|$)/ { print "not fixed: " $0 }
' "$header" >"$log"
[ ! -s "$log" ]
verdict struct_members_are_of_fixed_size $?

# The layout of each struct is held fast by test_abi.c.
sed -n 's/^typedef struct \(Ramify[A-Za-z]*\) {.*/\1/p' "$header" | sort >"$folder/structs"
grep -o 'STRUCT(Ramify[A-Za-z]*' tests/api/test_abi.c | sed 's/STRUCT(//' | sort >"$folder/held"
diff "$folder/structs" "$folder/held" >"$log"
verdict layout_of_every_struct_is_held $?
