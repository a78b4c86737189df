#include "skin/grid.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <stdlib.h>

void skin_grid_clear(SkinGrid *grid)
{
    free(grid->station);
    free(grid->seat);
    free(grid->child);
}

// ---- number of sides, spacing of rings ----

float skin_grid_sides(float radius, float thinnest, float thickest)
{
    float unit = thickest / 6.0f, thin = 2.5f * thinnest;
    unit = unit > thin ? unit : thin;
    return clampf(4.0f * radius / unit, 4.0f, (float)SKIN_MAX_SIDES);
}

static float wanted_sides(const SkinPlan *plan, float radius)
{
    float sides = skin_grid_sides(radius, plan->thinnest, plan->thickest);
    float least = (float)plan->params.sides;
    return clampf(sides > least ? sides : least, 4.0f, (float)SKIN_MAX_SIDES);
}

// Four sides are too few for children to leave from; a tube without children needs no more.
static int least_sides(bool has_children)
{
    return has_children ? 8 : 4;
}

int skin_grid_root_sides(const SkinGrid *grid, const SkinPlan *plan, int32_t chain)
{
    float wanted = wanted_sides(plan, plan->point[plan->chain[chain].axis].radius);
    int sides = least_sides(grid->child_count > 0);
    while ((float)sides < 0.75f * wanted) {
        sides *= 2;
    }
    return sides;
}

// Faces are about square. Thin straight twigs get longer ones, since their cage would otherwise
// outweigh the rest.
static float ring_step(const SkinPlan *plan, int32_t chain, float along, int sides, bool bare)
{
    SkinPoint here = skin_axis_at(plan, chain, along);
    float square = 2.0f * PI_F / (float)sides;
    float step = plan->params.ring_spacing * here.radius * (square < 1.0f ? square : 1.0f);
    if (bare && sides == 4) {
        SkinPoint ahead = skin_axis_at(plan, chain, along + 2.0f * here.radius);
        Vec3 bend = vec3_sub(ahead.tangent, here.tangent);
        float thin = 1.0f - smoothstepf(0.05f, 0.3f, here.radius / plan->thickest);
        step *= 1.0f + 2.0f * thin / (1.0f + 25.0f * vec3_dot(bend, bend));
    }
    const SkinChain *c = &plan->chain[chain];
    float length = plan->point[c->axis + c->samples - 1].along;
    float least = length / (float)(8 * c->count + 64);
    return step > least ? step : least;
}

// ---- the tube's ends ----

typedef struct TubeRange {
    float start;     // m along the axis: the first ring
    float low, high; // children leave between these; high is the last ring
    float last_exit; // position of the last child's exit
} TubeRange;

// A root's tube starts, and every tube ends, slightly beyond the last node, because the limit
// surface shrinks at a closed end.
static TubeRange tube_range(const SkinGrid *grid, const SkinPlan *plan, int32_t number)
{
    const SkinChain *chain = &plan->chain[number];
    const SkinPoint *first = &plan->point[chain->axis];
    const SkinPoint *last = first + chain->samples - 1;
    bool root = chain->parent < 0;
    TubeRange range = {.low = root ? 0.0f : chain->start,
                       .high = last->along + 0.5f * last->radius};
    range.start = root ? -0.9f * first->radius : range.low;
    range.last_exit = range.start;
    float longest = 0.0f;
    for (int64_t i = 0; i < grid->child_count; i++) {
        const SkinChain *child = &plan->chain[grid->child[i]];
        float height = 2.6f * plan->point[child->axis].radius;
        longest = height > longest ? height : longest;
        range.last_exit =
            child->exit_on_parent > range.last_exit ? child->exit_on_parent : range.last_exit;
    }
    longest = longest < 2.5f * last->radius ? longest : 2.5f * last->radius;
    if (range.high - range.low < longest) {
        range.high = range.low + longest;
    }
    return range;
}

// ---- rows ----

static bool add_station(SkinGrid *grid, float along, int sides, Error *e)
{
    if (!memory_reserve(&grid->station, &grid->station_capacity, grid->station_count + 1,
                        sizeof(SkinStation), e)) {
        return false;
    }
    grid->station[grid->station_count++] = (SkinStation){along, sides, 0};
    return true;
}

