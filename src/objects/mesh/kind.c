// An imported mesh as a kind of object.
#include "objects/kind.h"
#include "objects/mesh/bend.h"
#include "objects/mesh/mesh.h"
#include "shape/import.h"

// In its place; NULL and e otherwise.
static Mesh *import(const MeshParams *params, const Run *run, Error *e)
{
    Transform transform = transform_compose(params->position, params->rotation, params->scale);
    Mesh *mesh = mesh_import(params->file, run, e);
    if (mesh) {
        mesh_bend(mesh, params->bend_front, params->bend_back);
    }
    if (!mesh) {
        error_key(e, "file");
    } else if (!mesh_transform(mesh, &transform, e)) {
        mesh_free(mesh);
        mesh = NULL;
    }
    return mesh;
}

static bool geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const MeshParams *params = given;
    Mesh *mesh = import(params, placing->recipe->run, e);
    if (mesh && params->smooth && !mesh->normal && !mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return false;
    }
    if (!mesh) {
        return false;
    }
    if (!hoar_add_on_mesh(mesh, &params->hoar, placing, MESH_RIME, e)) {
        mesh_free(mesh);
        return false;
    }
    return placing_add(placing, (Part){.mesh = mesh}, MESH_OWN, e);
}

static void needs(const void *params, Needs *needs)
{
    const MeshParams *mesh = params;
    needs_add_mesh_file(needs, "file", mesh->file);
    if (mesh->hoar.length > 0.0f) { // the area is not known before the file is read
        needs_add(needs, "hoar.max_count", (double)mesh->hoar.max_count, HOAR_TUFT_BYTES);
    }
}

static bool cover(const void *params, uint64_t seed, Cover *cover, const Run *run, Error *e)
{
    (void)seed;
    Mesh *mesh = import(params, run, e);
    bool done = mesh && cover_add(cover, mesh, e);
    mesh_free(mesh);
    return done;
}

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(MESH_OWN),
    RIME_MATERIAL_ROW(MESH_RIME),
    {0},
};

const Kind kind_mesh = {.variant = {KIND_ROW("mesh", &mesh_table, "An imported mesh."), MATERIALS},
                        .carried = true,
                        .materials = {"clay", "rime"},
                        .needs = needs,
                        .geometry = geometry,
                        .cover = cover};
