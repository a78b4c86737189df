#include "objects/common/leaf_place.h"

#include "base/exact_math.h"
#include "base/random.h"
#include "base/turn.h"

// Of a leaf; LEAVES + k: leaf k of a node.
enum {
    STREAM_ANGLE = 1,
    STREAM_LIGHT = 2,
    STREAM_SIZE = 3,
    STREAM_ROLL = 4,
    STREAM_TURN = 8,
    STREAM_LEAVES = 100
};

static const Vec3 UP = {0, 1, 0};

static Vec3 across(Vec3 v, Vec3 along)
{
    v = vec3_madd(v, -vec3_dot(v, along), along);
    return vec3_dot(v, v) > 1e-6f ? vec3_normalize(v) : vec3_perpendicular(along);
}

Vec3 leaf_reference(const LeavesParams *leaves, Vec3 reference, Vec3 along)
{
    if (leaves->arrangement == ARRANGE_DISTICHOUS) {
        Vec3 level = vec3_cross(along, UP);
        reference = vec3_dot(level, level) > 0.01f ? level : reference;
    }
    return across(reference, along);
}

uint64_t leaf_key(const LeafNode *node, int k)
{
    return k == 0 ? node->key : random_key(node->key, STREAM_LEAVES + (uint64_t)k);
}

float leaf_size_at(const LeavesParams *leaves, int64_t number)
{
    int64_t small = leaves->tip_leaves;
    return number < small ? (float)(number + 1) / (float)(small + 1) : 1.0f;
}

float leaf_size_above_base(const LeavesParams *leaves, float distance, float spacing)
{
    const float least = 1.0f / 3.0f;
    float reach = (float)leaves->base_leaves * spacing;
    return reach > 0.0f && distance < reach ? lerpf(least, 1.0f, distance / reach) : 1.0f;
}

// Azimuth (degrees) about the twig of leaf number k of the node.
static float azimuth(const LeavesParams *leaves, const LeafNode *node, int k, uint64_t key)
{
    float n = (float)node->number, within = 0.0f, step = leaves->phyllotaxis;
    switch (leaves->arrangement) {
    case ARRANGE_ALTERNATE:
        step = 144.0f;
        break;
    case ARRANGE_DISTICHOUS:
        step = 180.0f;
        break;
    case ARRANGE_OPPOSITE:
        step = 90.0f;
        within = 180.0f * (float)k;
        break;
    case ARRANGE_WHORLED:
        within = 360.0f * (float)k / (float)leaves_per_node(leaves);
        step = 180.0f / (float)leaves_per_node(leaves);
        break;
    case ARRANGE_ROSETTE:
        within = 137.507764f * (float)k;
        break;
    case ARRANGE_SPIRAL:
    case ARRANGE_SPURS:
        break;
    }
    return n * step + within + 8.0f * (random_unit(random_key(key, STREAM_TURN)) - 0.5f);
}

// Turns a leaf's axis y into the level spray of its twig, or that of a rosette into a level plane,
// its upper side z up.
static void flatten(const LeavesParams *leaves, Vec3 along, Vec3 *y, Vec3 *z)
{
    Vec3 up = leaves->arrangement == ARRANGE_ROSETTE ? UP : across(UP, along);
    *y = vec3_normalize(vec3_madd(*y, -leaves->plane * vec3_dot(*y, up), up));
    *z = vec3_add(vec3_scale(*z, 1.0f - leaves->plane), vec3_scale(up, leaves->plane));
}

// Where the leaves at p turn to: up and away from the crown's middle, or off the surface.
static Vec3 light_at(const LeafLight *light, Vec3 p)
{
    if (light->facing) {
        return vec3_madd(vec3(0, 0.5f, 0), 1.2f, light->facing(light->user, p));
    }
    Vec3 away = vec3_normalize(vec3_sub(p, light->center));
    return vec3_add(vec3(0, 1.2f, 0), vec3_scale(away, 0.7f));
}

// A leaf at p on the side `out` of a twig that runs along `along`.
static Transform leaf_frame(const LeavesParams *leaves, Vec3 p, Vec3 along, Vec3 out, float open,
                            const LeafLight *light, uint64_t key)
{
    float grown = leaves_emergence(leaves, key); // young leaves are small and stand closer
    float angle = open * random_range(random_key(key, STREAM_ANGLE), 0.7f, 1.3f), sine, cosine;
    angle *= 0.4f + 0.6f * grown;
    exact_sincos(angle * RADIANS_PER_DEGREE, &sine, &cosine);
    Vec3 y = vec3_madd(vec3_scale(along, cosine), sine, out);
    Vec3 z = vec3_madd(vec3_scale(along, sine), -cosine, out);
    if (leaves->plane > 0.0f) {
        flatten(leaves, along, &y, &z);
    }
    // Blades sag under their weight and turn the upper side to the light, with random deviations.
    y = vec3_normalize(vec3_madd(y, leaves->droop * 0.6f, vec3(0, -1, 0)));
    if (leaves->hang > 0.0f) {
        Vec3 down = vec3_madd(vec3(0, -1, 0), 0.25f, y);
        y = vec3_normalize(vec3_lerp(y, down, leaves->hang));
    }
    Vec3 upper = light_at(light, p);
    upper = vec3_madd(upper, 0.55f, random_direction(random_key(key, STREAM_LIGHT)));
    z = vec3_add(vec3_scale(z, 1.0f - leaves->droop), vec3_scale(upper, leaves->droop));
    z = vec3_madd(z, -vec3_dot(z, y), y);
    z = vec3_dot(z, z) > 1e-6f ? vec3_normalize(z) : vec3_perpendicular(y);
    float size = 1.0f - leaves->size_variation * random_unit(random_key(key, STREAM_SIZE));
    size *= 0.12f + 0.88f * grown;
    return transform_from_axes(vec3_scale(vec3_cross(y, z), size), vec3_scale(y, size),
                               vec3_scale(z, size), p);
}

