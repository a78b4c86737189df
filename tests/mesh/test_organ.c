// Organs: each has the tissues and the size it should have, no quad is without area, clusters have
// as many as asked for, fruit and cones the form they should.
#include "mesh/organ/organ.h"
#include "testing.h"

static OrganParams plain(OrganKind kind)
{
    return (OrganParams){.kind = kind,
                         .length = 0.05f,
                         .width = 0.03f,
                         .stalk = 0.02f,
                         .per_cluster = 1,
                         .axis = 0.2f,
                         .spread = 50.0f,
                         .open = 0.7f,
                         .petals = 5,
                         .detail = 2};
}

static void make(const OrganParams *params, Mesh *mesh[TISSUES])
{
    Error e = {0};
    if (!organ_meshes(params, 4, mesh, &e)) {
        fail_msg("%s", e.message);
    }
}

static void clear(Mesh *mesh[TISSUES])
{
    for (int t = 0; t < TISSUES; t++) {
        mesh_free(mesh[t]);
    }
}

static double quad_area(const Mesh *mesh, int64_t f)
{
    Vec3 p[4];
    for (int k = 0; k < 4; k++) {
        p[k] = mesh->position[mesh->index[4 * f + k]];
    }
    Vec3 a = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
    Vec3 b = vec3_cross(vec3_sub(p[2], p[0]), vec3_sub(p[3], p[0]));
    return 0.5 * (double)(vec3_length(a) + vec3_length(b));
}

static void organs_have_their_tissues_and_size(void **state)
{
    (void)state;
    static const unsigned tissues[] = {
        [ORGAN_BLOSSOM] = 1u << TISSUE_PETAL | 1u << TISSUE_GREEN,
        [ORGAN_CATKIN] = 1u << TISSUE_WOOD | 1u << TISSUE_GREEN,
        [ORGAN_FRUIT] = 1u << TISSUE_FLESH | 1u << TISSUE_GREEN,
        [ORGAN_CONE] = 1u << TISSUE_WOOD | 1u << TISSUE_GREEN,
        [ORGAN_ACORN] = 1u << TISSUE_FLESH | 1u << TISSUE_WOOD | 1u << TISSUE_GREEN,
        [ORGAN_HUSK] = 1u << TISSUE_FLESH | 1u << TISSUE_GREEN,
        [ORGAN_BUD] = 1u << TISSUE_WOOD | 1u << TISSUE_GREEN,
        [ORGAN_SAMARA] = 1u << TISSUE_FLESH | 1u << TISSUE_WING | 1u << TISSUE_GREEN,
        [ORGAN_THORN] = 1u << TISSUE_WOOD | 1u << TISSUE_GREEN};
    for (int kind = ORGAN_BLOSSOM; kind <= ORGAN_THORN; kind++) {
        OrganParams params = plain((OrganKind)kind);
        for (params.detail = 1; params.detail <= 2; params.detail++) {
            Mesh *mesh[TISSUES];
            make(&params, mesh);
            Aabb box = aabb_empty();
            for (int t = 0; t < TISSUES; t++) {
                bool anthers = t == TISSUE_ANTHER && kind == ORGAN_BLOSSOM && params.detail == 2;
                assert_int_equal(mesh[t] != NULL, anthers || (tissues[kind] >> t & 1u));
                for (int64_t f = 0; mesh[t] && f < mesh[t]->face_count; f++) {
                    assert_true(quad_area(mesh[t], f) > 1e-11);
                }
                for (int64_t v = 0; mesh[t] && v < mesh[t]->vertex_count; v++) {
                    assert_true(vec3_finite(mesh[t]->normal[v]));
                    box = aabb_add(box, mesh[t]->position[v]);
                }
            }
            // From the stalk's start to about the organ's end.
            float high = params.stalk + params.length;
            assert_true(box.low.y > -0.005f && box.low.y < 0.001f);
            assert_true(kind == ORGAN_BLOSSOM || kind == ORGAN_SAMARA ||
                        (box.high.y > 0.8f * high && box.high.y < 1.25f * high));
            clear(mesh);
        }
    }
}

