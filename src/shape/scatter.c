#include "shape/scatter.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

#define PILOT_SEED 0x70696c6f74ull // seed of the draws that estimate mean densities
enum { PILOT_DRAWS = 1 << 15, PILOT_TRIES = 1 << 22 };

ScatterParams scatter_params_default(void)
{
    return (ScatterParams){.place = SCATTER_VOLUME,
                           .pattern = SCATTER_RANDOM,
                           .count = 1000,
                           .seed = 1,
                           .scale = 1.0f};
}

// ---- one draw ----

static double unit_double(uint64_t key)
{
    return (double)(random_mix(key) >> 11) * 0x1p-53;
}

// How near p is to the surface: 0 at the deepest place, 1 at the surface.
static double outness(const Scatter *s, Vec3 p)
{
    return s->depth ? 1.0 - (double)depth_field_at(s->depth, p) : 0.0;
}

// Density at p relative to a uniform one, before normalisation of shell and gradients; its maximum
// is largest_weight. out: outness of p.
static double weight_at(const Scatter *s, Vec3 p, double out)
{
    const ScatterParams *params = s->params;
    double height = (double)clampf((p.y - s->lowest) * s->inverse_height, 0.0f, 1.0f);
    double weight = 1.0 + (double)params->gradient * (2.0 * height - 1.0);
    if (params->density) {
        weight *= (double)params->density(params->density_user, p);
    }
    if (s->depth) {
        double out2 = out * out;
        weight *= 1.0 + (double)params->depth_gradient * (2.0 * out - 1.0);
        weight *= 1.0 - (double)params->shell + (double)params->shell * out2 * out2 / s->mean_shell;
    }
    return weight;
}

static double largest_weight(const Scatter *s)
{
    const ScatterParams *params = s->params;
    double weight = 1.0 + (double)fabsf(params->gradient);
    if (s->depth) {
        weight *= 1.0 + (double)fabsf(params->depth_gradient);
        weight *= 1.0 - (double)params->shell + (double)params->shell / s->mean_shell;
    }
    return weight;
}

static Vec3 interpolate(const Vec3 *values, const uint32_t *corner, float u, float v)
{
    Vec3 a = values[corner[0]], b = values[corner[1]], c = values[corner[2]];
    return vec3_add(vec3_scale(a, 1.0f - u - v), vec3_add(vec3_scale(b, u), vec3_scale(c, v)));
}

