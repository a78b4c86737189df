// GLB: glTF 2.0 in one file: a header, the JSON that describes the scene, and one buffer. The
// buffer holds the vertices (interleaved) and triangles of each part, tables of many instances, and
// pictures. Everything is planned first, because the JSON precedes what it describes, and then
// streamed.
#include "export/gltf/glb.h"

#include "base/file_writer.h"
#include "base/memory.h"
#include "export/formats.h"
#include "export/placement.h"
#include "export/vertex_colors.h"

#include <stdlib.h>
#include <string.h>

typedef struct GlbWriter {
    const Glb *glb;
    const GlbPart *part;
    FileWriter *file;
    ExportVertex *block; // EXPORT_BLOCK
    int64_t vertices;    // of the part's pieces before
    bool white;          // COLOR_0
    float strongest;     // of the material's glows
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
    if (part->glow) {
        at = put_floats(at, (const float[]){glb_ramp_place(v->glow / writer->strongest), 0.5f}, 2);
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
        export_surface_vertices(piece->surface, piece->place, piece->look, first, count,
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
            placement_from_transform(&part->instance[i], &p); // cannot fail: checked while planning
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
    writer->white = !vertex_colors_wanted(&glb->source->options, material);
    writer->strongest = glb->strongest[world->geometry.part[part->index].material];
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

// The head of a chunk: its length and type ("JSON" or "BIN\0").
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
        return glb_too_large(e, (double)whole);
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

static bool write(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    Glb glb = {.source = source, .run = run};
    size_t size = 0;
    char *json = NULL;
    bool done = glb_plan(&glb, e);
    if (done) {
        json = glb_json(&glb, &size, e);
        done = json && write_file(&glb, file, json, size, e);
    }
    for (int64_t i = 0; i < glb.image_count; i++) {
        free(glb.image[i].bytes);
    }
    free(json);
    free(glb.image);
    free(glb.material);
    free(glb.strongest);
    free(glb.part);
    return done;
}

const ExportFormat glb_format = {".glb", "glTF 2.0 in one file: meshes, materials, camera, lights",
                                 0, EXPORT_WORLD, write};
