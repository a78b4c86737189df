#include "model/fracture.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "model/crack.h"
#include "model/sculpture.h"
#include "shape/level_set.h"
#include "shape/mesh_close.h"

#include <math.h>
#include <stdlib.h>

enum { BUMP_OCTAVES = 4 };

#define KNOWN_VOXELS 11.0f // how far from a crack its distance matters: half a block and the band
#define TIMID 0.5          // distances to displaced sheets are off by less than this factor

FractureParams fracture_params_default(void)
{
    FractureParams params = {.impacts = 5,
                             .attractors = 70,
                             .roughness = 0.012f,
                             .weathering = 0.006f,
                             .explode = 0.12f,
                             .turn = 4.0f,
                             .resolution = 180};
    params.element.place = SCATTER_SURFACE;
    params.element.pattern = SCATTER_POISSON;
    params.element.max_children = 2;
    params.element.noise = 0.3f;
    params.element.field_weight = 1.0f;
    return params;
}

OutTree *fracture_grow(const FractureParams *params, const Recipe *recipe, Error *e)
{
    // A hollow branch sculpture's net, with a reach that leaves few cracks without an end.
    SculptureParams net = sculpture_params_default();
    net.element = params->element;
    net.clusters = params->impacts;
    net.attractors = params->attractors;
    net.thickness = 0.1f;
    net.contrast = 1.0f;
    net.reach = 3.5f;
    return sculpture_grow(&net, recipe, e);
}

// ---- the level sets ----

typedef struct Broken {
    const Envelope *envelope;
    const Crack *crack; // NULL = the base alone
    float hollow, gap;
    float bumps, wavelength; // m, of the outside
    uint64_t seed;
    bool removed; // what the cracks take instead of what they leave
} Broken;

// Of the base's outside, negative inside: the envelope's, and bumps.
static double outer_distance(const Broken *broken, Vec3 p)
{
    float d = envelope_distance(broken->envelope, p), height = broken->bumps;
    Vec3 q = vec3_scale(p, 1.0f / broken->wavelength);
    for (uint64_t k = 0; k < BUMP_OCTAVES && height > 0.0f && fabsf(d) < 8.0f * height; k++) {
        d += height * noise_space(q, random_key(broken->seed, k));
        q = vec3_scale(q, 2.1f);
        height *= 0.5f;
    }
    return (double)d;
}

// Of the base with its hollow.
static double base_distance(const Broken *broken, Vec3 p)
{
    double d = outer_distance(broken, p);
    if (broken->hollow > 0.0f) {
        double inner = -(d + (double)broken->hollow);
        d = inner > d ? inner : d;
    }
    return d;
}

static double broken_distance(const void *shape, Vec3 p, double *bound)
{
    const Broken *broken = shape;
    double d = base_distance(broken, p);
    // Outside the base what the cracks leave is as far as the base is.
    if (broken->crack && (broken->removed || d < (double)broken->gap)) {
        double cut = (double)(crack_distance(broken->crack, p) - 0.5f * broken->gap);
        double side = broken->removed ? cut : -cut;
        d = side > d ? side : d;
    }
    *bound = TIMID * (d < 0.0 ? -d : d);
    return d;
}

static Mesh *broken_surface(const Broken *broken, Aabb box, float voxel, const Run *run, Error *e)
{
    LevelSet *set = level_set_from_distance(broken_distance, broken, box,
                                            (LevelSetFrame){box.low, voxel}, run, e);
    Mesh *mesh = set && level_set_finish(set, e) ? level_set_surface(set, e) : NULL;
    level_set_free(set);
    return mesh;
}

// ---- the base and its cracks ----

typedef struct Workpiece {
    Envelope *envelope;
    Crack *crack;
    Broken broken;
    Aabb box;
    Vec3 center;
    float extent, voxel;
} Workpiece;

static void workpiece_free(Workpiece *work)
{
    crack_free(work->crack);
    envelope_free(work->envelope);
}

