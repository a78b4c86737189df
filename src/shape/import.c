#include "shape/import.h"

#include "base/child.h"
#include "base/file_name.h"
#include "base/memory.h"
#include "base/plugin.h"
#include "shape/import_read.h"
#include "shape/vdb.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define COORDINATE_LIMIT 1e7f // m: beyond it a float cannot tell points a metre apart

// Limits of the reading process. Assimp needs up to 35 bytes per byte of the file and a second per
// 20 MB; compressed or intricate files need more.
#define MIN_SECONDS 60.0
#define SECONDS_PER_BYTE 5e-6
#define MIN_MEMORY 2e9
#define MEMORY_PER_BYTE 200.0
#define MAX_MEMORY 1e15

// ---- limits ----

static double size_of(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode) ? (double)status.st_size : 0.0;
}

// Total size of the files beside a .gltf that may be its buffers.
static double size_of_buffers(const char *file)
{
    const char *slash = strrchr(file, '/');
    int folder = slash ? (int)(slash - file) + 1 : 0;
    char path[4096];
    snprintf(path, sizeof path, "%.*s.", folder, file);
    DIR *entries = opendir(path);
    double size = 0.0;
    for (struct dirent *entry; entries && (entry = readdir(entries));) {
        if (file_name_ends(entry->d_name, ".bin")) {
            snprintf(path, sizeof path, "%.*s%s", folder, file, entry->d_name);
            size += size_of(path);
        }
    }
    if (entries) {
        closedir(entries);
    }
    return size;
}

static void set_limits(const char *file, ChildJob *job)
{
    double size = size_of(file);
    if (file_name_ends(file, ".gltf")) {
        size += size_of_buffers(file);
    }
    job->seconds = MIN_SECONDS + SECONDS_PER_BYTE * size;
    job->memory = (int64_t)fmin(MIN_MEMORY + MEMORY_PER_BYTE * size, MAX_MEMORY);
}

// ---- the reader's result ----

static bool check_positions(const Mesh *mesh, Error *e)
{
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        if (!vec3_finite(p)) {
            return error_set(e, ERROR_INPUT,
                             "vertex %lld has a coordinate that is not finite; coordinates must be "
                             "numbers in metres",
                             (long long)i);
        }
        if (fabsf(p.x) > COORDINATE_LIMIT || fabsf(p.y) > COORDINATE_LIMIT ||
            fabsf(p.z) > COORDINATE_LIMIT) {
            return error_set(e, ERROR_INPUT,
                             "vertex %lld lies at %g, %g, %g m; at most %g m from the origin is "
                             "possible",
                             (long long)i, (double)p.x, (double)p.y, (double)p.z,
                             (double)COORDINATE_LIMIT);
        }
    }
    return true;
}

static bool check_faces(const Mesh *mesh, Error *e)
{
    for (int64_t i = 0; i < 3 * mesh->face_count; i++) {
        if (mesh->index[i] >= mesh->vertex_count) {
            return error_set(e, ERROR_INPUT, "face %lld has no vertex %u; there are %lld",
                             (long long)(i / 3), mesh->index[i], (long long)mesh->vertex_count);
        }
    }
    if (mesh->face_count == 0) {
        return error_set(e, ERROR_INPUT,
                         "all faces of the file are degenerate; triangles with an area are needed");
    }
    return true;
}

// Drops all normals if any is invalid; sets invalid texture coordinates to 0.
static void mend(Mesh *mesh)
{
    bool sound = true;
    for (int64_t i = 0; mesh->normal && i < mesh->vertex_count; i++) {
        sound = sound && fabsf(vec3_length(mesh->normal[i]) - 1.0f) < 1e-3f;
    }
    if (!sound) {
        free(mesh->normal);
        mesh->normal = NULL;
    }
    for (int64_t i = 0; mesh->uv && i < mesh->vertex_count; i++) {
        Vec2 *uv = &mesh->uv[i];
        *uv = isfinite(uv->x) && isfinite(uv->y) ? *uv : (Vec2){0.0f, 0.0f};
    }
}

// Checks that the bytes the header promises exist before any memory is allocated for them.
static bool check_header(const ImportHeader *h, int64_t left, Error *e)
{
    int64_t most = (int64_t)UINT32_MAX;
    bool sane = h->vertex_count >= 0 && h->vertex_count <= most && h->face_count >= 0 &&
                h->face_count <= most && h->normals >> 1 == 0 && h->uvs >> 1 == 0;
    int64_t a_vertex = (int64_t)sizeof(Vec3) * (1 + h->normals) + (int64_t)sizeof(Vec2) * h->uvs;
    return (sane && h->face_count * 12 + h->vertex_count * a_vertex == left) ||
           error_set(e, ERROR_INPUT,
                     "the reader's result makes no sense; " IMPORT_WANTED " is needed");
}

static Mesh *take_mesh(ChildOutput *output, Error *e)
{
    ImportHeader h;
    if (!child_read(output, &h, 1, sizeof h, e) || !check_header(&h, output->left, e)) {
        return NULL;
    }
    Mesh *mesh = mesh_new(3, h.vertex_count, h.face_count,
                          (h.normals ? (int)MESH_NORMAL : 0) | (h.uvs ? (int)MESH_UV : 0), e);
    bool done = mesh && child_read(output, mesh->index, 3 * h.face_count, sizeof *mesh->index, e) &&
                child_read(output, mesh->position, h.vertex_count, sizeof *mesh->position, e) &&
                child_read(output, mesh->normal, h.normals * h.vertex_count, sizeof(Vec3), e) &&
                child_read(output, mesh->uv, h.uvs * h.vertex_count, sizeof(Vec2), e) &&
                check_positions(mesh, e) && check_faces(mesh, e);
    if (!done) {
        mesh_free(mesh);
        return NULL;
    }
    mend(mesh);
    return mesh;
}

Mesh *mesh_import_by(ChildTask *reader, const char *file, const Run *run, Error *e)
{
    ImportJob work = {file, NULL};
    ChildJob job = {.task = reader, .data = &work, .file = file, .wanted = IMPORT_WANTED};
    ChildOutput output;
    if (!file || !file[0]) {
        error_set(e, ERROR_INPUT, "no mesh file is named; give the path of one");
        return NULL;
    }
    if (file_name_ends(file, ".vdb") &&
        !(work.vdb = plugin_table(VDB_PLUGIN, VDB_READERS, sizeof *work.vdb, e))) {
        return NULL;
    }
    set_limits(file, &job);
    if (!child_run(&job, run, &output, e)) {
        return NULL;
    }
    Mesh *mesh = take_mesh(&output, e);
    child_output_close(&output);
    if (!mesh) {
        error_locate(e, file, 0, 0);
    }
    return mesh;
}

Mesh *mesh_import(const char *file, const Run *run, Error *e)
{
    return mesh_import_by(import_read, file, run, e);
}
