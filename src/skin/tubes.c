// Builds the cage chain by chain: rings at the stations, quads between them, mouths for the
// children, caps at the ends.
#include "base/exact_math.h"
#include "base/memory.h"
#include "skin/cage.h"
#include "skin/girth.h"
#include "skin/grid.h"
#include "skin/lumen.h"
#include "skin/mouth.h"
#include "skin/ring.h"

#include <stdlib.h>

#define NO_NAME UINT32_MAX

// A chain to build, and the hole in its parent's surface where its tube starts.
typedef struct TubeJob {
    int32_t chain;
    int sides; // sides of the mouth; 0 at a root
    uint32_t mouth[SKIN_MAX_SIDES];
} TubeJob;

typedef struct TubeBuilder {
    SkinCage *cage;
    const SkinPlan *plan;
    int64_t *child_first; // per chain + 1, its first index in child
    int32_t *child;       // visible chains, grouped by parent
    SkinGrid grid;
    SkinRing *ring; // of the current chain, beginning with the mouth if there is one
    Vec3 *corner;   // corners of the rings
    uint32_t *name; // vertex indices of the rings
    int64_t ring_capacity, corner_capacity, name_capacity;
    TubeJob *job; // stack
    int64_t job_count, job_capacity;
} TubeBuilder;

// ---- rings ----

static bool reserve_rings(TubeBuilder *builder, const TubeJob *job, int64_t *corners, Error *e)
{
    const SkinGrid *grid = &builder->grid;
    *corners = job->sides;
    for (int64_t i = 0; i < grid->station_count; i++) {
        *corners += grid->station[i].sides;
    }
    return memory_reserve(&builder->ring, &builder->ring_capacity, grid->station_count + 1,
                          sizeof(SkinRing), e) &&
           memory_reserve(&builder->corner, &builder->corner_capacity, *corners, sizeof(Vec3), e) &&
           memory_reserve(&builder->name, &builder->name_capacity, *corners, sizeof(uint32_t), e);
}

// A branch is thicker where it leaves its parent: within about one radius of that place.
static float collar_at(const SkinPlan *plan, int32_t chain, float along, float radius)
{
    const SkinChain *own = &plan->chain[chain];
    float way = own->parent >= 0 ? (along - own->exit) / radius : 0.0f;
    float fall = way > 0.0f ? 1.0f + 0.6f * way * way : 1.0f;
    return own->parent >= 0 ? plan->params.collar / (fall * fall) : 0.0f;
}

static void set_ring(const SkinPlan *plan, int32_t chain, float along, float phase, SkinRing *ring)
{
    SkinPoint at = skin_axis_at(plan, chain, along);
    float sine, cosine;
    exact_sincos(phase, &sine, &cosine);
    ring->centre = at.position;
    ring->normal = at.tangent;
    ring->side = vec3_rotate(at.side, at.tangent, cosine, sine);
    ring->radius = at.radius * (1.0f + collar_at(plan, chain, along, at.radius));
    ring->along = along;
    ring->birth = at.birth;
    ring->uneven = plan->girth;
    if (ring->uneven) {
        ring->girth = skin_girth_turned(skin_girth_at(plan, chain, along), phase);
        skin_girth_limit(&ring->girth, ring->sides / 2);
    }
    skin_ring_set_corners(ring);
}

static SkinRing mouth_ring(const TubeBuilder *builder, const TubeJob *job, Vec3 *corner,
                           uint32_t *name)
{
    SkinRing ring = {.corner = corner, .name = name, .sides = job->sides};
    for (int k = 0; k < job->sides; k++) {
        name[k] = job->mouth[k];
        corner[k] = builder->cage->position[name[k]];
    }
    skin_ring_fit(&ring);
    return ring;
}

// Phase that aligns the chain's first ring with its mouth.
static float mouth_phase(const SkinPlan *plan, int32_t chain, const SkinRing *mouth)
{
    SkinPoint start = skin_axis_at(plan, chain, plan->chain[chain].start);
    Vec3 v = vec3_cross(mouth->normal, mouth->side);
    v = vec3_madd(v, -vec3_dot(v, start.tangent), start.tangent);
    Vec3 u = vec3_cross(v, start.tangent);
    return exact_atan2(vec3_dot(u, vec3_cross(start.tangent, start.side)), vec3_dot(u, start.side));
}

// A tube that leaves nearly parallel to its parent's surface first turns outward.
static void turn_outwards(SkinRing *ring, const SkinRing *mouth)
{
    float rise = vec3_dot(ring->normal, mouth->normal);
    if (rise < 0.4f) {
        ring->normal = vec3_normalize(vec3_madd(ring->normal, 0.5f - rise, mouth->normal));
        skin_ring_set_corners(ring);
    }
}