// Places rings from end to end, at `fineness` times the usual spacing; the number of sides is
// halved where the branch has become thin enough.
static bool lay_rows(SkinGrid *grid, const SkinPlan *plan, int32_t chain, TubeRange range,
                     int sides, float fineness, Error *e)
{
    grid->station_count = 0;
    if (!add_station(grid, range.start, sides, e)) {
        return false;
    }
    for (float at = range.start; at < range.high;) {
        bool bare = at > range.last_exit + 1.5f * skin_axis_at(plan, chain, at).radius ||
                    grid->child_count == 0;
        float radius = skin_axis_at(plan, chain, at).radius;
        bool reduce = sides % 4 == 0 && sides / 2 >= least_sides(!bare) &&
                      (float)sides * 0.5f >= 0.75f * wanted_sides(plan, radius) &&
                      at > range.start + radius;
        sides = reduce ? sides / 2 : sides;
        float step = fineness * ring_step(plan, chain, at, sides, bare);
        float next = at + 1.5f * step < range.high && at + step > at ? at + step : range.high;
        if (!add_station(grid, next, sides, e)) {
            return false;
        }
        at = next;
    }
    return true;
}

// ---- seats ----

// Signed distance of x from the nearest multiple of `turn`.
static float wrap(float x, float turn)
{
    return x - turn * floorf(x / turn + 0.5f);
}

float skin_grid_column(const SkinPlan *plan, int32_t parent, int32_t child, float phase, int sides)
{
    SkinPoint at = skin_axis_at(plan, parent, plan->chain[child].exit_on_parent);
    Vec3 side = plan->chain[child].exit_side, across = vec3_cross(at.tangent, at.side);
    float azimuth = exact_atan2(vec3_dot(side, across), vec3_dot(side, at.side)) - phase;
    return (azimuth / (2.0f * PI_F) + 0.125f) * (float)sides;
}

// Bit mask of faces k .. k + size - 1 of a row, modulo the number of sides.
static uint32_t column_mask(int column, int size, int sides)
{
    uint64_t block = ((1ull << size) - 1) << column;
    return (uint32_t)(block | block >> sides) & (uint32_t)((1ull << sides) - 1);
}

// Largest block that leaves a tube enough of its own side faces.
static int largest_block(int sides)
{
    int most = 3 * sides / 8;
    return most > SKIN_MAX_SIDES / 4 ? SKIN_MAX_SIDES / 4 : (most > 0 ? most : 1);
}

// Faces taken in `size` rows from `row`; all of them if the rows differ in sides or have too few.
static uint32_t rows_taken(const SkinGrid *grid, int64_t row, int size)
{
    uint32_t taken = size > largest_block(grid->station[row].sides) ? UINT32_MAX : 0;
    for (int64_t i = row; i < row + size; i++) {
        taken |= grid->station[i].taken;
        if (grid->station[i + 1].sides != grid->station[row].sides) {
            return UINT32_MAX;
        }
    }
    return taken;
}

void skin_grid_take(SkinGrid *grid, const SkinSeat *seat, bool taken)
{
    uint32_t mask = column_mask(seat->column, seat->size, grid->station[seat->row].sides);
    for (int64_t i = seat->row; i < seat->row + seat->size; i++) {
        grid->station[i].taken = (grid->station[i].taken & ~mask) | (taken ? mask : 0);
    }
}

bool skin_grid_is_free(const SkinGrid *grid, const SkinSeat *seat)
{
    int sides = grid->station[seat->row].sides;
    uint32_t taken = rows_taken(grid, seat->row, seat->size);
    return taken != UINT32_MAX && !(taken & column_mask(seat->column, seat->size, sides));
}

// Block size in faces per side that fits the child's radius and a fillet.
static int block_size(const SkinPlan *plan, int32_t number, const SkinPoint *parent, int sides,
                      float row_height, bool has_children)
{
    const SkinChain *child = &plan->chain[number];
    float radius = skin_axis_at(plan, number, child->start).radius;
    float column = 2.0f * PI_F * parent->radius / (float)sides;
    float slant = 1.0f / clampf(child->exit_sine, 0.6f, 1.0f);
    float across = 2.6f * radius / column, along = 2.6f * radius * slant / row_height;
    int size = (int)(0.5f * (across + along) + 0.5f), most = largest_block(sides);
    int least = has_children && most >= 2 ? 2 : 1;
    return size < least ? least : (size > most ? most : size);
}

