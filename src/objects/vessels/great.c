// The great arteries and veins of a body: courses through its trunk and limbs, from which growth
// starts.
#include "base/random.h"
#include "objects/vessels/stem.h"

// In a body of height 1 (see shape/body.h): the body's left is +x.
typedef struct Course {
    int from_course, from_point; // where it branches from another; -1 = the heart
    bool both_sides;             // this is the left one; the right mirrors it
    int count;
    float point[12][3];
} Course;

static const Course ARTERIES[] = {
    // aorta: heart, arch, down before the spine
    {-1,
     0,
     false,
     9,
     {{0.008f, 0.705f, 0.016f},
      {0.004f, 0.740f, 0.020f},
      {0.004f, 0.766f, 0.012f},
      {0.009f, 0.774f, -0.004f},
      {0.013f, 0.762f, -0.022f},
      {0.012f, 0.730f, -0.032f},
      {0.008f, 0.680f, -0.032f},
      {0.005f, 0.635f, -0.028f},
      {0.003f, 0.588f, -0.022f}}},
    // iliac, femoral, tibial
    {0,
     8,
     true,
     11,
     {{0.014f, 0.565f, -0.010f},
      {0.032f, 0.530f, 0.006f},
      {0.048f, 0.492f, 0.022f},
      {0.054f, 0.450f, 0.024f},
      {0.052f, 0.390f, 0.014f},
      {0.055f, 0.330f, -0.004f},
      {0.059f, 0.285f, -0.014f},
      {0.060f, 0.225f, -0.010f},
      {0.062f, 0.140f, -0.008f},
      {0.064f, 0.055f, 0.000f},
      {0.069f, 0.026f, 0.040f}}},
    // deep artery of the thigh
    {1,
     3,
     true,
     3,
     {{0.066f, 0.425f, 0.008f}, {0.072f, 0.380f, -0.006f}, {0.070f, 0.335f, -0.014f}}},
    // subclavian, brachial, radial
    {0,
     3,
     true,
     9,
     {{0.030f, 0.800f, -0.008f},
      {0.066f, 0.804f, -0.004f},
      {0.102f, 0.785f, -0.002f},
      {0.126f, 0.735f, 0.000f},
      {0.150f, 0.680f, 0.004f},
      {0.170f, 0.638f, 0.004f},
      {0.192f, 0.585f, 0.006f},
      {0.216f, 0.510f, 0.009f},
      {0.231f, 0.466f, 0.011f}}},
    // ulnar
    {3,
     5,
     true,
     3,
     {{0.176f, 0.605f, -0.006f}, {0.200f, 0.540f, -0.002f}, {0.221f, 0.474f, 0.006f}}},
    // carotid
    {0,
     2,
     true,
     5,
     {{0.014f, 0.806f, 0.004f},
      {0.018f, 0.850f, 0.006f},
      {0.021f, 0.890f, 0.006f},
      {0.020f, 0.925f, 0.000f},
      {0.014f, 0.960f, 0.002f}}},
    // renal, mesenteric
    {0, 7, true, 2, {{0.026f, 0.636f, -0.024f}, {0.048f, 0.640f, -0.020f}}},
    {0,
     6,
     false,
     3,
     {{0.006f, 0.660f, -0.006f}, {0.004f, 0.630f, 0.014f}, {0.000f, 0.590f, 0.022f}}},
};

static const Course VEINS[] = {
    // upper and lower vena cava, from the right of the heart
    {-1,
     0,
     false,
     4,
     {{-0.018f, 0.705f, 0.012f},
      {-0.024f, 0.735f, 0.014f},
      {-0.028f, 0.762f, 0.016f},
      {-0.026f, 0.785f, 0.018f}}},
    {0,
     0,
     false,
     5,
     {{-0.018f, 0.685f, -0.002f},
      {-0.018f, 0.650f, -0.014f},
      {-0.018f, 0.610f, -0.020f},
      {-0.016f, 0.575f, -0.030f},
      {-0.010f, 0.552f, -0.036f}}},
    // iliac, femoral, popliteal: inside and behind the artery
    {1,
     4,
     true,
     11,
     {{0.012f, 0.540f, -0.032f},
      {0.030f, 0.510f, -0.010f},
      {0.036f, 0.480f, 0.010f},
      {0.041f, 0.445f, 0.010f},
      {0.043f, 0.390f, 0.000f},
      {0.049f, 0.330f, -0.016f},
      {0.062f, 0.285f, -0.025f},
      {0.066f, 0.225f, -0.024f},
      {0.066f, 0.140f, -0.020f},
      {0.060f, 0.055f, -0.014f},
      {0.060f, 0.022f, 0.004f}}},
    // the long vein of the leg, under the skin
    {2,
     3,
     true,
     5,
     {{0.032f, 0.410f, 0.016f},
      {0.034f, 0.340f, 0.012f},
      {0.038f, 0.275f, 0.004f},
      {0.040f, 0.180f, 0.000f},
      {0.050f, 0.060f, 0.000f}}},
    // brachiocephalic, subclavian, brachial
    {0,
     3,
     true,
     9,
     {{0.030f, 0.792f, 0.022f},
      {0.066f, 0.792f, 0.014f},
      {0.098f, 0.768f, 0.010f},
      {0.116f, 0.722f, 0.010f},
      {0.138f, 0.672f, 0.012f},
      {0.157f, 0.632f, 0.014f},
      {0.178f, 0.585f, 0.016f},
      {0.204f, 0.516f, 0.014f},
      {0.220f, 0.474f, 0.016f}}},
    // jugular
    {4,
     0,
     true,
     5,
     {{0.031f, 0.815f, 0.012f},
      {0.028f, 0.850f, -0.004f},
      {0.030f, 0.890f, -0.010f},
      {0.030f, 0.925f, -0.016f},
      {0.024f, 0.958f, -0.022f}}},
    // renal, portal
    {1, 1, true, 2, {{0.010f, 0.648f, -0.014f}, {0.040f, 0.652f, -0.010f}}},
    {1,
     0,
     false,
     3,
     {{-0.020f, 0.672f, 0.010f}, {-0.024f, 0.640f, 0.022f}, {-0.016f, 0.595f, 0.026f}}},
};

