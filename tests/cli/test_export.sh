#!/bin/sh
# ramify export as a user meets it: exit status, messages, which objects are written, and that nothing harms an old file.
# RAMIFY names the binary. Prints "ok NAME" or "not ok NAME" for each case.
. "$(dirname "$0")/checks.sh"
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
folder=$(mktemp -d) && trap 'umount small 2>/dev/null; chmod -R u+w "$folder"; rm -rf "$folder"' EXIT
cd "$folder" || exit 1

cat >scene.yaml <<'END'
seed: 3
sky: {kind: constant, color: 1}
objects:
  - name: bush
    tree:
      height: 3
      crown: {lobes: 0, growth: {levels: [{attractors: 20, step: 0.1, kill: 0.4, influence: 4}, {attractors: 300}]}}
      leaves: {max_count: 500}
  - {name: ball, shape: {envelope: [{shape: sphere, size: 0.5, position: [1.5, 0.5, 1]}]}}
  - {name: other ball, shape: {envelope: [{shape: sphere, size: 0.5, position: [-1.5, 0.5, 1]}]}}
END

number() { sed "s/.*\"$1\": \([0-9]*\).*/\1/" out; } # of the report

check no_file 2 "$RAMIFY" export scene.yaml
says no_file_message err "add -o FILE"
check wrong_ending 2 "$RAMIFY" export scene.yaml -o a.fbx
says wrong_ending_lists_formats err ".glb"
check no_ending 2 "$RAMIFY" export scene.yaml -o glb
check missing_folder 1 "$RAMIFY" export scene.yaml -o nowhere/a.glb
says missing_folder_message err "No such file or directory"
check unknown_object 2 "$RAMIFY" export scene.yaml -o a.ply --object bal
says unknown_object_hint err "did you mean 'ball'?"
check unknown_instances 2 "$RAMIFY" export scene.yaml -o a.glb --instances node
says unknown_instances_hint err "auto, nodes, gpu, flat"
check unknown_colors 2 "$RAMIFY" export scene.yaml -o a.glb --colors red
check too_few_sides 2 "$RAMIFY" export scene.yaml -o a.glb --tube-sides 2
yes nothing_is_written_by_mistakes sh -c '! ls | grep -q "^a\\."'

# ---- what is written

for format in glb obj ply stl; do
    check "writes_$format" 0 "$RAMIFY" export scene.yaml -o "a.$format" --json -q
    bytes=$(number bytes) triangles=$(number triangles)
    yes "reports_the_size_of_$format" [ "$bytes" -eq "$(wc -c <"a.$format")" ]
done
yes stl_holds_what_is_reported [ "$bytes" -eq $((84 + 50 * triangles)) ]
yes obj_has_its_materials grep -q '^newmtl leaf' a.mtl
check says_the_file 0 "$RAMIFY" export scene.yaml -o a.stl
says says_the_file_name err "a.stl"
check upper_case_ending 0 "$RAMIFY" export scene.yaml -o B.OBJ -q
yes upper_case_materials [ -s B.mtl ]
check one_object 0 "$RAMIFY" export scene.yaml -o one.stl --json -q --object ball
ball=$(number triangles)
check two_objects 0 "$RAMIFY" export scene.yaml -o two.stl --json -q --object ball --object "other ball"
yes objects_add_up [ "$(number triangles)" -eq $((2 * ball)) ]
check another_form_of_the_same 0 "$RAMIFY" export scene.yaml -o bush.stl --json -q --object bush
yes an_object_alone_is_the_same [ "$(number triangles)" -eq $((triangles - 2 * ball)) ]
check thicker_tubes 0 "$RAMIFY" export scene.yaml -o bush.ply --json -q --object bush --tube-sides 12
yes sides_count [ "$(number triangles)" -gt $((triangles - 2 * ball)) ]
check half_grown 0 "$RAMIFY" export scene.yaml -o half.stl --json -q --grow-to 0.5 --object bush
yes half_grown_is_less [ "$(number triangles)" -lt $((triangles - 2 * ball)) ]

# A forest stands on its land also where that is left out.
cat >slope.yaml <<'END'
seed: 4
objects:
  - {name: floor, ground: {relief: 6, wavelength: 60, flat_radius: 6, grass_tufts: 0, fallen_leaves: 0, trees: {count: 0}}}
  - {name: forest, forest: {height: 8, spacing: 4, stand_trees: 2, stands: 1, radius: 20, glade: 4, density: 1, ferns: 20, leaves: {max_count: 50}, growth: {levels: [{attractors: 30}]}}}
END
check forest_alone 0 "$RAMIFY" export slope.yaml -o forest.stl -q --object forest
check floor_alone 0 "$RAMIFY" export slope.yaml -o floor.stl -q --object floor
check forest_and_floor 0 "$RAMIFY" export slope.yaml -o both.stl -q
tail -c +85 both.stl >both # triangles alone
yes a_forest_alone_stands_where_it_stood sh -c '{ tail -c +85 floor.stl; tail -c +85 forest.stl; } | cmp - both'

# A soap film is smooth in every format.
printf 'objects: [{name: bubble, shape: {envelope: [{shape: sphere}], voxel: 0.3}, material: soap_film}]\n' >soap.yaml
for format in obj glb usda; do
    check soap_$format 0 "$RAMIFY" export soap.yaml -o soap.$format -q
done
yes soap_is_smooth_in_mtl grep -qx 'Pr 0' soap.mtl
yes soap_is_smooth_in_glb grep -qa '"roughnessFactor":0[,}]' soap.glb
yes soap_is_smooth_in_usda grep -qE 'inputs:roughness = 0$' soap.usda

