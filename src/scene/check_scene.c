// Checks of camera, film, lamps, and of the scene as a whole.
#include "config/hint.h"
#include "render/cloud/cloud.h"
#include "render/film.h"
#include "render/light/light.h"
#include "scene/builtin.h"
#include "scene/spec_check.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_PIXELS 100000000.0

// Vertical field of view of a lens on a full-frame sensor, 24 mm high.
static float fov_from_focal_length(float focal_length)
{
    return fminf(2.0f * atanf(12.0f / focal_length) / RADIANS_PER_DEGREE, 179.999f);
}

bool check_camera(const Mapping *mapping, void *params)
{
    Camera *camera = params;
    const Node *focal_length = node_get(mapping->given, "focal_length");
    if (focal_length && node_get(mapping->given, "fov")) {
        return load_fail(mapping->loader, focal_length,
                         "%s has both fov and focal_length; give one", mapping_path(mapping, NULL));
    }
    if (focal_length) {
        camera->fov = fov_from_focal_length(camera->fov);
    }
    Vec3 view = vec3_sub(camera->target, camera->position);
    if (!(vec3_length(view) > 0.0f)) {
        return mapping_fail(mapping, "target",
                            " is the camera's position; it must be another point");
    }
    Vec3 aside = vec3_cross(vec3_normalize(view), vec3_normalize(camera->up));
    return vec3_length(aside) > 1e-5f ||
           mapping_fail(
               mapping, "up",
               " is zero or parallel to the line of sight; it must have another direction");
}

bool check_film(const Mapping *mapping, void *params)
{
    const Scene *scene = params;
    const FilmParams *film = &scene->film;
    const float *crop = film->crop;
    double pixels = (double)film->width * film->height;
    if (pixels > MOST_PIXELS) {
        return load_fail(mapping->loader, node_place(mapping->given, "width"),
                         "%s has %.0f million pixels; it must have at most %.0f million",
                         mapping_path(mapping, NULL), pixels * 1e-6, MOST_PIXELS * 1e-6);
    }
    if (!(crop[2] > crop[0] && crop[3] > crop[1])) {
        return mapping_fail(mapping, "crop",
                            " is empty; it must be [x0, y0, x1, y1] with x0 < x1, y0 < y1");
    }
    PixelBox box = film_crop_pixels(film->width, film->height, crop);
    if (box.x0 >= box.x1 || box.y0 >= box.y1) {
        return mapping_fail(mapping, "crop",
                            " is less than half a pixel wide or high; make it larger");
    }
    if (film->width % scene->downsample || film->height % scene->downsample) {
        return mapping_fail(mapping, "downsample",
                            " is %d; it must divide the width of %d and the height of %d pixels",
                            scene->downsample, film->width, film->height);
    }
    return scene->png_depth == 8 || scene->png_depth == 16 ||
           mapping_fail(mapping, "png_depth", " is %d; it must be 8 or 16", scene->png_depth);
}

// Of a range of samples, others must be able to take the rest.
bool check_render(const Mapping *mapping, void *params)
{
    const RenderParams *render = params;
    int end = render_end(render);
    if (end > render->samples) {
        return mapping_fail(mapping, "end_sample", " is %d; it must be at most samples, %d", end,
                            render->samples);
    }
    if (render->first_sample >= end) {
        return mapping_fail(mapping, "first_sample", " is %d; it must be below %s, %d",
                            render->first_sample, render->end_sample > 0 ? "end_sample" : "samples",
                            end);
    }
    const char *limit = render->max_noise > 0.0f ? "noise" : "seconds";
    return !render_is_range(render) || !(render->max_noise > 0.0f || render->max_seconds > 0.0) ||
           mapping_fail(mapping, limit,
                        " is %g, which decides on the number of samples; a range of samples "
                        "(first_sample, end_sample) needs it known: set it to 0",
                        render->max_noise > 0.0f ? (double)render->max_noise : render->max_seconds);
}

bool check_light(const Mapping *mapping, void *params)
{
    const Light *light = params;
    return light->kind != LIGHT_QUAD ||
           vec3_length(vec3_cross(light->edge_u, light->edge_v)) > 0.0f ||
           load_fail(mapping->loader, node_place(mapping->given, "edge_u"),
                     "%s has edges that span no area; they must not be parallel or zero",
                     mapping_path(mapping, NULL));
}

bool check_target(const Mapping *mapping, void *params)
{
    const SceneTarget *target = params;
    return target->low <= target->high ||
           load_fail(mapping->loader, node_place(mapping->given, "low"),
                     "%s: low %g is above high %g; low must not exceed high",
                     mapping_path(mapping, NULL), target->low, target->high);
}

// ---- names ----