// Six edges meet at every other corner of a ring above a reduction, where the limit surface is
// closer to the corner, so these corners are moved inward.
static void draw_in_above_reductions(SkinRing *ring, int64_t count)
{
    for (int64_t i = 1; i < count; i++) {
        if (ring[i].sides == ring[i - 1].sides) {
            continue;
        }
        float fine = skin_ring_scale(ring[i - 1].sides), coarse = skin_ring_scale(ring[i].sides);
        float draw = lerpf(1.0f, fine / coarse, 0.35f);
        for (int k = 0; k < ring[i].sides; k += 2) {
            Vec3 out = vec3_sub(ring[i].corner[k], ring[i].centre);
            ring[i].corner[k] = vec3_madd(ring[i].centre, draw, out);
        }
    }
}

// Places rings at all stations, after the mouth if there is one; *count of them.
static bool lay_rings(TubeBuilder *builder, const TubeJob *job, float phase, int64_t *count,
                      Error *e)
{
    const SkinGrid *grid = &builder->grid;
    int64_t corners, used = job->sides, extra = job->sides > 0;
    if (!reserve_rings(builder, job, &corners, e) ||
        !skin_cage_reserve(builder->cage, corners, 0, e)) {
        return false;
    }
    for (int64_t i = 0; i < corners; i++) {
        builder->name[i] = NO_NAME;
    }
    if (extra) {
        builder->ring[0] = mouth_ring(builder, job, builder->corner, builder->name);
    }
    for (int64_t i = 0; i < grid->station_count; i++) {
        const SkinStation *station = &grid->station[i];
        SkinRing *ring = &builder->ring[i + extra];
        *ring = (SkinRing){.corner = builder->corner + used,
                           .name = builder->name + used,
                           .sides = station->sides};
        set_ring(builder->plan, job->chain, station->along, phase, ring);
        used += station->sides;
    }
    if (extra) {
        turn_outwards(&builder->ring[1], &builder->ring[0]);
    }
    *count = grid->station_count + extra;
    skin_rings_settle(builder->ring, *count);
    draw_in_above_reductions(builder->ring, *count);
    return true;
}

// Vertex index of a ring's corner in the cage, assigned on first use: corners inside blocks get
// none.
static uint32_t name_corner(TubeBuilder *builder, const SkinRing *ring, int k, float offset)
{
    if (ring->name[k] == NO_NAME) {
        ring->name[k] = skin_cage_add_vertex(builder->cage, skin_ring_vertex(ring, k, offset));
    }
    return ring->name[k];
}

// ---- rows ----

static bool add_row(TubeBuilder *builder, const SkinRing *low, uint32_t taken, float offset,
                    Error *e)
{
    const SkinRing *high = low + 1;
    Vec3 axis = vec3_lerp(low->centre, high->centre, 0.5f);
    if (!skin_cage_reserve(builder->cage, 2 * low->sides, low->sides, e)) {
        return false;
    }
    for (int k = 0; k < low->sides; k++) {
        int next = (k + 1) % low->sides;
        if (taken & 1u << k) {
            continue;
        }
        uint32_t a = name_corner(builder, low, k, offset);
        uint32_t b = name_corner(builder, low, next, offset);
        uint32_t c = name_corner(builder, high, next, offset);
        uint32_t d = name_corner(builder, high, k, offset);
        skin_cage_add_face(builder->cage, a, b, c, d, axis);
    }
    return true;
}

// The vertex between a ring's corner k and the next ring, which has half as many corners.
static SkinVertex half_way(const SkinRing *low, const SkinRing *high, int k, float offset)
{
    SkinVertex below = skin_ring_vertex(low, k, offset), half = {.radius = 0.0f};
    SkinVertex above = skin_ring_vertex(high, k / 2, offset);
    above.position = skin_ring_finer_corner(high, low->sides, k);
    above.uv.x = below.uv.x;
    half = skin_vertex_madd(half, 0.5f, below);
    half = skin_vertex_madd(half, 0.5f, above);
    // The limit surface is closer to the cage with many sides than with few: these vertices are
    // moved as near to the axis as the ring below, or there would be a bulge.
    Vec3 axis = vec3_lerp(low->centre, high->centre, 0.5f);
    float fine = skin_ring_scale(low->sides), coarse = skin_ring_scale(high->sides);
    float draw = 2.0f * fine / (fine + coarse);
    half.position = vec3_madd(axis, draw, vec3_sub(half.position, axis));
    return half;
}