static void clusters_have_as_many_as_asked_for(void **state)
{
    (void)state;
    OrganParams params = plain(ORGAN_FRUIT);
    for (params.per_cluster = 1; params.per_cluster < 40; params.per_cluster += 13) {
        for (params.cluster = CLUSTER_UMBEL; params.cluster <= CLUSTER_RACEME; params.cluster++) {
            Mesh *mesh[TISSUES];
            MeshTopology topology;
            make(&params, mesh);
            assert_true(mesh_topology(mesh[TISSUE_FLESH], &topology, NULL));
            assert_int_equal(topology.component_count, params.per_cluster);
            assert_true(mesh_topology(mesh[TISSUE_GREEN], &topology, NULL));
            assert_int_equal(topology.component_count,
                             params.per_cluster + (params.cluster == CLUSTER_RACEME));
            clear(mesh);
        }
    }
}

// Farthest from the axis among a mesh's vertices in this part of a raceme's axis, m.
static float reach_of(const Mesh *mesh, float low, float high)
{
    float reach = 0.0f;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        if (p.y >= low && p.y < high) {
            reach = fmaxf(reach, sqrtf(p.x * p.x + p.z * p.z));
        }
    }
    return reach;
}

// Organs and stalks of a raceme shrink to its end by the taper, and an umbel's do not.
static void racemes_taper(void **state)
{
    (void)state;
    Mesh *even[TISSUES], *tapered[TISSUES];
    OrganParams params = plain(ORGAN_FRUIT);
    params.per_cluster = 60;
    params.axis = 0.3f;
    params.stalk = 0.02f;
    params.spread = 80.0f;
    params.cluster = CLUSTER_RACEME;
    make(&params, even);
    params.taper = 0.8f;
    make(&params, tapered);
    const Mesh *all = even[TISSUE_FLESH], *fewer = tapered[TISSUE_FLESH];
    assert_true(reach_of(fewer, 0.0f, 0.1f) > 0.9f * reach_of(all, 0.0f, 0.1f));
    float end = reach_of(fewer, 0.28f, 0.4f) / reach_of(all, 0.28f, 0.4f);
    assert_true(end > 0.2f && end < 0.45f);
    clear(even);
    clear(tapered);
    params.cluster = CLUSTER_UMBEL;
    make(&params, tapered);
    params.taper = 0.0f;
    make(&params, even);
    assert_memory_equal(even[TISSUE_FLESH]->position, tapered[TISSUE_FLESH]->position,
                        (size_t)even[TISSUE_FLESH]->vertex_count * sizeof(Vec3));
    clear(even);
    clear(tapered);
}

static int64_t pieces(const Mesh *mesh)
{
    MeshTopology topology = {0};
    assert_true(!mesh || mesh_topology(mesh, &topology, NULL));
    return topology.component_count;
}

enum { STAMENS = 30 }; // of a blossom of detail 2; their threads are of the petals' material

static void a_blossom_has_its_petals(void **state)
{
    (void)state;
    OrganParams params = plain(ORGAN_BLOSSOM);
    for (params.detail = 1; params.detail <= 2; params.detail++) {
        int64_t stamens = params.detail == 2 ? STAMENS : 0;
        for (params.petals = 4; params.petals < 25; params.petals += 5) {
            Mesh *mesh[TISSUES];
            make(&params, mesh);
            assert_int_equal(pieces(mesh[TISSUE_PETAL]), params.petals + stamens);
            assert_int_equal(pieces(mesh[TISSUE_ANTHER]), stamens);
            clear(mesh);
        }
    }
}