// Names are used in the paths of keys and in layer names.
static bool check_name(const Mapping *scene, const Node *name, const char *what)
{
    const char *text = name->text;
    bool plain = !isdigit((unsigned char)*text);
    for (const char *c = text; *c && plain; c++) {
        plain = isalnum((unsigned char)*c) || strchr("_- ", *c) || (unsigned char)*c >= 0x80;
    }
    return (plain && strlen(text) <= 63) ||
           load_fail(scene->loader, name,
                     "%s name '%.70s' is invalid; use at most 63 letters, digits, spaces, - and _, "
                     "and do not begin with a digit",
                     what, text);
}

static int compare_names(const void *a, const void *b)
{
    const Node *const *left = a, *const *right = b;
    int order = strcmp((*left)->text, (*right)->text);
    return order ? order : ((*left)->line > (*right)->line) - ((*left)->line < (*right)->line);
}

// Checks that names in a list of mappings are valid and unique.
static bool check_names(const Mapping *scene, const char *key, const char *what)
{
    const Node *list = node_get(scene->given, key);
    if (!list) {
        return true;
    }
    int count = 0;
    const Node **names = arena_alloc(scene->loader->arena,
                                     sizeof(Node *) * (size_t)(list->count + 1), scene->loader->e);
    for (const Node *entry = list->first; names && entry; entry = entry->next) {
        names[count] = node_get(entry, "name");
        if (!check_name(scene, names[count], what)) {
            return false;
        }
        count++;
    }
    if (names && count > 1) {
        qsort(names, (size_t)count, sizeof(Node *), compare_names);
    }
    for (int i = 1; names && i < count; i++) {
        if (strcmp(names[i - 1]->text, names[i]->text) == 0) {
            return load_fail(scene->loader, names[i],
                             "%s name '%s' is already used in line %d; names must be unique", what,
                             names[i]->text, names[i - 1]->line);
        }
    }
    return names;
}

enum { MOST_HINTED = 4096 }; // maximum number of names searched for a hint

// The first scalar below node with this text under a key that ends with "material"; NULL = none.
static const Node *find_reference(const Node *node, const char *text)
{
    for (const Node *child = node->first; child; child = child->next) {
        const char *end = child->key ? strstr(child->key, "material") : NULL;
        if (end && child->kind == NODE_SCALAR && strcmp(child->text, text) == 0) {
            return child;
        }
        const Node *below = find_reference(child, text);
        if (below) {
            return below;
        }
    }
    return NULL;
}

// Fails at a key that names a material that does not exist. where: "objects.oak".
static bool no_material(const Mapping *mapping, const Scene *scene, const char *where,
                        const Node *named)
{
    const char *names[MOST_HINTED];
    char hint[512];
    int count = 0;
    for (int i = 0; i < scene->material_count && count < MOST_HINTED; i++) {
        names[count++] = scene->materials[i].name;
    }
    for (int i = 0; builtin_material_at(i) && count < MOST_HINTED; i++) {
        names[count++] = builtin_material_at(i)->name;
    }
    hint_format(named->text, names, count, hint, sizeof hint);
    return load_fail(mapping->loader, named, "%s.%s: there is no material '%.60s'; %s", where,
                     named->key, named->text, hint);
}

static bool check_materials(const Mapping *mapping, const Scene *scene)
{
    const Node *given = node_get(mapping->given, "objects")->first;
    for (int i = 0; i < scene->object_count; i++, given = given->next) {
        const SceneObject *object = &scene->objects[i];
        char where[96];
        snprintf(where, sizeof where, "objects.%.80s", object->name);
        for (const Key *row = object->kind->variant.beside; row->key; row++) {
            const char *name = pointer_at((const char *)object + row->offset);
            if (name && !scene_material(scene, name)) {
                return no_material(mapping, scene, where, node_get(given, row->key));
            }
        }
        const char *name;
        for (int k = 0; object->kind->further_material &&
                        (name = object->kind->further_material(object->params, k));
             k++) {
            const Node *named = scene_material(scene, name) ? NULL : find_reference(given, name);
            if (named) {
                return no_material(mapping, scene, where, named);
            }
        }
    }
    return true;
}

static bool can_be_layer(const Material *m)
{
    return (m->kind == MATERIAL_DIFFUSE || m->kind == MATERIAL_PRINCIPLED) && m->layer_count == 0;
}

// Layers are materials that can be mixed with the one below.
static bool check_layers(const Mapping *mapping, const Scene *scene)
{
    const Node *given = node_get(mapping->given, "materials");
    given = given ? given->first : NULL;
    for (int i = 0; given && i < scene->material_count; i++, given = given->next) {
        const Material *below = &scene->materials[i];
        const Node *layer = node_get(given, "layers");
        layer = layer ? layer->first : NULL;
        for (int k = 0; layer && k < below->layer_count; k++, layer = layer->next) {
            const Material *m = scene_material(scene, below->layers[k].material);
            const Node *named = node_get(layer, "material");
            char where[128];
            snprintf(where, sizeof where, "materials.%.63s.layers.%d", below->name, k);
            if (!m) {
                return no_material(mapping, scene, where, named);
            }
            if (!can_be_layer(m)) {
                return load_fail(mapping->loader, named,
                                 "%s.material: '%.60s' is no layer; it must be diffuse or "
                                 "principled and have no layers itself",
                                 where, m->name);
            }
        }
    }
    return true;
}