// Adds a row that ends in half as many sides: six quads for every four sides below.
static bool add_reduction(TubeBuilder *builder, const SkinRing *low, float offset, Error *e)
{
    const SkinRing *high = low + 1;
    SkinCage *cage = builder->cage;
    // Axis points nearest to the outer, lower and upper faces.
    Vec3 beside = vec3_lerp(low->centre, high->centre, 0.375f);
    Vec3 lower = vec3_lerp(low->centre, high->centre, 0.25f);
    Vec3 upper = vec3_lerp(low->centre, high->centre, 0.75f);
    if (!skin_cage_reserve(cage, 4 * low->sides, 2 * low->sides, e)) {
        return false;
    }
    for (int g = 0; g < low->sides / 4; g++) {
        uint32_t below[5], inner[3], above[3];
        for (int k = 0; k < 5; k++) {
            below[k] = name_corner(builder, low, (4 * g + k) % low->sides, offset);
        }
        for (int k = 0; k < 3; k++) {
            above[k] = name_corner(builder, high, (2 * g + k) % high->sides, offset);
            inner[k] = skin_cage_add_vertex(cage, half_way(low, high, 4 * g + k + 1, offset));
        }
        skin_cage_add_face(cage, below[0], below[1], inner[0], above[0], beside);
        skin_cage_add_face(cage, below[1], below[2], inner[1], inner[0], lower);
        skin_cage_add_face(cage, below[2], below[3], inner[2], inner[1], lower);
        skin_cage_add_face(cage, below[3], below[4], above[2], inner[2], beside);
        skin_cage_add_face(cage, inner[0], inner[1], above[1], above[0], upper);
        skin_cage_add_face(cage, inner[1], inner[2], above[2], above[1], upper);
    }
    return true;
}

static bool add_cap(TubeBuilder *builder, const SkinRing *ring, bool at_end, Error *e)
{
    uint32_t loop[SKIN_MAX_SIDES];
    for (int k = 0; k < ring->sides; k++) {
        loop[at_end ? k : ring->sides - 1 - k] = ring->name[k];
    }
    float inwards = at_end ? -ring->radius : ring->radius;
    return skin_cage_cap(builder->cage, loop, ring->sides,
                         vec3_madd(ring->centre, inwards, ring->normal), e);
}

static bool close_root(TubeBuilder *builder, const SkinRing *ring, float offset, Error *e)
{
    float wall = builder->plan->params.wall;
    return wall > 0.0f ? skin_lumen_close(builder->cage, ring, wall, offset, e)
                       : add_cap(builder, ring, false, e);
}

static bool open_mouths(TubeBuilder *builder, int32_t chain, const SkinRing *ring, float phase,
                        Error *e)
{
    for (int64_t i = 0; i < builder->grid.seat_count; i++) {
        const SkinSeat *seat = &builder->grid.seat[i];
        SkinMouthSite site = {chain, phase, ring + seat->row, seat};
        if (!memory_reserve(&builder->job, &builder->job_capacity, builder->job_count + 1,
                            sizeof(TubeJob), e)) {
            return false;
        }
        TubeJob *job = &builder->job[builder->job_count++];
        *job = (TubeJob){.chain = seat->child, .sides = 4 * seat->size};
        if (!skin_mouth_open(builder->cage, builder->plan, &site, job->mouth, e)) {
            return false;
        }
    }
    return true;
}

static bool seat_fits(const TubeBuilder *builder, int32_t chain, const SkinRing *ring, float phase,
                      const SkinSeat *seat)
{
    SkinMouthSite site = {chain, phase, ring + seat->row, seat};
    return skin_mouth_fits(builder->plan, &site);
}

// Finds the nearest single face through which the child can leave without folds; false if there is
// none.
static bool find_other_seat(const TubeBuilder *builder, int32_t chain, const SkinRing *ring,
                            float phase, SkinSeat *seat)
{
    const SkinGrid *grid = &builder->grid;
    SkinSeat other = {.child = seat->child, .size = 1};
    for (int64_t step = 0; step < 2 * grid->station_count; step++) {
        other.row = seat->row + (step & 1 ? -(step + 1) / 2 : step / 2);
        if (other.row < 0 || other.row + 1 >= grid->station_count) {
            continue;
        }
        int sides = grid->station[other.row].sides;
        for (int k = 0; k < sides; k++) {
            other.column = (seat->column + k) % sides;
            if (skin_grid_is_free(grid, &other) && seat_fits(builder, chain, ring, phase, &other)) {
                *seat = other;
                return true;
            }
        }
    }
    return false;
}

