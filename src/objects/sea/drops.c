// Drops in the air above crests that break. Where the crowding exceeds that from which waves break,
// water is torn off in bursts: a thread of it parts into drops that fly on together, each a little
// off the way of the others, until they fall back or the wind has carried the finest ones ahead.
// Few drops are large: their number falls as the third power of the radius (Veron, "Ocean Spray",
// Annu. Rev. Fluid Mech. 47, 2015).
#include "objects/sea/drops.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

enum { STREAM_DROPS = 78 };
enum { DROP_VERTICES = 6, DROP_FACES = 8 };
enum { NUMBER_BURSTS, NUMBER_PLACE_X, NUMBER_PLACE_Z, NUMBERS };

static const float REACH = 60.0f;    // m about the centre
static const float CELL = 0.4f;      // m: of the grid on which bursts begin
static const float DENSITY = 5.0f;   // bursts per m^2 and standard deviation of excess
static const float LOWEST = 0.5f;    // m above the calm surface: crests that tear off water
static const float LEAST = 0.0018f;  // m: radii
static const float MOST = 0.006f;    // larger ones near the camera would be seen as what they are
static const float SHUTTER = 0.002f; // s by which drops are drawn out

typedef struct Drop {
    Vec3 at;      // m
    Vec3 drawn;   // m: half of what it is drawn out by
    float radius; // m
} Drop;

typedef struct Drops {
    const SeaParams *params;
    const Waves *waves;
    float gust; // m/s by which the wind at the crest outruns the waves
    uint64_t key;
    Drop *drop; // owned
    int64_t count, capacity;
} Drops;

// A thread of water: where and how fast it left, how long ago, and how many drops it has made.
typedef struct Burst {
    Vec3 from, speed;
    float age;
    int drops;
    uint64_t key;
} Burst;

static float spread_of(uint64_t key, uint64_t number)
{
    return random_range(random_key(key, number), -1.0f, 1.0f);
}

// A drop's place after its age; false when it has fallen back.
static bool fly(const Drops *d, const Burst *burst, int number, Drop *drop)
{
    uint64_t key = random_key(burst->key, 16 + (uint64_t)number);
    float u = random_unit(random_key(key, 0));
    // The inverse of the distribution of radii.
    float ratio = LEAST / MOST;
    drop->radius = LEAST / sqrtf(1.0f - u * (1.0f - ratio * ratio));
    float age = burst->age * (1.0f + 0.25f * spread_of(key, 1));
    Vec3 off = vec3(spread_of(key, 2), spread_of(key, 3), spread_of(key, 4));
    Vec3 speed = vec3_madd(burst->speed, 0.16f * vec3_length(burst->speed), off);
    // The wind takes a drop along within a time that grows with the radius.
    float lag = 0.9f * drop->radius / 0.004f, taken = d->gust * age / (age + lag);
    speed.x += taken * d->waves->way.x;
    speed.z += taken * d->waves->way.y;
    drop->at = vec3_madd(burst->from, age, speed);
    drop->at.y -= 0.5f * (float)GRAVITY * age * age;
    speed.y -= (float)GRAVITY * age;
    drop->drawn = vec3_scale(speed, 0.5f * SHUTTER);
    return drop->at.y > burst->from.y - 0.4f; // else it has fallen back
}

static bool add_burst(Drops *d, const Burst *burst, Error *e)
{
    for (int i = 0; i < burst->drops; i++) {
        Drop drop;
        if (!fly(d, burst, i, &drop)) {
            continue;
        }
        if (!memory_reserve(&d->drop, &d->capacity, d->count + 1, sizeof *d->drop, e)) {
            return false;
        }
        d->drop[d->count++] = drop;
    }
    return true;
}

// A burst at a place whose crowding exceeds that of breaking by `excess` deviations.
static Burst burst_at(const Drops *d, const WavePoint *point, float x, float z, float excess,
                      uint64_t key)
{
    Vec2 way = d->waves->way;
    float hard = fminf(excess / 3.0f, 1.0f);
    float up = (0.5f + 3.2f * hard) * random_unit(random_key(key, 3));
    float ahead = random_range(random_key(key, 4), -1.2f, 2.2f), aside = 1.1f * spread_of(key, 5);
    Burst burst = {.key = key};
    burst.from = vec3_add(vec3(x, d->params->level, z), point->displacement);
    burst.speed = vec3(ahead * way.x - aside * way.y, up, ahead * way.y + aside * way.x);
    burst.age = random_unit(random_key(key, 6)) * (0.08f + 1.7f * up / (float)GRAVITY);
    float many = random_unit(random_key(key, 7));
    burst.drops = 2 + (int)(40.0f * many * many * many);
    return burst;
}

