#include "mesh/organ/organ.h"

#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/organ/organ_parts.h"

#include <stddef.h>

enum {
    STREAM_SPUR = 1,
    STREAM_AXIS = 2,
    STREAM_ONES = 10
}; // of an organ; ONES + i: number i of the cluster
enum { STREAM_OPEN = 1, STREAM_TURN = 2, STREAM_STALK = 3, STREAM_SIZE = 4, STREAM_FORM = 5 };
enum { STREAM_BRACTS = 6, STREAM_NOD = 7 };

void organ_set_place(OrganBuild *build, const Transform *place)
{
    for (int t = 0; t < TISSUES; t++) {
        build->tissue[t].place = place;
    }
}

Transform organ_frame(Vec3 p, float open, float turn)
{
    float sine, cosine, x, z;
    exact_sincos(open * RADIANS_PER_DEGREE, &sine, &cosine);
    exact_sincos(turn * RADIANS_PER_DEGREE, &z, &x);
    Vec3 out = vec3(x, 0, z), up = vec3(0, 1, 0);
    Vec3 y = vec3_madd(vec3_scale(up, cosine), sine, out);
    Vec3 inward = vec3_madd(vec3_scale(up, sine), -cosine, out); // the sheet's upper side
    return transform_from_axes(vec3_cross(y, inward), y, inward, p);
}

void organ_stalk(OrganBuild *build, Vec3 p, float radius)
{
    enum { POINTS = 5 };
    int points = build->params->detail > 0 ? POINTS : 2;
    if (!(vec3_dot(p, p) > 0.0f)) {
        return;
    }
    Vec3 axis[POINTS], knee = vec3(0, 0.45f * vec3_length(p), 0);
    float thick[POINTS];
    for (int i = 0; i < points; i++) {
        float t = (float)i / (float)(points - 1);
        Vec3 first = vec3_scale(knee, t), second = vec3_lerp(knee, p, t);
        axis[i] = vec3_lerp(first, second, t);
        thick[i] = radius * (1.0f - 0.3f * t);
    }
    quads_tube(&build->tissue[TISSUE_GREEN], axis, thick, points, 3, (Vec2){0.5f, 0.0f});
}

void organ_sheet(Quads *quads, const float *length, const float *half, const float *lift, int rows,
                 float cup)
{
    enum { COLUMNS = 5 };
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int r = 0; r < rows; r++) {
        for (int c = 0; c < COLUMNS; c++) {
            float across = (float)c / (COLUMNS - 1) * 2.0f - 1.0f;
            float edge = across * across;
            quads_vertex(quads, vec3(half[r] * across, length[r], lift[r] + cup * half[r] * edge),
                         (Vec2){0.5f + 0.5f * across, (float)r / (float)(rows - 1)});
        }
    }
    quads_grid(quads, first, rows, COLUMNS);
}

// Length of a closed blossom's stalk, which still grows, relative to an open one's.
#define CLOSED_STALK 0.65f

static void add_one(OrganBuild *build, uint64_t seed)
{
    static void (*const add[])(OrganBuild *, uint64_t) = {
        [ORGAN_BLOSSOM] = organ_blossom, [ORGAN_CATKIN] = organ_catkin,
        [ORGAN_FRUIT] = organ_fruit,     [ORGAN_CONE] = organ_cone,
        [ORGAN_ACORN] = organ_acorn,     [ORGAN_HUSK] = organ_husk,
        [ORGAN_BUD] = organ_bud,         [ORGAN_SAMARA] = organ_samara,
        [ORGAN_THORN] = organ_thorn,     [ORGAN_DAISY] = organ_daisy,
        [ORGAN_BELL] = organ_bell,       [ORGAN_WATER_LILY] = organ_water_lily};
    add[build->params->kind](build, seed);
}

// Where number i of the cluster starts, and how far its stalk leans (degrees).
static Vec3 start_of(const OrganParams *p, int i, float *lean)
{
    float rank = ((float)i + 0.5f) / (float)p->per_cluster;
    if (p->cluster == CLUSTER_RACEME) {
        *lean = p->spread * (1.0f - 0.5f * rank);
        return vec3(0, p->spur + p->axis * (0.12f + 0.88f * rank), 0);
    }
    *lean = p->per_cluster > 1 ? p->spread * sqrtf(rank) : 0.0f;
    return vec3(0, p->spur, 0);
}

// Size of number i of the cluster and of its stalk, relative to the full-grown.
static float age_of(const OrganParams *p, int i)
{
    float rank = ((float)i + 0.5f) / (float)p->per_cluster;
    return p->cluster == CLUSTER_RACEME ? 1.0f - p->taper * rank * rank : 1.0f;
}

// Does the cluster's axis bend, or do its members hang or stand above bracts?
static bool is_plain(const OrganParams *p)
{
    return !(p->arch > 0.0f || p->one_sided > 0.0f || p->nod > 0.0f || p->bracts > 0);
}

