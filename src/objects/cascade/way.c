// The way of a strand of water: a body in free flight, that slides on rock, clings to it where it
// bends away gently, is slowed by it, and drifts on the pool when it has arrived.
#include "base/noise.h"
#include "base/random.h"
#include "objects/cascade/cascade.h"
#include "shape/envelope.h"

#include <math.h>

#define GRAVITY 9.81f

enum { NUMBER_SIDE, NUMBER_HEIGHT, NUMBER_SPEED, NUMBER_WAY = 4, NUMBERS };
enum { STREAM_GATHER = 1, STREAM_ROUGH, STREAM_EDDIES, STREAM_STRANDS };

static const float STEP = 0.004f;              // s, on rock and in the air
static const float AFLOAT_STEP = 0.03f;        // s
static const float FILM[2] = {0.001f, 0.009f}; // m: height of strands above the rock
static const float RUB = 0.01f;                // friction: share of v^2 / depth
static const float CLING = 5.0f;               // m/s^2: what holds a film to rock that bends away
static const float LEAST_AHEAD = 0.3f;         // m/s: no water rests on a ledge
static const float WHITENS_BY_LOSS = 0.30f;    // 1 / (J/kg)
static const float WHITENS_BY_FLIGHT = 0.45f;  // 1/m
static const float CLEARS = 1.2f;              // s: of slow water
static const float POOL_RUB = 0.45f;           // s in which a jet in the pool slows down

typedef struct Way {
    const CascadeParams *params;
    const ShapeSurface *surface;
    uint64_t seed, key; // of the cascade, of the strand
    Vec3 heading;
    float film; // m
    Vec3 p, v;
    float white;
    bool on_rock, afloat;
    int step;
} Way;

Vec3 cascade_heading(const CascadeParams *params)
{
    Vec3 line = vec3_sub(params->to, params->from);
    return vec3_normalize(vec3(-line.z, 0.0f, line.x));
}

static float number_of(uint64_t key, int number)
{
    return random_unit(random_key(key, (uint64_t)number));
}

static float side_of(const CascadeParams *params, uint64_t seed, int strand)
{
    uint64_t key = random_key(seed, STREAM_STRANDS + (uint64_t)strand);
    return ((float)strand + number_of(key, NUMBER_SIDE)) / (float)params->strands;
}

float cascade_share(const CascadeParams *params, uint64_t seed, int strand)
{
    float across = side_of(params, seed, strand) * vec3_distance(params->from, params->to);
    uint64_t key = random_key(seed, STREAM_GATHER);
    float broad = noise_plane_fractal(3.1f * across, 0.3f, 2, key);
    float fine = noise_plane_fractal(23.0f * across, 5.3f, 3, key);
    float share = 1.0f + params->gather * (1.5f * broad + 1.3f * fine);
    return share > 0.0f ? share : 0.0f;
}

// The rock's grain turns films, all strands at a place alike, so that they gather in rills.
static Vec3 roughened(const Way *w, Vec3 normal)
{
    static const float size[] = {0.07f, 0.022f}, steep[] = {0.5f, 0.4f};
    uint64_t key = random_key(w->seed, STREAM_ROUGH);
    for (int i = 0; i < 2; i++) {
        Vec3 q = vec3_scale(w->p, 1.0f / size[i]);
        Vec3 tilt = vec3(noise_space(q, key), 0.0f, noise_space(q, random_key(key, 7)));
        normal = vec3_madd(normal, steep[i], tilt);
    }
    return vec3_normalize(normal);
}

// The surface nearest to the strand. Returns how far above it it is, m. Beyond an edge the normal
// is the direction from the edge, so that water may leave it.
static float above(const Way *w, Vec3 *near, Vec3 *normal)
{
    const float least = 1e-4f; // m
    *near = w->p;
    w->surface->nearest(w->surface->user, near, normal);
    Vec3 off = vec3_sub(w->p, *near);
    float away = vec3_dot(off, *normal), far = vec3_length(off);
    if (away <= 0.0f || far < least) {
        return away;
    }
    *normal = vec3_scale(off, 1.0f / far);
    return far;
}

// Lays what has come to the surface on it. Returns what it loses, J/kg.
static float slide(Way *w)
{
    const float held = CLING * STEP;
    Vec3 near, normal;
    float away = above(w, &near, &normal);
    bool meets = away < w->film;
    float leaves = vec3_dot(w->v, normal);
    bool clings = w->on_rock && away < w->film + 0.012f && leaves < held;
    if (!meets && !clings) {
        w->on_rock = false;
        return 0.0f;
    }
    float before = vec3_dot(w->v, w->v);
    w->p = vec3_madd(near, w->film, normal);
    w->v = vec3_madd(w->v, -leaves, normal);
    Vec3 rough = roughened(w, normal);
    float aside = vec3_dot(w->v, rough);
    w->v = vec3_madd(w->v, -fminf(aside, 0.0f), vec3_madd(rough, -vec3_dot(rough, normal), normal));
    float speed = vec3_length(w->v);
    w->v = vec3_scale(w->v, 1.0f / (1.0f + STEP * RUB * speed / (w->film + 0.003f)));
    if (normal.y > 0.3f) {
        float ahead = vec3_dot(w->v, w->heading);
        w->v =
            ahead < LEAST_AHEAD ? vec3_madd(w->v, 0.1f * (LEAST_AHEAD - ahead), w->heading) : w->v;
    }
    w->on_rock = true;
    return fmaxf(0.5f * (before - vec3_dot(w->v, w->v)), 0.0f);
}

