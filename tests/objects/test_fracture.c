// Fracture: the pieces are closed, part from one another and together make the body, thin parts and
// all, for any number of cracks; what cannot be broken as asked is said.
#include "making.h"
#include "testing.h"

#include "mesh/pieces.h"
#include "objects/fracture/fracture.h"
#include "outtree/join.h"
#include "shape/level_set.h"
#include "shape/mesh_close.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// ---- a beast ----

static char beast_file[] = "/tmp/ramify-beast-XXXXXX.obj";

static float capsule(Vec3 p, Vec3 a, Vec3 b, float radius)
{
    Vec3 along = vec3_sub(b, a);
    float t = vec3_dot(vec3_sub(p, a), along) / vec3_dot(along, along);
    return vec3_distance(p, vec3_madd(a, clampf(t, 0.0f, 1.0f), along)) - radius;
}

// A barrel on four slender legs, with a head, horns and a tail.
static double beast_distance(const void *shape, Vec3 p, double *bound)
{
    (void)shape;
    float d = capsule(p, vec3(0, 0.9f, -0.4f), vec3(0, 0.9f, 0.4f), 0.28f);
    for (int i = 0; i < 4; i++) {
        float x = i & 1 ? 0.2f : -0.2f, z = i & 2 ? 0.4f : -0.4f;
        d = fminf(d, capsule(p, vec3(x, 0.8f, z), vec3(1.2f * x, 0.05f, z), 0.05f));
    }
    d = fminf(d, capsule(p, vec3(0, 1.0f, 0.5f), vec3(0, 1.4f, 0.8f), 0.13f));
    d = fminf(d, capsule(p, vec3(0, 1.4f, 0.8f), vec3(0, 1.3f, 1.0f), 0.15f));
    d = fminf(d, capsule(p, vec3(-0.1f, 1.5f, 0.75f), vec3(-0.2f, 1.75f, 0.75f), 0.022f));
    d = fminf(d, capsule(p, vec3(0.1f, 1.5f, 0.75f), vec3(0.2f, 1.75f, 0.75f), 0.022f));
    d = fminf(d, capsule(p, vec3(0, 0.95f, -0.65f), vec3(0, 0.5f, -0.85f), 0.025f));
    *bound = fabs((double)d);
    return (double)d;
}

static Mesh *beast;

static int write_beast(void **state)
{
    (void)state;
    Run run = run_default();
    Aabb box = {vec3(-0.6f, -0.1f, -1.0f), vec3(0.6f, 1.9f, 1.3f)};
    LevelSetFrame frame = {box.low, 0.011f};
    LevelSet *set = level_set_from_distance(beast_distance, NULL, box, frame, &run, NULL);
    assert_true(set && level_set_finish(set, NULL));
    beast = level_set_surface(set, NULL);
    level_set_free(set);
    FILE *file = fdopen(mkstemps(beast_file, 4), "w");
    for (int64_t i = 0; i < beast->vertex_count; i++) {
        Vec3 p = beast->position[i];
        fprintf(file, "v %.9g %.9g %.9g\n", (double)p.x, (double)p.y, (double)p.z);
    }
    for (int64_t i = 0; i < 3 * beast->face_count; i += 3) {
        const uint32_t *c = beast->index + i;
        fprintf(file, "f %u %u %u\n", c[0] + 1, c[1] + 1, c[2] + 1);
    }
    return fclose(file);
}

static int remove_beast(void **state)
{
    (void)state;
    mesh_free(beast);
    return unlink(beast_file);
}

// ---- breaking ----

typedef struct Warnings {
    char text[4096];
    int count;
} Warnings;

static void note_warning(void *user, const char *message)
{
    Warnings *warnings = user;
    size_t length = strlen(warnings->text);
    snprintf(warnings->text + length, sizeof warnings->text - length, "%s\n", message);
    warnings->count++;
}

typedef struct Broken {
    MeshPieces pieces;
    double base, sum, largest;
    int64_t loops; // of the network
    Warnings warnings;
} Broken;

static FractureParams small_params(int64_t attractors)
{
    FractureParams params = fracture_params_default();
    params.attractors = attractors;
    params.resolution = 64;
    params.weathering = 0.0f;
    return params;
}

static Broken break_up(const FractureParams *params, uint64_t seed, int threads)
{
    Error e = {0};
    Broken broken = {0};
    Run run = run_default();
    run.threads = threads;
    run.warn = note_warning;
    run.user = &broken.warnings;
    Recipe recipe = {.seed = seed, .label = "object 'it'", .run = &run};
    OutTree *network = grow_kind(&kind_fracture, params, &recipe, 1.0f, &e);
    broken.warnings = (Warnings){0}; // growth has its own
    int64_t pieces;
    if (!network || !out_tree_count_pieces(network, &pieces, &broken.loops, &e) ||
        !fracture_pieces(network, params, &recipe, &broken.pieces, &broken.base, &e)) {
        fail_msg("%s", e.message);
    }
    for (int64_t i = 0; i < broken.pieces.count; i++) {
        double volume = mesh_signed_volume(broken.pieces.piece[i]);
        broken.largest = fmax(broken.largest, volume);
        broken.sum += volume;
    }
    out_tree_free(network);
    return broken;
}

