// Snow crystals: the rules of growth against a plain reading of the paper, the diagram of habits,
// the surface.
#include "testing.h"

#include "base/random.h"
#include "objects/kinds.h"
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
    Mesh *mesh = snow_crystal_mesh(&params, &fake, 2, &e);
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

static double volume(const Mesh *mesh)
{
    double six = 0.0;
    for (int64_t i = 0; i < mesh->face_count; i++) {
        const uint32_t *c = mesh->index + 3 * i;
        Vec3 a = mesh->position[c[0]], b = mesh->position[c[1]], d = mesh->position[c[2]];
        six += (double)a.x * ((double)b.y * (double)d.z - (double)b.z * (double)d.y) +
               (double)a.y * ((double)b.z * (double)d.x - (double)b.x * (double)d.z) +
               (double)a.z * ((double)b.x * (double)d.y - (double)b.y * (double)d.x);
    }
    return six / 6.0;
}

static Mesh *surface_of(const SnowCrystalParams *params, const Snowfake *fake)
{
    Error e = {0};
    Mesh *mesh = snow_crystal_mesh(params, fake, 2, &e);
    assert_non_null(mesh);
    MeshTopology topology;
    assert_true(mesh_topology(mesh, &topology, &e));
    assert_int_equal(topology.open_edges + topology.overused_edges, 0);
    return mesh;
}

// More points to a cell give the same crystal: nearly the same outline, area and thickness.
static void detail_keeps_the_form(void **state)
{
    (void)state;
    SnowCrystalParams params = weather(-15.0f, 0.11f, 60);
    Snowfake fake = grow(&params, 2, 1);
    Mesh *coarse = surface_of(&params, &fake);
    Aabb box = mesh_bounds(coarse);
    for (int detail = 2; detail <= 4; detail++) {
        params.detail = detail;
        Mesh *fine = surface_of(&params, &fake);
        Aabb fine_box = mesh_bounds(fine);
        print_message("detail %d: volume %.4f of the coarse one's\n", detail,
                      volume(fine) / volume(coarse));
        assert_true(fine->face_count > (detail * detail - 1) * coarse->face_count);
        assert_true(fabs(volume(fine) / volume(coarse) - 1.0) < 0.05);
        float cell = 0.5f * params.size / (float)params.cells;
        assert_true(fabsf(fine_box.high.x - box.high.x) < cell);
        assert_true(fabsf(fine_box.high.y / box.high.y - 1.0f) < 0.05f);
        mesh_free(fine);
    }
    mesh_free(coarse);
    snowfake_clear(&fake);
}

// Rings stand on the upper face alone, the more the higher, and leave the outline as it is.
static void rings_stand_on_the_upper_face(void **state)
{
    (void)state;
    SnowCrystalParams params = weather(-15.0f, 0.04f, 60); // a plate
    params.detail = 2;
    Snowfake fake = grow(&params, 2, 1);
    Mesh *plain = surface_of(&params, &fake);
    double last = 0.0;
    for (int k = 1; k <= 2; k++) {
        params.rings = 0.5f * (float)k;
        Mesh *ringed = surface_of(&params, &fake);
        assert_int_equal(ringed->vertex_count, plain->vertex_count);
        double moved = 0.0;
        for (int64_t i = 0; i < plain->vertex_count; i++) {
            Vec3 a = plain->position[i], b = ringed->position[i];
            assert_true(a.x == b.x && a.z == b.z);
            assert_true(a.y > 0.0f ? b.y > 0.0f : a.y == b.y);
            moved += fabs((double)(b.y - a.y)) / (double)params.thickness;
        }
        moved /= (double)plain->vertex_count;
        print_message("rings %.1f: %.4f of the thickness\n", (double)params.rings, moved);
        assert_true(moved > 1.9 * last && moved > 0.005);
        last = moved;
        mesh_free(ringed);
    }
    mesh_free(plain);
    snowfake_clear(&fake);
}

// Share of the points that lie low, but not on the outline itself: the rounder an edge, the more.
static double low_share(const Mesh *mesh, float thickness)
{
    double low = 0.0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        float height = fabsf(mesh->position[i].y);
        low += height > 0.0f && height < 0.25f * thickness;
    }
    return low / (double)mesh->vertex_count;
}

static void worn_edges_are_round(void **state)
{
    (void)state;
    SnowCrystalParams params = weather(-15.0f, 0.11f, 60);
    params.detail = 2;
    params.relief = 0.0f;
    Snowfake fake = grow(&params, 2, 1);
    double low = -1.0, ice = 1.0;
    for (int k = 0; k <= 2; k++) {
        params.worn = 0.5f * (float)k;
        Mesh *mesh = surface_of(&params, &fake);
        double now = low_share(mesh, params.thickness), left = volume(mesh);
        print_message("worn %.1f: %.4f of the points lie low, %.3g mm3\n", (double)params.worn, now,
                      1e9 * left);
        assert_true(now > low && left < ice);
        low = now;
        ice = left;
        mesh_free(mesh);
    }
    snowfake_clear(&fake);
}

