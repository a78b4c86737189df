// Dicing and displacement against closed forms: a plane, a cylinder, a closed body with rates that
// differ from place to place.
#include "base/memory.h"
#include "mesh/dice.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Wanted {
    float edge;   // m
    float height; // m, of the waves
    float near;   // edges are to be diced where z is above it
    float growth; // per m: edges are longer by this times the distance from the end z = -1
    float fine;   // m: of ripples a tenth as wide as the waves, where edges are as wanted
} Wanted;

static float waves(Vec3 p, float height)
{
    return height * sinf(9.0f * p.x) * cosf(7.0f * p.z + p.y);
}

static float wanted_edge(const void *user, const DicePoint *a, const DicePoint *b)
{
    const Wanted *wanted = user;
    float z = 0.5f * (a->position.z + b->position.z);
    return z > wanted->near ? wanted->edge * (1.0f + wanted->growth * (z + 1.0f)) : INFINITY;
}

static float wanted_height(const void *user, const DicePoint *p, float coarsening, float *share)
{
    const Wanted *wanted = user;
    *share = smoothstepf(wanted->near, wanted->near + 0.3f, p->position.z);
    float ripples = waves(vec3_scale(p->position, 10.0f), wanted->fine / coarsening);
    return *share * (waves(p->position, wanted->height) + ripples);
}

static DicedMesh dice(const Mesh *mesh, const Wanted *wanted, int64_t most, int threads)
{
    Run run = run_default();
    run.threads = threads;
    DiceRule rule = {wanted_edge, wanted_height, wanted, most};
    DicedMesh diced;
    Error e = {0};
    if (!mesh_dice(mesh, &rule, &run, &diced, &e)) {
        fail_msg("%s", e.message);
    }
    return diced;
}

// A sheet of n x n quads over -1..1, closed to a tube about z of radius 1 if round.
static Mesh *sheet(int n, bool round)
{
    int columns = round ? n : n + 1;
    Mesh *mesh = mesh_new(4, (int64_t)columns * (n + 1), (int64_t)n * n,
                          MESH_NORMAL | MESH_UV | MESH_RADIUS, NULL);
    assert_non_null(mesh);
    uint32_t *index = mesh->index;
    for (int j = 0; j <= n; j++) {
        for (int i = 0; i < columns; i++) {
            float u = (float)i / (float)n, v = 2.0f * (float)j / (float)n - 1.0f;
            float angle = 2.0f * PI_F * u;
            int k = j * columns + i;
            mesh->position[k] = round ? vec3(cosf(angle), sinf(angle), v) : vec3(2 * u - 1, 0, v);
            mesh->normal[k] = round ? vec3(cosf(angle), sinf(angle), 0) : vec3(0, -1, 0);
            mesh->uv[k] = (Vec2){u, v};
            mesh->radius[k] = 1.0f + 0.5f * v;
        }
    }
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            uint32_t a = (uint32_t)(j * columns + i),
                     b = (uint32_t)(j * columns + (i + 1) % columns);
            uint32_t up = (uint32_t)columns;
            memcpy(index, (uint32_t[4]){a, b, b + up, a + up}, 16);
            index += 4;
        }
    }
    return mesh;
}

static void a_plane_is_displaced_by_its_waves(void **state)
{
    (void)state;
    Mesh *plane = sheet(3, false);
    Wanted wanted = {.edge = 0.03f, .height = 0.05f, .near = -2.0f};
    DicedMesh d = dice(plane, &wanted, 1000000, 1);
    assert_non_null(d.mesh);
    assert_true(d.mesh->face_count > 4000 && d.coarsening == 1.0f);
    for (int64_t i = 0; i < d.mesh->vertex_count; i++) {
        Vec3 p = d.mesh->position[i], q = d.displaced[i];
        assert_true(fabsf(p.y) < 1e-6f && p.x == q.x && p.z == q.z);
        assert_float_equal(q.y, -waves(p, 0.05f), 1e-6f);
        assert_float_equal(d.mesh->radius[i], 1.0f + 0.5f * p.z, 1e-5f);
        assert_true(vec3_distance(d.along[i], vec3(0, 0, 1)) < 1e-5f);
        // The normal of y = -h(x, z), which faces down, by differences; coarser at the border.
        if (fabsf(p.x) < 0.95f && fabsf(p.z) < 0.95f) {
            const float s = 1e-3f;
            float x = waves(vec3_add(p, vec3(s, 0, 0)), 0.05f) - waves(p, 0.05f);
            float z = waves(vec3_add(p, vec3(0, 0, s)), 0.05f) - waves(p, 0.05f);
            Vec3 n = vec3_normalize(vec3(-x / s, -1, -z / s));
            assert_true(vec3_distance(d.normal[i], n) < 0.05f);
        }
    }
    for (int64_t i = 0; i < 3 * d.mesh->face_count; i++) {
        int64_t next = i % 3 == 2 ? i - 2 : i + 1;
        Vec3 a = d.mesh->position[d.mesh->index[i]], b = d.mesh->position[d.mesh->index[next]];
        assert_true(vec3_distance(a, b) <= 0.03f);
    }
    diced_mesh_clear(&d);
    mesh_free(plane);
}

