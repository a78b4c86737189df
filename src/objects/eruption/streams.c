// Streams of lava. The branches of one set out together and run down from sample to sample of the
// land, the steeper the likelier, so that they part where the land parts them. A branch is as many
// strands side by side as fit its width.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "land/height_drainage.h"
#include "objects/eruption/eruption.h"

#include <stdlib.h>
#include <string.h>

static const float STEP = 5.0f;      // m
static const float THICK = 2.5f;     // m by which glowing lava stands above the land
static const float STRAND = 1.3f;    // m from strand to strand
static const float COOLING = 190.0f; // K from the source of a branch to its end
static const float CRUST = 420.0f;   // K by which crust is colder than what it covers
static const float DARK = 930.0f;    // K, below which it shows no glow
enum { MOST_STEPS = 2400, MOST_NODES = 4000 };

// The middle of a branch.
typedef struct Course {
    Vec3 node[MOST_NODES]; // of the land, on its way
    Vec3 at[MOST_STEPS];
    float width[MOST_STEPS]; // m
    int count;
} Course;

// The land with its hollows filled, as lava fills them before it runs on: from each of its samples
// a way leads down to the rim. The caller frees it.
static HeightField *filled(const HeightField *land, Error *e)
{
    const float fall = 0.02f;
    HeightField *copy = height_field_new(land->columns, land->rows, land->cell, land->origin, e);
    if (!copy) {
        return NULL;
    }
    memcpy(copy->height, land->height, sizeof(float) * (size_t)height_field_count(land));
    if (!height_field_fill(copy, fall, e)) {
        height_field_free(copy);
        return NULL;
    }
    return copy;
}

// A lower neighbour of sample i, drawn by its descent: mostly the steepest, at times another, so
// that branches part where the land hardly prefers one. -1 at the rim.
static int64_t step_down(const HeightField *full, int64_t i, uint64_t key)
{
    const int columns = full->columns, x = (int)(i % columns), z = (int)(i / columns);
    if (x == 0 || z == 0 || x == columns - 1 || z == full->rows - 1) {
        return -1;
    }
    double weight[8], sum = 0.0;
    int64_t next[8];
    for (int k = 0; k < 8; k++) {
        int at = k < 4 ? k : k + 1, dx = at % 3 - 1, dz = at / 3 - 1;
        next[k] = i + (int64_t)dz * columns + dx;
        double far = dx != 0 && dz != 0 ? 1.4142135623730951 : 1.0;
        double drop = (double)(full->height[i] - full->height[next[k]]) / far;
        weight[k] = drop > 0.0 ? drop * drop * drop * drop : 0.0;
        sum += weight[k];
    }
    double left = (double)random_unit(key) * sum;
    for (int k = 0; k < 8; k++) {
        if (weight[k] > 0.0 && left <= weight[k]) {
            return next[k];
        }
        left -= weight[k];
    }
    return -1;
}

static Vec3 sample_place(const HeightField *land, int64_t i)
{
    int64_t column = i % land->columns, row = i / land->columns;
    return vec3(land->origin.x + (float)column * land->cell.x, 0.0f,
                land->origin.y + (float)row * land->cell.y);
}

// From sample to sample; returns their number.
static int descend(const HeightField *full, float x, float z, Vec3 node[MOST_NODES], float length,
                   uint64_t key)
{
    int column = (int)lrintf((x - full->origin.x) / full->cell.x);
    int row = (int)lrintf((z - full->origin.y) / full->cell.y);
    if (column < 0 || row < 0 || column >= full->columns || row >= full->rows) {
        return 0;
    }
    int64_t i = (int64_t)row * full->columns + column;
    float way = 0.0f;
    int count = 0;
    while (i >= 0 && count < MOST_NODES && way < length) {
        node[count] = sample_place(full, i);
        way += count > 0 ? vec3_distance(node[count], node[count - 1]) : 0.0f;
        i = step_down(full, i, random_key(key, (uint64_t)count++));
    }
    return count;
}

// Rounds off the corners of a way from sample to sample.
static void smooth(Vec3 node[], int count)
{
    enum { PASSES = 3 };
    for (int pass = 0; pass < PASSES; pass++) {
        Vec3 last = node[0];
        for (int i = 1; i + 1 < count; i++) {
            Vec3 here = node[i], ends = vec3_add(last, node[i + 1]);
            last = here;
            node[i] = vec3_lerp(here, vec3_scale(ends, 0.5f), 0.5f);
        }
    }
}

// full: the land, filled.
static void run_down(Course *c, const LavaStream *s, const HeightField *full, float length,
                     uint64_t key)
{
    float x = s->at[0] + s->width * random_normal(random_key(key, 5));
    float z = s->at[1] + s->width * random_normal(random_key(key, 6));
    int nodes = descend(full, x, z, c->node, length, random_key(key, 7));
    smooth(c->node, nodes);
    c->count = 0;
    float way = 0.0f, at = 0.0f; // of the next point; of the node
    for (int i = 0; i + 1 < nodes; i++) {
        float stretch = fmaxf(vec3_distance(c->node[i], c->node[i + 1]), 1e-3f);
        for (; way < at + stretch && c->count < MOST_STEPS; way += STEP) {
            float swell = 1.0f + 0.9f * noise_plane(way / 110.0f, 1.5f, random_key(key, 2));
            c->at[c->count] = vec3_lerp(c->node[i], c->node[i + 1], (way - at) / stretch);
            c->width[c->count++] = s->width * swell * (1.0f - 0.6f * fminf(way / length, 1.0f));
        }
        at += stretch;
    }
}

