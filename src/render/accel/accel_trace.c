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

// Lanes beyond count repeat the first ray; valid is 0 there.
static void fill_packet(struct RTCRay16 *packet, const Ray ray[], int count, int valid[])
{
    for (int i = 0; i < PACKET_SIZE; i++) {
        const Ray *r = &ray[i < count ? i : 0];
        packet->org_x[i] = r->origin.x;
        packet->org_y[i] = r->origin.y;
        packet->org_z[i] = r->origin.z;
        packet->dir_x[i] = r->direction.x;
        packet->dir_y[i] = r->direction.y;
        packet->dir_z[i] = r->direction.z;
        packet->tfar[i] = r->far;
        packet->id[i] = r->key;
        valid[i] = i < count ? -1 : 0;
    }
    memset(packet->tnear, 0, sizeof packet->tnear);
    memset(packet->time, 0, sizeof packet->time);
    memset(packet->mask, 0xff, sizeof packet->mask);
    memset(packet->flags, 0, sizeof packet->flags);
}

static void intersect_packet(const Accel *accel, const Ray ray[], int count, Hit hit[], bool met[])
{
    AccelContext context = context_of(&ray[0]);
    // Never as coherent rays: Embree's frustums miss thin flat geometry, and take 1.6 times as long
    // among leaves and grass.
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    struct RTCRayHit16 query;
    int valid[PACKET_SIZE] __attribute__((aligned(64)));
    fill_packet(&query.ray, ray, count, valid);
    for (int i = 0; i < PACKET_SIZE; i++) {
        query.hit.geomID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
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

void accel_intersect_many(const Accel *accel, const Ray ray[], int count, Hit hit[], bool met[])
{
    int done = 0;
    for (; count - done >= LEAST_PACKET; done += PACKET_SIZE) {
        int n = count - done < PACKET_SIZE ? count - done : PACKET_SIZE;
        intersect_packet(accel, ray + done, n, hit + done, met + done);
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
    fill_packet(&packet, ray, count, valid);
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
