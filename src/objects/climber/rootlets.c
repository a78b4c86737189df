// Rootlets of a climber: short adventitious roots in dense rows along the side of a stem that faces
// what it clings to (of ivy 2 to 15 mm long and a few tenths of a millimetre thick; Melzer et al.,
// "The attachment strategy of English ivy", J. R. Soc. Interface 2010).
#include "objects/climber/climber.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "base/turn.h"

#include <math.h>
#include <stdlib.h>

enum { POINTS = 5 }; // of a rootlet
// Of a segment of a stem; ROOTLETS + i: rootlet i.
enum { STREAM_NUMBER = 1, STREAM_BUNCHES = 2, STREAM_ROOTLETS = 10 };
// Of a rootlet; STEPS + i: its step i.
enum { STREAM_PLACE = 1, STREAM_TURN = 2, STREAM_LENGTH = 3, STREAM_STEPS = 4 };

// The segment from a node's parent to the node.
typedef struct Segment {
    Vec3 start, end;
    Vec3 foot, normal; // the surface below its end: a point, and the direction out of it
    float radius;
    uint64_t key;
} Segment;

static Segment segment_to(const ClimberParams *params, const OutTree *tree, int64_t node,
                          uint64_t seed)
{
    int32_t parent = tree->parent[node];
    Vec3 normal = tree->normal[node];
    float lifted = params->offset + tree->radius[node]; // by climber_finish
    return (Segment){.start = tree->position[parent],
                     .end = tree->position[node],
                     .foot = vec3_madd(tree->position[node], -lifted, normal),
                     .normal = normal,
                     .radius = tree->radius[node],
                     .key = random_key(seed, tree->id[node])};
}

// Rootlets of a segment: in bunches, many more of them on a thicker stem, which has borne them for
// years.
static int64_t rootlets_of(const ClimberParams *params, const Segment *segment, uint64_t seed)
{
    const float bunch = 0.045f, common = 0.003f; // m
    float thick = segment->radius / common;
    float length = vec3_distance(segment->start, segment->end);
    float bunched =
        noise_space(vec3_scale(segment->end, 1.0f / bunch), random_key(seed, STREAM_BUNCHES));
    float dense = smoothstepf(-0.6f, 0.4f, bunched) * fminf(thick * thick, 6.0f);
    const float most = 1e9f; // no memory holds as many
    float wanted = fminf(dense * length / params->rootlets.spacing, most);
    return (int64_t)(wanted + random_unit(random_key(segment->key, STREAM_NUMBER)));
}

// Pushes p out of the surface.
static Vec3 keep_out(const Segment *segment, Vec3 p, float distance)
{
    float off = vec3_dot(vec3_sub(p, segment->foot), segment->normal);
    return off < distance ? vec3_madd(p, distance - off, segment->normal) : p;
}

// A rootlet leaves the stem below and at its sides, bends to the surface and creeps along it.
static void add_rootlet(const RootletParams *params, const Segment *segment, uint64_t key,
                        Vec3 *position, float *radius)
{
    const float widest = 125.0f; // degrees from straight into the surface
    Vec3 along = vec3_normalize(vec3_sub(segment->end, segment->start));
    Vec3 in = vec3_neg(segment->normal);
    float side = 2.0f * random_unit(random_key(key, STREAM_TURN)) - 1.0f;
    float turn = widest * (side < 0.0f ? -sqrtf(-side) : sqrtf(side)); // most spread out
    Vec3 heading = vec3_turn(in, along, turn);
    float share = random_unit(random_key(key, STREAM_LENGTH));
    float step = params->length * lerpf(0.25f, 1.0f, share) / (float)(POINTS - 1);
    Vec3 p = vec3_lerp(segment->start, segment->end, random_unit(random_key(key, STREAM_PLACE)));
    p = vec3_madd(p, 0.85f * segment->radius, heading);
    for (int i = 0; i < POINTS; i++) {
        float left = 1.0f - (float)i / (float)(POINTS - 1);
        position[i] = p;
        radius[i] = params->radius * (0.35f + 0.65f * left);
        Vec3 noise = random_direction(random_key(key, STREAM_STEPS + (uint64_t)i));
        heading = vec3_madd(vec3_madd(heading, 0.22f, in), 0.5f, noise);
        heading = vec3_normalize(heading);
        p = keep_out(segment, vec3_madd(p, step, heading), radius[i]);
    }
}

static void fill(const ClimberParams *params, const OutTree *tree, uint64_t seed,
                 const int64_t *count, CurveSet *curves)
{
    int64_t curve = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        for (int64_t k = 0; k < count[i]; k++) {
            Segment segment = segment_to(params, tree, i, seed);
            uint64_t key = random_key(segment.key, STREAM_ROOTLETS + (uint64_t)k);
            int64_t first = POINTS * curve;
            add_rootlet(&params->rootlets, &segment, key, curves->position + first,
                        curves->radius + first);
            for (int64_t j = first; j < first + POINTS; j++) {
                curves->birth[j] = 1.0f;
                curves->along[j] =
                    j > first ? curves->along[j - 1] +
                                    vec3_distance(curves->position[j - 1], curves->position[j])
                              : 0.0f;
            }
            curves->id[curve] = key;
            curves->first[curve++] = first;
        }
    }
    curves->first[curve] = POINTS * curve;
}

CurveSet *climber_rootlets(const ClimberParams *params, const OutTree *tree, const bool *hangs,
                           uint64_t seed, Error *e)
{
    int64_t *count = memory_alloc_zero(tree->count, sizeof *count, e), all = 0;
    if (!count) {
        return NULL;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0 && !hangs[i]) {
            Segment segment = segment_to(params, tree, i, seed);
            count[i] = rootlets_of(params, &segment, seed);
            all += count[i];
        }
    }
    const double bytes = POINTS * (sizeof(Vec3) + 3 * sizeof(float)) + 2 * sizeof(int64_t);
    bool fits = memory_check((double)all * bytes, e,
                             "%lld rootlets (fewer by a wider rootlets.spacing)", (long long)all);
    CurveSet *curves = fits ? curves_new(POINTS * all, all, e) : NULL;
    if (curves) {
        fill(params, tree, seed, count, curves);
    }
    free(count);
    return curves;
}