static Vec3 side_at(const LeafNode *node, float degrees)
{
    return vec3_turn(node->reference, node->along, degrees);
}

// Scales about the frame's origin.
static Transform resized(Transform frame, float size)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            frame.m[i][j] *= size;
        }
    }
    return frame;
}

// A leaf of a short shoot, which leaves the twig at right angles.
static Transform place_on_spur(const LeavesParams *leaves, const LeafNode *node, int k,
                               const LeafLight *light, uint64_t key)
{
    const float spur_length = 0.008f;
    Vec3 spur = side_at(node, azimuth(leaves, node, 0, node->key));
    spur = vec3_normalize(vec3_madd(spur, 0.35f, node->along));
    Vec3 tip = vec3_madd(node->position, node->radius + spur_length, spur);
    LeafNode end = {.along = spur, .reference = vec3_perpendicular(spur)};
    Vec3 out = side_at(&end, 137.507764f * (float)k);
    return leaf_frame(leaves, tip, spur, out, leaves->angle, light, key);
}

// A dead leaf below the rosette: it hangs about the trunk, the older the lower and the closer.
static Transform place_withered(const LeavesParams *leaves, const LeafNode *node, int k,
                                const LeafLight *light, uint64_t key)
{
    const float least = 105.0f, most = 150.0f; // degrees from the trunk's direction
    const float depth = 3.0f;                  // trunk radii that the skirt's bases cover
    float age = ((float)(k - leaves_per_node(leaves)) + 0.5f) / (float)leaves->withered;
    Vec3 out = side_at(node, azimuth(leaves, node, k, key));
    Vec3 p = vec3_madd(node->position, -(1.8f + depth * age) * node->radius, node->along);
    p = vec3_madd(p, 0.85f * node->radius, out);
    return leaf_frame(leaves, p, node->along, out, lerpf(least, most, age), light, key);
}

// A leaf of a rosette: the innermost nearly upright, the outermost at the full angle and lower.
static Transform place_in_rosette(const LeavesParams *leaves, const LeafNode *node, int k,
                                  const LeafLight *light, uint64_t key)
{
    if (k >= leaves_per_node(leaves)) {
        return place_withered(leaves, node, k, light, key);
    }
    float rank = ((float)k + 0.5f) / (float)leaves_per_node(leaves);
    Vec3 out = side_at(node, azimuth(leaves, node, k, key));
    Vec3 p = vec3_madd(node->position, -1.8f * node->radius * rank, node->along);
    p = vec3_madd(p, 0.85f * node->radius * sqrtf(rank), out);
    return leaf_frame(leaves, p, node->along, out, leaves->angle * (0.1f + 0.9f * rank), light,
                      key);
}

// No leaf leads into the surface that its twig clings to.
static Vec3 off_surface(Vec3 out, Vec3 normal)
{
    const float least = 0.45f;
    float rise = vec3_dot(out, normal);
    return rise < least ? vec3_normalize(vec3_madd(out, least - rise, normal)) : out;
}

static Transform place(const LeavesParams *leaves, const LeafNode *node, int k,
                       const LeafLight *light)
{
    uint64_t key = leaf_key(node, k);
    if (leaves->arrangement == ARRANGE_SPURS) {
        return place_on_spur(leaves, node, k, light, key);
    }
    if (leaves->arrangement == ARRANGE_ROSETTE) {
        return place_in_rosette(leaves, node, k, light, key);
    }
    Vec3 out = side_at(node, azimuth(leaves, node, k, key));
    if (light->facing) {
        out = off_surface(out, light->facing(light->user, node->position));
    }
    Vec3 p = vec3_madd(node->position, 0.8f * node->radius, out);
    return leaf_frame(leaves, p, node->along, out, leaves->angle, light, key);
}

Transform leaf_place(const LeavesParams *leaves, const LeafNode *node, int k,
                     const LeafLight *light)
{
    return resized(place(leaves, node, k, light), node->size);
}

Transform leaf_place_piece(const LeavesParams *leaves, Vec3 start, Vec3 end, float reach,
                           uint64_t key)
{
    Vec3 chord = vec3_sub(end, start), y = vec3_normalize(chord);
    Vec3 z = across(UP, y); // combed needles lie left and right
    if (leaves->comb == 0.0f) {
        z = across(random_direction(random_key(key, STREAM_ROLL)), y);
    }
    float size = 1.0f - leaves->size_variation * random_unit(random_key(key, STREAM_SIZE));
    return transform_from_axes(vec3_scale(vec3_cross(y, z), size), vec3_scale(chord, 1.0f / reach),
                               vec3_scale(z, size), start);
}
