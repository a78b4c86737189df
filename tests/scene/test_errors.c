// Scenes and meshes that are wrong, and the exact words they are refused with.
#include "render/material/material.h"
#include "scene_fixture.h"

#include "base/memory.h"
#include "scene/build.h"

// What follows the file's name: ":line:column: message" or ": message".
typedef struct Case {
    const char *text, *message;
} Case;

#define TREE "objects: [{name: a, tree: }]\n"

static const Case scenes[] = {
    // not YAML
    {"", ": the file is empty; a scene needs at least 'objects:' with one object"},
    {"# only a comment\n",
     ": the file is empty; a scene needs at least 'objects:' with one object"},
    {"a: [1, 2\n", ":2:1: not valid YAML: did not find expected ',' or ']' while parsing a flow "
                   "sequence; check indentation, brackets and quotes here and just above"},
    {"\tseed: 1\n",
     ":1:1: not valid YAML: found character that cannot start any token while scanning for the "
     "next token; indent with spaces, not tabs, and quote texts with special characters"},
    {"seed: \x01\n", ": not a text file: control characters are not allowed at byte 6; a scene is "
                     "YAML text in UTF-8"},
    {"seed: \xff\n", ": not a text file: invalid leading UTF-8 octet at byte 6; a scene is YAML "
                     "text in UTF-8"},
    {"seed: 1\n--- \nseed: 2\n",
     ":3:1: a second YAML document; a scene file must hold one document"},
    {"seed: !!int 4\n",
     ":1:7: tag 'tag:yaml.org,2002:int'; tags are not supported, write the plain value"},
    {"objects: *x\n",
     ":1:10: alias '*x' has no anchor; write '&x' before the value to repeat, above"},
    {"a: &a [*a]\n",
     ":1:8: alias '*a' has no anchor; write '&a' before the value to repeat, above"},
    {"? [1]\n: 2\n", ":1:3: a key is not text; keys must be plain words"},
    {"camera: {<<: 3}\n",
     ":1:14: the merge key '<<' needs a mapping or a list of mappings, usually an alias"},
    {"seed: 1\nseed: 2\n", ":2:1: duplicate key 'seed'; it is already in line 1, remove one"},
    // keys
    {"sed: 1\n" TREE, ":1:1: unknown key 'sed' in the scene; did you mean 'seed'?"},
    {TREE "camera: {heigth: 3}\n",
     ":2:10: unknown key 'heigth' in camera; known: position, target, up, fov, focal_length, "
     "aperture, focus_distance, shift"},
    {"objects: [{name: oak, tree: {leaves: {shape: palmate, lobes: 17}}}]\n",
     ":1:62: objects.oak.tree.leaves.lobes is 17; a palmate leaf has at most 15 lobes"},
    {"objects: [{name: a, snow_crystal: {life: [{at: 0.1, temperature: -15, supersaturation: 0.1}, "
     "{at: 1, temperature: -6, supersaturation: 0.1}]}}]\n",
     ":1:42: objects.a.snow_crystal.life comes from -10 degrees, where crystals are flat, to "
     "-9.99, "
     "where they are columns; columns on plates are not made, only plates on columns: let columns "
     "come first"},
    {"objects: [{name: oak, tree: {leaves: {max_cuont: 5}}}]\n",
     ":1:39: unknown key 'max_cuont' in objects.oak.tree.leaves; did you mean 'max_count'?"},
    {"objects: [{name: oak, tree: {transform: 5}}]\n",
     ":1:30: unknown key 'transform' in objects.oak.tree; known: species, position, height, age, "
     "grown_by, light, seed, season, latitude, phenology, snow, hoar, veteran, hazards, trunk, "
     "crown, "
     "roots, "
     "elbows, radii, "
     "leaves, "
     "organs, skin"},
    {"{}", ":1:1: the scene has no 'objects'; this key is required: Objects of the scene."},
    {"objects: [{tree: }]",
     ":1:11: objects.0 has no 'name'; this key is required: Unique name, used in messages, targets "
     "and paths of keys. The object's random numbers depend on it."},
    {"objects: [{name: a, mesh: }]", ":1:27: objects.a.mesh has no 'file'; this key is required: "
                                     "OBJ, PLY, STL, glTF, GLB or VDB file, "
                                     "relative to the scene's folder."},
    {TREE "sky: {kind: environment}\n",
     ":2:6: sky has no 'file'; this key is required: Latitude-longitude HDR panorama (.hdr, .exr), "
     "relative to the scene's folder."},
    {TREE "clouds: [{kind: grid}]\n",
     ":2:10: clouds.0 has no 'file'; this key is required: VDB file with a grid of floats: a fog "
     "volume's values, or the inside of a level set."},
    {TREE "clouds: [{kind: grid, file: c.vdb, cover: 1}]\n",
     ":2:36: key 'cover' does not apply to clouds.0 of kind 'grid'; known: kind, file, grid, "
     "position, rotation, scale, extinction, albedo"},
    {TREE "clouds: [{kind: stratus, softness: 1}]\n",
     ":2:26: key 'softness' does not apply to clouds.0 of kind 'stratus'; known: kind, base, "
     "thickness, cover, size, extinction, albedo, wind, seed, resolution"},
    {TREE "clouds: [{kind: cumulus, shelf: 1}]\n",
     ":2:26: key 'shelf' does not apply to clouds.0 of kind 'cumulus'; known: kind, base, "
     "thickness, cover, size, extinction, albedo, softness, wind, seed, resolution"},
    {TREE "clouds: [{kind: fog, over: b}]\n",
     ":2:28: clouds.0.over: there is no object 'b'; did you mean 'a'?"},
    {TREE "clouds: [{kind: fog, over: a}]\n",
     ":2:28: clouds.0.over: object 'a' is of the kind tree; it must be a terrain"},
    {"objects: [{name: a, scatter: {afloat: true, things: [{stone: {}}]}}]\n",
     ":1:39: objects.a.scatter.afloat is true; then in_water must be true, too"},
    {"objects: [{name: a, scatter: {beyond: 1, things: [{stone: {}}]}}]\n",
     ":1:39: objects.a.scatter.beyond is 1; 'on' must name the terrain whose copies it is about"},
    {TREE "clouds: [{kind: spray, over: a}]\n", ":2:30: clouds.0.over: object 'a' is of the kind "
                                                "tree; it must be a terrain with waterfalls, a "
                                                "cascade or a sea with a bed"},
    {TREE "clouds: [{kind: spray}]\n", ":2:10: clouds.0: spray needs the key 'over': the terrain "
                                       "with waterfalls, the cascade, or the "
                                       "sea with a bed, that throws it up"},
    {"objects: [{name: a, cascade: {over: b, from: [1, 2, 3], to: [1, 0, 3]}}]\n",
     ":1:61: objects.a.cascade.to is where 'from' is, seen from above; they must lie apart, for "
     "the water leaves their line at a right angle"},
    {TREE "sky: {kind: constant, turbidity: 3}\n",
     ":2:23: key 'turbidity' does not apply to sky of kind 'constant'; known: kind, color, "
     "strength, visible, haze_distance"},
    {TREE "lights: [{kind: sphere, corner: [0, 0, 0]}]\n",
     ":2:25: key 'corner' does not apply to lights.0 of kind 'sphere'; known: kind, radiance, "
     "center, radius"},
    // types
    {"- 1\n",
     ":1:1: the scene is a list; it must be a mapping of seed, grow_to, camera, film, render, sky, "
     "medium, clouds, showers, lights, materials, objects, targets, animation, golden"},
    {"objects: 3\n", ":1:10: objects is 3; it must be a list of mappings ('- ' before each)"},
    {"objects: []\n", ":1:10: objects has 0 entries; it must have 1 to 10000"},
    {TREE "camera: {fov: wide}\n", ":2:15: camera.fov is 'wide'; it must be a number"},
    {TREE "camera: {fov: \"40\"}\n", ":2:15: camera.fov is the text \"40\"; it must be a number"},
    {TREE "camera: {fov: [4]}\n", ":2:15: camera.fov is a list; it must be a number"},
    {TREE "camera: {fov: }\n", ":2:15: camera.fov is empty; it must be a number"},
    {TREE "camera: {position: 3}\n", ":2:20: camera.position is 3; it must be a list of 3 numbers"},
    {TREE "camera: {position: [1, 2]}\n",
     ":2:20: camera.position has 2 entries; it must be a list of 3 numbers"},
    {TREE "camera: {position: [1, 2, far]}\n",
     ":2:27: camera.position[2] is 'far'; it must be a number"},
    {TREE "film: {width: 3.5}\n", ":2:15: film.width is 3.5; it must be a whole number"},
    {TREE "film: {denoise: maybe}\n", ":2:17: film.denoise is 'maybe'; it must be true or false"},
    {TREE "film: {filter: gausian}\n", ":2:16: film.filter is 'gausian'; did you mean 'gaussian'?"},
    {TREE "sky: {kind: sun}\n",
     ":2:13: sky.kind is 'sun'; known: sun_sky, environment, constant, night, none"},
    {TREE "materials: [{name: x, color: \"#12345\"}]\n",
     ":2:30: materials.x.color is the text \"#12345\"; it must be [red, green, blue], one number "
     "for a grey, or \"#rrggbb\" in quotes"},
    {"objects: [{name: , tree: }]\n", ":1:18: objects.0.name is empty; it must be a text"},
    // ranges
    {TREE "camera: {fov: .nan}\n",
     ":2:15: camera.fov is .nan; it must be greater than 0 and less than 180 degrees"},
    {TREE "camera: {fov: 180}\n",
     ":2:15: camera.fov is 180; it must be greater than 0 and less than 180 degrees"},
    {TREE "camera: {position: [0, -.inf, 0]}\n",
     ":2:24: camera.position[1] is -.inf; it must be a finite number (m)"},
    {TREE "camera: {position: [0, 1e39, 0]}\n",
     ":2:24: camera.position[1] is 1e39; it must be a finite number (m)"},
    {TREE "seed: -1\n", ":2:7: seed is -1; it must be a whole number, at least 0 and below 2^64"},
    {TREE "seed: 99999999999999999999\n", ":2:7: seed is 99999999999999999999; it must be a whole "
                                          "number, at least 0 and below 2^64"},
    {"objects: [{name: a, tree: {radii: {tip: -0.1}}}]\n",
     ":1:41: objects.a.tree.radii.tip is -0.1; it must be greater than 0 and at most 10 m"},
    {"objects: [{name: a, tree: {height: -1}}]\n",
     ":1:36: objects.a.tree.height is -1; it must be at least 0 and at most 1000 m"},
    {"objects: [{name: a, tree: {leaves: {spacing: 1.0e-30}}}]\n",
     ":1:46: objects.a.tree.leaves.spacing is 1.0e-30; it must be at least 0.0001 and at most 100 "
     "m"},
    {"objects: [{name: a, tree: {crown: {growth: {levels: [{attractors: 0}]}}}}]\n",
     ":1:67: objects.a.tree.crown.growth.levels.0.attractors is 0; it must be a whole number, at "
     "least 1 and at most 2147483647"},
    {"objects: [{name: a, tree: {crown: {growth: {levels: [{attractors: 1000000000000}]}}}}]\n",
     ":1:67: objects.a.tree.crown.growth.levels.0.attractors is 1000000000000; it must be a whole "
     "number, at least 1 and at most 2147483647"},
    {TREE "film: {width: 0}\n",
     ":2:15: film.width is 0; it must be a whole number, at least 1 and at most 65536 pixels"},
    {TREE "film: {width: 65536, height: 65536}\n",
     ":2:15: film has 4295 million pixels; it must have at most 100 million"},
    // things that do not go together
    {TREE "camera: {fov: 40, focal_length: 35}\n",
     ":2:33: camera has both fov and focal_length; give one"},
    {TREE "camera: {target: [0, 1.7, 10]}\n",
     ":2:18: camera.target is the camera's position; it must be another point"},
    {TREE "camera: {up: [0, 0, 1]}\n",
     ":2:14: camera.up is zero or parallel to the line of sight; it must have another direction"},
    {TREE "film: {png_depth: 12}\n", ":2:19: film.png_depth is 12; it must be 8 or 16"},
    {TREE "film: {width: 30, height: 20, downsample: 4}\n",
     ":2:43: film.downsample is 4; it must divide the width of 30 and the height of 20 pixels"},
    {TREE "film: {crop: [0.5, 0, 0.5, 1]}\n",
     ":2:14: film.crop is empty; it must be [x0, y0, x1, y1] with x0 < x1, y0 < y1"},
    {TREE "film: {width: 2, height: 2, crop: [0, 0, 1, 0.2]}\n",
     ":2:35: film.crop is less than half a pixel wide or high; make it larger"},
    {TREE "lights: [{kind: quad, edge_u: [0, 0, 2]}]\n",
     ":2:31: lights.0 has edges that span no area; they must not be parallel or zero"},
    {"objects: [{name: a}]\n",
     ":1:11: objects.a has no kind; it must have one of tree, coral, lsystem, vessels..."},
    {"objects: [{name: a, tree: {}, ground: {}}]\n",
     ":1:39: objects.a is both a tree and a ground; split it into two objects"},
    {"objects: [{name: a.b, tree: }]\n",
     ":1:18: object name 'a.b' is invalid; use at most 63 letters, digits, spaces, - and _, and do "
     "not begin with a digit"},
    {"objects: [{name: a, tree: }, {name: a, ground: }]\n",
     ":1:37: object name 'a' is already used in line 1; names must be unique"},
    {"objects: [{name: a, tree: , material: barc}]\n",
     ":1:39: objects.a.material: there is no material 'barc'; did you mean 'bark'?"},
    {"objects: [{name: a, tree: , leaf_material: gold}]\n",
     ":1:44: objects.a.leaf_material: there is no material 'gold'; known: bark, twig, leaf, "
     "grass, clay, snow..."},
    {"objects: [{name: a, tree: , grass_material: grass}]\n",
     ":1:45: objects.a: a tree has no grass_material; remove this key"},
    {"objects: [{name: a, tree: {height: 5, crown: {base: 5}}}]\n",
     ":1:53: objects.a.tree.crown.base is 5 m; it must be below the tree's height, 5 m"},
    {"objects: [{name: a, tree: {crown: {growth: {levels: [{attractors: 5, kill: 3}]}}}}]\n",
     ":1:76: objects.a.tree.crown.growth.levels.0.kill is 3; it must be less than influence, 2.2, "
     "or attractors are removed before they pull"},
    {"objects: [{name: a, tree: {light: {attractors: {reach: 2, occupied: 3}}}}]\n",
     ":1:69: objects.a.tree.light.attractors.occupied is 3; it must be at most reach, 2 "
     "internodes, "
     "or attractors are taken before they draw a bud"},
    {"objects: [{name: a, tree: {crown: {envelope: [{shape: box, op: difference}]}}}]\n",
     ":1:47: objects.a.tree.crown.envelope begins with a difference; the first shape must be a "
     "union"},
    {"objects: [{name: a, tree: {crown: {fields: [{kind: nuclei, nuclei: [{kind: line, position: "
     "[0, 1, 0], end: [0, 1, 0]}]}]}}}]\n",
     ":1:108: objects.a.tree.crown.fields.0.nuclei.0.end equals position; a line needs two "
     "different ends, or use kind: point"},
    {"objects: [{name: a, terrain: {form: fjord}}]\n",
     ":1:37: objects.a.terrain.form is 'fjord'; known: rivers, ridges, map, "
     "noise, survey, canyon, mesas, alps, volcano, dunes, hills, badlands, coast, braided, "
     "karst, meander, delta"},
    {"objects: [{name: a, terrain: {form: canyon, evolution: {cells: 700}}}]\n",
     ":1:64: objects.a.terrain.evolution.cells is 700; it must be a power of two, such as 1024"},
    {"objects: [{name: a, terrain: {joints: {spacing: 150, angle: 10}}}]\n",
     ":1:61: objects.a.terrain.joints.angle is 10; it must be at least 30 and at most 150 "
     "degrees"},
    {"objects: [{name: a, terrain: {form: meander, size: 4096, resolution: 64, meander: {width: "
     "40}}}]\n",
     ":1:91: objects.a.terrain.meander.width is 40 m, less than a cell of the terrain, 64 m; a "
     "river "
     "must be at least a cell wide"},
    {"objects: [{name: a, terrain: {form: delta, size: 8000, delta: {width: 100}}}]\n",
     ":1:71: objects.a.terrain.delta.width is 100 m; in a terrain of 8000 m a river that builds a "
     "delta is 125 to 500 m wide"},
    {"objects: [{name: a, terrain: {lakes: {count: 3}, water_level: 0.1}}]\n",
     ":1:46: objects.a.terrain.lakes.count is 3, and water_level 0.1; land has lakes at their own "
     "levels or one water level"},
    {"objects: [{name: a, terrain: {form: alps, tiles: {drawn: true}}}]\n",
     ":1:58: objects.a.terrain.tiles.drawn is true, but tiles.count is 0; give a number of tiles, "
     "such as 16"},
    {"objects: [{name: a, terrain: {resolution: 16, tiles: {count: 32, drawn: true}}}]\n",
     ":1:73: objects.a.terrain.tiles.drawn is true; that needs at most as many tiles a side as the "
     "terrain has cells, 16, not 32"},
    {"objects: [{name: a, terrain: {beyond: 1, forest: {count: 9, beyond: 2}}}]\n",
     ":1:69: objects.a.terrain.forest.beyond is 2, but the terrain's own beyond is 1; that must be "
     "as much at least"},
    {"objects: [{name: a, terrain: {form: delta, beyond: 1, forest: {count: 9, beyond: 1}}}]\n",
     ":1:82: objects.a.terrain.forest.beyond is 1; around a delta there are no copies of the "
     "square"},
    {"objects: [{name: a, terrain: {show: map, tiles: {count: 16, drawn: true}}}]\n",
     ":1:68: objects.a.terrain.tiles.drawn is true; a map (show: map or tree) is flat and is not "
     "drawn of tiles"},
    {"objects: [{name: a, terrain: {form: dunes, lakes: {count: 3}}}]\n",
     ":1:59: objects.a.terrain.lakes.count is 3; forms braided, meander, delta, dunes and coast "
     "have no "
     "lakes"},
    {"objects: [{name: a, terrain: {lakes: {altitude: [0.7, 0.4]}}}]\n",
     ":1:49: objects.a.terrain.lakes.altitude is [0.7, 0.4]; the first must not exceed the second"},
    {"objects: [{name: a, terrain: {form: map}}]\n",
     ":1:30: objects.a.terrain.map.image is missing; form: map needs an image"},
    {"objects: [{name: a, terrain: {ridges: {lift: [{distance: 0, height: 1}, {distance: 0, "
     "height: 0}]}}}]\n",
     ":1:73: objects.a.terrain.ridges.lift.1 is at the distance 0, the point before it at 0; "
     "distances must ascend"},
    {"objects: [{name: a, terrain: {ridges: {lift: [{distance: 0, height: 1}, {distance: 0.5, "
     "height: -1}]}}}]\n",
     ":1:73: objects.a.terrain.ridges.lift.1 has the height -1, one before it 1; all heights must "
     "be positive, or all negative"},
    {"objects: [{name: a, terrain: {rivers: {file: /etc/passwd, image: /etc/passwd}}}]\n",
     ":1:66: objects.a.terrain.rivers.image: the tree already comes from a file; give a file or an "
     "image"},
    {"objects: [{name: a, terrain: {ridges: {file: no.swc}}}]\n",
     ":1:46: objects.a.terrain.ridges.file: cannot read 'no.swc': No such file or directory; paths "
     "are relative to the scene's folder"},
    {"materials: [{name: a/b}]\n" TREE,
     ":1:20: materials.a/b.name has a slash, as built-in materials' names may have and others may "
     "not; use another character"},
    {"materials: [{name: m, pattern: altitude, colors: [{at: 0.5, color: [1, 1, 1]}, {at: 0.2, "
     "color: [0, 0, 0]}]}]\n" TREE,
     ":1:80: materials.m.colors.1 is at the altitude 0.2, the one before it at 0.5; altitudes must "
     "ascend"},
    {"objects: [{name: a, tree: {crown: {fields: [{kind: nuclei, nuclei: [{kind: line}]}]}}}]\n",
     ":1:69: objects.a.tree.crown.fields.0.nuclei.0 has no 'position'; this key is required: The "
     "point, or the line's start, in the scene's space."},
    {"objects: [{name: a, tree: {crown: {fields: [{kind: nuclei, nuclei: [{kind: surface}]}]}}}]\n",
     ":1:69: objects.a.tree.crown.fields.0.nuclei.0 has no 'envelope'; this key is required: "
     "Shapes, combined in this order. Their surface is represented by 20,000 points."},
    {"objects: [{name: a, tree: {crown: {fields: [{kind: nuclei, nuclei: [{kind: surface, "
     "envelope: [{shape: half_space}]}]}]}}}]\n",
     ":1:96: objects.a.tree.crown.fields.0.nuclei.0.envelope: a half_space is unbounded; its op "
     "must be difference or intersection"},
    {"objects: [{name: a, tree: {crown: {fields: [{kind: vortex, nuclei: [{kind: point, position: "
     "[0, 0, 0]}]}]}}}]\n",
     ":1:60: key 'nuclei' does not apply to objects.a.tree.crown.fields.0 of kind 'vortex'; known: "
     "kind, weight, vector, center"},
    {"objects: [{name: a, tree: {crown: {fields: [{kind: nuclei, nuclei: [{kind: point, position: "
     "[0, 0, 0], end: [0, 1, 0]}]}]}}}]\n",
     ":1:104: key 'end' does not apply to objects.a.tree.crown.fields.0.nuclei.0 of kind 'point'; "
     "known: kind, position, normal"},
    {"objects: [{name: a, shape: {envelope: [{shape: half_space}]}}]\n",
     ":1:40: objects.a.shape.envelope: a half_space is unbounded; its op must be difference or "
     "intersection"},
    {"objects: [{name: a, shape: {envelope: [{shape: sphere, blend: 0.1}]}}]\n",
     ":1:63: objects.a.shape.envelope: there is no shape before the first to flow into; blend: 0 "
     "leaves the edge sharp"},
    {"objects: [{name: a, shape: {envelope: [{shape: cone, size: [0, 1, 1]}]}}]\n",
     ":1:60: objects.a.shape.envelope.0.size: radius below and height of a cone must be greater "
     "than 0 m"},
    {"objects: [{name: a, shape: {envelope: [{shape: box, scale: [1, 0, 1]}]}}]\n",
     ":1:60: objects.a.shape.envelope.0.scale has a 0; every factor must differ from 0"},
    {"objects: [{name: a, ground: {radius: 10, flat_radius: 10}}]\n",
     ":1:55: objects.a.ground.flat_radius is 10 m; it must be less than the radius, 10 m"},
    // files
    {"objects: [{name: a, mesh: {file: nope.ply}}]\n",
     ":1:34: objects.a.mesh.file: cannot read 'nope.ply': No such file or directory; paths are "
     "relative to the scene's folder"},
    {"objects: [{name: a, mesh: {file: /tmp}}]\n",
     ":1:34: objects.a.mesh.file: '/tmp' is a folder; it must be a file"},
    // what growth would refuse after minutes
    {"objects: [{name: a, tree: {skin: {ring_spacing: 0.05}}}]\n",
     ":1:49: objects.a.tree.skin.ring_spacing is 0.05; it must be at least 0.1 and "
     "at most 100 radii"},
    {"objects: [{name: a, tree: {crown: {points: {anchored: true, pattern: poisson}}}}]\n",
     ":1:55: objects.a.tree.crown.points.anchored: anchored points cannot be evenly spaced; use "
     "the pattern random, or anchored: false"},
    {"objects: [{name: a, tree: {crown: {growth: {rule: sectors, sector_angle: 9}}}}]\n",
     ":1:74: objects.a.tree.crown.growth.sector_angle: sector angle 9 makes more than 64 sectors; "
     "use a larger angle"},
    {"objects: [{name: a, lsystem: {axiom: \"F[\"}}]\n",
     ":1:38: objects.a.lsystem.axiom: the L-system's axiom, line 1, column 3: '[' is not closed; "
     "put a ']' for each '['"},
    {"objects: [{name: a, coral: {rules: \"q\"}}]\n",
     ":1:36: objects.a.coral.rules: the L-system's rules, line 1, column 2: '->' is missing; a "
     "rule "
     "is written A : condition -> BA"},
    {TREE "materials: [{name: m, texture: bark.jpg}]\n",
     ":2:32: materials.m.texture: cannot read 'bark.jpg': No such file or directory; paths are "
     "relative to the scene's folder"},
};

