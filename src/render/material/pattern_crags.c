#include "render/material/pattern_crags.h"

#include "base/strata.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <stddef.h>

enum { SEED_WARP = 201, SEED_BLOCKS = 251, SEED_STREAKS = 281 };

#define RATIO 0.37f // of the sizes of blocks, from scale to scale

// Relative to the size of the blocks.
#define STANDS_OUT 0.17f // of one block against another, at most
#define BEVEL 0.035f     // half the width of a step's face
#define CRACK 0.018f     // half the width of a crack
#define CORNER 0.16f     // reach of the shade in a corner

// m: at most, of these
#define WIDEST_BEVEL 1.2f
#define WIDEST_CRACK 0.2f
#define WIDEST_CORNER 4.0f

#define RAISED 0.25f // of displacement: more would fold at the land's edges

enum { BED, JOINT_A, JOINT_B, SETS };

// The interval about a place on a line that is cut at irregular distances of mean 1.
typedef struct Interval {
    int number;
    float low, high; // distances to its ends
} Interval;

// One scale of blocks at a place; lengths relative to their size.
typedef struct Blocks {
    float thick, bevel, crack, corner;
    float pixel;          // footprint
    float place[SETS];    // coordinates: across the beds and each set of joints
    Interval about[SETS]; // the block there
    uint32_t seed;
} Blocks;

typedef struct Plane {
    float height;
    float tilt[SETS]; // by the coordinates
    uint32_t hash;
} Plane;

static uint32_t hash_of(uint32_t seed, int a)
{
    return (seed ^ ((uint32_t)a * 0x9e3779b1u)) * 0x85ebca6bu + 0x165667b1u;
}

static float cut_at(int number, uint32_t seed)
{
    return (float)number + 0.8f * (noise_unit(hash_of(seed, number), 1) - 0.5f);
}

// Every other cut is missing at times, so that blocks differ much in size.
static Interval interval_at(float x, uint32_t seed)
{
    int i = (int)floorf(x);
    i -= i & 1;
    float first = cut_at(i, seed), last = cut_at(i + 2, seed);
    if (x < first) {
        i -= 2;
        last = first;
        first = cut_at(i, seed);
    } else if (x >= last) {
        i += 2;
        first = last;
        last = cut_at(i + 2, seed);
    }
    if (noise_unit(hash_of(seed, i), 5) < 0.4f) {
        return (Interval){i, x - first, last - x};
    }
    float middle = cut_at(i + 1, seed);
    return x < middle ? (Interval){i, x - first, middle - x}
                      : (Interval){i + 1, x - middle, last - x};
}

// Joints of a bed do not meet those of the next: the seed of the second coordinate's cuts hangs on
// the bed, the third's on the second.
static uint32_t cuts_seed(const Blocks *b, int set, int bed, int a)
{
    uint32_t seed = b->seed + 77u * (uint32_t)set;
    return set == BED ? seed : set == JOINT_A ? hash_of(seed, bed) : hash_of(hash_of(seed, bed), a);
}

static void find_block(Blocks *b)
{
    b->about[BED] = interval_at(b->place[BED] / b->thick, cuts_seed(b, BED, 0, 0));
    int bed = b->about[BED].number;
    b->about[JOINT_A] = interval_at(b->place[JOINT_A], cuts_seed(b, JOINT_A, bed, 0));
    int a = b->about[JOINT_A].number;
    b->about[JOINT_B] = interval_at(b->place[JOINT_B], cuts_seed(b, JOINT_B, bed, a));
}

// What a block's plane is at the place, which need not be within the block.
static Plane plane_at(const Blocks *b, const Interval about[SETS])
{
    uint32_t hash = b->seed;
    for (int set = 0; set < SETS; set++) {
        hash = hash_of(hash, about[set].number);
    }
    Plane plane = {.hash = hash};
    // Most blocks stand near the face, a few far out or back; beds as a whole, too.
    float out = 2.0f * noise_unit(hash, 1) - 1.0f;
    float bed = 2.0f * noise_unit(hash_of(b->seed, about[BED].number), 7) - 1.0f;
    plane.height = STANDS_OUT * (0.6f * out * (0.25f + 0.75f * out * out) + 0.4f * bed);
    for (int set = 0; set < SETS; set++) { // large blocks are not tilted as far
        float unit = set == BED ? b->thick : 1.0f;
        float extent = unit * (about[set].low + about[set].high);
        float tilt =
            0.7f * (noise_unit(hash, 2 + (uint32_t)set) - 0.5f) * fminf(1.0f, 0.8f / extent);
        plane.tilt[set] = tilt;
        plane.height += tilt * unit * 0.5f * (about[set].low - about[set].high);
    }
    return plane;
}

