#include "shape/pieces.h"

#include "base/memory.h"
#include "shape/blend.h"
#include "shape/import.h"
#include "shape/mesh_close.h"

#include <math.h>
#include <stdlib.h>

enum { VOXELS_MIN = 8, VOXELS_MAX = 1024 }; // across the largest extent

static const char *kind_name(ShapeKind kind)
{
    static const char *const names[] = {"sphere", "ellipsoid",  "box",  "cone",  "capsule",
                                        "mesh",   "half space", "body", "object"};
    return names[kind];
}

static bool check_list(const EnvelopeParams *params, Error *e)
{
    if (params->shape_count < 1) {
        return error_set(e, ERROR_INPUT, "the envelope has no shapes; it needs at least one");
    }
    if (!isfinite(params->voxel) || params->voxel < 0.0f) {
        return error_set(e, ERROR_INPUT,
                         "voxel is %g m; it must be positive, or 0 for 1/%d of the largest extent",
                         (double)params->voxel, ENVELOPE_VOXELS);
    }
    int meshes = 0;
    for (int i = 0; i < params->shape_count; i++) {
        const Shape *shape = &params->shapes[i];
        if (shape->kind == SHAPE_HALF_SPACE && (i == 0 || shape->op == SHAPE_UNION)) {
            return error_set(e, ERROR_INPUT,
                             "shape %d: a half space is unbounded and can only cut; put it after "
                             "another shape, as an intersection or a difference",
                             i + 1);
        }
        if (i == 0 && shape->op != SHAPE_UNION) {
            return error_set(e, ERROR_INPUT,
                             "shape 1: there is no shape to cut yet; the first shape of the list "
                             "must be a union");
        }
        meshes += shape->kind == SHAPE_MESH;
        if (shape->blend > 0.0f && (i == 0 || meshes > 0)) {
            return error_set(e, ERROR_INPUT,
                             "shape %d has a blend, but %s; a blend of 0 leaves its edge sharp",
                             i + 1, i == 0 ? "no shape comes before it" : "a mesh has sharp edges");
        }
    }
    return true;
}

// ---- meshes ----

// Turns faces and normals outward if the mesh encloses a volume.
static void face_outward(Piece *piece)
{
    double volume = mesh_signed_volume(piece->closed);
    double box = (double)aabb_extent(piece->bounds) * mesh_area(piece->closed);
    if (volume < -1e-5 * box) {
        mesh_flip(piece->closed);
        mesh_flip(piece->mesh);
    }
}

static bool load_mesh(Piece *piece, const Run *run, Error *e)
{
    const char *file = piece->shape->file;
    piece->mesh = mesh_import(file, run, e);
    if (!piece->mesh) {
        return error_key(e, "file");
    }
    if (!mesh_transform(piece->mesh, &piece->shape->transform, e) ||
        (!piece->mesh->normal && !mesh_compute_normals(piece->mesh, e))) {
        return false;
    }
    piece->bounds = mesh_bounds(piece->mesh);
    if (!vec3_finite(piece->bounds.low) || !vec3_finite(piece->bounds.high)) {
        return error_set(e, ERROR_INPUT,
                         "the transform moves the mesh out of all bounds; its "
                         "numbers must be finite and moderate");
    }
    piece->closed = mesh_close(piece->mesh, &piece->open_edges, e);
    if (!piece->closed) {
        return false;
    }
    face_outward(piece);
    if (piece->open_edges > 0) {
        run_warn(run,
                 "%s: the mesh is open: %lld edges have a face on one side only; its holes were "
                 "closed as well as possible, close them in the file to be sure of the inside",
                 file, (long long)piece->open_edges);
    }
    return true;
}

// ---- pieces ----

static bool piece_load(const Shape *shape, Piece *piece, const Run *run, Error *e)
{
    piece->shape = shape;
    if (shape->kind == SHAPE_MESH) {
        return load_mesh(piece, run, e);
    }
    if (shape->kind == SHAPE_BODY) {
        bool made = body_new(shape, &piece->body, e);
        piece->bounds = piece->body.bounds;
        return made;
    }
    if (!primitive_new(shape, &piece->primitive, e)) {
        return false;
    }
    piece->bounds = primitive_bounds(&piece->primitive);
    return true;
}

void pieces_free(Piece *pieces, int count)
{
    for (int i = 0; pieces && i < count; i++) {
        mesh_free(pieces[i].mesh);
        mesh_free(pieces[i].closed);
    }
    free(pieces);
}

Piece *pieces_load(const EnvelopeParams *params, const Run *run, Error *e)
{
    if (!check_list(params, e)) {
        return NULL;
    }
    Piece *pieces = memory_alloc_zero(params->shape_count, sizeof *pieces, e);
    for (int i = 0; pieces && i < params->shape_count; i++) {
        const Shape *shape = &params->shapes[i];
        if (!piece_load(shape, &pieces[i], run, e)) {
            error_quote_file(e);
            error_prefix(e, "shape %d (%s): ", i + 1, kind_name(shape->kind));
            error_key(e, "envelope.%d", i);
            pieces_free(pieces, params->shape_count);
            return NULL;
        }
    }
    return pieces;
}

// ---- level sets ----

