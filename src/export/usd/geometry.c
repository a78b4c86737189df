// Meshes, curves and instances in USD's text format: one Xform per object, one prim per part.
#include "export/placement.h"
#include "export/usd/usda.h"
#include "export/vertex_colors.h"

#include "base/memory.h"
#include "mesh/geometry_measure.h"
#include "render/material/appearance.h"

#include <stdio.h>
#include <stdlib.h>

#define BINDING "prepend apiSchemas = [\"MaterialBindingAPI\"]"

// ---- one mesh or set of curves

// The colour at the vertices where the material has a pattern, else its own colour.
static bool display_color(Usda *usda, const Part *part, Error *e)
{
    const World *world = usda->source->world;
    const Material *m = &world->material[part->material];
    if (!vertex_colors_wanted(&usda->source->options, m)) {
        Appearance a = material_appearance(m);
        Vec3 color = appearance_display_color(&a);
        usda_vec3s(&usda->text, "color3f[] primvars:displayColor", &color, 1, "constant");
        return true;
    }
    Vec3 *color = vertex_colors(world, part, usda->run, e);
    if (color) {
        int64_t count = part->mesh ? part->mesh->vertex_count : part->curves->point_count;
        usda_vec3s(&usda->text, "color3f[] primvars:displayColor", color, count, "vertex");
    }
    bool done = color;
    free(color);
    return done;
}

static void bind_material(Usda *usda, const Part *part)
{
    usda_line(&usda->text, "rel material:binding = </World/Materials/%s>",
              usda->material[part->material]);
}

static bool mesh_prim(Usda *usda, const Part *part, const char *name, Error *e)
{
    UsdaText *text = &usda->text;
    const Mesh *mesh = part->mesh;
    int64_t vertices = mesh->vertex_count;
    usda_begin(text, BINDING, "def Mesh \"%s\"", name);
    bind_material(usda, part);
    usda_line(text, "uniform token subdivisionScheme = \"none\"");
    usda_line(text, "uniform token orientation = \"rightHanded\"");
    usda_line(text, "uniform bool doubleSided = 1");
    usda_extent(text, part_bounds(part));
    usda_repeated(text, "int[] faceVertexCounts", mesh->face_size, mesh->face_count);
    usda_indices(text, "int[] faceVertexIndices", mesh->index, mesh->face_count * mesh->face_size);
    usda_vec3s(text, "point3f[] points", mesh->position, vertices, NULL);
    if (mesh->normal) {
        usda_vec3s(text, "normal3f[] normals", mesh->normal, vertices, "vertex");
    }
    if (mesh->uv) {
        usda_vec2s(text, "texCoord2f[] primvars:st", mesh->uv, vertices, "vertex");
    }
    if (mesh->radius) {
        usda_floats(text, "float[] primvars:radius", mesh->radius, vertices, "vertex");
    }
    if (mesh->birth) {
        usda_floats(text, "float[] primvars:birth", mesh->birth, vertices, "vertex");
    }
    if (mesh->site) {
        usda_vec2s(text, "float2[] primvars:site", mesh->site, vertices, "vertex");
    }
    bool done = display_color(usda, part, e);
    usda_end(text);
    return done;
}

static void curve_counts(UsdaText *text, const CurveSet *curves)
{
    usda_array_begin(text, "int[] curveVertexCounts");
    for (int64_t i = 0; i < curves->curve_count; i++) {
        file_writer_print(text->out, i > 0 ? ", %lld" : "%lld",
                          (long long)(curves->first[i + 1] - curves->first[i]));
    }
    usda_array_end(text, NULL);
}

static void curve_widths(UsdaText *text, const CurveSet *curves)
{
    usda_array_begin(text, "float[] widths");
    for (int64_t i = 0; i < curves->point_count; i++) {
        float width = 2.0f * curves->radius[i];
        usda_array_add(text, i == 0, &width, 1, 1);
    }
    usda_array_end(text, "vertex");
}

// The emission of each point, which the material reads.
static void curve_emission(UsdaText *text, const CurveSet *curves, Vec3 radiance)
{
    usda_array_begin(text, "color3f[] primvars:emission");
    for (int64_t i = 0; i < curves->point_count; i++) {
        Vec3 value = vec3_scale(radiance, curves->glow[i]);
        usda_array_add(text, i == 0, &value.x, 3, 1);
    }
    usda_array_end(text, "vertex");
}

static bool curves_prim(Usda *usda, const Part *part, const char *name, Error *e)
{
    UsdaText *text = &usda->text;
    const CurveSet *curves = part->curves;
    const Material *m = &usda->source->world->material[part->material];
    usda_begin(text, BINDING, "def BasisCurves \"%s\"", name);
    bind_material(usda, part);
    usda_line(text, "uniform token type = \"linear\"");
    usda_line(text, "uniform token wrap = \"nonperiodic\"");
    usda_extent(text, part_bounds(part));
    curve_counts(text, curves);
    usda_vec3s(text, "point3f[] points", curves->position, curves->point_count, NULL);
    curve_widths(text, curves);
    if (curves->birth) {
        usda_floats(text, "float[] primvars:birth", curves->birth, curves->point_count, "vertex");
    }
    if (curves->glow && material_has(m, TRAIT_EMISSIVE)) {
        curve_emission(text, curves, m->radiance);
    }
    bool done = display_color(usda, part, e);
    usda_end(text);
    return done;
}

static bool shape_prim(Usda *usda, const Part *part, const char *name, Error *e)
{
    return part->mesh ? mesh_prim(usda, part, name, e) : curves_prim(usda, part, name, e);
}