// Twelve sides become a cylinder: the polygon is off by 0.034, the cubics by 0.0002.
static void a_cylinder_is_round(void **state)
{
    (void)state;
    Mesh *tube = sheet(12, true);
    Wanted wanted = {.edge = 0.05f, .height = 0.02f, .near = -2.0f};
    DicedMesh d = dice(tube, &wanted, 1000000, 1);
    assert_non_null(d.mesh);
    for (int64_t i = 0; i < d.mesh->vertex_count; i++) {
        Vec3 p = d.mesh->position[i], q = d.displaced[i];
        Vec3 out = vec3_normalize(vec3(p.x, p.y, 0));
        assert_float_equal(hypotf(p.x, p.y), 1.0f, 2e-4f);
        assert_true(vec3_distance(d.mesh->normal[i], out) < 5e-3f);
        assert_float_equal(hypotf(q.x, q.y), 1.0f + waves(p, 0.02f), 3e-4f);
        assert_true(vec3_distance(d.along[i], vec3(0, 0, 1)) < 1e-2f);
    }
    diced_mesh_clear(&d);
    mesh_free(tube);
}

// Only the ends of the tube are open, where fine and coarse dice meet, too; what is not asked for
// stays.
static void rates_may_differ_without_cracks(void **state)
{
    (void)state;
    Mesh *tube = sheet(16, true);
    Wanted wanted = {.edge = 0.02f, .height = 0.03f, .near = 0.1f};
    DicedMesh d = dice(tube, &wanted, 1000000, 1);
    assert_non_null(d.mesh);
    MeshTopology t;
    assert_true(mesh_topology(d.mesh, &t, NULL));
    assert_int_equal(t.overused_edges + t.misoriented_edges + t.degenerate_faces, 0);
    assert_int_equal(t.component_count, 1);
    assert_int_equal(t.euler_number, 0);
    int64_t coarse = 0, rim = 0;
    for (int64_t i = 0; i < d.mesh->vertex_count; i++) {
        Vec3 p = d.mesh->position[i];
        coarse += p.z < 0.0f;
        rim += fabsf(p.z) > 1.0f - 1e-5f;
        assert_true(p.z > 0.1f || (vec3_distance(p, d.displaced[i]) <= 0.0f &&
                                   vec3_distance(d.normal[i], d.mesh->normal[i]) < 1e-6f));
    }
    assert_int_equal(coarse, 16 * 8);
    assert_int_equal(t.open_edges, rim);
    diced_mesh_clear(&d);
    mesh_free(tube);
}

static void nothing_is_made_where_nothing_is_asked_for(void **state)
{
    (void)state;
    Mesh *tube = sheet(16, true);
    Wanted wanted = {.edge = 0.02f, .height = 0.03f, .near = 2.0f};
    DicedMesh d = dice(tube, &wanted, 1000000, 2);
    assert_null(d.mesh);
    diced_mesh_clear(&d);
    mesh_free(tube);
}

static void the_limit_on_faces_is_kept(void **state)
{
    (void)state;
    Mesh *tube = sheet(16, true);
    Wanted wanted = {.edge = 0.002f, .height = 0.03f, .near = -2.0f};
    DicedMesh d = dice(tube, &wanted, 20000, 2);
    assert_non_null(d.mesh);
    assert_true(d.mesh->face_count <= 20000 && d.mesh->face_count > 7000);
    assert_true(d.coarsening > 5.0f);
    diced_mesh_clear(&d);
    mesh_free(tube);
}

