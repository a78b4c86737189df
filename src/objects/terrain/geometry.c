// The parts of a terrain: land, water, forest; or the plane with its map or its tree.
#include "base/memory.h"
#include "land/height_mesh.h"
#include "land/tile_mesh.h"
#include "mesh/curves.h"
#include "objects/terrain/drawn.h"
#include "objects/terrain/form.h"

#include <stdlib.h>

// Moves a mesh of the land to the terrain's place and gives it its beds. ERROR_MEMORY.
static bool move_land(Mesh *mesh, const Terrain *terrain, Error *e)
{
    Vec3 place = terrain->params->position;
    bool one = !terrain_form(terrain->params)->plateau && terrain->params->strata.bed_count == 0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        mesh->position[i] = vec3_add(mesh->position[i], place);
    }
    if (!terrain->strata || one) {
        return true;
    }
    mesh->strata = strata_copy(terrain->strata, e);
    if (mesh->strata) {
        mesh->strata->origin = vec3_add(mesh->strata->origin, place);
    }
    return mesh->strata;
}

// Likewise. Takes ownership; NULL stays NULL. ERROR_MEMORY: NULL.
static Mesh *put_in_place(Mesh *mesh, const Terrain *terrain, Error *e)
{
    if (mesh && !move_land(mesh, terrain, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

Transform terrain_copy(const TerrainParams *params, int column, int row)
{
    Repeat repeat = terrain_form(params)->repeat;
    float x = column % 2 == 0 || repeat == REPEAT_PERIODIC ? 1.0f : -1.0f;
    bool turned = row % 2 != 0 && repeat != REPEAT_PERIODIC && repeat != REPEAT_ALONG;
    float z = turned ? -1.0f : 1.0f;
    Vec3 middle = params->position;
    Vec3 place = vec3((float)column * params->size + (1.0f - x) * middle.x, 0.0f,
                      (float)row * params->size + (1.0f - z) * middle.z);
    if (repeat == REPEAT_ALONG) {
        place.y = -params->meander.slope * (float)row * params->size;
    }
    return transform_from_axes(vec3(x, 0, 0), vec3(0, 1, 0), vec3(0, 0, z), place);
}

bool terrain_has_copy(const TerrainParams *params, int column, int row)
{
    if (terrain_form(params)->beyond) {
        return false;
    }
    if (terrain_form(params)->repeat != REPEAT_SHORE) {
        return column != 0 || row != 0;
    }
    TerrainSide sea = params->coast.sea;
    int seaward = sea == SIDE_EAST    ? column
                  : sea == SIDE_WEST  ? -column
                  : sea == SIDE_NORTH ? -row
                                      : row;
    return (column != 0 || row != 0) && (seaward == 0 || seaward == -1);
}

int terrain_surface_copies(const void *given, SurfaceCopy *copy)
{
    const TerrainParams *params = given;
    int count = 0;
    bool in_mesh = params->tiles.drawn && !terrain_tiles_end(params);
    for (int ring = 1; ring <= params->beyond; ring++) {
        int side = 2 * ring + 1;
        for (int i = 0; i < side * side; i++) {
            int column = i % side - ring, row = i / side - ring;
            bool of_ring = abs(column) == ring || abs(row) == ring;
            if (!of_ring || !terrain_has_copy(params, column, row)) {
                continue;
            }
            if (copy) {
                copy[count] = (SurfaceCopy){terrain_copy(params, column, row), ring, in_mesh};
            }
            count++;
        }
    }
    return count;
}

bool terrain_add_copies(Mesh *mesh, const TerrainParams *params, const Placing *placing, int role,
                        Error *e)
{
    int rings = params->beyond, side = 2 * rings + 1;
    Part part = {.mesh = mesh,
                 .instance = memory_alloc((int64_t)side * side, sizeof(Transform), e),
                 .is_water = role == TERRAIN_WATER};
    for (int i = 0; part.instance && i < side * side; i++) {
        int column = i % side - rings, row = i / side - rings;
        if (terrain_has_copy(params, column, row)) {
            part.instance[part.instance_count++] = terrain_copy(params, column, row);
        }
    }
    if (!part.instance) {
        mesh_free(mesh);
        return false;
    }
    return placing_add(placing, part, role, e);
}

// What is to be a vertex of the land around the square: where water is near; the rim, if tiles end
// there, so that both meet. The caller frees it; NULL: ERROR_MEMORY.
static uint8_t *kept_beyond(const Terrain *terrain, const HeightField *field, Error *e)
{
    const TerrainParams *params = terrain->params;
    const uint8_t *bank = terrain_form(params)->water ? terrain->bank : NULL;
    uint8_t *keep = memory_alloc_zero(height_field_count(field), 1, e);
    for (int64_t i = 0; keep && i < height_field_count(field); i++) {
        int64_t column = i % field->columns, row = i / field->columns;
        bool rim =
            column == 0 || row == 0 || column + 1 == field->columns || row + 1 == field->rows;
        keep[i] = (bank && bank[i]) || (rim && params->tiles.drawn);
    }
    return keep;
}

// The land around the square: coarser, as it is farther from the eye.
static bool add_beyond(const Terrain *terrain, const HeightField *field, const Placing *placing,
                       Error *e)
{
    const TerrainParams *params = terrain->params;
    if (params->beyond <= 0) {
        return true;
    }
    if (terrain_form(params)->beyond) {
        return terrain_form(params)->beyond(terrain, placing, e);
    }
    uint8_t *keep = kept_beyond(terrain, field, e);
    HeightMeshParams meshing = {.error = 0.25f * params->mesh_error * params->size, .keep = keep};
    Mesh *mesh = keep ? height_mesh_new(field, &meshing, e) : NULL;
    free(keep);
    mesh = put_in_place(mesh, terrain, e);
    return mesh && terrain_add_copies(mesh, params, placing, TERRAIN_LAND, e);
}

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
    bool flat = params->show != SHOW_LAND;
    for (int64_t i = 0; flat && mesh && i < mesh->vertex_count; i++) {
        mesh->position[i].y = 0.0f;
        mesh->normal[i] = vec3(0, 1, 0);
    }
    Part part = {.mesh = put_in_place(mesh, terrain, e)};
    return placing_add(placing, part, TERRAIN_LAND, e);
}

// What stands on the land or in it.
static bool add_cover(const DrawnLand *land, const Placing *placing, Error *e)
{
    return terrain_add_water(land, placing, e) &&
           (land->terrain->params->forest.count <= 0 || terrain_add_forest(land, placing, e));
}

// The land of its tiles, and what lies beyond, of tiles too unless they end at the border. They are
// moved to their place when the water and the trees are on them.
static bool add_tiles(const Terrain *terrain, const HeightField *field, const Placing *placing,
                      Error *e)
{
    const double earth = 6371000.0; // m
    const TerrainParams *params = terrain->params;
    const Vec3 *eye = placing->around.eye;
    bool ends = terrain_tiles_end(params);
    Vec3 own_eye = eye ? vec3_sub(*eye, params->position) : vec3_splat(0.0f);
    TileGrid grid = {.count = params->tiles.count,
                     .cells = params->tiles.cells,
                     .detail = params->tiles.detail,
                     .seed = terrain->seed};
    TileView view = {.eye = eye ? &own_eye : NULL,
                     .cell = 8.0f * params->mesh_error,
                     .beyond = ends ? 0 : params->beyond,
                     .seam = ends,
                     .curve = ends ? 0.0f : (float)(0.5 / earth)};
    TileWater water;
    TilePlaces places = {0};
    bool done = tile_water_init(&water, terrain, field, grid.count, e);
    view.shaping = &water.shaping;
    Mesh *mesh = done ? tile_mesh_new(field, &grid, &view, &places, placing->recipe->run, e) : NULL;
    DrawnLand land = {
        .terrain = terrain, .field = field, .mesh = mesh, .places = &places, .view = &view};
    done = mesh && placing_add(placing, (Part){.mesh = mesh}, TERRAIN_LAND, e) &&
           (!ends || add_beyond(terrain, field, placing, e)) && add_cover(&land, placing, e) &&
           move_land(mesh, terrain, e);
    tile_places_clear(&places);
    tile_water_clear(&water);
    return done;
}

// The land of one mesh, and what lies beyond.
static bool add_square(const Terrain *terrain, const HeightField *field, const Placing *placing,
                       Error *e)
{
    DrawnLand land = {.terrain = terrain, .field = field};
    return add_land(terrain, field, placing, e) && add_beyond(terrain, field, placing, e) &&
           add_cover(&land, placing, e);
}

// The tree as lines on the plane, their thickness in proportion to its radii.
static bool add_lines(const Terrain *terrain, const Placing *placing, Error *e)
{
    const OutTree *tree = terrain->tree;
    const TerrainParams *params = terrain->params;
    const float thickest = 0.006f; // radius, as a share of the size
    float largest = 0.0f;
    int64_t count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        largest = tree->radius[i] > largest ? tree->radius[i] : largest;
        count += tree->parent[i] >= 0;
    }
    if (count == 0 || !(largest > 0.0f)) {
        return true;
    }
    CurveSet *lines = curves_new(2 * count, count, e);
    for (int64_t i = 0, c = 0; lines && i < tree->count; i++) {
        for (int end = 0; end < 2 && tree->parent[i] >= 0; end++) {
            int64_t node = end == 0 ? tree->parent[i] : i;
            Vec3 p = tree->position[node];
            lines->position[2 * c + end] = vec3_add(vec3(p.x, 0.0f, p.z), params->position);
            float share = 0.15f + 0.85f * tree->radius[node] / largest;
            lines->radius[2 * c + end] = thickest * share * params->size;
        }
        if (tree->parent[i] >= 0) {
            lines->id[c++] = tree->id[i];
            lines->first[c] = 2 * c;
        }
    }
    return placing_add(placing, (Part){.curves = lines}, TERRAIN_LINES, e);
}

// Leaves the land with the first part that the terrain has added, in the scene. Takes ownership.
static void keep_land(HeightField *field, const TerrainParams *params, Part *first)
{
    for (int64_t i = 0; i < height_field_count(field); i++) {
        field->height[i] += params->position.y;
        if (field->water) {
            field->water[i] += params->position.y;
        }
    }
    field->origin.x += params->position.x;
    field->origin.y += params->position.z;
    first->land = field;
}

bool terrain_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const TerrainParams *params = given;
    const Terrain *terrain = grown->state;
    int64_t first = placing->geometry->count;
    HeightField *field = terrain_heights(params, grown, placing->recipe->run, e);
    if (field && params->show != SHOW_LAND) {
        bool drawn = add_land(terrain, field, placing, e) &&
                     (params->show == SHOW_MAP || add_lines(terrain, placing, e));
        height_field_free(field);
        return drawn;
    }
    bool done = field && (params->tiles.drawn ? add_tiles(terrain, field, placing, e)
                                              : add_square(terrain, field, placing, e));
    if (done && placing->keep_land) {
        keep_land(field, params, &placing->geometry->part[first]);
    } else {
        height_field_free(field);
    }
    return done;
}
