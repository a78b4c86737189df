#include "shape/import_read.h"

#include "base/file_name.h"
#include "base/memory.h"
#include "base/vec.h"
#include "shape/import_check.h"
#include "shape/import_files.h"
#include "shape/ply_read.h"
#include "shape/vdb.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// Totals over all nodes that show a mesh.
typedef struct Tally {
    int64_t vertices, triangles;
    bool normals, uvs; // every vertex has them
} Tally;

static bool is_triangle_mesh(const struct aiMesh *mesh)
{
    return mesh->mNumVertices > 0 && mesh->mNumFaces > 0;
}

static void tally_node(const struct aiScene *scene, const struct aiNode *node, Tally *tally)
{
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        const struct aiMesh *mesh = scene->mMeshes[node->mMeshes[i]];
        if (is_triangle_mesh(mesh)) {
            tally->vertices += mesh->mNumVertices;
            tally->triangles += mesh->mNumFaces;
            tally->normals = tally->normals && mesh->mNormals;
            tally->uvs = tally->uvs && mesh->mTextureCoords[0];
        }
    }
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        tally_node(scene, node->mChildren[i], tally);
    }
}

static Transform node_transform(const Transform *parent, const struct aiMatrix4x4 *m)
{
    Transform own = {
        {{m->a1, m->a2, m->a3, m->a4}, {m->b1, m->b2, m->b3, m->b4}, {m->c1, m->c2, m->c3, m->c4}}};
    return transform_multiply(parent, &own);
}

static void copy_vertices(const struct aiMesh *from, const Transform *t, Mesh *to)
{
    Transform inverse = transform_identity();
    transform_inverse(t, &inverse); // if singular, normals are left unchanged
    for (unsigned i = 0; i < from->mNumVertices; i++) {
        int64_t v = to->vertex_count + i;
        const struct aiVector3D *p = &from->mVertices[i];
        to->position[v] = transform_point(t, vec3(p->x, p->y, p->z));
        if (to->normal) {
            const struct aiVector3D *n = &from->mNormals[i];
            to->normal[v] = vec3_normalize(transform_normal(&inverse, vec3(n->x, n->y, n->z)));
        }
        if (to->uv) {
            to->uv[v] = (Vec2){from->mTextureCoords[0][i].x, from->mTextureCoords[0][i].y};
        }
    }
}

static bool is_degenerate(const Mesh *mesh, const uint32_t c[3])
{
    Vec3 a = mesh->position[c[0]];
    Vec3 ab = vec3_sub(mesh->position[c[1]], a), ac = vec3_sub(mesh->position[c[2]], a);
    Vec3 across = vec3_cross(ab, ac);
    return c[0] == c[1] || c[1] == c[2] || c[2] == c[0] ||
           (across.x == 0.0f && across.y == 0.0f && across.z == 0.0f);
}

static void copy_faces(const struct aiMesh *from, const Transform *t, Mesh *to)
{
    Vec3 x = vec3(t->m[0][0], t->m[1][0], t->m[2][0]);
    Vec3 y = vec3(t->m[0][1], t->m[1][1], t->m[2][1]);
    Vec3 z = vec3(t->m[0][2], t->m[1][2], t->m[2][2]);
    bool mirrored = vec3_dot(x, vec3_cross(y, z)) < 0.0f;
    for (unsigned i = 0; i < from->mNumFaces; i++) {
        const struct aiFace *face = &from->mFaces[i];
        uint32_t *corner = to->index + 3 * to->face_count;
        bool valid = face->mNumIndices == 3;
        for (unsigned k = 0; valid && k < 3; k++) {
            unsigned v = face->mIndices[mirrored && k > 0 ? 3 - k : k];
            valid = v < from->mNumVertices;
            corner[k] = (uint32_t)(to->vertex_count + v);
        }
        if (valid && !is_degenerate(to, corner)) {
            to->face_count++;
        }
    }
}

static void copy_node(const struct aiScene *scene, const struct aiNode *node,
                      const Transform *parent, Mesh *to)
{
    Transform t = node_transform(parent, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        const struct aiMesh *mesh = scene->mMeshes[node->mMeshes[i]];
        if (is_triangle_mesh(mesh)) {
            copy_vertices(mesh, &t, to);
            copy_faces(mesh, &t, to);
            to->vertex_count += mesh->mNumVertices;
        }
    }
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        copy_node(scene, node->mChildren[i], &t, to);
    }
}

