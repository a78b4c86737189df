// What explosions and collapse do to a volcano.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "land/lava.h"
#include "objects/terrain/noise.h"
#include "objects/terrain/volcano.h"

#include <math.h>
#include <stdlib.h>

Away volcano_away(const Landscape *land, const Vent *vent, int64_t i)
{
    int64_t row = i / land->side;
    double dx = land->corner + (double)(i % land->side) * land->cell - vent->x;
    double dz = land->corner + (double)row * land->cell - vent->z;
    return (Away){dx, dz, sqrt(dx * dx + dz * dz)};
}

// Removes or adds ground; volume is booked as outflow or as risen.
static void set_height(Landscape *land, int64_t i, double height)
{
    double own = land->cell * land->cell, change = height - (land->rock[i] + land->loose[i]);
    if (land->base[i] || change == 0.0) {
        return;
    }
    if (change > 0.0) {
        land->loose[i] += change;
        land->uplifted += change * own;
        return;
    }
    double loose = -change < land->loose[i] ? -change : land->loose[i];
    land->loose[i] -= loose;
    land->rock[i] += change + loose;
    land->outflow -= change * own;
}

static double surface(const Landscape *land, int64_t i)
{
    return land->rock[i] + land->loose[i];
}

// Thickness falls exponentially with the distance from the rim (Pyle 1989), more slowly downwind.
void volcano_tephra(const Volcano *v, Landscape *land, double thick, uint64_t key)
{
    double gust = (double)random_range(random_key(key, 1), 0.1f, 0.4f);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        Away away = volcano_away(land, &v->summit, i);
        double along = away.r > 0.0 ? (away.dx * v->wind[0] + away.dz * v->wind[1]) / away.r : 0.0;
        double beyond = away.r - v->summit.rim;
        double reach = v->fall * (1.0 + gust * along);
        double at_rim = 1.0 + 0.5 * gust * along;
        double layer = beyond > 0.0 ? exact_exp(-beyond / reach) : 1.0;
        set_height(land, i, surface(land, i) + thick * at_rim * layer);
    }
}

double volcano_ring(const Volcano *v, const Landscape *land, double radius)
{
    enum { SAMPLES = 64 };
    double sum = 0.0;
    for (int k = 0; k < SAMPLES; k++) {
        double sine, cosine, loose;
        exact_sincos_double(6.283185307179586 * k / SAMPLES, &sine, &cosine);
        sum +=
            landscape_at(land, v->summit.x + radius * cosine, v->summit.z + radius * sine, &loose);
    }
    return sum / SAMPLES;
}

// The rim's radius relative to its mean: craters are not round.
static double rim_factor(const Volcano *v, const Away *away)
{
    uint64_t key = random_key(v->terrain->seed, STREAM_CRATER);
    double r = away->r > 0.0 ? away->r : 1.0;
    float n = sparse_noise_fractal((float)(1.1 * away->dx / r), (float)(1.1 * away->dz / r), 4,
                                   0.6f, 0.0f, key);
    return 1.0 + 0.10 * (double)clampf(n, -1.6f, 1.6f);
}

// A bowl: steep rock below the rim, talus under it, a floor.
void volcano_open_crater(const Volcano *v, Landscape *land)
{
    const double cliff = 1.3, talus = 0.66;
    double rim = v->summit.rim, top = volcano_ring(v, land, rim);
    double depth = 0.62 * rim, cliffs = 0.4 * depth;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        Away away = volcano_away(land, &v->summit, i);
        if (away.r > 1.5 * rim) {
            continue;
        }
        double in = rim * rim_factor(v, &away) - away.r, down = in * cliff; // below the rim
        down = down > cliffs ? cliffs + (in - cliffs / cliff) * talus : down;
        down = down < depth ? down : depth;
        double limit = top - down;
        if (in > 0.0 && surface(land, i) > limit) {
            set_height(land, i, limit);
        }
    }
}

// Lowers the ground to a scar with a floor that falls outward from the crater and walls of 45
// degrees that stand apart the farther the lower. Returns the removed volume, m^3.
static double dig_scar(const Volcano *v, Landscape *land, const double axis[2])
{
    const VolcanoParams *p = &v->params.volcano;
    double rim = v->summit.rim * (0.85 + 0.5 * (double)p->breach), removed = 0.0;
    double floor = volcano_ring(v, land, v->summit.rim) - (0.4 + 0.9 * (double)p->breach) * rim;
    uint64_t key = random_key(v->terrain->seed, STREAM_BREACH);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        Away away = volcano_away(land, &v->summit, i);
        double along = away.dx * axis[0] + away.dz * axis[1];
        double aside = fabs(away.dx * axis[1] - away.dz * axis[0]);
        float n = sparse_noise_fractal((float)(2.0 * away.dx / rim), (float)(2.0 * away.dz / rim),
                                       4, 0.6f, 0.0f, key);
        double half = rim * (0.8 + 0.12 * (double)n) + 0.22 * (along > 0.0 ? along : 0.0);
        double out = along > 0.0 ? aside - half : away.r - half;
        double limit = floor - 0.22 * (along > 0.0 ? along : 0.0) + (out > 0.0 ? 1.1 * out : 0.0);
        limit += 0.04 * rim * (double)n;
        double over = surface(land, i) - limit;
        if (over > 0.0 && away.r < 6.0 * rim) {
            removed += over * land->cell * land->cell;
            set_height(land, i, limit);
        }
    }
    return removed;
}

