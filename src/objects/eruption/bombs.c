// Bombs: thrown up, slowed by the air, drawn as long as the shutter is open, and rolling on where
// they land on a steep flank.
#include "base/exact_math.h"
#include "base/random.h"
#include "objects/eruption/eruption.h"

static const float GRAVITY = 9.81f;
static const float DRAG = 0.0012f; // 1/m: of blocks of about half a metre
static const float COOLING = 9.0f; // K/s: of their surface
static const float COLD = 1080.0f; // K: glows too little for a picture

typedef struct Bomb {
    Vec3 position, velocity;
    float radius, kelvin, time;
} Bomb;

static Bomb throw_bomb(const EruptionParams *p, const HeightField *land, uint64_t key)
{
    float sine, cosine, out_sine, out_cosine;
    exact_sincos(random_range(random_key(key, 0), 0.0f, 2.0f * PI_F), &sine, &cosine);
    float off = 0.5f * p->vent_width * sqrtf(random_unit(random_key(key, 1)));
    float out = p->spread * RADIANS_PER_DEGREE * random_normal(random_key(key, 2));
    exact_sincos(clampf(out, -1.3f, 1.3f), &out_sine, &out_cosine);
    float x = p->vent[0] + off * cosine, z = p->vent[1] + off * sine;
    exact_sincos(random_range(random_key(key, 3), 0.0f, 2.0f * PI_F), &sine, &cosine);
    float u = random_unit(random_key(key, 4)); // few are fast
    float speed = p->speed * (0.2f + 0.8f * u * u);
    float small = random_unit(random_key(key, 5));
    return (Bomb){
        .position = vec3(x, height_field_smooth_at(land, x, z) + 2.0f, z),
        .velocity = vec3_scale(vec3(out_sine * cosine, out_cosine, out_sine * sine), speed),
        .radius = 0.5f * p->size * (0.35f + 0.65f * small * small),
        .kelvin = p->temperature + 273.0f - 90.0f * random_unit(random_key(key, 6)),
    };
}

static void move(Bomb *b, float dt)
{
    float speed = vec3_length(b->velocity);
    Vec3 change = vec3_scale(b->velocity, -DRAG * speed);
    change.y -= GRAVITY;
    b->velocity = vec3_madd(b->velocity, dt, change);
    b->position = vec3_madd(b->position, dt, b->velocity);
    b->kelvin -= COOLING * dt;
    b->time += dt;
}

static TrailPoint seen(const Bomb *b)
{
    const float slow = 70.0f; // m/s at which the picture shows it as bright as what rests
    float shown = slow / (slow + vec3_length(b->velocity));
    return (TrailPoint){b->position, b->radius, b->kelvin, shown};
}

// It leaps and rolls down the flank until that is gentle or the bomb is dark.
static bool roll(Trails *t, Bomb b, const HeightField *land, uint64_t key, Error *e)
{
    enum { MOST = 120 };
    const float step = 4.0f, aside = 5.0f, gentle = 0.35f;
    float reach =
        1.0f + (float)MOST * random_unit(random_key(key, 0)) * random_unit(random_key(key, 1));
    for (int i = 0; (float)i < reach && b.kelvin > COLD; i++) {
        Vec3 p = b.position;
        float dx = height_field_smooth_at(land, p.x - aside, p.z) -
                   height_field_smooth_at(land, p.x + aside, p.z);
        float dz = height_field_smooth_at(land, p.x, p.z - aside) -
                   height_field_smooth_at(land, p.x, p.z + aside);
        float slope = sqrtf(dx * dx + dz * dz) / (2.0f * aside);
        if (slope < gentle) {
            return true;
        }
        float scale = step / (2.0f * aside * slope);
        float wander = 1.5f * random_normal(random_key(key, 2 + (uint64_t)i));
        b.position.x += scale * (dx - 0.3f * wander * dz);
        b.position.z += scale * (dz + 0.3f * wander * dx);
        float leap = random_unit(random_key(key, 500 + (uint64_t)i));
        b.position.y = height_field_smooth_at(land, b.position.x, b.position.z) + b.radius +
                       1.5f * leap * leap;
        b.kelvin -= 4.0f;
        if (!trails_add(t, (TrailPoint){b.position, b.radius, b.kelvin, 0.5f}, e)) {
            return false;
        }
    }
    return true;
}

static bool fly(Trails *t, const EruptionParams *p, const HeightField *land, uint64_t key, Error *e)
{
    const float dt = 0.25f;
    enum { MOST = 400 };
    Bomb b = throw_bomb(p, land, random_key(key, 0));
    float flight = 2.0f * b.velocity.y / GRAVITY;
    float opens = random_range(random_key(key, 1), -p->shutter, flight);
    if (!trails_begin(t, e)) {
        return false;
    }
    for (int i = 0; i < MOST && b.kelvin > COLD && b.time < opens + p->shutter; i++) {
        if (b.time >= opens && !trails_add(t, seen(&b), e)) {
            return false;
        }
        move(&b, dt);
        float ground = height_field_smooth_at(land, b.position.x, b.position.z);
        if (i > 3 && b.position.y < ground) {
            b.position.y = ground + b.radius;
            return trails_add(t, seen(&b), e) && roll(t, b, land, random_key(key, 2), e);
        }
    }
    return true;
}

bool eruption_fly(Trails *t, const EruptionParams *p, const HeightField *land, uint64_t seed,
                  Error *e)
{
    bool done = true;
    for (int i = 0; done && i < p->bombs; i++) {
        done = fly(t, p, land, random_key(seed, (uint64_t)i), e);
    }
    return done;
}