// Complains about other words and returns 1.
static int expect(const char *what, const Error *e, const char *wanted)
{
    char got[1200];
    error_format(e, got, sizeof got);
    // "..." at the end: a list that goes on
    size_t length = strlen(wanted);
    bool open = length > 3 && strcmp(wanted + length - 3, "...") == 0;
    bool same = open ? strncmp(got, wanted, length - 3) == 0 : strcmp(got, wanted) == 0;
    if (same && e->code == ERROR_INPUT) {
        return 0;
    }
    print_error("%s\n  said   %s\n  wanted %s\n", what, got, wanted);
    return 1;
}

static void bad_scenes_are_refused_in_exact_words(void **state)
{
    (void)state;
    int wrong = 0;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        Error e = {0};
        char wanted[1200];
        Scene *scene =
            scene_read_text(scenes[i].text, strlen(scenes[i].text), "s.yaml", "", NULL, 0, &e);
        if (scene) {
            fail_msg("read without complaint: %s", scenes[i].text);
        }
        snprintf(wanted, sizeof wanted, "s.yaml%s", scenes[i].message);
        wrong += expect(scenes[i].text, &e, wanted);
    }
    assert_int_equal(wrong, 0);
}

static const Case overrides[] = {
    {"camera.fov", ": not an override; write path=value, as in camera.fov=35"},
    {"camera.fov=", ": not an override; write path=value, as in camera.fov=35"},
    {"=3", ": not an override; write path=value, as in camera.fov=35"},
    {"camera..fov=3", ": an empty name in the path; write a.b=value"},
    {"camera.fvo=3", ": unknown key 'fvo' in camera; did you mean 'fov'?"},
    {"camera.fov=190", ": camera.fov is 190; it must be greater than 0 and less than 180 degrees"},
    {"objects.b.seed=3", ": no entry named 'b' in this list; did you mean 'a'?"},
    {"objects.7.seed=3", ": no entry 7 in this list; it has 1, counted from 0"},
    {"objects.a.name.x=3", ": 'x' is below a value that is not a mapping; shorten the path"},
    {"materials.leav.color=0.3", ": there is no material 'leav'; did you mean 'leaf'?"},
    {"materials.leaf.colour=0.3",
     ": unknown key 'colour' in materials.leaf; did you mean 'color'?"},
    {"camera={fov: [}", ": not valid YAML: did not find expected node content while parsing a flow "
                        "node; check indentation, brackets and quotes here and just above"},
};