# A picture that is cut off is found out, also where it would go into the file as it is.
printf '\211PNG\r\n\032\n' >cut.png
cat >pictured.yaml <<'END'
materials:
  - {name: pictured, kind: diffuse, texture: cut.png}
objects:
  - {name: ball, material: pictured, shape: {envelope: [{shape: sphere, size: 0.5}]}}
END
check broken_picture 2 "$RAMIFY" export pictured.yaml -o a.glb -q
says broken_picture_message err "'cut.png'"

# ---- nothing harms an old file

old() { for file in a.glb a.obj a.mtl a.ply a.stl; do echo old >$file; done; }
still_old() { for file in a.glb a.obj a.mtl a.ply a.stl; do [ "$(cat $file)" = old ] || return 1; done; }
old
for format in glb obj ply stl; do
    check "full_disk_$format" 1 sh -c "trap '' XFSZ; ulimit -f 8; exec '$RAMIFY' export scene.yaml -o a.$format -q"
    says "full_disk_${format}_message" err "cannot be written"
done
yes full_disk_keeps_old_files still_old
# A picture of the sky that would fit beside a scene that does not.
sed 's/^sky: .*/sky: {kind: sun_sky}/' scene.yaml >day.yaml
echo old >day.usda && echo old >day-sky.exr
limit=$("$RAMIFY" export day.yaml -o other.usda -q && wc -c <other.usda)
check full_disk_usda 1 bash -c "trap '' XFSZ; ulimit -f $((limit / 1024 - 1)); exec '$RAMIFY' export day.yaml -o day.usda -q"
says full_disk_usda_message err "day.usda' cannot be written"
yes the_sky_fits [ "$(wc -c <other-sky.exr)" -lt $((limit - 2048)) ]
yes full_disk_keeps_the_sky sh -c '[ "$(cat day.usda day-sky.exr)" = "old
old" ]'
yes full_disk_leaves_no_parts sh -c '! ls -A | grep -q part'
if [ "$(id -u)" -ne 0 ]; then
    mkdir locked && echo old >locked/a.ply && chmod a-w locked
    check read_only_folder 1 "$RAMIFY" export scene.yaml -o locked/a.ply
    yes read_only_folder_keeps_it grep -q old locked/a.ply
elif mkdir small && mount -t tmpfs -o size=64k,ro tmpfs small 2>/dev/null; then
    check read_only_folder 1 "$RAMIFY" export scene.yaml -o small/a.ply
    mount -o remount,rw small && echo old >small/a.obj && echo old >small/a.mtl
    check small_disk 1 "$RAMIFY" export scene.yaml -o small/a.obj
    says small_disk_message err "No space left on device"
    yes small_disk_keeps_both sh -c 'grep -q old small/a.obj && grep -q old small/a.mtl && [ "$(ls -A small | wc -l)" -eq 2 ]'
    umount small
fi

# Ctrl-C in the middle of it: the file on its way is there already, with a name or without one.
on_its_way() { ls -A | grep -q '\.part$' || ls -l "/proc/$1/fd" 2>/dev/null | grep -q '/#[0-9]* (deleted)'; }
sed 's/attractors: 300/attractors: 20000/; s/max_count: 500/max_count: 400000/' scene.yaml >large.yaml
for format in obj glb; do
    "$RAMIFY" export large.yaml -o a.$format -q --instances flat 2>err &
    process=$!
    tries=0
    while ! on_its_way $process && kill -0 $process 2>/dev/null && [ $tries -lt 6000 ]; do
        sleep 0.01
        tries=$((tries + 1))
    done
    kill -INT $process 2>/dev/null
    wait $process
    yes "interrupt_status_$format" [ $? -eq 130 ]
done
yes interrupt_keeps_old_files still_old
yes interrupt_leaves_no_parts sh -c '! ls -A | grep -q part'
# A terminal that is closed, and a kill that nothing can hear.
for signal in HUP KILL; do
    env --default-signal=HUP "$RAMIFY" export large.yaml -o a.obj -q --instances flat 2>err & # also under nohup
    process=$!
    tries=0
    while ! on_its_way $process && kill -0 $process 2>/dev/null && [ $tries -lt 6000 ]; do
        sleep 0.01
        tries=$((tries + 1))
    done
    kill -$signal $process 2>/dev/null
    wait $process
done
"$RAMIFY" export scene.yaml -o b.obj -q # where files need names, the next run clears up
yes killed_runs_keep_old_files still_old
yes killed_runs_leave_no_parts sh -c '! ls -A | grep -v "^b" | grep -q part'
rm -f b.*
# POV-Ray's folder of pictures goes when nothing came to lie in it.
mkdir c-textures
check no_pictures_for_povray 0 "$RAMIFY" export scene.yaml -o c.pov -q
yes empty_folder_of_pictures_goes [ ! -e c-textures ]
# A pipe as a picture is not waited for.
mkfifo pipe.png
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n' >sheet.obj
cat >piped.yaml <<'END'
materials:
  - {name: painted, kind: diffuse, alpha_texture: pipe.png}
objects:
  - {name: sheet, material: painted, mesh: {file: sheet.obj}}
END
for format in glb pov usda; do
    check "pipe_as_texture_$format" 2 timeout 60 "$RAMIFY" export piped.yaml -o d.$format -q
    says "pipe_as_texture_${format}_is_named" err "'pipe.png' is a device; it must be a file"
done
rm -f pipe.png c.pov piped.yaml sheet.obj
