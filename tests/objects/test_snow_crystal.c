// Snow crystals: the rules of growth against a plain reading of the paper, the diagram of habits,
// the surface.
#include "testing.h"

#include "objects/snow_crystal/snow_crystal.h"

static Snowfake grow(const SnowCrystalParams *params, uint64_t seed, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Snowfake fake;
    if (!snow_crystal_grow(params, seed, &run, &fake, &e)) {
        fail_msg("%s", e.message);
    }
    return fake;
}

static SnowCrystalParams weather(float temperature, float supersaturation, int cells)
{
    SnowCrystalParams params = snow_crystal_params_default();
    params.weather = (SnowWeather){.temperature = temperature, .supersaturation = supersaturation};
    params.cells = cells;
    params.gusts = 0.0f;
    return params;
}

// ---- the rules of Gravner and Griffeath (2008), section 2, in double precision and cell by cell
// ----

enum { SIDE = 141, MIDDLE = SIDE / 2, PLAIN_RADIUS = 24 };

typedef struct Plain {
    double d[SIDE][SIDE], b[SIDE][SIDE], c[SIDE][SIDE];
    bool ice[SIDE][SIDE];
    int size;
} Plain;

static const int STEP[6][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}};

static int ice_beside(const Plain *plain, int q, int r)
{
    int count = 0;
    for (int k = 0; k < 6; k++) {
        count += plain->ice[r + STEP[k][1]][q + STEP[k][0]];
    }
    return count;
}

static void plain_diffuse(Plain *plain, int active)
{
    static double next[SIDE][SIDE];
    memcpy(next, plain->d, sizeof next);
    for (int r = 1; r < SIDE - 1; r++) {
        for (int q = 1; q < SIDE - 1; q++) {
            if (plain->ice[r][q] || snowfake_distance(q - MIDDLE, r - MIDDLE) >= active) {
                continue;
            }
            double sum = plain->d[r][q];
            for (int k = 0; k < 6; k++) {
                int to_q = q + STEP[k][0], to_r = r + STEP[k][1];
                sum += plain->ice[to_r][to_q] ? plain->d[r][q] : plain->d[to_r][to_q];
            }
            next[r][q] = sum / 7.0;
        }
    }
    memcpy(plain->d, next, sizeof next);
}

static void plain_freeze(Plain *plain, const SnowfakeRates *rates)
{
    for (int r = 1; r < SIDE - 1; r++) {
        for (int q = 1; q < SIDE - 1; q++) {
            if (!plain->ice[r][q] && ice_beside(plain, q, r)) {
                plain->b[r][q] += (1.0 - (double)rates->kappa) * plain->d[r][q];
                plain->c[r][q] += (double)rates->kappa * plain->d[r][q];
                plain->d[r][q] = 0.0;
            }
        }
    }
}

static bool plain_attaches(const Plain *plain, const SnowfakeRates *rates, int q, int r)
{
    int count = ice_beside(plain, q, r);
    double b = plain->b[r][q], around = plain->d[r][q];
    if (plain->ice[r][q] || count == 0) {
        return false;
    }
    if (count <= 2) {
        return b >= (double)rates->beta;
    }
    for (int k = 0; k < 6; k++) {
        around += plain->d[r + STEP[k][1]][q + STEP[k][0]];
    }
    return count >= 4 || b >= 1.0 || (b >= (double)rates->alpha && around < (double)rates->theta);
}

static void plain_attach_and_melt(Plain *plain, const SnowfakeRates *rates)
{
    static bool joins[SIDE][SIDE];
    for (int r = 1; r < SIDE - 1; r++) {
        for (int q = 1; q < SIDE - 1; q++) {
            joins[r][q] = plain_attaches(plain, rates, q, r);
        }
    }
    for (int r = 1; r < SIDE - 1; r++) {
        for (int q = 1; q < SIDE - 1; q++) {
            if (joins[r][q]) {
                int distance = snowfake_distance(q - MIDDLE, r - MIDDLE);
                plain->ice[r][q] = true;
                plain->d[r][q] = 0.0;
                plain->size = distance > plain->size ? distance : plain->size;
            }
        }
    }
    for (int r = 1; r < SIDE - 1; r++) {
        for (int q = 1; q < SIDE - 1; q++) {
            if (!plain->ice[r][q] && ice_beside(plain, q, r)) {
                double liquid = (double)rates->mu * plain->b[r][q];
                double solid = (double)rates->gamma * plain->c[r][q];
                plain->b[r][q] -= liquid;
                plain->c[r][q] -= solid;
                plain->d[r][q] += liquid + solid;
            }
        }
    }
}