static void bad_overrides_are_refused_in_exact_words(void **state)
{
    (void)state;
    int wrong = 0;
    for (size_t i = 0; i < sizeof overrides / sizeof overrides[0]; i++) {
        Error e = {0};
        char wanted[1200];
        assert_null(scene_read_text(TREE, strlen(TREE), "s.yaml", "", &overrides[i].text, 1, &e));
        snprintf(wanted, sizeof wanted, "override %s%s", overrides[i].text, overrides[i].message);
        wrong += expect(overrides[i].text, &e, wanted);
    }
    assert_int_equal(wrong, 0);
}

// Built-in materials need not be listed to be changed.
static void built_in_materials_can_be_set(void **state)
{
    (void)state;
    static const char *const texts[] = {TREE, TREE "materials:\n",
                                        TREE "materials: [{name: gold, kind: conductor}]\n",
                                        TREE "materials: [{name: leaf, roughness: 0.25}]\n"};
    const char *const set[] = {"materials.leaf.color=0.5", "materials.leaf.specular=0.125"};
    for (int i = 0; i < 4; i++) {
        Error e = {0};
        Scene *scene = scene_read_text(texts[i], strlen(texts[i]), "s.yaml", "", set, 2, &e);
        if (!scene) {
            fail_msg("%s: %s", e.file, e.message);
        }
        const Material *leaf = &scene->materials[scene->material_count - 1];
        assert_int_equal(scene->material_count, i == 2 ? 2 : 1);
        assert_string_equal(leaf->name, "leaf");
        assert_int_equal(leaf->kind, MATERIAL_LEAF);
        assert_true(leaf->color.y == 0.5f && leaf->specular == 0.125f);
        assert_true(i != 3 || leaf->roughness == 0.25f);
        scene_free(scene);
    }
}

