#include "field/guide_field.h"

#include "base/memory.h"
#include "field/curl.h"
#include "field/curvature_field.h"
#include "field/field_grid.h"
#include "field/nuclei.h"
#include "field/volume_field.h"

#include <stdlib.h>

enum { DEFAULT_RESOLUTION = 48 };

typedef struct OneField {
    FieldParams params;
    Nuclei named;             // empty if it names none
    FieldGrid grid;           // FIELD_GRID
    CurvatureField curvature; // FIELD_CURVATURE
    VolumeField volume;       // FIELD_VOLUME
} OneField;

struct GuideField {
    OneField *field; // count of them
    int count;
    Nuclei nuclei; // the initial nodes
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

static bool check_params(const FieldParams *p, const FieldSite *site, Error *e)
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
    if (p->kind == FIELD_CURVATURE && !site->envelope) {
        return error_set(e, ERROR_INPUT,
                         "a curvature field needs an envelope with a surface; use another kind");
    }
    if (has_nuclei(p->kind) && p->nucleus_count < 1 && site->nucleus_count < 1) {
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

static const Nuclei *nuclei_of(const GuideField *field, const OneField *one)
{
    return one->params.nucleus_count > 0 ? &one->named : &field->nuclei;
}

static bool make_grid(const GuideField *field, OneField *one, const Run *run, Error *e)
{
    GridSource source = {.nuclei = nuclei_of(field, one), .params = one->params};
    source.params.surface = false; // no surface passes through a voxel's corner
    int resolution = source.params.resolution;
    return field_grid_init(&one->grid, sample_nuclei, &source, field->nuclei.bounds,
                           resolution == 0 ? DEFAULT_RESOLUTION : resolution, run, e);
}

static bool init_one(const GuideField *field, OneField *one, const FieldSite *site, const Run *run,
                     Error *e)
{
    const FieldParams *params = &one->params;
    if (!check_params(params, site, e)) {
        return false;
    }
    if (has_nuclei(params->kind) && params->nucleus_count > 0 &&
        !nuclei_init_named(&one->named, params->nucleus, params->nucleus_count, site->bounds, run,
                           e)) {
        return error_key(e, "nuclei");
    }
    switch (params->kind) {
    case FIELD_GRID:
        return make_grid(field, one, run, e);
    case FIELD_CURVATURE:
        return curvature_field_init(&one->curvature, envelope_surface(site->envelope),
                                    params->least, e);
    case FIELD_VOLUME:
        return volume_field_init(&one->volume, params, run, e);
    default:
        return true;
    }
}

static bool init_all(GuideField *field, const FieldParams *params, int count, const FieldSite *site,
                     const Run *run, Error *e)
{
    field->field = memory_alloc_zero(count, sizeof *field->field, e);
    if (!field->field || !nuclei_init(&field->nuclei, site->nuclei, site->normals,
                                      site->nucleus_count, site->bounds, e)) {
        return false;
    }
    field->count = count;
    for (int i = 0; i < count; i++) {
        field->field[i].params = params[i];
        if (!init_one(field, &field->field[i], site, run, e)) {
            return error_key(e, "%d", i);
        }
    }
    return true;
}

GuideField *guide_field_new(const FieldParams *params, int count, const FieldSite *site,
                            const Run *run, Error *e)
{
    GuideField *field = memory_alloc_zero(1, sizeof *field, e);
    if (field && !init_all(field, params, count, site, run, e)) {
        guide_field_free(field);
        return NULL;
    }
    return field;
}

void guide_field_free(GuideField *field)
{
    if (!field) {
        return;
    }
    for (int i = 0; i < field->count; i++) {
        nuclei_free(&field->field[i].named);
        field_grid_free(&field->field[i].grid);
        curvature_field_free(&field->field[i].curvature);
        volume_field_free(&field->field[i].volume);
    }
    nuclei_free(&field->nuclei);
    free(field->field);
    free(field);
}

static Vec3 tangential(Vec3 x, Vec3 n)
{
    return vec3_normalize(vec3_madd(x, -vec3_dot(x, n), n));
}

static Vec3 one_field_at(const GuideField *field, const OneField *one, Vec3 p, Vec3 n)
{
    const FieldParams *params = &one->params;
    Vec3 from_center = vec3_sub(p, params->center);
    switch (params->kind) {
    case FIELD_UNIFORM:
        return vec3_normalize(params->vector);
    case FIELD_RADIAL:
        return vec3_normalize(from_center);
    case FIELD_VORTEX:
        return vec3_normalize(vec3_cross(params->vector, from_center));
    case FIELD_NUCLEI:
        return nuclei_at(nuclei_of(field, one), params, p, n);
    case FIELD_GRID: {
        Vec3 x = field_grid_at(&one->grid, p);
        return params->surface ? tangential(x, n) : vec3_normalize(x);
    }
    case FIELD_CURVATURE:
        return curvature_field_at(&one->curvature, p, params->vector);
    case FIELD_VOLUME:
        return volume_field_at(&one->volume, p);
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
        const OneField *one = &field->field[i];
        sum = vec3_madd(sum, one->params.weight, one_field_at(field, one, p, n));
    }
    return sum;
}
