// Growth by light: what a plant does with the light that its buds get.
#include "grow/light/light.h"

#include "base/random.h"
#include "grow/light/plant.h"
#include "grow/light/share.h"
#include "grow/light/shed.h"
#include "testing.h"

#define INTERNODE 0.2f // m

static OutTree *seedling(void)
{
    OutTree *start = out_tree_new(NULL);
    assert_non_null(start);
    assert_int_equal(out_tree_add_node(start, vec3(0, -INTERNODE, 0), -1, 0, 0, 1, NULL), 0);
    assert_int_equal(out_tree_add_node(start, vec3(0, 0, 0), 0, 0, 0, 2, NULL), 1);
    return start;
}

static LightSite open_site(int seasons)
{
    return (LightSite){.internode = INTERNODE,
                       .seasons = seasons,
                       .up = {0, 1, 0},
                       .tip = 0.003f,
                       .exponent = 2.3f,
                       .colony = {0, 1, 3},
                       .seed = 9};
}

static OutTree *grow(const LightParams *params, const LightSite *site, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    OutTree *start = seedling();
    OutTree *tree = light_grow(start, params, site, &run, &e);
    if (!tree) {
        print_error("%s\n", e.message);
    }
    assert_non_null(tree);
    assert_true(out_tree_check(tree, NULL));
    out_tree_free(start);
    return tree;
}

static int64_t living(const OutTree *tree)
{
    int64_t count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        count += tree->colony[i] != 3;
    }
    return count;
}

static void any_number_of_threads_grows_the_same_bits(void **state)
{
    (void)state;
    LightParams params = light_params_default();
    LightSite site = open_site(16);
    OutTree *one = grow(&params, &site, 1);
    static const int threads[] = {2, 3, 8};
    for (int i = 0; i < 3; i++) {
        OutTree *other = grow(&params, &site, threads[i]);
        assert_true(out_tree_hash(one) == out_tree_hash(other));
        out_tree_free(other);
    }
    out_tree_free(one);
}

// ---- sharing ----

// A stem of four metamers with a side branch of two on its second; all have leaves, the ends
// terminal buds, and each a side bud.
static Plant forked_plant(void)
{
    LightParams params = light_params_default();
    LightSite site = open_site(1);
    OutTree *start = seedling();
    Plant plant;
    assert_true(plant_init(&plant, start, &params, &site, NULL));
    out_tree_free(start);
    Vec3 up = vec3(0, 1, 0), out = vec3(1, 0, 0);
    int64_t at = 1;
    for (int i = 0; i < 4; i++) {
        at = plant_add(&plant, (int32_t)at, -1, vec3(0, (float)(i + 1), 0), up, NULL);
        assert_true(at >= 0);
    }
    at = plant_add(&plant, 3, 0, vec3(1, 2, 0), out, NULL);
    assert_true(plant_add(&plant, (int32_t)at, -1, vec3(2, 2, 0), out, NULL) >= 0);
    for (int64_t i = 2; i < plant.count; i++) {
        Metamer *m = &plant.metamer[i];
        m->buds = i == 3 ? 0u : 1u;
        m->terminal = m->next < 0;
        m->light = random_range(random_key(5, (uint64_t)i), 0.2f, 1.0f);
        m->vigor = random_range(random_key(6, (uint64_t)i), 0.5f, 2.0f);
        m->claim = random_range(random_key(7, (uint64_t)i), 0.2f, 1.0f);
    }
    return plant;
}

// What of it growth is made of is in *claimed.
static float all_light(const Plant *plant, float *claimed)
{
    float sum = 0.0f;
    *claimed = 0.0f;
    for (int64_t i = 0; i < plant->count; i++) {
        sum += plant->metamer[i].light;
        *claimed += plant->metamer[i].claim * plant->metamer[i].light;
    }
    return sum;
}

