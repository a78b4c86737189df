// What flows in a river: its discharge, depth and speed, and the foam that its fall makes.
//
// The resistance of steep channels is Jarrett's ("Hydraulics of High-Gradient Streams", J. Hydraul.
// Eng. 110(11), 1984): v = 3.17 R^0.83 S^0.12 in metres and seconds, R the depth of a wide channel.
#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/terrain/internal.h"

#include <math.h>
#include <stdlib.h>

#define GRAVITY 9.81f
#define REGIME 4.8f // width over the root of the discharge, m and m^3/s, of rivers in their own bed

// Energy that the water loses, W/kg: below the first the surface stays whole, at the second it is
// all white.
static const float CALM = 0.15f, WHITE = 1.5f;

float terrain_discharge(const TerrainParams *params, float half)
{
    if (terrain_evolves(params)) { // a course of the width that the scene gives
        return 4.0f * half * half / (REGIME * REGIME);
    }
    float root = half / params->rivers.water; // of the drainage area
    return params->rivers.runoff * 1e-6f * root * root;
}

RiverFlow terrain_flow_of(float discharge, float half, float slope)
{
    RiverFlow flow = {.discharge = discharge, .slope = slope > 1e-5f ? slope : 1e-5f};
    float wide = discharge / (2.0f * half); // m^2/s
    float factor = 3.17f * exact_pow(flow.slope, 0.12f);
    flow.depth = exact_pow(wide / factor, 1.0f / 1.83f);
    flow.speed = flow.depth > 0.0f ? wide / flow.depth : 0.0f;
    float loss = GRAVITY * flow.speed * flow.slope;
    flow.foam = clampf((loss - CALM) / (WHITE - CALM), 0.0f, 1.0f);
    return flow;
}

// Slope of the water about a node, over a few nodes of one level of pools: not across a fall.
static float slope_at(const OutTree *water, const int32_t *main, const float *drop, int64_t i)
{
    enum { REACH = 6 };
    int64_t low = i, high = i;
    float run = 0.0f;
    for (int k = 0; k < REACH && water->parent[low] >= 0 && drop[low] <= 0.0f; k++) {
        int64_t next = water->parent[low];
        Vec3 step = vec3_sub(water->position[low], water->position[next]);
        run += sqrtf(step.x * step.x + step.z * step.z);
        low = next;
    }
    for (int k = 0; k < REACH && main[high] >= 0 && drop[main[high]] <= 0.0f; k++) {
        int64_t next = main[high];
        Vec3 step = vec3_sub(water->position[next], water->position[high]);
        run += sqrtf(step.x * step.x + step.z * step.z);
        high = next;
    }
    float fall = water->position[high].y - water->position[low].y;
    return run > 0.0f ? fall / run : 0.0f;
}

// The pool boils where a fall's air rises again: over about half of its height.
static void boil(const OutTree *water, const float *drop, int64_t lip, RiverFlow *flow)
{
    float left = 0.5f * drop[lip];
    for (int64_t i = water->parent[lip]; left >= 0.0f; i = water->parent[i]) {
        flow[i].foam = 1.0f;
        if (water->parent[i] < 0) {
            return;
        }
        Vec3 step = vec3_sub(water->position[i], water->position[water->parent[i]]);
        left -= sqrtf(step.x * step.x + step.z * step.z);
    }
}

// What drifts is drawn out along the flow, but the faster the flow, the more it is also stirred:
// the length that a metre of the river has in coordinates in which its foam is as wide as long.
float terrain_drawn_out(float speed)
{
    return 1.0f / sqrtf(1.0f + speed);
}

// Foam of rapids and falls drifts on. Where bubbles are dense they meet and burst within seconds;
// the thin lace that is left lasts longer.
float terrain_foam_left(float foam, float seconds)
{
    const float meet = 1.2f, lasts = 20.0f; // s
    return foam / (1.0f + foam * seconds / meet) * (float)exact_exp((double)(-seconds / lasts));
}

static void drift(const OutTree *water, RiverFlow *flow)
{
    const float least = 0.02f; // less foam is none
    for (int64_t i = water->count - 1; i >= 0; i--) {
        int32_t below = water->parent[i];
        if (below < 0) {
            continue;
        }
        Vec3 step = vec3_sub(water->position[i], water->position[below]);
        float run = sqrtf(step.x * step.x + step.z * step.z);
        float speed = flow[below].speed > 0.1f ? flow[below].speed : 0.1f;
        float left = terrain_foam_left(flow[i].foam, run / speed);
        if (left > least && left > flow[below].foam) {
            flow[below].foam = left;
        }
    }
}

static void mark_fall(const OutTree *water, const int32_t *main, int64_t lip, RiverFlow *flow)
{
    enum { REACH = 8 };
    int64_t below = lip, above = lip;
    for (int k = 0; k < REACH; k++) {
        flow[below].at_fall = flow[above].at_fall = true;
        below = water->parent[below] >= 0 ? water->parent[below] : below;
        above = main[above] >= 0 ? main[above] : above;
    }
}

RiverFlow *terrain_find_flow(const TerrainParams *params, const OutTree *water, const float *drop,
                             Error *e)
{
    int32_t *main = terrain_main_children(water, e);
    RiverFlow *flow = main ? memory_alloc(water->count, sizeof *flow, e) : NULL;
    for (int64_t i = 0; flow && i < water->count; i++) {
        float half = water->radius[i];
        flow[i] =
            terrain_flow_of(terrain_discharge(params, half), half, slope_at(water, main, drop, i));
        flow[i].foam = clampf(params->rivers.foam * flow[i].foam, 0.0f, 1.0f);
        flow[i].at_fall = false;
    }
    for (int64_t i = 0; flow && i < water->count; i++) {
        if (drop[i] > 0.0f) {
            mark_fall(water, main, i, flow);
        }
    }
    if (flow && params->rivers.foam > 0.0f) {
        for (int64_t i = 0; i < water->count; i++) {
            if (drop[i] > 0.0f) {
                boil(water, drop, i, flow);
            }
        }
        drift(water, flow);
    }
    free(main);
    return flow;
}

// Pools are widest twice the river's half width below the foot. They widen slowly enough that no
// pool reaches back to its lip.
void terrain_widen_pools(OutTree *water, const float *drop)
{
    const float widest = 0.6f; // more than the river
    for (int64_t i = 0; i < water->count; i++) {
        float run = 0.0f, half = water->radius[i];
        for (int64_t k = i; drop[i] > 0.0f && water->parent[k] >= 0 && run < 6.0f * half;) {
            int64_t below = water->parent[k];
            Vec3 step = vec3_sub(water->position[k], water->position[below]);
            run += sqrtf(step.x * step.x + step.z * step.z);
            float bulge =
                smoothstepf(0.0f, 2.0f * half, run) * smoothstepf(6.0f * half, 2.5f * half, run);
            float wide = half * (1.0f + widest * bulge);
            water->radius[below] = wide > water->radius[below] ? wide : water->radius[below];
            k = below;
            if (drop[k] > 0.0f) {
                break; // the next one has a pool of its own
            }
        }
    }
}
