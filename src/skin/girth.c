#include "skin/girth.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"

// Of a chain's first node.
enum { STREAM_KNOBS = 71, STREAM_WAVES = 72 };
// Of a knob.
enum { STREAM_KNOB_PLACE = 1, STREAM_KNOB_TURN = 2, STREAM_KNOB_SHARE = 3 };

#define BULGE_ROUND 0.3f   // share of a swelling that is the same all around
#define BULGE_WIDTH 0.35f  // radians, of the rest at the thinnest limb
#define BULGE_WIDER 0.5f   // more at one as thick as its parent
#define STRAND_WIDTH 0.27f // radians, of the thinnest limb's strand
#define STRAND_WIDER 0.35f // more at that of one as thick as its parent
#define KNOB_SPACING 3.2f  // radii between places of shed limbs
#define STRAND_LENGTH 9.0f // radii that the strand below a limb as thick as its parent runs
#define WAVE_LENGTH 15.0f  // radii, of what is random in the section
#define WAVES_FROM 2       // orders of it
#define WAVES_TO 5
#define WAVES 0.8f      // their height, of the strands'
#define MOST_REACH 1.6f // of the radius
#define LEAST_REACH 0.6f

// A limb that leaves a chain, or has left it.
typedef struct Knob {
    float along, azimuth; // m; radians from the axis' side
    float share;          // its radius, of the chain's
    float sine;           // of its angle to the chain: one that leaves along it makes no bulge
    bool hangs;           // it heads toward the chain's start, as a root: its strand, to the end
} Knob;

// A bump over the angle about the azimuth, a bell of this width (radians), without what is the same
// all around.
typedef struct Bump {
    float cosine[SKIN_GIRTH_ORDERS], sine[SKIN_GIRTH_ORDERS]; // 1 high
} Bump;

static Bump make_bump(float azimuth, float width)
{
    Bump bump;
    float total = 0.0f, weight[SKIN_GIRTH_ORDERS], sine, cosine;
    for (int n = 0; n < SKIN_GIRTH_ORDERS; n++) {
        float x = (float)(n + 1) * width;
        weight[n] = (float)exact_exp(-0.5 * (double)(x * x));
        total += weight[n];
    }
    for (int n = 0; n < SKIN_GIRTH_ORDERS; n++) {
        exact_sincos((float)(n + 1) * azimuth, &sine, &cosine);
        bump.cosine[n] = weight[n] / total * cosine;
        bump.sine[n] = weight[n] / total * sine;
    }
    return bump;
}

static void add_bump(SkinGirth *girth, const Bump *bump, float height)
{
    for (int n = 0; n < SKIN_GIRTH_ORDERS; n++) {
        girth->cosine[n] += height * bump->cosine[n];
        girth->sine[n] += height * bump->sine[n];
    }
}

// 1 at 0, 0 beyond 1.
static float hump(float x)
{
    float left = 1.0f - x * x;
    return left > 0.0f ? left * left : 0.0f;
}

// Adds a knob to the samples about it.
static void add_knob(SkinPlan *plan, const SkinChain *chain, int64_t near, const Knob *knob)
{
    const SkinParams *params = &plan->params;
    SkinPoint *point = plan->point + chain->axis;
    SkinGirth *girth = plan->girth + chain->axis;
    float radius = point[near].radius, share = clampf(knob->share, 0.0f, 1.0f);
    float wide = (0.4f + 1.2f * share) * radius, root = sqrtf(share);
    float stand = (0.4f + 0.6f * knob->sine) * root; // one along the chain is its own strand
    Bump bulge = make_bump(knob->azimuth, BULGE_WIDTH + BULGE_WIDER * share);
    Bump rope = make_bump(knob->azimuth, STRAND_WIDTH + STRAND_WIDER * share);
    // Wood gathers below a limb: where it leaves, its strand has ended.
    float drop = (0.3f + 0.7f * share) * radius, middle = knob->along;
    middle += knob->hangs ? drop : -drop;
    float below = STRAND_LENGTH * root * radius, above = drop;
    for (int way = -1; way <= 1; way += 2) {
        float reach = fmaxf(wide, (way < 0) != knob->hangs ? below : above);
        for (int64_t i = way < 0 ? near : near + 1; i >= 0 && i < chain->samples; i += way) {
            float off = point[i].along - middle;
            if ((float)way * off > reach) {
                break;
            }
            float swell = params->swelling * share * knob->sine * hump(off / wide);
            float strand =
                params->fluting * stand * hump(off / ((off < 0.0f) != knob->hangs ? below : above));
            girth[i].round += BULGE_ROUND * swell;
            add_bump(&girth[i], &bulge, (1.0f - BULGE_ROUND) * swell);
            add_bump(&girth[i], &rope, strand);
        }
    }
}

