#include "objects/coral/polyp_forms.h"

#include "base/exact_math.h"
#include "base/random.h"
#include "objects/coral/cup.h"

enum { STREAM_LEAN = 2, STREAM_SIZE = 3, STREAM_HEIGHT = 4 }; // of a cup
enum { STREAM_NOSE = 5, STREAM_OUT = 6, STREAM_TURN = 7 };    // of a cup that is a nose
enum { STREAM_FORM_LEAN = 0, STREAM_FORM_LIP = 1 };           // of a form

enum { AGES = 5 };
enum { NOSES = 8 }; // different noses of an age

#define NOSE_TURN 22.0f      // degrees by which noses point beside the tip, at most
#define TENTACLE_REACH 0.75f // in diameters

int polyp_form_count(const PolypPlaces *places)
{
    return places->shape == POLYP_TUBE ? AGES : (2 * AGES + 1) * NOSES;
}

int polyp_form(const PolypPlace *place, const PolypPlaces *places, uint64_t key)
{
    int age = (int)(place->youth * ((float)AGES - 0.01f));
    if (places->shape == POLYP_TUBE) {
        return age;
    }
    int variant = (int)(random_unit(random_key(key, STREAM_NOSE)) * (float)NOSES);
    bool out = random_unit(random_key(key, STREAM_OUT)) < places->tentacles;
    int group = place->axial ? 2 * AGES : (out ? AGES : 0) + age;
    return group * NOSES + (variant < NOSES ? variant : NOSES - 1);
}

Mesh *polyp_form_mesh(int form, const PolypPlaces *places, Error *e)
{
    float height = places->height / places->diameter;
    if (places->shape == POLYP_TUBE) {
        return polyp_cup(height, ((float)form + 0.5f) / AGES, e);
    }
    int group = form / NOSES;
    uint64_t key = random_key(random_key(places->seed, STREAM_NOSE), (uint64_t)form);
    bool axial = group == 2 * AGES;
    float youth = axial ? 0.9f : ((float)(group % AGES) + 0.5f) / AGES;
    NoseCup nose = {.height = height * (axial ? 1.4f : lerpf(1.0f, 0.8f, youth)),
                    .flare = axial ? 0.15f : 1.0f,
                    .girth = axial ? 0.0f : places->girth / places->diameter,
                    .reach = group >= AGES && !axial ? TENTACLE_REACH : 0.0f,
                    .youth = youth,
                    .seed = key};
    if (!axial) {
        nose.lean = places->lean * random_range(random_key(key, STREAM_FORM_LEAN), 0.6f, 1.25f);
        nose.oblique = random_range(random_key(key, STREAM_FORM_LIP), 0.12f, 0.42f);
    }
    return polyp_nose(&nose, e);
}

Transform polyp_frame(const PolypPlace *place, const PolypPlaces *places, uint64_t key)
{
    bool tube = places->shape == POLYP_TUBE;
    float s, c;
    float lean = places->lean * (1.0f - 0.7f * place->youth) *
                 random_range(random_key(key, STREAM_LEAN), 0.8f, 1.15f);
    exact_sincos(tube ? lean * RADIANS_PER_DEGREE : 0.0f, &s, &c); // noses are bent by themselves
    Vec3 along = vec3_madd(place->along, -vec3_dot(place->along, place->normal), place->normal);
    bool known = vec3_dot(along, along) > 1e-6f;
    along = known ? vec3_normalize(along) : vec3_perpendicular(place->normal);
    if (!tube) {
        float turn = random_range(random_key(key, STREAM_TURN), -NOSE_TURN, NOSE_TURN), ts, tc;
        exact_sincos(turn * RADIANS_PER_DEGREE, &ts, &tc);
        along = vec3_madd(vec3_scale(along, tc), ts, vec3_cross(place->normal, along));
    }
    Vec3 y = known ? vec3_madd(vec3_scale(place->normal, c), s, along) : place->normal;
    Vec3 x = vec3_normalize(vec3_cross(along, place->normal)), z = vec3_cross(x, y);
    float size =
        place->size * places->diameter * random_range(random_key(key, STREAM_SIZE), 0.75f, 1.15f);
    if (!tube && !place->axial) { // cups bud below the tip and grow on
        size *= lerpf(1.0f, 0.62f, place->youth * place->youth);
    }
    float tall = size * random_range(random_key(key, STREAM_HEIGHT), 0.6f, 1.25f);
    return transform_from_axes(vec3_scale(x, size), vec3_scale(y, tall), vec3_scale(z, size),
                               place->position);
}