// From near, the petals of an open flower rise toward their ends around the stamens, as a shallow
// bowl does; plain ones sink.
static void a_blossom_is_hollow(void **state)
{
    (void)state;
    OrganParams params = plain(ORGAN_BLOSSOM);
    params.stalk = 0.0f;
    params.open = 1.0f;
    float rise[3];
    for (params.detail = 1; params.detail <= 2; params.detail++) {
        Mesh *mesh[TISSUES];
        make(&params, mesh);
        double sum = 0.0, ends = 0.0;
        for (int64_t v = 0; v < mesh[TISSUE_PETAL]->vertex_count; v++) {
            Vec3 p = mesh[TISSUE_PETAL]->position[v];
            if (p.x * p.x + p.z * p.z > 0.49f * params.length * params.length) {
                sum += (double)p.y;
                ends += 1.0;
            }
        }
        rise[params.detail] = (float)(sum / ends) / params.length;
        clear(mesh);
    }
    assert_true(rise[2] > 0.22f && rise[2] < 0.5f);
    assert_true(rise[1] < 0.18f);
}

// Closed blossoms have a body in place of petals, no stamens, and stalks two thirds as long.
static void buds_are_closed(void **state)
{
    (void)state;
    OrganParams params = plain(ORGAN_BLOSSOM);
    params.per_cluster = 40;
    params.spread = 0.0f;
    Mesh *mesh[TISSUES];
    make(&params, mesh);
    float open = mesh_bounds(mesh[TISSUE_PETAL]).low.y;
    clear(mesh);
    params.buds = 1.0f;
    make(&params, mesh);
    assert_int_equal(pieces(mesh[TISSUE_PETAL]), params.per_cluster);
    assert_null(mesh[TISSUE_ANTHER]);
    float closed = mesh_bounds(mesh[TISSUE_PETAL]).low.y;
    assert_true(closed > 0.55f * open && closed < 0.75f * open);
    clear(mesh);
    params.buds = 0.3f;
    make(&params, mesh);
    int64_t flowers = pieces(mesh[TISSUE_ANTHER]) / STAMENS;
    assert_true(flowers > 20 && flowers < 36); // 28 are expected
    assert_int_equal(pieces(mesh[TISSUE_PETAL]),
                     params.per_cluster - flowers + flowers * (params.petals + STAMENS));
    clear(mesh);
}

// A cluster on a short shoot is the same, higher by the shoot's length, which ends in scales.
static void clusters_stand_on_spurs(void **state)
{
    (void)state;
    OrganParams params = plain(ORGAN_BLOSSOM);
    params.per_cluster = 3;
    Mesh *low[TISSUES], *high[TISSUES];
    for (params.detail = 1; params.detail <= 2; params.detail++) {
        params.spur = 0.0f;
        make(&params, low);
        params.spur = 0.01f;
        make(&params, high);
        assert_int_equal(low[TISSUE_GREEN]->vertex_count, high[TISSUE_GREEN]->vertex_count);
        for (int64_t v = 0; v < low[TISSUE_GREEN]->vertex_count; v++) {
            Vec3 up = vec3_sub(high[TISSUE_GREEN]->position[v], low[TISSUE_GREEN]->position[v]);
            assert_true(vec3_distance(up, vec3(0, params.spur, 0)) < 1e-6f);
        }
        assert_null(low[TISSUE_WOOD]);
        Aabb shoot = mesh_bounds(high[TISSUE_WOOD]);
        assert_true(fabsf(shoot.low.y) < 1e-6f && shoot.high.y >= params.spur);
        assert_true((shoot.high.y > 1.2f * params.spur) == (params.detail == 2)); // scales
        assert_true(shoot.high.x - shoot.low.x < params.spur);
        clear(low);
        clear(high);
    }
}

