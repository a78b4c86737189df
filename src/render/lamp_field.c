#include "render/lamp_field.h"

#include "base/color.h"
#include "base/memory.h"
#include "base/random.h"
#include "render/integrator.h"
#include "render/lamp_tally.h"
#include "render/light/emission.h"
#include "render/path.h"

#include <stdlib.h>

enum {
    PILOTS = 4096,        // photons that tell where the field is needed
    MOST_SEGMENTS = 1000, // of a photon: in a cloud of 30 mean free paths one in a thousand is lost
    SEGMENTS = 8000000,   // of all photons, about
    LEAST_PHOTONS = 20000,
    MOST_PHOTONS = 2000000,
    MOST_VOXELS = 1200000,
    BLOCK = 256 // photons of one piece of work
};

static const float LEAST_COLLIDING = 0.02f; // share of photons, below which a field does not pay
static const float SPREAD = 3.0f;           // standard deviations of collisions that it covers
static const float SIDE = 0.35f;            // of a voxel, in mean free paths, at least

struct LampField {
    LampBox box;
    Vec3 *mean; // owned: radiance; x first, then y, z last
};

typedef struct Photon {
    Vec3 origin, direction, color;
    int channel; // whose extinction in the medium it has
    uint64_t key;
} Photon;

typedef enum Flight { FLIGHT_ENDED, FLIGHT_MEDIUM, FLIGHT_DROPLET } Flight;

void lamp_field_free(LampField *field)
{
    if (field) {
        free(field->mean);
        free(field);
    }
}

int64_t lamp_field_bytes(void)
{
    return MOST_VOXELS * (int64_t)(sizeof(LampTally) + sizeof(Vec3));
}

// ---- photons

static bool is_grey(Vec3 v)
{
    return v.x == v.y && v.y == v.z;
}

// Where the medium is coloured, a photon has one channel, drawn by its share of the light, and
// stands for all of that: each channel then has flights of its own.
static void choose_channel(Photon *photon, const Filling *medium, float u)
{
    if (is_grey(medium->extinction) && is_grey(medium->scattering)) {
        return;
    }
    Vec3 c = photon->color;
    float sum = c.x + c.y + c.z, at = u * sum;
    photon->channel = at < c.x ? 0 : (at < c.x + c.y ? 1 : 2);
    photon->color = vec3(photon->channel == 0 ? sum : 0.0f, photon->channel == 1 ? sum : 0.0f,
                         photon->channel == 2 ? sum : 0.0f);
}

static Photon photon_start(const Tracer *tracer, const EmissionTable *table, uint64_t key)
{
    Emission light = emission_draw(table, random_key(key, 0));
    Photon photon = {light.origin, light.direction, light.color, 0, random_key(key, 1)};
    choose_channel(&photon, &tracer->outside, random_unit(random_key(key, 2)));
    return photon;
}

static float channel_of(Vec3 v, int channel)
{
    return channel == 0 ? v.x : (channel == 1 ? v.y : v.z);
}

// The distance at which the medium takes the photon, if nearer than `far`; else `far`.
static float meet_medium(const Photon *photon, const Tracer *tracer, float far, float u)
{
    float rate = channel_of(tracer->outside.extinction, photon->channel);
    if (rate <= 0.0f) {
        return far;
    }
    MediumLine line = medium_line(&tracer->world->medium, tracer->center, tracer->medium_radius,
                                  photon->origin, photon->direction, far);
    float length = -logf(1.0f - u) / rate;
    return line.count > 0 && length < line.length ? medium_line_at(&line, length) : far;
}

static Flight scatter_in_medium(Photon *photon, const Filling *medium, uint64_t key)
{
    float albedo = channel_of(medium->scattering, photon->channel) /
                   channel_of(medium->extinction, photon->channel);
    photon->color = vec3_scale(photon->color, albedo);
    photon->direction =
        phase_draw(medium->anisotropy, photon->direction, random_unit(random_key(key, 0)),
                   random_unit(random_key(key, 1)));
    return albedo > 0.0f ? FLIGHT_MEDIUM : FLIGHT_ENDED;
}

// Moves the photon to where a droplet or the medium scatters it. *length: m, of its way.
static Flight photon_fly(Photon *photon, const Tracer *tracer, uint64_t segment, float *length)
{
    CloudRay way = {photon->origin, photon->direction, INFINITY, true};
    float scale = cloud_even_extinction(&tracer->droplets);
    int which;
    float droplet = clouds_collide_with(tracer->clouds, &way, scale, &photon->key, &which);
    uint64_t key = random_key(photon->key, ~segment);
    float t = meet_medium(photon, tracer, droplet, random_unit(random_key(key, 2)));
    Ray ray = {.origin = photon->origin,
               .direction = photon->direction,
               .far = t,
               .key = (uint32_t)random_key(photon->key, segment)};
    Hit hit;
    bool met = accel_intersect(tracer->accel, &ray, &hit);
    *length = met ? hit.t : t;
    if (met || isinf(t)) {
        return FLIGHT_ENDED;
    }
    photon->origin = vec3_madd(photon->origin, t, photon->direction);
    if (t < droplet) {
        return scatter_in_medium(photon, &tracer->outside, key);
    }
    photon->direction = random_direction(random_key(photon->key, 2 * segment + 1));
    if (clouds_absorb(tracer->clouds, which) &&
        !clouds_scatter(tracer->clouds, which, scale, random_unit(random_key(key, 3)),
                        &photon->color)) {
        return FLIGHT_ENDED;
    }
    return FLIGHT_DROPLET;
}

