#include "objects/terrain/drawn.h"

#include "land/height_mesh.h"
#include "objects/terrain/form.h"

static Transform copy_of(const DrawnLand *land)
{
    return terrain_copy(land->terrain->params, land->column, land->row);
}

bool drawn_is_copy(const DrawnLand *land)
{
    return land->column != 0 || land->row != 0;
}

bool drawn_of_tiles(const DrawnLand *land)
{
    return land->mesh && !(drawn_is_copy(land) && terrain_tiles_end(land->terrain->params));
}

float drawn_away(const DrawnLand *land, Vec3 place)
{
    if (!land->mesh || !land->view->eye) {
        return 0.0f;
    }
    Vec3 middle = land->terrain->params->position;
    Vec3 there = drawn_in_scene(land, vec3_add(place, middle));
    return vec3_distance(vec3_sub(there, middle), *land->view->eye);
}

float drawn_land_at(const DrawnLand *land, float x, float z)
{
    if (!drawn_of_tiles(land)) {
        return height_mesh_finest_at(land->field, x, z);
    }
    Vec3 p = vec3(x, 0.0f, z), middle = land->terrain->params->position;
    if (drawn_is_copy(land)) {
        Transform copy = copy_of(land);
        p = vec3_sub(transform_point(&copy, vec3_add(p, middle)), middle);
    }
    return tile_places_height(land->places, land->mesh, p.x, p.z) +
           tile_view_sinks(land->view, p.x, p.z);
}

// A place in the scene, down to the Earth's curve.
static Vec3 sunk(const DrawnLand *land, Vec3 p)
{
    Vec3 middle = land->terrain->params->position;
    p.y -= tile_view_sinks(land->view, p.x - middle.x, p.z - middle.z);
    return p;
}

Vec3 drawn_in_scene(const DrawnLand *land, Vec3 place)
{
    Transform copy = copy_of(land);
    Vec3 p = drawn_is_copy(land) ? transform_point(&copy, place) : place;
    return land->mesh ? sunk(land, p) : p;
}

bool drawn_move(const DrawnLand *land, Mesh *mesh, Error *e)
{
    Transform copy = copy_of(land);
    if (!land->mesh) {
        return true;
    }
    if (drawn_is_copy(land) && !mesh_transform(mesh, &copy, e)) {
        return false;
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i] = sunk(land, mesh->position[i]);
        mesh->uv[i] = mesh->foam ? mesh->uv[i] : (Vec2){p.x, p.z}; // that of foam is the flow's
    }
    return true;
}

bool drawn_add_water(const DrawnLand *land, Mesh *mesh, const Placing *placing, Error *e)
{
    Part part = {.mesh = mesh, .is_water = true};
    if (mesh && !drawn_move(land, mesh, e)) {
        part_free_meshes(&part);
    }
    return placing_add(placing, part, TERRAIN_WATER, e);
}