// How many of the first pieces are made as one: up to the last that flows into those before it.
static int blended_count(const Piece *pieces, int count)
{
    while (count > 0 && !(pieces[count - 1].shape->blend > 0.0f)) {
        count--;
    }
    return count;
}

// A box that contains the envelope: rounded edges may lie a quarter of their blend outside of the
// shapes.
static Aabb box_inside(const Piece *pieces, int count)
{
    Aabb inside = aabb_empty();
    float reach = 0.0f;
    for (int i = 0; i < count; i++) {
        if (pieces[i].shape->op == SHAPE_UNION) {
            inside = aabb_union(inside, pieces[i].bounds);
            reach += 0.25f * pieces[i].shape->blend;
        }
    }
    return (Aabb){vec3_sub(inside.low, vec3_splat(reach)),
                  vec3_add(inside.high, vec3_splat(reach))};
}

// Chooses the voxel size and checks it before anything is allocated. *inside is set to a box that
// contains the envelope.
static bool choose_frame(const Piece *pieces, int count, float voxel, LevelSetFrame *frame,
                         Aabb *inside, Error *e)
{
    *inside = box_inside(pieces, count);
    float extent = aabb_extent(*inside);
    *frame = (LevelSetFrame){inside->low, voxel > 0.0f ? voxel : extent / ENVELOPE_VOXELS};
    if (!(extent / frame->voxel >= VOXELS_MIN)) {
        error_set(e, ERROR_INPUT,
                  "voxel %g m is too coarse for an envelope of %g m; set voxel to %g or "
                  "less, or to 0 for 1/%d of the extent",
                  (double)voxel, (double)extent, (double)(extent / VOXELS_MIN), ENVELOPE_VOXELS);
        return error_key(e, "voxel");
    }
    for (int i = 0; i < count; i++) {
        bool is_mesh =
            pieces[i].shape->kind == SHAPE_MESH; // other kinds are sampled only within the box
        float across = is_mesh ? aabb_extent(pieces[i].bounds) : extent;
        if (across / frame->voxel > VOXELS_MAX) {
            error_set(e, ERROR_INPUT,
                      "shape %d (%s): voxel %g m makes a level set of %.0f voxels across; "
                      "at most %d are possible: set voxel to %g or more",
                      i + 1, kind_name(pieces[i].shape->kind), (double)frame->voxel,
                      (double)(across / frame->voxel), VOXELS_MAX, (double)(across / VOXELS_MAX));
            return error_key(e, "voxel");
        }
    }
    return true;
}

double piece_distance(const void *shape, Vec3 p, double *bound)
{
    return primitive_distance(shape, p, bound);
}

static double piece_body_distance(const void *shape, Vec3 p, double *bound)
{
    return body_distance(shape, p, bound);
}

static LevelSet *piece_level_set(const Piece *piece, LevelSetFrame frame, Aabb inside,
                                 const Run *run, Error *e)
{
    if (piece->closed) {
        return level_set_from_mesh(piece->closed, frame, run, e);
    }
    if (piece->shape->kind == SHAPE_BODY) {
        return level_set_from_distance(piece_body_distance, &piece->body,
                                       aabb_common(piece->bounds, inside), frame, run, e);
    }
    return level_set_from_distance(piece_distance, &piece->primitive,
                                   aabb_common(piece->bounds, inside), frame, run, e);
}

// The first `count` pieces, which flow into each other, as one.
static LevelSet *blended_level_set(const Piece *pieces, int count, LevelSetFrame frame, Aabb inside,
                                   const Run *run, Error *e)
{
    BlendPart *part = memory_alloc(count, sizeof *part, e);
    LevelSet *set = NULL;
    if (part) {
        for (int i = 0; i < count; i++) {
            bool body = pieces[i].shape->kind == SHAPE_BODY;
            part[i] = (BlendPart){pieces[i].shape, body ? NULL : &pieces[i].primitive,
                                  body ? &pieces[i].body : NULL};
        }
        Blend blend = {part, count};
        set = level_set_from_distance(blend_all_distance, &blend, inside, frame, run, e);
    }
    free(part);
    return set;
}

static LevelSet *combine_pieces(const Piece *pieces, int count, LevelSetFrame frame, Aabb inside,
                                const Run *run, Error *e)
{
    int blended = blended_count(pieces, count);
    LevelSet *all = blended > 0 ? blended_level_set(pieces, blended, frame, inside, run, e)
                                : piece_level_set(&pieces[0], frame, inside, run, e);
    bool done = all;
    for (int i = blended > 0 ? blended : 1; done && i < count; i++) {
        LevelSet *next = piece_level_set(&pieces[i], frame, inside, run, e);
        done = next && level_set_combine(all, next, pieces[i].shape->op, e);
        level_set_free(next);
        run_progress(run, "envelope", (double)i / (double)count);
    }
    if (!done || !level_set_finish(all, e)) {
        level_set_free(all);
        return NULL;
    }
    return all;
}

LevelSet *pieces_level_set(const Piece *pieces, int count, float voxel, Aabb *inside,
                           const Run *run, Error *e)
{
    LevelSetFrame frame;
    return choose_frame(pieces, count, voxel, &frame, inside, e)
               ? combine_pieces(pieces, count, frame, *inside, run, e)
               : NULL;
}
