#include "export/gltf/glb.h"

#include "base/memory.h"
#include "base/number_text.h"
#include "base/text_stream.h"

#include <inttypes.h>
#include <stdlib.h>

enum {
    BYTE_ARRAY = 34962,
    BYTE_ELEMENTS = 34963,
    TYPE_USHORT = 5123,
    TYPE_UINT = 5125,
    TYPE_FLOAT = 5126
};

// ---- pieces

void json_put_float(FILE *json, float value)
{
    char text[FLOAT_TEXT_MOST + 1];
    *float_text(text, value) = 0;
    fputs(text, json);
}

void json_put_floats(FILE *json, const char *key, const float *value, int count)
{
    fprintf(json, "\"%s\":[", key);
    for (int i = 0; i < count; i++) {
        if (i > 0) {
            fputc(',', json);
        }
        json_put_float(json, value[i]);
    }
    fputc(']', json);
}

void json_put_color(FILE *json, const char *key, Vec3 value)
{
    json_put_floats(json, key, (const float[]){value.x, value.y, value.z}, 3);
}

// ---- buffers

int64_t glb_part_accessors(const GlbPart *part)
{
    return 2 + part->normal + part->uv + part->glow + part->color + part->growth + part->radius +
           part->birth + (part->placing == GLB_GPU ? 3 : 0);
}

int64_t glb_part_views(const GlbPart *part)
{
    return part->placing == GLB_GPU ? 5 : 2;
}

int64_t glb_instance_count(const Glb *glb, const GlbPart *part)
{
    return glb->source->world->geometry.part[part->index].instance_count;
}

static void put_view(FILE *json, int64_t at, int64_t size, const char *more)
{
    fprintf(json, "{\"buffer\":0,\"byteOffset\":%" PRId64 ",\"byteLength\":%" PRId64 "%s}", at,
            size, more);
}

static void put_part_views(const Glb *glb, const GlbPart *part, FILE *json)
{
    char more[64];
    snprintf(more, sizeof more, ",\"byteStride\":%d,\"target\":%d", part->stride, BYTE_ARRAY);
    put_view(json, part->vertex_at, part->vertices * part->stride, more);
    snprintf(more, sizeof more, ",\"target\":%d", BYTE_ELEMENTS);
    fputs(",\n", json);
    put_view(json, part->index_at, part->triangles * 12, more);
    if (part->placing == GLB_GPU) {
        int64_t count = glb_instance_count(glb, part), at = part->instance_at;
        for (int kind = 0; kind < 3; kind++) {
            int64_t size = count * (kind == 1 ? 16 : 12);
            fputs(",\n", json);
            put_view(json, at, size, "");
            at += size;
        }
    }
}

static void put_views(const Glb *glb, FILE *json)
{
    fputs(",\n\"bufferViews\":[", json);
    for (int64_t i = 0; i < glb->part_count; i++) {
        fputs(i > 0 ? ",\n" : "\n", json);
        put_part_views(glb, &glb->part[i], json);
    }
    for (int64_t i = 0; i < glb->image_count; i++) {
        fputs(i > 0 || glb->part_count > 0 ? ",\n" : "\n", json);
        put_view(json, glb->image[i].at, glb->image[i].size, "");
    }
    fprintf(json, "],\n\"buffers\":[{\"byteLength\":%" PRId64 "}]", glb->buffer_size);
}

// The accessors of one part, one after the other.
typedef struct AccessorList {
    FILE *json;
    int64_t view, count; // of vertices or instances
    int offset;          // of the next, within a vertex
    bool first;
} AccessorList;

static void put_accessor(AccessorList *list, const char *type, int component, int bytes,
                         const char *more)
{
    fprintf(list->json,
            "%s{\"bufferView\":%" PRId64
            ",\"byteOffset\":%d,\"componentType\":%d,\"count\":%" PRId64 ",\"type\":\"%s\"%s",
            list->first ? "" : ",\n", list->view, list->offset, component, list->count, type, more);
    list->first = false;
    list->offset += bytes;
}

static void put_vertex_accessors(AccessorList *list, const GlbPart *part)
{
    FILE *json = list->json;
    put_accessor(list, "VEC3", TYPE_FLOAT, 12, ",");
    json_put_color(json, "min", part->bounds.low);
    fputc(',', json);
    json_put_color(json, "max", part->bounds.high);
    fputc('}', json);
    if (part->normal) {
        put_accessor(list, "VEC3", TYPE_FLOAT, 12, "}");
    }
    if (part->uv) {
        put_accessor(list, "VEC2", TYPE_FLOAT, 8, "}");
    }
    if (part->glow) {
        put_accessor(list, "VEC2", TYPE_FLOAT, 8, "}");
    }
    for (int i = 0; i < part->color + part->growth; i++) {
        put_accessor(list, "VEC4", TYPE_USHORT, 8, ",\"normalized\":true}");
    }
    for (int i = 0; i < part->radius + part->birth; i++) {
        put_accessor(list, "SCALAR", TYPE_FLOAT, 4, "}");
    }
}