// ---- where the field lies

// One pilot's collisions with droplets.
typedef struct Pilot {
    int segments, collisions;
    double length;    // m, of the ways to them, without the first
    double sum[3][2]; // of coordinates and of their squares
    float low[3], high[3];
} Pilot;

static void fly_pilot(Pilot *pilot, const Tracer *tracer, const EmissionTable *table, uint64_t key)
{
    *pilot =
        (Pilot){.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}};
    Photon photon = photon_start(tracer, table, key);
    float length;
    Flight flight = FLIGHT_MEDIUM;
    while (flight != FLIGHT_ENDED && pilot->segments < MOST_SEGMENTS) {
        flight = photon_fly(&photon, tracer, (uint64_t)pilot->segments++, &length);
        if (flight != FLIGHT_DROPLET) {
            continue;
        }
        pilot->length += pilot->collisions++ > 0 ? (double)length : 0.0;
        float at[3] = {photon.origin.x, photon.origin.y, photon.origin.z};
        for (int axis = 0; axis < 3; axis++) {
            pilot->sum[axis][0] += (double)at[axis];
            pilot->sum[axis][1] += (double)at[axis] * (double)at[axis];
            pilot->low[axis] = fminf(pilot->low[axis], at[axis]);
            pilot->high[axis] = fmaxf(pilot->high[axis], at[axis]);
        }
    }
}

// What all pilots found.
typedef struct Survey {
    Pilot all;
    int colliding; // photons
} Survey;

static Survey sum_pilots(const Pilot pilot[])
{
    Survey s = {
        .all = {.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}}};
    for (int i = 0; i < PILOTS; i++) {
        s.all.segments += pilot[i].segments;
        s.all.collisions += pilot[i].collisions;
        s.all.length += pilot[i].length;
        s.colliding += pilot[i].collisions > 0;
        for (int axis = 0; axis < 3; axis++) {
            s.all.sum[axis][0] += pilot[i].sum[axis][0];
            s.all.sum[axis][1] += pilot[i].sum[axis][1];
            s.all.low[axis] = fminf(s.all.low[axis], pilot[i].low[axis]);
            s.all.high[axis] = fmaxf(s.all.high[axis], pilot[i].high[axis]);
        }
    }
    return s;
}

static bool survey(Survey *out, const Tracer *tracer, const EmissionTable *table, uint64_t key,
                   const Run *run, Error *e)
{
    Pilot *pilot = memory_alloc(PILOTS, sizeof *pilot, e);
    if (!pilot) {
        return false;
    }
#pragma omp parallel num_threads(run->threads)
    {
        unsigned state = accel_thread_begin();
#pragma omp for schedule(dynamic, 16)
        for (int i = 0; i < PILOTS; i++) {
            fly_pilot(&pilot[i], tracer, table, random_key(key, (uint64_t)i));
        }
        accel_thread_end(state);
    }
    *out = sum_pilots(pilot);
    free(pilot);
    return true;
}

// The box that holds nearly all collisions.
static LampBox lay_out(const Survey *s)
{
    LampBox box;
    float low[3], size[3], most = 0.0f, volume = 1.0f;
    double n = (double)s->all.collisions;
    for (int axis = 0; axis < 3; axis++) {
        double mean = s->all.sum[axis][0] / n;
        double deviation = sqrt(fmax(s->all.sum[axis][1] / n - mean * mean, 0.0));
        low[axis] = fmaxf(s->all.low[axis], (float)(mean - (double)SPREAD * deviation));
        float high = fminf(s->all.high[axis], (float)(mean + (double)SPREAD * deviation));
        size[axis] = fmaxf(high - low[axis], 0.0f);
        most = fmaxf(most, size[axis]);
    }
    for (int axis = 0; axis < 3; axis++) {
        size[axis] = fmaxf(size[axis], 0.01f * most);
        volume *= size[axis];
    }
    float free_path = (float)(s->all.length / fmax(n - (double)s->colliding, 1.0));
    box.voxel = fmaxf(fmaxf(SIDE * free_path, cbrtf(volume / MOST_VOXELS)), 0.005f * most);
    for (int axis = 0; axis < 3; axis++) { // a voxel on each side, between whose middle and that of
        box.count[axis] =
            (int)ceilf(size[axis] / box.voxel) + 2; // the next one lookups interpolate
        low[axis] -= box.voxel;
    }
    box.low = vec3(low[0], low[1], low[2]);
    return box;
}