// Radius of a cluster's stalks, m.
static float stalk_radius(const OrganParams *p)
{
    float share = p->kind == ORGAN_BELL ? 0.075f : p->kind == ORGAN_WATER_LILY ? 0.14f : 0.03f;
    return fmaxf(share * p->width, 0.0004f);
}

// The frame of a member at the end of its stalk, which it adds.
static Transform add_straight_stalk(OrganBuild *build, Vec3 start, float lean, float turn,
                                    float stalk)
{
    Transform frame = organ_frame(start, lean, turn);
    Vec3 end = transform_point(&frame, vec3(0, stalk, 0));
    organ_set_place(build, NULL);
    if (stalk > 0.0f) {
        Transform at = transform_from_axes(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), start);
        organ_set_place(build, &at);
        organ_stalk(build, vec3_sub(end, start), stalk_radius(build->params));
    }
    return organ_frame(end, lean, turn);
}

// The same on an axis that bends, with bracts, turned to one side and hanging as far as asked for.
static Transform add_hanging_stalk(OrganBuild *build, const OrganAxis *axis, Vec3 start, float lean,
                                   float turn, float stalk, float age, uint64_t key)
{
    const OrganParams *p = build->params;
    float along = p->axis > 0.0f ? (start.y - p->spur) / p->axis : 0.0f;
    Transform at = p->cluster == CLUSTER_RACEME
                       ? organ_axis_frame(axis, along)
                       : transform_from_axes(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), start);
    float round = turn - 360.0f * floorf(turn / 360.0f + 0.5f); // -180..180
    Transform own = organ_frame(vec3(0, 0, 0), lean, round * (1.0f - 0.75f * p->one_sided));
    Transform frame = transform_multiply(&at, &own);
    organ_set_place(build, NULL);
    organ_bracts(build, &frame, age, random_key(key, STREAM_BRACTS));
    // Buds look along the axis until their stalks have grown.
    float grown = p->cluster == CLUSTER_RACEME ? 1.0f - 0.75f * along * along * along : 1.0f;
    float nod = p->nod * grown * random_range(random_key(key, STREAM_NOD), 0.88f, 1.12f);
    return organ_nodding_stalk(build, &frame, stalk, clampf(nod, 0.0f, 1.0f), stalk_radius(p));
}

static void add_member(OrganBuild *build, const OrganAxis *axis, int i, uint64_t key)
{
    const OrganParams *p = build->params;
    float lean, age = age_of(p, i);
    float size = age * random_range(random_key(key, STREAM_SIZE), 0.88f, 1.08f);
    Vec3 start = start_of(p, i, &lean);
    lean *= random_range(random_key(key, STREAM_OPEN), 0.8f, 1.2f);
    float turn =
        (float)i * ORGAN_DIVERGENCE + random_range(random_key(key, STREAM_TURN), -20.0f, 20.0f);
    uint64_t form = random_key(key, STREAM_FORM);
    float stalk = age * p->stalk * random_range(random_key(key, STREAM_STALK), 0.8f, 1.15f);
    stalk *= organ_is_closed(p, form) ? CLOSED_STALK : 1.0f;
    build->rank = ((float)i + 0.5f) / (float)p->per_cluster;
    Transform own = is_plain(p)
                        ? add_straight_stalk(build, start, lean, turn, stalk)
                        : add_hanging_stalk(build, axis, start, lean, turn, stalk, age, key);
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            own.m[row][column] *= size;
        }
    }
    organ_set_place(build, &own);
    add_one(build, form);
    organ_set_place(build, NULL);
}

static void add_cluster(OrganBuild *build, uint64_t seed)
{
    const OrganParams *p = build->params;
    OrganAxis axis = organ_axis(p, random_key(seed, STREAM_AXIS));
    if (p->cluster == CLUSTER_RACEME) {
        if (is_plain(p)) {
            organ_stalk(build, vec3(0, p->spur + p->axis, 0), 1.3f * stalk_radius(p));
        } else {
            organ_axis_add(build, &axis, 2.0f * stalk_radius(p));
        }
    }
    if (p->spur > 0.0f) {
        organ_spur(build, random_key(seed, STREAM_SPUR));
    }
    for (int i = 0; i < p->per_cluster; i++) {
        add_member(build, &axis, i, random_key(seed, STREAM_ONES + (uint64_t)i));
    }
}

bool organ_meshes(const OrganParams *params, uint64_t seed, Mesh *mesh[TISSUES], Error *e)
{
    OrganBuild build = {.params = params};
    for (int t = 0; t < TISSUES; t++) {
        build.tissue[t].e = e;
        mesh[t] = NULL;
    }
    add_cluster(&build, seed);
    bool done = true;
    for (int t = 0; t < TISSUES; t++) {
        bool some = build.tissue[t].failed || build.tissue[t].face_count > 0;
        mesh[t] = some && done ? quads_mesh(&build.tissue[t]) : NULL;
        done = done && (mesh[t] || !some);
        quads_clear(&build.tissue[t]);
    }
    for (int t = 0; t < TISSUES && !done; t++) {
        mesh_free(mesh[t]);
        mesh[t] = NULL;
    }
    return done;
}