static void put_accessors(const Glb *glb, FILE *json)
{
    AccessorList list = {.json = json, .first = true};
    int64_t view = 0;
    fputs(",\n\"accessors\":[\n", json);
    for (int64_t i = 0; i < glb->part_count; i++) {
        const GlbPart *part = &glb->part[i];
        list.view = view;
        list.count = part->vertices;
        list.offset = 0;
        put_vertex_accessors(&list, part);
        list.view++;
        list.count = part->triangles * 3;
        list.offset = 0;
        put_accessor(&list, "SCALAR", TYPE_UINT, 0, "}");
        for (int kind = 0; kind < 3 && part->placing == GLB_GPU; kind++) {
            list.view++;
            list.count = glb_instance_count(glb, part);
            put_accessor(&list, kind == 1 ? "VEC4" : "VEC3", TYPE_FLOAT, 0, "}");
        }
        view += glb_part_views(part);
    }
    fputc(']', json);
}

// ---- meshes

static void put_attributes(const GlbPart *part, FILE *json, int64_t accessor)
{
    fprintf(json, "\"POSITION\":%" PRId64, accessor++);
    if (part->normal) {
        fprintf(json, ",\"NORMAL\":%" PRId64, accessor++);
    }
    if (part->uv) {
        fprintf(json, ",\"TEXCOORD_0\":%" PRId64, accessor++);
    }
    if (part->glow) {
        fprintf(json, ",\"TEXCOORD_1\":%" PRId64, accessor++);
    }
    if (part->color) {
        fprintf(json, ",\"COLOR_0\":%" PRId64, accessor++);
    }
    if (part->growth) {
        fprintf(json, ",\"COLOR_%d\":%" PRId64, part->color, accessor++);
    }
    if (part->radius) {
        fprintf(json, ",\"_RADIUS\":%" PRId64, accessor++);
    }
    if (part->birth) {
        fprintf(json, ",\"_BIRTH\":%" PRId64, accessor);
    }
}

void glb_put_part_name(const Glb *glb, const GlbPart *part, FILE *json)
{
    const Part *own = &glb->source->world->geometry.part[part->index];
    char name[320];
    snprintf(name, sizeof name, "%s %s", glb->source->object_name[own->object],
             glb->source->world->material[own->material].name);
    fputs("\"name\":", json);
    json_put_string(json, name);
}

static void put_meshes(const Glb *glb, FILE *json)
{
    int64_t accessor = 0;
    fputs(",\n\"meshes\":[", json);
    for (int64_t i = 0; i < glb->part_count; i++) {
        const GlbPart *part = &glb->part[i];
        int64_t places = part->placing == GLB_GPU ? 3 : 0;
        fputs(i > 0 ? ",\n{" : "\n{", json);
        glb_put_part_name(glb, part, json);
        fputs(",\"primitives\":[{\"attributes\":{", json);
        put_attributes(part, json, accessor);
        int64_t next = accessor + glb_part_accessors(part);
        int material = glb->source->world->geometry.part[part->index].material;
        fprintf(json, "},\"indices\":%" PRId64 ",\"material\":%d}]}", next - places - 1,
                glb->material[material]);
        accessor = next;
    }
    fputc(']', json);
}

// ---- the whole

static bool any_gpu(const Glb *glb)
{
    bool any = false;
    for (int64_t i = 0; i < glb->part_count; i++) {
        any = any || glb->part[i].placing == GLB_GPU;
    }
    return any;
}

// Required extensions: a reader without instancing would show one instance of each. False when out
// of memory.
static bool put_extensions(const Glb *glb, FILE *json, Error *e)
{
    bool gpu = any_gpu(glb);
    size_t size = 0;
    FILE *list;
    TextStream *stream = text_stream_new(&list, e);
    if (!stream) {
        return false;
    }
    glb_put_material_extensions(glb, list);
    fputs(glb_light_count(glb) > 0 ? "\"KHR_lights_punctual\"," : "", list);
    fputs(gpu ? "\"EXT_mesh_gpu_instancing\"," : "", list);
    char *text = text_stream_close(stream, &size, e);
    if (text && size > 0) {
        fprintf(json, ",\n\"extensionsUsed\":[%.*s]", (int)size - 1, text);
    }
    fputs(gpu ? ",\n\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"]" : "", json);
    bool done = text;
    free(text);
    return done;
}

char *glb_json(const Glb *glb, size_t *size, Error *e)
{
    FILE *json;
    TextStream *stream = text_stream_new(&json, e);
    if (!stream) {
        return NULL;
    }
    fputs("{\"asset\":{\"version\":\"2.0\",\"generator\":\"ramify\"}", json);
    bool good = put_extensions(glb, json, e);
    glb_put_nodes(glb, json);
    glb_put_camera(glb, json);
    if (glb_light_count(glb) > 0) {
        glb_put_lights(glb, json);
    }
    if (glb->part_count > 0) {
        put_meshes(glb, json);
        put_accessors(glb, json);
        glb_put_materials(glb, json);
        put_views(glb, json);
    }
    fputs("}", json);
    char *text = text_stream_close(stream, size, good ? e : NULL);
    if (!good) {
        free(text);
        return NULL;
    }
    return text;
}