// A document that no override can mend is to blame itself.
static void overrides_are_not_blamed_for_the_document(void **state)
{
    (void)state;
    static const char *const texts[] = {"3", "hello", "- 1\n- camera: {fov: 3}\n"};
    const char *set = "camera.fov=3";
    for (int i = 0; i < 3; i++) {
        Error e = {0};
        assert_null(scene_read_text(texts[i], strlen(texts[i]), "s.yaml", "", &set, 1, &e));
        assert_string_equal(e.file, "s.yaml");
        assert_int_equal(e.line, 1);
        assert_int_equal(strncmp(e.message, "the scene is ", 13), 0);
    }
}

typedef struct MeshCase {
    const char *name, *text;
    bool late; // told only when it is built
    const char *message;
} MeshCase;

#define PLY_HEAD                                                                    \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n" \
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"    \
    "end_header\n"

static const MeshCase meshes[] = {
    {"empty.ply", "", false, "the file is empty; a mesh is needed"},
    {"empty.obj", "", false, "the file is empty; a mesh is needed"},
    {"points.obj", "v 0 0 0\nv 1 0 0\nl 1 2\nvn 0 1 0\n# f 1 2 1\n", false,
     "the file holds no triangles; a surface of triangles or polygons is needed"},
    {"cut.ply", PLY_HEAD "0 0 0\n1 0 0\n", false,
     "truncated: the header promises 3 vertices and 1 faces, which need 4 lines, but 2 follow; the "
     "whole file is needed"},
    {"head.ply", "ply\nformat ascii 1.0\n", false,
     "not a PLY file, or its header is cut off; a header from 'ply' to 'end_header' is needed"},
    {"mesh.xyz", "0 0 0\n", false,
     "the name does not end in a mesh format that can be read; .obj, .ply, .stl, .gltf, .glb or "
     ".vdb "
     "would be right"},
    {"nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", true,
     "vertex 1 has a coordinate that is not finite; coordinates must be numbers in metres"},
};