enum {
    ARTERY_COUNT = sizeof ARTERIES / sizeof ARTERIES[0],
    VEIN_COUNT = sizeof VEINS / sizeof VEINS[0],
    MOST_COURSES = ARTERY_COUNT > VEIN_COUNT ? ARTERY_COUNT : VEIN_COUNT,
    MOST_POINTS = 13
};

#define NODE_SPACING 0.006f // of the height

float vessels_aorta_radius(const Shape *body)
{
    Vec3 up = transform_vector(&body->transform, vec3(0, body->size.x, 0));
    return 0.0066f * vec3_length(up);
}

typedef struct Planting {
    OutTree *tree;
    const Shape *body;
    int32_t colony;
    int64_t node[MOST_COURSES][2][MOST_POINTS]; // nodes of each course's points, left and right
} Planting;

static Vec3 place(const Planting *p, Vec3 at)
{
    return transform_point(&p->body->transform, vec3_scale(at, p->body->size.x));
}

// Interpolates between b and c, with slopes from their neighbours (Catmull-Rom).
static Vec3 between(Vec3 a, Vec3 b, Vec3 c, Vec3 d, float t)
{
    Vec3 m0 = vec3_scale(vec3_sub(c, a), 0.5f), m1 = vec3_scale(vec3_sub(d, b), 0.5f);
    float t2 = t * t, t3 = t2 * t;
    Vec3 p = vec3_scale(b, 2.0f * t3 - 3.0f * t2 + 1.0f);
    p = vec3_madd(p, t3 - 2.0f * t2 + t, m0);
    p = vec3_madd(p, -2.0f * t3 + 3.0f * t2, c);
    return vec3_madd(p, t3 - t2, m1);
}

// Adds the nodes of one course on one side; point[0] is where it starts.
static bool follow(Planting *p, const Vec3 *point, int count, int64_t parent, int64_t *node,
                   uint64_t id, Error *e)
{
    for (int i = 0; i + 1 < count; i++) {
        Vec3 before = point[i > 0 ? i - 1 : 0], after = point[i + 2 < count ? i + 2 : count - 1];
        int pieces = (int)(vec3_distance(point[i], point[i + 1]) / NODE_SPACING) + 1;
        for (int k = 1; k <= pieces; k++) {
            float t = (float)k / (float)pieces;
            Vec3 at = place(p, between(before, point[i], point[i + 1], after, t));
            int32_t birth = p->tree->birth[parent] + 1;
            parent = out_tree_add_node(p->tree, at, parent, birth, p->colony, id, e);
            if (parent < 0) {
                return false;
            }
            id = out_tree_child_id(id, 0);
        }
        node[i + 1] = parent;
    }
    return true;
}

static Vec3 to_vec3(const float at[3], bool right)
{
    return vec3(right ? -at[0] : at[0], at[1], at[2]);
}

static bool plant_course(Planting *p, const Course *courses, int number, bool right, uint64_t seed,
                         Error *e)
{
    const Course *course = &courses[number];
    Vec3 point[MOST_POINTS];
    int count = 0;
    int64_t *node = p->node[number][right], parent;
    uint64_t id = random_key(random_key(seed, (uint64_t)number), right);
    if (course->from_course < 0) {
        point[count++] = to_vec3(course->point[0], right);
        parent = out_tree_add_node(p->tree, place(p, point[0]), -1, 0, p->colony, id, e);
        if (parent < 0) {
            return false;
        }
        id = out_tree_child_id(id, 0);
    } else {
        const Course *from = &courses[course->from_course];
        bool side = right && from->both_sides;
        parent = p->node[course->from_course][side][course->from_point];
        if (right && !side && course->from_point + 1 < from->count) {
            // both sides leave the middle one after the other, because forks are binary
            parent = p->tree->parent[p->tree->parent[parent]];
        }
        point[count++] = to_vec3(from->point[course->from_point], side);
    }
    node[0] = parent;
    for (int i = course->from_course < 0; i < course->count; i++) {
        point[count++] = to_vec3(course->point[i], right);
    }
    if (!follow(p, point, count, parent, node, id, e)) {
        return false;
    }
    if (course->from_course >= 0) { // index the points as in the table, without the first
        for (int i = 0; i + 1 < count; i++) {
            node[i] = node[i + 1];
        }
    }
    return true;
}

bool vessels_plant_great(OutTree *tree, const Shape *body, int32_t colony, uint64_t seed, Error *e)
{
    Planting p = {.tree = tree, .body = body, .colony = colony};
    const Course *courses = colony == VESSELS_VEINS ? VEINS : ARTERIES;
    int count = colony == VESSELS_VEINS ? VEIN_COUNT : ARTERY_COUNT;
    uint64_t key = random_key(seed, (uint64_t)colony);
    for (int i = 0; i < count; i++) {
        for (int right = 0; right < (courses[i].both_sides ? 2 : 1); right++) {
            if (!plant_course(&p, courses, i, right, key, e)) {
                return false;
            }
        }
    }
    return true;
}