static bool workpiece_init(Workpiece *work, const OutTree *network, const FractureParams *params,
                           const Recipe *recipe, Error *e)
{
    *work = (Workpiece){0};
    Shape ball = {.kind = SHAPE_SPHERE, .size = {1, 1, 1}, .transform = transform_identity()};
    EnvelopeParams form = {params->element.shapes, params->element.shape_count,
                           params->element.voxel};
    if (form.shape_count == 0) {
        form.shapes = &ball;
        form.shape_count = 1;
    }
    work->envelope = envelope_new(&form, recipe->run, e);
    if (!work->envelope) {
        return false;
    }
    work->box = envelope_bounds(work->envelope);
    Vec3 size = vec3_sub(work->box.high, work->box.low);
    work->extent = fmaxf(size.x, fmaxf(size.y, size.z));
    Vec3 bumps = vec3_splat(2.0f * params->weathering * work->extent);
    work->box = (Aabb){vec3_sub(work->box.low, bumps), vec3_add(work->box.high, bumps)};
    work->center = vec3_lerp(work->box.low, work->box.high, 0.5f);
    work->voxel = work->extent / (float)params->resolution;
    float gap = params->gap > 0.0f ? params->gap : 0.012f * work->extent;
    gap = gap > 3.0f * work->voxel ? gap : 3.0f * work->voxel; // or the pieces would grow together
    CrackParams crack = {.center = work->center,
                         .to_axis = params->to_axis,
                         .outward = 0.1f * work->extent,
                         .known = KNOWN_VOXELS * work->voxel + gap,
                         .roughness = params->roughness * work->extent,
                         .wavelength = 0.12f * work->extent,
                         .seed = random_key(recipe->seed, 5)};
    work->crack = crack_new(network, &crack, work->box, recipe->run, e);
    work->broken = (Broken){.envelope = work->envelope,
                            .crack = work->crack,
                            .hollow = params->hollow,
                            .gap = gap,
                            .bumps = params->weathering * work->extent,
                            .wavelength = 0.25f * work->extent,
                            .seed = random_key(recipe->seed, 7)};
    return work->crack;
}

static bool measure_volume(const Workpiece *work, bool removed, const Run *run, double *volume,
                           Error *e)
{
    Broken broken = work->broken;
    broken.crack = removed ? broken.crack : NULL;
    broken.removed = removed;
    Mesh *mesh = broken_surface(&broken, work->box, work->voxel, run, e);
    if (mesh) {
        *volume = mesh_signed_volume(mesh);
    }
    mesh_free(mesh);
    return mesh;
}

// Splits the base; hollows inside a piece count as pieces of their own and go, and so does dust.
static bool split(const Workpiece *work, const Run *run, MeshPieces *pieces, Error *e)
{
    Mesh *mesh = broken_surface(&work->broken, work->box, work->voxel, run, e);
    bool done = mesh && mesh_split(mesh, pieces, e);
    mesh_free(mesh);
    int64_t kept = 0;
    double dust = 30.0 * (double)work->voxel * (double)work->voxel * (double)work->voxel;
    for (int64_t i = 0; done && i < pieces->count; i++) {
        if (mesh_signed_volume(pieces->piece[i]) > dust) {
            pieces->piece[kept++] = pieces->piece[i];
        } else {
            mesh_free(pieces->piece[i]);
        }
    }
    pieces->count = done ? kept : 0;
    return done;
}

bool fracture_pieces(const OutTree *network, const FractureParams *params, const Recipe *recipe,
                     MeshPieces *pieces, double *base, double *removed, Error *e)
{
    Workpiece work;
    *pieces = (MeshPieces){0};
    bool done = workpiece_init(&work, network, params, recipe, e) &&
                split(&work, recipe->run, pieces, e) &&
                (!base || measure_volume(&work, false, recipe->run, base, e)) &&
                (!removed || measure_volume(&work, true, recipe->run, removed, e));
    workpiece_free(&work);
    if (!done) {
        mesh_pieces_clear(pieces);
    }
    return done;
}

