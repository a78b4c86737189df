// An imported mesh as a kind of object.
#include "scene/kinds.h"
#include "shape/import.h"

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    (void)tree;
    const SceneMesh *params = p->object->mesh;
    Mesh *mesh = mesh_import(params->file, p->recipe.run, e);
    if (!mesh) {
        return error_key(e, "file");
    }
    if (!mesh_transform(mesh, &params->transform, e) ||
        (params->smooth && !mesh->normal && !mesh_compute_normals(mesh, e))) {
        mesh_free(mesh);
        return false;
    }
    return placing_add_mesh(p, mesh, "clay", e);
}

static void needs(const SceneObject *object, Needs *needs)
{
    needs_add_mesh_file(needs, "file", object->mesh->file);
}

const Kind kind_mesh = {.key = "mesh",
                        .offset = offsetof(SceneObject, mesh),
                        .materials = {"material"},
                        .needs = needs,
                        .place = place};
