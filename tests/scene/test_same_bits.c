// One small object of each kind, grown and skinned: its bits are those that were recorded, with any
// compiler's options and on any machine. Whoever means to change growth records what the failing
// test prints.
#include "scene/geometry_hash.h"
#include "testing.h"

#include "scene/builder.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static uint64_t hash_of(const char *object)
{
    char text[1024];
    Error e = {0};
    snprintf(text, sizeof text, "seed: 3\nobjects:\n  - name: a\n    %s\n", object);
    Scene *scene = scene_read_text(text, strlen(text), "s.yaml", "", NULL, 0, &e);
    Run run = run_default();
    BuildStats stats = {0};
    World *world = scene ? scene_build(scene, &run, &stats, &e) : NULL;
    if (!world) {
        fail_msg("%s: %s", object, e.message);
    }
    uint64_t hash = geometry_hash(&world->geometry);
    world_free(world);
    scene_free(scene);
    return hash;
}

static void every_kind_has_the_bits_that_were_recorded(void **state)
{
    (void)state;
    static const struct {
        const char *object;
        uint64_t hash;
    } kinds[] = {
        {"tree: {height: 2, crown: {lobes: 0, growth: {levels: [{attractors: 120}]}}, "
         "roots: {count: 3}, radii: {tip: 0.0024}, leaves: {max_count: 50, twig_radius: 0.011}}",
         0xe372e1cb8b2bc5d7},
        {"tree: {height: 4, light: {seasons: 16}, leaves: {max_count: 50}}", 0xc65a69bfa99fa1a8},
        {"tree: {height: 4, light: {seasons: 16, attractors: {count: 400, reach: 20, envelope: "
         "[{shape: ellipsoid, size: [1, 0.6, 1], position: [0.5, 3, 0]}]}}, leaves: {max_count: "
         "50}}",
         0x402623dbf27fc5b4},
        {"forest: {stands: 2, stand_trees: 2, height: 8, ferns: 10, leaves: {max_count: 50}}",
         0x1926e882d6db2c18},
        {"ground: {grass_tufts: 200}", 0x75671227db500027},
        {"ground: {grass_tufts: 200, ponds: [{position: [3, 2]}]}", 0x71af2f31f44db086},
        {"shape: {envelope: [{shape: box, size: [0.1, 0.2, 0.05]}], hoar: {length: 0.02, sky: "
         "0.5}}",
         0x790930f57f94ae71},
        {"shape: {envelope: [{shape: cone, size: [0.06, 0.3, 0.05]}], voxel: 0.004, checks: 0.02, "
         "hoar: {length: 0.02, habit: feathers, variety: 1}}",
         0x1d9a480aaa74ed78},
        {"stone: {resolution: 8}", 0xda5f7a6a48381f4f},
        {"scatter: {count: 40, spacing: 0.3, things: [{stone: {resolution: 4}}, {tree: {species: "
         "oxeye_daisy}}]}",
         0x93cdeb3e350b295a},
        {"tree: {species: bluebell}", 0x2e399edef959b330},
        {"sea: {spokes: 64, extent: 500, time: 3}", 0x19ee0aedc494f2a5},
        {"snow_crystal: {cells: 40, noise: 0.01}", 0x484e898b0f3f885c},
        {"snow_crystal: {cells: 20, noise: 0.1, life: [{at: 0.4, temperature: -6, supersaturation: "
         "0.1}, {at: 0.5, temperature: -15, supersaturation: 0.1}]}",
         0xf298471cb98de047},
        {"frost_flower: {feathers: 8, barbs: 10}", 0x83a50496024e9247},
        {"ice_cracks: {size: 2, grain: 0.02}", 0x36c64a4a3eb79f0f},
        {"eruption: {on: cone, bombs: 20, streams: [{at: [300, 0], length: 400}]}\n  - name: cone\n"
         "    terrain: {form: volcano, size: 9000, relief: 900, resolution: 64}",
         0xf2f9860a295d73b2},
        {"cascade: {over: rock, from: [-0.2, 1.5, 0.2], to: [0.2, 1.5, 0.2]}\n  - name: rock\n"
         "    shape: {envelope: [{shape: sphere}]}",
         0x6305d9f2d52bfceb},
        {"swarm: {count: 40, envelope: [{shape: sphere}], spacing: 0.05, clumping: 0.5, swirl: 90, "
         "roll: 20, things: [{stone: {resolution: 4}}]}",
         0x95ba3767a300744a},
        {"lightning: {height: 10, bolts: 2}", 0xbd6a57f0057ab6b6},
        {"lightning: {points: {place: surface}, envelope: [{shape: sphere, size: 1}]}",
         0xf74b02699ab982c4},
        {"coral: {attractors: 200}", 0x94b4e32eca4fb10e},
        {"coral: {form: massive, attractors: 100}", 0x6cd5c5236530e4fa},
        {"coral: {form: fan, rule: mean, attractors: 200, uneven: 1}", 0x5357bdbec608b5b7},
        {"lsystem: {generations: 4}", 0xb26e7379cdd8e999},
        {"frost: {surface: pane, spines: 40, sides: 400}", 0xf1e223ba3726ed12},
        {"frost: {surface: bubble, spines: 20, sides: 200}", 0x72100e15b56990cd},
        {"dla: {particles: 1000}", 0xb153aa8f718541f4},
        {"sculpture: {attractors: 20}", 0xb7095b46207de548},
        {"venation: {}", 0x88c1ce75c8e51c3b},
        {"venation: {teeth: 20, uneven: 1, wave: 0.002, wear: 1, spots: 1}", 0x5e2a5ef40c72f26b},
        {"vessels: {terminals: 100, envelope: [{shape: sphere, size: 0.1}]}", 0x7cac99eecdf0f5f5},
        {"fracture: {envelope: [{shape: sphere, size: 1}], attractors: 60, resolution: 50}",
         0xedf82202aa939c1e},
        {"terrain: {resolution: 64, rivers: {count: 200}}", 0xfaa674fa934997ce},
        {"terrain: {size: 1500, relief: 400, resolution: 128, rivers: {count: 60, water: 0.02}, "
         "terraces: {count: 6, strength: 1, sheer: 1}}",
         0x59a5c028539aedd8},
        {"terrain: {resolution: 64, size: 4000, rivers: {count: 100, water: 0.03}, lakes: {count: "
         "5, "
         "basins: 3}}",
         0xe3987dbabd4b1d6f},
        {"terrain: {resolution: 64, size: 6000, form: alps, lakes: {count: 9, silt: 0.2}}",
         0xc9808562934924ec},
        {"terrain: {resolution: 64, form: ridges, ridges: {count: 200}}", 0x5986ae362203d199},
        {"terrain: {resolution: 64, form: noise}", 0x3f387f552d79754c},
        {"terrain: {resolution: 64, form: canyon}", 0x3693ad85da528da1},
        {"terrain: {resolution: 64, form: mesas, strata: {dip: 2}}", 0x36558167b5181d99},
        {"terrain: {resolution: 64, form: volcano}", 0x5770cb63e1adf7ff},
        {"terrain: {resolution: 64, form: volcano, volcano: {kind: ash, barrancos: 20}}",
         0x813c21fd3af17b4a},
        {"terrain: {resolution: 64, size: 1000, form: coast}", 0x5f1d9bb2418a7de5},
        {"terrain: {resolution: 64, form: karst, karst: {river: 300}}", 0x2aa5b91b516f4c15},
        {"terrain: {resolution: 64, form: hills}", 0x3bf18f2164575a9b},
        {"terrain: {resolution: 64, form: badlands, size: 60}", 0xd1c69b9975859928},
        {"terrain: {resolution: 64, form: braided, braided: {age: 0.2}}", 0xc94a27064a8562a5},
        {"terrain: {resolution: 64, form: meander, meander: {age: 0.4}}", 0x749be19aadc8b9c0},
        {"terrain: {resolution: 64, form: delta, delta: {width: 700, age: 0.3}}",
         0xa81a190e94c48295},
        {"terrain: {resolution: 64, form: dunes, dunes: {kind: star, age: 0.2}}",
         0x29626e0306bf40c1},
        {"shape: {envelope: [{shape: capsule, size: [0.3, 1, 0.3]}, "
         "{shape: box, size: 0.5, rotation: [10, 20, 30]}]}",
         0x02ae3c4879220b89},
        {"outtree: {growth: {levels: [{attractors: 200}]}, leaves: {max_count: 20}}",
         0x0486c35f33d5e558},
        {"outtree: {envelope: [{shape: box, size: 1}], points: {place: surface}, growth: {rule: "
         "string, levels: [{attractors: 200, step: 0.8, kill: 0.7}]}, further: [{growth: {rule: "
         "sectors, max_order: 1, levels: [{attractors: 500}]}}], radii: {model: order}, jitter: "
         "{amplitude: 0.05, segment: 0.04}, skin: {levels: 0}}",
         0xf8068646ddccb74e},
        {"outtree: {placed: {points: [{position: [0, 0, 0]}, {position: [0, 1, 0], group: 1}, "
         "{position: [1, 1, 0], group: 1}]}, growth: {rule: snap}, skin: {levels: 0}}",
         0xf14cd4e3be8fa42d}};
    int wrong = 0;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        uint64_t hash = hash_of(kinds[i].object);
        if (hash != kinds[i].hash) {
            print_error("%s has 0x%016" PRIx64 ", not the 0x%016" PRIx64 " that was recorded\n",
                        kinds[i].object, hash, kinds[i].hash);
            wrong++;
        }
    }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_has_the_bits_that_were_recorded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