bool fracture_measure(const OutTree *network, const FractureParams *params, const Recipe *recipe,
                      MeasureList *list, Error *e)
{
    MeshPieces pieces;
    double base, kept = 0.0, largest = 0.0, none = (double)NAN;
    if (!fracture_pieces(network, params, recipe, &pieces, &base, NULL, e)) {
        return false;
    }
    for (int64_t i = 0; i < pieces.count; i++) {
        double volume = mesh_signed_volume(pieces.piece[i]);
        largest = volume > largest ? volume : largest;
        kept += volume;
    }
    bool done = measures_add(list, "pieces", (double)pieces.count, "", none, none, e) &&
                measures_add(list, "largest_piece", largest / base, "", none, none, e) &&
                measures_add(list, "removed", 1.0 - kept / base, "", none, none, e);
    mesh_pieces_clear(&pieces);
    return done;
}

// ---- the pieces on their way into the world ----

static Vec3 middle_of(const Mesh *mesh)
{
    Vec3 sum = vec3(0, 0, 0);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        sum = vec3_madd(sum, 1.0f / (float)mesh->vertex_count, mesh->position[i]);
    }
    return sum;
}

// Away from the middle, and turned a little about its own.
static Transform piece_motion(const Workpiece *work, const FractureParams *params, Vec3 middle,
                              uint64_t key)
{
    Vec3 angle = vec3_scale(random_direction(random_key(key, 1)),
                            params->turn * random_unit(random_key(key, 2)));
    Vec3 zero = vec3(0, 0, 0), one = vec3_splat(1.0f);
    float far = params->explode * (0.8f + 0.4f * random_unit(random_key(key, 3)));
    Vec3 goal = vec3_madd(middle, far, vec3_sub(middle, work->center));
    Transform back = transform_compose(vec3_neg(middle), zero, one);
    Transform turn = transform_compose(goal, angle, one);
    return transform_multiply(&turn, &back);
}

// The faces of the old surface, or those that broke, as a mesh of their own.
static Mesh *part_of(const Workpiece *work, const Mesh *piece, bool outside, Error *e)
{
    Mesh *part = mesh_new(3, piece->vertex_count, piece->face_count, MESH_NORMAL, e);
    if (!part) {
        return NULL;
    }
    for (int64_t i = 0; i < piece->vertex_count; i++) {
        part->position[i] = piece->position[i];
        part->normal[i] = piece->normal[i];
    }
    part->face_count = 0;
    for (int64_t f = 0; f < piece->face_count; f++) {
        const uint32_t *c = piece->index + 3 * f;
        Vec3 sum =
            vec3_add(piece->position[c[0]], vec3_add(piece->position[c[1]], piece->position[c[2]]));
        double depth = outer_distance(&work->broken, vec3_scale(sum, 1.0f / 3.0f));
        if ((depth > -0.8 * (double)work->voxel) == outside) {
            uint32_t *to = part->index + 3 * part->face_count++;
            to[0] = c[0], to[1] = c[1], to[2] = c[2];
        }
    }
    return part;
}

static bool add_piece(const Workpiece *work, const FractureParams *params, const Mesh *piece,
                      const FractureMaterials *materials, int object, uint64_t key,
                      Geometry *geometry, Error *e)
{
    Transform motion = piece_motion(work, params, middle_of(piece), key);
    for (int side = 0; side < 2; side++) {
        Mesh *mesh = part_of(work, piece, side == 0, e);
        if (!mesh || !mesh_transform(mesh, &motion, e)) {
            mesh_free(mesh);
            return false;
        }
        Part part = {.kind = PART_MESH,
                     .mesh = mesh,
                     .material = side == 0 ? materials->outside : materials->inside,
                     .object = object};
        if (!geometry_add(geometry, part, e)) {
            return false;
        }
    }
    return true;
}

bool fracture_geometry(const OutTree *network, const FractureParams *params,
                       const FractureMaterials *materials, int object, const Recipe *recipe,
                       Geometry *geometry, Error *e)
{
    Workpiece work;
    MeshPieces pieces = {0};
    bool done =
        workpiece_init(&work, network, params, recipe, e) && split(&work, recipe->run, &pieces, e);
    for (int64_t i = 0; done && i < pieces.count; i++) {
        uint64_t key = random_key(random_key(recipe->seed, 6), (uint64_t)i);
        if (random_unit(key) >= params->missing) {
            done = add_piece(&work, params, pieces.piece[i], materials, object, key, geometry, e);
        }
    }
    mesh_pieces_clear(&pieces);
    workpiece_free(&work);
    return done;
}
