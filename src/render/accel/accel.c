#include "render/accel/accel_internal.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- Embree's callbacks

static void on_error(void *user, enum RTCError code, const char *text)
{
    Accel *accel = user;
    pthread_mutex_lock(&accel->lock);
    if (accel->failure.code == ERROR_NONE) {
        if (code == RTC_ERROR_OUT_OF_MEMORY) {
            error_set(&accel->failure, ERROR_MEMORY,
                      "out of memory while building the acceleration structure (%.0f MB so far); "
                      "fewer instances or coarser meshes would be right",
                      (double)atomic_load(&accel->bytes) * 1e-6);
        } else if (code == RTC_ERROR_CANCELLED) {
            run_cancel_error(&accel->failure);
        } else {
            error_set(&accel->failure, ERROR_INTERNAL, "Embree: %s", text);
        }
    }
    pthread_mutex_unlock(&accel->lock);
}

// Refuses allocations beyond the machine's memory: an error now instead of the kernel's
// out-of-memory killer later.
static bool on_memory(void *user, ssize_t bytes, bool post)
{
    Accel *accel = user;
    int64_t now = atomic_fetch_add(&accel->bytes, (int64_t)bytes) + (int64_t)bytes;
    return post || bytes <= 0 || now <= accel->bytes_limit;
}

// Embree calls this from its own threads too; only the building thread reports progress.
static bool on_progress(void *user, double done)
{
    Accel *accel = user;
    if (pthread_equal(pthread_self(), accel->builder)) {
        run_progress(accel->run, "build", done);
    }
    return !run_is_cancelled(accel->run);
}

static bool check_failure(const Accel *accel, Error *e)
{
    if (accel->failure.code != ERROR_NONE && e) {
        *e = accel->failure;
    }
    return accel->failure.code == ERROR_NONE;
}

// ---- geometries

static RTCGeometry mesh_geometry(Accel *accel, const Mesh *mesh, const Transform *copies,
                                 int64_t count)
{
    bool quads = mesh->face_size == 4;
    RTCGeometry geometry =
        rtcNewGeometry(accel->device, quads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE);
    int64_t vertices = mesh->vertex_count, corners = mesh->face_count * mesh->face_size;
    Vec3 *position = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Vec3), (size_t)(vertices * count));
    uint32_t *index = NULL;
    if (!copies) {
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                   quads ? RTC_FORMAT_UINT4 : RTC_FORMAT_UINT3, mesh->index, 0,
                                   (size_t)mesh->face_size * 4, (size_t)mesh->face_count);
        if (position) {
            memcpy(position, mesh->position, (size_t)vertices * sizeof(Vec3));
        }
        return geometry;
    }
    index = rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, quads ? RTC_FORMAT_UINT4 : RTC_FORMAT_UINT3,
        (size_t)mesh->face_size * 4, (size_t)(mesh->face_count * count));
    for (int64_t k = 0; k < count && position && index; k++) {
        for (int64_t i = 0; i < vertices; i++) {
            *position++ = transform_point(&copies[k], mesh->position[i]);
        }
        for (int64_t i = 0; i < corners; i++) {
            *index++ = mesh->index[i] + (uint32_t)(k * vertices);
        }
    }
    return geometry;
}

static RTCGeometry curve_geometry(Accel *accel, const CurveSet *curves, const uint32_t **segment)
{
    RTCGeometry geometry = rtcNewGeometry(accel->device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    size_t points = (size_t)curves->point_count;
    size_t segments = points - (size_t)curves->curve_count;
    float *vertex =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, points);
    uint32_t *index =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, 4, segments);
    uint8_t *flags =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, 1, segments);
    *segment = index;
    if (!vertex || !index || !flags) {
        return geometry;
    }
    for (size_t i = 0; i < points; i++) {
        Vec3 p = curves->position[i];
        memcpy(vertex + 4 * i, (float[4]){p.x, p.y, p.z, curves->radius[i]}, 16);
    }
    for (int64_t k = 0; k < curves->curve_count; k++) {
        int64_t first = curves->first[k], last = curves->first[k + 1] - 1;
        for (int64_t i = first; i < last; i++) {
            *index++ = (uint32_t)i;
            *flags++ = (uint8_t)((i > first ? RTC_CURVE_FLAG_NEIGHBOR_LEFT : 0) |
                                 (i + 1 < last ? RTC_CURVE_FLAG_NEIGHBOR_RIGHT : 0));
        }
    }
    return geometry;
}

