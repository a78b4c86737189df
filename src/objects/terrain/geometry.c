// The parts of a terrain: land, water, forest.
#include "land/height_mesh.h"
#include "objects/terrain/internal.h"

static bool add_land(const Terrain *terrain, const HeightField *field, const Placing *placing,
                     Error *e)
{
    const TerrainParams *params = terrain->params;
    const Vec3 *eye = placing->around.eye;
    Vec3 own_eye = eye ? vec3_sub(*eye, params->position) : vec3_splat(0.0f);
    HeightMeshParams meshing = {.error = eye ? 0.0f : params->mesh_error * 0.5f * params->size,
                                .eye = eye ? &own_eye : NULL,
                                .view = params->mesh_error,
                                .nearest = 2.0f * field->cell.x,
                                .keep = terrain->bank};
    Mesh *mesh = height_mesh_new(field, &meshing, e);
    for (int64_t i = 0; mesh && i < mesh->vertex_count; i++) {
        mesh->position[i] = vec3_add(mesh->position[i], params->position);
    }
    return placing_add(placing, (Part){.mesh = mesh}, TERRAIN_LAND, e);
}

bool terrain_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const TerrainParams *params = given;
    const Terrain *terrain = grown->state;
    HeightField *field = terrain_heights(params, grown, placing->recipe->run, e);
    bool done = field && add_land(terrain, field, placing, e) &&
                terrain_add_water(terrain, field, placing, e) &&
                (params->forest.count <= 0 || terrain_add_forest(terrain, field, placing, e));
    height_field_free(field);
    return done;
}
