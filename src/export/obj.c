// Wavefront OBJ with its materials (.mtl) beside it: an object (o) for each object of the scene, a
// group (g) for each part. Positions are followed by pattern colours (sRGB); texture coordinates
// and normals are written if a part has them. Instances are written out, curves as tubes.
#include "export/formats.h"

#include "base/file_writer.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "export/asset_path.h"
#include "export/mtl.h"
#include "export/pieces.h"
#include "render/world.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct ObjWriter {
    const ExportSource *source;
    const Run *run;
    FileWriter *writer;
    ExportVertex *block;            // EXPORT_BLOCK
    char (*material)[MTL_NAME];     // names
    int64_t vertices, uvs, normals; // written so far
    int64_t part;                   // current; -1 = none yet
    int object;                     // likewise
} ObjWriter;

enum { LINE = 4 + 6 * (FLOAT_TEXT_MOST + 1), FACE = 3 + 12 * (INTEGER_TEXT_MOST + 1) };

static char *put_line(char *at, const char *keyword, const float *value, int count)
{
    while (*keyword) {
        *at++ = *keyword++;
    }
    at = floats_text(at, value, count, ' ');
    *at++ = '\n';
    return at;
}

// 0..1 in the fewest digits that tell 8-bit values apart.
static float short_channel(float value)
{
    return (float)(int)(value * 1000.0f + 0.5f) / 1000.0f;
}

static float srgb_channel(float linear)
{
    return short_channel((float)export_srgb8(linear) * (1.0f / 255.0f));
}

static char *put_position(const ObjWriter *obj, const ExportVertex *v, char *at)
{
    ExportColors colors = obj->source->options.colors;
    float numbers[6] = {v->position.x, v->position.y, v->position.z};
    if (colors == EXPORT_COLORS_GROWTH) { // data, not encoded as sRGB
        numbers[3] = short_channel(v->growth.x);
        numbers[4] = short_channel(v->growth.y);
        numbers[5] = short_channel(v->growth.z);
    } else {
        numbers[3] = srgb_channel(v->color.x);
        numbers[4] = srgb_channel(v->color.y);
        numbers[5] = srgb_channel(v->color.z);
    }
    return put_line(at, "v ", numbers, colors == EXPORT_COLORS_NONE ? 3 : 6);
}

static void write_vertices(ObjWriter *obj, const ExportPiece *piece)
{
    const Mesh *mesh = piece->surface->mesh;
    int64_t all = mesh->vertex_count;
    for (int64_t first = 0; first < all && !run_is_cancelled(obj->run); first += EXPORT_BLOCK) {
        int64_t count = all - first < EXPORT_BLOCK ? all - first : EXPORT_BLOCK;
        export_surface_vertices(piece->surface, piece->place, piece->look, first, count,
                                obj->run->threads, obj->block);
        for (int64_t i = 0; i < count; i++) {
            const ExportVertex *v = &obj->block[i];
            char text[3 * LINE], *end = put_position(obj, v, text);
            if (mesh->uv) {
                end = put_line(end, "vt ", (const float[]){v->uv.x, v->uv.y}, 2);
            }
            if (mesh->normal) {
                end =
                    put_line(end, "vn ", (const float[]){v->normal.x, v->normal.y, v->normal.z}, 3);
            }
            file_writer_bytes(obj->writer, text, (size_t)(end - text));
        }
    }
}

static char *put_corner(const ObjWriter *obj, const Mesh *mesh, uint32_t v, char *at)
{
    *at++ = ' ';
    at = integer_text(at, obj->vertices + v + 1);
    if (mesh->uv || mesh->normal) {
        *at++ = '/';
    }
    if (mesh->uv) {
        at = integer_text(at, obj->uvs + v + 1);
    }
    if (mesh->normal) {
        *at++ = '/';
        at = integer_text(at, obj->normals + v + 1);
    }
    return at;
}

