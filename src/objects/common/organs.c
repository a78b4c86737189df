#include "objects/common/organs.h"

#include "objects/common/phenology.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/common/leaf_batch.h"

#include <stdlib.h>
#include <string.h>

enum { STREAM_GROUPS = 10, STREAM_MESHES = 1, STREAM_TWIGS = 2 }; // of the seed; of a group
// Of a twig; SITES + i: site i.
enum { STREAM_OFFSET = 1, STREAM_REFERENCE = 2, STREAM_SITES = 100 };
// Of a site.
enum {
    STREAM_SHARE = 1,
    STREAM_VARIANT = 2,
    STREAM_VARIATION = 3,
    STREAM_ANGLE = 4,
    STREAM_ROLL = 5,
    STREAM_SIZE = 6,
    STREAM_TURN = 7
};

// Of an organ: here, once for each tissue, and at least in the ray tracer.
#define ORGAN_BYTES (3.0 * (sizeof(Transform) + 2 * sizeof(float)) + 100.0)

// What coarse forms leave out.
#define SCALE_DEPTH 0.3f  // of a scaly organ's width
#define PETAL_SHAPE 0.15f // of a petal's length

typedef struct Organs {
    const OrganGroup *group;
    const CurveSet *curves;
    const bool *bare; // per curve; NULL = none
    float lowest;     // m: none below
    float share;      // the group's, less if there are too many
    uint64_t seed;
    const LeafLight *light;
    LeafBatch *batch; // group->variants of them; NULL = they are only counted
    int64_t count;
} Organs;

// A place on a branch.
typedef struct Site {
    Vec3 position, along, out; // m; unit
    float radius;              // m, of the branch
    uint64_t key;
} Site;

static Transform frame_of(const OrganGroup *group, const Site *site)
{
    float angle = group->where == SITES_ENDS ? 0.15f * group->angle : group->angle, sine, cosine;
    angle *= random_range(random_key(site->key, STREAM_ANGLE), 0.75f, 1.25f);
    exact_sincos(angle * RADIANS_PER_DEGREE, &sine, &cosine);
    Vec3 y = vec3_madd(vec3_scale(site->along, cosine), sine, site->out);
    Vec3 down = vec3_madd(vec3(0, -1, 0), 0.12f, y);
    y = vec3_normalize(vec3_lerp(y, down, group->hang));
    Vec3 x = vec3_cross(y, random_direction(random_key(site->key, STREAM_ROLL)));
    if (group->arch > 0.0f || group->nod > 0.0f) { // they bend down, upright ones to any side
        x = vec3_madd(vec3(0, -1, 0), 0.15f, x);
        x = vec3_madd(x, -vec3_dot(x, y), y);
    }
    x = vec3_dot(x, x) > 1e-6f ? vec3_normalize(x) : vec3_perpendicular(y);
    float size = 1.0f - group->size_variation * random_unit(random_key(site->key, STREAM_SIZE));
    static const float inside_of[] = {
        [SITES_ENDS] = 0.0f, [SITES_ALONG] = 0.85f, [SITES_STEM] = 0.96f};
    float inside = inside_of[group->where] * site->radius;
    return transform_from_axes(vec3_scale(x, size), vec3_scale(y, size),
                               vec3_scale(vec3_cross(x, y), size),
                               vec3_madd(site->position, inside, site->out));
}

static bool add_site(Organs *organs, const Site *site, Error *e)
{
    const OrganGroup *group = organs->group;
    if (site->position.y < organs->lowest ||
        random_unit(random_key(site->key, STREAM_SHARE)) >= organs->share) {
        return true;
    }
    organs->count++;
    if (!organs->batch) {
        return true;
    }
    float pick = random_unit(random_key(site->key, STREAM_VARIANT));
    return leaf_batch_add(&organs->batch[(int)(pick * (float)group->variants)],
                          frame_of(group, site),
                          random_unit(random_key(site->key, STREAM_VARIATION)), 0.0f, e);
}

// On a surface, organs keep to its outer side and as far from it as they are wide.
static void hold_off(const Organs *organs, Site *site)
{
    const OrganGroup *group = organs->group;
    Vec3 away = organs->light->facing(organs->light->user, site->position);
    site->out = vec3_normalize(vec3_madd(site->out, 1.2f, away));
    float reach = group->hang * (group->stalk + 0.5f * group->width);
    site->position = vec3_madd(site->position, reach, away);
}