// Reads, and if it must, builds a scene that draws the mesh.
static int refuse_mesh(Fixture *fixture, const MeshCase *mesh)
{
    Error e = {0};
    char scene_path[128], wanted[1200], text[256];
    fixture_write(fixture, mesh->name, mesh->text, strlen(mesh->text));
    snprintf(text, sizeof text, "objects: [{name: a, mesh: {file: %s}}]", mesh->name);
    strcpy(scene_path, fixture_write(fixture, "s.yaml", text, strlen(text)));
    Scene *scene = scene_read(scene_path, NULL, 0, &e);
    assert_int_equal(scene != NULL, mesh->late);
    if (mesh->late) {
        Run run = run_default();
        assert_null(scene_build(scene, &run, NULL, &e));
        snprintf(wanted, sizeof wanted, "%s:1:34: object 'a': %s/%s: %s", scene_path,
                 fixture->folder, mesh->name, mesh->message);
    } else {
        snprintf(wanted, sizeof wanted, "%s:1:34: objects.a.mesh.file: '%s': %s", scene_path,
                 mesh->name, mesh->message);
    }
    int wrong = expect(mesh->name, &e, wanted);
    scene_free(scene);
    return wrong;
}

static void bad_meshes_are_refused_in_exact_words(void **state)
{
    int wrong = 0;
    for (size_t i = 0; i < sizeof meshes / sizeof meshes[0]; i++) {
        wrong += refuse_mesh(*state, &meshes[i]);
    }
    assert_int_equal(wrong, 0);
}