static RTCGeometry light_geometry(Accel *accel, const Light *light)
{
    bool quad = light->kind == LIGHT_QUAD;
    RTCGeometry geometry = rtcNewGeometry(accel->device, quad ? RTC_GEOMETRY_TYPE_QUAD
                                                              : RTC_GEOMETRY_TYPE_SPHERE_POINT);
    if (quad) {
        Vec3 far = vec3_add(light->corner, vec3_add(light->edge_u, light->edge_v));
        Vec3 corner[4] = {light->corner, vec3_add(light->corner, light->edge_u), far,
                          vec3_add(light->corner, light->edge_v)};
        void *vertex = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                               RTC_FORMAT_FLOAT3, sizeof(Vec3), 4);
        void *index =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 16, 1);
        if (vertex && index) {
            memcpy(vertex, corner, sizeof corner);
            memcpy(index, (uint32_t[4]){0, 1, 2, 3}, 16);
        }
    } else {
        void *vertex =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, 1);
        if (vertex) {
            Vec3 c = light->center;
            memcpy(vertex, (float[4]){c.x, c.y, c.z, light->radius}, 16);
        }
    }
    return geometry;
}

// ---- putting them into the scene

// Attaches the geometry to the top scene and takes its reference; entry index = Embree's geomID.
static bool attach(Accel *accel, RTCGeometry geometry, int32_t part, uint32_t instance, Error *e)
{
    if (!memory_reserve(&accel->entry, &accel->entry_capacity, accel->entry_count + 1,
                        sizeof *accel->entry, e)) {
        rtcReleaseGeometry(geometry);
        return false;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(accel->scene, geometry, (unsigned)accel->entry_count);
    rtcReleaseGeometry(geometry);
    accel->entry[accel->entry_count++] = (AccelEntry){part, instance};
    return check_failure(accel, e);
}

static bool same_instances(const Part *a, const Part *b)
{
    return a->object == b->object && a->instance_count == b->instance_count &&
           memcmp(a->instance, b->instance, (size_t)a->instance_count * sizeof *a->instance) == 0;
}

// Ends the group: instances its scene.
static bool instance_group(Accel *accel, Error *e)
{
    int32_t number = accel->group;
    if (number < 0) {
        return true;
    }
    accel->group = -1;
    const AccelPart *part = &accel->part[number];
    rtcCommitScene(part->scene);
    for (int64_t i = 0; i < part->part->instance_count; i++) {
        if (!run_goes_on(accel->run, i, e)) {
            return false;
        }
        RTCGeometry instance = rtcNewGeometry(accel->device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, part->scene);
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR,
                                &part->part->instance[i]);
        if (!attach(accel, instance, number, (uint32_t)i, e)) {
            return false;
        }
    }
    return true;
}

