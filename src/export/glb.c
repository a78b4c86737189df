// GLB: glTF 2.0 in one file. A header, the JSON that describes the scene, one buffer: of each part
// the vertices (interleaved), the triangles and, where they stand at very many places, those
// places; then the pictures. Everything is planned first, so that the JSON can stand before what it
// describes, and then streamed.
#include "export/glb.h"

#include "base/file_writer.h"
#include "base/memory.h"
#include "export/formats.h"
#include "export/placement.h"
#include "export/sky_bake.h"

#include <stdlib.h>
#include <string.h>

enum { NODES_MOST = 4096 }; // places that become nodes of their own unless told otherwise

// ---- the plan

static bool shears(const Part *part)
{
    Placement placement;
    for (int64_t i = 0; i < part->instance_count; i++) {
        if (!placement_from_transform(&part->instance[i], &placement)) {
            return true;
        }
    }
    return false;
}

static GlbPlacing placing_of(const Glb *glb, const Part *part, int64_t instances)
{
    static const GlbPlacing asked[] = {[EXPORT_INSTANCES_NODES] = GLB_NODES,
                                       [EXPORT_INSTANCES_GPU] = GLB_GPU,
                                       [EXPORT_INSTANCES_FLAT] = GLB_FLAT};
    ExportInstances how = glb->source->options.instances;
    if (!part->instance) {
        return GLB_ONCE;
    }
    if (shears(part)) { // no node can do that
        return GLB_FLAT;
    }
    if (how == EXPORT_INSTANCES_AUTO) {
        return instances <= NODES_MOST ? GLB_NODES : GLB_GPU;
    }
    return asked[how];
}

static void plan_vertex(const Glb *glb, const Part *part, GlbPart *own)
{
    const Mesh *mesh = part->mesh; // NULL: tubes, which have everything
    ExportColors colors = glb->source->options.colors;
    const Material *material = &glb->source->world->material[part->material];
    own->normal = !mesh || mesh->normal;
    own->uv = !mesh || mesh->uv;
    own->radius = !mesh || mesh->radius;
    own->birth = !mesh || mesh->birth;
    own->growth = (own->radius || own->birth) &&
                  (colors == EXPORT_COLORS_ALL || colors == EXPORT_COLORS_GROWTH);
    // COLOR_1 needs a COLOR_0
    own->color = glb_colors_are_base(glb, material) || (own->growth && colors == EXPORT_COLORS_ALL);
    own->stride = 12 + 12 * own->normal + 8 * own->uv + 8 * own->color + 8 * own->growth +
                  4 * own->radius + 4 * own->birth;
}

static bool too_large(Error *e, double bytes)
{
    return error_set(e, ERROR_INPUT,
                     "the file would have more than %.1f GB; a GLB file holds at most 4.29: "
                     "--instances gpu keeps instances, --object NAME writes only that object, and "
                     ".ply has no such limit",
                     bytes * 1e-9);
}

static bool add_bounds(void *user, const ExportPiece *piece, Error *e)
{
    (void)e;
    Aabb *bounds = user;
    *bounds = aabb_union(*bounds, export_piece_bounds(piece));
    return true;
}

// All but its bounds.
static bool plan_part(Glb *glb, int64_t index, int64_t instances, Error *e)
{
    const Part *part = &glb->source->world->geometry.part[index];
    GlbPart own = {.index = index, .placing = placing_of(glb, part, instances)};
    ExportTally tally = export_part_tally(glb->source, index, own.placing == GLB_FLAT);
    if (tally.triangles == 0 || (part->instance && part->instance_count == 0)) {
        return true;
    }
    if (tally.vertices > UINT32_MAX - 1) {
        return too_large(e, (double)tally.vertices * 40.0);
    }
    own.vertices = tally.vertices;
    own.triangles = tally.triangles;
    plan_vertex(glb, part, &own);
    own.bounds = aabb_empty();
    own.vertex_at = glb->buffer_size;
    own.index_at = own.vertex_at + own.vertices * own.stride;
    own.instance_at = own.index_at + own.triangles * 12;
    glb->buffer_size = own.instance_at + (own.placing == GLB_GPU ? part->instance_count * 40 : 0);
    glb->part[glb->part_count++] = own;
    return glb->buffer_size <= UINT32_MAX || too_large(e, (double)glb->buffer_size);
}

static bool plan_bounds(Glb *glb, Error *e)
{
    bool done = true;
    for (int64_t i = 0; done && i < glb->part_count; i++) {
        GlbPart *part = &glb->part[i];
        run_progress(glb->run, "write", 0.2 * (double)i / (double)glb->part_count);
        done = export_part_pieces(glb->source, part->index, part->placing == GLB_FLAT, 0, glb->run,
                                  add_bounds, &part->bounds, e);
    }
    return done;
}

