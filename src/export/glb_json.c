#include "export/glb.h"

#include "base/memory.h"
#include "base/number_text.h"
#include "export/placement.h"

#include <inttypes.h>
#include <stdlib.h>

// Radiances are in watts, glTF's lights in lumens, which its readers take for 1/683 W each.
static const float LUMENS_PER_WATT = 683.0f;

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

void json_put_string(FILE *json, const char *text)
{
    fputc('"', json);
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\') {
            fprintf(json, "\\%c", c);
        } else if (c < ' ') {
            fprintf(json, "\\u%04x", c);
        } else {
            fputc(c, json);
        }
    }
    fputc('"', json);
}

// ---- buffers

static int64_t part_accessors(const GlbPart *part)
{
    return 2 + part->normal + part->uv + part->color + part->growth + part->radius + part->birth +
           (part->placing == GLB_GPU ? 3 : 0);
}

int64_t glb_part_views(const GlbPart *part)
{
    return part->placing == GLB_GPU ? 5 : 2;
}

static int64_t instance_count(const Glb *glb, const GlbPart *part)
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
        int64_t count = instance_count(glb, part), at = part->instance_at;
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
            list.count = instance_count(glb, part);
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

static void put_part_name(const Glb *glb, const GlbPart *part, FILE *json)
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
        put_part_name(glb, part, json);
        fputs(",\"primitives\":[{\"attributes\":{", json);
        put_attributes(part, json, accessor);
        int64_t next = accessor + part_accessors(part);
        int material = glb->source->world->geometry.part[part->index].material;
        fprintf(json, "},\"indices\":%" PRId64 ",\"material\":%d}]}", next - places - 1,
                glb->material[material]);
        accessor = next;
    }
    fputc(']', json);
}

// ---- nodes: those of parts, of objects, of the camera, of lights

static int64_t part_nodes(const Glb *glb, const GlbPart *part)
{
    return part->placing == GLB_NODES ? instance_count(glb, part) : 1;
}

static void put_placement(FILE *json, const Placement *p)
{
    fputc(',', json);
    json_put_color(json, "translation", p->position);
    fputc(',', json);
    json_put_floats(json, "rotation", p->rotation, 4);
    fputc(',', json);
    json_put_color(json, "scale", p->scale);
}

// Of a thing that looks along -z.
static void put_looking(FILE *json, Vec3 position, Vec3 x, Vec3 back)
{
    Transform t = transform_from_axes(x, vec3_cross(back, x), back, position);
    Placement p;
    if (placement_from_transform(&t, &p)) {
        p.scale = vec3_splat(1.0f);
        fputc(',', json);
        json_put_color(json, "translation", p.position);
        fputc(',', json);
        json_put_floats(json, "rotation", p.rotation, 4);
    }
}

static void put_part_nodes(const Glb *glb, int64_t mesh, int64_t accessor, FILE *json)
{
    const GlbPart *part = &glb->part[mesh];
    const Transform *place = glb->source->world->geometry.part[part->index].instance;
    for (int64_t i = 0; i < part_nodes(glb, part); i++) {
        fprintf(json, "%s\n{", mesh > 0 || i > 0 ? "," : "");
        if (part->placing != GLB_NODES) {
            put_part_name(glb, part, json);
            fputc(',', json);
        }
        fprintf(json, "\"mesh\":%" PRId64, mesh);
        if (part->placing == GLB_NODES) {
            Placement p;
            placement_from_transform(&place[i], &p); // planned: it can
            put_placement(json, &p);
        } else if (part->placing == GLB_GPU) {
            fprintf(json,
                    ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":"
                    "%" PRId64 ",\"ROTATION\":%" PRId64 ",\"SCALE\":%" PRId64 "}}}",
                    accessor - 3, accessor - 2, accessor - 1);
        }
        fputc('}', json);
    }
}