static void read_failing(const char *path, const char *message)
{
    Error e = {0};
    char wanted[1200];
    assert_null(scene_read(path, NULL, 0, &e));
    snprintf(wanted, sizeof wanted, "%s: %s", path, message);
    assert_int_equal(expect(path, &e, wanted), 0);
}

static void files_that_are_no_scene_are_refused(void **state)
{
    Fixture *fixture = *state;
    read_failing("/tmp", "a folder; name a scene file");
    read_failing("/dev/null", "a device or pipe; name a scene file");
    read_failing("/nope/s.yaml", "cannot read it: No such file or directory; name a scene file");
    read_failing(fixture_write(fixture, "zero.yaml", "a\0b", 3),
                 "not a text file: a NUL at byte 1; a scene is YAML text in UTF-8");
    const char *large = fixture_write(fixture, "large.yaml", "", 0);
    assert_int_equal(truncate(large, 100 << 20), 0);
    read_failing(large, "100.0 MB long; a scene has at most 16 MB");
}

// ---- hostile documents: an error, soon, whatever they are ----

static void refuse_soon(const char *text, const char *ending)
{
    Error e = {0};
    double start = run_seconds();
    assert_null(scene_read_text(text, strlen(text), "s.yaml", "", NULL, 0, &e));
    assert_true(run_seconds() - start < 20.0);
    if (!strstr(e.message, ending)) {
        fail_msg("said %s\nwanted %s", e.message, ending);
    }
}