static void clear(Broken *broken)
{
    mesh_pieces_clear(&broken->pieces);
}

static void pieces_are_closed(const Broken *broken)
{
    for (int64_t i = 0; i < broken->pieces.count; i++) {
        MeshTopology t;
        assert_true(mesh_topology(broken->pieces.piece[i], &t, NULL));
        assert_int_equal(t.open_edges + t.overused_edges + t.misoriented_edges, 0);
        assert_int_equal(t.component_count, 1);
    }
}

static float distance_to_pieces(const MeshPieces *pieces, Vec3 p)
{
    float least = INFINITY;
    for (int64_t i = 0; i < pieces->count; i++) {
        for (int64_t k = 0; k < pieces->piece[i]->vertex_count; k++) {
            least = fminf(least, vec3_distance(p, pieces->piece[i]->position[k]));
        }
    }
    return least;
}

static void nothing_is_missing(const Broken *broken)
{
    for (int64_t i = 0; i < beast->vertex_count; i += beast->vertex_count / 300) {
        assert_true(distance_to_pieces(&broken->pieces, beast->position[i]) < 0.04f);
    }
}

// At most two loops of a network close one cell: tips join where others have joined already.
static void holds_together(const Broken *broken, double own)
{
    pieces_are_closed(broken);
    if (broken->pieces.count < 3 || 3 * broken->pieces.count < broken->loops ||
        broken->pieces.count > 3 * broken->loops + 3 || broken->largest > 0.75 * own ||
        fabs(broken->sum / own - 1.0) > 0.01 || broken->warnings.count > 0) {
        fail_msg("%d pieces of %d loops, largest %.3f, volume %.4f; %s", (int)broken->pieces.count,
                 (int)broken->loops, broken->largest / own, broken->sum / own,
                 broken->warnings.text);
    }
}

static void a_ball_falls_into_the_cells_of_its_cracks(void **state)
{
    (void)state;
    const int64_t attractors[] = {40, 70, 200};
    int64_t before = 0;
    for (int i = 0; i < 3; i++) {
        for (uint64_t seed = 1; seed <= (i == 2 ? 1 : 2); seed++) {
            FractureParams params = small_params(attractors[i]);
            params.resolution = i == 2 ? 96 : 64;
            Broken broken = break_up(&params, seed, 2);
            holds_together(&broken, 4.0 / 3.0 * M_PI);
            if (seed == 1) {
                assert_true(broken.pieces.count > before);
                before = broken.pieces.count;
            }
            clear(&broken);
        }
    }
}

static void thin_legs_survive(void **state)
{
    (void)state;
    Shape mesh = {.kind = SHAPE_MESH, .transform = transform_identity(), .file = beast_file};
    for (int i = 0; i < 2; i++) {
        FractureParams params = small_params(i ? 70 : 40);
        params.weathering = i ? fracture_params_default().weathering : 0.0f;
        params.element.shapes = &mesh;
        params.element.shape_count = 1;
        Broken broken = break_up(&params, 1, 2);
        holds_together(&broken, mesh_signed_volume(beast));
        nothing_is_missing(&broken);
        clear(&broken);
    }
}

static double total_area(const MeshPieces *pieces)
{
    double sum = 0.0;
    for (int64_t i = 0; i < pieces->count; i++) {
        sum += mesh_area(pieces->piece[i]);
    }
    return sum;
}

// What a gap takes is the walls' area times its width.
static void a_gap_takes_its_width(void **state)
{
    (void)state;
    FractureParams params = small_params(60);
    params.roughness = 0.0f;
    Broken none = break_up(&params, 2, 2);
    double walls = 0.5 * (total_area(&none.pieces) - 4.0 * M_PI);
    for (int i = 1; i <= 2; i++) {
        params.gap = 0.02f * (float)i;
        Broken gap = break_up(&params, 2, 2);
        assert_int_equal(gap.pieces.count, none.pieces.count);
        double width = (none.sum - gap.sum) / walls;
        if (fabs(width / (double)params.gap - 1.0) > 0.15) {
            fail_msg("a gap of %g m is %g m wide", (double)params.gap, width);
        }
        clear(&gap);
    }
    clear(&none);
}