// The sites of one place along a branch: one, or a row's each.
static bool add_place(Organs *organs, Site *site, Vec3 reference, int64_t number, uint64_t twig_key,
                      Error *e)
{
    const OrganGroup *group = organs->group;
    int rows = group->where == SITES_STEM ? group->rows : 1;
    for (int r = 0; r < rows; r++) {
        uint64_t place = (uint64_t)number * (uint64_t)rows + (uint64_t)r;
        site->key = random_key(twig_key, STREAM_SITES + place);
        float turn = group->where == SITES_STEM
                         ? 360.0f * (float)r / (float)rows
                         : (float)number * 137.507764f +
                               random_range(random_key(site->key, STREAM_TURN), -15.0f, 15.0f);
        float sine, cosine;
        exact_sincos(turn * RADIANS_PER_DEGREE, &sine, &cosine);
        Site one = *site;
        one.out = vec3_rotate(reference, site->along, cosine, sine);
        if (organs->light->facing) {
            hold_off(organs, &one);
        }
        if (!add_site(organs, &one, e)) {
            return false;
        }
    }
    return true;
}

// Unit direction of a curve's last piece.
static Vec3 curve_end(const CurveSet *curves, int64_t curve)
{
    int64_t last = curves->first[curve + 1] - 1, first = curves->first[curve];
    return last > first
               ? vec3_normalize(vec3_sub(curves->position[last], curves->position[last - 1]))
               : vec3(0, 1, 0);
}

// Walks a branch from its tip toward its start while it is thin enough.
static bool add_twig(Organs *organs, int64_t curve, Error *e)
{
    const OrganGroup *group = organs->group;
    const CurveSet *curves = organs->curves;
    uint64_t key = random_key(random_key(organs->seed, STREAM_TWIGS), curves->id[curve]);
    int64_t first = curves->first[curve], last = curves->first[curve + 1] - 1, number = 0;
    bool ends = group->where == SITES_ENDS;
    float until = ends ? 0.0f : group->spacing * random_unit(random_key(key, STREAM_OFFSET));
    Vec3 reference = group->where == SITES_STEM // lines start where the skin's ribs do
                         ? vec3_perpendicular(curve_end(curves, curve))
                         : random_direction(random_key(key, STREAM_REFERENCE));
    for (int64_t i = last; i > first && curves->radius[i] < group->twig_radius; i--) {
        Vec3 a = curves->position[i], b = curves->position[i - 1];
        float length = vec3_distance(a, b);
        Vec3 along = vec3_normalize(vec3_sub(a, b));
        reference = vec3_madd(reference, -vec3_dot(reference, along), along);
        reference = vec3_dot(reference, reference) > 1e-6f ? vec3_normalize(reference)
                                                           : vec3_perpendicular(along);
        while (until < length) {
            float t = until / length;
            Site site = {.position = vec3_lerp(a, b, t),
                         .along = along,
                         .radius = lerpf(curves->radius[i], curves->radius[i - 1], t)};
            if (!add_place(organs, &site, reference, number++, key, e)) {
                return false;
            }
            if (ends) {
                return true;
            }
            until += group->spacing;
        }
        until -= length;
    }
    return true;
}

static bool add_twigs(Organs *organs, const Run *run, Error *e)
{
    bool done = true;
    for (int64_t i = 0; done && i < organs->curves->curve_count; i++) {
        done =
            run_goes_on(run, i, e) && ((organs->bare && organs->bare[i]) || add_twig(organs, i, e));
    }
    return done;
}

// m: the lower end of the part of the crown that bears them.
static float lowest_of(const OrganGroup *group, const CurveSet *curves, const bool *bare)
{
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < curves->curve_count; i++) {
        if (!bare || !bare[i]) {
            box = aabb_add(box, curves->position[curves->first[i + 1] - 1]);
        }
    }
    return group->above > 0.0f && !aabb_is_empty(box) ? lerpf(box.low.y, box.high.y, group->above)
                                                      : -INFINITY;
}

static bool is_scaly(OrganKind kind)
{
    return kind == ORGAN_CONE || kind == ORGAN_CATKIN;
}

// Simpler forms for organs of a few pixels, where there are some; else NULL. The caller frees each.
static bool coarse_meshes(const OrganParams *form, uint64_t key, Mesh *mesh[TISSUES], Error *e)
{
    bool some = is_scaly(form->kind) || form->kind == ORGAN_BLOSSOM || form->kind == ORGAN_BELL ||
                form->kind == ORGAN_WATER_LILY;
    OrganParams plain = *form;
    plain.detail = 0;
    return !some || organ_meshes(&plain, key, mesh, e);
}