// a: &a [..], b: &b [*a x 9], c: &c [*b x 9] ...: ten to the tenth values.
static void aliases_cannot_explode(void **state)
{
    (void)state;
    char text[2048] = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 12; i++) {
        size_t used = strlen(text);
        snprintf(text + used, sizeof text - used,
                 "a%d: &a%d [*a%d, *a%d, *a%d, *a%d, *a%d, *a%d, *a%d, *a%d, *a%d]\n", i, i, i - 1,
                 i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1);
    }
    refuse_soon(text, "the aliases of this file expand to too much");
}

static void nesting_is_bounded(void **state)
{
    (void)state;
    enum { DEEP = 200000 };
    char *text = malloc(DEEP + 1);
    memset(text, '[', DEEP);
    text[DEEP] = 0;
    refuse_soon(text, "nested deeper than 64 levels");
    memset(text, '{', DEEP);
    refuse_soon(text, "");
    free(text);
    // depth that only aliases make
    char chain[4096] = "a0: &a0 [[[[[[[[[[x]]]]]]]]]]\n";
    for (int i = 1; i < 20; i++) {
        size_t used = strlen(chain);
        snprintf(chain + used, sizeof chain - used, "a%d: &a%d [[[[[[[[[[*a%d]]]]]]]]]]\n", i, i,
                 i - 1);
    }
    refuse_soon(chain, "nested deeper than 64 levels");
}

