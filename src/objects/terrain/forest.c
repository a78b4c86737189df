// Conifers on the land: three forms, instanced where slope, altitude and clearings allow.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/terrain/drawn.h"
#include "objects/terrain/lakes.h"

#include <math.h>
#include <stdlib.h>

// Of the forest; + i: form, copy of the square or tree i.
enum { STREAM_FRAY = 5, STREAM_FORMS = 50, STREAM_COPIES = 100, STREAM_TREES = 1000 };
enum { STREAM_SLIM = 1, STREAM_BOUGHS = 100 }; // of a form; BOUGHS + i: bough i
enum { STREAM_BOUGH_TURN = 1, STREAM_BOUGH_LENGTH = 2, STREAM_BOUGH_LIFT = 3 }; // of a bough
// Of a tree.
enum {
    STREAM_TREE_X = 1,
    STREAM_TREE_Z = 2,
    STREAM_TREE_CHANCE = 3,
    STREAM_TREE_HEIGHT = 4,
    STREAM_TREE_FAR = 5,
    STREAM_TREE_TURN = 6,
    STREAM_TREE_WIDTH = 7
};

enum { FORMS = 3, WHORLS = 13, BOUGHS = 12 };

#define MOST_ROWS 2e9f // of trees; their square must be a 64-bit number

// A tree of height 1: whorls of drooping boughs, each a bent triangle of two faces.
static Mesh *conifer_mesh(uint64_t seed, Error *e)
{
    Mesh *mesh = mesh_new(3, WHORLS * BOUGHS * 4, WHORLS * BOUGHS * 2, MESH_NORMAL, e);
    if (!mesh) {
        return NULL;
    }
    float slim = random_range(random_key(seed, STREAM_SLIM), 0.13f, 0.19f);
    for (int w = 0; w < WHORLS; w++) {
        float share = (float)w / (WHORLS - 1);
        float height = lerpf(0.10f, 0.97f, share);
        float reach = slim * (1.03f - share) * (0.6f + 0.4f * smoothstepf(0.0f, 0.2f, share));
        for (int b = 0; b < BOUGHS; b++) {
            uint64_t key = random_key(seed, STREAM_BOUGHS + (uint64_t)(w * BOUGHS + b));
            float turn = ((float)b + 0.5f * (float)(w & 1) +
                          random_unit(random_key(key, STREAM_BOUGH_TURN))) *
                         (2.0f * PI_F / BOUGHS);
            float length = reach * random_range(random_key(key, STREAM_BOUGH_LENGTH), 0.65f, 1.15f);
            float wide = 0.34f * length + 0.004f, sine, cosine;
            exact_sincos(turn, &sine, &cosine);
            Vec3 out = vec3(cosine, 0.0f, sine), side = vec3(-sine, 0.0f, cosine);
            float lift = random_range(random_key(key, STREAM_BOUGH_LIFT), -0.01f, 0.01f);
            int64_t v = 4 * (w * BOUGHS + b);
            Vec3 root = vec3(0.0f, height + lift + 0.05f, 0.0f);
            Vec3 middle = vec3_madd(vec3(0.0f, height + lift, 0.0f), 0.62f * length, out);
            mesh->position[v] = root;
            mesh->position[v + 1] = vec3_madd(middle, wide, side);
            mesh->position[v + 2] =
                vec3_madd(vec3(0.0f, height - 0.35f * length, 0.0f), length, out);
            mesh->position[v + 3] = vec3_madd(middle, -wide, side);
            // Normals of a cone, so that it shades like soft needles, not like sheets.
            for (int k = 0; k < 4; k++) {
                mesh->normal[v + k] =
                    vec3_normalize(vec3_madd(vec3(0.0f, 0.55f, 0.0f), k == 0 ? 0.5f : 1.0f, out));
            }
            uint32_t *corner = mesh->index + (int64_t)6 * (w * BOUGHS + b);
            corner[0] = corner[3] = (uint32_t)v;
            corner[1] = (uint32_t)v + 1;
            corner[2] = corner[4] = (uint32_t)v + 2;
            corner[5] = (uint32_t)v + 3;
        }
    }
    return mesh;
}

typedef struct Planting {
    const DrawnLand *land;
    const Terrain *terrain;
    const TerrainParams *params;
    const HeightField *field;
    Vec3 eye; // in the field's space
    bool has_eye;
    float low, high, lake, least_upright;
    uint64_t seed;
    uint64_t trees; // of the individuals
    int64_t stride; // of the jittered grid, in places: more where only few trees are kept
} Planting;

// The trees of the square, then those of its copies.
typedef struct Planted {
    Transform *place; // owned
    int64_t count, capacity;
} Planted;

