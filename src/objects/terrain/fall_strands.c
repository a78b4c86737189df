// Where the strands of a waterfall are, and how wide and white.
#include "base/exact_math.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/terrain/fall.h"
#include "objects/terrain/white_water.h"

#include <math.h>

// The lower end of the lip's direction is its pool; the upper one the node above, if there is one.
static Vec3 way_at(const OutTree *water, const int32_t *main, int32_t lip)
{
    Vec3 from = water->position[main[lip] >= 0 ? main[lip] : lip];
    Vec3 to = water->position[water->parent[lip]];
    return vec3_normalize(vec3(to.x - from.x, 0.0f, to.z - from.z));
}

void fall_init(Fall *fall, const int32_t *main)
{
    const OutTree *water = fall->terrain->water;
    float discharge = fall->terrain->flow[fall->lip].discharge;
    fall->way = way_at(water, main, fall->lip);
    fall->across = vec3(fall->way.z, 0.0f, -fall->way.x);
    fall->half = water->radius[fall->lip];
    fall->speed = terrain_lip_speed(discharge, fall->half);
    float height = water->position[fall->lip].y - fall->level;
    float thick = discharge / (2.0f * fall->half * sqrtf(2.0f * FALL_GRAVITY * height));
    fall->cover = thick / (thick + 0.01f); // sheets of a centimetre are torn
}

enum {
    NUMBER_SIDE,
    NUMBER_SPEED,
    NUMBER_DRIFT,
    NUMBER_LIFT,
    NUMBER_WIDTH,
    NUMBER_START,
    NUMBER_WHITE
};

uint64_t fall_stream(const Fall *fall, int stream)
{
    return random_key(fall->terrain->water->id[fall->lip], (uint64_t)stream);
}

static float number_of(const Fall *fall, int strand, int number)
{
    return random_unit(random_key(fall_stream(fall, strand), (uint64_t)number));
}

// As the river's surface is drawn there, a little upstream of its end.
Vec3 fall_start(const Fall *fall, float side)
{
    Vec3 middle = fall->terrain->water->position[fall->lip];
    Vec3 p = vec3_madd(middle, side * fall->half, fall->across);
    p = vec3_madd(p, -0.3f * fall->land->field->cell.x, fall->way);
    float over = drawn_land_at(fall->land, p.x, p.z) + terrain_bed_depth(fall->half, fall->half);
    p.y = fmaxf(middle.y, over);
    return p;
}

float fall_strand_side(const Fall *fall, int strand)
{
    float jitter = number_of(fall, strand, NUMBER_SIDE);
    return 2.0f * ((float)(strand % fall->detail.columns) + jitter) / (float)fall->detail.columns -
           1.0f;
}

float fall_tongue(const Fall *fall, float side)
{
    uint64_t seed = fall_stream(fall, FALL_STREAM_TONGUES);
    float x = 2.5f * side, broad = noise_plane_fractal(x, 0.3f, 2, seed);
    float narrow = noise_plane_fractal(6.0f * x, 7.3f, 2, seed);
    return clampf(1.0f + 1.5f * broad + 1.1f * narrow, 0.0f, 2.2f);
}

// m/s, of the water at a place across the lip.
static float speed_at(const Fall *fall, float side)
{
    float held = 1.0f - 0.35f * side * side; // by the banks
    return held * (0.6f + 0.4f * fall_tongue(fall, side)) * fall->speed;
}

// The path of what leaves the lip at a place across. *step: s between its places.
static int path_from(const Fall *fall, float side, Vec3 velocity, Vec3 place[FALL_STEPS],
                     float *step)
{
    Vec3 start = fall_start(fall, 0.97f * side);
    float height = start.y > fall->level ? start.y - fall->level : 0.0f;
    FallPath path = {.land = fall->land,
                     .way = fall->way,
                     .level = fall->level,
                     .film = 0.2f * terrain_bed_depth(fall->half, fall->half),
                     .step = sqrtf(2.0f * height / FALL_GRAVITY) / (0.6f * FALL_STEPS)};
    *step = path.step;
    return path.step > 0.0f ? terrain_fall_path(&path, start, velocity, place, FALL_STEPS) : 0;
}

int fall_strand_path(const Fall *fall, int strand, Vec3 place[FALL_STEPS], float *step)
{
    float side = fall_strand_side(fall, strand);
    float fast = lerpf(0.7f, 1.25f, number_of(fall, strand, NUMBER_SPEED)) * speed_at(fall, side);
    float drift = 0.16f * fall->speed * (number_of(fall, strand, NUMBER_DRIFT) - 0.5f);
    Vec3 velocity = vec3_madd(vec3_scale(fall->way, fast), drift, fall->across);
    velocity.y = 0.25f * fall->speed * (number_of(fall, strand, NUMBER_LIFT) - 0.5f);
    return path_from(fall, side, velocity, place, step);
}

// Below the lip a strand parts into clots, evenly spaced in the time of its fall, and the longer it
// falls, the wider the gaps between them: its width at a share of the height, relative to the mean.
static float clots(const Fall *fall, int strand, float share)
{
    const float often = 16.0f; // clots in the time of the fall
    uint64_t seed = fall_stream(fall, FALL_STREAM_CLOTS);
    float along = often * sqrtf(share), apart = smoothstepf(0.1f, 0.7f, share);
    float noise = noise_plane_fractal(along, 7.3f * (float)strand, 3, seed);
    return clampf(1.0f + lerpf(3.2f, 1.6f, fall->cover) * apart * noise, 0.0f, 2.5f);
}

float fall_strand_width(const Fall *fall, int strand)
{
    float wide = number_of(fall, strand, NUMBER_WIDTH);
    return lerpf(0.25f, 1.9f, wide * wide) * fall_tongue(fall, fall_strand_side(fall, strand));
}

// None at the lip, where the sheet is, torn below.
float fall_strand_half(const Fall *fall, int strand, float share)
{
    float spacing = 2.0f * fall->half / (float)fall->detail.columns;
    float from =
        strand < fall->detail.columns ? 0.0f : 0.75f * number_of(fall, strand, NUMBER_START);
    float torn = lerpf(1.4f, lerpf(0.25f, 0.65f, fall->cover), smoothstepf(0.0f, 0.6f, share));
    float own = fall_strand_width(fall, strand);
    float grown = smoothstepf(from, from + 0.12f, share);
    own = fminf(own * clots(fall, strand, share), 4.2f); // no wider than the widest whole one
    grown *= fall->breaks ? 1.0f - white_water_share(share) : 1.0f;
    return 0.5f * spacing * torn * own * grown; // at most about 1.5 spacings
}

float fall_strand_white(const Fall *fall, int strand)
{
    return lerpf(0.5f, 1.0f, number_of(fall, strand, NUMBER_WHITE)); // some are still clear
}

int fall_sheet_path(const Fall *fall, float side, Vec3 place[FALL_STEPS], float *step)
{
    return path_from(fall, side, vec3_scale(fall->way, speed_at(fall, side)), place, step);
}
