#include "objects/common/instanced.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/common/near_copies.h"
#include "objects/common/thinning.h"
#include "shape/mesh_close.h"

#include <stdlib.h>

enum { STREAM_KEPT = 1, STREAM_TONE = 2, STREAM_PLACE_TONE = 3, STREAM_PLACE_SEASON = 4 };

enum { SEASONS = 4, TONES = 2, GROUPS = SEASONS * TONES };
#define PLACE_TONE 0.25f   // how far copies differ in colour variation, 0..1
#define PLACE_SEASON 0.15f // and in the state of their autumn

// A coarse form that is off by more than this angle (radians, about a pixel of a still) shows.
#define NEAR_ANGLE 4e-4f
enum { MOST_NEAR_LEAVES = 300000 }; // of all near copies of a model

// Leaves of one season and tone.
typedef struct Bin {
    Part part; // borrows the mesh
    float season;
    float tone;
} Bin;

static bool is_foliage(const Part *part)
{
    return part->instance_count > 0;
}

static int64_t count_leaves(const Geometry *model)
{
    int64_t count = 0;
    for (int64_t i = 0; i < model->count; i++) {
        count += is_foliage(&model->part[i]) ? model->part[i].instance_count : 0;
    }
    return count;
}

static void scale_linear(Transform *t, float factor)
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            t->m[row][column] *= factor;
        }
    }
}

// Keeps a share of the instances and enlarges them to the area of all.
static void thin_out(Part *part, float share, uint64_t seed)
{
    int64_t kept = 0;
    float factor = 1.0f / sqrtf(share);
    for (int64_t i = 0; i < part->instance_count; i++) {
        if (random_unit(random_key(random_key(seed, STREAM_KEPT), (uint64_t)i)) >= share) {
            continue;
        }
        part->instance[kept] = part->instance[i];
        scale_linear(&part->instance[kept], factor);
        if (part->season) {
            part->season[kept] = part->season[i];
        }
        kept++;
    }
    part->instance_count = kept;
}

// The finest form of the part's mesh with at most so many faces, or the coarsest: 0 = the mesh
// itself, k = its coarse form k - 1.
static int level_of(const Part *part, int64_t most_faces)
{
    int level = 0;
    int64_t faces = part->mesh->face_count;
    for (int i = 0; i < PART_COARSE_MOST && faces > most_faces && part->coarse[i].mesh; i++) {
        level = i + 1;
        faces = part->coarse[i].mesh->face_count;
    }
    return level;
}

static Mesh *form_of(const Part *part, int64_t most_faces)
{
    int level = level_of(part, most_faces);
    return level > 0 ? part->coarse[level - 1].mesh : part->mesh;
}

static int bin_of(const Part *part, int64_t i, uint64_t seed)
{
    float season = part->season ? clampf(part->season[i], -1.0f, 1.0f) : 0.0f;
    int state = season < -0.05f ? 0 : (season < 0.05f ? 1 : (season < 0.6f ? 2 : 3));
    return state * TONES +
           (random_unit(random_key(random_key(seed, STREAM_TONE), (uint64_t)i)) < 0.5f ? 0 : 1);
}

// Sorts the part's instances into bins, which share one list of transforms.
static void fill_bins(const Part *part, uint64_t seed, Transform *sorted, Bin bin[GROUPS])
{
    int64_t next = 0;
    for (int b = 0; b < GROUPS; b++) {
        double season = 0.0;
        bin[b] = (Bin){.part = *part, .tone = (float)(b % TONES) + 0.5f};
        bin[b].tone /= (float)TONES;
        bin[b].part.instance = sorted + next;
        bin[b].part.instance_count = 0;
        for (int64_t i = 0; i < part->instance_count; i++) {
            if (bin_of(part, i, seed) == b) {
                bin[b].part.instance[bin[b].part.instance_count++] = part->instance[i];
                season += part->season ? (double)part->season[i] : 0.0;
                next++;
            }
        }
        int64_t count = bin[b].part.instance_count;
        bin[b].season = count > 0 ? (float)(season / (double)count) : 0.0f;
    }
}

// Adds a mesh or curves at every place; takes them over, also on failure.
static bool add_at_places(Part part, float season, float tone, const Instanced *how,
                          const Placing *placing, Error *e)
{
    part.object = placing->object;
    part.instance = memory_alloc(how->count, sizeof *part.instance, e);
    part.variation = part.instance ? memory_alloc(how->count, sizeof *part.variation, e) : NULL;
    part.season = part.variation ? memory_alloc(how->count, sizeof *part.season, e) : NULL;
    for (int64_t i = 0; part.season && i < how->count; i++) {
        uint64_t key = random_key(how->seed, (uint64_t)i);
        float aside = random_range(random_key(key, STREAM_PLACE_TONE), -PLACE_TONE, PLACE_TONE);
        float ahead =
            random_range(random_key(key, STREAM_PLACE_SEASON), -PLACE_SEASON, PLACE_SEASON);
        part.instance[i] = how->place[i];
        part.variation[i] = clampf(tone + aside, 0.0f, 1.0f);
        part.season[i] = season > 0.05f ? clampf(season + ahead, 0.0f, 1.0f) : season;
        part.instance_count = i + 1;
    }
    if (!part.season) {
        part.instance_count = 0;
        mesh_free(part.mesh);
        curves_free(part.curves);
        free(part.instance);
        free(part.variation);
        return false;
    }
    return geometry_add(placing->geometry, part, e);
}

