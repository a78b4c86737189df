#include "render/sky/dome.h"

#include "base/memory.h"
#include "render/warp.h"

#include <stdlib.h>

enum { CELLS_PER_GUIDE = 4 }; // a search looks at half as many on average

static int guides_of(int cells)
{
    return cells / CELLS_PER_GUIDE + 1;
}

// Sine of the elevation of the upper edge of a row of cells.
static float edge_of(const Dome *dome, int row)
{
    float v = ((float)row - 0.5f) / (float)dome->rows;
    return sinf(dome_elevation(dome->horizon_spacing, clampf(v, 0.0f, 1.0f)));
}

Dome *dome_new(int columns, int rows, bool horizon_spacing, float rotation, Error *e)
{
    Dome *dome = memory_alloc_zero(1, sizeof *dome, e);
    if (!dome) {
        return NULL;
    }
    *dome = (Dome){
        .columns = columns, .rows = rows, .horizon_spacing = horizon_spacing, .rotation = rotation};
    int64_t down = rows + 1;
    if (!(dome->entry = memory_alloc_zero((int64_t)columns * rows, sizeof(DomeEntry), e)) ||
        !(dome->edge = memory_alloc_zero(down + 1, sizeof(float), e)) ||
        !(dome->row_sum = memory_alloc_zero(down + 1, sizeof(float), e)) ||
        !(dome->cell_sum = memory_alloc_zero(down * (columns + 1), sizeof(float), e)) ||
        !(dome->row_guide = memory_alloc_zero(guides_of(rows + 1), sizeof(int32_t), e)) ||
        !(dome->cell_guide = memory_alloc_zero(down * guides_of(columns), sizeof(int32_t), e))) {
        dome_free(dome);
        return NULL;
    }
    for (int i = 0; i <= rows + 1; i++) {
        dome->edge[i] = edge_of(dome, i);
    }
    return dome;
}

void dome_free(Dome *dome)
{
    if (dome) {
        free(dome->entry);
        free(dome->edge);
        free(dome->row_sum);
        free(dome->cell_sum);
        free(dome->row_guide);
        free(dome->cell_guide);
        free(dome);
    }
}

float dome_elevation(bool horizon_spacing, float v)
{
    float t = 1.0f - 2.0f * v;
    return 0.5f * PI_F * (horizon_spacing ? t * fabsf(t) : t);
}

// ---- cells

// The entries at the corners of a cell.
typedef struct Corners {
    const DomeEntry *above, *below; // rows
    int left, right;
} Corners;

static inline Corners corners_of(const Dome *dome, int row, int column)
{
    int above = row > 0 ? row - 1 : 0, below = row < dome->rows ? row : dome->rows - 1;
    return (Corners){dome->entry + (int64_t)above * dome->columns,
                     dome->entry + (int64_t)below * dome->columns, column,
                     column + 1 < dome->columns ? column + 1 : 0};
}

static inline Vec3 radiance_in(const Corners *c, float x, float y)
{
    Vec3 above = vec3_lerp(c->above[c->left].radiance, c->above[c->right].radiance, x);
    Vec3 below = vec3_lerp(c->below[c->left].radiance, c->below[c->right].radiance, x);
    return vec3_lerp(above, below, y);
}

static inline float weight_in(const Corners *c, float x, float y)
{
    return lerpf(lerpf(c->above[c->left].weight, c->above[c->right].weight, x),
                 lerpf(c->below[c->left].weight, c->below[c->right].weight, x), y);
}

// ---- lookup

// Within 7e-5 radians. Abramowitz and Stegun, 4.4.45.
static inline float rough_asin(float x)
{
    float a = fabsf(x);
    float p = 1.5707288f + a * (-0.2121144f + a * (0.0742610f - 0.0187293f * a));
    float angle = 0.5f * PI_F - sqrtf(a < 1.0f ? 1.0f - a : 0.0f) * p;
    return copysignf(angle, x);
}