// ---- columns ----

// Closed, without handles, each vertex joined to one fan of faces, and of positive volume.
static Mesh *column_of(const SnowCrystalParams *params, uint64_t seed)
{
    Error e = {0};
    SnowColumn column = snow_column(params);
    Mesh *mesh = snow_column_mesh(params, &column, seed, &e);
    assert_non_null(mesh);
    MeshTopology topology;
    assert_true(mesh_topology(mesh, &topology, &e));
    assert_int_equal(topology.open_edges, 0);
    assert_int_equal(topology.overused_edges, 0);
    assert_int_equal(topology.misoriented_edges, 0);
    assert_int_equal(topology.degenerate_faces, 0);
    assert_int_equal(topology.component_count, 1);
    assert_int_equal(topology.euler_number, 2);
    uint8_t *closed = calloc(1 + (size_t)mesh->face_count, 1);
    assert_true(mesh_closed_faces(mesh, closed, &e));
    for (int64_t i = 0; i < mesh->face_count; i++) {
        assert_int_equal(closed[i], 1);
    }
    free(closed);
    return mesh;
}

// Without worn edges a solid column is the hexagonal prism of its length and width.
static void a_solid_column_is_a_prism(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        SnowCrystalParams params = weather(k < 3 ? -4.5f - (float)k : -28.0f, 0.025f, 40);
        params.relief = 0.0f;
        SnowColumn column = snow_column(&params);
        assert_true(column.hollow == 0.0f && column.length == params.size);
        Mesh *mesh = column_of(&params, 4);
        double width = (double)column.width, prism = 0.375 * sqrt(3.0) * width * width;
        assert_true(fabs(volume(mesh) / (prism * (double)column.length) - 1.0) < 1e-5);
        mesh_free(mesh);
        params.relief = 1.0f; // worn edges take a little away
        mesh = column_of(&params, 4);
        double worn = volume(mesh) / (prism * (double)column.length);
        assert_true(worn < 1.0 && worn > 0.97);
        mesh_free(mesh);
    }
}

// Funnels at both ends take the more away the more vapour there was.
static void columns_are_hollow_in_much_vapour(void **state)
{
    (void)state;
    double last = 2.0;
    for (int k = 0; k < 6; k++) {
        SnowCrystalParams params = weather(-7.0f, 0.03f + 0.02f * (float)k, 40);
        params.gusts = 0.5f;
        SnowColumn column = snow_column(&params);
        Mesh *mesh = column_of(&params, 2);
        double width = (double)column.width;
        double left = volume(mesh) / (0.375 * sqrt(3.0) * width * width * (double)column.length);
        print_message("%.2f g/m3: hollow %.2f, %.3f of the prism is left\n",
                      (double)params.weather.supersaturation, (double)column.hollow, left);
        assert_true(left < last && left > 0.4);
        last = left;
        mesh_free(mesh);
    }
}

// Facets stand at 60 degrees to each other, however far each is from the axis.
static void faces_keep_the_angles_of_ice(void **state)
{
    (void)state;
    SnowCrystalParams params = weather(-6.0f, 0.08f, 40);
    params.noise = 0.5f;
    double even = 0.0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        Mesh *mesh = column_of(&params, seed);
        for (int64_t i = 0; i < mesh->face_count; i++) {
            const uint32_t *c = mesh->index + 3 * i;
            Vec3 n = vec3_cross(vec3_sub(mesh->position[c[1]], mesh->position[c[0]]),
                                vec3_sub(mesh->position[c[2]], mesh->position[c[0]]));
            if (fabsf(n.y) < 1e-4f * vec3_length(n)) { // a face along the axis
                double sixth = atan2((double)n.z, (double)n.x) / (M_PI / 3.0) - 0.5;
                assert_true(fabs(sixth - round(sixth)) < 2e-3);
            }
        }
        Aabb box = mesh_bounds(mesh);
        even += fabs((double)(box.high.x + box.low.x)) / (double)(box.high.x - box.low.x) / 20.0;
        mesh_free(mesh);
    }
    assert_true(even > 0.01); // and they are not even
}

static float aspect_in(float temperature, float supersaturation)
{
    SnowCrystalParams params = weather(temperature, supersaturation, 40);
    SnowColumn column = snow_column(&params);
    assert_true(column.length > 0.0f && column.width <= column.length);
    return column.length / column.width;
}

