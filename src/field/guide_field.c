#include "field/guide_field.h"

#include "base/memory.h"
#include "field/curl.h"
#include "field/curvature_field.h"
#include "field/field_grid.h"
#include "field/nuclei.h"
#include "field/volume_field.h"

#include <stdlib.h>

enum { DEFAULT_RESOLUTION = 48 };

struct GuideField {
    FieldParams *params; // count of them
    FieldGrid *grid;     // count of them; used for FIELD_GRID only
    int count;
    Nuclei nuclei;             // the initial nodes
    CurvatureField *curvature; // count of them; used for FIELD_CURVATURE only
    VolumeField *volume;       // count of them; used for FIELD_VOLUME only
    Nuclei *named;             // count of them; empty for fields that name none
};

static bool has_nuclei(FieldKind kind)
{
    return kind == FIELD_NUCLEI || kind == FIELD_GRID;
}

FieldParams field_params_default(FieldKind kind)
{
    return (FieldParams){.kind = kind,
                         .weight = 1.0f,
                         .vector = {0, has_nuclei(kind) ? 0.0f : 1.0f, 0},
                         .scale = 1.0f,
                         .profile = PROFILE_SWEPT,
                         .seed = 1};
}

static bool check_params(const FieldParams *p, int64_t nucleus_count, Error *e)
{
    if (!isfinite(p->weight) || !isfinite(p->turn) || !isfinite(p->scale) || !isfinite(p->rim) ||
        !isfinite(p->pull) || !vec3_finite(p->vector) || !vec3_finite(p->center)) {
        return error_set(e, ERROR_INPUT, "a field's numbers must be finite");
    }
    bool scaled = p->kind == FIELD_CURL || p->kind == FIELD_POINT || p->kind == FIELD_VOLUME;
    if (scaled && p->scale <= 0.0f) {
        return error_set(e, ERROR_INPUT, "field scale %g m; it must be positive", (double)p->scale);
    }
    if (fabsf(p->turn) > 1e6f) {
        return error_set(e, ERROR_INPUT, "field turn %g degrees; at most 1000000 make sense",
                         (double)p->turn);
    }
    if (p->kind == FIELD_CURVATURE && !p->envelope) {
        return error_set(e, ERROR_INPUT,
                         "a curvature field needs an envelope with a surface; use another kind");
    }
    if (has_nuclei(p->kind) && p->nucleus_count < 1 && nucleus_count < 1) {
        return error_set(e, ERROR_INPUT,
                         "a nuclei field needs at least one root to lead away from");
    }
    return true;
}

typedef struct GridSource {
    const Nuclei *nuclei;
    FieldParams params;
} GridSource;

static Vec3 sample_nuclei(const void *context, Vec3 p)
{
    const GridSource *source = context;
    return nuclei_at(source->nuclei, &source->params, p, vec3(0, 0, 0));
}

static const Nuclei *nuclei_of(const GuideField *field, int i)
{
    return field->params[i].nucleus_count > 0 ? &field->named[i] : &field->nuclei;
}

static bool make_grid(GuideField *field, int i, const Run *run, Error *e)
{
    GridSource source = {.nuclei = nuclei_of(field, i), .params = field->params[i]};
    source.params.surface = false; // no surface passes through a voxel's corner
    int resolution = source.params.resolution;
    return field_grid_init(&field->grid[i], sample_nuclei, &source, field->nuclei.bounds,
                           resolution == 0 ? DEFAULT_RESOLUTION : resolution, run, e);
}

static bool fill(GuideField *field, const FieldParams *params, int64_t nucleus_count,
                 const Run *run, Error *e)
{
    for (int i = 0; i < field->count; i++) {
        if (!check_params(&params[i], nucleus_count, e)) {
            return error_key(e, "%d", i);
        }
        field->params[i] = params[i];
        if (has_nuclei(params[i].kind) && params[i].nucleus_count > 0 &&
            !nuclei_init_named(&field->named[i], params[i].nucleus, params[i].nucleus_count,
                               field->nuclei.bounds, run, e)) {
            error_key(e, "nuclei");
            return error_key(e, "%d", i);
        }
        if (params[i].kind == FIELD_CURVATURE &&
            !curvature_field_init(&field->curvature[i], envelope_surface(params[i].envelope),
                                  params[i].least, e)) {
            return error_key(e, "%d", i);
        }
        if (params[i].kind == FIELD_VOLUME &&
            !volume_field_init(&field->volume[i], &params[i], run, e)) {
            return error_key(e, "%d", i);
        }
        if (params[i].kind == FIELD_GRID && !make_grid(field, i, run, e)) {
            return error_key(e, "%d", i);
        }
    }
    return true;
}

