#!/bin/sh
# Mesh files in the hands of other programs: the Khronos glTF validator finds nothing wrong, Blender and Assimp read what
# was written. RAMIFY names the binary, RAMIFY_PEERS the folder of node_modules/. Prints "ok NAME", "not ok NAME" or
# "skipped NAME: why" for each case.
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
export RAMIFY_PEERS="${RAMIFY_PEERS:-$PWD/build/peers}"
here=$PWD/tests/peers
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

tree='height: 3
      crown: {lobes: 0, growth: {levels: [{attractors: 20, step: 0.1, kill: 0.4, influence: 4}, {attractors: 300}]}}'
cat >bare.yaml <<END
seed: 3
sky: {kind: sun_sky}
objects:
  - name: tree
    tree:
      $tree
      leaves: {max_count: 0}
END
cat >leafy.yaml <<END
seed: 3
sky: {kind: sun_sky}
lights:
  - {kind: quad, corner: [-2.5, 3.2, 0], edge_u: [2.5, 0, 0], edge_v: [0, 0.6, 1.5], radiance: [7, 6.6, 6]}
  - {kind: sphere, center: [2.2, 2.4, 2], radius: 0.3, radiance: [14, 17, 22]}
objects:
  - name: tree two
    tree:
      $tree
      leaves: {max_count: 300}
  - {name: floor, ground: {radius: 5, flat_radius: 2, grass_tufts: 50, fallen_leaves: 20}}
END
cat >land.yaml <<END
sky: {kind: night, moon: 1}
materials:
  - {name: mountain, kind: diffuse, color: [0.135, 0.128, 0.124], color2: [0.072, 0.07, 0.07], pattern: mountain, pattern_scale: 50, snow_line: 0.6}
objects:
  - {name: range, material: mountain, terrain: {size: 6000, relief: 650, resolution: 64, rivers: {count: 60}}}
END
# Trees on a slope lean with it: a shear, which glTF says by two nodes.
cat >slope.yaml <<END
seed: 4
objects:
  - {name: floor, ground: {relief: 6, wavelength: 60, flat_radius: 6, grass_tufts: 0, fallen_leaves: 0, trees: {count: 0}}}
  - {name: forest, forest: {height: 8, spacing: 4, stand_trees: 2, stands: 1, radius: 20, glade: 4, density: 1, ferns: 20, leaves: {max_count: 200}, growth: {levels: [{attractors: 30}]}}}
END
# Light that is stronger in the main channel than in the others.
cat >bolt.yaml <<END
seed: 5
objects:
  - {name: bolt, lightning: {streamers: 1}}
END
# Every kind of material; a texture with transparency from another file, one that is no PNG.
cat >materials.yaml <<END
sky: {kind: constant, color: 0.2}
materials:
  - {name: matt, kind: diffuse, color: [0.7, 0.2, 0.12], roughness: 0.9}
  - {name: metal, kind: conductor, color: [0.95, 0.72, 0.38], roughness: 0.25}
  - {name: frosted, kind: dielectric, roughness: 0.3, scattering: [2, 2, 3]}
  - {name: glass, kind: dielectric, roughness: 0, ior: 1.5, absorption: [1.5, 0.3, 0.2]}
  - {name: coated, kind: principled, color: [0.1, 0.22, 0.6], roughness: 0.2, specular: 0.8, metallic: 0.3}
  - {name: sheet, kind: leaf, color: [0.15, 0.3, 0.06], transmittance: [0.2, 0.4, 0.05], pattern: leaf}
  - {name: lamp, kind: emission, radiance: [40, 30, 10]}
  - {name: dim, kind: emission, radiance: [0.4, 0.3, 0.1]}
  - {name: film, kind: thin_film}
  - {name: pictured, kind: diffuse, color: 1, texture: color.png, alpha_texture: holes.png}
  - {name: plain picture, kind: principled, color: 1, texture: color.png}
  - {name: other picture, kind: principled, color: 1, texture: color.ppm}
  - {name: picture nowhere, kind: diffuse, texture: color.png}
objects:
END
x=0
for name in matt metal frosted glass coated sheet lamp dim film "picture nowhere"; do # spheres have no coordinates for one
    echo "  - {name: $name, material: $name, shape: {envelope: [{shape: sphere, size: 0.4, position: [$x, 0, 0]}]}}" >>materials.yaml
    x=$((x + 1))