// No light is counted twice, neither by the base nor by buds, and growth is neither made nor lost.
static void light_and_growth_are_shared_without_rest(void **state)
{
    (void)state;
    Plant plant = forked_plant();
    float control = 0.54f, vigor = 2.0f, buds = 0.0f, growth = 0.0f, claimed;
    float all = all_light(&plant, &claimed);
    plant_sum_light(&plant, 0, 1);
    assert_float_equal(plant.metamer[0].income, all, 1e-5f);
    plant_share_growth(&plant, vigor, control);
    for (int64_t i = 0; i < plant.count; i++) {
        const Metamer *m = &plant.metamer[i];
        float each, ahead = metamer_bud_growth(&plant, m, control, &each);
        buds += metamer_terminal_light(m) + metamer_bud_light(m);
        growth += ahead + each;
    }
    assert_true(claimed < 0.9f * all && buds <= claimed + 1e-5f);
    assert_float_equal(growth, vigor * claimed, 1e-4f);
    plant_clear(&plant);
}

static void more_light_gives_no_bud_less_growth(void **state)
{
    (void)state;
    Plant dim = forked_plant(), bright = forked_plant();
    for (int64_t i = 0; i < bright.count; i++) {
        bright.metamer[i].light *= 1.25f;
    }
    for (int tenths = 3; tenths < 9; tenths++) {
        float control = 0.1f * (float)tenths;
        plant_sum_light(&dim, 0, 1);
        plant_sum_light(&bright, 0, 1);
        plant_share_growth(&dim, 2.0f, control);
        plant_share_growth(&bright, 2.0f, control);
        for (int64_t i = 0; i < dim.count; i++) {
            float a, b, dim_end = metamer_bud_growth(&dim, &dim.metamer[i], control, &a);
            float bright_end = metamer_bud_growth(&bright, &bright.metamer[i], control, &b);
            assert_true(bright_end >= dim_end && b >= a);
        }
    }
    plant_clear(&dim);
    plant_clear(&bright);
}

static void apical_control_favours_the_axis(void **state)
{
    (void)state;
    Plant plant = forked_plant();
    float before = 0.0f;
    plant_sum_light(&plant, 0, 1);
    for (int tenths = 2; tenths < 10; tenths++) {
        float control = 0.1f * (float)tenths;
        plant_share_growth(&plant, 2.0f, control);
        float top = plant.metamer[5].growth;
        assert_true(top > before);
        before = top;
    }
    plant_clear(&plant);
}

static void a_shaded_branch_dies_and_the_stem_does_not(void **state)
{
    (void)state;
    LightParams params = light_params_default();
    params.light_need = 0.2f;
    Plant plant = forked_plant();
    for (int64_t i = 0; i < plant.count; i++) {
        plant.metamer[i].light = 0.15f;
    }
    plant_sum_light(&plant, 0, params.leaf_seasons);
    assert_int_equal(plant_shed(&plant, &params, 0, 0.0f), 1);
    for (int64_t i = 0; i < plant.count; i++) {
        assert_int_equal(plant.metamer[i].died, i < 6 ? PLANT_ALIVE : 0);
    }
    plant_clear(&plant);
}

// ---- form ----

static bool has_node_near(const OutTree *tree, Vec3 p, float within)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (vec3_distance(tree->position[i], p) < within) {
            return true;
        }
    }
    return false;
}

// Pairs of opposite buds, each crosswise to the last, and no noise: turned by half a circle, the
// tree covers itself.
static void without_noise_a_tree_is_symmetric(void **state)
{
    (void)state;
    LightParams params = light_params_default();
    params.buds = 2;
    params.phyllotaxis = 90.0f;
    params.noise = params.zigzag = params.angle_spread = 0.0f;
    params.vigor = 5.0f;
    LightSite site = open_site(8);
    OutTree *tree = grow(&params, &site, 2);
    assert_true(tree->count > 300);
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        assert_true(has_node_near(tree, vec3(-p.x, p.y, -p.z), 0.01f * INTERNODE));
    }
    out_tree_free(tree);
}

// Chord / length of the stem's axis.
static double stem_straightness(const OutTree *tree)
{
    double length = 0.0;
    int64_t end = 0;
    for (int64_t i = 1; i < tree->count; i++) {
        if (tree->colony[i] == 0) {
            assert_int_equal(tree->parent[i], end);
            length += (double)vec3_distance(tree->position[i], tree->position[end]);
            end = i;
        }
    }
    assert_true(length > 0.0);
    return (double)vec3_distance(tree->position[0], tree->position[end]) / length;
}