static void long_documents_are_read_in_linear_time(void **state)
{
    (void)state;
    enum { COUNT = 300000 };
    char *text = malloc(COUNT * 12 + 100), *at = text;
    at += sprintf(at, "objects: [");
    for (int i = 0; i < COUNT; i++) {
        at += sprintf(at, "{a%d: 1},", i % 100);
    }
    sprintf(at, "]");
    refuse_soon(text, "objects has 300000 entries; it must have 1 to 10000");
    at = text;
    for (int i = 0; i < 2000; i++) {
        at += sprintf(at, "k%d: 1\n", i);
    }
    refuse_soon(text, "more than 1000 keys in one mapping");
    free(text);
}

// Whatever bytes come, the reader returns; the sanitizers see that it does so cleanly.
static void mangled_scenes_are_survived(void **state)
{
    (void)state;
    static const char right[] = "seed: 1\ncamera: &c {position: [0, 1, 9], fov: 3_0}\nobjects:\n"
                                "  - name: a\n    tree: {crown: {envelope: [{shape: box, size: 2}],"
                                " growth: {levels: [{attractors: 9, <<: {step: .2}}]}}}\n"
                                "  - {name: \"b\", ground: ~}\n";
    char text[sizeof right];
    uint64_t random = 12345;
    int read = 0;
    for (int i = 0; i < 3000; i++) {
        memcpy(text, right, sizeof right);
        for (int k = 0; k < 1 + i % 3; k++) {
            random = random * 6364136223846793005ull + 1442695040888963407ull;
            text[(random >> 33) % (sizeof right - 1)] = (char)(random >> 56);
        }
        Error e = {0};
        Scene *scene = scene_read_text(text, sizeof right - 1, "s.yaml", "", NULL, 0, &e);
        read += scene != NULL;
        assert_true(scene || (e.code == ERROR_INPUT && e.message[0]));
        scene_free(scene);
    }
    assert_true(read < 3000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_scenes_are_refused_in_exact_words),
        cmocka_unit_test(bad_overrides_are_refused_in_exact_words),
        cmocka_unit_test(built_in_materials_can_be_set),
        cmocka_unit_test(overrides_are_not_blamed_for_the_document),
        cmocka_unit_test_setup_teardown(bad_meshes_are_refused_in_exact_words, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(files_that_are_no_scene_are_refused, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test(aliases_cannot_explode),
        cmocka_unit_test(nesting_is_bounded),
        cmocka_unit_test(long_documents_are_read_in_linear_time),
        cmocka_unit_test(mangled_scenes_are_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
