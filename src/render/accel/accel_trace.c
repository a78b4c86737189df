#include "render/accel/accel_internal.h"

#include "base/random.h"

#include <pmmintrin.h>
#include <string.h>
#include <xmmintrin.h>

// Rays of one of Embree's packets; fewer than the least are faster one by one.
enum { PACKET_SIZE = 16, LEAST_PACKET = 3 };

unsigned accel_thread_begin(void)
{
    unsigned state = _mm_getcsr();
    _mm_setcsr(state | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON);
    return state;
}

void accel_thread_end(unsigned state)
{
    _mm_setcsr(state);
}

static bool passes(const AccelPiece *own, unsigned primitive, unsigned instance, float u, float v,
                   unsigned key)
{
    const Mesh *mesh = own->mesh;
    Corners c = accel_corners(mesh, primitive % mesh->face_count, u, v);
    float opacity =
        material_opacity(own->accel->materials, own->part->material, accel_uv(mesh, &c));
    return opacity < 1.0f &&
           random_unit(random_key(random_key(key, primitive), instance)) >= opacity;
}

// Embree may call this more than once per hit, so the decision is a hash of the hit. Rays come one
// at a time or in packets, whose fields are arrays of N.
void accel_alpha_filter(const struct RTCFilterFunctionNArguments *arguments)
{
    unsigned n = arguments->N;
    const unsigned *ray = (const unsigned *)arguments->ray, *hit = (const unsigned *)arguments->hit;
    for (unsigned i = 0; i < n; i++) {
        float uv[2];
        memcpy(&uv[0], &hit[3 * n + i], sizeof(float));
        memcpy(&uv[1], &hit[4 * n + i], sizeof(float));
        // Words of RTCRayN and RTCHitN: 10 = id; 3, 4 = u, v; 5 = primID; 7 = instID.
        if (arguments->valid[i] && passes(arguments->geometryUserPtr, hit[5 * n + i],
                                          hit[7 * n + i], uv[0], uv[1], ray[10 * n + i])) {
            arguments->valid[i] = 0;
        }
    }
}

static bool passes_thin(const AccelPiece *own, Vec3 normal, Vec3 direction, unsigned primitive,
                        unsigned key)
{
    float cosine = fabsf(vec3_dot(vec3_normalize(normal), direction));
    const Material *m = &own->accel->world->material[own->part->material];
    return random_unit(random_key(key, primitive)) >= material_shadow_opacity(m, cosine);
}

// Word number `word` of lane `lane` of one of Embree's packets of n.
static float packet_float(const unsigned *packet, unsigned n, unsigned word, unsigned lane)
{
    float x;
    memcpy(&x, &packet[word * n + lane], sizeof x);
    return x;
}

void accel_thin_filter(const struct RTCFilterFunctionNArguments *arguments)
{
    unsigned n = arguments->N;
    const unsigned *ray = (const unsigned *)arguments->ray, *hit = (const unsigned *)arguments->hit;
    for (unsigned i = 0; i < n; i++) {
        // RTCHitN has the normal in words 0 to 2, RTCRayN the direction in 4 to 6.
        Vec3 normal = vec3(packet_float(hit, n, 0, i), packet_float(hit, n, 1, i),
                           packet_float(hit, n, 2, i));
        Vec3 direction = vec3(packet_float(ray, n, 4, i), packet_float(ray, n, 5, i),
                              packet_float(ray, n, 6, i));
        if (arguments->valid[i] && passes_thin(arguments->geometryUserPtr, normal, direction,
                                               hit[5 * n + i], ray[10 * n + i])) {
            arguments->valid[i] = 0;
        }
    }
}

// Word 8 of RTCRayN is tfar: where the hit is.
void accel_glow_filter(const struct RTCFilterFunctionNArguments *arguments)
{
    const AccelContext *context = (const AccelContext *)arguments->context;
    const AccelPiece *own = arguments->geometryUserPtr;
    unsigned n = arguments->N;
    const unsigned *ray = (const unsigned *)arguments->ray;
    if (own->number != context->part) {
        return;
    }
    for (unsigned i = 0; i < n; i++) {
        if (arguments->valid[i] && packet_float(ray, n, 8, i) > context->from) {
            arguments->valid[i] = 0;
        }
    }
}

