// The foot of a tree: the trunk is as wide on the ground as its flare says, and the bark between
// trunk and main roots is drawn out to buttresses without folds.
#include "making.h"
#include "objects/tree/buttress.h"
#include "skin/skin.h"
#include "testing.h"

#include <math.h>

static GrowLevel crown_level[] = {{30, 0.10f, 0.4f, 4.0f, 0.70f, 0.3f, 0.0f, 0.5f}};

static OutTree *grow(const TreeParams *params)
{
    Error e = {0};
    Run run = run_default();
    OutTree *tree =
        grow_kind(&kind_tree, params, &(Recipe){.seed = 3, .label = "oak", .run = &run}, 1.0f, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

static TreeParams stout_tree(void)
{
    TreeParams params = tree_params_default();
    params.height = 14.0f;
    params.crown.element.levels = crown_level;
    params.crown.element.level_count = 1;
    params.crown.lobes = 0;
    params.trunk.radius = 0.42f;
    params.radii.flare = 0.6f;
    return params;
}

static void the_flare_is_full_on_the_ground(void **state)
{
    (void)state;
    TreeParams params = stout_tree();
    OutTree *wide = grow(&params);
    params.radii.flare = 0.0f;
    OutTree *plain = grow(&params);
    assert_true(fabsf(wide->position[1].y) < 1e-6f);
    assert_true(fabsf(wide->radius[1] / plain->radius[1] - 1.6f) < 1e-3f);
    out_tree_free(wide);
    out_tree_free(plain);
}

static Vec3 face_normal(const Mesh *mesh, int64_t f)
{
    const uint32_t *corner = mesh->index + f * mesh->face_size;
    Vec3 a = mesh->position[corner[0]];
    return vec3_cross(vec3_sub(mesh->position[corner[1]], a),
                      vec3_sub(mesh->position[corner[2]], a));
}

// How far around roots the bark moves, and that it does so outward and without folds.
static void bark_is_drawn_out_about_the_roots(void **state)
{
    (void)state;
    TreeParams params = stout_tree();
    OutTree *tree = grow(&params);
    SkinParams skin = skin_params_default();
    skin.min_radius = params.skin.curve_radius;
    Run run = run_default();
    Error e = {0};
    Mesh *plain = skin_tree(tree, &skin, &run, &e), *drawn = skin_tree(tree, &skin, &run, &e);
    assert_true(plain && drawn && tree_buttress(drawn, tree, &params, &e));
    int64_t moved = 0, turned = 0, near = 0, inward = 0;
    float most = 0.0f;
    for (int64_t i = 0; i < plain->vertex_count; i++) {
        Vec3 way = vec3_sub(drawn->position[i], plain->position[i]);
        float length = vec3_length(way);
        most = length > most ? length : most;
        moved += length > 0.05f * params.trunk.radius;
        assert_true(length == 0.0f || plain->position[i].y < 3.0f * params.trunk.radius);
        inward += length > 0.02f * params.trunk.radius && vec3_dot(way, plain->normal[i]) < 0.0f;
    }
    assert_true(moved > 500 && 20 * inward < moved);
    assert_true(most > 0.15f * params.trunk.radius && most < params.trunk.radius);
    for (int64_t f = 0; f < plain->face_count; f++) {
        uint32_t corner = plain->index[f * plain->face_size];
        if (vec3_distance(plain->position[corner], drawn->position[corner]) > 0.0f) {
            near++;
            turned += vec3_dot(face_normal(plain, f), face_normal(drawn, f)) < 0.0f;
        }
    }
    if (100 * turned > near) {
        fail_msg("%lld of %lld faces are folded over", (long long)turned, (long long)near);
    }
    // Without a flare there is nothing to do.
    params.radii.flare = 0.0f;
    Vec3 before = drawn->position[0];
    assert_true(tree_buttress(drawn, tree, &params, &e));
    assert_true(vec3_distance(before, drawn->position[0]) == 0.0f);
    mesh_free(plain);
    mesh_free(drawn);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_flare_is_full_on_the_ground),
        cmocka_unit_test(bark_is_drawn_out_about_the_roots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
