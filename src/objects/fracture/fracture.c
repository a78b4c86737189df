#include "objects/fracture/fracture.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/fracture/body.h"
#include "objects/fracture/crack_cells.h"
#include "objects/sculpture/sculpture.h"
#include "shape/level_set.h"
#include "shape/mesh_close.h"

#include <math.h>
#include <stdlib.h>

enum { STREAM_AXIS = 1, STREAM_ANGLE = 2, STREAM_DISTANCE = 3 }; // of a piece

#define CELL_VOXELS 1.6f    // spacing of the grid that tells cells apart, over a voxel
#define CELL_SPACINGS 2.0f  // inner radius of the smallest cell, in those
#define MOST_ACROSS 340.0f  // of those
#define DUST 30.0           // voxels of volume: less is no piece
#define CHANGE_MOST 0.01    // of the volume: beyond that a warning tells
#define DISTANCE_SAFETY 0.5 // bumps put distances off by less than this factor

FractureParams fracture_params_default(void)
{
    FractureParams params = {.impacts = 5,
                             .attractors = 70,
                             .roughness = 0.012f,
                             .weathering = 0.006f,
                             .explode = 0.12f,
                             .turn = 4.0f,
                             .resolution = 180};
    params.element.points.place = SCATTER_SURFACE;
    params.element.points.pattern = SCATTER_POISSON;
    params.element.growth.max_children = 2;
    params.element.growth.noise = 0.3f;
    params.element.growth.field_weight = 1.0f;
    return params;
}

bool fracture_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const FractureParams *params = given;
    // A hollow branch sculpture's network, with a reach that leaves few cracks open.
    SculptureParams net = sculpture_params_default();
    net.element = params->element;
    net.clusters = params->impacts;
    net.attractors = params->attractors;
    net.thickness = 0.1f;
    net.contrast = 1.0f;
    net.reach = 3.5f;
    return sculpture_grow(&net, recipe, whole, e);
}

// ---- cutting ----

typedef struct Workpiece {
    FractureBody body;
    CrackCells *cells;
    float gap, least; // m; of the cells: see CrackCellsParams
} Workpiece;

// One cell of the workpiece; the whole body if there are no cells.
typedef struct Cut {
    const Workpiece *work;
    int32_t cell;
} Cut;

static float body_distance(const void *shape, Vec3 p, float *outer)
{
    const FractureBody *body = shape;
    *outer = (float)fracture_body_outer(body, p);
    return (float)fracture_body_distance(body, p);
}

static void workpiece_clear(Workpiece *work)
{
    crack_cells_free(work->cells);
    fracture_body_clear(&work->body);
}

static bool workpiece_new(Workpiece *work, const OutTree *network, const FractureParams *params,
                          const Recipe *recipe, Error *e)
{
    *work = (Workpiece){.gap = params->gap};
    if (!fracture_body_new(&work->body, params, recipe, e)) {
        return false;
    }
    const FractureBody *body = &work->body;
    float spacing = fmaxf(CELL_VOXELS * body->voxel, body->extent / MOST_ACROSS);
    work->least = fmaxf(CELL_SPACINGS * spacing, params->gap);
    CrackCellsParams cells = {.distance = body_distance,
                              .body = body,
                              .box = body->box,
                              .spacing = spacing,
                              .least = work->least,
                              .known = params->gap + 5.0f * body->voxel,
                              .roughness = 2.0f * params->roughness * body->extent,
                              .wavelength = 0.12f * body->extent,
                              .seed = random_key(recipe->seed, STREAM_CELLS)};
    work->cells = crack_cells_new(network, &cells, recipe->run, e);
    return work->cells;
}

static double cut_distance(const void *shape, Vec3 p, double *bound)
{
    const Cut *cut = shape;
    const Workpiece *work = cut->work;
    double wall = -INFINITY, near = INFINITY, half = 0.5 * (double)work->gap;
    if (work->cells) {
        wall = crack_cells_distance(work->cells, cut->cell, p, &near) + half;
        near -= half;
        if (wall > 0.0 && near > 4.0 * (double)work->body.voxel) {
            *bound = near; // in another piece
            return wall;
        }
    }
    double body = fracture_body_distance(&work->body, p);
    double far = DISTANCE_SAFETY * fabs(body);
    *bound = body > 0.0 ? far : fmin(far, fmax(near, 0.0));
    return body > wall ? body : wall;
}

