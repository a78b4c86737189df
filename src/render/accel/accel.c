#include "render/accel/accel_internal.h"

#include "base/memory.h"
#include "mesh/curve_tubes.h"
#include "render/accel/accel_detail.h"
#include "render/material/relief.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Tubes of thin curves: of some hundred bytes a point.
enum { TUBE_POINTS_LIMIT = 1000000 };

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

// ---- pieces

static bool worth_copying(const Accel *accel, const AccelPiece *piece)
{
    const Mesh *mesh = piece->mesh;
    return mesh && piece->part->instance && mesh->face_count > 0 &&
           mesh->face_count <= ACCEL_COPY_MESH_LIMIT &&
           piece->count <= (ACCEL_COPY_FACES_LIMIT - accel->copied_faces) / mesh->face_count &&
           piece->count < (int64_t)UINT32_MAX / (mesh->vertex_count + 1);
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

// The traits of the material that decide what is drawn of a part with several forms: round curves
// or tubes, a full or a coarse mesh.
static unsigned form_traits(const Accel *accel, const Part *part)
{
    const Material *m = &accel->world->material[part->material];
    if (part->kind == PART_MESH && !part->coarse[0].mesh) {
        return 0;
    }
    return (material_has(m, TRAIT_OPAQUE) ? TRAIT_OPAQUE : 0u) |
           (material_has(m, TRAIT_EMISSIVE) ? TRAIT_EMISSIVE : 0u);
}

static uint64_t relief_of(const Accel *accel, const Part *part)
{
    bool can = part->kind == PART_MESH && !part->instance;
    return can ? relief_key(&accel->world->material[part->material]) : 0;
}

static void set_filters(RTCGeometry geometry, AccelPiece *own)
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

static bool is_empty(const Part *part)
{
    return (part->kind == PART_MESH ? part->mesh->face_count : part->curves->curve_count) < 1 ||
           (part->instance && part->instance_count < 1);
}

// Thin opaque curves become tubes: Embree keeps curves in a tree of their own, through which every
// ray goes, and meets them several times more slowly than the few quads of a tube.
static bool worth_tubes(const Accel *accel, const Part *part)
{
    const CurveSet *curves = part->curves;
    return curves->point_count <= TUBE_POINTS_LIMIT && curves->birth && curves->along &&
           material_has(&accel->world->material[part->material], TRAIT_OPAQUE) &&
           !material_has(&accel->world->material[part->material], TRAIT_EMISSIVE) &&
           detail_is_thin(part, &accel->views);
}

// Emitters and the filters of alpha know the faces of the part's own mesh only.
static bool has_coarse(const Accel *accel, const Part *part)
{
    const Material *m = &accel->world->material[part->material];
    return part->kind == PART_MESH && part->instance && part->coarse[0].mesh &&
           accel->views.count > 0 && !material_has(m, TRAIT_EMISSIVE) && !m->alpha_texture;
}

// Widens inscribed tubes to the width of round curves: the perimeter is that of the circle, and so
// is the mean width from all sides.
static void widen_tubes(Mesh *tubes)
{
    float more = PI_F / ((float)CURVE_TUBE_SIDES * sinf(PI_F / CURVE_TUBE_SIDES)) - 1.0f;
    for (int64_t v = 0; v < tubes->vertex_count; v++) {
        tubes->position[v] =
            vec3_madd(tubes->position[v], more * tubes->radius[v], tubes->normal[v]);
    }
}

static bool displace(const Accel *accel, AccelPiece *own, Error *e)
{
    const World *world = accel->world;
    ReliefView view = {.views = &accel->views,
                       .frame = world->views.count > 0 ? NULL : &accel->camera,
                       .width = world->film.width,
                       .height = world->film.height,
                       .material = world->material,
                       .set = accel->materials};
    if (!accel_relief_dice(&view, own->part, accel->run, &own->diced, e)) {
        return false;
    }
    own->mesh = own->diced.mesh ? own->diced.mesh : own->mesh;
    return true;
}

static bool add_piece(Accel *accel, AccelPiece piece, Error *e)
{
    AccelPiece *own = &accel->piece[accel->piece_count++];
    *own = piece; // its arrays are owned from here on
    const Part *part = piece.part;
    if (!displace(accel, own, e)) {
        return false;
    }
    if (part->kind == PART_CURVES && worth_tubes(accel, part)) {
        own->tubes = curve_tubes(part->curves, 0, part->curves->curve_count, CURVE_TUBE_SIDES, e);
        if (!own->tubes) {
            return false;
        }
        widen_tubes(own->tubes);
        own->mesh = own->tubes;
    }
    own->copied = worth_copying(accel, own);
    if (own->copied) {
        accel->copied_faces += own->count * own->mesh->face_count;
    } else if (own->mesh && accel->has_quads && !own->filters) {
        return pairs_new(&own->pairs, own->mesh, e);
    }
    const Mesh *mesh = own->mesh;
    own->plain = mesh && !own->copied && !mesh->normal && !mesh->uv && !mesh->radius &&
                 !mesh->birth && !mesh->site && !mesh->foam && !mesh->shore && !mesh->young &&
                 !mesh->withered;
    return true;
}

// One piece for each form of the mesh that some instances are drawn in.
static bool add_levels(Accel *accel, AccelPiece piece, Error *e)
{
    const Part *part = piece.part;
    int64_t count[PART_COARSE_MOST + 1] = {0};
    uint8_t *level = memory_alloc(part->instance_count, 1, e);
    float reach = detail_reach(part->mesh);
    for (int64_t i = 0; level && i < part->instance_count; i++) {
        level[i] = (uint8_t)detail_level(part, i, reach, &accel->views);
        count[level[i]]++;
    }
    bool done = level;
    for (int k = 0; done && k <= PART_COARSE_MOST; k++) {
        if (count[k] == 0) {
            continue;
        }
        piece.mesh = k > 0 ? part->coarse[k - 1].mesh : part->mesh;
        piece.which = memory_alloc(count[k], sizeof *piece.which, e);
        piece.count = 0;
        for (int64_t i = 0; piece.which && i < part->instance_count; i++) {
            if (level[i] == k) {
                piece.which[piece.count++] = (uint32_t)i;
            }
        }
        done = piece.which && add_piece(accel, piece, e);
    }
    free(level);
    return done;
}

static bool add_part(Accel *accel, int32_t number, Error *e)
{
    const Part *part = &accel->world->geometry.part[number];
    if (part->material < 0 || part->material >= accel->world->material_count) {
        return error_set(e, ERROR_INTERNAL, "part %d has material %d of %d", number, part->material,
                         accel->world->material_count);
    }
    AccelPiece piece = {.accel = accel,
                        .part = part,
                        .number = number,
                        .mesh = part->kind == PART_MESH ? part->mesh : NULL,
                        .count = part->instance ? part->instance_count : 0,
                        .base_variation = 0.5f,
                        .filters = filters_of(accel, part),
                        .traits = form_traits(accel, part),
                        .relief = relief_of(accel, part)};
    if (is_empty(part)) {
        return true;
    }
    return has_coarse(accel, part) ? add_levels(accel, piece, e) : add_piece(accel, piece, e);
}

static bool add_parts(Accel *accel, Error *e)
{
    const Geometry *geometry = &accel->world->geometry;
    accel->piece =
        memory_alloc_zero(geometry->count * (PART_COARSE_MOST + 1), sizeof *accel->piece, e);
    for (int64_t i = 0; i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        accel->has_quads =
            accel->has_quads || (part->kind == PART_MESH && part->mesh->face_size == 4);
    }
    bool done = accel->piece;
    for (int32_t i = 0; done && i < (int32_t)geometry->count; i++) {
        done = add_part(accel, i, e);
    }
    return done;
}

// ---- putting them into the scene

// Attaches the geometry to the top scene and takes its reference; entry index = Embree's geomID.
static bool attach(Accel *accel, RTCGeometry geometry, int32_t piece, uint32_t instance, Error *e)
{
    if (!memory_reserve(&accel->entry, &accel->entry_capacity, accel->entry_count + 1,
                        sizeof *accel->entry, e)) {
        rtcReleaseGeometry(geometry);
        return false;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(accel->scene, geometry, (unsigned)accel->entry_count);
    rtcReleaseGeometry(geometry);
    accel->entry[accel->entry_count++] = (AccelEntry){piece, instance};
    return check_failure(accel, e);
}

static RTCGeometry new_geometry(AccelPiece *piece)
{
    RTCGeometry geometry = accel_piece_geometry(piece);
    set_filters(geometry, piece);
    return geometry;
}

static bool is_instanced(const AccelPiece *piece)
{
    return piece->part->instance && !piece->copied;
}

static bool same_instances(const AccelPiece *a, const AccelPiece *b)
{
    return a == b ||
           (!a->which && !b->which && a->count == b->count && a->part->object == b->part->object &&
            memcmp(a->part->instance, b->part->instance,
                   (size_t)a->count * sizeof *a->part->instance) == 0);
}

// The scene of a group: pieces with the same instances as the first, such as bark, twigs and leaves
// of a tree. In it a piece's geometry has the piece's distance from the first as its number. An
// instance of them all takes a third of the memory and of the build of three, and a ray meets one
// box where three would overlap.
static void build_group(Accel *accel, AccelPiece *first)
{
    first->scene = rtcNewScene(accel->device);
    rtcSetSceneProgressMonitorFunction(first->scene, on_progress, accel);
    for (AccelPiece *piece = first; piece < accel->piece + accel->piece_count; piece++) {
        if (!is_instanced(piece)) {
            continue;
        }
        if (!same_instances(first, piece)) {
            break;
        }
        RTCGeometry geometry = new_geometry(piece);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(first->scene, geometry, (unsigned)(piece - first));
        rtcReleaseGeometry(geometry);
        piece->grouped = true;
    }
    rtcCommitScene(first->scene);
}

static bool attach_group(Accel *accel, AccelPiece *first, Error *e)
{
    build_group(accel, first);
    for (int64_t i = 0; i < first->count; i++) {
        if (!run_goes_on(accel->run, i, e)) {
            return false;
        }
        uint32_t number = accel_instance(first, i);
        RTCGeometry instance = rtcNewGeometry(accel->device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, first->scene);
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR,
                                &first->part->instance[number]);
        if (!attach(accel, instance, (int32_t)(first - accel->piece), number, e)) {
            return false;
        }
    }
    return true;
}

static bool attach_pieces(Accel *accel, Error *e)
{
    bool done = true;
    for (int32_t i = 0; done && i < accel->piece_count; i++) {
        AccelPiece *piece = &accel->piece[i];
        if (!piece->grouped) {
            done = is_instanced(piece) ? attach_group(accel, piece, e)
                                       : attach(accel, new_geometry(piece), i, 0, e);
        }
    }
    return done;
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
    if (!add_parts(accel, e) || !attach_pieces(accel, e)) {
        return false;
    }
    for (int i = 0; i < accel->world->light_count; i++) {
        if (!attach(accel, accel_light_geometry(accel, &accel->world->light[i]), -1, (uint32_t)i,
                    e)) {
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
    accel->bytes_limit = (int64_t)memory_allowed();
    pthread_mutex_init(&accel->lock, NULL);
    accel->device = open_device(accel, isa, run->threads, e);
    accel->camera = camera_frame(&world->camera, world->film.width, world->film.height);
    accel->views = world->views.count > 0
                       ? world->views
                       : (Views){&accel->camera.position, 1, accel->camera.pixel_angle, 0.0f};
    accel->views.detail = world->render.detail;
    if (!accel->device || !build(accel, e)) {
        accel_free(accel);
        return NULL;
    }
    accel->run = NULL;
    accel->views = (Views){0};
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
    for (int32_t i = 0; i < accel->piece_count; i++) {
        if (accel->piece[i].scene) {
            rtcReleaseScene(accel->piece[i].scene);
        }
    }
    if (accel->device) {
        rtcReleaseDevice(accel->device);
    }
    for (int32_t i = 0; i < accel->piece_count; i++) { // Embree no longer reads them
        mesh_free(accel->piece[i].tubes);
        diced_mesh_clear(&accel->piece[i].diced);
        free(accel->piece[i].which);
        pairs_clear(&accel->piece[i].pairs);
    }
    pthread_mutex_destroy(&accel->lock);
    free(accel->piece);
    free(accel->entry);
    free(accel);
}

void accel_use_materials(Accel *accel, const MaterialSet *materials)
{
    accel->materials = materials;
}

bool accel_fits_materials(const Accel *accel)
{
    for (int32_t i = 0; i < accel->piece_count; i++) {
        const AccelPiece *piece = &accel->piece[i];
        if (piece->filters != filters_of(accel, piece->part) ||
            piece->traits != form_traits(accel, piece->part) ||
            piece->relief != relief_of(accel, piece->part)) {
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