static void turn_aside(Way *w)
{
    enum { HOLDS = 12 }; // steps of one turn of turbulence
    uint64_t key = random_key(w->key, NUMBERS + (uint64_t)(w->step / HOLDS));
    Vec3 push = random_direction(key);
    float share = w->params->wander * (w->on_rock ? 1.0f : 0.35f);
    w->v = vec3_madd(w->v, share * 0.02f * vec3_length(w->v), push);
}

static void fly(Way *w)
{
    w->v.y -= GRAVITY * STEP;
    turn_aside(w);
    w->p = vec3_madd(w->p, STEP, w->v);
    float speed = vec3_length(w->v), loss = slide(w);
    float gain = WHITENS_BY_LOSS * loss;
    gain += w->on_rock ? 0.0f : WHITENS_BY_FLIGHT * speed * STEP;
    w->white += gain * (1.0f - w->white);
    w->white *= speed < 0.5f ? 1.0f - STEP / CLEARS : 1.0f;
    if (w->p.y <= w->params->level) {
        Vec3 aside = random_direction(random_key(w->key, NUMBER_WAY));
        float into = 0.22f * vec3_length(w->v);
        w->v = vec3(0.3f * w->v.x + into * aside.x, 0.0f, 0.3f * w->v.z + into * aside.z);
        w->p.y = w->params->level;
        w->afloat = true;
        w->on_rock = false;
    }
}

// m/s, of the pool's eddies.
static Vec3 eddies(const Way *w)
{
    static const float size[] = {0.55f, 0.19f}, fast[] = {0.10f, 0.035f};
    uint64_t key = random_key(w->seed, STREAM_EDDIES);
    Vec3 sum = {0};
    for (int i = 0; i < 2; i++) {
        const float by = 0.05f;
        float x = w->p.x / size[i], z = w->p.z / size[i];
        float dx = noise_plane(x + by, z, key) - noise_plane(x - by, z, key);
        float dz = noise_plane(x, z + by, key) - noise_plane(x, z - by, key);
        sum = vec3_add(sum, vec3_scale(vec3(dz, 0.0f, -dx), fast[i] / (2.0f * by)));
    }
    return sum;
}

static void float_on(Way *w)
{
    Vec3 rest = vec3_madd(eddies(w), 0.05f, w->heading);
    Vec3 push = random_direction(random_key(w->key, NUMBERS + (uint64_t)w->step));
    w->v = vec3_lerp(w->v, rest, AFLOAT_STEP / POOL_RUB);
    w->v = vec3_madd(w->v, 0.02f + 0.05f * vec3_length(w->v), vec3(push.x, 0.0f, push.z));
    w->p = vec3_madd(w->p, AFLOAT_STEP, w->v);
    Vec3 near, normal;
    float away = above(w, &near, &normal);
    if (away < 0.01f) {
        Vec3 out = vec3_normalize(vec3(normal.x, 0.0f, normal.z));
        w->p = vec3_madd(w->p, fminf(0.01f - away, 0.02f), out);
        w->v = vec3_madd(w->v, -fminf(vec3_dot(w->v, out), 0.0f), out);
    }
    w->white *= 1.0f - AFLOAT_STEP / (w->params->drift + AFLOAT_STEP);
}

static Way start(const CascadeParams *params, const ShapeSurface *surface, uint64_t seed,
                 int strand)
{
    Way w = {.params = params,
             .surface = surface,
             .seed = seed,
             .key = random_key(seed, STREAM_STRANDS + (uint64_t)strand),
             .heading = cascade_heading(params),
             .white = 0.06f};
    float depth = number_of(w.key, NUMBER_HEIGHT);
    w.film = lerpf(FILM[0], FILM[1], depth * depth);
    w.p = vec3_lerp(params->from, params->to, side_of(params, seed, strand));
    Vec3 normal;
    surface->nearest(surface->user, &w.p, &normal);
    w.p = vec3_madd(w.p, w.film, normal);
    w.on_rock = true;
    float fast = lerpf(0.75f, 1.2f, number_of(w.key, NUMBER_SPEED));
    w.v = vec3_scale(w.heading, fast * params->speed);
    return w;
}

int cascade_way(const CascadeParams *params, const ShapeSurface *surface, uint64_t seed, int strand,
                CascadePlace *place, int most)
{
    const float faint = 0.02f;
    Way w = start(params, surface, seed, strand);
    int count = 0;
    for (w.step = 0; w.step < most; w.step++) {
        place[count++] = (CascadePlace){.at = w.p,
                                        .velocity = w.v,
                                        .seconds = w.afloat ? AFLOAT_STEP : STEP,
                                        .white = w.white,
                                        .on_rock = w.on_rock,
                                        .afloat = w.afloat};
        if (w.afloat && w.white < faint) {
            break;
        }
        (w.afloat ? float_on : fly)(&w);
    }
    return count;
}
