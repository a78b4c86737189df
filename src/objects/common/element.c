#include "objects/common/element.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

static Vec3 anchor_of(const OutTree *tree)
{
    return tree->count > 0 ? tree->position[0] : vec3(0, 0, 0);
}

ColonizeParams element_colonize_params(const OutTree *tree, const ElementParams *element,
                                       const GuideField *field, uint64_t seed)
{
    ColonizeParams params = element->growth;
    params.noise_in_space = element->points.anchored;
    params.anchor = anchor_of(tree);
    params.field = field;
    params.on_surface = element->points.place == SCATTER_SURFACE;
    params.sector_angle = params.sector_angle > 0.0f ? params.sector_angle : 60.0f;
    params.seed = seed;
    for (int64_t i = 0; i < tree->count; i++) { // new nodes are younger than existing ones
        params.first_step = tree->birth[i] > params.first_step ? tree->birth[i] : params.first_step;
    }
    return params;
}

ScatterParams element_scatter_params(const OutTree *tree, const ElementParams *element,
                                     uint64_t seed)
{
    ScatterParams params = element->points;
    params.scale = 1.0f;
    params.anchor = anchor_of(tree);
    params.seed = seed;
    return params;
}

bool growth_observe(const Recipe *recipe, const char *part, const Envelope *envelope,
                    const GuideField *field, Error *e)
{
    const GrowthObserver *observer = recipe->run->observer;
    return !observer || observer->see(observer->user, part, envelope, field, e);
}

int64_t element_attractors(const ElementParams *element)
{
    int64_t sum = 0;
    for (int i = 0; i < element->level_count; i++) {
        sum += element->levels[i].attractors;
    }
    return sum;
}

// Centre of the sphere for polar angles: the middle of the envelope's first shape if it has one,
// otherwise of the envelope's bounding box.
static Vec3 sphere_center(const ElementParams *element, Aabb bounds)
{
    const Shape *first = element->shape_count > 0 ? &element->shapes[0] : NULL;
    if (first && (first->kind == SHAPE_SPHERE || first->kind == SHAPE_ELLIPSOID ||
                  first->kind == SHAPE_BOX)) {
        return transform_point(&first->transform, vec3(0, 0, 0));
    }
    return vec3_lerp(bounds.low, bounds.high, 0.5f);
}

// The normals of start points turn the field, as in the papers. Those of branches point to any
// side; about them it is turned about +Y (NULL).
static const Vec3 *nucleus_normals(const OutTree *tree, int64_t nuclei)
{
    for (int64_t i = 0; i < nuclei; i++) {
        if (tree->parent[i] >= 0) {
            return NULL;
        }
    }
    return tree->normal;
}

// The guide field with the tree's first nodes as nuclei (Tanaka eq. (9); Tanaka report 3.7.3).
static GuideField *element_field(const OutTree *tree, int64_t nuclei, const ElementParams *element,
                                 const Envelope *envelope, uint64_t seed, const Run *run, Error *e)
{
    FieldParams *fields = memory_alloc(element->field_count, sizeof *fields, e);
    Aabb bounds = envelope_bounds(envelope);
    if (!fields) {
        return NULL;
    }
    for (int i = 0; i < element->field_count; i++) {
        fields[i] = element->fields[i];
        fields[i].seed = random_key(seed, (uint64_t)i);
        fields[i].pull = field_params_pull(&fields[i], element->growth.field_weight);
        if (fields[i].spherical) {
            fields[i].center = sphere_center(element, bounds);
        }
    }
    FieldSite site = {.nuclei = tree->position,
                      .normals = nucleus_normals(tree, nuclei),
                      .nucleus_count = nuclei,
                      .bounds = bounds,
                      .envelope = envelope};
    GuideField *field = guide_field_new(fields, element->field_count, &site, run, e);
    if (!field) {
        error_key(e, "fields");
    }
    free(fields);
    return field;
}

static void warn_out_of_reach(const GrowReport *reports, const ElementParams *element,
                              const ColonizeParams *params, const Recipe *recipe, const char *part)
{
    for (int i = 0; i < element->level_count; i++) {
        if (reports[i].stop == STOP_OUT_OF_REACH) {
            char text[256], name[RECIPE_NAME_SIZE];
            grow_report_format(&reports[i], params, text, sizeof text);
            run_warn(recipe->run, "%s, level %d: %s", recipe_name(recipe, part, name), i + 1, text);
        }
    }
}

