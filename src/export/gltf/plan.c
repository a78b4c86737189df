#include "export/gltf/glb.h"

#include "base/memory.h"
#include "export/placement.h"
#include "export/sky_bake.h"
#include "export/vertex_colors.h"

enum {
    NODES_MOST = 4096, // instances that become nodes by default
    // Leaves and grass are merged, which costs at most about 100 MB of file: Blender makes an
    // object of each node.
    COPIES_LEAST = 16,            // of a mesh that is merged
    SMALL_MOST = 1024,            // triangles of such a mesh
    MERGED_MOST = 2 * 1000 * 1000 // triangles of all that is merged
};

// How a whole scene's instances are written.
typedef struct Plan {
    bool merges;       // small meshes with many instances
    int64_t instances; // that are not merged
} Plan;

static bool is_small(const Glb *glb, int64_t index)
{
    const Part *part = &glb->source->world->geometry.part[index];
    return part->instance_count >= COPIES_LEAST &&
           export_part_tally(glb->source, index, false).triangles <= SMALL_MOST;
}

static Plan plan_placing(const Glb *glb)
{
    const Geometry *geometry = &glb->source->world->geometry;
    int64_t all = 0, small = 0, triangles = 0;
    for (int64_t i = 0; i < geometry->count; i++) {
        all += geometry->part[i].instance_count;
        if (is_small(glb, i)) {
            small += geometry->part[i].instance_count;
            triangles += export_part_tally(glb->source, i, true).triangles;
        }
    }
    bool merges =
        glb->source->options.instances == EXPORT_INSTANCES_AUTO && triangles <= MERGED_MOST;
    return (Plan){.merges = merges, .instances = merges ? all - small : all};
}

// Reasons why one node, or two, cannot express a part's instances.
typedef enum Trouble { TROUBLE_NONE, TROUBLE_SHEARED, TROUBLE_FLATTENED } Trouble;

static Trouble trouble_of(const Part *part)
{
    Trouble trouble = TROUBLE_NONE;
    for (int64_t i = 0; i < part->instance_count; i++) {
        Placement placement;
        float turn[4];
        if (placement_from_transform(&part->instance[i], &placement)) {
            continue;
        }
        if (!placement_of_turned(&part->instance[i], turn, &placement)) {
            return TROUBLE_FLATTENED;
        }
        trouble = TROUBLE_SHEARED;
    }
    return trouble;
}

static GlbPlacing placing_of(const Glb *glb, int64_t index, const Plan *plan, bool *refused)
{
    static const GlbPlacing asked[] = {[EXPORT_INSTANCES_NODES] = GLB_NODES,
                                       [EXPORT_INSTANCES_GPU] = GLB_GPU,
                                       [EXPORT_INSTANCES_FLAT] = GLB_FLAT};
    const Part *part = &glb->source->world->geometry.part[index];
    ExportInstances how = glb->source->options.instances;
    if (!part->instance) {
        return GLB_ONCE;
    }
    if (how == EXPORT_INSTANCES_FLAT || (plan->merges && is_small(glb, index))) {
        return GLB_FLAT;
    }
    Trouble trouble = trouble_of(part);
    if (trouble != TROUBLE_NONE) { // a table cannot express it
        *refused = trouble == TROUBLE_FLATTENED || part->instance_count > NODES_MOST;
        return *refused ? GLB_FLAT : GLB_PAIRS;
    }
    if (how == EXPORT_INSTANCES_AUTO) {
        return plan->instances <= NODES_MOST ? GLB_NODES : GLB_GPU;
    }
    return asked[how];
}

static void plan_vertex(const Glb *glb, const Part *part, GlbPart *own)
{
    const Mesh *mesh = part->mesh; // NULL: tubes, which have everything
    ExportColors colors = glb->source->options.colors;
    const Material *material = &glb->source->world->material[part->material];
    own->normal = !mesh || mesh->normal;
    own->glow = glb->strongest[part->material] > 0.0f;
    // a picture needs uv, and a second set needs a first
    own->uv = !mesh || mesh->uv || glb_has_image(material) || own->glow;
    own->radius = !mesh || mesh->radius;
    own->birth = !mesh || mesh->birth;
    own->growth = (own->radius || own->birth) &&
                  (colors == EXPORT_COLORS_ALL || colors == EXPORT_COLORS_GROWTH);
    // COLOR_1 needs a COLOR_0
    own->color = vertex_colors_wanted(&glb->source->options, material) ||
                 (own->growth && colors == EXPORT_COLORS_ALL);
    own->stride = 12 + 12 * own->normal + 8 * own->uv + 8 * own->glow + 8 * own->color +
                  8 * own->growth + 4 * own->radius + 4 * own->birth;
}

