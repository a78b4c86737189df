#!/bin/sh
# The command as a user meets it: exit status, messages, files. RAMIFY names the binary.
# Prints "ok NAME" or "not ok NAME" for each case.
. "$(dirname "$0")/checks.sh"
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
folder=$(mktemp -d) && trap 'chmod -R u+w "$folder"; rm -rf "$folder"' EXIT
cd "$folder" || exit 1

# A small scene that needs every stage: growth, skin, leaves, ground, lamp.
cat >scene.yaml <<'END'
seed: 3
camera: {position: [0, 1.5, 7], target: [0, 1.4, 0], fov: 35}
film: {width: 48, height: 32}
render: {samples: 4, max_depth: 4}
sky: {kind: constant, color: 1}
objects:
  - name: bush
    tree:
      height: 3
      crown: {lobes: 0, growth: {levels: [{attractors: 20, step: 0.1, kill: 0.4, influence: 4}, {attractors: 300}]}}
      leaves: {max_count: 500}
  - name: ball
    shape: {envelope: [{shape: sphere, size: 0.5, position: [1.5, 0.5, 1]}]}
END

hash() { cksum <"$1"; }

check version 0 "$RAMIFY" --version
says version_number out "ramify 0."
matches version_commit out '^commit [0-9a-f]\{12\}\(-dirty\)*$\|^commit unknown$'
says version_libraries out 'OpenSubdiv 3.'
check help 0 "$RAMIFY" --help
says help_lists_commands out "ramify render SCENE"
check help_of_a_command 0 "$RAMIFY" help render
says help_lists_options out "--samples N"
check help_option 0 "$RAMIFY" grow --help
check help_of_nonsense 2 "$RAMIFY" help nonsense
check no_command 2 "$RAMIFY"
check unknown_command 2 "$RAMIFY" rendre scene.yaml
says unknown_command_hint err "unknown command 'rendre'; did you mean 'render'?"
check unknown_option 2 "$RAMIFY" render scene.yaml --sampels 4
says unknown_option_hint err "unknown option '--sampels' of render; did you mean '--samples'?"
check option_of_another_command 2 "$RAMIFY" info scene.yaml --resume
check bad_number 2 "$RAMIFY" render scene.yaml --samples 0
says bad_number_range err "--samples 0; it must be a whole number of 1 to 16777216"
check bad_size 2 "$RAMIFY" render scene.yaml --size 64
check bad_crop 2 "$RAMIFY" render scene.yaml --crop 0.5,0,0.5,1
check missing_value 2 "$RAMIFY" render scene.yaml --samples
check missing_scene 2 "$RAMIFY" render
check two_scenes 2 "$RAMIFY" info scene.yaml scene.yaml
check absent_scene 2 "$RAMIFY" render nope.yaml
says absent_scene_message err "nope.yaml: cannot read it: No such file or directory"
check wrong_scene 2 "$RAMIFY" info scene.yaml --set camera.fvo=3
says wrong_scene_message err "override camera.fvo=3: unknown key 'fvo' in camera; did you mean 'fov'?"

check species 0 "$RAMIFY" species
says species_have_names out "silver_birch"
says species_have_latin_names out "Carnegiea gigantea"
yes every_species_has_its_line [ "$(wc -l <out)" -ge 32 ]
check species_takes_no_scene 2 "$RAMIFY" species scene.yaml
check schema 0 "$RAMIFY" schema
says schema_title out '"title": "ramify scene"'
if command -v python3 >/dev/null; then
    yes schema_is_json python3 -m json.tool out
fi
check info 0 "$RAMIFY" info scene.yaml
says info_lists_objects out "bush"
check info_json 0 "$RAMIFY" info scene.yaml --json
says info_json_names out '"name": "ball", "kind": "shape"'
check info_resolved 0 "$RAMIFY" info scene.yaml --resolved --set seed=9
says info_resolved_defaults out "phyllotaxis: 137.5"
cp out resolved.yaml
check resolved_reads_back 0 "$RAMIFY" info resolved.yaml --resolved
yes resolved_is_the_same cmp out resolved.yaml