bool volcano_breach(Volcano *v, Landscape *land, const Run *run, Error *e)
{
    const VolcanoParams *p = &v->params.volcano;
    if (!(p->breach > 0.0f)) {
        return true;
    }
    double sine, cosine, rim = v->summit.rim;
    exact_sincos_double((double)p->breach_azimuth * 0.017453292519943295, &sine, &cosine);
    double axis[2] = {sine, -cosine}, removed = dig_scar(v, land, axis);
    // A part of it stays on the foot, as hummocks; the rest runs out thin and is washed away.
    LavaParams debris = {.volume = 0.5 * removed,
                         .rate = 1e6,
                         .yield = 2.0,
                         .viscosity = 0.5,
                         .roughness = 1.2,
                         .seed = random_key(v->terrain->seed, STREAM_BREACH)};
    return removed <= 0.0 || lava_erupt(land, &debris, v->summit.x + 4.0 * rim * axis[0],
                                        v->summit.z + 4.0 * rim * axis[1], v->flow, run, e);
}

// A piston: a flat floor within ring faults.
void volcano_sink_caldera(const Volcano *v, Landscape *land)
{
    double radius = (double)v->params.volcano.caldera;
    double floor = volcano_ring(v, land, radius) - 0.3 * radius;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        Away away = volcano_away(land, &v->summit, i);
        if (away.r > 1.4 * radius) {
            continue;
        }
        double in = radius * rim_factor(v, &away) - away.r;
        double limit = in > 0.0 ? floor + 0.02 * (double)away.r : INFINITY;
        if (surface(land, i) > limit) {
            set_height(land, i, limit);
        }
    }
}

// ---- scoria cones

// Along two fissures that run out from the summit, and some apart from them.
void volcano_place_cones(Volcano *v)
{
    uint64_t key = random_key(v->terrain->seed, STREAM_CONES);
    double first = (double)random_range(random_key(key, 0), 0.0f, 6.2831853f);
    v->cones = v->params.volcano.cones;
    for (int k = 0; k < v->cones; k++) {
        uint64_t own = random_key(key, (uint64_t)k + 1);
        bool apart = random_unit(random_key(own, 1)) < 0.3f;
        double turn = apart ? (double)random_range(random_key(own, 2), 0.0f, 6.2831853f)
                            : first + (k % 2 == 0 ? 0.0 : 2.4) +
                                  (double)random_range(random_key(own, 3), -0.16f, 0.16f);
        double out = v->fall * (double)random_range(random_key(own, 4), 0.75f, 2.1f), sine, cosine;
        out = fmin(out, 0.4 * v->size);
        exact_sincos_double(turn, &sine, &cosine);
        double radius = 0.105 * v->relief * (double)random_range(random_key(own, 5), 0.6f, 1.4f);
        v->cone[k] = (Vent){.x = v->summit.x + out * cosine,
                            .z = v->summit.z + out * sine,
                            .rim = 0.2 * radius * 2.0, // Wood 1980: 0.4 of the foot's width
                            .radius = radius};
    }
}

static void build_cone(Volcano *v, Landscape *land, const Vent *cone)
{
    const double slope = 0.577; // 30 degrees
    double loose, foot = landscape_at(land, cone->x, cone->z, &loose);
    double top = slope * (cone->radius - cone->rim);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        Away away = volcano_away(land, cone, i);
        double reach = 1.6 * cone->radius;
        if (away.r > reach) {
            continue;
        }
        double lee = away.r > 0.0 ? (away.dx * v->wind[0] + away.dz * v->wind[1]) / away.r : 0.0;
        double high = (top + slope * (cone->rim - away.r)) * (1.0 + 0.12 * lee);
        double bowl = top - 0.5 * (cone->rim - away.r); // the crater's inside
        high = away.r < cone->rim && bowl < high ? bowl : high;
        // On a slope a cone stands on its lower side: it is heaped on the mean of both.
        double ground = surface(land, i);
        double level = ground + 0.5 * (foot - ground) + high;
        if (high > 0.0 && level > ground) {
            set_height(land, i, level);
            double burnt = 1.0 - (away.r - 0.6 * cone->rim) / cone->radius;
            v->red[i] = fmaxf(v->red[i], clampf((float)burnt, 0.0f, 1.0f));
            v->lava[i] = 0.0f;
        }
    }
}

void volcano_build_cones(Volcano *v, Landscape *land)
{
    for (int k = 0; k < v->cones; k++) {
        build_cone(v, land, &v->cone[k]);
    }
}