static AccelContext context_of(const Ray *ray)
{
    AccelContext context = {.from = ray->far - ray->slack,
                            .part = ray->slack > 0.0f ? ray->part : -1};
    rtcInitIntersectContext(&context.embree);
    return context;
}

static struct RTCRay embree_ray(const Ray *ray)
{
    return (struct RTCRay){.org_x = ray->origin.x,
                           .org_y = ray->origin.y,
                           .org_z = ray->origin.z,
                           .dir_x = ray->direction.x,
                           .dir_y = ray->direction.y,
                           .dir_z = ray->direction.z,
                           .tfar = ray->far,
                           .mask = ~0u,
                           .id = ray->key};
}

bool accel_intersect(const Accel *accel, const Ray *ray, Hit *hit)
{
    AccelContext context = context_of(ray);
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    struct RTCRayHit query = {.ray = embree_ray(ray)};
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(accel->scene, &context.embree, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return false;
    }
    bool instanced = query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    *hit = (Hit){query.ray.tfar,
                 query.hit.u,
                 query.hit.v,
                 vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z),
                 instanced ? query.hit.instID[0] : query.hit.geomID,
                 query.hit.primID,
                 instanced ? query.hit.geomID : 0};
    return true;
}

bool accel_occluded(const Accel *accel, const Ray *ray)
{
    AccelContext context = context_of(ray);
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    struct RTCRay query = embree_ray(ray);
    rtcOccluded1(accel->scene, &context.embree, &query);
    return query.tfar < 0.0f;
}

// ---- packets

static void set_packet_ray(struct RTCRay16 *packet, int i, const Ray *ray)
{
    packet->org_x[i] = ray->origin.x;
    packet->org_y[i] = ray->origin.y;
    packet->org_z[i] = ray->origin.z;
    packet->dir_x[i] = ray->direction.x;
    packet->dir_y[i] = ray->direction.y;
    packet->dir_z[i] = ray->direction.z;
    packet->tnear[i] = 0.0f;
    packet->tfar[i] = ray->far;
    packet->time[i] = 0.0f;
    packet->mask[i] = ~0u;
    packet->id[i] = ray->key;
    packet->flags[i] = 0;
}

static void intersect_packet(const Accel *accel, const Ray ray[], int count, bool coherent,
                             Hit hit[], bool met[])
{
    AccelContext context = context_of(&ray[0]);
    // Embree's packets for coherent rays take 1.6 times as long among leaves and grass, and are 5 %
    // faster elsewhere.
    context.embree.flags = coherent && accel->copied_faces == 0
                               ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                               : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    struct RTCRayHit16 query;
    int valid[PACKET_SIZE] __attribute__((aligned(64)));
    for (int i = 0; i < PACKET_SIZE; i++) {
        set_packet_ray(&query.ray, i, &ray[i < count ? i : 0]);
        query.hit.geomID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        valid[i] = i < count ? -1 : 0;
    }
    rtcIntersect16(valid, accel->scene, &context.embree, &query);
    for (int i = 0; i < count; i++) {
        met[i] = query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        bool instanced = query.hit.instID[0][i] != RTC_INVALID_GEOMETRY_ID;
        hit[i] = (Hit){query.ray.tfar[i],
                       query.hit.u[i],
                       query.hit.v[i],
                       vec3(query.hit.Ng_x[i], query.hit.Ng_y[i], query.hit.Ng_z[i]),
                       instanced ? query.hit.instID[0][i] : query.hit.geomID[i],
                       query.hit.primID[i],
                       instanced ? query.hit.geomID[i] : 0};
    }
}