GuideField *guide_field_new(const FieldParams *params, int count, const Vec3 *nuclei,
                            const Vec3 *nucleus_normals, int64_t nucleus_count, Aabb bounds,
                            const Run *run, Error *e)
{
    GuideField *field = memory_alloc_zero(1, sizeof *field, e);
    if (!field) {
        return NULL;
    }
    field->count = count;
    field->params = memory_alloc_zero(count, sizeof *field->params, e);
    field->grid = memory_alloc_zero(count, sizeof *field->grid, e);
    field->named = memory_alloc_zero(count, sizeof *field->named, e);
    field->curvature = memory_alloc_zero(count, sizeof *field->curvature, e);
    field->volume = memory_alloc_zero(count, sizeof *field->volume, e);
    if (!field->params || !field->grid || !field->named || !field->curvature || !field->volume ||
        !nuclei_init(&field->nuclei, nuclei, nucleus_normals, nucleus_count, bounds, e) ||
        !fill(field, params, nucleus_count, run, e)) {
        guide_field_free(field);
        return NULL;
    }
    return field;
}

void guide_field_free(GuideField *field)
{
    if (field) {
        for (int i = 0; field->grid && i < field->count; i++) {
            field_grid_free(&field->grid[i]);
        }
        for (int i = 0; field->curvature && i < field->count; i++) {
            curvature_field_free(&field->curvature[i]);
        }
        for (int i = 0; field->volume && i < field->count; i++) {
            volume_field_free(&field->volume[i]);
        }
        for (int i = 0; field->named && i < field->count; i++) {
            nuclei_free(&field->named[i]);
        }
        nuclei_free(&field->nuclei);
        free(field->params);
        free(field->grid);
        free(field->named);
        free(field->curvature);
        free(field->volume);
        free(field);
    }
}

static Vec3 tangential(Vec3 x, Vec3 n)
{
    return vec3_normalize(vec3_madd(x, -vec3_dot(x, n), n));
}

static Vec3 one_field_at(const GuideField *field, int i, Vec3 p, Vec3 n)
{
    const FieldParams *params = &field->params[i];
    Vec3 from_center = vec3_sub(p, params->center);
    switch (params->kind) {
    case FIELD_UNIFORM:
        return vec3_normalize(params->vector);
    case FIELD_RADIAL:
        return vec3_normalize(from_center);
    case FIELD_VORTEX:
        return vec3_normalize(vec3_cross(params->vector, from_center));
    case FIELD_NUCLEI:
        return nuclei_at(nuclei_of(field, i), params, p, n);
    case FIELD_GRID: {
        Vec3 x = field_grid_at(&field->grid[i], p);
        return params->surface ? tangential(x, n) : vec3_normalize(x);
    }
    case FIELD_CURVATURE:
        return curvature_field_at(&field->curvature[i], p, params->vector);
    case FIELD_VOLUME:
        return volume_field_at(&field->volume[i], p);
    case FIELD_CURL:
        return vec3_normalize(curl_noise(vec3_scale(p, 1.0f / params->scale), params->seed));
    case FIELD_POINT: {
        float falloff = 1.0f - smoothstepf(0.0f, params->scale, vec3_length(from_center));
        return vec3_scale(vec3_normalize(params->vector), falloff);
    }
    }
    return vec3(0, 0, 0);
}

Vec3 guide_field_at(const GuideField *field, Vec3 p, Vec3 n)
{
    Vec3 sum = vec3(0, 0, 0);
    for (int i = 0; i < field->count; i++) {
        sum = vec3_madd(sum, field->params[i].weight, one_field_at(field, i, p, n));
    }
    return sum;
}