static void a_hollow_stays_hollow(void **state)
{
    (void)state;
    const Shape balls[2] = {
        {.kind = SHAPE_SPHERE, .size = {1, 1, 1}, .transform = transform_identity()},
        {.kind = SHAPE_SPHERE, .size = {1, 1, 1}, .transform = transform_identity()}};
    double own = 4.0 / 3.0 * M_PI * (1.0 - 0.7 * 0.7 * 0.7);
    for (int shapes = 1; shapes <= 2; shapes++) { // two make a level set: depths are coarser
        for (int whole = 0; whole < 2; whole++) {
            FractureParams params = small_params(whole ? 1 : 60);
            params.element.shapes = (Shape *)balls;
            params.element.shape_count = shapes;
            params.hollow = 0.3f;
            Broken broken = break_up(&params, 2, 2);
            assert_true(whole ? broken.pieces.count == 1 : broken.pieces.count > 4);
            if (fabs(broken.sum / own - 1.0) > (shapes == 1 ? 0.01 : 0.04)) {
                fail_msg("%d shapes: %.4f of the wall's volume", shapes, broken.sum / own);
            }
            clear(&broken);
        }
    }
}

static void said_of(FractureParams params, const char *text)
{
    Broken broken = break_up(&params, 2, 2);
    if (!strstr(broken.warnings.text, text)) {
        fail_msg("'%s' does not say '%s'", broken.warnings.text, text);
    }
    clear(&broken);
}

static void what_cannot_be_broken_is_said(void **state)
{
    (void)state;
    Shape sheet = {
        .kind = SHAPE_BOX, .size = {1, 0.0015f, 0.1f}, .transform = transform_identity()};
    said_of(small_params(1), "cracks from 5 impacts with 1 attractors separate no pieces");
    FractureParams params = small_params(1500);
    params.resolution = 40;
    params.gap = 0.2f;
    said_of(params, "were merged with a neighbour");
    params = small_params(40);
    params.resolution = 20;
    said_of(params, "% of the body's volume; a resolution above 20");
    params = small_params(40);
    params.element.shapes = &sheet;
    params.element.shape_count = 1;
    said_of(params, "thinner than");
}

static void threads_do_not_show(void **state)
{
    (void)state;
    FractureParams params = small_params(60);
    params.resolution = 40;
    Broken one = break_up(&params, 2, 1);
    for (int threads = 2; threads <= 3; threads++) {
        Broken many = break_up(&params, 2, threads);
        assert_int_equal(many.pieces.count, one.pieces.count);
        for (int64_t i = 0; i < one.pieces.count; i++) {
            const Mesh *a = one.pieces.piece[i], *b = many.pieces.piece[i];
            assert_int_equal(a->vertex_count, b->vertex_count);
            assert_memory_equal(a->position, b->position, sizeof(Vec3) * (size_t)a->vertex_count);
        }
        clear(&many);
    }
    clear(&one);
}

static void measures_are_those_of_the_pieces(void **state)
{
    (void)state;
    FractureParams params = small_params(60);
    params.resolution = 40;
    Broken broken = break_up(&params, 2, 1);
    Run run = run_default();
    Recipe recipe = {.seed = 2, .label = "ball", .run = &run};
    OutTree *network = grow_kind(&kind_fracture, &params, &recipe, 1.0f, NULL);
    MeasureList list = {0};
    Grown grown = grown_of(network);
    assert_true(fracture_measure(&params, &grown, &recipe, &list, NULL));
    assert_int_equal(measures_find(&list, "pieces")->value, broken.pieces.count);
    assert_true(measures_find(&list, "largest_piece")->value == broken.largest / broken.base);
    assert_true(measures_find(&list, "removed")->value == 1.0 - broken.sum / broken.base);
    measures_clear(&list);
    out_tree_free(network);
    clear(&broken);
}

static void a_mesh_of_two_balls_has_two_pieces(void **state)
{
    (void)state;
    Mesh *mesh = mesh_new(3, 8, 8, MESH_NORMAL, NULL); // two tetrahedra, their vertices mixed
    const uint32_t face[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    for (int f = 0; f < 8; f++) {
        for (int k = 0; k < 3; k++) {
            mesh->index[3 * f + k] = 2 * face[f / 2][k] + (uint32_t)(f % 2);
        }
    }
    const Vec3 corner[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 8; i++) {
        mesh->position[i] = vec3_add(corner[i / 2], vec3(5.0f * (float)(i % 2), 0, 0));
    }
    MeshPieces pieces;
    assert_true(mesh_split(mesh, &pieces, NULL));
    assert_int_equal(pieces.count, 2);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(pieces.piece[i]->vertex_count, 4);
        assert_int_equal(pieces.piece[i]->face_count, 4);
        assert_float_equal((float)mesh_signed_volume(pieces.piece[i]), 1.0f / 6.0f, 1e-6f);
    }
    mesh_pieces_clear(&pieces);
    mesh_free(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_falls_into_the_cells_of_its_cracks),
        cmocka_unit_test(thin_legs_survive),
        cmocka_unit_test(a_gap_takes_its_width),
        cmocka_unit_test(a_hollow_stays_hollow),
        cmocka_unit_test(what_cannot_be_broken_is_said),
        cmocka_unit_test(threads_do_not_show),
        cmocka_unit_test(measures_are_those_of_the_pieces),
        cmocka_unit_test(a_mesh_of_two_balls_has_two_pieces),
    };
    return cmocka_run_group_tests(tests, write_beast, remove_beast);
}