// Merges the scene into one mesh; NULL and e when it has no usable triangles.
static Mesh *gather(const struct aiScene *scene, Error *e)
{
    Tally tally = {.normals = true, .uvs = true};
    tally_node(scene, scene->mRootNode, &tally);
    if (tally.triangles == 0) {
        error_set(e, ERROR_INPUT, IMPORT_NO_TRIANGLES);
        return NULL;
    }
    Mesh *mesh =
        mesh_new(3, tally.vertices, tally.triangles,
                 (tally.normals ? (int)MESH_NORMAL : 0) | (tally.uvs ? (int)MESH_UV : 0), e);
    if (!mesh) {
        return NULL;
    }
    mesh->vertex_count = mesh->face_count = 0;
    Transform identity = transform_identity();
    copy_node(scene, scene->mRootNode, &identity, mesh);
    return mesh;
}

// Prefixes Assimp's message, without its full stop and line end.
static void read_error(const char *why, Error *e)
{
    int length = (int)strcspn(why, "\r\n");
    while (length > 0 && why[length - 1] == '.') {
        length--;
    }
    if (strncmp(why, "std::bad_alloc", 14) == 0) {
        error_set(e, ERROR_MEMORY, "out of memory");
    } else if (strncmp(why, "No meshes remaining", 19) == 0) { // only lines and points
        error_set(e, ERROR_INPUT, IMPORT_NO_TRIANGLES);
    } else {
        error_set(e, ERROR_INPUT, "not readable as a mesh: %.*s; " IMPORT_WANTED " is needed",
                  length > 0 ? length : 19, length > 0 ? why : "no reason is known");
    }
}

static const struct aiScene *read_scene(const char *file, Error *e)
{
    struct aiPropertyStore *store = aiCreatePropertyStore();
    if (!store) {
        error_set(e, ERROR_MEMORY, "out of memory");
        return NULL;
    }
    struct aiFileIO files = import_files(file);
    // drop attributes that would keep equal vertices apart, and primitives that are not surfaces
    aiSetImportPropertyInteger(store, AI_CONFIG_PP_RVC_FLAGS,
                               aiComponent_COLORS | aiComponent_BONEWEIGHTS |
                                   aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                                   aiComponent_LIGHTS | aiComponent_CAMERAS |
                                   aiComponent_TANGENTS_AND_BITANGENTS);
    aiSetImportPropertyInteger(store, AI_CONFIG_PP_SBP_REMOVE,
                               aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const struct aiScene *scene =
        aiImportFileExWithProperties(file,
                                     aiProcess_RemoveComponent | aiProcess_Triangulate |
                                         aiProcess_JoinIdenticalVertices | aiProcess_SortByPType,
                                     &files, store);
    aiReleasePropertyStore(store);
    if (!scene || !scene->mRootNode) {
        read_error(aiGetErrorString(), e);
        aiReleaseImport(scene);
        return NULL;
    }
    return scene;
}

static bool write_mesh(const Mesh *mesh, ChildOutput *output, Error *e)
{
    ImportHeader header = {.vertex_count = mesh->vertex_count,
                           .face_count = mesh->face_count,
                           .normals = mesh->normal != NULL,
                           .uvs = mesh->uv != NULL};
    int64_t vertices = mesh->vertex_count;
    return child_write(output, &header, 1, sizeof header, e) &&
           child_write(output, mesh->index, 3 * mesh->face_count, sizeof *mesh->index, e) &&
           child_write(output, mesh->position, vertices, sizeof *mesh->position, e) &&
           child_write(output, mesh->normal, header.normals * vertices, sizeof *mesh->normal, e) &&
           child_write(output, mesh->uv, header.uvs * vertices, sizeof *mesh->uv, e);
}

static Mesh *read_mesh(const ImportJob *job, Error *e)
{
    const char *file = job->file;
    if (job->vdb) {
        return job->vdb->surface(file, e);
    }
    bool declined = true;
    Mesh *mesh = file_name_ends(file, ".ply") ? ply_read(file, &declined, e) : NULL;
    if (mesh || !declined) {
        return mesh;
    }
    const struct aiScene *scene = read_scene(file, e);
    return scene ? gather(scene, e) : NULL; // freed with the process: one by one is slow
}

bool import_read(const void *data, ChildOutput *output, Error *e)
{
    const ImportJob *job = data;
    Mesh *mesh = import_check(job->file, e) ? read_mesh(job, e) : NULL;
    bool done = mesh && write_mesh(mesh, output, e);
    mesh_free(mesh);
    return done;
}
