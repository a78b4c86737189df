// Waterfalls: where a river drops over a step of the land, its water leaves the lip as a jet that
// gravity alone bends, and breaks up into white strands. Where it meets rock it slides and leaps
// on.
//
// The speed at the lip is that of a free overfall, whose depth is 0.715 of the critical one (Rouse,
// "Discharge Characteristics of the Free Overfall", Civil Eng. 6, 1936).
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/terrain/drawn.h"
#include "objects/terrain/spray.h"
#include "objects/terrain/white_water.h"

#include <math.h>
#include <stdlib.h>

#define GRAVITY 9.81f

float terrain_lip_speed(float discharge, float half)
{
    float wide = discharge / (2.0f * half);
    float critical = exact_pow(wide * wide / GRAVITY, 1.0f / 3.0f);
    return critical > 0.0f ? wide / (0.715f * critical) : 0.0f;
}

// ---- the path of a strand

// Unit normal of the land.
static Vec3 land_normal(const DrawnLand *land, float x, float z)
{
    float step = 0.25f * land->field->cell.x;
    float dx = drawn_land_at(land, x + step, z) - drawn_land_at(land, x - step, z);
    float dz = drawn_land_at(land, x, z + step) - drawn_land_at(land, x, z - step);
    return vec3_normalize(vec3(-dx, 2.0f * step, -dz));
}

// Lays what has come below the surface back on it, and takes away the speed across it.
static void slide(const FallPath *path, Vec3 *p, Vec3 *v)
{
    const float rubs = 1.5f, least = 0.4f; // 1/s: how fast rock slows it; m/s
    float land = drawn_land_at(path->land, p->x, p->z) + path->film;
    if (p->y >= land) {
        return;
    }
    p->y = land;
    Vec3 normal = land_normal(path->land, p->x, p->z);
    float into = vec3_dot(*v, normal);
    *v = vec3_scale(into < 0.0f ? vec3_madd(*v, -into, normal) : *v,
                    1.0f / (1.0f + rubs * path->step));
    float ahead = vec3_dot(*v, path->way); // it never rests on a ledge
    *v = ahead < least ? vec3_madd(*v, least - ahead, path->way) : *v;
}

int terrain_fall_path(const FallPath *path, Vec3 start, Vec3 velocity, Vec3 *place, int most)
{
    Vec3 p = start, v = velocity;
    float t = path->step;
    int count = 0;
    place[count++] = p;
    while (count < most && p.y > path->level) {
        Vec3 last = p;
        p = vec3_madd(p, t, v);
        p.y -= 0.5f * GRAVITY * t * t;
        v.y -= GRAVITY * t;
        if (path->land) {
            slide(path, &p, &v);
        }
        if (p.y < path->level) {
            p = vec3_lerp(last, p, (last.y - path->level) / (last.y - p.y));
            p.y = path->level;
        }
        place[count++] = p;
    }
    return count;
}

// ---- strands

enum {
    ROWS = 96, // of a strand, or in the distance at least
    FEWEST_ROWS = 6,
    SHEET = 28, // rows of the sheet in which water leaves the lip, and likewise
    FEWEST_SHEET = 4,
    STEPS = 160, // of its path
    ACROSS = 72, // strands of a layer ...
    MANY = 26,   // ... of at most so many falls; of more falls fewer, but never fewer than
    FEWEST = 12,
    FEWEST_FAR = 3, // in copies of the square
    LAYERS = 4,
    STRANDS = ACROSS * LAYERS
};
enum {
    NUMBER_SIDE,
    NUMBER_SPEED,
    NUMBER_DRIFT,
    NUMBER_LIFT,
    NUMBER_WIDTH,
    NUMBER_START,
    NUMBER_WHITE
};

// How finely a fall is drawn.
typedef struct FallDetail {
    int columns;     // strands of a layer; 0 = it is too small to be seen
    int rows, sheet; // rows of a strand, and of the sheet
} FallDetail;

