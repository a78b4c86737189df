// From grown colonies to geometry: skins of branches, crusts over rocks, corallites.
#include "model/coral.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "mesh/skin.h"
#include "model/coral_crust.h"
#include "model/polyps.h"

#include <stdlib.h>

enum { YOUTH_STEPS = 1000 };

// A copy of the tree whose births tell how near a growing tip is (YOUTH_STEPS there, 0 from `pale`
// metres on): what living coral shows is the age of its tissue, not of its skeleton.
static OutTree *with_youth(const OutTree *tree, float pale, Error *e)
{
    OutTree *copy = out_tree_copy(tree, e);
    float *to_tip = copy ? memory_alloc(tree->count, sizeof *to_tip, e) : NULL;
    if (!to_tip) {
        out_tree_free(copy);
        return NULL;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        to_tip[i] = INFINITY;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        to_tip[i] = to_tip[i] == INFINITY ? 0.0f : to_tip[i];
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            float way = to_tip[i] + vec3_distance(tree->position[i], tree->position[parent]);
            to_tip[parent] = way < to_tip[parent] ? way : to_tip[parent];
        }
        float youth = clampf(1.0f - to_tip[i] / pale, 0.0f, 1.0f);
        copy->birth[i] = (int32_t)(youth * (float)YOUTH_STEPS + 0.5f);
    }
    free(to_tip);
    return copy;
}

static Mesh *branches(const OutTree *tree, const CoralParams *p, const Run *run, Error *e)
{
    OutTree *young = with_youth(tree, p->pale, e);
    SkinParams skin = skin_params_default();
    skin.levels = p->levels;
    skin.ring_spacing = 0.8f;
    Mesh *mesh = young ? skin_tree(young, &skin, run, e) : NULL;
    out_tree_free(young);
    return mesh;
}

static bool add_mesh(Geometry *geometry, Mesh *mesh, int material, int object, Error *e)
{
    return mesh && geometry_add(geometry,
                                (Part){.kind = PART_MESH,
                                       .mesh = mesh,
                                       .material = material,
                                       .object = object},
                                e);
}

// The rock: its surface eaten into by weather, up to `depth` (m), never out of the crust.
static Mesh *weathered(const Mesh *from, float depth, uint64_t seed, Error *e)
{
    Mesh *to = mesh_new(from->face_size, from->vertex_count, from->face_count, 0, e);
    for (int64_t i = 0; to && i < from->vertex_count; i++) {
        Vec3 p = vec3_scale(from->position[i], 0.16f / depth);
        float hollow = noise_plane_fractal(p.x + 0.4f * p.y, p.z, 4, seed) +
                       noise_plane_fractal(p.y, p.x - 0.4f * p.z, 4, seed + 1) - 0.5f;
        to->position[i] =
            vec3_madd(from->position[i], hollow < 0.0f ? depth * hollow : 0.0f, from->normal[i]);
    }
    for (int64_t i = 0; to && i < from->face_count * from->face_size; i++) {
        to->index[i] = from->index[i];
    }
    if (to && !mesh_compute_normals(to, e)) {
        mesh_free(to);
        return NULL;
    }
    return to;
}

// The crust, and the rock below it.
static Mesh *crust(const OutTree *tree, const CoralParams *p, const CoralMaterials *materials,
                   int object, uint64_t seed, Geometry *geometry, const Run *run, Error *e)
{
    Envelope *rock = coral_base(p, seed, run, e);
    Mesh *mesh = NULL;
    if (rock && add_mesh(geometry,
                         weathered(envelope_surface(rock), 0.04f * p->size, random_key(seed, 12), e),
                         materials->rock, object, e)) {
        CrustParams crust = {.thickness = 1.3f * p->tip_radius,
                             .reach = 1.5f * p->length,
                             .seam = 0.35f * p->length_tip,
                             .pale = p->form == CORAL_MASSIVE ? 0.03f * p->size : 0.05f * p->size,
                             .lump = p->form == CORAL_MASSIVE ? 0.10f * p->size : 0.05f * p->size,
                             .seed = random_key(seed, 8)};
        mesh = crust_mesh(envelope_surface(rock), tree, &crust, run, e);
    }
    envelope_free(rock);
    return mesh;
}

bool coral_geometry(const OutTree *tree, const CoralParams *params, const CoralMaterials *materials,
                    int object, uint64_t seed, Geometry *geometry, const Run *run, Error *e)
{
    CoralParams p = coral_params_resolve(params);
    bool on_rock = p.form == CORAL_ENCRUSTING || p.form == CORAL_MASSIVE;
    Mesh *mesh = on_rock ? crust(tree, &p, materials, object, seed, geometry, run, e)
                         : branches(tree, &p, run, e);
    if (!mesh) {
        return false;
    }
    PolypPlaces places = {.max_count = p.polyps.max_count,
                          .spacing = p.polyps.spacing,
                          .diameter = p.polyps.diameter,
                          .height = p.polyps.height,
                          .lean = p.polyps.lean,
                          .floor = p.position.y,
                          .seed = random_key(seed, 9)};
    if (p.polyps.max_count > 0 &&
        !polyps_add(mesh, &places, materials->polyp, object, geometry, run, e)) {
        mesh_free(mesh);
        return false;
    }
    return add_mesh(geometry, mesh, materials->coral, object, e);
}