// Nakaya's diagram: short columns in little vapour, longer ones in more, needles at -6 degrees in
// much; toward plates' temperatures they are ever shorter, below -22 ever longer.
static void aspects_are_those_of_the_diagram(void **state)
{
    (void)state;
    for (float temperature = -9.5f; temperature < -3.5f; temperature += 0.5f) {
        for (float s = 0.01f; s < 0.14f; s += 0.01f) {
            assert_true(aspect_in(temperature, s) < aspect_in(temperature, s + 0.01f));
        }
    }
    for (float t = -10.0f; t < -6.1f; t += 0.5f) {
        assert_true(aspect_in(t, 0.1f) < aspect_in(t + 0.5f, 0.1f));
    }
    for (float t = -6.0f; t < -3.6f; t += 0.5f) {
        assert_true(aspect_in(t, 0.1f) > aspect_in(t + 0.5f, 0.1f));
    }
    for (float t = -39.0f; t < -22.0f; t += 1.0f) {
        assert_true(aspect_in(t - 1.0f, 0.1f) > aspect_in(t, 0.1f));
    }
    assert_true(aspect_in(-6.0f, 0.15f) > 15.0f);  // needles
    assert_true(aspect_in(-8.0f, 0.02f) < 2.0f);   // short columns
    assert_true(aspect_in(-10.0f, 0.15f) < 1.01f); // neither column nor plate
    for (int k = 0; k < 3; k++) { // log(length) over log(width) is the ratio of growth, from 1/300
        SnowWeather air = {.temperature = -4.0f - 1.5f * (float)k, .supersaturation = 0.07f};
        double closed = pow(300.0, 1.0 - 1.0 / (double)snow_growth_ratio(&air));
        double aspect = (double)aspect_in(air.temperature, air.supersaturation);
        assert_true(fabs(aspect / closed - 1.0) < 1e-3);
    }
    SnowCrystalParams flat = weather(-15.0f, 0.1f, 40);
    assert_true(snow_column(&flat).length == 0.0f && snow_column_until(&flat) == 0.0f);
}

static Geometry build(const SnowCrystalParams *params)
{
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.seed = 5, .label = "object 'crystal'", .run = &run};
    Geometry geometry = {0};
    const int material[1] = {0};
    Placing placing = {.recipe = &recipe, .geometry = &geometry, .material = material};
    if (!kind_snow_crystal.geometry(params, NULL, &placing, &e)) {
        fail_msg("%s", e.message);
    }
    return geometry;
}

// A column up to half the size, then two plates as wide as the size at its ends.
static void plates_cap_columns(void **state)
{
    (void)state;
    SnowWeather life[] = {{0.0f, -7.0f, 0.05f}, {0.5f, -9.9f, 0.05f}, {0.51f, -14.0f, 0.05f}};
    SnowCrystalParams params = weather(-15.0f, 0.1f, 60);
    params.life = life;
    params.life_count = 3;
    SnowColumn column = snow_column(&params);
    assert_true(fabsf(column.until - 0.5f) < 0.005f);
    assert_true(fabsf(column.length - 0.5f * params.size) < 0.01f * params.size);
    Geometry geometry = build(&params);
    assert_int_equal(geometry.count, 3);
    Error e = {0};
    float middle[3];
    for (int p = 0; p < 3; p++) {
        MeshTopology topology;
        assert_true(mesh_topology(geometry.part[p].mesh, &topology, &e));
        assert_int_equal(topology.open_edges + topology.overused_edges, 0);
        Aabb box = mesh_bounds(geometry.part[p].mesh);
        float width = box.high.x - box.low.x;
        float wanted = p == 0 ? column.width : params.size;
        assert_true(fabsf(width - wanted) < 0.04f * params.size);
        middle[p] = 0.5f * (box.low.y + box.high.y);
    }
    assert_true(fabsf(middle[0]) < 1e-9f);
    assert_true(fabsf(middle[1] - 0.5f * column.length) < 1e-8f);
    assert_true(fabsf(middle[2] + 0.5f * column.length) < 1e-8f);
    geometry_clear(&geometry);

    params.life_count = 1; // weather of columns to the end: nothing caps it
    geometry = build(&params);
    assert_int_equal(geometry.count, 1);
    geometry_clear(&geometry);
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
        cmocka_unit_test(detail_keeps_the_form),
        cmocka_unit_test(rings_stand_on_the_upper_face),
        cmocka_unit_test(worn_edges_are_round),
        cmocka_unit_test(a_solid_column_is_a_prism),
        cmocka_unit_test(columns_are_hollow_in_much_vapour),
        cmocka_unit_test(faces_keep_the_angles_of_ice),
        cmocka_unit_test(aspects_are_those_of_the_diagram),
        cmocka_unit_test(plates_cap_columns),
        cmocka_unit_test(dry_air_is_an_error),
        cmocka_unit_test(a_cancelled_growth_stops),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
