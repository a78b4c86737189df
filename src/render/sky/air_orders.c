#include "render/sky/air_orders.h"

#include "base/memory.h"
#include "render/sky/air_march.h"

#include <stdlib.h>

// Directions in which light is looked for: many for sunlight scattered once, which is bright about
// the sun, and those of the table for smoother light.
enum { FINE_TILTS = 20, FINE_TURNS = 10, FINE = FINE_TILTS * FINE_TURNS };
enum { COARSE = GLOW_TILTS * GLOW_TURNS };

typedef struct Directions {
    int tilts, turns;
} Directions;

// Phase functions from each of the directions to each of the table's, as weights of sum 1:
// [to][from].
typedef struct Kernel {
    float air[COARSE][FINE], dust[COARSE][FINE];
} Kernel;

// Light on level ground from above, by the sun's elevation.
typedef struct Ground {
    Spectrum irradiance[GLOW_SUNS];
} Ground;

typedef struct Orders {
    const AirModel *model;
    Kernel *kernel;
    int first_sun, last_sun;
    Ground ground, next; // light on it of the last order, and of the one that is being found
} Orders;

static int count_of(Directions d)
{
    return d.tilts * d.turns;
}

// Solid angle of a direction's cell and of its mirror image beyond the sun's plane.
static double solid_angle(Directions d, int tilt)
{
    double low = -1.0 + 2.0 * tilt / d.tilts, high = low + 2.0 / d.tilts;
    return (high * fabs(high) - low * fabs(low)) * 2.0 * (double)PI_F / d.turns;
}

static void normalise(float *weight, int count)
{
    double sum = 0.0;
    for (int k = 0; k < count; k++) {
        sum += (double)weight[k];
    }
    for (int k = 0; k < count; k++) {
        weight[k] = (float)((double)weight[k] / sum);
    }
}

static void fill_row(Kernel *kernel, Directions from, int to)
{
    double mu = air_tilt(to / GLOW_TURNS, GLOW_TILTS), sine = sqrt(1.0 - mu * mu);
    double turn = air_turn(to % GLOW_TURNS, GLOW_TURNS);
    for (int k = 0; k < count_of(from); k++) {
        int tilt = k / from.turns;
        double other = air_tilt(tilt, from.tilts), across = sine * sqrt(1.0 - other * other);
        double angle = air_turn(k % from.turns, from.turns), half = 0.5 * solid_angle(from, tilt);
        float near = (float)(mu * other + across * cos(turn - angle));
        float far = (float)(mu * other + across * cos(turn + angle));
        kernel->air[to][k] = (float)half * (air_rayleigh_phase(near) + air_rayleigh_phase(far));
        kernel->dust[to][k] = (float)half * (air_mie_phase(near) + air_mie_phase(far));
    }
    normalise(kernel->air[to], count_of(from));
    normalise(kernel->dust[to], count_of(from));
}

static void fill_kernel(Kernel *kernel, Directions from, const Run *run)
{
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int to = 0; to < COARSE; to++) {
        fill_row(kernel, from, to);
    }
}

// Irradiance of the ground where the sun has this cosine to the vertical: of the sun itself, or of
// the sky that it has lit.
static Spectrum ground_light(const Orders *o, bool of_sun, double mu_sun)
{
    Spectrum light = {{0.0f}};
    Column sun;
    if (of_sun) {
        bool lit = mu_sun > 0.0 && air_column_to_space(o->model, GROUND_RADIUS, mu_sun, &sun);
        for (int i = 0; lit && i < SPECTRUM_BANDS; i++) {
            light.v[i] = air_decay(air_extinction(o->model, i, sun)) * (float)mu_sun;
        }
        return light;
    }
    int k = o->first_sun;
    while (k < o->last_sun - 1 && air_glow_sun(k + 1) < mu_sun) {
        k++;
    }
    double low = air_glow_sun(k), high = air_glow_sun(k + 1);
    float t = clampf((float)((mu_sun - low) / (high - low)), 0.0f, 1.0f);
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        light.v[i] = lerpf(o->ground.irradiance[k].v[i], o->ground.irradiance[k + 1].v[i], t);
    }
    return light;
}

// What lies in a direction's way, the same for all that are tilted alike.
typedef struct Way {
    double r, mu, length;
    bool ground; // at its end
    AirPath path;
} Way;

static void find_way(const Orders *o, double r, double mu, Way *way)
{
    enum { STEPS = 16 };
    way->r = r;
    way->mu = mu;
    way->length = air_distance_to_top(r, mu);
    way->ground = air_meets_ground(r, mu, &way->length);
    air_path_find(o->model, r, mu, way->length, STEPS, &way->path);
}

// Radiance that comes to the point from a direction: sunlight scattered once with before == NULL,
// or else what scatters the light of `before` once more. The ground scatters, too.
static Spectrum radiance_from(const Orders *o, const AirGlow *before, const Way *way, double mu_sun,
                              double turn)
{
    double r = way->r, mu = way->mu;
    double cosine = mu * mu_sun + sqrt(1.0 - mu * mu) * sqrt(1.0 - mu_sun * mu_sun) * cos(turn);
    AirRay ray = air_ray(r, mu, mu_sun, cosine);
    AirMarch m = air_march(o->model, before, !before, &ray, &way->path);
    Spectrum light = before ? m.glow : m.sunlit;
    if (way->ground) {
        double foot = (r * mu_sun + way->length * cosine) / GROUND_RADIUS;
        Spectrum lit = ground_light(o, !before, foot);
        for (int i = 0; i < SPECTRUM_BANDS; i++) {
            light.v[i] += m.clear.v[i] * lit.v[i] * o->model->ground_albedo / PI_F;
        }
    }
    return light;
}

