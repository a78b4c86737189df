#!/bin/sh
# make install: a small program finds the library through pkg-config, shared and static. RAMIFY names the binary.
RAMIFY=${RAMIFY:-build/ramify}
out=$(dirname "$RAMIFY")
case $out in */sanitize) exit 0 ;; esac # its library needs the sanitizers' own
prefix=$(mktemp -d) && trap 'rm -rf "$prefix"' EXIT
verdict() { if [ "$2" -eq 0 ]; then echo "ok $1"; else echo "not ok $1"; cat "$prefix/log"; fi; }

# DESTDIR keeps it from telling the loader about a folder that is soon gone.
make -s install OUT="$out" PREFIX="$prefix" DESTDIR=/ >"$prefix/log" 2>&1
verdict install $?
cat >"$prefix/program.c" <<'END'
#include <ramify.h>
#include <string.h>
int main(void)
{
    char *schema = ramify_schema(NULL);
    int good = schema && strcmp(ramify_version(), RAMIFY_VERSION) == 0;
    ramify_free(schema);
    return good ? 0 : 1;
}
END
export PKG_CONFIG_PATH="$prefix/lib/pkgconfig"
# Word splitting is meant: pkg-config prints options.
cc "$prefix/program.c" -o "$prefix/shared" $(pkg-config --cflags --libs ramify) >"$prefix/log" 2>&1 &&
    LD_LIBRARY_PATH="$prefix/lib" "$prefix/shared" >>"$prefix/log" 2>&1
verdict install_shared $?
rm "$prefix/lib/libramify.so" # so that the archive is what -lramify finds
cc "$prefix/program.c" -o "$prefix/static" $(pkg-config --static --cflags --libs ramify) >"$prefix/log" 2>&1 &&
    "$prefix/static" >>"$prefix/log" 2>&1
verdict install_static $?