void accel_intersect_many(const Accel *accel, const Ray ray[], int count, bool coherent, Hit hit[],
                          bool met[])
{
    int done = 0;
    for (; count - done >= LEAST_PACKET; done += PACKET_SIZE) {
        int n = count - done < PACKET_SIZE ? count - done : PACKET_SIZE;
        intersect_packet(accel, ray + done, n, coherent, hit + done, met + done);
    }
    for (; done < count; done++) {
        met[done] = accel_intersect(accel, &ray[done], &hit[done]);
    }
}

// The glow filter has one limit for a whole packet, so rays with slack cannot share one.
static bool has_slack(const Ray ray[], int count)
{
    for (int i = 0; i < count; i++) {
        if (ray[i].slack > 0.0f) {
            return true;
        }
    }
    return false;
}

static void occluded_packet(const Accel *accel, const Ray ray[], int count, bool blocked[])
{
    AccelContext context = context_of(&ray[0]);
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    struct RTCRay16 packet;
    int valid[PACKET_SIZE] __attribute__((aligned(64)));
    for (int i = 0; i < PACKET_SIZE; i++) {
        set_packet_ray(&packet, i, &ray[i < count ? i : 0]);
        valid[i] = i < count ? -1 : 0;
    }
    rtcOccluded16(valid, accel->scene, &context.embree, &packet);
    for (int i = 0; i < count; i++) {
        blocked[i] = packet.tfar[i] < 0.0f;
    }
}

void accel_occluded_many(const Accel *accel, const Ray ray[], int count, bool blocked[])
{
    for (int done = 0; done < count; done += PACKET_SIZE) {
        int n = count - done < PACKET_SIZE ? count - done : PACKET_SIZE;
        if (n >= LEAST_PACKET && !has_slack(ray + done, n)) {
            occluded_packet(accel, ray + done, n, blocked + done);
        } else {
            for (int i = done; i < done + n; i++) {
                blocked[i] = accel_occluded(accel, &ray[i]);
            }
        }
    }
}

int accel_light(const Accel *accel, const Hit *hit)
{
    AccelEntry entry = accel->entry[hit->geometry];
    return entry.piece < 0 ? (int)entry.instance : -1;
}

// A hit of a piece in terms of its mesh or curves.
typedef struct PieceHit {
    const AccelPiece *own;
    uint32_t instance, primitive;
    float u, v;
} PieceHit;

static PieceHit piece_hit(const Accel *accel, const Hit *hit)
{
    AccelEntry entry = accel->entry[hit->geometry];
    const AccelPiece *own = &accel->piece[entry.piece + (int32_t)hit->member];
    PieceHit at = {own, entry.instance, hit->primitive, hit->u, hit->v};
    if (own->copied) {
        uint32_t faces = (uint32_t)own->mesh->face_count;
        at.instance = accel_instance(own, hit->primitive / faces);
        at.primitive = hit->primitive % faces;
    } else if (own->pairs.count > 0) {
        at.primitive = pairs_triangle(own->pairs.face[hit->primitive], &at.u, &at.v);
    }
    return at;
}

SurfacePlace accel_place(const Accel *accel, const Hit *hit)
{
    PieceHit at = piece_hit(accel, hit);
    SurfacePlace place = {.part = at.own->number,
                          .instance = at.instance,
                          .primitive = at.primitive,
                          .u = at.u,
                          .v = at.v};
    if (!at.own->mesh) {
        place.point = at.own->segment[hit->primitive];
    }
    return place;
}

// Normals transform by the cofactor matrix: right for any scale, without an inverse. The sign of
// the determinant keeps them outside when the transform mirrors.
static Vec3 normal_to_world(const Transform *t, Vec3 n)
{
    Vec3 x = vec3(t->m[0][0], t->m[1][0], t->m[2][0]);
    Vec3 y = vec3(t->m[0][1], t->m[1][1], t->m[2][1]);
    Vec3 z = vec3(t->m[0][2], t->m[1][2], t->m[2][2]);
    Vec3 yz = vec3_cross(y, z);
    Vec3 sum = vec3_madd(vec3_scale(yz, n.x), n.y, vec3_cross(z, x));
    sum = vec3_madd(sum, n.z, vec3_cross(x, y));
    return vec3_dot(x, yz) < 0.0f ? vec3_neg(sum) : sum;
}