// Index of the face that contains this share of the total area.
static int64_t find_face(const double *cumulative, int64_t count, double share)
{
    double area = share * cumulative[count - 1];
    int64_t low = 0, high = count - 1;
    while (low < high) {
        int64_t middle = low + (high - low) / 2;
        if (cumulative[middle] > area) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

static void draw_on_surface(const Scatter *s, uint64_t key, Draw *draw)
{
    const Mesh *mesh = envelope_surface(s->envelope);
    int64_t face =
        find_face(s->cumulative, mesh->face_count, unit_double(random_key(key, STREAM_POSITION)));
    const uint32_t *corner = mesh->index + 3 * face;
    // uniform in a triangle (Turk 1990)
    float root = (float)sqrt(unit_double(random_key(key, STREAM_POSITION + 1)));
    float v = root * random_unit(random_key(key, STREAM_POSITION + 2)), u = root - v;
    draw->position = interpolate(mesh->position, corner, u, v);
    draw->normal = vec3_normalize(interpolate(mesh->normal, corner, u, v));
    if (isinf(envelope_band(s->envelope))) { // a primitive: from the facet to the exact surface
        float distance = envelope_distance(s->envelope, draw->position);
        draw->position = vec3_madd(draw->position, -distance, draw->normal);
    }
    draw->inside = true;
}

bool scatter_keeps(const Scatter *s, Vec3 p, uint64_t key)
{
    return !s->weighted || unit_double(random_key(key, STREAM_KEEP)) * largest_weight(s) <
                               weight_at(s, p, outness(s, p));
}

bool scatter_faces(const Scatter *s, Vec3 normal)
{
    Vec3 facing = s->params->facing;
    return !s->faces || 2.0f * vec3_dot(normal, facing) >= vec3_length(facing);
}

Draw scatter_draw(const Scatter *s, uint64_t number)
{
    uint64_t key = random_key(s->params->seed, number);
    Draw draw = {.id = key, .normal = vec3(0, 1, 0)};
    if (s->params->place == SCATTER_SURFACE) {
        draw_on_surface(s, key, &draw);
    } else {
        double u[3], p[3];
        for (int i = 0; i < 3; i++) {
            u[i] = unit_double(random_key(key, STREAM_POSITION + (uint64_t)i));
        }
        for (int i = 0; i < 3; i++) {
            const float *row = s->frame.m[i];
            p[i] = (double)row[0] * u[0] + (double)row[1] * u[1] + (double)row[2] * u[2] +
                   (double)row[3];
        }
        draw.position = vec3((float)p[0], (float)p[1], (float)p[2]);
        draw.inside = envelope_contains(s->envelope, draw.position);
    }
    draw.kept =
        draw.inside && scatter_faces(s, draw.normal) && scatter_keeps(s, draw.position, key);
    draw.position = vec3_madd(s->center, s->params->scale, vec3_sub(draw.position, s->center));
    return draw;
}

void scatter_draw_many(const Scatter *scatter, uint64_t first, int64_t count, Draw *draws,
                       const Run *run)
{
#pragma omp parallel for schedule(dynamic, 1024) num_threads(run->threads)
    for (int64_t i = 0; i < count; i++) {
        draws[i] = scatter_draw(scatter, first + (uint64_t)i);
    }
}

// ---- checks ----

static bool check_share(const char *name, float value, float low, Error *e)
{
    if (!(value >= low) || !(value <= 1.0f)) {
        return error_set(e, ERROR_INPUT, "%s is %g; it must lie between %g and 1", name,
                         (double)value, (double)low);
    }
    return true;
}

static bool check_count(int64_t count, Error *e)
{
    if (count < 1) {
        return error_set(e, ERROR_INPUT, "%lld points; at least one is needed", (long long)count);
    }
    if (count > INT32_MAX) {
        return error_set(e, ERROR_INPUT, "%lld points; at most %d are possible", (long long)count,
                         INT32_MAX);
    }
    double needed = (double)count * (2.0 * sizeof(Vec3) + sizeof(uint64_t));
    return memory_check(needed, e, "%lld points", (long long)count);
}

static bool check_params(const Envelope *envelope, const ScatterParams *params, Error *e)
{
    if (!check_count(params->count, e) || !check_share("shell", params->shell, 0.0f, e) ||
        !check_share("gradient", params->gradient, -1.0f, e) ||
        !check_share("depth_gradient", params->depth_gradient, -1.0f, e)) {
        return false;
    }
    if (!isfinite(params->scale) || !(params->scale > 0.0f)) {
        return error_set(e, ERROR_INPUT, "scale is %g; it must be positive", (double)params->scale);
    }
    if (params->anchored && params->pattern == SCATTER_POISSON) {
        error_set(
            e, ERROR_INPUT,
            "anchored points keep no minimum distance; use the pattern random, or anchored: false");
        return error_key(e, "points.anchored");
    }
    if (params->place == SCATTER_VOLUME && !(envelope_volume(envelope) > 0.0)) {
        error_set(e, ERROR_INPUT,
                  "the envelope has no interior for points; close its mesh, make its voxel "
                  "smaller, or place the points on its surface");
        return error_key(e, "envelope");
    }
    if (params->place == SCATTER_SURFACE && !(envelope_area(envelope) > 0.0)) {
        error_set(e, ERROR_INPUT, "the envelope has no surface for points; make it larger");
        return error_key(e, "envelope");
    }
    return true;
}

bool scatter_empty_error(const Scatter *scatter, int64_t draws, Error *e)
{
    error_set(e, ERROR_INPUT,
              "the envelope fills too little of its bounding box: %lld random draws did not give "
              "%lld points; make the envelope thicker, or use fewer points",
              (long long)draws, (long long)scatter->params->count);
    return error_key(e, "envelope");
}

// ---- preparation ----

static bool sum_areas(Scatter *s, Error *e)
{
    const Mesh *mesh = envelope_surface(s->envelope);
    s->cumulative = memory_alloc(mesh->face_count, sizeof *s->cumulative, e);
    if (!s->cumulative) {
        return false;
    }
    double sum = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + 3 * f;
        Vec3 a = mesh->position[corner[0]];
        Vec3 across = vec3_cross(vec3_sub(mesh->position[corner[1]], a),
                                 vec3_sub(mesh->position[corner[2]], a));
        double x = (double)across.x, y = (double)across.y, z = (double)across.z;
        sum += 0.5 * sqrt(x * x + y * y + z * z);
        s->cumulative[f] = sum;
    }
    return true;
}

// Means over the region of the shell's density and of the whole weight.
static bool measure_weights(Scatter *s, Error *e)
{
    ScatterParams even = *s->params;
    even.seed = PILOT_SEED;
    even.scale = 1.0f;
    Scatter pilot = *s;
    pilot.params = &even;
    pilot.weighted = false;
    Vec3 *inner = memory_alloc(PILOT_DRAWS, sizeof *inner, e);
    double *out = memory_alloc(PILOT_DRAWS, sizeof *out, e);
    bool made = inner && out;
    int64_t n = 0, averted = 0; // draws
    for (uint64_t i = 0; made && i < PILOT_TRIES && n < PILOT_DRAWS; i++) {
        Draw draw = scatter_draw(&pilot, i);
        if (draw.kept) {
            inner[n++] = draw.position;
        }
        averted += draw.inside && !draw.kept;
    }
    double shell = 0.0, weight = 0.0;
    for (int64_t i = 0; i < n; i++) {
        out[i] = outness(s, inner[i]);
        shell += out[i] * out[i] * out[i] * out[i];
    }
    s->mean_shell = n > 0 && shell > 0.0 ? shell / (double)n : 1.0;
    for (int64_t i = 0; i < n; i++) {
        weight += weight_at(s, inner[i], out[i]);
    }
    s->mean_weight = n > 0 ? weight / ((double)n * largest_weight(s)) : 0.0;
    s->seen = n > 0 ? (double)n / (double)(n + averted) : 0.0;
    free(inner);
    free(out);
    if (made && !(s->mean_weight > 0.0)) {
        return scatter_empty_error(s, PILOT_TRIES, e);
    }
    return made;
}

static bool scatter_prepare(const Envelope *envelope, const ScatterParams *params, Scatter *s,
                            Error *e)
{
    bool volume = params->place == SCATTER_VOLUME;
    *s = (Scatter){
        .envelope = envelope, .params = params, .mean_shell = 1.0, .mean_weight = 1.0, .seen = 1.0};
    Aabb box = envelope_bounds(envelope);
    s->frame = envelope_frame(envelope);
    s->lowest_corner = box.low;
    s->center = params->scale_about_center ? params->scale_center
                                           : vec3_scale(vec3_add(box.low, box.high), 0.5f);
    s->lowest = box.low.y;
    float height = box.high.y - box.low.y;
    s->inverse_height = height > 0.0f ? 1.0f / height : 0.0f;
    bool uses_depth = volume && (params->shell > 0.0f || params->depth_gradient != 0.0f);
    s->weighted = uses_depth || params->gradient != 0.0f || params->density;
    s->faces = !volume && vec3_dot(params->facing, params->facing) > 0.0f;
    if (!volume && !sum_areas(s, e)) {
        return false;
    }
    if (uses_depth) {
        s->depth = envelope_depth(envelope, e);
        if (!s->depth) {
            return false;
        }
    }
    return !(s->weighted || s->faces) || measure_weights(s, e);
}

static void scatter_release(Scatter *s)
{
    free(s->cumulative);
}

PointSet *points_scatter(const Envelope *envelope, const ScatterParams *params, const Run *run,
                         Error *e)
{
    if (!check_params(envelope, params, e)) {
        return NULL;
    }
    Scatter s;
    PointSet *points = NULL;
    bool done = scatter_prepare(envelope, params, &s, e) && (points = points_new(e));
    if (done) {
        double scale = (double)params->scale;
        bool volume = params->place == SCATTER_VOLUME;
        points->dimension = volume ? 3 : 2;
        points->measure = volume ? envelope_volume(envelope) * scale * scale * scale
                                 : envelope_area(envelope) * scale * scale;
        points->measure *= s.seen;
        if (params->density) { // the mean spacing is that where the points are
            points->measure *= s.mean_weight;
        }
        done = params->anchored                     ? scatter_anchored(&s, points, run, e)
               : params->pattern == SCATTER_POISSON ? scatter_poisson(&s, points, run, e)
                                                    : scatter_random(&s, points, run, e);
    }
    scatter_release(&s);
    if (!done) {
        points_free(points);
        return NULL;
    }
    return points;
}
