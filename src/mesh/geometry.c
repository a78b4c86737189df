#include "mesh/geometry.h"

#include "base/memory.h"

#include <stdlib.h>

void part_free_meshes(Part *part)
{
    mesh_free(part->mesh);
    part->mesh = NULL;
    for (int i = 0; i < PART_COARSE_MOST; i++) {
        mesh_free(part->coarse[i].mesh);
        part->coarse[i].mesh = NULL;
    }
}

void part_clear(Part *part)
{
    part_free_meshes(part);
    curves_free(part->curves);
    free(part->instance);
    free(part->variation);
    free(part->season);
    height_field_free(part->land);
    spray_free(part->spray);
    spray_free(part->water);
}

bool geometry_add(Geometry *geometry, Part part, Error *e)
{
    if (!memory_reserve(&geometry->part, &geometry->capacity, geometry->count + 1, sizeof part,
                        e)) {
        part_clear(&part);
        return false;
    }
    geometry->part[geometry->count++] = part;
    return true;
}

bool geometry_order(Geometry *geometry, int objects, Error *e)
{
    int64_t *next = memory_alloc_zero((int64_t)objects + 1, sizeof *next, e);
    Part *part = memory_alloc(geometry->count, sizeof *part, e);
    bool done = next && part;
    for (int64_t i = 0; done && i < geometry->count; i++) {
        next[geometry->part[i].object + 1]++;
    }
    for (int i = 0; done && i < objects; i++) {
        next[i + 1] += next[i];
    }
    for (int64_t i = 0; done && i < geometry->count; i++) {
        part[next[geometry->part[i].object]++] = geometry->part[i];
    }
    free(next);
    if (done) {
        free(geometry->part);
        geometry->part = part;
        geometry->capacity = geometry->count;
    } else {
        free(part);
    }
    return done;
}

void geometry_clear(Geometry *geometry)
{
    for (int64_t i = 0; i < geometry->count; i++) {
        part_clear(&geometry->part[i]);
    }
    free(geometry->part);
    *geometry = (Geometry){0};
}

static int64_t mesh_bytes(const Mesh *mesh)
{
    size_t vertex = sizeof(Vec3);
    vertex += mesh->normal ? sizeof(Vec3) : 0;
    vertex += mesh->uv ? sizeof(Vec2) : 0;
    vertex += mesh->radius ? sizeof(float) : 0;
    vertex += mesh->birth ? sizeof(float) : 0;
    vertex += mesh->site ? sizeof(Vec2) : 0;
    vertex += mesh->foam ? sizeof(float) : 0;
    vertex += mesh->shore ? sizeof(float) : 0;
    vertex += mesh->young ? sizeof(float) : 0;
    vertex += mesh->withered ? sizeof(float) : 0;
    return mesh->vertex_count * (int64_t)vertex +
           mesh->face_count * mesh->face_size * (int64_t)sizeof(uint32_t);
}

static int64_t curves_bytes(const CurveSet *curves)
{
    size_t point = sizeof(Vec3) + (curves->glow ? 4 : 3) * sizeof(float);
    return curves->point_count * (int64_t)point +
           (curves->curve_count + 1) * (int64_t)sizeof(int64_t);
}

GeometryCounts geometry_counts(const Geometry *geometry)
{
    GeometryCounts counts = {0};
    for (int64_t i = 0; i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        if (part->mesh) {
            counts.triangles += part->mesh->face_count * (part->mesh->face_size - 2);
            counts.bytes += mesh_bytes(part->mesh);
        }
        if (part->curves) {
            counts.curve_segments += part->curves->point_count - part->curves->curve_count;
            counts.bytes += curves_bytes(part->curves);
        }
        counts.bytes += part->land ? height_field_bytes(part->land) : 0;
        counts.bytes += part->spray ? part->spray->count * (int64_t)sizeof(SprayParcel) : 0;
        counts.bytes += part->water ? part->water->count * (int64_t)sizeof(SprayParcel) : 0;
        counts.instances += part->instance_count;
        counts.bytes += part->instance_count * (int64_t)sizeof(Transform);
    }
    return counts;
}

static void bake_instance(Mesh *out, const Part *part, int64_t instance)
{
    const Mesh *mesh = part->mesh;
    const Transform *t = &part->instance[instance];
    Transform inverse;
    bool invertible = transform_inverse(t, &inverse);
    int64_t v0 = instance * mesh->vertex_count;
    for (int64_t v = 0; v < mesh->vertex_count; v++) {
        out->position[v0 + v] = transform_point(t, mesh->position[v]);
        if (mesh->normal) {
            Vec3 n = mesh->normal[v];
            out->normal[v0 + v] = vec3_normalize(invertible ? transform_normal(&inverse, n) : n);
        }
        if (mesh->uv) {
            out->uv[v0 + v] = mesh->uv[v];
        }
    }
    int64_t corners = mesh->face_count * mesh->face_size;
    for (int64_t c = 0; c < corners; c++) {
        out->index[instance * corners + c] = (uint32_t)v0 + mesh->index[c];
    }
}

Mesh *geometry_bake(const Part *part, const Run *run, Error *e)
{
    const Mesh *mesh = part->mesh;
    int64_t count = part->instance_count;
    Mesh *out = mesh_new(mesh->face_size, count * mesh->vertex_count, count * mesh->face_count,
                         (mesh->normal ? MESH_NORMAL : 0) | (mesh->uv ? MESH_UV : 0), e);
    for (int64_t i = 0; out && i < count; i++) {
        if (!run_goes_on(run, i, e)) {
            mesh_free(out);
            return NULL;
        }
        bake_instance(out, part, i);
    }
    return out;
}

static bool is_joined(const Part *part, bool water)
{
    return part->mesh && !part->instance && part->is_water == water;
}

// Appends triangles; the counts are those so far.
static void append(Mesh *out, const Mesh *mesh)
{
    for (int64_t v = 0; v < mesh->vertex_count; v++) {
        out->position[out->vertex_count + v] = mesh->position[v];
    }
    uint32_t base = (uint32_t)out->vertex_count;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * mesh->face_size;
        for (int k = 2; k < mesh->face_size; k++) {
            uint32_t *to = out->index + 3 * out->face_count++;
            to[0] = base + corner[0];
            to[1] = base + corner[k - 1];
            to[2] = base + corner[k];
        }
    }
    out->vertex_count += mesh->vertex_count;
}

// The meshes of water, or those of all else.
static Mesh *join(const Geometry *geometry, bool water, Error *e)
{
    int64_t vertices = 0, faces = 0;
    for (int64_t i = 0; i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        if (is_joined(part, water)) {
            vertices += part->mesh->vertex_count;
            faces += part->mesh->face_count * (part->mesh->face_size - 2);
        }
    }
    Mesh *out = mesh_new(3, vertices, faces, 0, e);
    if (!out) {
        return NULL;
    }
    out->vertex_count = out->face_count = 0;
    for (int64_t i = 0; i < geometry->count; i++) {
        if (is_joined(&geometry->part[i], water)) {
            append(out, geometry->part[i].mesh);
        }
    }
    return out;
}

Mesh *geometry_surface(const Geometry *geometry, Error *e)
{
    Mesh *out = join(geometry, false, e);
    if (out && !mesh_compute_normals(out, e)) {
        mesh_free(out);
        return NULL;
    }
    return out;
}

Mesh *geometry_water(const Geometry *geometry, Error *e)
{
    return join(geometry, true, e);
}