static void lost_leaders_make_an_axis_crooked(void **state)
{
    (void)state;
    LightParams params = light_params_default();
    params.noise = params.zigzag = params.angle_spread = params.phototropism = 0.0f;
    params.tropism = vec3(0, 0, 0);
    LightSite site = open_site(10);
    OutTree *straight = grow(&params, &site, 2);
    params.leader_loss = vec3(0.4f, 0, 0);
    OutTree *crooked = grow(&params, &site, 2);
    assert_true(stem_straightness(straight) > 0.999);
    assert_true(stem_straightness(crooked) < 0.95);
    out_tree_free(straight);
    out_tree_free(crooked);
}

// Stems that bow over end where they meet the ground.
static void no_cane_grows_into_the_ground(void **state)
{
    (void)state;
    LightParams params = light_params_default();
    params.apical_control = (Vec2){0.85f, 0.85f};
    params.tropism = vec3(-0.2f, -0.1f, 0.0f);
    params.noise = 0.3f;
    LightSite site = open_site(20);
    OutTree *tree = grow(&params, &site, 2);
    float low = INFINITY, high = 0.0f;
    for (int64_t i = 2; i < tree->count; i++) { // after the foot
        low = fminf(low, tree->position[i].y);
        high = fmaxf(high, tree->position[i].y);
    }
    assert_true(low >= 0.0f && high > 5.0f * INTERNODE);
    out_tree_free(tree);
}

// The branch whose buds were given more vigor than its neighbour's gets the larger share.
static void a_vigorous_branch_gets_more(void **state)
{
    (void)state;
    Plant plant = forked_plant();
    plant_sum_light(&plant, 0, 1);
    Metamer *branch = &plant.metamer[plant.metamer[3].lateral];
    branch->vigor = 1.0f;
    plant_share_growth(&plant, 2.0f, 0.5f);
    float plain = branch->growth;
    branch->vigor = 1.5f;
    plant_share_growth(&plant, 2.0f, 0.5f);
    assert_true(branch->growth > 1.1f * plain);
    plant_clear(&plant);
}

// A branch whose leaves get enough dies if they must keep much bare wood alive.
static void bare_wood_counts_by_its_upkeep(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        LightParams params = light_params_default();
        params.light_need = 0.3f;
        params.upkeep = (float)i;
        Plant plant = forked_plant();
        int32_t base = plant.metamer[3].lateral;
        plant.metamer[base].season = -5; // without leaves
        plant.metamer[plant.metamer[base].next].light = 0.4f;
        plant_sum_light(&plant, 0, 1);
        assert_int_equal(plant.metamer[base].size, 2);
        assert_int_equal(plant.metamer[base].leafy, 1);
        params.leaf_seasons = 1;
        assert_int_equal(plant_shed(&plant, &params, 0, 0.0f), i);
        plant_clear(&plant);
    }
}

// The tree that covers itself does so no more.
static void uneven_vigor_makes_uneven_crowns(void **state)
{
    (void)state;
    LightParams params = light_params_default();
    params.buds = 2;
    params.phyllotaxis = 90.0f;
    params.noise = params.zigzag = params.angle_spread = 0.0f;
    params.vigor = 5.0f;
    params.unevenness = 0.2f;
    LightSite site = open_site(8);
    OutTree *tree = grow(&params, &site, 2);
    int alone = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        alone += !has_node_near(tree, vec3(-p.x, p.y, -p.z), 0.01f * INTERNODE);
    }
    assert_true(alone > tree->count / 10);
    out_tree_free(tree);
}

static void a_lone_tree_does_not_lean(void **state)
{
    (void)state;
    LightParams params = light_params_default();
    params.noise = params.zigzag = 0.0f;
    LightSite site = open_site(24);
    OutTree *tree = grow(&params, &site, 2);
    Vec3 mean = vec3(0, 0, 0);
    for (int64_t i = 0; i < tree->count; i++) {
        mean = vec3_madd(mean, 1.0f / (float)tree->count, tree->position[i]);
    }
    Aabb box = out_tree_bounds(tree);
    float x = box.high.x - box.low.x, z = box.high.z - box.low.z;
    assert_true(fabsf(mean.x) < 0.08f * x && fabsf(mean.z) < 0.08f * z);
    assert_true(x < 1.25f * z && z < 1.25f * x);
    out_tree_free(tree);
}