// Height of the tree at a place; 0 = none.
static float tree_size(const Planting *p, float x, float z, uint64_t key)
{
    const TerrainForestParams *forest = &p->params->forest;
    float h = height_field_at(p->field, x, z), step = 2.0f * p->field->cell.x;
    float dx = (height_field_at(p->field, x + step, z) - height_field_at(p->field, x - step, z)) /
               (2.0f * step);
    float dz = (height_field_at(p->field, x, z + step) - height_field_at(p->field, x, z - step)) /
               (2.0f * step);
    float upright = 1.0f / sqrtf(1.0f + dx * dx + dz * dz);
    float altitude = (h - p->low) / (p->high - p->low);
    float fray = noise_plane_fractal(x / (12.0f * forest->height), z / (12.0f * forest->height), 4,
                                     random_key(p->seed, STREAM_FRAY));
    float line = smoothstepf(forest->high, 0.7f * forest->high, altitude + 0.12f * fray);
    float wood = smoothstepf(-0.15f, 0.15f, fray + 0.25f - 0.55f * forest->clumping);
    float keep = line * lerpf(1.0f, wood, forest->clumping) *
                 smoothstepf(p->least_upright - 0.05f, p->least_upright + 0.05f, upright);
    if (altitude < forest->low || h < p->lake ||
        terrain_lake_at(p->terrain, p->field, x, z) > -INFINITY ||
        random_unit(random_key(key, STREAM_TREE_CHANCE)) > keep) {
        return 0.0f;
    }
    float tall = forest->height * random_range(random_key(key, STREAM_TREE_HEIGHT), 0.45f, 1.0f) *
                 (0.55f + 0.45f * line);
    // Its lowest boughs must not reach over rivers either.
    return terrain_shore(p->terrain, x, z) > 0.2f * tall ? tall : 0.0f;
}

// Where a tree stands, in the scene: a little below the land; false in the water of a lake, whose
// shore on tiles is finer than its samples.
static bool find_foot(const Planting *p, float x, float z, float tall, Vec3 *foot)
{
    bool tiles = drawn_of_tiles(p->land);
    float height = tiles ? drawn_land_at(p->land, x, z) : height_field_at(p->field, x, z);
    Vec3 place = vec3_add(vec3(x, height - 0.06f * tall, z), p->params->position);
    *foot = drawn_in_scene(p->land, place);
    const float *water = tiles ? p->field->water : NULL;
    return !water || height > water[terrain_sample_at(p->field, x, z)];
}

// From one place of the jittered grid to the next, m.
static float spacing_of(const Planting *p)
{
    return 0.36f * p->params->forest.height;
}

// The share of the grid's distance at which trees stand, this far from the eye; 1 or more: all do.
static float share_at(const Planting *p, float away)
{
    float full = 0.32f * sqrtf((float)p->params->forest.count) * spacing_of(p);
    return full / (away + 1.0f);
}

// m in plan from the eye to a place of the square, or of its copy.
static float away_from_eye(const Planting *p, float x, float z)
{
    if (!p->has_eye) {
        return 0.5f * p->params->size;
    }
    if (drawn_is_copy(p->land)) {
        Vec3 middle = p->params->position;
        Vec3 there = drawn_in_scene(p->land, vec3_add(vec3(x, 0.0f, z), middle));
        x = there.x - middle.x;
        z = there.z - middle.z;
    }
    return sqrtf((x - p->eye.x) * (x - p->eye.x) + (z - p->eye.z) * (z - p->eye.z));
}

static bool add_tree(Planted *trees, Vec3 foot, float tall, uint64_t key, Error *e)
{
    if (!memory_reserve(&trees->place, &trees->capacity, trees->count + 1, sizeof *trees->place,
                        e)) {
        return false;
    }
    float sine, cosine;
    exact_sincos(random_range(random_key(key, STREAM_TREE_TURN), 0.0f, 2.0f * PI_F), &sine,
                 &cosine);
    float wide = tall * random_range(random_key(key, STREAM_TREE_WIDTH), 0.85f, 1.2f);
    trees->place[trees->count++] =
        transform_from_axes(vec3(wide * cosine, 0, -wide * sine), vec3(0, tall, 0),
                            vec3(wide * sine, 0, wide * cosine), foot);
    return true;
}