// The table's entries of one point: the light around it, weighted.
static void fill_point(const Orders *o, const AirGlow *before, Directions d, int height, int sun,
                       AirGlow *glow, Spectrum *irradiance)
{
    int count = count_of(d);
    double r = air_glow_radius(height), mu_sun = air_glow_sun(sun);
    Spectrum light[FINE];
    Way way;
    *irradiance = (Spectrum){{0.0f}};
    for (int k = 0; k < count; k++) {
        double mu = air_tilt(k / d.turns, d.tilts);
        if (k % d.turns == 0) {
            find_way(o, r, mu, &way);
        }
        light[k] = radiance_from(o, before, &way, mu_sun, air_turn(k % d.turns, d.turns));
        float share = (float)(fmax(mu, 0.0) * solid_angle(d, k / d.turns));
        for (int i = 0; i < SPECTRUM_BANDS; i++) {
            irradiance->v[i] += share * light[k].v[i];
        }
    }
    for (int to = 0; to < COARSE; to++) {
        GlowPair sum = {{{0.0f}}, {{0.0f}}};
        for (int k = 0; k < count; k++) {
            float air = o->kernel->air[to][k], dust = o->kernel->dust[to][k];
            for (int i = 0; i < SPECTRUM_BANDS; i++) {
                sum.air.v[i] += air * light[k].v[i];
                sum.dust.v[i] += dust * light[k].v[i];
            }
        }
        glow->at[height][sun][to / GLOW_TURNS][to % GLOW_TURNS] = sum;
    }
}

// One more scattering of all light.
static void scatter(Orders *o, const AirGlow *before, Directions d, AirGlow *glow, const Run *run)
{
    int suns = o->last_sun - o->first_sun + 1;
    fill_kernel(o->kernel, d, run);
    glow->first_sun = o->first_sun;
    glow->last_sun = o->last_sun;
#pragma omp parallel for schedule(dynamic) num_threads(run->threads)
    for (int point = 0; point < GLOW_HEIGHTS * suns; point++) {
        int height = point / suns, sun = o->first_sun + point % suns;
        Spectrum irradiance;
        fill_point(o, before, d, height, sun, glow, &irradiance);
        if (height == 0) { // on the ground
            o->next.irradiance[sun] = irradiance;
        }
    }
    o->ground = o->next;
}

// Adds to the sum of all orders so far the last of them. With the rest, a geometric series, for it
// is to the one before as further ones are to it.
static void add_order(Spectrum *sum, const Spectrum *last, const Spectrum *before, bool with_rest)
{
    const float most = 0.9f; // ratio of two orders; the thickest haze has less
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        float ratio = before->v[i] > 0.0f ? fminf(last->v[i] / before->v[i], most) : 0.0f;
        sum->v[i] += last->v[i] / (with_rest ? 1.0f - ratio : 1.0f);
    }
}

static void add_orders(AirGlow *sum, const AirGlow *last, const AirGlow *before, bool with_rest)
{
    int suns = sum->last_sun - sum->first_sun + 1;
    for (int point = 0; point < GLOW_HEIGHTS * suns; point++) {
        int height = point / suns, sun = sum->first_sun + point % suns;
        GlowPair *to = &sum->at[height][sun][0][0];
        const GlowPair *one = &last->at[height][sun][0][0], *other = &before->at[height][sun][0][0];
        for (int i = 0; i < COARSE; i++) {
            add_order(&to[i].air, &one[i].air, &other[i].air, with_rest);
            add_order(&to[i].dust, &one[i].dust, &other[i].dust, with_rest);
        }
    }
}

bool air_orders_fill(AirGlow *glow, const AirModel *model, double sine, const Run *run, Error *e)
{
    enum { ORDERS = 5 }; // one by one
    const Directions fine = {FINE_TILTS, FINE_TURNS}, coarse = {GLOW_TILTS, GLOW_TURNS};
    air_glow_set_suns(glow, sine);
    Orders o = {.model = model, .first_sun = glow->first_sun, .last_sun = glow->last_sun};
    AirGlow *before = memory_alloc(1, sizeof *before, e);
    AirGlow *last = before ? memory_alloc(1, sizeof *last, e) : NULL;
    o.kernel = last ? memory_alloc(1, sizeof *o.kernel, e) : NULL;
    bool done = o.kernel != NULL;
    if (done) {
        scatter(&o, NULL, fine, before, run);
        *glow = *before;
    }
    for (int order = 3; done && order <= ORDERS; order++) {
        scatter(&o, before, coarse, last, run);
        add_orders(glow, last, before, order == ORDERS);
        AirGlow *swap = before;
        before = last;
        last = swap;
    }
    free(o.kernel);
    free(last);
    free(before);
    return done;
}
