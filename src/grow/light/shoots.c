#include "grow/light/shoots.h"

#include "base/exact_math.h"
#include "base/random.h"
#include "base/turn.h"
#include "grow/light/attractors.h"
#include "grow/light/share.h"

#define LEAST_TERMINAL 0.5f // metamers: less growth makes no shoot
#define LEAST_SIDE 1.0f
#define LONGEST 1.3f // internodes, of a metamer
// Of the branch's angle: a side bud that leads on after the end bud's loss soon stands more
// upright.
#define RELAY_ANGLE 0.8f

// Of a metamer's id, the bud's number and the site's seed; NOISE .. + 2.
enum { STREAM_ANGLE = 1, STREAM_NOISE = 2, STREAM_LOSS = 5, STREAM_VIGOR = 6, STREAM_BETWEEN = 7 };

typedef struct Shooting {
    Plant *plant;
    const LightParams *params;
    const LightSite *site;
    const SeasonLight *light;
    int season;
    float low; // internodes: branches do not sink below
} Shooting;

static float of_order(Vec3 v, int order)
{
    return order <= 0 ? v.x : (order == 1 ? v.y : v.z);
}

static Vec3 across(Vec3 v, Vec3 direction)
{
    Vec3 flat = vec3_madd(v, -vec3_dot(v, direction), direction);
    return vec3_dot(flat, flat) > 1e-6f ? vec3_normalize(flat) : vec3_perpendicular(direction);
}

// Direction from a metamer to its side bud: evenly about the axis; on plagiotropic branches in the
// level plane.
static Vec3 bud_side(const Shooting *s, const Metamer *m, int bud, int buds)
{
    Vec3 side = vec3_turn(m->side, m->direction, 360.0f * (float)bud / (float)buds);
    float flat = m->order > 0 ? s->params->plagiotropy : 0.0f;
    Vec3 level = vec3_cross(vec3(0, 1, 0), m->direction);
    if (flat <= 0.0f || vec3_dot(level, level) < 1e-4f) {
        return side;
    }
    level = vec3_normalize(level);
    level = vec3_dot(level, side) < 0.0f ? vec3_neg(level) : level;
    return across(vec3_lerp(side, level, flat), m->direction);
}

static int bud_count(const LightParams *params, int order)
{
    if (params->whorl <= 0) {
        return params->buds;
    }
    int most = order == 0 ? params->whorl : (params->plagiotropy > 0.5f ? 2 : 3);
    return params->whorl < most ? params->whorl : most;
}

// The direction of a side bud; share: of the angle to the axis.
static Vec3 side_direction(const Shooting *s, const Metamer *base, int bud, float share,
                           uint64_t key)
{
    const LightParams *p = s->params;
    Vec3 side = bud_side(s, base, bud, bud_count(p, base->order));
    float angle = of_order(p->branch_angle, base->order) +
                  p->angle_spread * random_normal(random_key(key, STREAM_ANGLE));
    float sine, cosine;
    exact_sincos(share * clampf(angle, 0.0f, 150.0f) * RADIANS_PER_DEGREE, &sine, &cosine);
    return vec3_madd(vec3_scale(base->direction, cosine), sine, side);
}

// The direction in which a shoot starts.
static Vec3 first_direction(const Shooting *s, const Metamer *base, int bud)
{
    const LightParams *p = s->params;
    uint64_t key = random_key(random_key(s->site->seed, base->id), (uint64_t)bud + 1u);
    Vec3 d = base->direction;
    float loss = of_order(p->leader_loss, base->order);
    if (bud >= 0) {
        d = side_direction(s, base, bud, 1.0f, key);
    } else if (base->parent >= 0 && base->season > 0 && loss > 0.0f &&
               random_unit(random_key(key, STREAM_LOSS)) < loss) {
        d = side_direction(s, base, 0, RELAY_ANGLE, key);
    } else if (base->parent >= 0 && base->season > 0) {
        float degrees = base->order == 0 ? 0.5f * p->zigzag : p->zigzag;
        d = vec3_turn(d, vec3_cross(d, base->side), degrees);
    }
    Vec3 noise = vec3(random_normal(random_key(key, STREAM_NOISE)),
                      random_normal(random_key(key, STREAM_NOISE + 1)),
                      random_normal(random_key(key, STREAM_NOISE + 2)));
    float level = base->order + (bud >= 0) > 0 ? 1.0f - p->plagiotropy : 1.0f;
    noise.y *= level;
    return vec3_normalize(
        vec3_madd(d, base->order == 0 && bud < 0 ? 0.5f * p->noise : p->noise, noise));
}

