#include "skin/mouth.h"

#include "base/exact_math.h"

// The child's cross-section in coordinates of its block: x from 0 (left edge) to 1 (right), y from
// 0 (bottom) to 1 (top).
typedef struct Girth {
    float x, y, reach_x, reach_y; // of the corners
    float radius;                 // m, of the child
} Girth;

SkinVertex skin_ring_vertex(const SkinRing *ring, int k, float offset)
{
    // u runs from 0 at corner 0 both ways around to half the circumference: mirrored, so that it is
    // continuous without a seam.
    int way_round = 2 * k <= ring->sides ? k : ring->sides - k;
    float u = 2.0f * PI_F * ring->radius * (float)way_round / (float)ring->sides;
    return (SkinVertex){ring->corner[k], {u, offset + ring->along}, ring->radius, ring->birth};
}

static float girth_reach(float wanted, float room, int size)
{
    // The sides of a square are at 0.707 of its corners' distance.
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
    float height = high->along - low->along, way = 0.0f;
    for (int i = 0; i < seat->size; i++) {
        way += vec3_distance(low[i].centre, low[i + 1].centre);
    }
    Girth girth = {.radius = radius, .y = 0.5f};
    girth.reach_x = girth_reach(wanted, width, seat->size);
    girth.reach_y = girth_reach(wanted / clampf(child->exit_sine, 0.5f, 1.0f), way, seat->size);
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

// Point of the parent's surface at (x, y) of the block, moved by `pull` from the cage to the limit
// surface.
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

// Frame vertex k at fraction `share` between the outline and the child's cross-section.
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
    // Faces of a four-sided parent are far from its limit surface, but allow less bending.
    float pull = seat->size == 1 && site->ring->sides == 4 ? 0.6f : 0.9f;
    SkinVertex v = block_point(plan, site, x, y, pull * share);
    v.radius = lerpf(v.radius, girth->radius, share);
    return v;
}

// Nearest point of the parent's axis to the frame's face k.
static Vec3 frame_axis(const SkinMouthSite *site, const Girth *girth, int k, float share)
{
    int row, column;
    outline_corner(site->seat, k, &row, &column);
    float y = lerpf((float)row, girth->y * (float)site->seat->size, 0.5f * share);
    int below = (int)y < site->seat->size - 1 ? (int)y : site->seat->size - 1;
    return vec3_lerp(site->ring[below].centre, site->ring[below + 1].centre, y - (float)below);
}

// Fraction between outline and cross-section of frame i of `frames`. Frames shrink by equal
// factors.
static float frame_share(float ratio, int i, int frames)
{
    float shrunk = exact_pow(ratio, (float)i / (float)frames);
    return i < frames ? (1.0f - shrunk) / (1.0f - ratio) : 1.0f;
}

// Size of the cross-section relative to the block, and the number of frames down to it.
static float girth_ratio(const Girth *girth, int *frames)
{
    float ratio = 2.0f * (girth->reach_x < girth->reach_y ? girth->reach_x : girth->reach_y);
    *frames = 1;
    float left = ratio;
    while (left < 0.36f) {
        left *= 2.0f;
        ++*frames;
    }
    return ratio < 0.95f ? ratio : 0.95f;
}

// Whether all faces of the frames would face away from the parent's axis.
static bool frames_look_outwards(const SkinPlan *plan, const SkinMouthSite *site,
                                 const Girth *girth)
{
    int count = 4 * site->seat->size, frames;
    float ratio = girth_ratio(girth, &frames);
    Vec3 outer[SKIN_MAX_SIDES], inner[SKIN_MAX_SIDES];
    for (int i = 0; i <= frames; i++) {
        float share = frame_share(ratio, i, frames);
        for (int k = 0; k < count; k++) {
            inner[k] = frame_vertex(plan, site, girth, k, share).position;
        }
        for (int k = 0; i > 0 && k < count; k++) {
            int next = (k + 1) % count;
            Vec3 normal =
                vec3_cross(vec3_sub(inner[next], outer[k]), vec3_sub(inner[k], outer[next]));
            Vec3 middle = vec3_scale(
                vec3_add(vec3_add(inner[k], inner[next]), vec3_add(outer[k], outer[next])), 0.25f);
            Vec3 out = vec3_sub(middle, frame_axis(site, girth, k, share));
            if (!(vec3_dot(normal, out) > 0.0f)) {
                return false;
            }
        }
        for (int k = 0; k < count; k++) {
            outer[k] = inner[k];
        }
    }
    return true;
}

// At sharp bends frames may fold; a smaller cross-section leaves more room.
static Girth fit_unfolded_girth(const SkinPlan *plan, const SkinMouthSite *site)
{
    Girth girth = fit_girth(plan, site);
    for (int i = 0; i < 4 && !frames_look_outwards(plan, site, &girth); i++) {
        girth.reach_x *= 0.6f;
        girth.reach_y *= 0.6f;
        girth.x = lerpf(girth.x, 0.5f, 0.4f);
        girth.y = lerpf(girth.y, 0.5f, 0.4f);
    }
    return girth;
}

bool skin_mouth_fits(const SkinPlan *plan, const SkinMouthSite *site)
{
    Girth girth = fit_unfolded_girth(plan, site);
    return frames_look_outwards(plan, site, &girth);
}

bool skin_mouth_open(SkinCage *cage, const SkinPlan *plan, const SkinMouthSite *site,
                     uint32_t *mouth, Error *e)
{
    const SkinSeat *seat = site->seat;
    Girth girth = fit_unfolded_girth(plan, site);
    int count = 4 * seat->size, frames;
    float ratio = girth_ratio(&girth, &frames);
    if (!skin_cage_reserve(cage, count * frames, count * frames, e)) {
        return false;
    }
    uint32_t outer[SKIN_MAX_SIDES];
    for (int k = 0; k < count; k++) {
        int row, column;
        outline_corner(seat, k, &row, &column);
        outer[k] = site->ring[row].name[(seat->column + column) % site->ring[row].sides];
    }
    for (int i = 1; i <= frames; i++) {
        float share = frame_share(ratio, i, frames);
        for (int k = 0; k < count; k++) {
            SkinVertex v = frame_vertex(plan, site, &girth, k, share);
            mouth[k] = skin_cage_add_vertex(cage, v);
        }
        for (int k = 0; k < count; k++) {
            int next = (k + 1) % count;
            Vec3 axis = frame_axis(site, &girth, k, share);
            skin_cage_add_face(cage, outer[k], outer[next], mouth[next], mouth[k], axis);
        }
        for (int k = 0; k < count; k++) {
            outer[k] = mouth[k];
        }
    }
    return true;
}