typedef struct FallMesher {
    const Terrain *terrain;
    const DrawnLand *land;
    int32_t lip;
    float level; // m, of the pool
    Vec3 way, across;
    float half, speed, cover; // cover: how closely strands stand together at the foot, 0..1
    FallDetail detail;
    bool breaks; // below the lip its strands become white water
    Mesh *mesh;
    int64_t vertices, faces;
} FallMesher;

static float number_of(const FallMesher *f, int strand, int number)
{
    uint64_t key = random_key(f->terrain->water->id[f->lip], (uint64_t)strand);
    return random_unit(random_key(key, (uint64_t)number));
}

// From the lip as the river's surface is drawn there, a little upstream of its end.
static Vec3 strand_start(const FallMesher *f, float side)
{
    Vec3 middle = f->terrain->water->position[f->lip];
    Vec3 p = vec3_madd(middle, side * f->half, f->across);
    p = vec3_madd(p, -0.3f * f->land->field->cell.x, f->way);
    float over = drawn_land_at(f->land, p.x, p.z) + terrain_bed_depth(f->half, f->half);
    p.y = fmaxf(middle.y, over);
    return p;
}

static float strand_side(const FallMesher *f, int strand)
{
    float jitter = number_of(f, strand, NUMBER_SIDE);
    return 2.0f * ((float)(strand % f->detail.columns) + jitter) / (float)f->detail.columns - 1.0f;
}

// Rocks at the lip part the water into tongues: its share at a place across, about 1.
static float tongue(const FallMesher *f, float side)
{
    uint64_t seed = random_key(f->terrain->water->id[f->lip], STRANDS);
    float x = 2.5f * side, broad = noise_plane_fractal(x, 0.3f, 2, seed);
    float narrow = noise_plane_fractal(6.0f * x, 7.3f, 2, seed);
    return clampf(1.0f + 1.5f * broad + 1.1f * narrow, 0.0f, 2.2f);
}

// m/s, of the water at a place across the lip.
static float speed_at(const FallMesher *f, float side)
{
    float held = 1.0f - 0.35f * side * side; // by the banks
    return held * (0.6f + 0.4f * tongue(f, side)) * f->speed;
}

// The path of what leaves the lip at a place across. *step: s between its places.
static int path_from(const FallMesher *f, float side, Vec3 velocity, Vec3 place[STEPS], float *step)
{
    Vec3 start = strand_start(f, 0.97f * side);
    float height = start.y > f->level ? start.y - f->level : 0.0f;
    FallPath path = {.land = f->land,
                     .way = f->way,
                     .level = f->level,
                     .film = 0.2f * terrain_bed_depth(f->half, f->half),
                     .step = sqrtf(2.0f * height / GRAVITY) / (0.6f * STEPS)};
    *step = path.step;
    return path.step > 0.0f ? terrain_fall_path(&path, start, velocity, place, STEPS) : 0;
}

static int strand_path(const FallMesher *f, int strand, Vec3 place[STEPS], float *step)
{
    float side = strand_side(f, strand);
    float fast = lerpf(0.7f, 1.25f, number_of(f, strand, NUMBER_SPEED)) * speed_at(f, side);
    float drift = 0.16f * f->speed * (number_of(f, strand, NUMBER_DRIFT) - 0.5f);
    Vec3 velocity = vec3_madd(vec3_scale(f->way, fast), drift, f->across);
    velocity.y = 0.25f * f->speed * (number_of(f, strand, NUMBER_LIFT) - 0.5f);
    return path_from(f, side, velocity, place, step);
}

// Below the lip a strand parts into clots, evenly spaced in the time of its fall, and the longer it
// falls, the wider the gaps between them: its width at a share of the height, relative to the mean.
static float clots(const FallMesher *f, int strand, float share)
{
    const float often = 16.0f; // clots in the time of the fall
    uint64_t seed = random_key(f->terrain->water->id[f->lip], STRANDS + 2);
    float along = often * sqrtf(share), apart = smoothstepf(0.1f, 0.7f, share);
    float noise = noise_plane_fractal(along, 7.3f * (float)strand, 3, seed);
    return clampf(1.0f + lerpf(3.2f, 1.6f, f->cover) * apart * noise, 0.0f, 2.5f);
}