static void the_rules_are_those_of_the_paper(void **state)
{
    (void)state;
    for (int habit = 0; habit <= 4; habit++) {
        SnowfakeRates rates = snow_habit_rates((float)habit);
        SnowfakeParams params = {.radius = PLAIN_RADIUS, .life = &rates, .life_count = 1};
        Run run = run_default();
        Error e = {0};
        Snowfake fake;
        assert_true(snowfake_grow(&params, &run, &fake, &e));

        static Plain plain;
        memset(&plain, 0, sizeof plain);
        for (int i = 0; i < SIDE * SIDE; i++) {
            plain.d[i / SIDE][i % SIDE] = (double)rates.rho;
        }
        plain.ice[MIDDLE][MIDDLE] = true;
        plain.d[MIDDLE][MIDDLE] = 0.0;
        int64_t steps = 0;
        for (int active = 24; plain.size < PLAIN_RADIUS; steps++) {
            plain_diffuse(&plain, active);
            plain_freeze(&plain, &rates);
            plain_attach_and_melt(&plain, &rates);
            int wanted = plain.size * 7 / 5 + 24;
            active = wanted > active ? wanted : active;
        }
        int64_t differ = 0, ice = 0;
        for (int r = -PLAIN_RADIUS; r <= PLAIN_RADIUS; r++) {
            for (int q = -PLAIN_RADIUS; q <= PLAIN_RADIUS; q++) {
                bool there = plain.ice[r + MIDDLE][q + MIDDLE];
                ice += there;
                differ += there != (fake.ice[snowfake_cell(&fake, q, r)] > 0.0f);
            }
        }
        print_message("habit %d: %lld cells, %lld differ; %lld and %lld steps\n", habit,
                      (long long)ice, (long long)differ, (long long)fake.steps, (long long)steps);
        assert_true(differ <= ice / 100); // where a mass is a rounding away from its threshold
        assert_true(llabs(fake.steps - steps) <= steps / 100);
        snowfake_clear(&fake);
    }
}

static void mass_is_conserved_and_six_arms_are_equal(void **state)
{
    (void)state;
    for (int habit = 0; habit <= 4; habit++) {
        SnowfakeRates rates = snow_habit_rates((float)habit);
        SnowfakeParams params = {.radius = 60, .life = &rates, .life_count = 1};
        Run run = run_default();
        Error e = {0};
        Snowfake fake;
        assert_true(snowfake_grow(&params, &run, &fake, &e));
        assert_true(fabs(fake.mass_error) < 1e-4);
        assert_true(snowfake_asymmetry(&fake) == 0.0); // masses are integers
        snowfake_clear(&fake);
    }
}

static void noise_breaks_the_symmetry(void **state)
{
    (void)state;
    SnowCrystalParams params = weather(-15.0f, 0.16f, 60);
    params.noise = 0.05f;
    Snowfake fake = grow(&params, 3, 1);
    assert_true(snowfake_asymmetry(&fake) > 0.0);
    snowfake_clear(&fake);
}

static double fill_in(float temperature, float supersaturation)
{
    SnowCrystalParams params = weather(temperature, supersaturation, 100);
    Snowfake fake = grow(&params, 1, 2);
    double fill = snowfake_fill(&fake);
    snowfake_clear(&fake);
    print_message("%g degrees, %g g/m3: fills %.3f\n", (double)temperature, (double)supersaturation,
                  fill);
    return fill;
}

