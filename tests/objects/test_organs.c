// Organs on a small tree: how many there are, where they stand, what they are made of.
#include "render/world.h"
#include "scene/builder.h"
#include "testing.h"

#include <stdio.h>
#include <string.h>

static World *build(const char *organ)
{
    char text[1024];
    Error e = {0};
    snprintf(text, sizeof text,
             "seed: 3\nobjects:\n  - name: a\n    tree: {height: 2, position: [7, 0, 5], crown: "
             "{lobes: 0, growth: {levels: [{attractors: 120}]}}, roots: {count: 3}, leaves: "
             "{max_count: 0}, radii: {tip: 0.004}, organs: [{%s, variants: 1}]}\n",
             organ);
    Scene *scene = scene_read_text(text, strlen(text), "s.yaml", "", NULL, 0, &e);
    Run run = run_default();
    BuildStats stats = {0};
    World *world = scene ? scene_build(scene, &run, &stats, &e) : NULL;
    if (!world) {
        fail_msg("%s: %s", organ, e.message);
    }
    scene_free(scene);
    return world;
}

// The part of the material; NULL = none.
static const Part *part_of(const World *world, const char *material)
{
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        if (part->instance_count > 0 &&
            strcmp(world->material[part->material].name, material) == 0) {
            return part;
        }
    }
    return NULL;
}

static int64_t count_of(const char *organ, const char *material)
{
    World *world = build(organ);
    const Part *part = part_of(world, material);
    int64_t count = part ? part->instance_count : 0;
    world_free(world);
    return count;
}

#define BUDS "kind: bud, where: along, spacing: 0.005, twig_radius: 0.02"

static void as_many_stand_there_as_asked_for(void **state)
{
    (void)state;
    int64_t all = count_of(BUDS ", share: 1", "cone");
    assert_true(all > 100);
    int64_t half = count_of(BUDS ", share: 0.5", "cone");
    assert_in_range(half, 2 * all / 5, 3 * all / 5);
    assert_in_range(count_of(BUDS ", share: 1, max_count: 100", "cone"), 70, 130);
    assert_int_equal(count_of(BUDS ", share: 1, max_count: 0", "cone"), 0);
    assert_int_equal(count_of(BUDS ", share: 0", "cone"), 0);
}

static void tissues_share_their_places(void **state)
{
    (void)state;
    World *world =
        build("kind: blossom, where: ends, share: 1, twig_radius: 0.02, detail: 2, spur: 0.01");
    const Part *petals = part_of(world, "blossom");
    assert_non_null(petals);
    static const char *const OTHERS[] = {"stalk", "tree/anther", "cone"};
    for (int i = 0; i < 3; i++) {
        const Part *other = part_of(world, OTHERS[i]);
        assert_non_null(other);
        assert_int_equal(petals->instance_count, other->instance_count);
        assert_memory_equal(petals->instance, other->instance,
                            (size_t)petals->instance_count * sizeof *petals->instance);
    }
    world_free(world);
}

static void those_of_the_upper_crown_are_there(void **state)
{
    (void)state;
    float lowest[2] = {1e9f, 1e9f}, highest = -1e9f;
    for (int i = 0; i < 2; i++) {
        World *world = build(i ? BUDS ", share: 1, above: 0.6" : BUDS ", share: 1");
        const Part *part = part_of(world, "cone");
        assert_non_null(part);
        for (int64_t k = 0; k < part->instance_count; k++) {
            float y = part->instance[k].m[1][3];
            lowest[i] = fminf(lowest[i], y);
            highest = fmaxf(highest, y);
        }
        world_free(world);
    }
    assert_true(lowest[1] >= lerpf(lowest[0], highest, 0.6f) - 1e-3f);
}

static void those_that_hang_hang(void **state)
{
    (void)state;
    World *world = build("kind: catkin, where: along, share: 1, twig_radius: 0.02, hang: 1");
    const Part *part = part_of(world, "cone");
    assert_non_null(part);
    for (int64_t k = 0; k < part->instance_count; k++) {
        const Transform *t = &part->instance[k];
        Vec3 y = vec3_normalize(vec3(t->m[0][1], t->m[1][1], t->m[2][1]));
        assert_true(y.y < -0.95f);
    }
    world_free(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_many_stand_there_as_asked_for),
        cmocka_unit_test(tissues_share_their_places),
        cmocka_unit_test(those_of_the_upper_crown_are_there),
        cmocka_unit_test(those_that_hang_hang),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