// Width of a strand, relative to the mean.
static float strand_width(const FallMesher *f, int strand)
{
    float wide = number_of(f, strand, NUMBER_WIDTH);
    return lerpf(0.25f, 1.9f, wide * wide) * tongue(f, strand_side(f, strand));
}

// Half the width of a strand where it has fallen by this share: none at the lip, where the sheet
// is, torn below.
static float strand_half(const FallMesher *f, int strand, float share)
{
    float spacing = 2.0f * f->half / (float)f->detail.columns;
    float from = strand < f->detail.columns ? 0.0f : 0.75f * number_of(f, strand, NUMBER_START);
    float torn = lerpf(1.4f, lerpf(0.25f, 0.65f, f->cover), smoothstepf(0.0f, 0.6f, share));
    float own = strand_width(f, strand);
    float grown = smoothstepf(from, from + 0.12f, share);
    own = fminf(own * clots(f, strand, share), 4.2f); // no wider than the widest whole one
    grown *= f->breaks ? 1.0f - white_water_share(share) : 1.0f;
    return 0.5f * spacing * torn * own * grown; // at most about 1.5 spacings
}

// A quad between vertices v and v + 1 of a row and those of the row above it, `columns` before:
// seen from the front, counter-clockwise.
static void add_quad(FallMesher *f, uint32_t v, uint32_t columns)
{
    uint32_t *corner = f->mesh->index + 4 * f->faces++;
    corner[0] = v - columns;
    corner[1] = v;
    corner[2] = v + 1;
    corner[3] = v + 1 - columns;
}

static void put_vertex(FallMesher *f, int64_t v, Vec3 at, float foam)
{
    f->mesh->position[v] = vec3_add(at, f->terrain->params->position);
    Vec3 from = f->terrain->water->position[f->lip];
    float down = from.y - at.y, fast = fmaxf(f->speed, sqrtf(2.0f * GRAVITY * fmaxf(down, 0.0f)));
    f->mesh->uv[v] =
        (Vec2){terrain_drawn_out(fast) * down, vec3_dot(vec3_sub(at, from), f->across)};
    f->mesh->foam[v] = foam;
}

static void add_strand_row(FallMesher *f, Vec3 p, Vec3 along, float half, float foam)
{
    Vec3 front = vec3_normalize(vec3_cross(along, f->across));
    for (int i = 0; i < 3; i++) {
        Vec3 at = vec3_madd(p, (float)(i - 1) * half, f->across);
        put_vertex(f, f->vertices++, i == 1 ? vec3_madd(at, 0.6f * half, front) : at, foam);
    }
}

static void add_strand(FallMesher *f, int strand)
{
    Vec3 place[STEPS];
    float step;
    int count = strand_path(f, strand, place, &step);
    if (count < 2) {
        return;
    }
    float lip = f->terrain->flow[f->lip].foam;
    float white = lerpf(0.5f, 1.0f, number_of(f, strand, NUMBER_WHITE)); // some are still clear
    for (int row = 0; row < f->detail.rows; row++) {
        float at = (float)row / (float)(f->detail.rows - 1) * (float)(count - 1);
        int k = (int)at < count - 2 ? (int)at : count - 2;
        Vec3 p = vec3_lerp(place[k], place[k + 1], at - (float)k);
        float share = (place[0].y - p.y) / fmaxf(place[0].y - f->level, 1e-6f);
        if (f->breaks && white_water_share(share) >= 1.0f) {
            break;
        }
        float foam = lerpf(fmaxf(lip, 0.35f), white, smoothstepf(0.0f, 0.12f, share));
        foam = lerpf(foam, 1.0f, smoothstepf(0.6f, 1.0f, share));
        add_strand_row(f, p, vec3_sub(place[k + 1], place[k]), strand_half(f, strand, share), foam);
        for (uint32_t i = 0; i < 2 && row > 0; i++) {
            add_quad(f, (uint32_t)f->vertices - 3 + i, 3);
        }
    }
}

