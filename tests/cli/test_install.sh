#!/bin/sh
# make install: the programs of docs/examples are compiled against the installed library through pkg-config, shared and
# static, and do what they say; make uninstall leaves nothing. The prefix has a blank in its name. RAMIFY names the binary.
# Prints "ok NAME" or "not ok NAME" for each case.
RAMIFY=${RAMIFY:-build/ramify}
out=$(dirname "$RAMIFY")
case $out in */sanitize) exit 0 ;; esac # its library needs the sanitizers' own
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
repository=$PWD prefix="$folder/a prefix" log=$folder/log
verdict() { if [ "$2" -eq 0 ]; then echo "ok $1"; else echo "not ok $1"; cat "$log"; fi; }

# DESTDIR keeps it from telling the loader about a folder that is soon gone.
make -s install OUT="$out" PREFIX="$prefix" DESTDIR=/ >"$log" 2>&1
verdict install $?
[ -x "$prefix/bin/ramify" ] && [ "$("$prefix/bin/ramify" --version)" = "$("$RAMIFY" --version)" ] &&
    [ "ramify $(PKG_CONFIG_PATH="$prefix/lib/pkgconfig" pkg-config --modversion ramify)" = "$("$RAMIFY" --version | head -1)" ]
verdict install_has_one_version $?

cat >"$folder/scene.yaml" <<'END'
camera: {position: [0, 1.5, 7], target: [0, 1.4, 0]}
film: {width: 32, height: 24, denoise: true}
render: {samples: 4, max_depth: 3}
sky: {kind: constant, color: 1}
objects:
  - name: bush
    tree: {height: 3, leaves: {max_count: 50}, crown: {lobes: 0, growth: {levels: [{attractors: 60}]}}}
  - {name: ball, shape: {envelope: [{shape: sphere}]}}
END
export PKG_CONFIG_PATH="$prefix/lib/pkgconfig"

# compile KIND ARCHIVE OPTION...: all examples into $folder/KIND. pkg-config prints options as a shell reads them.
compile() {
    kind=$1 archive=$2
    shift 2
    mkdir "$folder/$kind"
    status=0
    for source in docs/examples/*.c; do
        program=$(basename "$source" .c)
        eval "cc -std=c99 -Wall -Wextra -Werror -pedantic '$source' -o '$folder/$kind/$program' $archive \
            $(pkg-config "$@" --cflags --libs ramify)" >"$log" 2>&1 || status=1
    done
    verdict "${kind}_compiles" $status
}

# examples KIND: runs them and looks at what they print and write.
examples() {
    kind=$1
    cd "$folder" || exit 1
    "$kind/grow_print" scene.yaml objects.bush.tree.height=4 >print 2>"$log" &&
        grep -qE '^bush: [1-9][0-9]* nodes, 1 roots, [34]\.[0-9]+ m high' print && grep -qE '^  strahler_order +[2-9]' print
    verdict "${kind}_grow_print" $?
    "$kind/grow_print" scene.yaml objects.bush.tree.hight=4 >print 2>"$log"
    [ $? -eq 2 ] && grep -qF "unknown key 'hight'" "$log"
    verdict "${kind}_grow_print_says_what_is_wrong" $?
    "$kind/grow_export" scene.yaml bush.swc >"$log" 2>&1 && "$RAMIFY" grow scene.yaml -q -o same.swc && cmp bush.swc same.swc
    verdict "${kind}_grow_export_swc" $?
    "$kind/grow_export" scene.yaml bush.stl >"$log" 2>&1 && "$RAMIFY" export scene.yaml -q -o same.stl && cmp bush.stl same.stl
    verdict "${kind}_grow_export_stl" $?
    "$kind/grow_export" scene.yaml bush.xyz >"$log" 2>&1
    [ $? -eq 2 ] && grep -qF ".stl" "$log" && [ ! -e bush.xyz ]
    verdict "${kind}_grow_export_refuses" $?
    "$kind/render_progress" scene.yaml bush.png >"$log" 2>&1 && grep -q '^grow [0-9]* %' "$log" &&
        grep -q '^bush.png has 1 samples' "$log" && "$RAMIFY" render scene.yaml -q -o same.png && cmp bush.png same.png
    verdict "${kind}_render_progress" $?
    sed 's/samples: 4/samples: 1000000/' scene.yaml >long.yaml
    "$kind/render_progress" long.yaml long.png >"$log" 2>&1 &
    process=$! waited=0
    while [ ! -s long.png ] && [ $waited -lt 300 ]; do sleep 0.1; waited=$((waited + 1)); done
    kill -INT $process
    wait $process
    [ $? -eq 130 ] && grep -q '^long.png: [1-9][0-9]* samples a pixel' "$log" && [ -s long.png ]
    verdict "${kind}_render_progress_interrupted" $?
    rm -f bush.* same.* long.*
    cd "$OLDPWD" || exit 1
}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac

compile shared ''
readelf -d "$folder/shared/grow_print" >"$log" && grep -q 'NEEDED.*\[libramify\.so\.[0-9]*\]' "$log"
verdict shared_needs_the_numbered_library $?
LD_LIBRARY_PATH="$prefix/lib" examples shared

python=${RAMIFY_PEERS:-$repository/build/peers}/python/bin/python
if "$python" -c 'import numpy' 2>/dev/null; then
    # found below the same prefix, from anywhere, without a word about where
    (cd / && env -u RAMIFY_LIBRARY -u PYTHONDONTWRITEBYTECODE PYTHONPATH="$(echo "$prefix"/lib/python3*/dist-packages)" \
        "$python" "$repository/docs/examples/grow_numpy.py" "$folder/scene.yaml" bush) >"$log" 2>&1 &&
        grep -qE '^bush: [0-9]+ nodes, .* m of branches, [0-9]+ tips$' "$log"
    verdict installed_python_module $?
else
    echo "skipped installed_python_module: NumPy is not installed"
fi
compile static "-Wl,--as-needed '$(pkg-config --variable=libdir ramify)/libramify.a'" --static
readelf -d "$folder/static/grow_print" >"$log" && ! grep -q 'libramify' "$log"
verdict static_needs_no_library $?
examples static

make -s uninstall OUT="$out" PREFIX="$prefix" DESTDIR=/ >"$log" 2>&1 && find "$prefix" ! -type d -o -name ramify >"$log" && [ ! -s "$log" ]
verdict uninstall_leaves_nothing $?