static bool add_foliage(Part *part, int64_t faces_each, const Instanced *how,
                        const Placing *placing, Error *e)
{
    Bin bin[GROUPS];
    Transform *sorted = memory_alloc(part->instance_count, sizeof *sorted, e);
    bool done = sorted;
    if (sorted) {
        fill_bins(part, how->seed, sorted, bin);
    }
    for (int b = 0; done && b < GROUPS; b++) {
        Part *leaves = &bin[b].part;
        leaves->mesh = form_of(part, faces_each);
        if (leaves->instance_count > 0) {
            Part baked = {.material = part->material,
                          .mesh = geometry_bake(leaves, placing->recipe->run, e)};
            done = baked.mesh && add_at_places(baked, bin[b].season, bin[b].tone, how, placing, e);
        }
    }
    free(sorted);
    return done;
}

static bool add_wood(Part *part, const Instanced *how, const Placing *placing, Error *e)
{
    Part wood = {
        .kind = part->kind, .material = part->material, .mesh = part->mesh, .curves = part->curves};
    part->mesh = NULL;
    part->curves = NULL;
    return add_at_places(wood, 0.0f, 0.5f, how, placing, e);
}

// m2: the area of all leaves of the part in this form.
static double area_of(const Part *part, const Mesh *form)
{
    double squares = 0.0; // of the instances' scales
    for (int64_t i = 0; i < part->instance_count; i++) {
        const Transform *t = &part->instance[i];
        for (int row = 0; row < 3; row++) {
            for (int column = 0; column < 3; column++) {
                squares += (double)(t->m[row][column] * t->m[row][column]) / 3.0;
            }
        }
    }
    return squares * mesh_area(form);
}

// The share of each part's leaves that is baked; the caller frees it.
static double *shares_of(const Geometry *model, int64_t faces_each, const Instanced *how, Error *e)
{
    double *share = memory_alloc(model->count + 1, sizeof *share, e);
    ThinnedLeaves *kind = share ? memory_alloc(model->count + 1, sizeof *kind, e) : NULL;
    if (!kind) {
        free(share);
        return NULL;
    }
    int kinds = 0;
    for (int64_t i = 0; i < model->count; i++) {
        const Part *part = &model->part[i];
        if (is_foliage(part)) {
            const Mesh *form = form_of(part, faces_each);
            kind[kinds++] = (ThinnedLeaves){.count = part->instance_count,
                                            .area = area_of(part, form),
                                            .faces = (double)form->face_count};
        }
    }
    thinning_shares(kind, kinds, (double)how->most_leaves, (double)how->most_faces);
    kinds = 0;
    for (int64_t i = 0; i < model->count; i++) {
        share[i] = is_foliage(&model->part[i]) ? kind[kinds++].share : 1.0;
    }
    free(kind);
    return share;
}

// Distance (m) within which the forms of the leaves would show.
static float showing_within(const Geometry *model, int64_t faces_each)
{
    float reach = 0.0f;
    for (int64_t i = 0; i < model->count; i++) {
        const Part *part = &model->part[i];
        int level = is_foliage(part) ? level_of(part, faces_each) : 0;
        if (level > 0) {
            reach = fmaxf(reach, part->coarse[level - 1].error / NEAR_ANGLE);
        }
    }
    return reach;
}

// Adds foliage: baked at the far places, and at the near ones as instances, which take the part's
// meshes over. share: of the leaves that are baked.
static bool add_leaves(Part *part, int64_t faces_each, float share, const NearCopies *copies,
                       const Instanced *how, uint64_t seed, const Placing *placing, Error *e)
{
    Part near = {0};
    bool some_near = copies->near > 0 && level_of(part, faces_each) > 0;
    bool done = !some_near || near_copies_leaves(copies, part, &near, placing->recipe->run, e);
    Instanced far = *how;
    if (some_near) {
        far.place = copies->place + copies->near;
        far.count = copies->count - copies->near;
    } else {
        far.place = copies->place;
    }
    if (done && share < 1.0f) {
        thin_out(part, share, seed);
    }
    if (done && far.count > 0 && part->instance_count > 0) {
        done = add_foliage(part, faces_each, &far, placing, e);
    }
    if (!near.instance) {
        return done;
    }
    near.object = placing->object;
    near.mesh = part->mesh;
    part->mesh = NULL;
    for (int k = 0; k < PART_COARSE_MOST; k++) {
        near.coarse[k] = part->coarse[k];
        part->coarse[k].mesh = NULL;
    }
    return geometry_add(placing->geometry, near, e) && done;
}

// Adds the parts at the places, which are sorted.
static bool add_sorted(Geometry *model, int64_t faces_each, const double *share,
                       const NearCopies *copies, const Instanced *how, const Placing *placing,
                       Error *e)
{
    Instanced all = *how;
    all.place = copies->place;
    bool done = true;
    for (int64_t i = 0; done && i < model->count; i++) {
        Part *part = &model->part[i];
        done = is_foliage(part) ? add_leaves(part, faces_each, (float)share[i], copies, how,
                                             random_key(how->seed, (uint64_t)i), placing, e)
                                : add_wood(part, &all, placing, e);
    }
    return done;
}

bool instanced_add(Geometry *model, const Instanced *how, const Placing *placing, Error *e)
{
    if (how->count == 0) {
        return true;
    }
    int64_t leaves = count_leaves(model);
    int64_t left = leaves < how->most_leaves ? leaves : how->most_leaves;
    int64_t faces_each = how->distant || left == 0 ? 1 : how->most_faces / left;
    double *share = shares_of(model, faces_each, how, e);
    if (!share) {
        return false;
    }
    NearCopies copies;
    bool done = near_copies_init(&copies, how->place, how->count, how->eye,
                                 showing_within(model, faces_each),
                                 leaves > 0 ? MOST_NEAR_LEAVES / leaves : 0, e) &&
                add_sorted(model, faces_each, share, &copies, how, placing, e);
    near_copies_free(&copies);
    free(share);
    return done;
}