// The object's node with the nodes of its parts; false where it has none.
static bool put_object_node(const Glb *glb, int object, FILE *json)
{
    int64_t node = 0;
    bool any = false;
    for (int64_t i = 0; i < glb->part_count; i++) {
        const GlbPart *part = &glb->part[i];
        int64_t count = part_nodes(glb, part);
        bool own = glb->source->world->geometry.part[part->index].object == object;
        for (int64_t k = 0; k < count && own; k++) {
            if (!any) {
                fputs(",\n{\"name\":", json);
                json_put_string(json, glb->source->object_name[object]);
                fputs(",\"children\":[", json);
            }
            fprintf(json, "%s%" PRId64, any ? "," : "", node + k);
            any = true;
        }
        node += count;
    }
    if (any) {
        fputs("]}", json);
    }
    return any;
}

static void put_camera_node(const Glb *glb, FILE *json)
{
    const Camera *camera = &glb->source->world->camera;
    Vec3 back = vec3_normalize(vec3_sub(camera->position, camera->target));
    Vec3 right = vec3_cross(camera->up, back);
    right = vec3_dot(right, right) > 1e-12f ? vec3_normalize(right) : vec3_perpendicular(back);
    fprintf(json, "%s\n{\"name\":\"camera\",\"camera\":0", glb->part_count > 0 ? "," : "");
    put_looking(json, camera->position, right, back);
    fputc('}', json);
}

// ---- camera and lights

static bool has_sun(const Glb *glb)
{
    Vec3 r = glb->sun.radiance;
    return r.x + r.y + r.z > 0.0f;
}

static int light_count(const Glb *glb)
{
    return glb->source->world->light_count + has_sun(glb);
}

