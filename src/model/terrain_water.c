// Water surfaces: a level lake, and ribbons along the rivers.
#include "base/memory.h"
#include "model/terrain_internal.h"

#include <stdlib.h>

static bool add_mesh(Mesh *mesh, int material, int object, Geometry *geometry, Error *e)
{
    Part part = {.kind = PART_MESH, .mesh = mesh, .material = material, .object = object};
    return mesh && geometry_add(geometry, part, e);
}

// ---- the lake

static Mesh *lake_mesh(const HeightField *field, Vec3 move, float level, Error *e)
{
    Mesh *mesh = mesh_new(4, 4, 1, MESH_NORMAL | MESH_UV, e);
    if (!mesh) {
        return NULL;
    }
    float width = field->cell.x * (float)(field->columns - 1);
    float depth = field->cell.y * (float)(field->rows - 1);
    for (uint32_t i = 0; i < 4; i++) { // counter-clockwise from above
        float x = field->origin.x + (i == 2 || i == 3 ? width : 0.0f);
        float z = field->origin.y + (i == 1 || i == 2 ? depth : 0.0f);
        mesh->position[i] = vec3(move.x + x, move.y + level, move.z + z);
        mesh->normal[i] = vec3(0, 1, 0);
        mesh->uv[i] = (Vec2){x, z};
        mesh->index[i] = i;
    }
    return mesh;
}

// ---- rivers

// The child that carries most water on; -1 at the end of what is wide enough to show.
static void find_heaviest(const Terrain *terrain, float least, int32_t *heaviest)
{
    const OutTree *tree = terrain->rivers;
    for (int64_t i = 0; i < tree->count; i++) {
        heaviest[i] = -1;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (parent >= 0 && tree->radius[i] >= least &&
            (heaviest[parent] < 0 || terrain->area[i] > terrain->area[heaviest[parent]])) {
            heaviest[parent] = (int32_t)i;
        }
    }
}

// Unit direction across the river at a node, in the plane.
static Vec3 across_at(const OutTree *tree, int32_t below, int32_t here, int32_t above)
{
    Vec3 from = tree->position[below >= 0 ? below : here];
    Vec3 to = tree->position[above >= 0 ? above : here];
    return vec3_normalize(vec3(to.z - from.z, 0.0f, from.x - to.x));
}

// Two vertices a node from `first` up its main stem; faces between. Counts when mesh is NULL.
static void add_stem(const Terrain *terrain, const int32_t *heaviest, int32_t first, Mesh *mesh,
                     int64_t *vertices, int64_t *faces)
{
    const OutTree *tree = terrain->rivers;
    int32_t below = tree->parent[first], here = below >= 0 ? below : first;
    below = -1;
    for (int64_t k = 0; here >= 0; k++) {
        int32_t above = k == 0 && here != first ? first : heaviest[here];
        if (mesh) {
            Vec3 across = across_at(tree, below, here, above);
            // A brook enters a wider river with its own width.
            float half = 1.35f * (k == 0 ? tree->radius[first] : tree->radius[here]);
            Vec3 p = vec3_add(tree->position[here], terrain->params->position);
            p.y -= 0.08f * tree->radius[here];
            for (int side = 0; side < 2; side++) {
                int64_t v = *vertices + side;
                mesh->position[v] = vec3_madd(p, side == 0 ? -half : half, across);
                mesh->normal[v] = vec3(0, 1, 0);
                mesh->uv[v] = (Vec2){mesh->position[v].x, mesh->position[v].z};
            }
            if (above >= 0) {
                uint32_t *corner = mesh->index + *faces * 4, v = (uint32_t)*vertices;
                corner[0] = v;
                corner[1] = v + 1;
                corner[2] = v + 3;
                corner[3] = v + 2;
            }
        }
        *vertices += 2;
        *faces += above >= 0 ? 1 : 0;
        below = here;
        here = above;
    }
}

static void add_stems(const Terrain *terrain, const int32_t *heaviest, float least, Mesh *mesh,
                      int64_t *vertices, int64_t *faces)
{
    const OutTree *tree = terrain->rivers;
    *vertices = *faces = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        bool begins =
            parent < 0 ? heaviest[i] >= 0 : tree->radius[i] >= least && heaviest[parent] != i;
        if (begins) {
            add_stem(terrain, heaviest, (int32_t)i, mesh, vertices, faces);
        }
    }
}

static bool add_rivers(const Terrain *terrain, float least, int material, int object,
                       Geometry *geometry, Error *e)
{
    int32_t *heaviest = memory_alloc(terrain->rivers->count, sizeof *heaviest, e);
    if (!heaviest) {
        return false;
    }
    int64_t vertices, faces;
    find_heaviest(terrain, least, heaviest);
    add_stems(terrain, heaviest, least, NULL, &vertices, &faces);
    bool done = true;
    if (faces > 0) {
        Mesh *mesh = mesh_new(4, vertices, faces, MESH_NORMAL | MESH_UV, e);
        if (mesh) {
            add_stems(terrain, heaviest, least, mesh, &vertices, &faces);
        }
        done = add_mesh(mesh, material, object, geometry, e);
    }
    free(heaviest);
    return done;
}

bool terrain_add_water(const Terrain *terrain, const HeightField *field, int material, int object,
                       Geometry *geometry, Error *e)
{
    const TerrainParams *params = terrain->params;
    if (params->water_level > 0.0f) {
        float level = terrain_water_height(params, field);
        if (!add_mesh(lake_mesh(field, params->position, level, e), material, object, geometry,
                      e)) {
            return false;
        }
    }
    // Narrower channels than the grid can hold would float on their banks.
    return params->rivers.water <= 0.0f ||
           add_rivers(terrain, 0.6f * field->cell.x, material, object, geometry, e);
}