// The block beyond the nearer end of the interval of a set.
static Plane neighbour(const Blocks *b, int set, bool up)
{
    Blocks next = *b;
    Interval *i = &next.about[set];
    uint32_t seed = cuts_seed(b, set, b->about[BED].number, b->about[JOINT_A].number);
    float x = set == BED ? b->place[BED] / b->thick : b->place[set];
    const float beyond = 1e-3f;
    float end = up ? x + i->high + beyond : x - i->low - beyond;
    *i = interval_at(end, seed);
    i->low += x - end;
    i->high -= x - end;
    int bed = next.about[BED].number;
    if (set == BED) {
        next.about[JOINT_A] = interval_at(b->place[JOINT_A], cuts_seed(b, JOINT_A, bed, 0));
    }
    if (set != JOINT_B) {
        int a = next.about[JOINT_A].number;
        next.about[JOINT_B] = interval_at(b->place[JOINT_B], cuts_seed(b, JOINT_B, bed, a));
    }
    return plane_at(&next, next.about);
}

// What one scale adds, relative to its size.
typedef struct Relief {
    float height, slope[SETS], tone, crevice, ledge;
} Relief;

static void add_border(const Blocks *b, int set, const Plane *own, Relief *r)
{
    const Interval *about = &b->about[set];
    float unit = set == BED ? b->thick : 1.0f;
    bool up = about->high < about->low;
    float away = unit * (up ? about->high : about->low);
    if (away > fmaxf(b->corner, b->pixel)) {
        return;
    }
    Plane next = neighbour(b, set, up);
    float step = next.height - own->height;
    float bevel = fmaxf(b->bevel, 0.6f * b->pixel), t = fminf(away / bevel, 1.0f);
    float share = 0.5f * (1.0f - t) * (1.0f - t);
    r->height += share * step;
    r->slope[set] += (up ? 1.0f : -1.0f) * step * (1.0f - t) / bevel;
    float crack = fmaxf(b->crack, 0.6f * b->pixel), open = noise_unit(own->hash ^ next.hash, 11);
    float dark = open * open * b->crack / crack * (1.0f - smoothstepf(0.3f, 1.0f, away / crack));
    float corner = clampf(4.0f * step, 0.0f, 1.0f) * (1.0f - smoothstepf(0.0f, b->corner, away));
    r->crevice = fmaxf(r->crevice, fmaxf(dark, 0.6f * corner));
    if (set == BED && !up) {
        float reach = fmaxf(fminf(2.0f * step, b->corner), 1e-3f);
        float on = clampf(8.0f * step - 0.3f, 0.0f, 1.0f);
        r->ledge = fmaxf(r->ledge, on * (1.0f - smoothstepf(0.4f, 1.0f, away / reach)));
    }
}

static Relief relief_of(Blocks *b)
{
    find_block(b);
    Plane own = plane_at(b, b->about);
    Relief r = {.height = own.height, .tone = 2.0f * noise_unit(own.hash, 9) - 1.0f};
    for (int set = 0; set < SETS; set++) {
        r.slope[set] = own.tilt[set];
    }
    for (int set = 0; set < SETS; set++) {
        add_border(b, set, &own, &r);
    }
    return r;
}

// Bends beds and joints, which would be planes. Rock is shattered here and massive there: `broken`
// tells how far joints of this scale show.
static Vec3 bent(Vec3 p, uint32_t seed, float *broken)
{
    Vec3 q = vec3_scale(p, 0.55f);
    Vec3 bend = {noise_solid(q, seed, NULL), noise_solid(q, seed + 1, NULL),
                 noise_solid(q, seed + 2, NULL)};
    *broken = lerpf(0.25f, 1.0f,
                    smoothstepf(-0.35f, 0.3f, noise_solid(vec3_scale(p, 0.23f), seed + 3, NULL)));
    return vec3_scale(bend, 0.3f);
}