static void write_faces(ObjWriter *obj, const ExportPiece *piece)
{
    const Mesh *mesh = piece->surface->mesh;
    bool mirrored = piece->place && export_is_mirror(piece->place);
    int size = mesh->face_size;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        char text[FACE], *end = text;
        *end++ = 'f';
        for (int k = 0; k < size; k++) {
            end = put_corner(obj, mesh, mesh->index[f * size + (mirrored ? size - 1 - k : k)], end);
        }
        *end++ = '\n';
        file_writer_bytes(obj->writer, text, (size_t)(end - text));
    }
}

// A name is the rest of a line; some readers take its first word.
static void write_name(FileWriter *writer, const char *keyword, const char *name)
{
    file_writer_text(writer, keyword);
    for (; *name; name++) {
        file_writer_bytes(writer, (unsigned char)*name <= ' ' ? "_" : name, 1);
    }
}

static void begin_part(ObjWriter *obj, int64_t index)
{
    const Part *part = &obj->source->world->geometry.part[index];
    const char *object = obj->source->object_name[part->object];
    const char *material = obj->material[part->material];
    if (part->object != obj->object) {
        write_name(obj->writer, "o ", object);
        file_writer_text(obj->writer, "\n");
    }
    write_name(obj->writer, "g ", object);
    file_writer_print(obj->writer, "_%s_%lld\nusemtl %s\ns %s\n", material, (long long)index,
                      material, !part->mesh || part->mesh->normal ? "1" : "off");
    obj->object = part->object;
    obj->part = index;
}

static bool write_piece(void *user, const ExportPiece *piece, Error *e)
{
    (void)e;
    ObjWriter *obj = user;
    const Mesh *mesh = piece->surface->mesh;
    if (piece->part != obj->part) {
        begin_part(obj, piece->part);
    }
    write_vertices(obj, piece);
    write_faces(obj, piece);
    obj->vertices += mesh->vertex_count;
    obj->uvs += mesh->uv ? mesh->vertex_count : 0;
    obj->normals += mesh->normal ? mesh->vertex_count : 0;
    return true;
}

static bool write_all(ObjWriter *obj, const char *library, Error *e)
{
    const char *slash = strrchr(library, '/');
    file_writer_text(obj->writer, "# written by ramify; metres, Y up\n");
    file_writer_print(obj->writer, "mtllib %s\n", slash ? slash + 1 : library);
    ExportColors colors = obj->source->options.colors;
    bool patterned = colors == EXPORT_COLORS_ALL || colors == EXPORT_COLORS_PATTERN;
    return export_all_pieces(obj->source, patterned ? EXPORT_WANTS_COLORS : 0, 0.0f, 1.0f, obj->run,
                             write_piece, obj, e);
}

// Writes both files or neither: both are complete on disk before either takes its name.
static bool write_both(ObjWriter *obj, const char *file, const char *library, Error *e)
{
    obj->writer = file_writer_open(file, e);
    FileWriter *materials = obj->writer ? file_writer_open(library, e) : NULL;
    bool done = materials && mtl_write(materials, obj->source, obj->material, library, e) &&
                write_all(obj, library, e);
    done = done && file_writer_settle(obj->writer, e);
    done = file_writer_close(materials, done, e);
    return file_writer_close(obj->writer, done, e);
}

static bool write(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    char *library = asset_beside(file, ".mtl", e);
    ObjWriter obj = {.source = source, .run = run, .part = -1, .object = -1};
    obj.material = library ? mtl_names(source->world, e) : NULL;
    obj.block = obj.material ? memory_alloc(EXPORT_BLOCK, sizeof *obj.block, e) : NULL;
    bool done = false;
    if (obj.block) {
        export_warn_of_instances(source, run);
        done = write_both(&obj, file, library, e);
    }
    free(obj.block);
    free(obj.material);
    free(library);
    return done;
}

const ExportFormat obj_format = {".obj", "meshes with materials beside it (.mtl)", 0, EXPORT_WORLD,
                                 write};