// ---- all photons

static void fly_photon(LampTally *tally, const LampBox *box, const Tracer *tracer,
                       const EmissionTable *table, uint64_t key)
{
    Photon photon = photon_start(tracer, table, key);
    Flight flight = FLIGHT_MEDIUM;
    for (int i = 0; flight != FLIGHT_ENDED && i < MOST_SEGMENTS; i++) {
        Vec3 from = photon.origin, direction = photon.direction, color = photon.color;
        float length;
        flight = photon_fly(&photon, tracer, (uint64_t)i, &length);
        lamp_tally_stretch(tally, box, from, direction, length, color);
    }
}

static bool fly_photons(LampTally *tally, const LampBox *box, const Tracer *tracer,
                        const EmissionTable *table, int64_t photons, uint64_t key, const Run *run,
                        Error *e)
{
    int64_t blocks = photons / BLOCK;
#pragma omp parallel num_threads(run->threads)
    {
        unsigned state = accel_thread_begin();
#pragma omp for schedule(dynamic, 1)
        for (int64_t block = 0; block < blocks; block++) {
            if (run_is_cancelled(run)) {
                continue;
            }
            for (int64_t i = block * BLOCK; i < (block + 1) * BLOCK; i++) {
                fly_photon(tally, box, tracer, table, random_key(key, (uint64_t)i));
            }
        }
        accel_thread_end(state);
    }
    return !run_is_cancelled(run) || run_cancel_error(e);
}

static bool fill(LampField *field, const Tracer *tracer, const EmissionTable *table,
                 const Survey *s, uint64_t key, const Run *run, Error *e)
{
    LampBox *box = &field->box;
    int64_t photons = (int64_t)((double)SEGMENTS * PILOTS / s->all.segments);
    photons = photons < LEAST_PHOTONS ? LEAST_PHOTONS : photons;
    photons = (photons < MOST_PHOTONS ? photons : MOST_PHOTONS) / BLOCK * BLOCK;
    LampTally *tally = memory_alloc_zero(lamp_box_voxels(box), sizeof *tally, e);
    if (!tally || !fly_photons(tally, box, tracer, table, photons, key, run, e)) {
        free(tally);
        return false;
    }
    float scale = emission_power(table) / (4.0f * PI_F * (float)photons);
    field->mean = lamp_tally_means(tally, box, scale, e);
    free(tally);
    return field->mean;
}

bool lamp_field_make(LampField **out, const Tracer *tracer, uint64_t key, const Run *run, Error *e)
{
    *out = NULL;
    if (!tracer->clouds || !tracer->has_glow) {
        return true;
    }
    Error own = {.code = ERROR_NONE};
    EmissionTable *table = emission_table_new(tracer->lights, &own);
    if (!table) {
        if (own.code == ERROR_NONE) {
            return true;
        }
        *e = own;
        return false;
    }
    Survey s;
    bool done = survey(&s, tracer, table, random_key(key, 0), run, e);
    if (done && (float)s.colliding >= LEAST_COLLIDING * PILOTS) {
        LampField *field = memory_alloc_zero(1, sizeof *field, e);
        done = field;
        if (field) {
            field->box = lay_out(&s);
            done = fill(field, tracer, table, &s, random_key(key, 1), run, e);
            *out = done ? field : NULL;
        }
        if (!done) {
            lamp_field_free(field);
        }
    }
    emission_table_free(table);
    return done;
}

bool lamp_field_at(const LampField *field, Vec3 p, Vec3 *mean)
{
    if (!field) {
        return false;
    }
    const LampBox *box = &field->box;
    Vec3 own = vec3_scale(vec3_sub(p, box->low), 1.0f / box->voxel);
    const float place[3] = {own.x, own.y, own.z};
    for (int axis = 0; axis < 3; axis++) {
        if (!(place[axis] >= 0.0f && place[axis] < (float)box->count[axis])) {
            return false;
        }
    }
    *mean = lamp_box_interpolate(field->mean, box, p);
    return true;
}

float lamp_field_around(const LampField *field, Vec3 p)
{
    Vec3 mean;
    if (!field || lamp_field_at(field, p, &mean)) {
        return field ? luminance(mean) : 0.0f;
    }
    const LampBox *box = &field->box;
    Vec3 half = vec3_scale(vec3((float)box->count[0], (float)box->count[1], (float)box->count[2]),
                           0.5f * box->voxel);
    Vec3 middle = vec3_add(box->low, half), away = vec3_sub(p, middle);
    Vec3 near = vec3(clampf(away.x, -half.x, half.x), clampf(away.y, -half.y, half.y),
                     clampf(away.z, -half.z, half.z));
    float dim = vec3_dot(near, near) / vec3_dot(away, away);
    return luminance(lamp_box_interpolate(field->mean, box, vec3_add(middle, near))) * dim;
}