// The point lifted to the tangent planes of the vertices: Hanika, "Hacking the Shadow Terminator",
// Ray Tracing Gems II, 2021. All in the part's space; normals on the ray's side.
static Vec3 lift(const Mesh *mesh, const Corners *c, Vec3 p, float side)
{
    Vec3 lifted = p;
    for (int i = 0; i < 3; i++) {
        Vec3 n = vec3_scale(mesh->normal[c->vertex[i]], side);
        float depth = vec3_dot(vec3_sub(p, mesh->position[c->vertex[i]]), n);
        if (depth < 0.0f) {
            lifted = vec3_madd(lifted, -depth * c->weight[i], n);
        }
    }
    return lifted;
}

// dP/du and dP/dv of the triangle of c; false where uv is degenerate.
static bool uv_tangents(const Mesh *mesh, const Corners *c, Vec3 e1, Vec3 e2, SurfacePoint *point)
{
    Vec2 a = mesh->uv[c->vertex[0]], b = mesh->uv[c->vertex[1]], d = mesh->uv[c->vertex[2]];
    float u1 = b.x - a.x, v1 = b.y - a.y, u2 = d.x - a.x, v2 = d.y - a.y;
    float determinant = u1 * v2 - v1 * u2;
    if (fabsf(determinant) < 1e-20f) {
        return false;
    }
    float scale = 1.0f / determinant;
    point->tangent_u = vec3_scale(vec3_madd(vec3_scale(e1, v2), -v1, e2), scale);
    point->tangent_v = vec3_scale(vec3_madd(vec3_scale(e2, u1), -u2, e1), scale);
    return true;
}

// An interpolated normal on the facet's side, bent until it faces the ray's origin at least
// grazingly.
static Vec3 smooth_normal(Vec3 n, Vec3 facet, Vec3 direction)
{
    const float least = 1e-3f;
    n = vec3_dot(n, facet) < 0.0f ? vec3_neg(n) : n;
    float cosine = -vec3_dot(n, direction);
    return cosine >= least ? n : vec3_normalize(vec3_madd(n, cosine - 2.0f * least, direction));
}

static void mesh_surface(const PieceHit *at, const Transform *t, Vec3 direction,
                         SurfacePoint *point)
{
    const Mesh *mesh = at->own->mesh;
    Corners c = accel_corners(mesh, at->primitive, at->u, at->v);
    Vec3 a = mesh->position[c.vertex[0]];
    Vec3 e1 = vec3_sub(mesh->position[c.vertex[1]], a);
    Vec3 e2 = vec3_sub(mesh->position[c.vertex[2]], a);
    Vec3 p = vec3_madd(vec3_madd(a, c.weight[1], e1), c.weight[2], e2);
    Vec3 facet = vec3_cross(e1, e2);
    Vec3 geometric = vec3_normalize(t ? normal_to_world(t, facet) : facet);
    point->backface = vec3_dot(geometric, direction) > 0.0f;
    float side = point->backface ? -1.0f : 1.0f;
    point->object_position = p;
    point->position = point->lifted = t ? transform_point(t, p) : p;
    point->facet_normal = point->normal = vec3_scale(geometric, side);
    if (mesh->normal) {
        Vec3 n = vec3_scale(mesh->normal[c.vertex[0]], c.weight[0]);
        n = vec3_madd(n, c.weight[1], mesh->normal[c.vertex[1]]);
        n = vec3_madd(n, c.weight[2], mesh->normal[c.vertex[2]]);
        n = vec3_normalize(t ? normal_to_world(t, n) : n);
        if (vec3_dot(n, n) > 0.0f) {
            point->normal = smooth_normal(n, point->facet_normal, direction);
            Vec3 lifted = lift(mesh, &c, p, side);
            point->lifted = t ? transform_point(t, lifted) : lifted;
        }
    }
    point->geometric_normal = point->normal;
    if (mesh->uv) {
        point->uv = accel_uv(mesh, &c);
    }
    if (!mesh->uv || !uv_tangents(mesh, &c, e1, e2, point)) {
        point->tangent_u = e1;
        point->tangent_v = e2;
    }
    if (t) {
        point->tangent_u = transform_vector(t, point->tangent_u);
        point->tangent_v = transform_vector(t, point->tangent_v);
    }
    for (int i = 0; i < 3 && mesh->radius; i++) {
        point->radius += c.weight[i] * mesh->radius[c.vertex[i]];
    }
    for (int i = 0; i < 3 && mesh->birth; i++) {
        point->birth += c.weight[i] * mesh->birth[c.vertex[i]];
    }
    for (int i = 0; i < 3 && mesh->site; i++) {
        point->site.x += c.weight[i] * mesh->site[c.vertex[i]].x;
        point->site.y += c.weight[i] * mesh->site[c.vertex[i]].y;
    }
    point->epsilon = 4e-6f * vec3_largest(point->position) + 1e-7f;
}