// ---- instances

// The attributes of instances that a PointInstancer stores.
typedef enum Column { POSITION, ORIENTATION, SCALE, VARIATION, INDEX } Column;

static void instance_column(UsdaText *text, const Part *part, Column column, const char *name)
{
    bool first = true;
    usda_array_begin(text, name);
    for (int64_t i = 0; i < part->instance_count; i++) {
        Placement p;
        if (!placement_from_transform(&part->instance[i], &p)) {
            continue;
        }
        if (column == INDEX) {
            file_writer_text(text->out, first ? "0" : ", 0");
        } else if (column == VARIATION) {
            float variation = part_variation(part, i);
            usda_array_add(text, first, &variation, 1, 1);
        } else if (column == ORIENTATION) { // the real part first
            const float q[4] = {p.rotation[3], p.rotation[0], p.rotation[1], p.rotation[2]};
            usda_array_add(text, first, q, 4, 1);
        } else {
            usda_array_add(text, first, column == POSITION ? &p.position.x : &p.scale.x, 3, 1);
        }
        first = false;
    }
    usda_array_end(text, column == VARIATION ? "vertex" : NULL);
}

// Bounds of the instances that a PointInstancer can express; *sheared counts the others.
static Aabb instancer_bounds(const Part *part, int64_t *sheared)
{
    Aabb own = part_bounds(part), all = aabb_empty();
    Placement placement;
    *sheared = 0;
    for (int64_t i = 0; i < part->instance_count && !aabb_is_empty(own); i++) {
        if (placement_from_transform(&part->instance[i], &placement)) {
            all = aabb_union(all, aabb_transform(own, &part->instance[i]));
        } else {
            ++*sheared;
        }
    }
    return aabb_is_empty(all) ? (Aabb){vec3_splat(0.0f), vec3_splat(0.0f)} : all;
}

// A PointInstancer cannot shear: sheared instances are prims that reference its prototype.
static void sheared_instances(Usda *usda, const Part *part, const char *object, const char *name)
{
    UsdaText *text = &usda->text;
    Placement placement;
    usda_begin(text, NULL, "def Xform \"%s_sheared\"", name);
    for (int64_t i = 0; i < part->instance_count; i++) {
        if (placement_from_transform(&part->instance[i], &placement)) {
            continue;
        }
        usda_line(text, "def Xform \"_%lld\" (", (long long)i);
        usda_line(text, "    instanceable = true");
        usda_line(text, "    prepend references = </World/%s/%s/Prototype>", object, name);
        usda_line(text, ")");
        usda_line(text, "{");
        text->depth++;
        usda_transform(text, &part->instance[i]);
        usda_end(text);
    }
    usda_end(text);
}

static bool instanced_part(Usda *usda, const Part *part, const char *object, const char *name,
                           Error *e)
{
    UsdaText *text = &usda->text;
    int64_t sheared;
    Aabb box = instancer_bounds(part, &sheared);
    usda_begin(text, NULL, "def PointInstancer \"%s\"", name);
    usda_line(text, "rel prototypes = </World/%s/%s/Prototype>", object, name);
    usda_extent(text, box);
    instance_column(text, part, INDEX, "int[] protoIndices");
    instance_column(text, part, POSITION, "point3f[] positions");
    instance_column(text, part, ORIENTATION, "quath[] orientations");
    instance_column(text, part, SCALE, "float3[] scales");
    instance_column(text, part, VARIATION, "float[] primvars:variation");
    usda_begin(text, NULL, "def Xform \"Prototype\"");
    bool done = shape_prim(usda, part, "Shape", e);
    usda_end(text);
    usda_end(text);
    if (done && sheared > 0) {
        sheared_instances(usda, part, object, name);
    }
    return done;
}

// ---- objects

// Has the part no geometry, and so no bounds?
static bool is_empty(const Part *part)
{
    bool bare = part->mesh ? part->mesh->face_count == 0 : part->curves->curve_count == 0;
    return bare || (part->instance && part->instance_count == 0);
}

static bool object_prim(Usda *usda, int object, const char *name, Error *e)
{
    const Geometry *geometry = &usda->source->world->geometry;
    bool done = true;
    usda_begin(&usda->text, "kind = \"component\"", "def Xform \"%s\"", name);
    for (int64_t i = 0, number = 0; done && i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        if (part->object != object || is_empty(part)) {
            continue;
        }
        char part_name[USDA_NAME + 24];
        snprintf(part_name, sizeof part_name, "%s_%lld", usda->material[part->material],
                 (long long)number++);
        if (run_is_cancelled(usda->run)) {
            done = run_cancel_error(e);
        } else if (part->instance) {
            done = instanced_part(usda, part, name, part_name, e);
        } else {
            done = shape_prim(usda, part, part_name, e);
        }
    }
    usda_end(&usda->text);
    return done;
}

bool usda_objects(Usda *usda, Error *e)
{
    static const char *const reserved[] = {"Camera", "Materials", "Lights", NULL};
    const ExportSource *source = usda->source;
    char(*name)[USDA_NAME] = memory_alloc(source->object_count, sizeof *name, e);
    bool done = name;
    for (int i = 0; done && i < source->object_count; i++) {
        usda_unique_identifier(source->object_name[i], name, i, reserved);
        run_progress(usda->run, "export", (double)i / (double)source->object_count);
        done = object_prim(usda, i, name[i], e);
    }
    free(name);
    return done;
}