// Within 3e-7 radians; libm's is a call that takes five times as long. Abramowitz and Stegun,
// 4.4.49.
static inline float fast_atan2(float y, float x)
{
    float ax = fabsf(x), ay = fabsf(y);
    float high = ax > ay ? ax : ay, low = ax > ay ? ay : ax;
    float t = high > 0.0f ? low / high : 0.0f, s = t * t;
    float p = -0.0161657367f + 0.0028662257f * s;
    p = -0.0752896400f + s * (0.0429096138f + s * p);
    p = -0.1420889944f + s * (0.1065626393f + s * p);
    p = 1.0f + s * (-0.3333314528f + s * (0.1999355085f + s * p));
    float angle = p * t;
    angle = ay > ax ? 0.5f * PI_F - angle : angle;
    angle = x < 0.0f ? PI_F - angle : angle;
    return copysignf(angle, y);
}

// The row of cells of a sine, and the place within it from its upper edge.
static inline int row_at(const Dome *dome, float sine, float *y)
{
    float t = rough_asin(sine) * (2.0f / PI_F);
    t = dome->horizon_spacing ? copysignf(sqrtf(fabsf(t)), t) : t;
    int row = (int)((0.5f - 0.5f * t) * (float)dome->rows + 0.5f);
    row = row < 0 ? 0 : (row > dome->rows ? dome->rows : row);
    while (row > 0 && sine > dome->edge[row]) {
        row--;
    }
    while (row < dome->rows && sine < dome->edge[row + 1]) {
        row++;
    }
    float height = dome->edge[row] - dome->edge[row + 1];
    *y = height > 0.0f ? clampf((dome->edge[row] - sine) / height, 0.0f, 1.0f) : 0.0f;
    return row;
}

static inline int column_at(const Dome *dome, Vec3 direction, float *x)
{
    float azimuth = fast_atan2(direction.x, direction.z) - dome->rotation;
    float turn = 0.5f - azimuth / (2.0f * PI_F) - 0.5f / (float)dome->columns;
    turn = (turn - floorf(turn)) * (float)dome->columns;
    int column = (int)turn;
    column = column < dome->columns ? column : dome->columns - 1;
    *x = turn - (float)column;
    return column;
}

DomePlace dome_find(const Dome *dome, Vec3 direction)
{
    DomePlace place;
    place.row = row_at(dome, direction.y, &place.y);
    place.column = column_at(dome, direction, &place.x);
    Corners corners = corners_of(dome, place.row, place.column);
    __builtin_prefetch(corners.above + place.column);
    __builtin_prefetch(corners.below + place.column);
    return place;
}

Vec3 dome_radiance(const Dome *dome, const DomePlace *place)
{
    Corners corners = corners_of(dome, place->row, place->column);
    return radiance_in(&corners, place->x, place->y);
}

static inline DomeLight light_in(const Dome *dome, const Corners *c, float x, float y)
{
    return (DomeLight){radiance_in(c, x, y),
                       dome->power > 0.0f ? weight_in(c, x, y) / dome->power : 0.0f};
}

DomeLight dome_at(const Dome *dome, const DomePlace *place)
{
    Corners corners = corners_of(dome, place->row, place->column);
    return light_in(dome, &corners, place->x, place->y);
}

// ---- sampling tables

// Cumulated shares of the weights that sum[1 .. count] hold; sum[0] = 0 and sum[count] = 1 after
// it. Returns the weights' total.
static double cumulate(float *sum, int count)
{
    double total = 0.0, done = 0.0;
    for (int i = 1; i <= count; i++) {
        total += (double)sum[i];
    }
    sum[0] = 0.0f;
    for (int i = 1; i <= count; i++) {
        done += (double)sum[i];
        sum[i] = (float)(total > 0.0 ? done / total : (double)i / count);
    }
    sum[count] = 1.0f;
    return total;
}

// Where the search of u begins: for each equal part of 0 .. 1, the interval of its lower end (Chen
// and Asau, "On Generating Random Variates from an Empirical Distribution", 1974).
static void fill_guide(const float *sum, int count, int32_t *guide)
{
    int guides = guides_of(count), i = 0;
    for (int k = 0; k < guides; k++) {
        while (i + 1 < count && sum[i + 1] <= (float)k / (float)guides) {
            i++;
        }
        guide[k] = i;
    }
}