// Fails at a key that names an object that does not exist.
static bool no_object(const Mapping *mapping, const Scene *scene, const Node *named,
                      const char *where)
{
    const char *names[MOST_HINTED];
    char hint[512];
    int count = 0;
    for (; count < scene->object_count && count < MOST_HINTED; count++) {
        names[count] = scene->objects[count].name;
    }
    hint_format(named->text, names, count, hint, sizeof hint);
    return load_fail(mapping->loader, named, "%s: there is no object '%.60s'; %s", where,
                     named->text, hint);
}

// Checks that each target's object exists. (Its measures are known only after measuring.)
static bool check_targets(const Mapping *mapping, const Scene *scene)
{
    const Node *list = node_get(mapping->given, "targets"), *given = list ? list->first : NULL;
    for (int i = 0; given && i < scene->target_count; i++, given = given->next) {
        if (scene_find_object(scene, scene->targets[i].object) < 0) {
            return no_object(mapping, scene, node_get(given, "object"), "targets");
        }
    }
    return true;
}

// ---- neighbours

static const Node *object_key(const Mapping *mapping, int object, const char *key)
{
    const Node *given = node_get(mapping->given, "objects")->first;
    for (int i = 0; i < object; i++) {
        given = given->next;
    }
    return node_get(given, key);
}

static bool waits_for(const Scene *scene, int object, int other, int depth);

// Does growth that waits for object `next` wait for that of `other`?
static bool leads_to(const Scene *scene, int next, int other, int depth)
{
    return next == other || scene_objects_contend(&scene->objects[next], &scene->objects[other]) ||
           waits_for(scene, next, other, depth);
}

// Does the growth of `object` wait for that of `other`? Rivals wait for what any of them waits for.
// depth: of the recursion; a way without repetition visits no more than all objects.
static bool waits_for(const Scene *scene, int object, int other, int depth)
{
    for (int i = 0; depth <= scene->object_count && i < scene->object_count; i++) {
        const SceneObject *mate = &scene->objects[i];
        if (i != object && !scene_objects_contend(&scene->objects[object], mate)) {
            continue;
        }
        const char *name;
        for (int k = 0; (name = scene_object_waits_for(mate, k)); k++) {
            if (leads_to(scene, scene_find_object(scene, name), other, depth + 1)) {
                return true;
            }
        }
    }
    return false;
}

static bool check_obstacles(const Mapping *mapping, const Scene *scene, int index)
{
    const SceneObject *object = &scene->objects[index];
    const Node *list = object_key(mapping, index, "clear_of"), *given = list ? list->first : NULL;
    char where[128];
    snprintf(where, sizeof where, "objects.%s.clear_of", object->name);
    for (int i = 0; given && i < object->clear_of_count; i++, given = given->next) {
        const ClearOf *of = &object->clear_of[i];
        if (scene_find_object(scene, of->object) < 0) {
            return no_object(mapping, scene, node_get(given, "object"), where);
        }
        if (of->within > 0.0f && of->within <= of->distance) {
            return load_fail(mapping->loader, node_get(given, "within"),
                             "%s.%d.within is %g m; it must be above distance, %g m, or 0", where,
                             i, (double)of->within, (double)of->distance);
        }
    }
    return true;
}

// The name of the object that the object grows over (Kind.over), as the file gives it.
static const Node *over_key(const Mapping *mapping, const Scene *scene, int index)
{
    const Kind *kind = scene->objects[index].kind;
    const char *rest;
    return node_follow(object_key(mapping, index, kind_name(kind)), kind->over_key, &rest);
}

static bool check_over(const Mapping *mapping, const Scene *scene, int index)
{
    const SceneObject *object = &scene->objects[index];
    const char *over = scene_object_over(object);
    char where[192];
    snprintf(where, sizeof where, "objects.%s.%s.%s", object->name, kind_name(object->kind),
             over ? object->kind->over_key : "");
    return !over || scene_find_object(scene, over) >= 0 ||
           no_object(mapping, scene, over_key(mapping, scene, index), where);
}