// Warns if at least a tenth of the last level's attractors were never reached, and names the level
// with the longest reach as the one to change.
static void warn_ends_short(const GrowReport *reports, const ElementParams *element,
                            const Recipe *recipe, const char *part)
{
    int last = element->level_count - 1, far = 0;
    if (last < 0 || reports[last].stop != STOP_NO_PULL || reports[last].unreached == 0 ||
        10 * reports[last].unreached < element->levels[last].attractors) {
        return;
    }
    for (int i = 1; i <= last; i++) {
        far = reports[i].influence > reports[far].influence ? i : far;
    }
    far = reports[far].influence > reports[last].nearest ? last : far;
    float multiple = element->levels[far].influence;
    float wanted = multiple * reports[last].nearest / reports[far].influence;
    char name[RECIPE_NAME_SIZE];
    run_warn(
        recipe->run,
        "%s ends up to %.3g m short of its envelope: %lld of %lld attractors are out of reach, "
        "the nearest %.3g m from all nodes; give level %d an influence above %.3g (it has "
        "%.3g) or more attractors",
        recipe_name(recipe, part, name), (double)reports[last].furthest,
        (long long)reports[last].unreached, (long long)element->levels[last].attractors,
        (double)reports[last].nearest, far + 1, (double)wanted, (double)multiple);
}

bool element_guide_field(const OutTree *tree, int64_t nuclei, const ElementParams *element,
                         const Envelope *envelope, uint64_t seed, const Run *run,
                         GuideField **field, Error *e)
{
    *field = NULL;
    if (element->field_count > 0) {
        *field = element_field(tree, nuclei, element, envelope, seed, run, e);
        return *field;
    }
    return true;
}

bool element_density(const ElementParams *element, ScatterParams *scatter, Density **density,
                     const Run *run, Error *e)
{
    *density = NULL;
    if (!element->density) {
        return true;
    }
    *density = density_new(element->density, run, e);
    scatter->density = density_at;
    scatter->density_user = *density;
    if (!*density) {
        error_key(e, "points.density");
    }
    return *density;
}

bool element_grow_in(OutTree *tree, int64_t nuclei, const ElementParams *element,
                     const Envelope *envelope, uint64_t seed, const Recipe *recipe,
                     const char *part, Error *e)
{
    const Run *run = recipe->run;
    GuideField *field;
    if (!element_guide_field(tree, nuclei, element, envelope,
                             random_key(seed, STREAM_ELEMENT_FIELD), run, &field, e)) {
        return false;
    }
    ScatterParams scatter =
        element_scatter_params(tree, element, random_key(seed, STREAM_ELEMENT_POINTS));
    ColonizeParams params =
        element_colonize_params(tree, element, field, random_key(seed, STREAM_ELEMENT_GROWTH));
    params.room = recipe->room;
    Density *density = NULL;
    GrowReport *reports = memory_alloc_zero(element->level_count, sizeof *reports, e);
    bool done = reports && element_density(element, &scatter, &density, run, e) &&
                growth_observe(recipe, part, envelope, field, e) &&
                colonize_levels(tree, envelope, &scatter, element->levels, element->level_count,
                                &params, run, reports, e);
    if (done) {
        warn_out_of_reach(reports, element, &params, recipe, part);
        warn_ends_short(reports, element, recipe, part);
    }
    free(reports);
    density_free(density);
    guide_field_free(field);
    return done;
}

Envelope *element_envelope(const ElementParams *element, const Run *run, Error *e)
{
    EnvelopeParams params = {
        .shapes = element->shapes, .shape_count = element->shape_count, .voxel = element->voxel};
    return envelope_new(&params, run, e);
}

bool element_grow(OutTree *tree, const ElementParams *element, uint64_t seed, const Recipe *recipe,
                  const char *part, Error *e)
{
    Envelope *envelope = element_envelope(element, recipe->run, e);
    bool done =
        envelope && element_grow_in(tree, tree->count, element, envelope, seed, recipe, part, e);
    envelope_free(envelope);
    return done || recipe_fail(recipe, part, e);
}