static double cell_angle(const Dome *dome, int row)
{
    double height = (double)dome->edge[row] - (double)dome->edge[row + 1];
    return height * 2.0 * (double)PI_F / dome->columns;
}

// A cell's weight integrates to its solid angle times the mean of its corners.
static double prepare_row(Dome *dome, int row)
{
    float *sum = dome->cell_sum + (int64_t)row * (dome->columns + 1);
    for (int i = 0; i < dome->columns; i++) {
        Corners corners = corners_of(dome, row, i);
        sum[i + 1] = weight_in(&corners, 0.5f, 0.5f);
    }
    double total = cumulate(sum, dome->columns);
    fill_guide(sum, dome->columns, dome->cell_guide + (int64_t)row * guides_of(dome->columns));
    return total * cell_angle(dome, row);
}

// Mean luminance over all directions.
static double mean_luminance(const Dome *dome)
{
    double sum = 0.0;
    for (int row = 0; row <= dome->rows; row++) {
        double line = 0.0;
        for (int i = 0; i < dome->columns; i++) {
            Corners corners = corners_of(dome, row, i);
            line += (double)luminance(radiance_in(&corners, 0.5f, 0.5f));
        }
        sum += line * cell_angle(dome, row);
    }
    return sum / (4.0 * (double)PI_F);
}

void dome_prepare(Dome *dome)
{
    // The rounding of a dome of one colour is no excess.
    float even = (float)mean_luminance(dome) * 1.00001f;
    for (int64_t i = 0; i < (int64_t)dome->rows * dome->columns; i++) {
        float excess = luminance(dome->entry[i].radiance) - even;
        dome->entry[i].weight = excess > 0.0f ? excess : 0.0f;
    }
    for (int row = 0; row <= dome->rows; row++) {
        dome->row_sum[row + 1] = (float)prepare_row(dome, row);
    }
    dome->power = (float)cumulate(dome->row_sum, dome->rows + 1);
    fill_guide(dome->row_sum, dome->rows + 1, dome->row_guide);
}

// ---- sampling

// The interval that holds u; *rest becomes u's place within it, 0..1.
static inline int find_interval(const float *sum, const int32_t *guide, int count, float u,
                                float *rest)
{
    int i = guide[(int)(u * (float)guides_of(count))];
    while (i + 1 < count && sum[i + 1] <= u) {
        i++;
    }
    float width = sum[i + 1] - sum[i];
    *rest = width > 0.0f ? clampf((u - sum[i]) / width, 0.0f, 1.0f) : 0.5f;
    return i;
}

// Draws from a density that leads straight from a at 0 to b at 1.
static inline float draw_linear(float a, float b, float u)
{
    float divisor = a + sqrtf(lerpf(a * a, b * b, u));
    return divisor > 0.0f ? clampf(u * (a + b) / divisor, 0.0f, 1.0f) : u;
}

Vec3 dome_sample(const Dome *dome, float u, float v, DomeLight *light)
{
    float x, y;
    int row = find_interval(dome->row_sum, dome->row_guide, dome->rows + 1, v, &y);
    const float *sum = dome->cell_sum + (int64_t)row * (dome->columns + 1);
    const int32_t *guide = dome->cell_guide + (int64_t)row * guides_of(dome->columns);
    int column = find_interval(sum, guide, dome->columns, u, &x);
    Corners c = corners_of(dome, row, column);
    float a = c.above[c.left].weight, b = c.above[c.right].weight;
    float d = c.below[c.left].weight, e = c.below[c.right].weight;
    y = draw_linear(a + b, d + e, y);
    x = draw_linear(lerpf(a, d, y), lerpf(b, e, y), x);
    *light = light_in(dome, &c, x, y);
    float sine = lerpf(dome->edge[row], dome->edge[row + 1], y);
    float turn = ((float)column + 0.5f + x) / (float)dome->columns;
    float around = 0.5f - turn + dome->rotation / (2.0f * PI_F), east, south;
    sincos_turn(around - floorf(around), &east, &south);
    float square = 1.0f - sine * sine;
    float cosine = sqrtf(square > 0.0f ? square : 0.0f);
    return vec3(cosine * east, sine, cosine * south);
}