// The direction of the next metamer after one of direction d at `at`, on a shoot from metamer
// `base`.
static Vec3 turned(const Shooting *s, int64_t base, Vec3 at, Vec3 d, int order)
{
    const LightParams *p = s->params;
    Vec3 light = vec3_normalize(season_light_brightest(s->light, at));
    light.y *= order > 0 ? 1.0f - p->plagiotropy : 1.0f;
    Vec3 turn =
        vec3_madd(vec3_scale(light, p->phototropism), of_order(p->tropism, order), s->site->up);
    if (s->site->field) {
        Vec3 here = vec3_madd(s->site->foot, s->site->internode, at);
        turn = vec3_madd(turn, s->site->field_weight,
                         guide_field_at(s->site->field, here, vec3(0, 1, 0)));
    }
    if (s->light->attractors) {
        turn = vec3_add(turn, attractors_pull(s->light->attractors, base, at));
    }
    return vec3_normalize(vec3_add(d, turn));
}

// Moves the end of a step out of taken space; false if there is no room.
static bool find_room(const Shooting *s, Vec3 from, Vec3 *to, int order)
{
    const LightSite *site = s->site;
    float low = order > 0 ? s->low : 0.0f; // canes that bow over root where they meet the ground
    if (to->y < low && to->y < from.y) {
        return false;
    }
    if (!site->room && !site->envelope) {
        return true;
    }
    Vec3 start = vec3_madd(site->foot, site->internode, from);
    Vec3 end = vec3_madd(site->foot, site->internode, *to);
    if (site->room) {
        if (!room_give_way(site->room, start, vec3(0, 0, 0), &end)) {
            return false;
        }
        *to = vec3_scale(vec3_sub(end, site->foot), 1.0f / site->internode);
    }
    return !site->envelope || envelope_contains(site->envelope, end) ||
           (order == 0 && !envelope_contains(site->envelope, start)); // the bole leads into it
}

// Gives the side branch that begins at a metamer a vigor of its own.
static void set_vigor(const Shooting *s, Metamer *m)
{
    float spread = s->params->unevenness;
    if (spread > 0.0f) {
        uint64_t key = random_key(random_key(s->site->seed, m->id), STREAM_VIGOR);
        m->vigor = (float)exact_exp((double)(spread * random_normal(key)));
    }
}

static void finish_metamer(const Shooting *s, Metamer *m, int place, bool last)
{
    const LightParams *p = s->params;
    uint64_t key = random_key(random_key(s->site->seed, m->id), STREAM_BETWEEN);
    bool lone = p->between > 0.0f && random_unit(key) < p->between;
    m->season = s->season + 1;
    m->birth = 1 + s->season * (int)vec3_largest(p->shoot) + place;
    m->terminal = last;
    m->buds = p->whorl <= 0 || last ? (1u << (unsigned)bud_count(p, m->order)) - 1u : lone;
    m->side = across(vec3_turn(m->side, m->direction, p->phyllotaxis), m->direction);
}

// Makes one shoot of bud number `bud` (-1 = terminal) of a metamer.
static bool make_shoot(const Shooting *s, int32_t base, int bud, float growth, Error *e)
{
    int order = s->plant->metamer[base].order + (bud >= 0);
    float most = of_order(s->params->shoot, order);
    int metamers = (int)(growth < most ? growth : most);
    metamers = metamers > 0 ? metamers : 1;
    float length = growth / (float)metamers;
    length = length < LONGEST ? length : LONGEST;
    Vec3 at = s->plant->metamer[base].position;
    Vec3 d = first_direction(s, &s->plant->metamer[base], bud);
    int64_t made = base;
    for (int i = 0; i < metamers; i++) {
        d = turned(s, base, at, d, order);
        Vec3 to = vec3_madd(at, length, d);
        if (!find_room(s, at, &to, order)) {
            break;
        }
        d = vec3_normalize(vec3_sub(to, at));
        made = plant_add(s->plant, (int32_t)made, i == 0 ? bud : -1, to, d, e);
        if (made < 0) {
            return false;
        }
        finish_metamer(s, &s->plant->metamer[made], i, i == metamers - 1);
        if (i == 0 && bud >= 0) {
            set_vigor(s, &s->plant->metamer[made]);
        }
        at = to;
    }
    if (made != base) {
        s->plant->metamer[made].terminal = true; // also of a shoot cut short
    }
    return true;
}

bool plant_make_shoots(Plant *plant, const LightParams *params, const LightSite *site,
                       const SeasonLight *light, int season, float control, float low, Error *e)
{
    Shooting s = {plant, params, site, light, season, low};
    int64_t old = plant->living_count;
    for (int64_t k = 0; k < old; k++) {
        int32_t i = plant->living[k];
        const Metamer *m = &plant->metamer[i];
        if (!m->terminal && !m->buds) {
            continue;
        }
        float each_bud, ahead = metamer_bud_growth(plant, m, control, &each_bud);
        uint32_t buds = each_bud >= LEAST_SIDE ? m->buds : 0u;
        if (ahead >= LEAST_TERMINAL && !make_shoot(&s, i, -1, ahead, e)) {
            return false;
        }
        for (int bud = 0; buds >> bud; bud++) {
            if (buds >> bud & 1u && !make_shoot(&s, i, bud, each_bud, e)) {
                return false;
            }
        }
    }
    return true;
}
