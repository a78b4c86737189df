#!/bin/sh
# The command and the library are linked and compiled so that a flaw of memory is hard to use. RAMIFY names the binary, beside
# which the library lies. Prints "ok NAME" or "not ok NAME" for each case.
RAMIFY=${RAMIFY:-build/ramify}
# holds NAME TEXT PATTERN: the text has a line that a basic regular expression matches; lacks: it has none.
holds() {
    if printf '%s\n' "$2" | grep -q -- "$3"; then echo "ok $1"; else echo "not ok $1: nothing like '$3'"; fi
}
lacks() {
    if printf '%s\n' "$2" | grep -q -- "$3"; then echo "not ok $1: there is '$3'"; else echo "ok $1"; fi
}
for file in "$RAMIFY" "$(dirname "$RAMIFY")/libramify.so"; do
    [ -f "$file" ] || continue # a configuration without the library
    name=$(basename "$file" | tr . _)
    segments=$(readelf -lW "$file") dynamic=$(readelf -dW "$file") symbols=$(readelf --dyn-syms -W "$file")
    holds "${name}_is_position_independent" "$(readelf -h "$file")" 'Type: *DYN'
    holds "${name}_relro" "$segments" GNU_RELRO
    holds "${name}_binds_at_once" "$dynamic" 'FLAGS_1.*NOW'
    holds "${name}_stack_is_not_executable" "$segments" 'GNU_STACK.* RW '
    lacks "${name}_no_segment_is_written_and_run" "$segments" 'LOAD.* RWE '
    lacks "${name}_no_relocation_in_its_code" "$dynamic" TEXTREL
    printf '%s\n' "$symbols" | grep -q __asan_ && continue # sanitizers have their own ways
    holds "${name}_guards_its_stack" "$symbols" __stack_chk_fail
    holds "${name}_checks_sizes" "$symbols" '__\(memcpy\|snprintf\|vsnprintf\)_chk'
done
