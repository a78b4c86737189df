// Envelopes drawn as they are, as a kind of object.
#include "objects/kind.h"
#include "mesh/wood.h"
#include "objects/shape/shape.h"
#include "shape/primitive.h"

#include <math.h>
#include <string.h>

static Mesh *copy_mesh(const Mesh *mesh, Error *e)
{
    int arrays = (mesh->normal ? MESH_NORMAL : 0) | (mesh->uv ? MESH_UV : 0);
    Mesh *copy = mesh_new(mesh->face_size, mesh->vertex_count, mesh->face_count, arrays, e);
    if (!copy) {
        return NULL;
    }
    size_t vertices = (size_t)mesh->vertex_count;
    size_t corners = (size_t)mesh->face_count * (size_t)mesh->face_size;
    memcpy(copy->index, mesh->index, sizeof *mesh->index * corners);
    memcpy(copy->position, mesh->position, sizeof *mesh->position * vertices);
    if (mesh->normal) {
        memcpy(copy->normal, mesh->normal, sizeof *mesh->normal * vertices);
    }
    if (mesh->uv) {
        memcpy(copy->uv, mesh->uv, sizeof *mesh->uv * vertices);
    }
    return copy;
}

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    SolidParams *shape = params;
    own_space_of_shapes(own, shape->shapes, shape->shape_count);
    shape->hoar.wind = own_space_azimuth(own, shape->hoar.wind);
    return own_space_take_shapes(own, &shape->shapes, shape->shape_count, e);
}

static Envelope *make(const SolidParams *shape, const Run *run, Error *e)
{
    EnvelopeParams params = {.shapes = shape->shapes,
                             .shape_count = shape->shape_count,
                             .voxel = shape->voxel,
                             .voxelized = shape->checks > 0.0f};
    return envelope_new(&params, run, e);
}

// m, of triangles.
static float mean_face_size(const Mesh *mesh)
{
    double area = 0.0;
    for (int64_t i = 0; i < mesh->face_count; i++) {
        const uint32_t *face = mesh->index + i * mesh->face_size;
        Vec3 a = mesh->position[face[0]];
        Vec3 across =
            vec3_cross(vec3_sub(mesh->position[face[1]], a), vec3_sub(mesh->position[face[2]], a));
        area += (double)vec3_length(across); // twice that of the triangle, as of a voxel's face
    }
    return sqrtf((float)(area / (double)(mesh->face_count > 0 ? mesh->face_count : 1)));
}

// Moves the surface, whose faces are about as large as voxels, to the relief of weathered wood.
static bool carve(Mesh *mesh, const SolidParams *shape, const Run *run, Error *e)
{
    float finest = 2.0f * mean_face_size(mesh);
    bool done = mesh->normal || mesh_compute_normals(mesh, e);
    for (int64_t i = 0; done && i < mesh->vertex_count; i++) {
        float height = wood_relief(mesh->position[i], mesh->normal[i], finest, shape->checks);
        mesh->position[i] = vec3_madd(mesh->position[i], height, mesh->normal[i]);
        done = run_goes_on(run, i, e);
    }
    return done && mesh_compute_normals(mesh, e);
}

static bool geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const SolidParams *shape = given;
    Envelope *envelope = make(shape, placing->recipe->run, e);
    if (!envelope) {
        return false;
    }
    Mesh *mesh = copy_mesh(envelope_surface(envelope), e);
    envelope_free(envelope);
    if (mesh && shape->checks > 0.0f && !carve(mesh, shape, placing->recipe->run, e)) {
        mesh_free(mesh);
        return false;
    }
    if (mesh && !hoar_add_on_mesh(mesh, &shape->hoar, placing, SHAPE_RIME, e)) {
        mesh_free(mesh);
        return false;
    }
    return mesh && placing_add(placing, (Part){.mesh = mesh}, SHAPE_OWN, e);
}

// Area of the surface sampled by a level set, m^2. Half spaces add none.
static double surface_area(const Shape *shape)
{
    const double man = 0.62; // of the square of the height
    Primitive primitive;
    if (shape->kind == SHAPE_BODY) {
        return man * (double)(shape->size.x * shape->size.x);
    }
    bool bounded = shape->kind != SHAPE_HALF_SPACE && shape->kind != SHAPE_MESH;
    return bounded && primitive_new(shape, &primitive, NULL) ? primitive_area(&primitive) : 0.0;
}

static void needs(const void *params, Needs *needs)
{
    const double voxel_bytes = 370.0; // of a voxel on the surface, with its faces
    const double voxels_by_default = 6.0 * 128.0 * 128.0;
    const SolidParams *shape = params;
    double area = 0.0;
    for (int i = 0; i < shape->shape_count; i++) {
        area += surface_area(&shape->shapes[i]);
        needs_add_mesh_file(needs, "envelope", shape->shapes[i].file);
    }
    if (shape->hoar.length > 0.0f) { // more on thin parts, up to max_count
        double tufts = 4.0 * area * (double)hoar_tufts_per_area(&shape->hoar, 1.0f);
        needs_add(needs, "hoar.max_count", fmin(tufts, (double)shape->hoar.max_count),
                  HOAR_TUFT_BYTES);
    }
    bool plain = shape->shape_count == 1 && shape->shapes[0].kind != SHAPE_BODY;
    if (plain && shape->checks == 0.0f) {
        return; // no level set
    }
    double voxel = (double)shape->voxel;
    needs_add(needs, "voxel", voxel > 0.0 ? area / (voxel * voxel) : voxels_by_default,
              voxel_bytes);
}

static bool cover(const void *params, uint64_t seed, Cover *cover, const Run *run, Error *e)
{
    (void)seed;
    Envelope *envelope = make(params, run, e);
    bool done = envelope && cover_add(cover, envelope_surface(envelope), e);
    envelope_free(envelope);
    return done;
}

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(SHAPE_OWN),
    RIME_MATERIAL_ROW(SHAPE_RIME),
    {0},
};

const Kind kind_shape = {
    .variant = {KIND_ROW("shape", &solid_table, "Solids: spheres, boxes and their combinations."),
                MATERIALS},
    .carried = true,
    .materials = {"clay", "rime"},
    .needs = needs,
    .own_space = own_space,
    .geometry = geometry,
    .cover = cover};