check grow 0 "$RAMIFY" grow scene.yaml -o tree.swc --quiet --json --threads 1
says grow_json out '"name": "bush", "nodes": '
yes grow_wrote_swc grep -qE '^1 0 .* -1$' tree.swc
yes quiet_is_quiet test ! -s err
check grow_json_file 0 "$RAMIFY" grow scene.yaml -o tree.json --quiet
yes grow_wrote_json grep -q '"parent"' tree.json
hash tree.swc >one
check isa_unknown 2 "$RAMIFY" render missing.yaml --isa sse9
says isa_before_the_scene err "unknown instruction set 'sse9'"
check grow_capital_ending 0 "$RAMIFY" grow scene.yaml -o TREE.SWC --quiet
check grow_two_threads 0 "$RAMIFY" grow scene.yaml -o tree.swc --quiet --threads 2
hash tree.swc >two
yes growth_ignores_threads cmp one two
check grow_wrong_ending 2 "$RAMIFY" grow scene.yaml -o tree.txt
printf 'objects: [{name: land, terrain: {resolution: 32, size: 600, relief: 90, rivers: {count: 40}}}]\n' >land.yaml
check grow_map 0 "$RAMIFY" grow land.yaml --map slope -o slope.asc --quiet
yes grow_map_in_degrees awk 'NR > 6 { for (i = 1; i <= NF; i++) { if ($i < 0 || $i >= 90) exit 1; sum += $i } } END { exit !(sum > 0) }' slope.asc
check grow_no_map 2 "$RAMIFY" grow land.yaml --map beauty -o beauty.asc
says grow_no_map_message err "must be one of slope, aspect"
check grow_map_of_tree 2 "$RAMIFY" grow scene.yaml --map slope -o slope.png
yes grow_map_of_tree_writes_nothing [ ! -e slope.png ]
printf 'objects: [{name: land, terrain: {form: noise, resolution: 32, size: 600, tiles: {count: 4, cells: 16}}}]\n' >world.yaml
check grow_tiles 0 "$RAMIFY" grow world.yaml --tile 1-2,3 -o t.asc --quiet
check grow_tile 0 "$RAMIFY" grow world.yaml --tile 2,3 -o one.asc --quiet
yes grow_tile_alone cmp t-2-3.asc one.asc
yes grow_tiles_share_their_border sh -c "awk 'NR > 6 { print \$17 }' t-1-3.asc >west; awk 'NR > 6 { print \$1 }' t-2-3.asc >east
[ \$(wc -l <west) = 17 ] && cmp west east"
check grow_tile_map 0 "$RAMIFY" grow world.yaml --tile 2,3 --map slope -o one.asc --quiet
check grow_no_tile 2 "$RAMIFY" grow world.yaml --tile 4,0 -o one.asc
says grow_no_tile_message err "the world has tiles 0,0 to 3,3"
check grow_tile_of_whole 2 "$RAMIFY" grow land.yaml --tile 1,1 -o one.asc
says grow_tile_of_whole_message err "the key tiles"
check grow_tile_badly 2 "$RAMIFY" grow world.yaml --tile 3 -o one.asc
check coarse_tiles 2 "$RAMIFY" info world.yaml --set objects.land.terrain.tiles.count=1
says coarse_tiles_message err "coarser than the terrain"
check grow_nothing 2 "$RAMIFY" grow scene.yaml --set 'objects=[{name: a, ground: }]'