// ---- the sheet

static int sheet_columns(const FallMesher *f)
{
    return 2 * f->detail.columns + 1;
}

static float share_fallen(const FallMesher *f, const Vec3 *place, int k)
{
    return (place[0].y - place[k].y) / fmaxf(place[0].y - f->level, 1e-6f);
}

// The place on a path, in steps, where it has fallen by this share of its height.
static float step_at(const FallMesher *f, const Vec3 *place, int count, float share)
{
    int k = 0;
    while (k < count - 2 && share_fallen(f, place, k + 1) < share) {
        k++;
    }
    float from = share_fallen(f, place, k), to = share_fallen(f, place, k + 1);
    return (float)k + clampf((share - from) / fmaxf(to - from, 1e-6f), 0.0f, 1.0f);
}

// Water bends over the lip as one sheet, clear at first, then white in streaks; it is torn where
// the strands of it are wide enough, earlier where rocks hold it back. Its columns begin as level
// as the river ends.
static void add_sheet(FallMesher *f)
{
    uint32_t columns = (uint32_t)sheet_columns(f), rows = (uint32_t)f->detail.sheet;
    uint32_t first = (uint32_t)f->vertices;
    uint64_t seed = random_key(f->terrain->water->id[f->lip], STRANDS + 4);
    float lip = f->terrain->flow[f->lip].foam;
    f->vertices += (int64_t)columns * rows;
    for (uint32_t column = 0; column < columns; column++) {
        float side = 2.0f * (float)column / (float)(columns - 1) - 1.0f, step;
        Vec3 place[STEPS];
        int count = path_from(f, side, vec3_scale(f->way, speed_at(f, side)), place, &step);
        float x = side * f->half, streak = noise_plane_fractal(2.7f * x, 0.7f, 3, seed);
        float ends = lerpf(0.05f, 0.2f, fminf(tongue(f, side), 1.0f)) * (1.0f + 0.5f * streak);
        float last = count > 1 ? step_at(f, place, count, ends) : 0.0f;
        for (uint32_t row = 0; row < rows; row++) {
            float along = (float)row / (float)(rows - 1), at = along * last;
            int k = count > 1 && (int)at > count - 2 ? count - 2 : (int)at;
            Vec3 p = count > 1 ? vec3_lerp(place[k], place[k + 1], at - (float)k)
                               : strand_start(f, 0.97f * side);
            float white = smoothstepf(0.1f, 0.9f, along + 0.7f * streak * (1.0f - along));
            uint32_t v = first + row * columns + column;
            put_vertex(f, v, p, lerpf(lip, 1.0f, white));
            if (row > 0 && column + 1 < columns) {
                add_quad(f, v, columns);
            }
        }
    }
}

// ----

// The lower end of the lip's direction is its pool; the upper one the node above, if there is one.
static Vec3 way_at(const OutTree *water, const int32_t *main, int32_t lip)
{
    Vec3 from = water->position[main[lip] >= 0 ? main[lip] : lip];
    Vec3 to = water->position[water->parent[lip]];
    return vec3_normalize(vec3(to.x - from.x, 0.0f, to.z - from.z));
}

