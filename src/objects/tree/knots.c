// Knots where shed limbs were overgrown: a ring of callus about dead wood, on the surface of the
// wood that bore them.
#include "objects/tree/veteran.h"

#include "base/exact_math.h"
#include "mesh/quads.h"

enum { AROUND = 20, RINGS = 9, CORE = 3 }; // rings; the first of them are dead wood

#define WOUND 1.25f       // of the limb's radius, radius of the wound
#define WIDEST 0.55f      // of the wood's radius, of the same
#define ALONG 1.35f       // a wound is longer along the wood than across
#define LEAST_WOOD 0.03f  // m: thinner wood shows none
#define LEAST_LIMB 0.006f // m, radius of a limb that leaves one

// The wound's profile from its middle outward: distance and height in its radii.
static const float DISTANCE[RINGS] = {0.0f, 0.3f, 0.5f, 0.62f, 0.78f, 0.95f, 1.15f, 1.4f, 1.65f};
static const float HEIGHT[RINGS] = {-0.02f, -0.03f, 0.0f, 0.20f, 0.33f, 0.32f, 0.20f, 0.0f, -0.25f};

typedef struct Wound {
    Vec3 axis, along, out, across; // a point of the wood's axis; unit vectors
    float wood, radius;            // m
} Wound;

static bool find_wound(const OutTree *tree, int64_t i, Wound *wound)
{
    int32_t base = tree->parent[i];
    int32_t below = base >= 0 ? tree->parent[base] : -1;
    if (below < 0 || tree->colony[i] != TREE_KNOTS || tree->colony[base] > TREE_CROWN) {
        return false;
    }
    float wood = tree->radius[base], radius = WOUND * tree->radius[i];
    Vec3 d = vec3_normalize(vec3_sub(tree->position[i], tree->position[base]));
    Vec3 along = vec3_normalize(vec3_sub(tree->position[base], tree->position[below]));
    float climb = vec3_dot(d, along);
    Vec3 out = vec3_madd(d, -climb, along);
    float sine = vec3_length(out);
    if (wood < LEAST_WOOD || tree->radius[i] < LEAST_LIMB || sine < 0.2f) {
        return false;
    }
    out = vec3_scale(out, 1.0f / sine);
    float rise = clampf(climb / sine, -0.5f, 1.5f); // to where the limb left the wood's surface
    *wound = (Wound){.axis = vec3_madd(tree->position[base], rise * wood, along),
                     .along = along,
                     .out = out,
                     .across = vec3_cross(along, out),
                     .wood = wood,
                     .radius = radius < WIDEST * wood ? radius : WIDEST * wood};
    return true;
}

static Vec3 place(const Wound *wound, float distance, float height, float sine, float cosine)
{
    float around = distance * wound->radius * cosine / wound->wood, s, c;
    exact_sincos(around, &s, &c);
    Vec3 out = vec3_madd(vec3_scale(wound->out, c), s, wound->across);
    Vec3 p = vec3_madd(wound->axis, ALONG * distance * wound->radius * sine, wound->along);
    return vec3_madd(p, wound->wood + height * wound->radius, out);
}

static void add_rings(Quads *quads, const Wound *wound, int first, int last)
{
    uint32_t start = (uint32_t)quads->vertex_count;
    for (int ring = first; ring <= last; ring++) {
        for (int k = 0; k <= AROUND; k++) {
            float sine, cosine, turn = -2.0f * PI_F * (float)k / (float)AROUND;
            exact_sincos(turn, &sine, &cosine);
            Vec3 p = place(wound, DISTANCE[ring], HEIGHT[ring], sine, cosine);
            float reach = DISTANCE[ring] * wound->radius;
            quads_vertex(quads, p, (Vec2){reach * cosine, reach * sine});
        }
    }
    quads_grid(quads, start, last - first + 1, AROUND + 1);
}

bool tree_add_knots(const OutTree *tree, const Placing *placing, Error *e)
{
    Quads callus = {.e = e}, core = {.e = e};
    for (int64_t i = 0; i < tree->count; i++) {
        Wound wound;
        if (find_wound(tree, i, &wound)) {
            add_rings(&core, &wound, 0, CORE - 1);
            add_rings(&callus, &wound, CORE - 1, RINGS - 1);
        }
    }
    if (callus.vertex_count == 0) {
        quads_clear(&callus);
        quads_clear(&core);
        return !callus.failed && !core.failed;
    }
    Mesh *dead = quads_mesh(&core), *ring = quads_mesh(&callus);
    bool done = dead && ring;
    done = dead ? placing_add(placing, (Part){.mesh = dead}, TREE_DEADWOOD, e) && done : done;
    return ring ? placing_add(placing, (Part){.mesh = ring}, TREE_BARK, e) && done : false;
}
