#include "export/gltf/glb.h"

#include "export/placement.h"

#include <inttypes.h>

// Radiances are in watts, glTF's lights in lumens; readers take a lumen for 1/683 W.
static const float LUMENS_PER_WATT = 683.0f;

// ---- nodes: those of parts, of objects, of the camera, of lights

static int64_t part_nodes(const Glb *glb, const GlbPart *part)
{
    int64_t count = glb_instance_count(glb, part);
    return part->placing == GLB_NODES ? count : part->placing == GLB_PAIRS ? 2 * count : 1;
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

// The rotation of an object that looks along -z.
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

// Node number `node`, and the node inside it that has the mesh.
static void put_pair(FILE *json, int64_t node, int64_t mesh, const Transform *place)
{
    Placement p;
    float turn[4];
    placement_of_turned(place, turn, &p); // planned: it can
    fprintf(json, "{\"children\":[%" PRId64 "]", node + 1);
    put_placement(json, &p);
    fprintf(json, "},\n{\"mesh\":%" PRId64 ",", mesh);
    json_put_floats(json, "rotation", turn, 4);
    fputc('}', json);
}

static void put_instance(FILE *json, int64_t mesh, const Transform *place)
{
    Placement p;
    placement_from_transform(place, &p); // planned: it can
    fprintf(json, "{\"mesh\":%" PRId64, mesh);
    put_placement(json, &p);
    fputc('}', json);
}

static void put_whole(const Glb *glb, int64_t mesh, int64_t accessor, FILE *json)
{
    const GlbPart *part = &glb->part[mesh];
    fputc('{', json);
    glb_put_part_name(glb, part, json);
    fprintf(json, ",\"mesh\":%" PRId64, mesh);
    if (part->placing == GLB_GPU) {
        fprintf(json,
                ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":"
                "%" PRId64 ",\"ROTATION\":%" PRId64 ",\"SCALE\":%" PRId64 "}}}",
                accessor - 3, accessor - 2, accessor - 1);
    }
    fputc('}', json);
}

// accessor: the first after the part's own; node: number of the part's first node.
static void put_part_nodes(const Glb *glb, int64_t mesh, int64_t accessor, int64_t node, FILE *json)
{
    const GlbPart *part = &glb->part[mesh];
    const Transform *place = glb->source->world->geometry.part[part->index].instance;
    int step = part->placing == GLB_PAIRS ? 2 : 1;
    for (int64_t i = 0; i < part_nodes(glb, part); i += step) {
        fputs(node + i > 0 ? ",\n" : "\n", json);
        if (part->placing == GLB_PAIRS) {
            put_pair(json, node + i, mesh, &place[i / 2]);
        } else if (part->placing == GLB_NODES) {
            put_instance(json, mesh, &place[i]);
        } else {
            put_whole(glb, mesh, accessor, json);
        }
    }
}

// The object's node with the nodes of its parts; false if it has none.
static bool put_object_node(const Glb *glb, int object, FILE *json)
{
    int64_t node = 0;
    bool any = false;
    for (int64_t i = 0; i < glb->part_count; i++) {
        const GlbPart *part = &glb->part[i];
        int64_t count = part_nodes(glb, part);
        bool own = glb->source->world->geometry.part[part->index].object == object;
        for (int64_t k = 0; k < count && own; k += part->placing == GLB_PAIRS ? 2 : 1) {
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

int glb_light_count(const Glb *glb)
{
    return glb->source->world->light_count + has_sun(glb);
}

void glb_put_camera(const Glb *glb, FILE *json)
{
    const World *world = glb->source->world;
    float distance = vec3_distance(world->camera.position, world->camera.target);
    float aspect = (float)world->film.width / (float)world->film.height;
    fputs(",\n\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":", json);
    json_put_float(json, world->camera.fov * RADIANS_PER_DEGREE);
    fputs(",\"aspectRatio\":", json);
    json_put_float(json, aspect);
    fputs(",\"znear\":", json); // readers need clipping planes
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

// From afar, a sphere is a point and a quad a spot that emits to one side.
static void put_light(const Light *light, FILE *json)
{
    bool quad = light->kind == LIGHT_QUAD;
    float area = quad ? vec3_length(vec3_cross(light->edge_u, light->edge_v))
                      : PI_F * light->radius * light->radius;
    fprintf(json, "{\"type\":\"%s\",", quad ? "spot" : "point");
    put_light_power(json, vec3_scale(light->radiance, area));
    fputs(quad ? ",\"spot\":{\"innerConeAngle\":0,\"outerConeAngle\":1.5707963}}" : "}", json);
}

void glb_put_lights(const Glb *glb, FILE *json)
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
    for (int i = 0; i < glb_light_count(glb); i++) {
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

void glb_put_nodes(const Glb *glb, FILE *json)
{
    int64_t accessor = 0, nodes = 0;
    fputs(",\n\"nodes\":[", json);
    for (int64_t i = 0; i < glb->part_count; i++) {
        accessor += glb_part_accessors(&glb->part[i]);
        put_part_nodes(glb, i, accessor, nodes, json);
        nodes += part_nodes(glb, &glb->part[i]);
    }
    put_camera_node(glb, json);
    int64_t roots = 1 + glb_light_count(glb);
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