static Mesh *fall_mesh(FallMesher *f, const int32_t *main, Error *e)
{
    const OutTree *water = f->terrain->water;
    const RiverFlow *flow = &f->terrain->flow[f->lip];
    f->way = way_at(water, main, f->lip);
    f->across = vec3(f->way.z, 0.0f, -f->way.x);
    f->half = water->radius[f->lip];
    f->speed = fmaxf(terrain_lip_speed(flow->discharge, f->half), flow->speed);
    float height = water->position[f->lip].y - f->level;
    float thick = flow->discharge / (2.0f * f->half * sqrtf(2.0f * GRAVITY * height));
    f->cover = thick / (thick + 0.01f); // sheets of a centimetre are torn
    f->vertices = f->faces = 0;
    int strands = f->detail.columns * LAYERS;
    int64_t columns = sheet_columns(f), rows = f->detail.rows, sheet = f->detail.sheet;
    f->mesh = mesh_new(4, strands * rows * 3 + columns * sheet,
                       strands * (rows - 1) * 2 + (columns - 1) * (sheet - 1),
                       MESH_NORMAL | MESH_UV | MESH_FOAM, e);
    if (f->mesh) {
        add_sheet(f);
    }
    for (int i = 0; f->mesh && i < strands; i++) {
        add_strand(f, i);
    }
    if (f->mesh) {
        f->mesh->vertex_count = f->vertices;
        f->mesh->face_count = f->faces;
    }
    if (f->mesh && !(mesh_compute_normals(f->mesh, e) && drawn_move(f->land, f->mesh, e))) {
        mesh_free(f->mesh);
        return NULL;
    }
    return f->mesh;
}

static int strand_in_scene(const FallMesher *f, int strand, Vec3 place[STEPS], float *step)
{
    int count = strand_path(f, strand, place, step);
    for (int i = 0; i < count; i++) {
        place[i] = drawn_in_scene(f->land, vec3_add(place[i], f->terrain->params->position));
    }
    return count;
}

// What it throws up, in the scene.
static SprayParcels *fall_spray(const FallMesher *f, Error *e)
{
    SprayParcels *spray = memory_alloc_zero(1, sizeof *spray, e);
    FallSpray fall = {.way = f->way,
                      .across = f->across,
                      .half = f->half,
                      .height = f->terrain->water->position[f->lip].y - f->level,
                      .cover = f->cover,
                      .strands = f->detail.columns * LAYERS,
                      .key = random_key(f->terrain->water->id[f->lip], STRANDS + 1)};
    bool done = spray;
    for (int strand = 0; done && strand < fall.strands; strand++) {
        Vec3 place[STEPS];
        int count = strand_in_scene(f, strand, place, &(float){0});
        done = count < 2 || terrain_spray_strand(&fall, strand, place, count, spray, e);
    }
    if (!done) {
        spray_free(spray);
        return NULL;
    }
    return spray;
}

// Its white water, in the scene.
static SprayParcels *fall_water(const FallMesher *f, Error *e)
{
    SprayParcels *water = memory_alloc_zero(1, sizeof *water, e);
    int strands = f->detail.columns * LAYERS;
    WhiteWater white = {.across = f->across,
                        .way = f->way,
                        .spacing = 2.0f * f->half / (float)f->detail.columns,
                        .discharge = f->terrain->flow[f->lip].discharge,
                        .shutter = f->terrain->params->rivers.shutter,
                        .key = random_key(f->terrain->water->id[f->lip], STRANDS + 3)};
    bool done = water;
    for (int strand = 0; done && strand < strands; strand++) {
        Vec3 place[STEPS];
        WhiteStrand part = {.number = strand,
                            .side = f->half * strand_side(f, strand),
                            .place = place,
                            .width = strand_width(f, strand)};
        part.count = strand_in_scene(f, strand, place, &part.step);
        done = part.count < 2 || white_water_strand(&white, &part, water, e);
    }
    if (!done) {
        spray_free(water);
        return NULL;
    }
    white_water_settle(&white, water);
    return water;
}

// So many that up to 400 falls take at most about 100 MB together.
static int strands_across(const Terrain *terrain)
{
    int64_t falls = 0;
    for (int64_t i = 0; i < terrain->water->count; i++) {
        falls += terrain->drop[i] > 0.0f;
    }
    int64_t columns = falls > MANY ? (int64_t)ACROSS * MANY / falls : ACROSS;
    return columns > FEWEST ? (int)columns : FEWEST;
}

