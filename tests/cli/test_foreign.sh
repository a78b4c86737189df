#!/bin/sh
# Meshes of other programs as crowns: closed ones hold the crown, open ones give a warning and work. RAMIFY names the
# binary. Prints "ok NAME" or "not ok NAME" for each case.
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

result() { # result NAME: by the status of the command before
    if [ $? -eq 0 ]; then echo "ok $1"; else
        echo "not ok $1"
        cat err
    fi
}

# sphere HOLE: an OBJ of a ball of radius 1 about the origin, quads by longitude and latitude. Without the faces whose
# longitude's and latitude's numbers are both below HOLE: a hole in its side.
sphere() {
    awk -v hole="$1" 'BEGIN {
        n = 24; m = 12; pi = atan2(0, -1)
        print "o ball\nv 0 1 0\nv 0 -1 0"
        for (j = 1; j < m; j++) for (i = 0; i < n; i++)
            printf "v %.6f %.6f %.6f\n", sin(pi*j/m) * sin(2*pi*i/n), cos(pi*j/m), sin(pi*j/m) * cos(2*pi*i/n)
        for (i = 0; i < n; i++) { k = (i + 1) % n
            print "f 1", 3 + i, 3 + k
            print "f 2", 3 + (m - 2) * n + k, 3 + (m - 2) * n + i }
        for (j = 0; j < m - 2; j++) for (i = 0; i < n; i++) { k = (i + 1) % n
            if (i >= hole || j < 4 || j >= 4 + hole)
                print "f", 3 + j*n + i, 3 + (j+1)*n + i, 3 + (j+1)*n + k, 3 + j*n + k }
    }'
}
sphere 0 >closed.obj
sphere 3 >torn.obj
head -c 400 closed.obj >cut.obj # ends within a line, before any face

# The ball is blown up to 1.5 x 1 x 1.5 m about y = 2.
cat >scene.yaml <<'END_OF_SCENE'
camera: {position: [0, 1.6, 8], target: [0, 1.6, 0], fov: 34}
film: {width: 40, height: 40}
render: {samples: 4, max_depth: 3}
sky: {kind: constant, color: 1}
objects:
  - name: tree
    tree:
      height: 3
      trunk: {height: 1.6, lean: 0}
      crown:
        branches: 4
        branch_from: 0.85
        branch_length: 0.1
        envelope: [{shape: mesh, file: closed.obj, position: [0, 2, 0], scale: [1.5, 1, 1.5]}]
        growth: {levels: [{attractors: 30, influence: 4, scale: 0.9}, {attractors: 600}]}
      leaves: {max_count: 300}
END_OF_SCENE
sed 's/closed.obj/torn.obj/' scene.yaml >torn.yaml
sed 's/closed.obj/cut.obj/' scene.yaml >cut.yaml
sed 's/closed.obj/absent.obj/' scene.yaml >absent.yaml

# crown FILE.json: prints how many nodes the crown has (colony 1), and by how many metres the farthest of them stands out of
# the box about the blown up ball, and out of the ball itself, as a share of its radius.
crown() {
    awk '/^"(position|colony)":/ {
        key = substr($0, 2, 6)
        sub(/^[^[]*/, "")
        gsub(/[][]/, "")
        count[key] = split($0, value, ",")
        for (i = 1; i <= count[key]; i++) data[key, i] = value[i]
    }
    function beyond(v, most) { v = v < 0 ? -v : v; return v - most }
    END {
        box = ball = -1
        for (n = 1; 3 * n <= count["positi"]; n++) if (data["colony", n] == 1) {
            x = data["positi", 3*n - 2]; y = data["positi", 3*n - 1] - 2; z = data["positi", 3*n]
            nodes++
            if (beyond(x, 1.5) > box) box = beyond(x, 1.5)
            if (beyond(y, 1) > box) box = beyond(y, 1)
            if (beyond(z, 1.5) > box) box = beyond(z, 1.5)
            r = sqrt(x*x / 2.25 + y*y + z*z / 2.25) - 1
            if (r > ball) ball = r
        }
        printf "%d %.4f %.4f\n", nodes, box, ball
    }' "$1"
}

"$RAMIFY" grow scene.yaml -o closed.json 2>err
result closed_mesh_grows
! grep -q "warning" err
result closed_mesh_needs_no_warning
crown closed.json >err
read -r nodes box ball <err
[ "$nodes" -gt 300 ]
result crown_has_grown
awk -v box="$box" 'BEGIN { exit !(box <= 0) }'
result crown_keeps_to_the_bounds
awk -v ball="$ball" 'BEGIN { exit !(ball <= 0 && ball > -0.2) }'
result crown_fills_the_mesh_and_no_more

"$RAMIFY" render torn.yaml -o torn.png 2>err
result open_mesh_renders
grep -qF "torn.obj: the mesh is open: 12 edges" err
result open_mesh_warns_by_name
[ -s torn.png ]
result open_mesh_gives_a_picture
"$RAMIFY" grow torn.yaml -o torn.json -q 2>err && crown torn.json >err
read -r nodes box ball <err
[ "$nodes" -gt 300 ] && awk -v ball="$ball" 'BEGIN { exit !(ball <= 0) }'
result open_mesh_holds_the_crown

"$RAMIFY" render cut.yaml -o cut.png 2>err
[ $? -eq 2 ] && grep -qF "cut.obj" err && grep -qF "no triangles" err && [ ! -e cut.png ]
result truncated_mesh_is_refused
"$RAMIFY" render absent.yaml -o absent.png 2>err
[ $? -eq 2 ] && grep -qF "absent.yaml:14:40: " err && grep -qF "absent.obj" err && [ ! -e absent.png ]
result absent_mesh_is_refused

# A mesh that the reader itself crashes on: brackets nested two hundred thousand deep.
awk 'BEGIN { printf "{\"asset\":"; for (i = 0; i < 200000; i++) printf "[" }' >deep.gltf
cat >deep.yaml <<'END_OF_SCENE'
film: {width: 40, height: 40}
objects:
  - {name: thing, mesh: {file: deep.gltf}}
END_OF_SCENE
echo "an old picture" >deep.png
"$RAMIFY" render deep.yaml -o deep.png 2>err
[ $? -eq 2 ] && grep -qF "deep.yaml:3:32: object 'thing': deep.gltf: the reader crashed (Segmentation fault); a whole OBJ" err
result crash_of_the_reader_is_an_error
[ "$(cat deep.png)" = "an old picture" ] && [ "$(ls deep.* | wc -l)" -eq 3 ]
result crash_of_the_reader_harms_no_file