// At sharp bends a mouth may have faces that face inward: its child moves to another seat.
static void move_bad_seats(TubeBuilder *builder, int32_t chain, const SkinRing *ring, float phase)
{
    for (int64_t i = 0; i < builder->grid.seat_count; i++) {
        SkinSeat *seat = &builder->grid.seat[i];
        if (!seat_fits(builder, chain, ring, phase, seat)) {
            skin_grid_take(&builder->grid, seat, false);
            find_other_seat(builder, chain, ring, phase, seat);
            skin_grid_take(&builder->grid, seat, true);
        }
    }
}

// Assigns vertices to corners of blocks that no other face uses, before mouths open.
static void name_outlines(TubeBuilder *builder, const SkinRing *ring, float offset)
{
    for (int64_t i = 0; i < builder->grid.seat_count; i++) {
        const SkinSeat *seat = &builder->grid.seat[i];
        for (int row = 0; row <= seat->size; row++) {
            const SkinRing *at = ring + seat->row + row;
            int step = row == 0 || row == seat->size ? 1 : seat->size;
            for (int k = 0; k <= seat->size; k += step) {
                name_corner(builder, at, (seat->column + k) % at->sides, offset);
            }
        }
    }
}

// ---- a chain ----

static bool gather_chain_children(TubeBuilder *builder, int32_t chain, Error *e)
{
    SkinGrid *grid = &builder->grid;
    int64_t first = builder->child_first[chain], end = builder->child_first[chain + 1];
    if (!memory_reserve(&grid->child, &grid->child_capacity, end - first, sizeof(int32_t), e)) {
        return false;
    }
    grid->child_count = end - first;
    for (int64_t i = first; i < end; i++) {
        grid->child[i - first] = builder->child[i];
    }
    return true;
}

static bool build_chain(TubeBuilder *builder, const TubeJob *job, Error *e)
{
    const SkinPlan *plan = builder->plan;
    SkinGrid *grid = &builder->grid;
    float phase = 0.0f, offset = plan->chain[job->chain].offset;
    if (!gather_chain_children(builder, job->chain, e)) {
        return false;
    }
    int sides = job->sides > 0 ? job->sides : skin_grid_root_sides(grid, plan, job->chain);
    if (job->sides > 0) {
        Vec3 corner[SKIN_MAX_SIDES];
        uint32_t name[SKIN_MAX_SIDES];
        SkinRing mouth = mouth_ring(builder, job, corner, name);
        phase = mouth_phase(plan, job->chain, &mouth);
    }
    int64_t count;
    if (!skin_grid_place(grid, plan, job->chain, phase, sides, e) ||
        !lay_rings(builder, job, phase, &count, e)) {
        return false;
    }
    const SkinRing *ring = builder->ring;
    int64_t extra = job->sides > 0;
    move_bad_seats(builder, job->chain, ring + extra, phase);
    name_outlines(builder, ring + extra, offset);
    for (int64_t i = 0; i + 1 < count; i++) {
        uint32_t taken = i >= extra ? grid->station[i - extra].taken : 0;
        bool good = ring[i].sides == ring[i + 1].sides
                        ? add_row(builder, &ring[i], taken, offset, e)
                        : add_reduction(builder, &ring[i], offset, e);
        if (!good) {
            return false;
        }
    }
    return (extra || close_root(builder, &ring[0], offset, e)) &&
           add_cap(builder, &ring[count - 1], true, e) &&
           open_mouths(builder, job->chain, ring + extra, phase, e);
}

// ---- all chains ----

static bool gather_children(TubeBuilder *builder, Error *e)
{
    const SkinPlan *plan = builder->plan;
    int64_t *first = memory_alloc_zero(plan->chain_count + 2, sizeof(int64_t), e);
    builder->child_first = first;
    builder->child = memory_alloc(plan->chain_count, sizeof(int32_t), e);
    if (!first || !builder->child) {
        return false;
    }
    // Counts offset by two, so that filling shifts each start to its place.
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

static bool build_root(TubeBuilder *builder, int32_t chain, const Run *run, Error *e)
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
    TubeBuilder builder = {.cage = cage, .plan = plan};
    bool good = gather_children(&builder, e);
    for (int64_t i = 0; good && i < plan->chain_count; i++) {
        if (plan->chain[i].parent < 0) {
            good = build_root(&builder, (int32_t)i, run, e);
        }
    }
    free(builder.child_first);
    free(builder.child);
    free(builder.ring);
    free(builder.corner);
    free(builder.name);
    free(builder.job);
    skin_grid_clear(&builder.grid);
    return good;
}