// The vertices of the mesh, which were displaced before the limit was met, too.
static void all_vertices_know_how_long_edges_became(void **state)
{
    (void)state;
    Mesh *tube = sheet(16, true);
    Wanted wanted = {.edge = 0.002f, .height = 0.03f, .near = -2.0f, .fine = 0.01f};
    DicedMesh d = dice(tube, &wanted, 20000, 2);
    assert_true(d.coarsening > 5.0f && d.mesh->vertex_count > tube->vertex_count);
    for (int64_t i = 0; i < d.mesh->vertex_count; i++) {
        const DicePoint at = {.position = d.mesh->position[i]};
        float share, height = wanted_height(&wanted, &at, d.coarsening, &share);
        Vec3 moved = vec3_sub(d.displaced[i], d.mesh->position[i]);
        assert_float_equal(vec3_dot(moved, d.mesh->normal[i]), height, 1e-5f);
    }
    diced_mesh_clear(&d);
    mesh_free(tube);
}

// Mean of how long edges are against what is wanted, over faces between two heights.
static double mean_length(const DicedMesh *d, const Wanted *wanted, float low, float high)
{
    double sum = 0.0;
    int64_t edges = 0;
    for (int64_t i = 0; i < 3 * d->mesh->face_count; i++) {
        uint32_t a = d->mesh->index[i], b = d->mesh->index[i % 3 == 2 ? i - 2 : i + 1];
        const DicePoint from = {.position = d->mesh->position[a]};
        const DicePoint to = {.position = d->mesh->position[b]};
        float z = 0.5f * (from.position.z + to.position.z);
        if (z > low && z < high) {
            float length = vec3_distance(from.position, to.position);
            sum += (double)(length / wanted_edge(wanted, &from, &to));
            edges++;
        }
    }
    return sum / (double)edges;
}

// What needs most halvings must not bear the limit alone.
static void the_limit_on_faces_is_borne_by_all(void **state)
{
    (void)state;
    Mesh *tube = sheet(16, true);
    Wanted wanted = {.edge = 0.002f, .height = 0.03f, .near = -2.0f, .growth = 20.0f};
    DicedMesh d = dice(tube, &wanted, 40000, 2);
    double fine = mean_length(&d, &wanted, -1.0f, -0.8f), coarse = mean_length(&d, &wanted, 0, 1);
    assert_true(d.mesh->face_count <= 40000 && d.mesh->face_count > 20000);
    assert_true(d.coarsening > 1.5f && fine < d.coarsening && coarse < d.coarsening);
    assert_true(fine / coarse < 1.3 && coarse / fine < 1.3);
    diced_mesh_clear(&d);
    mesh_free(tube);
}

static void threads_do_not_change_a_bit(void **state)
{
    (void)state;
    Mesh *tube = sheet(24, true);
    Wanted wanted = {.edge = 0.013f, .height = 0.04f, .near = -0.3f};
    DicedMesh a = dice(tube, &wanted, 30000, 1), b = dice(tube, &wanted, 30000, 3);
    assert_true(a.coarsening > 1.0f); // the limit was met
    assert_int_equal(a.mesh->vertex_count, b.mesh->vertex_count);
    assert_int_equal(a.mesh->face_count, b.mesh->face_count);
    size_t points = (size_t)a.mesh->vertex_count * sizeof(Vec3);
    assert_memory_equal(a.displaced, b.displaced, points);
    assert_memory_equal(a.normal, b.normal, points);
    assert_memory_equal(a.mesh->index, b.mesh->index, (size_t)a.mesh->face_count * 12);
    diced_mesh_clear(&a);
    diced_mesh_clear(&b);
    mesh_free(tube);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plane_is_displaced_by_its_waves),
        cmocka_unit_test(a_cylinder_is_round),
        cmocka_unit_test(rates_may_differ_without_cracks),
        cmocka_unit_test(nothing_is_made_where_nothing_is_asked_for),
        cmocka_unit_test(the_limit_on_faces_is_kept),
        cmocka_unit_test(the_limit_on_faces_is_borne_by_all),
        cmocka_unit_test(all_vertices_know_how_long_edges_became),
        cmocka_unit_test(threads_do_not_change_a_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