// Where a child leaves the chain's surface, by its nodes.
static Knob child_knob(const SkinPlan *plan, int32_t number, const SkinChain *child)
{
    SkinPoint at = skin_axis_at(plan, number, child->attach);
    Vec3 across = vec3_cross(at.tangent, at.side), first = vec3(0, 0, 0), off = first;
    float x = 0.0f, y = 0.0f, radius = 0.0f;
    for (int64_t i = 0; i < child->count && x * x + y * y < at.radius * at.radius; i++) {
        int32_t node = plan->node[child->first + i];
        off = vec3_sub(plan->tree->position[node], at.position);
        first = i == 0 ? off : first;
        x = vec3_dot(off, at.side);
        y = vec3_dot(off, across);
        radius = plan->tree->radius[node];
    }
    Vec3 way = vec3_normalize(vec3_sub(off, first));
    float climb = clampf(vec3_dot(off, at.tangent), -2.0f * at.radius, 2.0f * at.radius);
    return (Knob){.along = child->attach + climb,
                  .azimuth = exact_atan2(y, x),
                  .share = radius / at.radius,
                  .sine = vec3_length(vec3_cross(way, at.tangent)),
                  .hangs = vec3_dot(way, at.tangent) < -0.35f};
}

// Limbs that are there.
static void add_children(SkinPlan *plan, int32_t number)
{
    const SkinChain *chain = &plan->chain[number];
    for (int32_t i = chain->first_child; i >= 0; i = plan->chain[i].next_sibling) {
        Knob knob = child_knob(plan, number, &plan->chain[i]);
        add_knob(plan, chain, skin_axis_sample(plan, number, knob.along), &knob);
    }
}

// Places where limbs were shed, and waves of what is random. Both go by the arc length in radii.
static void add_random(SkinPlan *plan, const SkinChain *chain)
{
    const SkinParams *params = &plan->params;
    const SkinPoint *point = plan->point + chain->axis;
    uint64_t key = plan->tree->id[plan->node[chain->first]];
    uint64_t knobs = random_key(key, STREAM_KNOBS), waves = random_key(key, STREAM_WAVES);
    float way = 0.0f;
    int64_t next = 1;
    for (int64_t i = 0; i < chain->samples; i++) {
        way += i > 0 ? (point[i].along - point[i - 1].along) / point[i].radius : 0.0f;
        SkinGirth *girth = &plan->girth[chain->axis + i];
        for (int n = WAVES_FROM; n <= WAVES_TO; n++) {
            float t = way / WAVE_LENGTH, at = 10.37f * (float)n;
            girth->cosine[n - 1] += WAVES * params->fluting * noise_plane(t, at, waves);
            girth->sine[n - 1] += WAVES * params->fluting * noise_plane(t, at + 5.0f, waves);
        }
        for (; way > KNOB_SPACING * (float)next; next++) {
            uint64_t own = random_key(knobs, (uint64_t)next);
            float share = random_unit(random_key(own, STREAM_KNOB_SHARE));
            Knob knob = {.along = point[i].along -
                                  random_range(random_key(own, STREAM_KNOB_PLACE), 0.0f, 2.5f) *
                                      point[i].radius,
                         .azimuth =
                             random_range(random_key(own, STREAM_KNOB_TURN), 0.0f, 2.0f * PI_F),
                         .sine = 1.0f,
                         .share = 0.12f + 0.4f * share * share};
            add_knob(plan, chain, i, &knob);
        }
    }
}

// Closed ends are round, so that no cap folds: 0 at an end, 1 two radii from it.
static float far_from_ends(const SkinPlan *plan, const SkinChain *chain, int64_t i)
{
    const SkinPoint *point = plan->point + chain->axis;
    float left = point[chain->samples - 1].along - point[i].along;
    float near = chain->parent < 0 ? fminf(left, point[i].along) : left;
    return smoothstepf(0.0f, 2.0f, near / point[i].radius);
}