static Mesh *cut_surface(const Cut *cut, Aabb box, const Run *run, Error *e)
{
    const FractureBody *body = &cut->work->body;
    LevelSet *set = level_set_from_distance(cut_distance, cut, box,
                                            (LevelSetFrame){body->box.low, body->voxel}, run, e);
    Mesh *mesh = set && level_set_finish(set, e) ? level_set_surface(set, e) : NULL;
    level_set_free(set);
    return mesh;
}

static bool holds_hollow(const MeshPieces *parts, double dust)
{
    for (int64_t i = 0; i < parts->count; i++) {
        if (mesh_signed_volume(parts->piece[i]) < -dust) {
            return true;
        }
    }
    return false;
}

// Each connected part of a cell is a piece, chips too; dust is dropped. A mesh around a hollow is
// one piece. Moves what it keeps out of parts, or out of *mesh, which consists of these parts.
static bool add_parts(MeshPieces *parts, Mesh **mesh, double dust, MeshPieces *pieces,
                      int64_t *capacity, Error *e)
{
    if (!memory_reserve(&pieces->piece, capacity, pieces->count + parts->count + 1, sizeof(Mesh *),
                        e)) {
        return false;
    }
    if (holds_hollow(parts, dust)) {
        pieces->piece[pieces->count++] = *mesh;
        *mesh = NULL;
        return true;
    }
    for (int64_t i = 0; i < parts->count; i++) {
        if (mesh_signed_volume(parts->piece[i]) > dust) {
            pieces->piece[pieces->count++] = parts->piece[i];
            parts->piece[i] = NULL;
        }
    }
    return true;
}

static bool cut_cell(const Workpiece *work, int32_t cell, MeshPieces *pieces, int64_t *capacity,
                     const Run *run, Error *e)
{
    Cut cut = {work, cell};
    MeshPieces parts = {0};
    double voxel = (double)work->body.voxel, dust = DUST * voxel * voxel * voxel;
    Aabb box = crack_cells_bounds(work->cells, cell);
    box = (Aabb){vec3_max(box.low, work->body.box.low), vec3_min(box.high, work->body.box.high)};
    if (aabb_is_empty(box)) {
        return true;
    }
    Mesh *mesh = cut_surface(&cut, box, run, e);
    bool done =
        mesh && mesh_split(mesh, &parts, e) && add_parts(&parts, &mesh, dust, pieces, capacity, e);
    mesh_pieces_clear(&parts);
    mesh_free(mesh);
    return done;
}

// Warns where the result differs from the scene's request.
static void warn_of_pieces(const Workpiece *work, const FractureParams *params,
                           const MeshPieces *pieces, int32_t gone, const Recipe *recipe)
{
    int32_t cells = crack_cells_count(work->cells), small = crack_cells_small(work->cells);
    double kept = 0.0, own = envelope_volume(work->body.envelope);
    if (cells == 1) {
        recipe_warn(recipe, NULL,
                    "cracks from %d impacts with %lld attractors separate no pieces; use more "
                    "impacts or attractors",
                    params->impacts,
                    (long long)(params->element.level_count ? element_attractors(&params->element)
                                                            : params->attractors));
    }
    if (small > 0) {
        recipe_warn(recipe, NULL,
                    "%d cells between cracks are less than %.2g m wide and were merged with a "
                    "neighbour; %d remain; a resolution above %d, a narrower gap or fewer "
                    "attractors would separate them",
                    small, 2.0 * (double)work->least, cells, params->resolution);
    }
    if (gone > 0) {
        recipe_warn(recipe, NULL,
                    "%d of %d pieces are thinner than the gap of %g m and were removed; use a "
                    "narrower gap to keep them",
                    gone, cells, (double)params->gap);
    }
    for (int64_t i = 0; i < pieces->count; i++) {
        kept += mesh_signed_volume(pieces->piece[i]);
    }
    if (params->hollow <= 0.0f && params->gap <= 0.0f && fabs(kept / own - 1.0) > CHANGE_MOST) {
        recipe_warn(recipe, NULL,
                    "the pieces have %.1f %% of the body's volume; a resolution above %d or less "
                    "weathering (now %g) would preserve more of its shape",
                    100.0 * kept / own, params->resolution, (double)params->weathering);
    }
}