// The form for a few pixels has the petals of the true one: about their area and reach, in a tenth
// of the faces, and stalks, but nothing else.
static void a_small_blossom_keeps_its_white(void **state)
{
    (void)state;
    OrganParams params = plain(ORGAN_BLOSSOM);
    params.per_cluster = 4;
    Mesh *fine[TISSUES], *small[TISSUES];
    params.detail = 1;
    make(&params, fine);
    params.detail = 0;
    make(&params, small);
    double area[2] = {0.0, 0.0};
    for (int64_t f = 0; f < fine[TISSUE_PETAL]->face_count; f++) {
        area[0] += quad_area(fine[TISSUE_PETAL], f);
    }
    for (int64_t f = 0; f < small[TISSUE_PETAL]->face_count; f++) {
        assert_true(quad_area(small[TISSUE_PETAL], f) > 1e-11);
        area[1] += quad_area(small[TISSUE_PETAL], f);
    }
    if (fabs(area[1] / area[0] - 1.0) > 0.15) {
        fail_msg("petals of %g m2 instead of %g m2", area[1], area[0]);
    }
    assert_int_equal(small[TISSUE_PETAL]->face_count, 4 * 5 * 2);
    assert_int_equal(small[TISSUE_GREEN]->face_count, 4 * 3);
    Aabb a = mesh_bounds(fine[TISSUE_PETAL]), b = mesh_bounds(small[TISSUE_PETAL]);
    assert_true(vec3_distance(a.low, b.low) < 0.2f * params.length);
    assert_true(vec3_distance(a.high, b.high) < 0.2f * params.length);
    clear(fine);
    clear(small);
}

// A fruit without a dimple is an ellipsoid: its volume by the divergence theorem.
static void a_fruit_is_an_ellipsoid(void **state)
{
    (void)state;
    OrganParams params = plain(ORGAN_FRUIT);
    Mesh *mesh[TISSUES];
    make(&params, mesh);
    double volume = 0.0;
    const Mesh *body = mesh[TISSUE_FLESH];
    for (int64_t f = 0; f < body->face_count; f++) {
        Vec3 p[4];
        for (int k = 0; k < 4; k++) {
            p[k] = body->position[body->index[4 * f + k]];
        }
        volume += (double)vec3_dot(p[0], vec3_cross(p[1], p[2])) / 6.0 +
                  (double)vec3_dot(p[0], vec3_cross(p[2], p[3])) / 6.0;
    }
    // Sizes of the cluster's members vary by 0.88 to 1.08.
    Aabb box = mesh_bounds(body);
    double length = (double)(box.high.y - box.low.y), width = (double)(box.high.x - box.low.x);
    double wanted = 3.14159265 / 6.0 * length * width * width;
    assert_true(volume > 0.93 * wanted && volume < 1.03 * wanted);
    assert_true(length > 0.87 * 0.05 && length < 1.09 * 0.05);
    clear(mesh);
}

// Largest distance of the mesh's vertices from +Y above this height, m.
static float reach_above(const Mesh *mesh, float low)
{
    return reach_of(mesh, low, INFINITY);
}

// A water lily opens: petals spread as far as they are long, stamens stay within them, sepals lie
// below; its bud is an egg that sepals hold, without stamens.
static void water_lilies_open(void **state)
{
    (void)state;
    OrganParams params = plain(ORGAN_WATER_LILY);
    params.length = 0.06f;
    params.width = 0.024f;
    params.stalk = 0.0f;
    params.petals = 24;
    for (params.detail = 1; params.detail <= 2; params.detail++) {
        Mesh *shut[TISSUES], *open[TISSUES], *bud[TISSUES];
        params.buds = params.open = 0.0f;
        make(&params, shut);
        params.open = 1.0f;
        make(&params, open);
        params.buds = 1.0f;
        make(&params, bud);
        float wide = reach_above(open[TISSUE_PETAL], -1.0f);
        assert_true(wide > 0.8f * params.length && wide < 1.15f * params.length);
        assert_true(reach_above(shut[TISSUE_PETAL], -1.0f) < 0.8f * wide);
        assert_true(reach_above(open[TISSUE_ANTHER], -1.0f) < 0.75f * wide);
        assert_true(mesh_bounds(open[TISSUE_GREEN]).low.y < mesh_bounds(open[TISSUE_PETAL]).low.y);
        assert_null(bud[TISSUE_ANTHER]);
        assert_true(reach_above(bud[TISSUE_GREEN], -1.0f) < 0.45f * wide);
        clear(shut);
        clear(open);
        clear(bud);
    }
}