// Directions across the sets: the beds, and joints at about 75 degrees to each other that stand on
// the beds, turned a little from scale to scale.
static void set_directions(Vec3 up, int scale, Vec3 across[SETS])
{
    static const float turn[CRAGS_MOST][2] = {{0.96f, 0.28f},  {0.80f, 0.60f}, {0.99f, 0.14f},
                                              {0.866f, 0.50f}, {0.94f, 0.34f}, {0.76f, 0.65f}};
    Vec3 x = vec3_normalize(vec3_sub(vec3(1.0f, 0.0f, 0.1f), vec3_scale(up, up.x + 0.1f * up.z)));
    Vec3 z = vec3_cross(x, up);
    float c = turn[scale][0], s = turn[scale][1];
    Vec3 a = vec3_add(vec3_scale(x, c), vec3_scale(z, s));
    Vec3 b = vec3_sub(vec3_scale(z, c), vec3_scale(x, s));
    across[BED] = up;
    across[JOINT_A] = a;
    across[JOINT_B] = vec3_add(vec3_scale(b, 0.966f), vec3_scale(a, 0.26f));
}

Crags pattern_crags(const SurfacePoint *point, const CragsRock *rock)
{
    Crags crags = {0};
    float weight = 0.0f, size = rock->size;
    for (int k = 0; k < rock->scales && k < CRAGS_MOST; k++, size *= RATIO) {
        float seen = pattern_detail(0.8f * size, point->footprint);
        if (seen <= 0.0f) {
            break;
        }
        uint32_t seed = SEED_WARP + 8u * (uint32_t)k;
        float broken;
        Vec3 p = vec3_scale(point->object_position, 1.0f / size);
        Vec3 bend = bent(p, seed, &broken), across[SETS];
        set_directions(rock->up, k, across);
        Blocks blocks = {.thick = rock->thick,
                         .bevel = fminf(BEVEL, WIDEST_BEVEL / size),
                         .crack = fminf(CRACK, WIDEST_CRACK / size),
                         .corner = fminf(CORNER, WIDEST_CORNER / size),
                         .pixel = point->footprint / size,
                         .seed = SEED_BLOCKS + 31u * (uint32_t)k};
        blocks.place[BED] = rock->level / size + 0.6f * vec3_dot(bend, rock->up) * rock->thick;
        p = vec3_add(p, bend);
        blocks.place[JOINT_A] = vec3_dot(p, across[JOINT_A]);
        blocks.place[JOINT_B] = vec3_dot(p, across[JOINT_B]);
        Relief r = relief_of(&blocks);
        float share = seen * broken;
        crags.height += RAISED * share * size * r.height;
        for (int set = 0; set < SETS; set++) {
            crags.slope = vec3_madd(crags.slope, share * r.slope[set], across[set]);
        }
        crags.tone += seen * r.tone;
        crags.crevice = fmaxf(crags.crevice, share * r.crevice);
        crags.ledge = fmaxf(crags.ledge, seen * r.ledge);
        weight += 1.0f;
    }
    crags.tone = weight > 0.0f ? crags.tone / sqrtf(weight) : 0.0f;
    return crags;
}

CragsRock crags_level(const SurfacePoint *point, float size, float thick)
{
    Vec3 at = point->object_position;
    float base = point->strata ? strata_base(point->strata, at.x, at.z) : 0.0f;
    return (CragsRock){.size = size,
                       .thick = thick,
                       .scales = CRAGS_MOST,
                       .up = vec3(0.0f, 1.0f, 0.0f),
                       .level = at.y - base};
}

float crags_height(const SurfacePoint *point, const CragsRock *rock, float level, float steep)
{
    float share = smoothstepf(level, steep, fabsf(point->smooth_normal.y));
    return share > 0.0f ? share * pattern_crags(point, rock).height : 0.0f;
}

Vec3 crags_normal(const SurfacePoint *point, Vec3 n, Vec3 slope)
{
    Vec3 smooth = surface_smooth_normal(point);
    float alike = smoothstepf(0.3f, 0.7f, vec3_dot(n, smooth)); // not where the mesh is folded
    return pattern_tilt(vec3_normalize(vec3_lerp(n, smooth, alike * point->displaced)), slope);
}

float pattern_streaks(const SurfacePoint *point, float size)
{
    float broad = pattern_octaves(point, 6.0f * size, 3, 0.5f, 0.4f, SEED_STREAKS + 14).value;
    float streak = pattern_octaves(point, size, 4, 0.65f, 0.07f, SEED_STREAKS).value;
    float thin = pattern_octaves(point, 0.24f * size, 3, 0.65f, 0.05f, SEED_STREAKS + 8).value;
    return smoothstepf(0.0f, 0.55f, streak + 0.35f * thin + 0.45f * broad);
}