// Parts with the same instances are a group: one scene, in which a part's geometry has the part's
// distance from the first as its number. An instance of them all takes a third of the memory and
// of the build of three, and a ray meets one box where three would overlap.
static bool add_to_group(Accel *accel, RTCGeometry geometry, int32_t number, Error *e)
{
    AccelPart *part = &accel->part[number];
    bool joins = accel->group >= 0 && same_instances(accel->part[accel->group].part, part->part);
    if (!joins && !instance_group(accel, e)) {
        rtcReleaseGeometry(geometry);
        return false;
    }
    if (!joins) {
        accel->group = number;
        part->scene = rtcNewScene(accel->device);
        rtcSetSceneProgressMonitorFunction(part->scene, on_progress, accel);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(accel->part[accel->group].scene, geometry,
                          (unsigned)(number - accel->group));
    rtcReleaseGeometry(geometry);
    return check_failure(accel, e);
}

static bool worth_copying(const Accel *accel, const Part *part)
{
    return part->kind == PART_MESH && part->instance && part->mesh->face_count > 0 &&
           part->mesh->face_count <= ACCEL_COPY_MESH_LIMIT &&
           part->instance_count <=
               (ACCEL_COPY_FACES_LIMIT - accel->copied_faces) / part->mesh->face_count &&
           part->instance_count < (int64_t)UINT32_MAX / (part->mesh->vertex_count + 1);
}

// The filters that rays need at this part: bits of AccelFilter.
static unsigned filters_of(const Accel *accel, const Part *part)
{
    const Material *m = &accel->world->material[part->material];
    if (part->kind == PART_CURVES) {
        return material_has(m, TRAIT_EMISSIVE) ? ACCEL_FILTER_GLOW : 0;
    }
    return (m->alpha_texture ? ACCEL_FILTER_ALPHA : 0u) |
           (material_has(m, TRAIT_THIN) ? ACCEL_FILTER_THIN : 0u);
}

static void set_filters(RTCGeometry geometry, AccelPart *own)
{
    rtcSetGeometryUserData(geometry, own);
    if (own->filters & ACCEL_FILTER_ALPHA) {
        rtcSetGeometryIntersectFilterFunction(geometry, accel_alpha_filter);
        rtcSetGeometryOccludedFilterFunction(geometry, accel_alpha_filter);
    }
    if (own->filters & ACCEL_FILTER_THIN) {
        rtcSetGeometryOccludedFilterFunction(geometry, accel_thin_filter);
    }
    if (own->filters & ACCEL_FILTER_GLOW) {
        rtcSetGeometryIntersectFilterFunction(geometry, accel_glow_filter);
        rtcSetGeometryOccludedFilterFunction(geometry, accel_glow_filter);
    }
}

static bool add_part(Accel *accel, int32_t number, Error *e)
{
    const Part *part = &accel->world->geometry.part[number];
    AccelPart *own = &accel->part[number];
    *own = (AccelPart){.accel = accel, .part = part, .base_variation = 0.5f};
    if (part->material < 0 || part->material >= accel->world->material_count) {
        return error_set(e, ERROR_INTERNAL, "part %d has material %d of %d", number, part->material,
                         accel->world->material_count);
    }
    bool mesh = part->kind == PART_MESH;
    own->filters = filters_of(accel, part);
    if ((mesh ? part->mesh->face_count : part->curves->curve_count) < 1 ||
        (part->instance && part->instance_count < 1)) {
        return true;
    }
    own->copied = worth_copying(accel, part);
    if (own->copied) {
        accel->copied_faces += part->instance_count * part->mesh->face_count;
    }
    own->plain = mesh && !own->copied && !part->mesh->normal && !part->mesh->uv &&
                 !part->mesh->radius && !part->mesh->birth && !part->mesh->site;
    RTCGeometry geometry =
        mesh ? mesh_geometry(accel, part->mesh, own->copied ? part->instance : NULL,
                             own->copied ? part->instance_count : 1)
             : curve_geometry(accel, part->curves, &own->segment);
    set_filters(geometry, own);
    return part->instance && !own->copied ? add_to_group(accel, geometry, number, e)
                                          : attach(accel, geometry, number, 0, e);
}

// ---- life

// Embree silently replaces an unknown name by its default.
bool accel_check_isa(const char *isa, Error *e)
{
    static const char *const known[] = {"sse2", "sse4.2", "avx", "avx2", "avx512"};
    for (size_t i = 0; isa && i < sizeof known / sizeof *known; i++) {
        if (strcmp(isa, known[i]) == 0) {
            return true;
        }
    }
    return !isa ||
           error_set(e, ERROR_INPUT,
                     "unknown instruction set '%s'; sse2, sse4.2, avx, avx2 or avx512 would "
                     "be right",
                     isa);
}

static RTCDevice open_device(Accel *accel, const char *isa, int threads, Error *e)
{
    if (!accel_check_isa(isa, e)) {
        return NULL;
    }
    char config[128];
    snprintf(config, sizeof config, "threads=%d%s%s", threads, isa ? ",isa=" : "", isa ? isa : "");
    RTCDevice device = rtcNewDevice(config);
    if (!device && rtcGetDeviceError(NULL) == RTC_ERROR_OUT_OF_MEMORY) { // of this thread
        error_set(e, ERROR_MEMORY, "out of memory while Embree starts its %d threads", threads);
        return NULL;
    }
    if (!device) {
        error_set(e, ERROR_INTERNAL, "Embree does not start with '%s' on this machine", config);
        return NULL;
    }
    rtcSetDeviceErrorFunction(device, on_error, accel);
    rtcSetDeviceMemoryMonitorFunction(device, on_memory, accel);
    return device;
}

static bool build(Accel *accel, Error *e)
{
    accel->scene = rtcNewScene(accel->device);
    if (!check_failure(accel, e)) {
        return false;
    }
    rtcSetSceneProgressMonitorFunction(accel->scene, on_progress, accel);
    for (int32_t i = 0; i < (int32_t)accel->world->geometry.count; i++) {
        if (!add_part(accel, i, e)) {
            return false;
        }
    }
    if (!instance_group(accel, e)) {
        return false;
    }
    for (int i = 0; i < accel->world->light_count; i++) {
        if (!attach(accel, light_geometry(accel, &accel->world->light[i]), -1, (uint32_t)i, e)) {
            return false;
        }
    }
    rtcCommitScene(accel->scene);
    return check_failure(accel, e);
}

Accel *accel_new(const World *world, const MaterialSet *materials, const char *isa, const Run *run,
                 Error *e)
{
    Accel *accel = memory_alloc_zero(1, sizeof *accel, e);
    if (!accel) {
        return NULL;
    }
    accel->world = world;
    accel->materials = materials;
    accel->run = run;
    accel->builder = pthread_self();
    accel->group = -1;
    accel->bytes_limit = (int64_t)memory_allowed();
    pthread_mutex_init(&accel->lock, NULL);
    accel->device = open_device(accel, isa, run->threads, e);
    accel->part = memory_alloc_zero(world->geometry.count, sizeof *accel->part, e);
    if (!accel->device || !accel->part || !build(accel, e)) {
        accel_free(accel);
        return NULL;
    }
    accel->run = NULL;
    return accel;
}

void accel_free(Accel *accel)
{
    if (!accel) {
        return;
    }
    if (accel->scene) {
        rtcReleaseScene(accel->scene);
    }
    for (int64_t i = 0; accel->part && i < accel->world->geometry.count; i++) {
        if (accel->part[i].scene) {
            rtcReleaseScene(accel->part[i].scene);
        }
    }
    if (accel->device) {
        rtcReleaseDevice(accel->device);
    }
    pthread_mutex_destroy(&accel->lock);
    free(accel->part);
    free(accel->entry);
    free(accel);
}

void accel_use_materials(Accel *accel, const MaterialSet *materials)
{
    accel->materials = materials;
}

bool accel_fits_materials(const Accel *accel)
{
    for (int64_t i = 0; i < accel->world->geometry.count; i++) {
        if (accel->part[i].filters != filters_of(accel, &accel->world->geometry.part[i])) {
            return false;
        }
    }
    return true;
}

int64_t accel_bytes(const Accel *accel)
{
    return atomic_load(&accel->bytes);
}

Aabb accel_bounds(const Accel *accel)
{
    struct RTCBounds b;
    rtcGetSceneBounds(accel->scene, &b);
    return (Aabb){vec3(b.lower_x, b.lower_y, b.lower_z), vec3(b.upper_x, b.upper_y, b.upper_z)};
}