// Nakaya's diagram: plates in little vapour, branches in much of it, most of all at -15 degrees.
static void habits_are_those_of_the_diagram(void **state)
{
    (void)state;
    assert_true(fill_in(-15.0f, 0.01f) > 0.97); // a hexagon, with facets at 120 degrees
    assert_true(fill_in(-20.0f, 0.03f) > 0.9);
    assert_true(fill_in(-2.0f, 0.03f) > 0.9);
    assert_true(fill_in(-15.0f, 0.16f) < 0.4);
    assert_true(fill_in(-15.0f, 0.22f) < 0.4);
    assert_true(fill_in(-12.0f, 0.06f) > fill_in(-15.0f, 0.16f) + 0.1);
    assert_true(fill_in(-21.0f, 0.08f) > fill_in(-15.0f, 0.16f) + 0.1);
}

static void threads_do_not_matter(void **state)
{
    (void)state;
    SnowCrystalParams params = weather(-14.0f, 0.13f, 130);
    params.gusts = 0.3f;
    params.noise = 0.02f;
    Snowfake one = grow(&params, 5, 1), four = grow(&params, 5, 4);
    size_t bytes = (size_t)one.width * (size_t)one.width * sizeof *one.ice;
    assert_int_equal(one.steps, four.steps);
    assert_memory_equal(one.ice, four.ice, bytes);
    assert_memory_equal(one.born, four.born, bytes);
    snowfake_clear(&one);
    snowfake_clear(&four);
}

static void the_surface_is_closed_and_has_its_size(void **state)
{
    (void)state;
    SnowCrystalParams params = weather(-15.0f, 0.13f, 80);
    params.gusts = 0.3f;
    Snowfake fake = grow(&params, 2, 1);
    Error e = {0};
    Mesh *mesh = snow_crystal_mesh(&params, &fake, &e);
    assert_non_null(mesh);
    MeshTopology topology;
    assert_true(mesh_topology(mesh, &topology, &e));
    assert_int_equal(topology.open_edges, 0);
    assert_int_equal(topology.overused_edges, 0);
    assert_int_equal(topology.misoriented_edges, 0);
    uint8_t *closed = calloc((size_t)mesh->face_count, 1);
    assert_true(mesh_closed_faces(mesh, closed, &e));
    for (int64_t i = 0; i < mesh->face_count; i++) {
        assert_int_equal(closed[i], 1);
    }
    free(closed);
    Aabb box = mesh_bounds(mesh);
    float width = box.high.x - box.low.x, cell = 0.5f * params.size / (float)params.cells;
    assert_true(fabsf(width - params.size) < 2.0f * cell);
    assert_true(box.high.y == -box.low.y && box.high.y < 2.0f * params.thickness);
    mesh_free(mesh);
    snowfake_clear(&fake);
}

static void dry_air_is_an_error(void **state)
{
    (void)state;
    SnowfakeRates rates = snow_habit_rates(0.0f);
    rates.rho = 0.001f;
    SnowfakeParams params = {.radius = 30, .life = &rates, .life_count = 1};
    Run run = run_default();
    Error e = {0};
    Snowfake fake;
    assert_false(snowfake_grow(&params, &run, &fake, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "too little vapour"));
}

static void a_cancelled_growth_stops(void **state)
{
    (void)state;
    int cancelled = 1;
    SnowCrystalParams params = weather(-15.0f, 0.1f, 80);
    Run run = run_default();
    run.cancelled = &cancelled;
    Error e = {0};
    Snowfake fake;
    assert_false(snow_crystal_grow(&params, 1, &run, &fake, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_rules_are_those_of_the_paper),
        cmocka_unit_test(mass_is_conserved_and_six_arms_are_equal),
        cmocka_unit_test(noise_breaks_the_symmetry),
        cmocka_unit_test(habits_are_those_of_the_diagram),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(the_surface_is_closed_and_has_its_size),
        cmocka_unit_test(dry_air_is_an_error),
        cmocka_unit_test(a_cancelled_growth_stops),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