static bool plan_sun(Glb *glb, Error *e)
{
    const Sky *sky = &glb->source->world->sky;
    if (sky->kind != SKY_SUN_SKY && sky->kind != SKY_NIGHT) {
        return true;
    }
    BakedSky baked;
    if (!sky_bake(sky, 4, glb->run, &baked, e)) {
        return false;
    }
    glb->sun = baked.sun;
    baked_sky_clear(&baked);
    return true;
}

static bool plan(Glb *glb, Error *e)
{
    const Geometry *geometry = &glb->source->world->geometry;
    int64_t instances = 0;
    for (int64_t i = 0; i < geometry->count; i++) {
        instances += geometry->part[i].instance_count;
    }
    glb->part = memory_alloc_zero(geometry->count, sizeof *glb->part, e);
    bool done = glb->part;
    for (int64_t i = 0; done && i < geometry->count; i++) {
        done = plan_part(glb, i, instances, e);
    }
    done = done && plan_bounds(glb, e) && plan_sun(glb, e) && glb_gather_materials(glb, e);
    for (int64_t i = 0; done && i < glb->image_count; i++) {
        glb->image[i].at = glb->buffer_size;
        glb->buffer_size += (glb->image[i].size + 3) & ~(int64_t)3;
    }
    return done;
}

static void warn_of_placing(const Glb *glb)
{
    bool gpu = false, flat = false;
    for (int64_t i = 0; i < glb->part_count; i++) {
        gpu = gpu || glb->part[i].placing == GLB_GPU;
        flat = flat || glb->part[i].placing == GLB_FLAT;
    }
    if (gpu && glb->source->options.instances == EXPORT_INSTANCES_AUTO) {
        run_warn(glb->run, "instances need EXT_mesh_gpu_instancing, which Blender knows from 4.0 "
                           "on; --instances nodes or flat is for readers without it");
    }
    if (flat && glb->source->options.instances == EXPORT_INSTANCES_FLAT) {
        export_warn_of_instances(glb->source, glb->run);
    } else if (flat) {
        run_warn(glb->run, "instances that are sheared or flattened are written out: glTF has no "
                           "such nodes");
    }
}

// ---- the bytes

typedef struct GlbWriter {
    const Glb *glb;
    const GlbPart *part;
    FileWriter *file;
    ExportVertex *block; // EXPORT_BLOCK
    int64_t vertices;    // of the part's pieces before
    bool white;          // COLOR_0
} GlbWriter;

static char *put_floats(char *at, const float *value, int count)
{
    memcpy(at, value, (size_t)count * sizeof *value);
    return at + (size_t)count * sizeof *value;
}

static char *put_color(char *at, Vec3 c)
{
    uint16_t value[4] = {(uint16_t)(c.x * 65535.0f + 0.5f), (uint16_t)(c.y * 65535.0f + 0.5f),
                         (uint16_t)(c.z * 65535.0f + 0.5f), UINT16_MAX};
    memcpy(at, value, sizeof value);
    return at + sizeof value;
}

static void write_vertex(const GlbWriter *writer, const ExportVertex *v)
{
    const GlbPart *part = writer->part;
    char *at = file_writer_room(writer->file, (size_t)part->stride);
    if (!at) {
        return;
    }
    at = put_floats(at, (const float[]){v->position.x, v->position.y, v->position.z}, 3);
    if (part->normal) {
        at = put_floats(at, (const float[]){v->normal.x, v->normal.y, v->normal.z}, 3);
    }
    if (part->uv) { // v runs down
        at = put_floats(at, (const float[]){v->uv.x, 1.0f - v->uv.y}, 2);
    }
    if (part->color) {
        at = put_color(at, writer->white ? vec3_splat(1.0f) : v->color);
    }
    if (part->growth) {
        at = put_color(at, v->growth);
    }
    if (part->radius) {
        at = put_floats(at, &v->radius, 1);
    }
    if (part->birth) {
        put_floats(at, &v->birth, 1);
    }
}

static bool write_vertices(void *user, const ExportPiece *piece, Error *e)
{
    (void)e;
    GlbWriter *writer = user;
    int64_t all = piece->surface->mesh->vertex_count;
    for (int64_t first = 0; first < all && !run_is_cancelled(writer->glb->run);
         first += EXPORT_BLOCK) {
        int64_t count = all - first < EXPORT_BLOCK ? all - first : EXPORT_BLOCK;
        export_surface_vertices(piece->surface, piece->place, piece->variation, first, count,
                                writer->glb->run->threads, writer->block);
        for (int64_t i = 0; i < count; i++) {
            write_vertex(writer, &writer->block[i]);
        }
    }
    return true;
}