// As many petals as asked for, within four sepals that are white inside.
static void water_lilies_have_their_petals(void **state)
{
    (void)state;
    OrganParams params = plain(ORGAN_WATER_LILY);
    int64_t faces[3];
    for (int i = 0; i < 3; i++) {
        Mesh *mesh[TISSUES];
        params.petals = 10 + 8 * i;
        make(&params, mesh);
        faces[i] = mesh[TISSUE_PETAL]->face_count;
        clear(mesh);
    }
    assert_int_equal(faces[2] - faces[1], faces[1] - faces[0]);
    assert_int_equal(8 * faces[0], (10 + 4) * (faces[1] - faces[0]));
}

static OrganParams bell(void)
{
    OrganParams params = plain(ORGAN_BELL);
    params.length = 0.02f;
    params.width = 0.008f;
    params.stalk = 0.0f;
    params.petals = 6;
    params.open = 0.0f;
    return params;
}

// Closed tips end a tube as wide as asked for and as long as its petals; open ones curl out and
// back.
static void bells_curl_back(void **state)
{
    (void)state;
    OrganParams params = bell();
    for (params.detail = 1; params.detail <= 2; params.detail++) {
        Mesh *tube[TISSUES], *open[TISSUES];
        params.open = 0.0f;
        make(&params, tube);
        params.open = 1.0f;
        make(&params, open);
        float tube_high = mesh_bounds(tube[TISSUE_PETAL]).high.y;
        float size = tube_high / params.length; // sizes vary
        assert_true(size > 0.87f && size < 1.09f);
        float reach = reach_above(tube[TISSUE_PETAL], 0.0f);
        assert_true(reach > 0.45f * size * params.width && reach < 0.6f * size * params.width);
        assert_true(reach_above(open[TISSUE_PETAL], 0.0f) > 1.4f * reach);
        // The farthest out is above the mouth's rim no more, but curled back.
        float rim = mesh_bounds(open[TISSUE_PETAL]).high.y;
        assert_true(rim < 0.93f * tube_high);
        assert_true(reach_above(open[TISSUE_PETAL], 0.98f * rim) <
                    0.95f * reach_above(open[TISSUE_PETAL], 0.0f));
        int64_t more = params.detail > 1 ? params.petals + 1 : 0; // filaments and the style
        assert_int_equal(pieces(open[TISSUE_PETAL]), params.petals + more);
        assert_int_equal(pieces(open[TISSUE_ANTHER]), params.detail > 1 ? params.petals : 0);
        for (int64_t f = 0; f < open[TISSUE_PETAL]->face_count; f++) {
            assert_true(quad_area(open[TISSUE_PETAL], f) > 1e-13);
        }
        clear(tube);
        clear(open);
    }
}

// Of a raceme with a share of buds the last are closed: narrow at their ends, without anthers.
static void the_last_bells_are_buds(void **state)
{
    (void)state;
    OrganParams params = bell();
    params.cluster = CLUSTER_RACEME;
    params.per_cluster = 20;
    params.buds = 0.5f;
    params.open = 1.0f;
    params.spread = 0.0f;
    Mesh *mesh[TISSUES];
    make(&params, mesh);
    int64_t open = pieces(mesh[TISSUE_ANTHER]) / params.petals;
    assert_true(open >= 8 && open <= 12);
    assert_true(mesh_bounds(mesh[TISSUE_ANTHER]).high.y < 0.75f * params.axis);
    float half = 0.6f * params.width;
    assert_true(reach_of(mesh[TISSUE_PETAL], 0.0f, 0.3f * params.axis) > 1.2f * half);
    assert_true(reach_of(mesh[TISSUE_PETAL], 0.8f * params.axis, INFINITY) < half);
    clear(mesh);
}

