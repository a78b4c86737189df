#include "shape/envelope.h"

#include "base/memory.h"
#include "shape/depth_field.h"
#include "shape/mesh_close.h"
#include "shape/pieces.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

// What is made when first asked for, also of an envelope that is const.
typedef struct Kept {
    pthread_mutex_t lock;
    DepthField *depth; // NULL = not asked for yet
} Kept;

struct Envelope {
    Primitive primitive; // used when level_set and existing are NULL
    LevelSet *level_set;
    const ShapeSurface *existing; // NULL = made of shapes; borrowed
    Mesh *surface;                // NULL if existing
    Aabb bounds;
    double volume, area;
    Kept *kept;
};

static bool become_primitive(Envelope *envelope, const Primitive *primitive, Error *e)
{
    envelope->primitive = *primitive;
    envelope->bounds = primitive_bounds(primitive);
    envelope->volume = primitive_volume(primitive);
    envelope->area = primitive_area(primitive);
    if (!isfinite(envelope->volume) || !vec3_finite(envelope->bounds.low) ||
        !vec3_finite(envelope->bounds.high)) {
        error_set(e, ERROR_INPUT,
                  "the envelope is larger than numbers can say; its sizes "
                  "and scales must be moderate");
        return error_key(e, "envelope");
    }
    envelope->surface = primitive_surface(primitive, e);
    return envelope->surface;
}

// A mesh alone keeps its own triangles as the surface.
static bool measure_mesh(Envelope *envelope, Piece *piece, Error *e)
{
    Mesh *inside = level_set_surface(envelope->level_set, e);
    if (!inside) {
        return false;
    }
    double filled = mesh_signed_volume(inside), own = mesh_signed_volume(piece->closed);
    // overlapping faces or a guessed cap falsify the mesh's volume; the level set's is used then
    bool trusted = piece->open_edges == 0 && fabs(own - filled) < 0.1 * own;
    mesh_free(inside);
    envelope->volume = trusted ? own : filled;
    envelope->area = mesh_area(piece->mesh);
    envelope->bounds = piece->bounds;
    envelope->surface = piece->mesh;
    piece->mesh = NULL;
    return true;
}

static bool measure_level_set(Envelope *envelope, Aabb inside, Error *e)
{
    envelope->surface = level_set_surface(envelope->level_set, e);
    if (!envelope->surface) {
        return false;
    }
    envelope->bounds = aabb_common(level_set_bounds(envelope->level_set), inside);
    envelope->volume = mesh_signed_volume(envelope->surface);
    envelope->area = mesh_area(envelope->surface);
    if (!(envelope->volume > 0.0)) {
        error_set(e, ERROR_INPUT,
                  "the envelope is empty: its cuts leave nothing of it; "
                  "make the cutting shapes smaller or move them");
        return error_key(e, "envelope");
    }
    return true;
}

static bool build(Envelope *envelope, Piece *pieces, const EnvelopeParams *params, const Run *run,
                  Error *e)
{
    int count = params->shape_count;
    bool primitive = !pieces[0].mesh && pieces[0].shape->kind != SHAPE_BODY;
    if (count == 1 && primitive && !params->voxelized) {
        return become_primitive(envelope, &pieces[0].primitive, e);
    }
    Aabb inside;
    envelope->level_set = pieces_level_set(pieces, count, params->voxel, &inside, run, e);
    if (!envelope->level_set) {
        return false;
    }
    return count == 1 && pieces[0].mesh ? measure_mesh(envelope, &pieces[0], e)
                                        : measure_level_set(envelope, inside, e);
}

static Kept *kept_new(Error *e)
{
    Kept *kept = memory_alloc_zero(1, sizeof *kept, e);
    if (kept) {
        pthread_mutex_init(&kept->lock, NULL);
    }
    return kept;
}

static void kept_free(Kept *kept)
{
    if (kept) {
        depth_field_free(kept->depth);
        pthread_mutex_destroy(&kept->lock);
        free(kept);
    }
}

static Envelope *envelope_alloc(Error *e)
{
    Envelope *envelope = memory_alloc_zero(1, sizeof *envelope, e);
    if (envelope) {
        envelope->kept = kept_new(e);
        if (!envelope->kept) {
            free(envelope);
            envelope = NULL;
        }
    }
    return envelope;
}

