#include "mesh/skin_cage.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "mesh/skin_ring.h"
#include "mesh/skin_slots.h"

#include <stdlib.h>

// A chain to be built, and the hole in its parent's surface that its tube starts from.
typedef struct TubeJob {
    int32_t chain;
    bool has_mouth; // false at a root
    uint32_t mouth[4];
} TubeJob;

typedef struct CageBuilder {
    SkinCage *cage;
    const SkinPlan *plan;
    int64_t *child_first; // per chain + 1, into child
    int32_t *child;       // visible chains, by parent
    SkinSlots slots;
    SkinRing *ring; // of the chain at hand, the mouth first if there is one
    int64_t ring_capacity;
    TubeJob *job; // stack
    int64_t job_count, job_capacity;
} CageBuilder;

void skin_cage_clear(SkinCage *cage)
{
    free(cage->position);
    free(cage->uv);
    free(cage->radius);
    free(cage->birth);
    free(cage->index);
    free(cage->face_axis);
}

// ---- vertices and faces ----

static bool reserve_vertices(SkinCage *cage, int64_t more, Error *e)
{
    int64_t count = cage->vertex_count + more;
    if (count > UINT32_MAX) {
        return error_set(e, ERROR_MEMORY, "the skin needs 2^32 vertices or more; raise min_radius");
    }
    return memory_reserve(&cage->position, &cage->position_capacity, count, sizeof(Vec3), e) &&
           memory_reserve(&cage->uv, &cage->uv_capacity, count, sizeof(Vec2), e) &&
           memory_reserve(&cage->radius, &cage->radius_capacity, count, sizeof(float), e) &&
           memory_reserve(&cage->birth, &cage->birth_capacity, count, sizeof(float), e);
}

static bool reserve_faces(SkinCage *cage, int64_t more, Error *e)
{
    int64_t count = cage->face_count + more;
    return memory_reserve(&cage->index, &cage->index_capacity, 4 * count, sizeof(uint32_t), e) &&
           memory_reserve(&cage->face_axis, &cage->axis_capacity, count, sizeof(Vec3), e);
}

static uint32_t add_vertex(SkinCage *cage, Vec3 position, Vec2 uv, float radius, float birth)
{
    int64_t i = cage->vertex_count++;
    cage->position[i] = position;
    cage->uv[i] = uv;
    cage->radius[i] = radius;
    cage->birth[i] = birth;
    return (uint32_t)i;
}

static void add_face(SkinCage *cage, uint32_t a, uint32_t b, uint32_t c, uint32_t d, Vec3 axis)
{
    uint32_t *corner = cage->index + 4 * cage->face_count;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    corner[3] = d;
    cage->face_axis[cage->face_count++] = axis;
}

// The four corners of a ring. u runs from 0 at corner 0 both ways round to half the girth at
// corner 2: mirrored, so that it is continuous without a seam.
static void add_ring_vertices(SkinCage *cage, const SkinRing *ring, float offset, uint32_t loop[4])
{
    static const float way_round[4] = {0, 1, 2, 1};
    for (int k = 0; k < 4; k++) {
        Vec2 uv = {0.5f * PI_F * ring->radius * way_round[k], offset + ring->along};
        loop[k] = add_vertex(cage, ring->corner[k], uv, ring->radius, ring->birth);
    }
}

// ---- a child's mouth in its parent's face ----

// A rectangle in a face's bilinear coordinates.
typedef struct Inset {
    float x, y, half_x, half_y;
} Inset;

// Where the child's square fits into the face. corner: the face's; at: the child where it comes
// out.
static Inset fit_inset(const Vec3 corner[4], const SkinPoint *at, float radius, float sine)
{
    Vec3 u =
        vec3_scale(vec3_sub(vec3_add(corner[1], corner[2]), vec3_add(corner[0], corner[3])), 0.5f);
    Vec3 v =
        vec3_scale(vec3_sub(vec3_add(corner[2], corner[3]), vec3_add(corner[0], corner[1])), 0.5f);
    Vec3 middle =
        vec3_scale(vec3_add(vec3_add(corner[0], corner[1]), vec3_add(corner[2], corner[3])), 0.25f);
    Vec3 offset = vec3_sub(at->position, middle);
    float width2 = vec3_dot(u, u), height2 = vec3_dot(v, v), reach = SKIN_FACE_SCALE * radius;
    Inset inset = {.half_x = 0.36f, .half_y = 0.36f, .x = 0.5f, .y = 0.5f};
    if (width2 > 0.0f) {
        inset.half_x = clampf(reach / sqrtf(width2), 0.001f, 0.36f);
        inset.x += vec3_dot(offset, u) / width2;
    }
    if (height2 > 0.0f) {
        inset.half_y = clampf(reach / clampf(sine, 0.5f, 1.0f) / sqrtf(height2), 0.001f, 0.36f);
        inset.y += vec3_dot(offset, v) / height2;
    }
    float margin_x = inset.half_x + 0.12f > 0.3f ? inset.half_x + 0.12f : 0.3f;
    float margin_y = inset.half_y + 0.12f;
    inset.x = clampf(inset.x, margin_x, 1.0f - margin_x);
    inset.y = clampf(inset.y, margin_y, 1.0f - margin_y);
    return inset;
}