static Vec3 middle_of(const Mesh *mesh)
{
    Vec3 sum = vec3(0, 0, 0);
    for (int64_t v = 0; v < mesh->vertex_count; v++) {
        sum = vec3_add(sum, mesh->position[v]);
    }
    return vec3_scale(sum, 1.0f / (float)mesh->vertex_count);
}

// An axis bends toward +X as far as asked for, its organs turn to that side and hang, and each has
// its bracts.
static void racemes_arch_and_nod(void **state)
{
    (void)state;
    OrganParams params = plain(ORGAN_FRUIT);
    params.length = params.width = 0.006f;
    params.stalk = 0.03f;
    params.per_cluster = 24;
    params.cluster = CLUSTER_RACEME;
    params.spread = 80.0f;
    Mesh *upright[TISSUES], *other[TISSUES];
    make(&params, upright);
    Vec3 middle = middle_of(upright[TISSUE_FLESH]);
    assert_true(fabsf(middle.x) < 0.006f && fabsf(middle.z) < 0.006f);
    params.one_sided = 1.0f;
    make(&params, other);
    assert_true(middle_of(other[TISSUE_FLESH]).x > middle.x + 0.01f);
    clear(other);
    params.one_sided = 0.0f;
    params.nod = 1.0f;
    make(&params, other);
    assert_true(middle_of(other[TISSUE_FLESH]).y < middle.y - 0.007f);
    clear(other);
    params.nod = 0.0f;
    params.bracts = 2;
    params.bract_length = 0.01f;
    make(&params, other);
    assert_int_equal(pieces(other[TISSUE_GREEN]), 1 + params.per_cluster * (1 + params.bracts));
    clear(other);
    params.arch = 90.0f; // its end runs level, at a height of about a half to nine tenths
    make(&params, other);
    Aabb box = mesh_bounds(other[TISSUE_FLESH]);
    assert_true(box.high.x > 0.35f * params.axis && box.low.x > -0.04f);
    assert_true(box.high.y < mesh_bounds(upright[TISSUE_FLESH]).high.y - 0.03f);
    clear(other);
    clear(upright);
}

// The opening decides how far scales stand off.
static void cones_open(void **state)
{
    (void)state;
    float before = 0.0f;
    for (int i = 0; i <= 2; i++) {
        OrganParams params = plain(ORGAN_CONE);
        params.open = 0.5f * (float)i;
        Mesh *mesh[TISSUES];
        make(&params, mesh);
        Aabb box = mesh_bounds(mesh[TISSUE_WOOD]);
        assert_true(box.high.x - box.low.x > before);
        before = box.high.x - box.low.x;
        clear(mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(organs_have_their_tissues_and_size),
        cmocka_unit_test(clusters_have_as_many_as_asked_for),
        cmocka_unit_test(racemes_taper),
        cmocka_unit_test(a_blossom_has_its_petals),
        cmocka_unit_test(a_blossom_is_hollow),
        cmocka_unit_test(buds_are_closed),
        cmocka_unit_test(clusters_stand_on_spurs),
        cmocka_unit_test(a_small_blossom_keeps_its_white),
        cmocka_unit_test(a_fruit_is_an_ellipsoid),
        cmocka_unit_test(cones_open),
        cmocka_unit_test(bells_curl_back),
        cmocka_unit_test(water_lilies_open),
        cmocka_unit_test(water_lilies_have_their_petals),
        cmocka_unit_test(the_last_bells_are_buds),
        cmocka_unit_test(racemes_arch_and_nod),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