static bool write_triangles(void *user, const ExportPiece *piece, Error *e)
{
    (void)e;
    GlbWriter *writer = user;
    const Mesh *mesh = piece->surface->mesh;
    bool mirrored = piece->place && export_is_mirror(piece->place);
    for (int64_t f = 0; f < mesh->face_count; f++) {
        uint32_t corner[6];
        int count = 3 * export_face_triangles(mesh, f, mirrored, corner);
        for (int k = 0; k < count; k++) {
            corner[k] += (uint32_t)writer->vertices;
        }
        char *at = file_writer_room(writer->file, (size_t)count * sizeof *corner);
        if (at) {
            memcpy(at, corner, (size_t)count * sizeof *corner);
        }
    }
    writer->vertices += mesh->vertex_count;
    return true;
}

// Positions, then rotations, then scales: of whole arrays.
static void write_instances(const GlbWriter *writer)
{
    const Part *part = &writer->glb->source->world->geometry.part[writer->part->index];
    for (int kind = 0; kind < 3; kind++) {
        for (int64_t i = 0; i < part->instance_count; i++) {
            Placement p;
            placement_from_transform(&part->instance[i], &p); // planned: it can
            if (kind == 1) {
                file_writer_bytes(writer->file, p.rotation, sizeof p.rotation);
            } else {
                Vec3 v = kind == 0 ? p.position : p.scale;
                file_writer_bytes(writer->file, &v, sizeof v);
            }
        }
    }
}

static bool write_part(GlbWriter *writer, Error *e)
{
    const Glb *glb = writer->glb;
    const GlbPart *part = writer->part;
    const World *world = glb->source->world;
    const Material *material = &world->material[world->geometry.part[part->index].material];
    bool flat = part->placing == GLB_FLAT;
    writer->vertices = 0;
    writer->white = !glb_colors_are_base(glb, material);
    unsigned wants = part->color && !writer->white ? EXPORT_WANTS_COLORS : 0;
    bool done =
        export_part_pieces(glb->source, part->index, flat, wants, glb->run, write_vertices, writer,
                           e) &&
        export_part_pieces(glb->source, part->index, flat, 0, glb->run, write_triangles, writer, e);
    if (done && part->placing == GLB_GPU) {
        write_instances(writer);
    }
    return done;
}

static void write_images(const Glb *glb, FileWriter *file)
{
    for (int64_t i = 0; i < glb->image_count; i++) {
        int64_t size = glb->image[i].size;
        file_writer_bytes(file, glb->image[i].bytes, (size_t)size);
        file_writer_bytes(file, "\0\0\0", (size_t)(((size + 3) & ~(int64_t)3) - size));
    }
}

static bool write_buffer(const Glb *glb, FileWriter *file, Error *e)
{
    GlbWriter writer = {.glb = glb, .file = file};
    writer.block = memory_alloc(EXPORT_BLOCK, sizeof *writer.block, e);
    bool done = writer.block;
    for (int64_t i = 0; done && i < glb->part_count; i++) {
        writer.part = &glb->part[i];
        run_progress(glb->run, "write",
                     0.2 + 0.8 * (double)writer.part->vertex_at / (double)glb->buffer_size);
        done = write_part(&writer, e);
    }
    if (done) {
        write_images(glb, file);
    }
    free(writer.block);
    return done;
}

// A chunk: its length, what it is ("JSON" or "BIN\0"), its bytes.
static void write_chunk_head(FileWriter *file, int64_t size, const char kind[4])
{
    uint32_t length = (uint32_t)size;
    file_writer_bytes(file, &length, sizeof length);
    file_writer_bytes(file, kind, 4);
}

static bool write_file(const Glb *glb, const char *name, const char *json, size_t json_size,
                       Error *e)
{
    enum { HEADER = 12, CHUNK = 8 };
    int64_t padded = ((int64_t)json_size + 3) & ~(int64_t)3;
    int64_t whole = HEADER + CHUNK + padded + (glb->buffer_size > 0 ? CHUNK + glb->buffer_size : 0);
    if (whole > UINT32_MAX) {
        return too_large(e, (double)whole);
    }
    FileWriter *file = file_writer_open(name, e);
    if (!file) {
        return false;
    }
    uint32_t header[3] = {0x46546c67, 2, (uint32_t)whole}; // "glTF"
    file_writer_bytes(file, header, sizeof header);
    write_chunk_head(file, padded, "JSON");
    file_writer_bytes(file, json, json_size);
    file_writer_bytes(file, "   ", (size_t)(padded - (int64_t)json_size));
    bool done = true;
    if (glb->buffer_size > 0) {
        write_chunk_head(file, glb->buffer_size, "BIN");
        done = write_buffer(glb, file, e);
    }
    return file_writer_close(file, done, e);
}

bool export_glb(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    Glb glb = {.source = source, .run = run};
    size_t size = 0;
    char *json = NULL;
    bool done = plan(&glb, e);
    if (done) {
        warn_of_placing(&glb);
        json = glb_json(&glb, &size, e);
        done = json && write_file(&glb, file, json, size, e);
    }
    for (int64_t i = 0; i < glb.image_count; i++) {
        free(glb.image[i].bytes);
    }
    free(json);
    free(glb.image);
    free(glb.material);
    free(glb.part);
    return done;
}