static void the_stem_is_bare_below_the_bole(void **state)
{
    (void)state;
    LightParams params = light_params_default();
    params.bole = 0.4f;
    params.snags = 0.0f;
    LightSite site = open_site(16);
    OutTree *tree = grow(&params, &site, 2);
    float height = out_tree_bounds(tree).high.y;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        bool leaves_stem = tree->colony[i] == 1 && tree->colony[parent] == 0;
        assert_true(!leaves_stem || tree->position[parent].y > 0.33f * height);
    }
    out_tree_free(tree);
}

static void snags_are_stubs_without_living_wood(void **state)
{
    (void)state;
    LightParams params = light_params_default();
    LightSite site = open_site(24);
    params.snags = 0.5f;
    OutTree *with = grow(&params, &site, 2);
    params.snags = 0.0f;
    OutTree *without = grow(&params, &site, 2);
    assert_int_equal(living(with), without->count);
    assert_true(with->count > without->count);
    for (int64_t i = 0; i < with->count; i++) {
        int32_t parent = with->parent[i];
        assert_true(parent < 0 || with->colony[parent] != 3 || with->colony[i] == 3);
    }
    out_tree_free(with);
    out_tree_free(without);
}

// ---- space ----

#define WALL 0.7f // m: x beyond it is taken

static float wall(const void *user, Vec3 p, Vec3 *away)
{
    (void)user;
    *away = vec3(-1, 0, 0);
    return WALL - p.x;
}

static float wall_alone(const void *user, Vec3 p)
{
    Vec3 away;
    return wall(user, p, &away);
}

// Nothing grows into the wall, and its shade makes the crown grow away from it, with less wood than
// in the open.
static void a_wall_takes_room_and_light(void **state)
{
    (void)state;
    LightParams params = light_params_default();
    Room room = {.clearance = wall, .obstacle = wall_alone};
    LightSite site = open_site(20);
    OutTree *open = grow(&params, &site, 2);
    site.room = &room;
    site.reach = (Aabb){vec3(-20, 0, -20), vec3(20, 40, 20)};
    OutTree *tree = grow(&params, &site, 2);
    float mean = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        assert_true(tree->position[i].x <= WALL);
        mean += tree->position[i].x / (float)tree->count;
    }
    assert_true(out_tree_bounds(open).high.x > 2.0f * WALL);
    assert_true(mean < -0.3f);
    assert_true(living(tree) < living(open));
    out_tree_free(open);
    out_tree_free(tree);
}

enum { MARKS = 4000 };

// Attractors in a box on the side of +x, from which a stem at the origin is out of sight.
static void scatter_marks(Vec3 mark[MARKS])
{
    for (uint64_t i = 0; i < MARKS; i++) {
        mark[i] = vec3(random_range(random_key(i, 1), 0.5f, 4.5f),
                       random_range(random_key(i, 2), 1.5f, 6.5f),
                       random_range(random_key(i, 3), -2.0f, 2.0f));
    }
}

static Vec3 mean_of(const OutTree *tree)
{
    Vec3 mean = vec3(0, 0, 0);
    for (int64_t i = 0; i < tree->count; i++) {
        mean = vec3_madd(mean, 1.0f / (float)tree->count, tree->position[i]);
    }
    return mean;
}