// Adds a part for each tissue of a variant; the instances are copied for all but the last.
static bool add_variant(const OrganGroup *group, int variant, LeafBatch *batch,
                        const OrgansParams *params, uint64_t seed, const Placing *placing, Error *e)
{
    OrganParams form = {.kind = group->kind,
                        .length = group->length,
                        .width = group->width,
                        .stalk = group->stalk,
                        .cluster = group->cluster,
                        .per_cluster = group->per_cluster,
                        .axis = group->axis,
                        .taper = group->taper,
                        .arch = group->arch,
                        .one_sided = group->one_sided,
                        .nod = group->nod,
                        .bracts = group->bracts,
                        .bract_length = group->bract_length,
                        .spread = group->spread,
                        .open = group->open,
                        .petals = group->petals,
                        .buds = group->buds,
                        .spur = group->spur,
                        .dimple = group->dimple,
                        .detail = group->detail};
    uint64_t key = random_key(random_key(seed, STREAM_MESHES), (uint64_t)variant);
    Mesh *mesh[TISSUES], *coarse[TISSUES] = {NULL};
    float left_out = is_scaly(form.kind) ? SCALE_DEPTH * form.width : PETAL_SHAPE * form.length;
    bool done = organ_meshes(&form, key, mesh, e) && coarse_meshes(&form, key, coarse, e);
    for (int t = 0; done && t < TISSUES; t++) {
        if (!mesh[t]) {
            continue;
        }
        Part part = {.mesh = mesh[t], .instance_count = batch->count};
        part.coarse[0] = (CoarseMesh){.mesh = coarse[t], .error = left_out};
        mesh[t] = coarse[t] = NULL;
        part.instance = memory_alloc(batch->count, sizeof *part.instance, e);
        part.variation = memory_alloc(batch->count, sizeof *part.variation, e);
        if (!part.instance || !part.variation) {
            part_free_meshes(&part);
            free(part.instance);
            free(part.variation);
            done = false;
            break;
        }
        memcpy(part.instance, batch->instance, (size_t)batch->count * sizeof *part.instance);
        memcpy(part.variation, batch->variation, (size_t)batch->count * sizeof *part.variation);
        done = placing_add(placing, part, params->role[t], e);
    }
    for (int t = 0; t < TISSUES; t++) {
        mesh_free(mesh[t]);
        mesh_free(coarse[t]);
    }
    return done;
}

// Organs where they were counted, fewer if there are more than max_count.
static bool place_group(Organs *organs, const OrgansParams *params, const Placing *placing,
                        Error *e)
{
    const OrganGroup *group = organs->group;
    if (!add_twigs(organs, placing->recipe->run, e)) {
        return false;
    }
    if (organs->count > group->max_count) {
        organs->share *= (float)((double)group->max_count / (double)organs->count);
    }
    double most = fmin((double)organs->count, (double)group->max_count);
    if (!memory_check(most * ORGAN_BYTES, e,
                      "%.0f organs (fewer by organs.max_count or a smaller organs.share)", most)) {
        return false;
    }
    organs->batch = memory_alloc_zero(group->variants, sizeof *organs->batch, e);
    bool done = organs->batch && add_twigs(organs, placing->recipe->run, e);
    for (int v = 0; done && v < group->variants; v++) {
        done = organs->batch[v].count == 0 ||
               add_variant(group, v, &organs->batch[v], params, organs->seed, placing, e);
    }
    for (int v = 0; organs->batch && v < group->variants; v++) {
        leaf_batch_clear(&organs->batch[v]);
    }
    free(organs->batch);
    return done;
}

static bool add_group(const OutTree *tree, const OrgansParams *params, int index,
                      const Placing *placing, Error *e)
{
    const OrganGroup *group = &params->group[index];
    SkinParams skin = branches_skin(params->skin);
    skin.blunt = group->where == SITES_STEM; // lines lie on the bark
    CurveSet *curves = skin_curves(tree, fmaxf(group->twig_radius, skin.min_radius), &skin, e);
    bool some = params->bare_from >= 0;
    bool *bare = some && curves ? branches_bare(tree, curves, params->bare_from, e) : NULL;
    bool done = curves && (bare || !some);
    if (done) {
        Organs organs = {.group = group,
                         .curves = curves,
                         .bare = bare,
                         .light = &params->light,
                         .lowest = lowest_of(group, curves, bare),
                         .share = group->share,
                         .seed = random_key(params->seed, STREAM_GROUPS + (uint64_t)index)};
        done = place_group(&organs, params, placing, e);
    }
    free(bare);
    curves_free(curves);
    return done;
}

bool organs_add(const OutTree *tree, const OrgansParams *params, const Placing *placing, Error *e)
{
    bool done = true;
    for (int i = 0; done && i < params->count; i++) {
        const OrganGroup *group = &params->group[i];
        bool there = group->max_count > 0 && phenology_is_within(group->season, params->time);
        done = !there || add_group(tree, params, i, placing, e);
    }
    return done;
}