typedef struct Bilinear {
    uint32_t index[4];
    Vec3 axis_low, axis_high;      // the parent's axis below and above the face
    float radius_low, radius_high; // of the parent
} Bilinear;

// A point of the face at (x, y), drawn `pull` of the way to the parent's surface proper.
static uint32_t add_face_vertex(SkinCage *cage, const Bilinear *face, float x, float y, float pull,
                                float child_radius)
{
    float weight[4] = {(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y};
    Vec3 position = vec3(0, 0, 0);
    Vec2 uv = {0, 0};
    float birth = 0.0f;
    for (int k = 0; k < 4; k++) {
        uint32_t i = face->index[k];
        position = vec3_madd(position, weight[k], cage->position[i]);
        uv.x += weight[k] * cage->uv[i].x;
        uv.y += weight[k] * cage->uv[i].y;
        birth += weight[k] * cage->birth[i];
    }
    Vec3 axis = vec3_lerp(face->axis_low, face->axis_high, y);
    float radius = lerpf(face->radius_low, face->radius_high, y);
    Vec3 out = vec3_sub(position, axis);
    float distance = vec3_length(out);
    if (distance > radius) {
        position = vec3_madd(axis, lerpf(1.0f, radius / distance, pull), out);
    }
    return add_vertex(cage, position, uv, lerpf(radius, child_radius, pull), birth);
}

// Replaces a side face by frames of quads that shrink to the child's own square, and leaves that
// open for the child's tube.
static bool open_mouth(CageBuilder *builder, int32_t number, const Bilinear *face, Error *e)
{
    SkinCage *cage = builder->cage;
    const SkinChain *child = &builder->plan->chain[number];
    SkinPoint at = skin_axis_at(builder->plan, number, child->exit);
    Vec3 corner[4];
    for (int k = 0; k < 4; k++) {
        corner[k] = cage->position[face->index[k]];
    }
    float radius = skin_axis_at(builder->plan, number, child->start).radius;
    Inset inset = fit_inset(corner, &at, radius, child->exit_sine);
    float smaller = inset.half_x < inset.half_y ? inset.half_x : inset.half_y;
    int frames = 1;
    for (float ratio = 0.5f / smaller; ratio > 2.8f; ratio *= 0.5f) {
        frames++;
    }
    if (!reserve_vertices(cage, 4 * frames, e) || !reserve_faces(cage, 4 * frames, e) ||
        !memory_reserve(&builder->job, &builder->job_capacity, builder->job_count + 1,
                        sizeof(TubeJob), e)) {
        return false;
    }
    Vec3 axis = vec3_lerp(face->axis_low, face->axis_high, 0.5f);
    TubeJob job = {.chain = number, .has_mouth = true};
    uint32_t outer[4] = {face->index[0], face->index[1], face->index[2], face->index[3]};
    for (int i = 1; i <= frames; i++) {
        float t = (float)i / (float)frames;
        float half_x = 0.5f * exact_pow(2.0f * inset.half_x, t);
        float half_y = 0.5f * exact_pow(2.0f * inset.half_y, t);
        // The centre moves only as fast as the room within the frame before allows.
        float x = 0.5f + (inset.x - 0.5f) * (0.5f - half_x) / (0.5f - inset.half_x);
        float y = 0.5f + (inset.y - 0.5f) * (0.5f - half_y) / (0.5f - inset.half_y);
        for (int k = 0; k < 4; k++) {
            float px = k == 0 || k == 3 ? x - half_x : x + half_x;
            float py = k < 2 ? y - half_y : y + half_y;
            job.mouth[k] = add_face_vertex(cage, face, px, py, 0.7f * t, radius);
        }
        for (int k = 0; k < 4; k++) {
            int next = (k + 1) & 3;
            add_face(cage, outer[k], outer[next], job.mouth[next], job.mouth[k], axis);
        }
        for (int k = 0; k < 4; k++) {
            outer[k] = job.mouth[k];
        }
    }
    builder->job[builder->job_count++] = job;
    return true;
}

// ---- a chain's tube ----

// The twist at which the chain's first ring lies squarely over its mouth.
static float mouth_phase(const SkinPlan *plan, int32_t chain, const SkinRing *mouth)
{
    SkinPoint start = skin_axis_at(plan, chain, plan->chain[chain].start);
    Vec3 v = vec3_cross(mouth->normal, mouth->side);
    v = vec3_madd(v, -vec3_dot(v, start.tangent), start.tangent);
    Vec3 u = vec3_cross(v, start.tangent);
    return exact_atan2(vec3_dot(u, vec3_cross(start.tangent, start.side)), vec3_dot(u, start.side));
}

static SkinRing ring_at(const SkinPlan *plan, int32_t chain, const SkinStation *station)
{
    SkinPoint at = skin_axis_at(plan, chain, station->along);
    float sine, cosine;
    exact_sincos(station->twist, &sine, &cosine);
    SkinRing ring = {.centre = at.position,
                     .normal = at.tangent,
                     .side = vec3_rotate(at.side, at.tangent, cosine, sine),
                     .radius = at.radius,
                     .along = station->along,
                     .birth = at.birth};
    skin_ring_set_corners(&ring);
    return ring;
}

// Rings of all stations, after the mouth if there is one.
static bool lay_rings(CageBuilder *builder, const TubeJob *job, const SkinRing *mouth, Error *e)
{
    const SkinSlots *slots = &builder->slots;
    int64_t extra = job->has_mouth ? 1 : 0;
    if (!memory_reserve(&builder->ring, &builder->ring_capacity, slots->station_count + extra,
                        sizeof(SkinRing), e)) {
        return false;
    }
    SkinRing *ring = builder->ring + extra;
    for (int64_t i = 0; i < slots->station_count; i++) {
        ring[i] = ring_at(builder->plan, job->chain, &slots->station[i]);
    }
    if (job->has_mouth) {
        builder->ring[0] = *mouth;
        // A tube that leaves nearly along its parent's surface first turns outwards.
        float rise = vec3_dot(ring[0].normal, mouth->normal);
        if (rise < 0.4f) {
            ring[0].normal = vec3_normalize(vec3_madd(ring[0].normal, 0.5f - rise, mouth->normal));
            skin_ring_set_corners(&ring[0]);
        }
    }
    skin_rings_settle(builder->ring, slots->station_count + extra);
    return true;
}

static void add_cap(SkinCage *cage, const uint32_t loop[4], bool at_end, Vec3 inside)
{
    if (at_end) {
        add_face(cage, loop[0], loop[1], loop[2], loop[3], inside);
    } else {
        add_face(cage, loop[3], loop[2], loop[1], loop[0], inside);
    }
}

// The four sides between two rings; those with a child become its mouth.
static bool add_sides(CageBuilder *builder, const SkinRing *low, const uint32_t lower[4],
                      const uint32_t upper[4], const int32_t *child, Error *e)
{
    const SkinRing *high = low + 1;
    Vec3 axis = vec3_lerp(low->centre, high->centre, 0.5f);
    for (int k = 0; k < 4; k++) {
        int next = (k + 1) & 3;
        if (!child || child[k] < 0) {
            add_face(builder->cage, lower[k], lower[next], upper[next], upper[k], axis);
            continue;
        }
        Bilinear face = {.index = {lower[k], lower[next], upper[next], upper[k]},
                         .axis_low = low->centre,
                         .axis_high = high->centre,
                         .radius_low = low->radius,
                         .radius_high = high->radius};
        if (!open_mouth(builder, child[k], &face, e) || !reserve_faces(builder->cage, 8, e)) {
            return false;
        }
    }
    return true;
}

static bool add_tube(CageBuilder *builder, const TubeJob *job, Error *e)
{
    SkinCage *cage = builder->cage;
    const SkinSlots *slots = &builder->slots;
    int64_t extra = job->has_mouth ? 1 : 0, count = slots->station_count + extra;
    float offset = builder->plan->chain[job->chain].offset;
    uint32_t lower[4], upper[4];
    for (int k = 0; k < 4; k++) {
        lower[k] = job->mouth[k];
    }
    for (int64_t i = 0; i < count; i++) {
        if (!reserve_vertices(cage, 4, e) || !reserve_faces(cage, 8, e)) {
            return false;
        }
        if (i < extra) {
            continue; // the mouth's vertices are there
        }
        const SkinRing *ring = &builder->ring[i];
        add_ring_vertices(cage, ring, offset, upper);
        if (i == 0) {
            add_cap(cage, upper, false, vec3_madd(ring->centre, ring->radius, ring->normal));
        } else {
            const int32_t *child = i > extra ? slots->station[i - extra - 1].child : NULL;
            if (!add_sides(builder, ring - 1, lower, upper, child, e)) {
                return false;
            }
        }
        for (int k = 0; k < 4; k++) {
            lower[k] = upper[k];
        }
    }
    const SkinRing *last = &builder->ring[count - 1];
    add_cap(cage, lower, true, vec3_madd(last->centre, -last->radius, last->normal));
    return true;
}

static bool build_chain(CageBuilder *builder, const TubeJob *job, Error *e)
{
    const SkinPlan *plan = builder->plan;
    SkinSlots *slots = &builder->slots;
    int64_t first = builder->child_first[job->chain], end = builder->child_first[job->chain + 1];
    if (!memory_reserve(&slots->child, &slots->child_capacity, end - first, sizeof(int32_t), e)) {
        return false;
    }
    slots->child_count = end - first;
    for (int64_t i = first; i < end; i++) {
        slots->child[i - first] = builder->child[i];
    }
    SkinRing mouth = {.radius = 0.0f};
    float phase = 0.0f;
    if (job->has_mouth) {
        Vec3 corner[4];
        for (int k = 0; k < 4; k++) {
            corner[k] = builder->cage->position[job->mouth[k]];
        }
        mouth = skin_ring_from_corners(corner);
        phase = mouth_phase(plan, job->chain, &mouth);
    }
    return skin_slots_place(slots, plan, job->chain, phase, e) &&
           lay_rings(builder, job, &mouth, e) && add_tube(builder, job, e);
}

// ---- the whole ----

static bool gather_children(CageBuilder *builder, Error *e)
{
    const SkinPlan *plan = builder->plan;
    builder->child_first = memory_alloc_zero(plan->chain_count + 2, sizeof(int64_t), e);
    builder->child = memory_alloc(plan->chain_count, sizeof(int32_t), e);
    if (!builder->child_first || !builder->child) {
        return false;
    }
    // Counted two places further on, so that filling moves each start to where it belongs.
    int64_t *first = builder->child_first;
    for (int64_t i = 0; i < plan->chain_count; i++) {
        if (plan->chain[i].parent >= 0 && plan->chain[i].visible) {
            first[plan->chain[i].parent + 2]++;
        }
    }
    for (int64_t i = 0; i < plan->chain_count; i++) {
        first[i + 2] += first[i + 1];
    }
    for (int64_t i = 0; i < plan->chain_count; i++) {
        if (plan->chain[i].parent >= 0 && plan->chain[i].visible) {
            builder->child[first[plan->chain[i].parent + 1]++] = (int32_t)i;
        }
    }
    return true;
}

static bool build_root(CageBuilder *builder, int32_t chain, const Run *run, Error *e)
{
    TubeJob job = {.chain = chain};
    bool good = build_chain(builder, &job, e);
    while (good && builder->job_count > 0) {
        job = builder->job[--builder->job_count];
        good = run_is_cancelled(run) ? run_cancel_error(e) : build_chain(builder, &job, e);
    }
    return good;
}

bool skin_cage_build(SkinCage *cage, const SkinPlan *plan, const Run *run, Error *e)
{
    *cage = (SkinCage){0};
    CageBuilder builder = {.cage = cage, .plan = plan};
    bool good = gather_children(&builder, e);
    for (int64_t i = 0; good && i < plan->chain_count; i++) {
        if (plan->chain[i].parent < 0) {
            good = build_root(&builder, (int32_t)i, run, e);
        }
    }
    free(builder.child_first);
    free(builder.child);
    free(builder.ring);
    free(builder.job);
    skin_slots_clear(&builder.slots);
    return good;
}