// Plants trees in a jittered grid over the square, or over its copy. If there are more than
// `count`, far ones are left out first.
static bool plant(const Planting *p, Planted *trees, const Run *run, Error *e)
{
    float spacing = spacing_of(p) * (float)p->stride, size = p->params->size;
    int64_t side = (int64_t)fminf(size / spacing, MOST_ROWS);
    int64_t most = trees->count + p->params->forest.count;
    float places = (float)(p->stride * p->stride); // for which one stands
    for (int64_t i = 0; i < side * side && trees->count < most; i++) {
        if (!run_goes_on(run, i, e)) {
            return false;
        }
        uint64_t key = random_key(p->trees, STREAM_TREES + (uint64_t)i);
        float x = ((float)(i % side) + random_unit(random_key(key, STREAM_TREE_X))) * spacing -
                  0.5f * size;
        int64_t row = i / side;
        float z =
            ((float)row + random_unit(random_key(key, STREAM_TREE_Z))) * spacing - 0.5f * size;
        float share = share_at(p, away_from_eye(p, x, z));
        if (share < 1.0f &&
            random_unit(random_key(key, STREAM_TREE_FAR)) > share * share * places) {
            continue;
        }
        float tall = tree_size(p, x, z, key);
        Vec3 foot;
        if (tall > 0.0f && find_foot(p, x, z, tall, &foot) &&
            !add_tree(trees, foot, tall, key, e)) {
            return false;
        }
    }
    return true;
}

// m by which a number lies outside of a range about another.
static float outside(float value, float middle, float half)
{
    return fmaxf(fabsf(value - middle) - half, 0.0f);
}

// The grid's stride at which no place of a copy of the square is to hold more than one tree.
static int64_t stride_over(const Planting *p)
{
    float size = p->params->size, half = 0.5f * size, away = half;
    if (p->has_eye) {
        float x = outside(p->eye.x, (float)p->land->column * size, half);
        float z = outside(p->eye.z, (float)p->land->row * size, half);
        away = sqrtf(x * x + z * z);
    }
    float share = share_at(p, away);
    return share < 1.0f ? (int64_t)(1.0f / share) : 1;
}

// Over the copies of the square, in as many rings as the forest is to go on.
static bool plant_beyond(Planting p, Planted *trees, const Run *run, Error *e)
{
    enum { MOST = TERRAIN_MOST_BEYOND, SIDE = 2 * MOST + 1 };
    int rings = p.params->forest.beyond, side = 2 * rings + 1;
    DrawnLand copy = *p.land;
    p.land = &copy;
    bool done = true;
    for (int i = 0; done && i < side * side; i++) {
        copy.column = i % side - rings;
        copy.row = i / side - rings;
        if (terrain_has_copy(p.params, copy.column, copy.row)) {
            int number = (copy.row + MOST) * SIDE + copy.column + MOST;
            p.trees = random_key(p.seed, STREAM_COPIES + (uint64_t)number);
            p.stride = stride_over(&p);
            done = plant(&p, trees, run, e);
        }
    }
    return done;
}

static bool add_form(const Planted *trees, int form, uint64_t seed, const Placing *placing,
                     Error *e)
{
    int64_t own = (trees->count - form + FORMS - 1) / FORMS;
    if (own <= 0) {
        return true;
    }
    Part part = {.mesh = conifer_mesh(random_key(seed, STREAM_FORMS + (uint64_t)form), e),
                 .instance = memory_alloc(own, sizeof *part.instance, e),
                 .instance_count = own};
    if (!part.instance) {
        mesh_free(part.mesh);
        return false;
    }
    for (int64_t i = 0; i < own; i++) {
        part.instance[i] = trees->place[i * FORMS + form];
    }
    return placing_add(placing, part, TERRAIN_FOLIAGE, e);
}

bool terrain_add_forest(const DrawnLand *land, const Placing *placing, Error *e)
{
    const Terrain *terrain = land->terrain;
    const HeightField *field = land->field;
    const TerrainParams *params = terrain->params;
    const Vec3 *eye = placing->around.eye;
    Planting p = {.land = land,
                  .terrain = terrain,
                  .params = params,
                  .field = field,
                  .has_eye = eye,
                  .seed = random_key(terrain->seed, STREAM_FOREST),
                  .stride = 1};
    p.trees = p.seed;
    if (eye) {
        p.eye = vec3_sub(*eye, params->position);
    }
    float sine, cosine;
    exact_sincos(params->forest.slope * 0.017453292f, &sine, &cosine);
    p.least_upright = cosine;
    height_field_range(field, &p.low, &p.high);
    p.lake = params->water_level > 0.0f ? terrain_water_height(params, field) + 1.0f : p.low - 1.0f;
    if (!(p.high > p.low)) {
        return true;
    }
    const Run *run = placing->recipe->run;
    Planted trees = {0};
    bool done = plant(&p, &trees, run, e) && plant_beyond(p, &trees, run, e);
    for (int form = 0; done && form < FORMS; form++) {
        done = add_form(&trees, form, p.seed, placing, e);
    }
    free(trees.place);
    return done;
}