static bool split(const Workpiece *work, const FractureParams *params, const Recipe *recipe,
                  MeshPieces *pieces, Error *e)
{
    int32_t count = crack_cells_count(work->cells), gone = 0;
    int64_t capacity = 0;
    for (int32_t i = 0; i < count; i++) {
        int64_t before = pieces->count;
        run_progress(recipe->run, "pieces", (double)i / (double)count);
        if (!cut_cell(work, i, pieces, &capacity, recipe->run, e)) {
            return false;
        }
        gone += pieces->count == before;
    }
    warn_of_pieces(work, params, pieces, gone, recipe);
    return true;
}

bool fracture_pieces(const OutTree *network, const FractureParams *params, const Recipe *recipe,
                     MeshPieces *pieces, double *base, Error *e)
{
    Workpiece work;
    *pieces = (MeshPieces){0};
    bool done =
        workpiece_new(&work, network, params, recipe, e) && split(&work, params, recipe, pieces, e);
    if (done && base) {
        Workpiece whole = {.body = work.body};
        Mesh *mesh = cut_surface(&(Cut){&whole, 0}, work.body.box, recipe->run, e);
        done = mesh;
        *base = mesh ? mesh_signed_volume(mesh) : 0.0;
        mesh_free(mesh);
    }
    workpiece_clear(&work);
    if (!done) {
        mesh_pieces_clear(pieces);
    }
    return done;
}

bool fracture_measure(const void *params, const Grown *grown, const Recipe *recipe,
                      MeasureList *list, Error *e)
{
    MeshPieces pieces;
    double base, kept = 0.0, largest = 0.0, none = (double)NAN;
    if (!fracture_pieces(grown->tree, params, recipe, &pieces, &base, e)) {
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

// ---- placing the pieces ----

static Vec3 middle_of(const Mesh *mesh)
{
    Vec3 sum = vec3(0, 0, 0);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        sum = vec3_madd(sum, 1.0f / (float)mesh->vertex_count, mesh->position[i]);
    }
    return sum;
}

// Moves a piece away from the body's middle and rotates it about its own.
static Transform piece_motion(const Workpiece *work, const FractureParams *params, Vec3 middle,
                              uint64_t key)
{
    Vec3 angle = vec3_scale(random_direction(random_key(key, STREAM_AXIS)),
                            params->turn * random_unit(random_key(key, STREAM_ANGLE)));
    Vec3 zero = vec3(0, 0, 0), one = vec3_splat(1.0f);
    float far = params->explode * (0.8f + 0.4f * random_unit(random_key(key, STREAM_DISTANCE)));
    Vec3 goal = vec3_madd(middle, far, vec3_sub(middle, work->body.center));
    Transform back = transform_compose(vec3_neg(middle), zero, one);
    Transform turn = transform_compose(goal, angle, one);
    return transform_multiply(&turn, &back);
}

// The faces of the old surface, or the fracture faces, as a separate mesh.
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
        double depth = fracture_body_outer(&work->body, vec3_scale(sum, 1.0f / 3.0f));
        if ((depth > -0.8 * (double)work->body.voxel) == outside) {
            uint32_t *to = part->index + 3 * part->face_count++;
            to[0] = c[0], to[1] = c[1], to[2] = c[2];
        }
    }
    return part;
}

static bool add_piece(const Workpiece *work, const FractureParams *params, const Mesh *piece,
                      uint64_t key, const Placing *placing, Error *e)
{
    Transform motion = piece_motion(work, params, middle_of(piece), key);
    for (int role = FRACTURE_OUTSIDE; role <= FRACTURE_INSIDE; role++) {
        Mesh *mesh = part_of(work, piece, role == FRACTURE_OUTSIDE, e);
        if (!mesh || !mesh_transform(mesh, &motion, e)) {
            mesh_free(mesh);
            return false;
        }
        if (!placing_add(placing, (Part){.mesh = mesh}, role, e)) {
            return false;
        }
    }
    return true;
}

bool fracture_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const FractureParams *params = given;
    const Recipe *recipe = placing->recipe;
    Workpiece work;
    MeshPieces pieces = {0};
    bool done = workpiece_new(&work, grown->tree, params, recipe, e) &&
                split(&work, params, recipe, &pieces, e);
    for (int64_t i = 0; done && i < pieces.count; i++) {
        uint64_t key = random_key(random_key(recipe->seed, STREAM_PIECES), (uint64_t)i);
        if (random_unit(key) >= params->missing) {
            done = add_piece(&work, params, pieces.piece[i], key, placing, e);
        }
    }
    mesh_pieces_clear(&pieces);
    workpiece_clear(&work);
    return done;
}