static void round_ends(SkinPlan *plan, const SkinChain *chain)
{
    for (int64_t i = 0; i < chain->samples; i++) {
        float share = far_from_ends(plan, chain, i);
        SkinGirth *girth = &plan->girth[chain->axis + i];
        girth->round = lerpf(1.0f, girth->round, share);
        for (int n = 0; n < SKIN_GIRTH_ORDERS; n++) {
            girth->cosine[n] *= share;
            girth->sine[n] *= share;
        }
    }
}

bool skin_girth_make(SkinPlan *plan, int32_t number, Error *e)
{
    const SkinChain *chain = &plan->chain[number];
    if (plan->params.swelling <= 0.0f && plan->params.fluting <= 0.0f) {
        return true;
    }
    if (!memory_reserve(&plan->girth, &plan->girth_capacity, plan->point_count, sizeof(SkinGirth),
                        e)) {
        return false;
    }
    for (int64_t i = 0; i < chain->samples; i++) {
        plan->girth[chain->axis + i] = (SkinGirth){.round = 1.0f};
    }
    add_children(plan, number);
    add_random(plan, chain);
    round_ends(plan, chain);
    for (int64_t i = 0; i < chain->samples; i++) {
        float round = clampf(plan->girth[chain->axis + i].round, LEAST_REACH, MOST_REACH);
        plan->point[chain->axis + i].radius *= round;
    }
    return true;
}

SkinGirth skin_girth_at(const SkinPlan *plan, int32_t number, float along)
{
    SkinGirth at = {.round = 1.0f};
    if (!plan->girth) {
        return at;
    }
    const SkinChain *chain = &plan->chain[number];
    int64_t i = skin_axis_sample(plan, number, along);
    const SkinPoint *point = plan->point + chain->axis + i;
    const SkinGirth *a = plan->girth + chain->axis + i;
    if (i + 1 >= chain->samples) {
        return *a;
    }
    float length = point[1].along - point[0].along;
    float t = length > 0.0f ? clampf((along - point[0].along) / length, 0.0f, 1.0f) : 0.0f;
    for (int n = 0; n < SKIN_GIRTH_ORDERS; n++) {
        at.cosine[n] = lerpf(a[0].cosine[n], a[1].cosine[n], t);
        at.sine[n] = lerpf(a[0].sine[n], a[1].sine[n], t);
    }
    return at;
}

SkinGirth skin_girth_turned(SkinGirth girth, float turn)
{
    float sine, cosine;
    for (int n = 0; n < SKIN_GIRTH_ORDERS; n++) {
        exact_sincos((float)(n + 1) * turn, &sine, &cosine);
        float c = girth.cosine[n], s = girth.sine[n];
        girth.cosine[n] = c * cosine + s * sine;
        girth.sine[n] = s * cosine - c * sine;
    }
    return girth;
}

void skin_girth_limit(SkinGirth *girth, int order)
{
    for (int n = order; n < SKIN_GIRTH_ORDERS; n++) {
        girth->cosine[n] = girth->sine[n] = 0.0f;
    }
}

float skin_girth_reach(const SkinGirth *girth, float cosine, float sine)
{
    float reach = 1.0f, c = 1.0f, s = 0.0f; // of n times the angle
    for (int n = 0; n < SKIN_GIRTH_ORDERS; n++) {
        float next = c * cosine - s * sine;
        s = s * cosine + c * sine;
        c = next;
        reach += girth->cosine[n] * c + girth->sine[n] * s;
    }
    return clampf(reach, LEAST_REACH, MOST_REACH);
}

float skin_girth_toward(const SkinPlan *plan, int32_t chain, const SkinPoint *at, Vec3 direction)
{
    if (!plan->girth) {
        return 1.0f;
    }
    float x = vec3_dot(direction, at->side);
    float y = vec3_dot(direction, vec3_cross(at->tangent, at->side));
    float length = sqrtf(x * x + y * y);
    if (!(length > 0.0f)) {
        return 1.0f;
    }
    SkinGirth girth = skin_girth_at(plan, chain, at->along);
    return skin_girth_reach(&girth, x / length, y / length);
}