// Fails at a key by which the object waits for itself.
static bool check_circle(const Mapping *mapping, const Scene *scene, int index)
{
    const SceneObject *object = &scene->objects[index];
    const char *name;
    for (int k = 0; (name = scene_object_waits_for(object, k)); k++) {
        if (leads_to(scene, scene_find_object(scene, name), index, 0)) {
            char key[64] = "clear_of";
            const Node *place = object_key(mapping, index, key);
            if (k == object->clear_of_count) {
                snprintf(key, sizeof key, "%s.%s", kind_name(object->kind), object->kind->over_key);
                place = over_key(mapping, scene, index);
            }
            return load_fail(mapping->loader, place,
                             "objects.%s.%s leads back to '%s' itself; one of the objects must "
                             "grow first",
                             object->name, key, object->name);
        }
    }
    return true;
}

static bool kind_contends(const Kind *kind)
{
    return kind->contends;
}

static bool kind_keeps_clear(const Kind *kind)
{
    return kind->keeps_clear;
}

// Refuses a key of an object whose kind would ignore it.
static bool check_kind(const Mapping *mapping, const Scene *scene, int index, const char *key,
                       bool (*able)(const Kind *kind))
{
    const SceneObject *object = &scene->objects[index];
    char list[256] = "";
    if (able(object->kind)) {
        return true;
    }
    for (int i = 0; kind_at(i); i++) {
        if (able(kind_at(i))) {
            size_t used = strlen(list);
            snprintf(list + used, sizeof list - used, "%s%s", used > 0 ? ", " : "",
                     kind_name(kind_at(i)));
        }
    }
    return load_fail(mapping->loader, object_key(mapping, index, key),
                     "objects.%s.%s: objects of kind %s ignore it; only these take it: %s",
                     object->name, key, kind_name(object->kind), list);
}

static bool check_keeps_room(const Mapping *mapping, const Scene *scene, int index)
{
    const SceneObject *object = &scene->objects[index];
    return (object->clear_of_count == 0 ||
            check_kind(mapping, scene, index, "clear_of", kind_keeps_clear)) &&
           (!object->contest || check_kind(mapping, scene, index, "contest", kind_contends));
}

static bool check_carried(const Mapping *mapping, const Scene *scene, int index)
{
    const SceneObject *object = &scene->objects[index];
    return object->deform_count == 0 || object->kind->carried ||
           load_fail(mapping->loader, object_key(mapping, index, "deform"),
                     "objects.%s.deform: objects of kind %s cannot be deformed; leave it out",
                     object->name, kind_name(object->kind));
}

static bool check_neighbours(const Mapping *mapping, const Scene *scene)
{
    bool done = true;
    for (int i = 0; done && i < scene->object_count; i++) {
        done = check_keeps_room(mapping, scene, i) && check_obstacles(mapping, scene, i) &&
               check_over(mapping, scene, i) && check_carried(mapping, scene, i);
    }
    for (int i = 0; done && i < scene->object_count; i++) {
        done = check_circle(mapping, scene, i);
    }
    return done;
}

// ---- clouds

// Fog that lies over a terrain needs one, spray falls or surf.
static bool check_clouds(const Mapping *mapping, const Scene *scene)
{
    const Node *list = node_get(mapping->given, "clouds");
    const Node *given = list ? list->first : NULL;
    for (int i = 0; given && i < scene->cloud_count; i++, given = given->next) {
        const char *over = scene->clouds[i].over;
        char where[64];
        snprintf(where, sizeof where, "clouds.%d.over", i);
        int object = over ? scene_find_object(scene, over) : -1;
        if (over && object < 0) {
            return no_object(mapping, scene, node_get(given, "over"), where);
        }
        const Kind *kind = over ? scene->objects[object].kind : NULL;
        bool sprays = scene->clouds[i].kind == CLOUD_SPRAY;
        if (sprays && !over) {
            snprintf(where, sizeof where, "clouds.%d", i);
            return load_fail(mapping->loader, given,
                             "%s: spray needs the key 'over': the terrain with waterfalls, the "
                             "cascade, or the sea with a bed, that throws it up",
                             where);
        }
        if (sprays && !kind->sprays) {
            return load_fail(mapping->loader, node_get(given, "over"),
                             "%s: object '%.60s' is of the kind %s; it must be a terrain with "
                             "waterfalls, a cascade or a sea with a bed",
                             where, over, kind_name(kind));
        }
        if (!sprays && over && !kind->heights) {
            return load_fail(mapping->loader, node_get(given, "over"),
                             "%s: object '%.60s' is of the kind %s; it must be a terrain", where,
                             over, kind_name(scene->objects[object].kind));
        }
    }
    return true;
}

bool check_scene(const Mapping *mapping, void *params)
{
    const Scene *scene = params;
    return check_names(mapping, "materials", "material") &&
           check_names(mapping, "objects", "object") && check_targets(mapping, scene) &&
           check_materials(mapping, scene) && check_layers(mapping, scene) &&
           check_clouds(mapping, scene) && check_neighbours(mapping, scene);
}