bool glb_too_large(Error *e, double bytes)
{
    return error_set(e, ERROR_INPUT,
                     "the file would have more than %.1f GB; a GLB file holds at most 4.29: "
                     "keep instances by EXT_mesh_gpu_instancing, export fewer objects, or export a "
                     ".ply file, which has no such limit",
                     bytes * 1e-9);
}

static bool add_bounds(void *user, const ExportPiece *piece, Error *e)
{
    (void)e;
    Aabb *bounds = user;
    *bounds = aabb_union(*bounds, export_piece_bounds(piece));
    return true;
}

// Fills all members but the bounds.
static bool plan_part(Glb *glb, int64_t index, const Plan *plan, Error *e)
{
    const Part *part = &glb->source->world->geometry.part[index];
    GlbPart own = {.index = index};
    own.placing = placing_of(glb, index, plan, &own.refused);
    ExportTally tally = export_part_tally(glb->source, index, own.placing == GLB_FLAT);
    if (tally.triangles == 0 || (part->instance && part->instance_count == 0)) {
        return true;
    }
    if (tally.vertices > UINT32_MAX - 1) {
        return glb_too_large(e, (double)tally.vertices * 40.0);
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
    return glb->buffer_size <= UINT32_MAX || glb_too_large(e, (double)glb->buffer_size);
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

static bool varies(const World *world, const Part *part)
{
    return part->curves && part->curves->glow &&
           material_has(&world->material[part->material], TRAIT_EMISSIVE);
}

static bool plan_glows(Glb *glb, Error *e)
{
    const World *world = glb->source->world;
    const Geometry *geometry = &world->geometry;
    glb->strongest = memory_alloc_zero(world->material_count, sizeof *glb->strongest, e);
    for (int64_t i = 0; glb->strongest && i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        float *strongest = &glb->strongest[part->material];
        for (int64_t k = 0; varies(world, part) && k < part->curves->point_count; k++) {
            *strongest = fmaxf(*strongest, fmaxf(part->curves->glow[k], 1e-20f));
        }
    }
    for (int64_t i = 0; glb->strongest && i < geometry->count; i++) { // parts that glow evenly
        float *strongest = &glb->strongest[geometry->part[i].material];
        if (*strongest > 0.0f && !varies(world, &geometry->part[i])) {
            *strongest = fmaxf(*strongest, 1.0f);
        }
    }
    return glb->strongest;
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

static void warn_of_placing(const Glb *glb)
{
    bool gpu = false, refused = false;
    for (int64_t i = 0; i < glb->part_count; i++) {
        gpu = gpu || glb->part[i].placing == GLB_GPU;
        refused = refused || glb->part[i].refused;
    }
    if (gpu && glb->source->options.instances == EXPORT_INSTANCES_AUTO) {
        run_warn(glb->run, "instances need EXT_mesh_gpu_instancing, which Blender knows from 4.0 "
                           "on; readers without it need instances as nodes or written out");
    }
    if (glb->source->options.instances == EXPORT_INSTANCES_FLAT) {
        export_warn_of_instances(glb->source, glb->run);
    }
    if (refused) {
        run_warn(glb->run,
                 "instances that are flattened, or sheared and more than %d, are written "
                 "out: glTF has no such nodes",
                 NODES_MOST);
    }
}

bool glb_plan(Glb *glb, Error *e)
{
    const Geometry *geometry = &glb->source->world->geometry;
    Plan plan = plan_placing(glb);
    glb->part = memory_alloc_zero(geometry->count, sizeof *glb->part, e);
    bool done = glb->part && plan_glows(glb, e);
    for (int64_t i = 0; done && i < geometry->count; i++) {
        done = plan_part(glb, i, &plan, e);
    }
    done = done && plan_bounds(glb, e) && plan_sun(glb, e) && glb_gather_materials(glb, e);
    for (int64_t i = 0; done && i < glb->image_count; i++) {
        glb->image[i].at = glb->buffer_size;
        glb->buffer_size += (glb->image[i].size + 3) & ~(int64_t)3;
    }
    if (done) {
        warn_of_placing(glb);
    }
    return done;
}