// Without vertex attributes the hit holds all that is needed, and no vertex is fetched from memory.
static void plain_surface(const Ray *ray, const Hit *hit, const Transform *t, SurfacePoint *point)
{
    Vec3 normal = vec3_normalize(t ? normal_to_world(t, hit->normal) : hit->normal);
    point->backface = vec3_dot(normal, ray->direction) > 0.0f;
    point->normal = point->backface ? vec3_neg(normal) : normal;
    point->facet_normal = point->geometric_normal = point->normal;
    point->position = point->lifted = vec3_madd(ray->origin, hit->t, ray->direction);
    point->object_position = point->position;
    Transform inverse;
    if (t && transform_inverse(t, &inverse)) {
        point->object_position = transform_point(&inverse, point->position);
    }
    float reach = vec3_largest(point->position);
    point->epsilon = 4e-6f * (reach > hit->t ? reach : hit->t) + 1e-7f;
}

static void curve_surface(const AccelPiece *own, const Ray *ray, const Hit *hit, const Transform *t,
                          SurfacePoint *point)
{
    plain_surface(ray, hit, t, point);
    const CurveSet *curves = own->part->curves;
    uint32_t k = own->segment[hit->primitive];
    Vec3 axis = vec3_sub(curves->position[k + 1], curves->position[k]);
    point->radius = lerpf(curves->radius[k], curves->radius[k + 1], hit->u);
    point->birth = curves->birth ? lerpf(curves->birth[k], curves->birth[k + 1], hit->u) : 0.0f;
    if (curves->along) {
        point->uv.y = lerpf(curves->along[k], curves->along[k + 1], hit->u);
    }
    point->tangent_v = vec3_normalize(t ? transform_vector(t, axis) : axis);
    point->tangent_u = vec3_cross(point->tangent_v, point->normal);
    point->epsilon *= 2.5f; // Embree meets curves less precisely than triangles
}

void accel_surface(const Accel *accel, const Ray *ray, const Hit *hit, SurfacePoint *point)
{
    PieceHit at = piece_hit(accel, hit);
    const AccelPiece *own = at.own;
    const Part *part = own->part;
    *point = (SurfacePoint){.variation = part->instance ? part_variation(part, at.instance)
                                                        : own->base_variation,
                            .material = part->material,
                            .object = part->object,
                            .part = own->number};
    const Transform *t = part->instance ? &part->instance[at.instance] : NULL;
    if (own->plain) {
        plain_surface(ray, hit, t, point);
        Vec3 n = point->normal; // any two directions in the plane
        point->tangent_u = fabsf(n.x) > 0.5f ? vec3(-n.y, n.x, 0.0f) : vec3(0.0f, -n.z, n.y);
        point->tangent_v = vec3_cross(n, point->tangent_u);
    } else if (own->mesh) {
        mesh_surface(&at, t, ray->direction, point);
    } else {
        curve_surface(own, ray, hit, t, point);
    }
}