// Finds the free block with its centre nearest to the child's exit.
static bool find_block(const SkinGrid *grid, const SkinPlan *plan, int32_t chain, float phase,
                       int64_t near, SkinSeat *seat)
{
    const SkinChain *child = &plan->chain[seat->child];
    float best = INFINITY;
    float radius = skin_axis_at(plan, chain, child->exit_on_parent).radius;
    for (int64_t step = 0; step < 2 * grid->station_count + 2; step++) {
        int64_t row = near + (step & 1 ? -(step + 1) / 2 : step / 2);
        if (row < 0 || row + seat->size >= grid->station_count) {
            continue;
        }
        float middle = 0.5f * (grid->station[row].along + grid->station[row + seat->size].along);
        float away = (middle - child->exit_on_parent) / radius;
        if (0.25f * away * away > best) {
            break;
        }
        uint32_t taken = rows_taken(grid, row, seat->size);
        int sides = grid->station[row].sides;
        float column = skin_grid_column(plan, chain, seat->child, phase, sides);
        for (int k = 0; taken != UINT32_MAX && k < sides; k++) {
            float off = wrap((float)k + 0.5f * (float)seat->size - column, (float)sides);
            off *= 2.0f * PI_F / (float)sides;
            float cost = away * away + off * off;
            if (cost < best && !(taken & column_mask(k, seat->size, sides))) {
                best = cost;
                seat->row = row;
                seat->column = k;
            }
        }
    }
    return best < INFINITY;
}

static int64_t row_at(const SkinGrid *grid, float along)
{
    int64_t low = 0, high = grid->station_count - 1;
    while (high - low > 1) {
        int64_t middle = low + (high - low) / 2;
        if (grid->station[middle].along <= along) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static bool seat_child(SkinGrid *grid, const SkinPlan *plan, int32_t chain, int32_t child,
                       float phase, bool *seated, Error *e)
{
    float exit = plan->chain[child].exit_on_parent;
    int64_t row = row_at(grid, exit);
    SkinPoint at = skin_axis_at(plan, chain, exit);
    float height = grid->station[row + 1].along - grid->station[row].along;
    SkinSeat seat = {.child = child};
    seat.size = block_size(plan, child, &at, grid->station[row].sides, height,
                           plan->chain[child].has_children);
    *seated = false;
    for (; seat.size >= 1 && !*seated; seat.size -= *seated ? 0 : 1) {
        *seated = find_block(grid, plan, chain, phase, row - seat.size / 2, &seat);
    }
    if (!*seated) {
        return true;
    }
    skin_grid_take(grid, &seat, true);
    if (!memory_reserve(&grid->seat, &grid->seat_capacity, grid->seat_count + 1, sizeof seat, e)) {
        return false;
    }
    grid->seat[grid->seat_count++] = seat;
    return true;
}

static int compare_keys(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

// Sorts thick children first; ties keep the list's order.
static bool sort_children(SkinGrid *grid, const SkinPlan *plan, Error *e)
{
    uint64_t *key = memory_alloc(grid->child_count, sizeof *key, e);
    if (!key) {
        return false;
    }
    for (int64_t i = 0; i < grid->child_count; i++) {
        float radius = plan->point[plan->chain[grid->child[i]].axis].radius;
        float share = clampf(1.0f - radius / plan->thickest, 0.0f, 1.0f);
        key[i] = (uint64_t)(share * 16777216.0f) << 32 | (uint32_t)grid->child[i];
    }
    qsort(key, (size_t)grid->child_count, sizeof *key, compare_keys);
    for (int64_t i = 0; i < grid->child_count; i++) {
        grid->child[i] = (int32_t)(key[i] & UINT32_MAX);
    }
    free(key);
    return true;
}

bool skin_grid_place(SkinGrid *grid, const SkinPlan *plan, int32_t chain, float phase, int sides,
                     Error *e)
{
    TubeRange range = tube_range(grid, plan, chain);
    if (!sort_children(grid, plan, e)) {
        return false;
    }
    // If children crowd, rows are halved until each has a face; as a last resort the tube is
    // lengthened.
    bool seated = false;
    for (float fineness = 1.0f; !seated;) {
        grid->seat_count = 0;
        if (!lay_rows(grid, plan, chain, range, sides, fineness, e)) {
            return false;
        }
        seated = true;
        for (int64_t i = 0; seated && i < grid->child_count; i++) {
            if (!seat_child(grid, plan, chain, grid->child[i], phase, &seated, e)) {
                return false;
            }
        }
        if (fineness > 0.01f) {
            fineness *= 0.5f;
        } else {
            range.high += range.high - range.start;
        }
    }
    return true;
}