// On every seed the crown tends to the side of the attractors, is the same on any number of
// threads, and without weight and pull they do not show.
static void attractors_give_the_crown_its_side(void **state)
{
    (void)state;
    Vec3 mark[MARKS];
    scatter_marks(mark);
    LightParams params = light_params_default();
    for (uint64_t seed = 1; seed <= 4; seed++) {
        LightSite site = open_site(20);
        site.seed = seed;
        OutTree *plain = grow(&params, &site, 2);
        LightAttractors attractors = {mark, MARKS, 0.0f, 0.0f, 6.0f, 1.0f};
        site.attractors = &attractors;
        OutTree *same = grow(&params, &site, 2);
        assert_true(out_tree_hash(same) == out_tree_hash(plain));
        attractors.weight = 0.5f;
        OutTree *weighed = grow(&params, &site, 1);
        attractors.pull = 0.15f;
        OutTree *drawn = grow(&params, &site, 1), *again = grow(&params, &site, 3);
        assert_true(out_tree_hash(drawn) == out_tree_hash(again));
        float width = out_tree_bounds(plain).high.x - out_tree_bounds(plain).low.x;
        assert_true(mean_of(weighed).x > mean_of(plain).x + 0.06f * width);
        assert_true(mean_of(drawn).x > mean_of(plain).x + 0.1f * width);
        assert_true(drawn->count > plain->count / 5);
        out_tree_free(plain);
        out_tree_free(same);
        out_tree_free(weighed);
        out_tree_free(drawn);
        out_tree_free(again);
    }
}

static void an_envelope_bounds_the_crown(void **state)
{
    (void)state;
    LightParams params = light_params_default();
    Shape ball = {.kind = SHAPE_SPHERE,
                  .size = {1.0f, 0, 0},
                  .transform = transform_compose(vec3(0, 1.8f, 0), vec3(0, 0, 0), vec3_splat(1))};
    Run run = run_default();
    Envelope *envelope =
        envelope_new(&(EnvelopeParams){.shapes = &ball, .shape_count = 1, .voxel = 0}, &run, NULL);
    LightSite site = open_site(16);
    site.envelope = envelope;
    OutTree *tree = grow(&params, &site, 1);
    int64_t inside = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        bool in = envelope_contains(envelope, tree->position[i]);
        assert_true(in || tree->colony[i] != 1);
        inside += in;
    }
    assert_true(inside > 400);
    out_tree_free(tree);
    envelope_free(envelope);
}

// ---- refusals ----

static void a_start_without_nodes_is_refused(void **state)
{
    (void)state;
    Error e = {0};
    Run run = run_default();
    LightParams params = light_params_default();
    LightSite site = open_site(2);
    OutTree *empty = out_tree_new(NULL), *start = seedling();
    assert_null(light_grow(empty, &params, &site, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    site.internode = 0.0f;
    assert_null(light_grow(start, &params, &site, &run, &e));
    out_tree_free(empty);
    out_tree_free(start);
}

static void growth_can_be_cancelled(void **state)
{
    (void)state;
    Error e = {0};
    volatile int cancelled = 1;
    Run run = run_default();
    run.cancelled = &cancelled;
    LightParams params = light_params_default();
    LightSite site = open_site(30);
    OutTree *start = seedling();
    assert_null(light_grow(start, &params, &site, &run, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    out_tree_free(start);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_threads_grows_the_same_bits),
        cmocka_unit_test(light_and_growth_are_shared_without_rest),
        cmocka_unit_test(more_light_gives_no_bud_less_growth),
        cmocka_unit_test(apical_control_favours_the_axis),
        cmocka_unit_test(a_shaded_branch_dies_and_the_stem_does_not),
        cmocka_unit_test(without_noise_a_tree_is_symmetric),
        cmocka_unit_test(lost_leaders_make_an_axis_crooked),
        cmocka_unit_test(no_cane_grows_into_the_ground),
        cmocka_unit_test(a_vigorous_branch_gets_more),
        cmocka_unit_test(bare_wood_counts_by_its_upkeep),
        cmocka_unit_test(uneven_vigor_makes_uneven_crowns),
        cmocka_unit_test(a_lone_tree_does_not_lean),
        cmocka_unit_test(the_stem_is_bare_below_the_bole),
        cmocka_unit_test(snags_are_stubs_without_living_wood),
        cmocka_unit_test(a_wall_takes_room_and_light),
        cmocka_unit_test(attractors_give_the_crown_its_side),
        cmocka_unit_test(an_envelope_bounds_the_crown),
        cmocka_unit_test(a_start_without_nodes_is_refused),
        cmocka_unit_test(growth_can_be_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
