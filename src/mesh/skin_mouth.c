#include "mesh/skin_mouth.h"

#include "base/exact_math.h"

// The child's girth in the coordinates of its block: x from 0 at the left edge to 1 at the right,
// y from 0 below to 1 above.
typedef struct Girth {
    float x, y, reach_x, reach_y; // of the corners
    float radius;                 // m, of the child
} Girth;

SkinVertex skin_ring_vertex(const SkinRing *ring, int k, float offset)
{
    // u runs both ways round from 0 at corner 0 to half the girth: mirrored, so that it is
    // continuous without a seam.
    int way_round = 2 * k <= ring->sides ? k : ring->sides - k;
    float u = 2.0f * PI_F * ring->radius * (float)way_round / (float)ring->sides;
    return (SkinVertex){ring->corner[k], {u, offset + ring->along}, ring->radius, ring->birth};
}

static float girth_reach(float wanted, float room, int size)
{
    // A square's sides stand at 0.707 of its corners.
    float most = size == 1 ? 0.58f : 0.42f;
    float reach = room > 0.0f ? wanted / room : most;
    return clampf(reach, 0.002f, most);
}

static Girth fit_girth(const SkinPlan *plan, const SkinMouthSite *site)
{
    const SkinSeat *seat = site->seat;
    const SkinChain *child = &plan->chain[seat->child];
    const SkinRing *low = site->ring, *high = site->ring + seat->size;
    float size = (float)seat->size, sides = (float)low->sides;
    float radius = skin_axis_at(plan, seat->child, child->start).radius;
    float wanted = skin_ring_scale(4 * seat->size) * radius;
    float width = size * 2.0f * PI_F * 0.5f * (low->radius + high->radius) / sides;
    float height = high->along - low->along;
    Girth girth = {.radius = radius, .y = 0.5f};
    girth.reach_x = girth_reach(wanted, width, seat->size);
    girth.reach_y = girth_reach(wanted / clampf(child->exit_sine, 0.5f, 1.0f), height, seat->size);
    float column = skin_grid_column(plan, site->parent, seat->child, site->phase, low->sides);
    float off = column - (float)seat->column - 0.5f * size;
    girth.x = 0.5f + (off - sides * floorf(off / sides + 0.5f)) / size;
    if (height > 0.0f) {
        girth.y = (child->exit_on_parent - low->along) / height;
    }
    float side = seat->size == 1 ? 0.7072f : 1.0f;
    float margin_x = side * girth.reach_x + 0.07f, margin_y = side * girth.reach_y + 0.07f;
    girth.x = clampf(girth.x, margin_x, 1.0f - margin_x);
    girth.y = clampf(girth.y, margin_y, 1.0f - margin_y);
    return girth;
}

// Corner k of the block's outline: its ring (counted from the seat's row) and its column.
static void outline_corner(const SkinSeat *seat, int k, int *row, int *column)
{
    int n = seat->size, side = k / n, way = k % n;
    int x[4] = {way, n, n - way, 0}, y[4] = {0, way, n, n - way};
    *row = y[side];
    *column = x[side];
}

// The parent's surface at (x, y) of the block, drawn by `pull` from the cage to the limit surface.
static SkinVertex block_point(const SkinPlan *plan, const SkinMouthSite *site, float x, float y,
                              float pull)
{
    const SkinSeat *seat = site->seat;
    float offset = plan->chain[site->parent].offset;
    float gx = x * (float)seat->size, gy = y * (float)seat->size;
    int column = (int)gx < seat->size - 1 ? (int)gx : seat->size - 1;
    int row = (int)gy < seat->size - 1 ? (int)gy : seat->size - 1;
    float s = gx - (float)column, t = gy - (float)row;
    const SkinRing *low = site->ring + row, *high = low + 1;
    int left = (seat->column + column) % low->sides, right = (left + 1) % low->sides;
    SkinVertex v = {.radius = 0.0f};
    v = skin_vertex_madd(v, (1 - s) * (1 - t), skin_ring_vertex(low, left, offset));
    v = skin_vertex_madd(v, s * (1 - t), skin_ring_vertex(low, right, offset));
    v = skin_vertex_madd(v, s * t, skin_ring_vertex(high, right, offset));
    v = skin_vertex_madd(v, (1 - s) * t, skin_ring_vertex(high, left, offset));
    Vec3 axis = vec3_lerp(low->centre, high->centre, t);
    Vec3 out = vec3_sub(v.position, axis);
    float distance = vec3_length(out);
    if (distance > v.radius) {
        v.position = vec3_madd(axis, lerpf(1.0f, v.radius / distance, pull), out);
    }
    return v;
}

// Frame vertex k, `share` of the way from the outline to the girth.
static SkinVertex frame_vertex(const SkinPlan *plan, const SkinMouthSite *site, const Girth *girth,
                               int k, float share)
{
    const SkinSeat *seat = site->seat;
    int row, column;
    outline_corner(seat, k, &row, &column);
    float cosine, sine;
    skin_ring_direction(4 * seat->size, k, &cosine, &sine);
    float x = lerpf((float)column / (float)seat->size, girth->x + girth->reach_x * sine, share);
    float y = lerpf((float)row / (float)seat->size, girth->y - girth->reach_y * cosine, share);
    // Faces of a four-sided parent stand well off its limit surface, but bear less bending.
    float pull = seat->size == 1 && site->ring->sides == 4 ? 0.6f : 0.9f;
    SkinVertex v = block_point(plan, site, x, y, pull * share);
    v.radius = lerpf(v.radius, girth->radius, share);
    return v;
}

bool skin_mouth_open(SkinCage *cage, const SkinPlan *plan, const SkinMouthSite *site,
                     uint32_t *mouth, Error *e)
{
    const SkinSeat *seat = site->seat;
    Girth girth = fit_girth(plan, site);
    int count = 4 * seat->size, frames = 1;
    float ratio = 2.0f * (girth.reach_x < girth.reach_y ? girth.reach_x : girth.reach_y);
    for (float left = ratio; left < 0.36f; left *= 2.0f) {
        frames++;
    }
    if (!skin_cage_reserve(cage, count * frames, count * frames, e)) {
        return false;
    }
    Vec3 axis = vec3_lerp(site->ring[0].centre, site->ring[seat->size].centre, 0.5f);
    uint32_t outer[SKIN_MAX_SIDES];
    for (int k = 0; k < count; k++) {
        int row, column;
        outline_corner(seat, k, &row, &column);
        outer[k] = site->ring[row].name[(seat->column + column) % site->ring[row].sides];
    }
    for (int i = 1; i <= frames; i++) {
        // Frames shrink by equal factors.
        float shrunk = exact_pow(ratio, (float)i / (float)frames);
        float share = i < frames ? (1.0f - shrunk) / (1.0f - ratio) : 1.0f;
        for (int k = 0; k < count; k++) {
            SkinVertex v = frame_vertex(plan, site, &girth, k, share);
            mouth[k] = skin_cage_add_vertex(cage, v);
        }
        for (int k = 0; k < count; k++) {
            int next = (k + 1) % count;
            skin_cage_add_face(cage, outer[k], outer[next], mouth[next], mouth[k], axis);
        }
        for (int k = 0; k < count; k++) {
            outer[k] = mouth[k];
        }
    }
    return true;
}