check render 0 "$RAMIFY" render scene.yaml -o a.png --threads 1 --json
says render_json out '"samples": 4'
says render_summary err "triangles"
yes render_noise grep -q '4 samples, noise [0-9.]* %$' err
yes render_noise_json grep -q '"noise": 0\.[0-9]*,' out
yes render_wrote_both test -s a.png -a -s a.exr
check render_two_threads 0 "$RAMIFY" render scene.yaml -o b.png --threads 2 --quiet
if command -v oiiotool >/dev/null; then
    yes picture_ignores_threads oiiotool --fail 0 --warn 0 --diff a.exr b.exr
    yes exr_carries_the_scene sh -c "oiiotool --info -v a.exr | grep -q ramify:scene"
fi
yes pixels_ignore_threads cmp a.png b.png
check render_again 0 "$RAMIFY" render scene.yaml -o b.png --quiet --seconds 0 --noise 0 --no-denoise
yes picture_repeats cmp a.png b.png
check render_once 0 "$RAMIFY" render scene.yaml -o c.png --samples 1 --json
yes render_once_no_noise grep -q ' 1 samples$' err
says render_once_no_noise_json out '"noise": null,'
check render_by_exr_name 0 "$RAMIFY" render scene.yaml -o c.exr --quiet --size 16x8 --samples 1 --crop 0,0,0.5,1
yes exr_name_writes_both test -s c.exr -a -s c.png
check render_denoised 0 "$RAMIFY" render scene.yaml -o d.png --quiet --denoise --samples 2 --isa sse4.2
check render_default_name 0 "$RAMIFY" render scene.yaml --quiet --size 8x8 --samples 1
yes default_name test -s scene.png -a -s scene.exr

check wrong_ending 2 "$RAMIFY" render scene.yaml -o a.tga
check no_folder 1 "$RAMIFY" render scene.yaml -o nope/a.png
says no_folder_message err "cannot write 'nope/a.png': folder 'nope': No such file or directory"
long=$(printf 'n%.0s' $(seq 252))
check name_too_long 2 "$RAMIFY" render scene.yaml -o "$long.png"
says name_too_long_message err "File name too long"
check name_too_long_for_pov 1 "$RAMIFY" export scene.yaml -o "${long%??}.pov"
says name_too_long_for_pov_message err "at most 250 are possible here"
check name_too_long_for_film 1 "$RAMIFY" turntable scene.yaml -o "${long%??}.mp4"
says name_too_long_for_film_message err "at most 248 are possible here"
yes nothing_of_long_names sh -c '! ls | grep -q nnnn'
mkdir -p taken.png
check output_is_folder 1 "$RAMIFY" render scene.yaml -o taken.png
if [ "$(id -u)" -ne 0 ]; then
    mkdir sealed && chmod a-w sealed
    check sealed_folder 1 "$RAMIFY" render scene.yaml -o sealed/a.png
fi

# An old picture outlives a failure: a bad scene, and a disk with no room (a limit on file size).
hash a.png >before
check bad_scene_over_old 2 "$RAMIFY" render scene.yaml -o a.png --set camera.fov=0
hash a.png >after
yes old_file_unharmed_by_bad_scene cmp before after
check full_disk 1 sh -c "trap '' XFSZ; ulimit -f 2; exec '$RAMIFY' render scene.yaml -o a.png -q --size 256x256 --samples 1"
hash a.png >after
yes old_file_unharmed_by_full_disk cmp before after
yes nothing_left_behind sh -c '! ls -A | grep -qE "^a\.(png|exr)."'

# Ctrl-C: what there is gets written, and the status says so.
"$RAMIFY" render scene.yaml -o long.png -q --samples 1000000 --size 200x150 2>talk &
process=$!
waited=0
until [ -s long.png ] || [ $waited -ge 600 ]; do sleep 0.1; waited=$((waited + 1)); done
hash long.png >before # the coarse look, or already a later picture: the next one has whole samples
while hash long.png | cmp -s before - && [ $waited -lt 1200 ]; do sleep 0.1; waited=$((waited + 1)); done
kill -INT $process
wait $process
check interrupt_status 130 sh -c "exit $?"
yes interrupt_wrote_both test -s long.png -a -s long.exr
says interrupt_message talk "interrupted; long.png has"