Envelope *envelope_new(const EnvelopeParams *params, const Run *run, Error *e)
{
    Piece *pieces = pieces_load(params, run, e);
    if (!pieces) {
        return NULL;
    }
    Envelope *envelope = envelope_alloc(e);
    if (envelope && !build(envelope, pieces, params, run, e)) {
        envelope_free(envelope);
        envelope = NULL;
    }
    pieces_free(pieces, params->shape_count);
    return envelope;
}

Envelope *envelope_of_surface(const ShapeSurface *surface, Error *e)
{
    Envelope *envelope = envelope_alloc(e);
    if (envelope) {
        envelope->existing = surface;
        envelope->bounds = mesh_bounds(surface->mesh);
        envelope->area = mesh_area(surface->mesh);
    }
    return envelope;
}

void envelope_free(Envelope *envelope)
{
    if (envelope) {
        level_set_free(envelope->level_set);
        mesh_free(envelope->surface);
        kept_free(envelope->kept);
        free(envelope);
    }
}

const DepthField *envelope_depth(const Envelope *envelope, Error *e)
{
    Kept *kept = envelope->kept;
    pthread_mutex_lock(&kept->lock);
    if (!kept->depth) {
        kept->depth = depth_field_new(envelope, e);
    }
    const DepthField *depth = kept->depth;
    pthread_mutex_unlock(&kept->lock);
    return depth;
}

Aabb envelope_bounds(const Envelope *envelope)
{
    return envelope->bounds;
}

Transform envelope_frame(const Envelope *envelope)
{
    if (!envelope->level_set && !envelope->existing) {
        return primitive_frame(&envelope->primitive);
    }
    Vec3 low = envelope->bounds.low, size = vec3_sub(envelope->bounds.high, low);
    return transform_from_axes(vec3(size.x, 0, 0), vec3(0, size.y, 0), vec3(0, 0, size.z), low);
}

double envelope_volume(const Envelope *envelope)
{
    return envelope->volume;
}

double envelope_area(const Envelope *envelope)
{
    return envelope->area;
}

static float existing_distance(const ShapeSurface *surface, Vec3 p)
{
    Vec3 nearest = p, normal;
    surface->nearest(surface->user, &nearest, &normal);
    Vec3 apart = vec3_sub(p, nearest);
    return vec3_dot(apart, normal) < 0.0f ? -vec3_length(apart) : vec3_length(apart);
}

float envelope_distance(const Envelope *envelope, Vec3 p)
{
    if (envelope->level_set) {
        return level_set_distance(envelope->level_set, p);
    }
    return envelope->existing ? existing_distance(envelope->existing, p)
                              : (float)primitive_distance(&envelope->primitive, p, NULL);
}

bool envelope_nearest(const Envelope *envelope, Vec3 *p, Vec3 *normal)
{
    if (envelope->existing) {
        envelope->existing->nearest(envelope->existing->user, p, normal);
    }
    return envelope->existing;
}

bool envelope_contains(const Envelope *envelope, Vec3 p)
{
    if (envelope->existing) {
        return existing_distance(envelope->existing, p) < 0.0f;
    }
    return envelope->level_set ? level_set_distance(envelope->level_set, p) < 0.0f
                               : primitive_contains(&envelope->primitive, p);
}

float envelope_band(const Envelope *envelope)
{
    return envelope->level_set ? level_set_band(envelope->level_set) : INFINITY;
}

bool envelope_is_exact(const Envelope *envelope)
{
    return !envelope->level_set && !envelope->existing && envelope->primitive.exact;
}

const Mesh *envelope_surface(const Envelope *envelope)
{
    return envelope->existing ? envelope->existing->mesh : envelope->surface;
}

bool envelope_add_to(const Envelope *envelope, const char *name, GridFile *grids, const Run *run,
                     Error *e)
{
    if (envelope->level_set) {
        return level_set_add_to(envelope->level_set, name, grids, e);
    }
    LevelSetFrame frame = {envelope->bounds.low, aabb_extent(envelope->bounds) / ENVELOPE_VOXELS};
    LevelSet *sampled = level_set_from_distance(piece_distance, &envelope->primitive,
                                                envelope->bounds, frame, run, e);
    bool done =
        sampled && level_set_finish(sampled, e) && level_set_add_to(sampled, name, grids, e);
    level_set_free(sampled);
    return done;
}