done
for name in pictured "plain picture" "other picture"; do
    echo "  - {name: $name, material: $name, mesh: {file: card.obj, position: [$x, 0, 0]}}" >>materials.yaml
    x=$((x + 1))
done
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n' >card.obj
printf 'P3\n2 2\n255\n255 0 0  0 255 0\n0 0 255  255 255 0\n' >color.ppm
printf 'P2\n4 4\n255\n0 255 255 0\n255 255 255 255\n255 255 255 255\n0 255 255 0\n' >holes.pgm

# export NAME FILE ARGUMENT...: writes FILE and FILE.json; a failure shows in whatever reads them.
export_file() {
    file=$1
    shift
    "$RAMIFY" export "$@" -o "$file" --json -q >"$file.json" 2>err || { echo "not ok export_$file"; cat err; }
}
have() { command -v "$1" >/dev/null; }

if have oiiotool; then
    oiiotool color.ppm -o color.png && oiiotool holes.pgm -o holes.png
    export_file materials.glb materials.yaml
fi
for format in glb obj ply stl; do export_file "bare.$format" bare.yaml; done
export_file leafy.glb leafy.yaml
export_file nodes.glb leafy.yaml --instances nodes
export_file gpu.glb leafy.yaml --instances gpu
export_file flat.glb leafy.yaml --instances flat --colors pattern
for format in obj ply stl; do export_file "leafy.$format" leafy.yaml; done
export_file bolt.glb bolt.yaml
export_file bolt.usda bolt.yaml
export_file slope.glb slope.yaml --object forest
export_file growth.glb bare.yaml --colors growth
export_file none.glb bare.yaml --colors none
export_file land.glb land.yaml

# ---- the Khronos validator

checked="bare leafy nodes gpu flat bolt slope growth none land$(have oiiotool && echo " materials")"
if have node && [ -d "$RAMIFY_PEERS/node_modules/gltf-validator" ]; then
    for name in $checked; do
        if node "$here/validate_gltf.js" "$name.glb" >log 2>&1; then echo "ok gltf_validator_$name"; else
            echo "not ok gltf_validator_$name"
            cat log
        fi
    done
    # What it remarks upon: coordinates that no texture needs yet, and the extension that it does not know.
    node "$here/validate_gltf.js" $(printf '%s.glb ' $checked) 2>&1 | grep '^    ' |
        grep -v 'UNUSED_OBJECT .*TEXCOORD_0' | grep -v 'UNSUPPORTED_EXTENSION .*EXT_mesh_gpu_instancing' |
        grep -v 'UNUSED_OBJECT /\(accessors\|bufferViews\)/' >log
    if [ -s log ]; then echo "not ok gltf_validator_has_no_other_remarks"; cat log; else echo "ok gltf_validator_has_no_other_remarks"; fi
else
    echo "skipped gltf_validator: Node.js or gltf-validator is not installed"
fi

# ---- Blender

# Blender takes the prefix of its Python from the first one in PATH; one that is not Debian's lacks Debian's NumPy.
if have blender; then
    PATH=/usr/bin:/bin blender -b --factory-startup --python "$here/blender_meshes.py" -- "$folder" \
        blender_glb:bare.glb:bare.glb.json:closed,colored,lit,normals=bare.ply \
        blender_obj:bare.obj:bare.obj.json:closed,normals=bare.ply \
        blender_ply:bare.ply:bare.ply.json:closed,colored \
        blender_stl:bare.stl:bare.stl.json:closed \
        blender_glb_instances:nodes.glb:nodes.glb.json:instances,lit \
        blender_glb_merged:leafy.glb:leafy.glb.json:lit,objects=80 \
        blender_glb_flat:flat.glb:flat.glb.json:lit \
        blender_glb_glow:bolt.glb:bolt.glb.json:glow=bolt.usda \
        blender_glb_sheared:slope.glb:slope.glb.json:instances \
        blender_obj_instances:leafy.obj:leafy.obj.json: \
        blender_land:land.glb:land.glb.json:colored,lit \
        $(have oiiotool && echo blender_materials:materials.glb:materials.glb.json:textured) \
        >log 2>err
    grep -E '^(ok|not ok) ' log || { echo "not ok blender"; cat log err; }
else
    echo "skipped blender: blender is not installed"
fi