static int clamped(float value, int least, int most)
{
    return value < (float)least ? least : value > (float)most ? most : (int)value;
}

// As finely as can be seen, in copies of the square; the square's own falls are all drawn alike.
static FallDetail detail_of(const DrawnLand *land, int32_t lip, float height, int columns)
{
    const float seen = 0.0004f; // of the distance, m; see also objects/common/near_copies.h
    const OutTree *water = land->terrain->water;
    FallDetail full = {columns, ROWS, SHEET};
    float fine = drawn_is_copy(land) ? seen * drawn_away(land, water->position[lip]) : 0.0f;
    if (fine <= 0.0f) {
        return full;
    }
    if (height < fine) {
        return (FallDetail){0};
    }
    return (FallDetail){clamped(2.0f * water->radius[lip] / fine, FEWEST_FAR, full.columns),
                        clamped(height / fine, FEWEST_ROWS, full.rows),
                        clamped(height / fine, FEWEST_SHEET, full.sheet)};
}

// Adds a fall with what clouds may show of it. Those of copies have nothing for clouds, whose grids
// would reach as far.
static bool add_fall(FallMesher *f, const int32_t *main, const Placing *placing, Error *e)
{
    bool spray = placing->keep_spray && !drawn_is_copy(f->land);
    f->breaks = placing->keep_water && !drawn_is_copy(f->land);
    Part part = {.mesh = fall_mesh(f, main, e), .is_water = true};
    if (part.mesh && ((spray && !(part.spray = fall_spray(f, e))) ||
                      (f->breaks && !(part.water = fall_water(f, e))))) {
        part_free_meshes(&part);
    }
    return placing_add(placing, part, TERRAIN_WATER, e);
}

bool terrain_add_falls(const DrawnLand *land, const Placing *placing, Error *e)
{
    const Terrain *terrain = land->terrain;
    const OutTree *water = terrain->water;
    int32_t *main = terrain_main_children(water, e);
    float lake = terrain->params->water_level > 0.0f
                     ? terrain_water_height(terrain->params, land->field)
                     : -INFINITY;
    int columns = strands_across(terrain);
    bool done = main;
    for (int64_t i = 0; done && i < water->count; i++) {
        float top = water->position[i].y;
        if (terrain->drop[i] <= 0.0f || top <= lake) {
            continue;
        }
        FallMesher f = {.terrain = terrain, .land = land, .lip = (int32_t)i};
        f.level = fmaxf(water->position[water->parent[i]].y, lake);
        f.detail = detail_of(land, f.lip, top - f.level, columns);
        done = f.detail.columns == 0 || add_fall(&f, main, placing, e);
    }
    free(main);
    return done;
}

bool terrain_measure_falls(const Terrain *terrain, MeasureList *list, Error *e)
{
    const OutTree *water = terrain->water;
    int64_t highest = -1;
    double count = 0.0, nan = (double)NAN;
    for (int64_t i = 0; water && terrain->drop && i < water->count; i++) {
        count += terrain->drop[i] > 0.0f;
        bool higher = highest < 0 || terrain->drop[i] > terrain->drop[highest];
        highest = terrain->drop[i] > 0.0f && higher ? i : highest;
    }
    if (highest < 0) {
        return true;
    }
    Vec3 lip = vec3_add(water->position[highest], terrain->params->position);
    return measures_add(list, "waterfalls", count, "", nan, nan, e) &&
           measures_add(list, "fall_height", (double)terrain->drop[highest], "m", nan, nan, e) &&
           measures_add(list, "fall_discharge", (double)terrain->flow[highest].discharge, "m^3/s",
                        nan, nan, e) &&
           measures_add(list, "fall_x", (double)lip.x, "m", nan, nan, e) &&
           measures_add(list, "fall_y", (double)lip.y, "m", nan, nan, e) &&
           measures_add(list, "fall_z", (double)lip.z, "m", nan, nan, e);
}
