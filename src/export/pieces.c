#include "export/pieces.h"

#include "base/memory.h"
#include "mesh/curve_tubes.h"
#include "render/world.h"

#include <stdlib.h>

static const double MANY_TRIANGLES = 20e6; // a gigabyte or so

enum { CHUNK_POINTS = 16384 }; // of curves made into tubes at once, about

Aabb export_piece_bounds(const ExportPiece *piece)
{
    const Mesh *mesh = piece->surface->mesh;
    Aabb bounds = aabb_empty();
    for (int64_t v = 0; v < mesh->vertex_count; v++) {
        Vec3 p = mesh->position[v];
        bounds = aabb_add(bounds, piece->place ? transform_point(piece->place, p) : p);
    }
    return bounds;
}

static int tube_sides(const ExportSource *source)
{
    int sides = source->options.tube_sides;
    return sides > 0 ? sides : CURVE_TUBE_SIDES;
}

static int64_t part_copies(const Part *part, bool placed)
{
    return part->instance && placed ? part->instance_count : 1;
}

// The number of curves from `first` on that make a chunk.
static int64_t chunk_of(const CurveSet *curves, int64_t first)
{
    int64_t last = first + 1;
    while (last < curves->curve_count &&
           curves->first[last + 1] - curves->first[first] <= CHUNK_POINTS) {
        last++;
    }
    return last - first;
}

static float largest(const float *radius, int64_t count)
{
    float most = 0.0f;
    for (int64_t i = 0; radius && i < count; i++) {
        most = radius[i] > most ? radius[i] : most;
    }
    return most;
}

// The largest radius of all branches of the object.
static float largest_radius(const Geometry *geometry, int object)
{
    float most = 0.0f;
    for (int64_t i = 0; i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        if (part->object == object && part->mesh) {
            most = fmaxf(most, largest(part->mesh->radius, part->mesh->vertex_count));
        } else if (part->object == object && part->curves) {
            most = fmaxf(most, largest(part->curves->radius, part->curves->point_count));
        }
    }
    return most;
}

typedef struct PartWalk {
    const ExportSource *source;
    int64_t index;
    bool placed;
    unsigned wants;
    float largest_radius;
    const Run *run;
    ExportVisit visit;
    void *user;
} PartWalk;

// Visits one mesh at all its places. glow: of its vertices, or NULL.
static bool visit_mesh(const PartWalk *walk, const Mesh *mesh, const float *glow, Error *e)
{
    const World *world = walk->source->world;
    const Part *part = &world->geometry.part[walk->index];
    ExportSurface surface;
    if (!export_surface_prepare(&surface, mesh, &world->material[part->material], walk->wants, e)) {
        return false;
    }
    surface.largest_radius = walk->largest_radius;
    surface.glow = glow;
    bool done = true;
    for (int64_t i = 0; done && i < part_copies(part, walk->placed); i++) {
        ExportPiece piece = {.part = walk->index, .surface = &surface, .look = {0.5f, 0.0f}};
        if (part->instance) {
            piece.place = walk->placed ? &part->instance[i] : NULL;
            piece.look = walk->placed ? part_look(part, i) : (InstanceLook){-1.0f, 0.0f};
        }
        done = walk->visit(walk->user, &piece, e);
        if (run_is_cancelled(walk->run)) { // it may be incomplete
            done = run_cancel_error(e);
        }
    }
    export_surface_clear(&surface);
    return done;
}

static bool visit_tubes(const PartWalk *walk, const CurveSet *curves, int64_t first, int64_t count,
                        Error *e)
{
    int sides = tube_sides(walk->source);
    Mesh *tubes = curve_tubes(curves, first, count, sides, e);
    float *glow = NULL;
    bool done = tubes;
    if (done && curves->glow) {
        glow = memory_alloc(tubes->vertex_count, sizeof *glow, e);
        done = glow;
        if (done) {
            curve_tubes_spread(curves, first, count, sides, curves->glow, glow);
        }
    }
    done = done && visit_mesh(walk, tubes, glow, e);
    free(glow);
    mesh_free(tubes);
    return done;
}

bool export_part_pieces(const ExportSource *source, int64_t index, bool placed, unsigned wants,
                        const Run *run, ExportVisit visit, void *user, Error *e)
{
    const Geometry *geometry = &source->world->geometry;
    const Part *part = &geometry->part[index];
    PartWalk walk = {.source = source,
                     .index = index,
                     .placed = placed,
                     .wants = wants,
                     .largest_radius = largest_radius(geometry, part->object),
                     .run = run,
                     .visit = visit,
                     .user = user};
    if (part->mesh) {
        return part->mesh->face_count == 0 || visit_mesh(&walk, part->mesh, NULL, e);
    }
    bool done = true;
    for (int64_t i = 0; done && i < part->curves->curve_count;) {
        int64_t count = chunk_of(part->curves, i);
        done = visit_tubes(&walk, part->curves, i, count, e);
        i += count;
    }
    return done;
}

bool export_all_pieces(const ExportSource *source, unsigned wants, float begin, float end,
                       const Run *run, ExportVisit visit, void *user, Error *e)
{
    int64_t whole = export_all_tally(source).vertices, past = 0;
    bool done = true;
    for (int64_t i = 0; done && i < source->world->geometry.count; i++) {
        double share = whole > 0 ? (double)past / (double)whole : 0.0;
        run_progress(run, "write", (double)begin + share * (double)(end - begin));
        done = export_part_pieces(source, i, true, wants, run, visit, user, e);
        past += export_part_tally(source, i, true).vertices;
    }
    return done;
}

ExportTally export_part_tally(const ExportSource *source, int64_t index, bool placed)
{
    const Part *part = &source->world->geometry.part[index];
    ExportTally tally = {0};
    if (part->mesh && part->mesh->face_count > 0) {
        tally.vertices = part->mesh->vertex_count;
        tally.faces = part->mesh->face_count;
        tally.triangles = tally.faces * (part->mesh->face_size - 2);
    } else if (part->curves) {
        curve_tubes_count(part->curves, 0, part->curves->curve_count, tube_sides(source),
                          &tally.vertices, &tally.triangles);
        tally.faces = tally.triangles;
    }
    int64_t copies = part_copies(part, placed);
    return (ExportTally){tally.vertices * copies, tally.faces * copies, tally.triangles * copies};
}

ExportTally export_all_tally(const ExportSource *source)
{
    ExportTally sum = {0};
    for (int64_t i = 0; i < source->world->geometry.count; i++) {
        ExportTally tally = export_part_tally(source, i, true);
        sum.vertices += tally.vertices;
        sum.faces += tally.faces;
        sum.triangles += tally.triangles;
    }
    return sum;
}

void export_warn_of_instances(const ExportSource *source, const Run *run)
{
    int64_t instanced = 0;
    for (int64_t i = 0; i < source->world->geometry.count; i++) {
        if (source->world->geometry.part[i].instance) {
            instanced += export_part_tally(source, i, true).triangles;
        }
    }
    if ((double)instanced > MANY_TRIANGLES) {
        run_warn(run,
                 "instances written out make %.0f million triangles; export fewer objects, or a "
                 ".glb or .usda file, which keep instances",
                 (double)instanced * 1e-6);
    }
}
