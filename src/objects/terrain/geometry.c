// The parts of a terrain: land, water, forest.
#include "land/height_mesh.h"
#include "objects/terrain/internal.h"

#include <stddef.h>

static bool add_land(const Terrain *terrain, const HeightField *field, const Vec3 *eye,
                     int material, int object, Geometry *geometry, Error *e)
{
    const TerrainParams *params = terrain->params;
    Vec3 own_eye = eye ? vec3_sub(*eye, params->position) : vec3_splat(0.0f);
    HeightMeshParams meshing = {.error = eye ? 0.0f : params->mesh_error * 0.5f * params->size,
                                .eye = eye ? &own_eye : NULL,
                                .view = params->mesh_error,
                                .nearest = 2.0f * field->cell.x,
                                .keep = terrain->bank};
    Mesh *mesh = height_mesh_new(field, &meshing, e);
    if (!mesh) {
        return false;
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        mesh->position[i] = vec3_add(mesh->position[i], params->position);
    }
    Part part = {.kind = PART_MESH, .mesh = mesh, .material = material, .object = object};
    return geometry_add(geometry, part, e);
}

bool terrain_geometry(const TerrainParams *params, const OutTree *rivers,
                      const TerrainMaterials *materials, const Vec3 *eye, int object,
                      Geometry *geometry, const Recipe *recipe, Error *e)
{
    OutTree *copy = out_tree_copy(rivers, e);
    Terrain *terrain = copy ? terrain_new(params, copy, recipe, e) : NULL;
    HeightField *field = terrain ? terrain_sample(terrain, recipe->run, e) : NULL;
    bool done =
        field && add_land(terrain, field, eye, materials->land, object, geometry, e) &&
        terrain_add_water(terrain, field, materials->water, object, geometry, e) &&
        (params->forest.count <= 0 || terrain_add_forest(terrain, field, eye, materials->foliage,
                                                         object, geometry, recipe->run, e));
    height_field_free(field);
    terrain_free(terrain);
    return done;
}