static float excess_at(const Drops *d, float x, float z, WavePoint *point)
{
    waves_at(d->waves, x, z, 0.5f * CELL, point);
    return (point->crowding - d->waves->foam) / d->waves->spread;
}

// The bursts that begin in a cell of the grid.
static bool add_cell(Drops *d, float x, float z, uint64_t key, Error *e)
{
    WavePoint point;
    float excess = excess_at(d, x, z, &point);
    float gather = noise_plane(x / 1.7f, z / 1.7f, d->key) + 0.15f;
    float high = smoothstepf(LOWEST, 3.0f * LOWEST, point.displacement.y);
    float want = d->params->drops * DENSITY * CELL * CELL * 4.0f * high * (excess - 0.6f) *
                 fmaxf(gather, 0.0f);
    int bursts = (int)(fmaxf(want, 0.0f) + random_unit(random_key(key, NUMBER_BURSTS)));
    bool done = true;
    for (int i = 0; done && want > 0.0f && i < bursts; i++) {
        uint64_t own = random_key(key, NUMBERS + (uint64_t)i);
        float to_x = x + 0.5f * CELL * spread_of(own, NUMBER_PLACE_X);
        float to_z = z + 0.5f * CELL * spread_of(own, NUMBER_PLACE_Z);
        excess = excess_at(d, to_x, to_z, &point);
        if (excess > 0.3f) {
            Burst burst = burst_at(d, &point, to_x, to_z, excess, own);
            done = add_burst(d, &burst, e);
        }
    }
    return done;
}

// An octahedron, drawn out along the drop's way, whose normals are those of a ball.
static void set_drop(Mesh *mesh, int64_t number, const Drop *drop)
{
    static const uint32_t corner[DROP_FACES][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                   {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int v = 0; v < DROP_VERTICES; v++) {
        float side = v % 2 == 0 ? 1.0f : -1.0f;
        Vec3 out =
            vec3(v / 2 == 0 ? side : 0.0f, v / 2 == 1 ? side : 0.0f, v / 2 == 2 ? side : 0.0f);
        float ahead = vec3_dot(out, drop->drawn) >= 0.0f ? 1.0f : -1.0f;
        Vec3 at = vec3_madd(drop->at, drop->radius, out);
        mesh->position[number * DROP_VERTICES + v] = vec3_madd(at, ahead, drop->drawn);
        mesh->normal[number * DROP_VERTICES + v] = out;
    }
    for (int f = 0; f < DROP_FACES; f++) {
        for (int k = 0; k < 3; k++) {
            mesh->index[(number * DROP_FACES + f) * 3 + k] =
                (uint32_t)(number * DROP_VERTICES) + corner[f][k];
        }
    }
}

static bool find_drops(Drops *d, Vec2 center, Error *e)
{
    int most = (int)(REACH / CELL);
    int64_t column = (int64_t)floorf(center.x / CELL), row = (int64_t)floorf(center.y / CELL);
    bool done = true;
    for (int j = -most; done && j <= most; j++) {
        for (int i = -most; done && i <= most; i++) {
            uint64_t key =
                random_key(random_key(d->key, (uint64_t)(column + i)), (uint64_t)(row + j));
            done = i * i + j * j > most * most ||
                   add_cell(d, CELL * (float)(column + i), CELL * (float)(row + j), key, e);
        }
    }
    return done;
}

Mesh *sea_drops(const SeaParams *params, const Waves *waves, Vec2 center, uint64_t seed, bool *none,
                Error *e)
{
    WaveSpectrum spectrum = sea_spectrum(params);
    float celerity = (float)(spectrum.peak / wave_number(spectrum.peak, spectrum.depth));
    Drops d = {.params = params,
               .waves = waves,
               .gust = fmaxf(0.75f * params->wind - celerity, 0.0f),
               .key = random_key(seed, STREAM_DROPS)};
    bool done = params->drops <= 0.0f || find_drops(&d, center, e);
    *none = done && d.count == 0;
    Mesh *mesh = NULL;
    if (done && d.count > 0) {
        mesh = mesh_new(3, d.count * DROP_VERTICES, d.count * DROP_FACES, MESH_NORMAL, e);
    }
    for (int64_t i = 0; mesh && i < d.count; i++) {
        set_drop(mesh, i, &d.drop[i]);
    }
    free(d.drop);
    return mesh;
}