// The place beside a course, in shares of half its width, on the land.
static Vec3 beside(const Course *c, int i, float share, const HeightField *land)
{
    int before = i > 2 ? i - 2 : 0, after = i + 2 < c->count ? i + 2 : c->count - 1;
    Vec3 along = vec3_sub(c->at[after], c->at[before]);
    float length = fmaxf(sqrtf(along.x * along.x + along.z * along.z), 1e-3f);
    float off = 0.5f * c->width[i] * share / length;
    Vec3 p = vec3(c->at[i].x - off * along.z, 0.0f, c->at[i].z + off * along.x);
    p.y = height_field_smooth_at(land, p.x, p.z);
    return p;
}

// The temperature of the surface: crust covers more of it toward the end and at the sides.
static float surface(const EruptionParams *p, float done, float share, float way, uint64_t key)
{
    float core = p->temperature + 273.0f - COOLING * exact_pow(done, 0.7f) - 50.0f * share * share;
    float plates = noise_plane_fractal(way / 34.0f, 2.6f * share, 4, key);
    float cover = lerpf(-0.34f, 0.30f, done) + 0.22f * share * share;
    return core - CRUST * smoothstepf(-0.14f, 0.16f, plates + cover);
}

static bool add_strand(Trails *t, const EruptionParams *p, const Course *c, float share,
                       float length, const HeightField *land, uint64_t key, uint64_t own, Error *e)
{
    float radius = 0.5f * STRAND * random_range(random_key(own, 0), 0.7f, 1.3f);
    bool open = false;
    for (int i = 0; i < c->count; i++) {
        float way = (float)i * STEP;
        float wander = share + 0.25f * noise_plane(way / 50.0f, 3.1f * share, random_key(own, 1));
        float kelvin = surface(p, way / length, share, way, key);
        if (kelvin < DARK) {
            open = false;
            continue;
        }
        Vec3 at = beside(c, i, wander, land);
        at.y += THICK;
        if ((!open && !trails_begin(t, e)) ||
            !trails_add(t, (TrailPoint){at, radius, kelvin, 1.0f}, e)) {
            return false;
        }
        open = true;
    }
    return true;
}

// Rubble of crust on and beside the branch.
static bool add_crust(Trails *t, const Course *c, float share, const HeightField *land,
                      uint64_t own, Error *e)
{
    if (!trails_begin(t, e)) {
        return false;
    }
    for (int i = 0; i < c->count; i++) {
        uint64_t here = random_key(own, (uint64_t)i);
        float radius = (0.1f * c->width[i] + 1.0f) * random_range(random_key(here, 0), 0.6f, 1.2f);
        Vec3 at = beside(c, i, share + 0.3f * random_unit(random_key(here, 1)), land);
        at.y += THICK - 1.15f * radius;
        if (!trails_add(t, (TrailPoint){at, radius, 0.0f, 0.0f}, e)) {
            return false;
        }
    }
    return true;
}

static bool add_branch(Trails *strands, Trails *crust, const EruptionParams *p, const Course *c,
                       float width, float length, const HeightField *land, uint64_t key, Error *e)
{
    enum { RUBBLE = 7 };
    int count = 1 + (int)(width / STRAND);
    bool done = true;
    for (int k = 0; done && k < count; k++) {
        float share = count > 1 ? 2.0f * (float)k / (float)(count - 1) - 1.0f : 0.0f;
        done = add_strand(strands, p, c, share, length, land, random_key(key, 1),
                          random_key(key, 100 + (uint64_t)k), e);
    }
    for (int k = 0; done && k < RUBBLE; k++) {
        float share = 2.8f * ((float)k / (RUBBLE - 1) - 0.5f);
        done = add_crust(crust, c, share, land, random_key(key, 10 + (uint64_t)k), e);
    }
    return done;
}

bool eruption_flow(Trails *strands, Trails *crust, const EruptionParams *p, const HeightField *land,
                   uint64_t seed, Error *e)
{
    Course *course = memory_alloc(1, sizeof *course, e);
    HeightField *full = course ? filled(land, e) : NULL;
    bool done = full;
    for (int s = 0; done && s < p->stream_count; s++) {
        const LavaStream *stream = &p->stream[s];
        for (int b = 0; done && b < stream->branches; b++) {
            uint64_t key = random_key(random_key(seed, (uint64_t)s), (uint64_t)b);
            float share = b == 0 ? 1.0f : random_range(random_key(key, 3), 0.4f, 0.95f);
            float length = share * stream->length;
            run_down(course, stream, full, length, key);
            done = course->count < 2 ||
                   add_branch(strands, crust, p, course, stream->width, length, land, key, e);
        }
    }
    height_field_free(full);
    free(course);
    return done;
}
