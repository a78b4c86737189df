// Which light is sampled: by powers alone, or by what near ones bring to a place.
//
// A lamp of a few watts a kilometre away must not take as many samples as a bolt nearby. A part of
// the choices stays by powers, for a distance knows no shadows.
#include "render/light/lamp.h"
#include "render/light/lights_internal.h"

static const float BLIND = 0.1f; // of the choices

// What asks: a receiver or a segment.
typedef struct Asker {
    const LightReceiver *receiver;
    const LightSegment *segment;
} Asker;

static NearLight near_light(const LightBounds *bounds)
{
    Vec3 half = vec3_scale(vec3_sub(bounds->box.high, bounds->box.low), 0.5f);
    return (NearLight){vec3_add(bounds->box.low, half), vec3_dot(half, half), bounds->power};
}

void lights_find_near(Lights *lights)
{
    int lamps = lights->world->light_count, count = lamps + (lights->emitters.tree ? 1 : 0);
    if (count < 2 || count > MOST_WEIGHED) {
        return;
    }
    float power = 0.0f;
    for (int i = 0; i < count; i++) {
        LightBounds bounds = {.box = lights->emitters.box};
        if (i < lamps) {
            bounds = lamp_bounds(&lights->world->light[i]);
        } else {
            bounds.power = light_tree_power(lights->emitters.tree);
        }
        lights->near[i] = near_light(&bounds);
        power += bounds.power;
    }
    lights->near_count = power > 0.0f ? count : 0;
}

// Power over squared distance; along a segment as the light tree has it: power times the angle that
// the segment subtends, over the distance.
static float weigh(const NearLight *light, Asker asker)
{
    const LightSegment *s = asker.segment;
    if (!s) {
        Vec3 to = vec3_sub(light->center, asker.receiver->position);
        return light->power / fmaxf(fmaxf(vec3_dot(to, to), light->square), 1e-12f);
    }
    Vec3 to = vec3_sub(light->center, s->origin);
    float along = vec3_dot(to, s->direction), aside = vec3_dot(to, to) - along * along;
    float distance = sqrtf(fmaxf(fmaxf(aside, light->square), 1e-12f));
    float angle = atanf((s->far - along) / distance) - atanf((s->near - along) / distance);
    return light->power * fmaxf(angle, 1e-4f) / distance;
}

LightChoice lights_choose(const Lights *lights, float u)
{
    int low = 0, high = lights->count;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (lights->sum[middle] <= u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    float rest = fminf((u - lights->sum[low]) / lights->share[low], 0.99999994f);
    bool near = low != lights->dome_index && low != lights->sun_index;
    return (LightChoice){low, rest, near, 1.0f};
}

// The stretch of the cumulated shares that dome and sun have, which follow each other in the list.
static void stretch_above(const Lights *lights, float *low, float *high)
{
    int end = lights->emitters_index >= 0 ? lights->emitters_index : lights->count;
    *low = lights->sum[lights->world->light_count];
    *high = lights->sum[end];
}

// The number in the list of lights of what is near.
static int near_index(const Lights *lights, int i)
{
    return i < lights->world->light_count ? i : lights->emitters_index;
}

// Fills the chances of what is near for the asker; total: chance of all of it, by powers.
static void weigh_all(const Lights *lights, Asker asker, float total, float chance[MOST_WEIGHED])
{
    float sum = 0.0f;
    for (int i = 0; i < lights->near_count; i++) {
        chance[i] = weigh(&lights->near[i], asker);
        sum += chance[i];
    }
    for (int i = 0; i < lights->near_count; i++) {
        float blind = lights->share[near_index(lights, i)];
        chance[i] = sum > 0.0f ? lerpf(total * chance[i] / sum, blind, BLIND) : blind;
    }
}

// Chooses what is near for the asker, with a uniform number.
static LightChoice choose_near(const Lights *lights, Asker asker, float total, float u)
{
    float chance[MOST_WEIGHED], own = total;
    weigh_all(lights, asker, total, chance);
    LightChoice choice = {.near = true};
    float rest = u * total;
    for (int i = 0; i < lights->near_count; i++) {
        if (chance[i] > 0.0f) {
            own = chance[i];
            choice.index = near_index(lights, i);
            choice.rest = rest;
        }
        if (rest < chance[i]) {
            break;
        }
        rest -= chance[i];
    }
    choice.rest = fminf(choice.rest / own, 0.99999994f);
    choice.ratio = own / lights->share[choice.index];
    return choice;
}

// The choice for u by powers, but by the asker among what is near.
static LightChoice choose(const Lights *lights, Asker asker, float u)
{
    LightChoice choice = lights_choose(lights, u);
    if (lights->near_count == 0 || !choice.near) {
        return choice;
    }
    float low, high;
    stretch_above(lights, &low, &high);
    float total = 1.0f - (high - low), at = u < low ? u : u - (high - low);
    return choose_near(lights, asker, total, clampf(at / total, 0.0f, 0.99999994f));
}

LightChoice lights_choose_along(const Lights *lights, const LightSegment *segment, float u)
{
    return choose(lights, (Asker){.segment = segment}, u);
}

float lights_mix(const Lights *lights, float near, bool is_near)
{
    float low, high;
    stretch_above(lights, &low, &high);
    float above = high - low;
    if (near < 0.0f || !(above > 0.0f) || !(above < 1.0f)) {
        return 1.0f;
    }
    return is_near ? near / (1.0f - above) : (1.0f - near) / above;
}

LightChoice lights_choose_mixed(const Lights *lights, const LightReceiver *receiver, float near,
                                float u)
{
    float low, high;
    stretch_above(lights, &low, &high);
    float above = high - low;
    if (near >= 0.0f && above > 0.0f && above < 1.0f) {
        if (u < near) {
            u = u / near * (1.0f - above);
            u += u < low ? 0.0f : above;
        } else {
            u = low + (u - near) / (1.0f - near) * above;
        }
        u = fminf(u, 0.99999994f);
    }
    return choose(lights, (Asker){.receiver = receiver}, u);
}

float lights_ratio(const Lights *lights, const LightReceiver *receiver, int index)
{
    if (lights->near_count == 0) {
        return 1.0f;
    }
    float low, high, chance[MOST_WEIGHED];
    stretch_above(lights, &low, &high);
    weigh_all(lights, (Asker){.receiver = receiver}, 1.0f - (high - low), chance);
    bool lamp = index >= 0 && index < lights->world->light_count;
    return chance[lamp ? index : lights->near_count - 1] /
           lights->share[lamp ? index : lights->emitters_index];
}