static void put_camera(const Glb *glb, FILE *json)
{
    const World *world = glb->source->world;
    float distance = vec3_distance(world->camera.position, world->camera.target);
    float aspect = (float)world->film.width / (float)world->film.height;
    fputs(",\n\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":", json);
    json_put_float(json, world->camera.fov * RADIANS_PER_DEGREE);
    fputs(",\"aspectRatio\":", json);
    json_put_float(json, aspect);
    fputs(",\"znear\":", json); // readers need planes; what they cut off is far from the subject
    json_put_float(json, fmaxf(1e-3f * distance, 1e-5f));
    fputs(",\"zfar\":", json);
    json_put_float(json, fmaxf(1e4f * distance, 1.0f));
    fputs("}}]", json);
}

static void put_light_power(FILE *json, Vec3 power)
{
    float most = fmaxf(power.x, fmaxf(power.y, power.z));
    Vec3 color = most > 0.0f ? vec3_scale(power, 1.0f / most) : vec3_splat(1.0f);
    json_put_color(json, "color", vec3_min(color, vec3_splat(1.0f)));
    fputs(",\"intensity\":", json);
    json_put_float(json, LUMENS_PER_WATT * most);
}

// Far away a sphere is a point, a quad a spot that shines to one side.
static void put_light(const Light *light, FILE *json)
{
    bool quad = light->kind == LIGHT_QUAD;
    float area = quad ? vec3_length(vec3_cross(light->edge_u, light->edge_v))
                      : PI_F * light->radius * light->radius;
    fprintf(json, "{\"type\":\"%s\",", quad ? "spot" : "point");
    put_light_power(json, vec3_scale(light->radiance, area));
    fputs(quad ? ",\"spot\":{\"innerConeAngle\":0,\"outerConeAngle\":1.5707963}}" : "}", json);
}

static void put_lights(const Glb *glb, FILE *json)
{
    const World *world = glb->source->world;
    fputs(",\n\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[", json);
    for (int i = 0; i < world->light_count; i++) {
        fputs(i > 0 ? ",\n" : "\n", json);
        put_light(&world->light[i], json);
    }
    if (has_sun(glb)) {
        fprintf(json, "%s\n{\"type\":\"directional\",", world->light_count > 0 ? "," : "");
        put_light_power(json, vec3_scale(glb->sun.radiance, glb->sun.solid_angle));
        fputc('}', json);
    }
    fputs("]}}", json);
}

static void put_light_nodes(const Glb *glb, FILE *json)
{
    const World *world = glb->source->world;
    for (int i = 0; i < light_count(glb); i++) {
        bool sun = i >= world->light_count;
        fprintf(json, ",\n{\"name\":\"%s\",\"extensions\":{\"KHR_lights_punctual\":{\"light\":%d}}",
                sun ? "sun" : "lamp", i);
        if (sun) {
            Vec3 back = glb->sun.direction;
            put_looking(json, vec3_splat(0.0f), vec3_perpendicular(back), back);
        } else if (world->light[i].kind == LIGHT_QUAD) {
            const Light *light = &world->light[i];
            Vec3 back = vec3_neg(vec3_normalize(vec3_cross(light->edge_u, light->edge_v)));
            Vec3 half = vec3_scale(vec3_add(light->edge_u, light->edge_v), 0.5f);
            put_looking(json, vec3_add(light->corner, half), vec3_perpendicular(back), back);
        } else {
            fputc(',', json);
            json_put_color(json, "translation", world->light[i].center);
        }
        fputc('}', json);
    }
}

static void put_nodes(const Glb *glb, FILE *json)
{
    int64_t accessor = 0, nodes = 0;
    fputs(",\n\"nodes\":[", json);
    for (int64_t i = 0; i < glb->part_count; i++) {
        accessor += part_accessors(&glb->part[i]);
        put_part_nodes(glb, i, accessor, json);
        nodes += part_nodes(glb, &glb->part[i]);
    }
    put_camera_node(glb, json);
    int64_t roots = 1 + light_count(glb);
    put_light_nodes(glb, json);
    for (int i = 0; i < glb->source->object_count; i++) {
        roots += put_object_node(glb, i, json);
    }
    fputs("],\n\"scene\":0,\n\"scenes\":[{\"nodes\":[", json);
    for (int64_t i = 0; i < roots; i++) {
        fprintf(json, "%s%" PRId64, i > 0 ? "," : "", nodes + i);
    }
    fputs("]}]", json);
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

// A reader that does not know of instances would show one of each: so they are required.
static void put_extensions(const Glb *glb, FILE *json)
{
    bool gpu = any_gpu(glb);
    char *text = NULL;
    size_t size = 0;
    FILE *list = open_memstream(&text, &size);
    if (!list) {
        return;
    }
    glb_put_material_extensions(glb, list);
    fputs(light_count(glb) > 0 ? "\"KHR_lights_punctual\"," : "", list);
    fputs(gpu ? "\"EXT_mesh_gpu_instancing\"," : "", list);
    fclose(list);
    if (text && size > 0) {
        fprintf(json, ",\n\"extensionsUsed\":[%.*s]", (int)size - 1, text);
    }
    fputs(gpu ? ",\n\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"]" : "", json);
    free(text);
}

char *glb_json(const Glb *glb, size_t *size, Error *e)
{
    char *text = NULL;
    FILE *json = open_memstream(&text, size);
    if (!json) {
        error_set(e, ERROR_MEMORY, "out of memory for the description of a GLB file");
        return NULL;
    }
    fputs("{\"asset\":{\"version\":\"2.0\",\"generator\":\"ramify\"}", json);
    put_extensions(glb, json);
    put_nodes(glb, json);
    put_camera(glb, json);
    if (light_count(glb) > 0) {
        put_lights(glb, json);
    }
    if (glb->part_count > 0) {
        put_meshes(glb, json);
        put_accessors(glb, json);
        glb_put_materials(glb, json);
        put_views(glb, json);
    }
    fputs("}", json);
    bool good = !ferror(json);
    good = fclose(json) == 0 && good;
    if (!good) {
        error_set(e, ERROR_MEMORY, "out of memory for the description of a GLB file");
        free(text);
        return NULL;
    }
    return text;
}
