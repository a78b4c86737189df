// Trails as curves: of three materials by their temperature, since what is cooler glows redder.
#include "base/color.h"
#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/eruption/eruption.h"

#include <math.h>

enum { CLASSES = 3, CRUST_ROLE = CLASSES };
static const float LIMIT[CLASSES - 1] = {120.0f, 260.0f}; // K below the hottest

float eruption_glow(float kelvin, float hottest)
{
    const double c2 = 23980.0; // K: hc / (k 600 nm)
    return (float)exact_exp(c2 * (1.0 / (double)hottest - 1.0 / (double)kelvin));
}

static int class_of(const TrailPoint *a, const TrailPoint *b, float hottest)
{
    float colder = hottest - 0.5f * (a->kelvin + b->kelvin);
    return colder < LIMIT[0] ? 0 : (colder < LIMIT[1] ? 1 : 2);
}

// Whether segment i of the trail that ends before `end` is drawn in this class; CRUST_ROLE: any is.
static bool belongs(const Trails *t, int64_t i, int64_t end, int wanted, float hottest)
{
    return i + 1 < end &&
           (wanted == CRUST_ROLE || class_of(&t->point[i], &t->point[i + 1], hottest) == wanted);
}

// Counts the points and runs of a class; fills them in if curves is given.
static void visit(const Trails *t, int wanted, float hottest, float scale, int64_t count[2],
                  CurveSet *curves)
{
    count[0] = count[1] = 0;
    for (int64_t k = 0; k < t->trail_count; k++) {
        int64_t first = t->first[k], end = t->first[k + 1];
        for (int64_t i = first; i < end; i++) {
            bool before = i > first && belongs(t, i - 1, end, wanted, hottest);
            bool after = belongs(t, i, end, wanted, hottest);
            if (!before && !after) {
                continue;
            }
            if (curves) {
                const TrailPoint *p = &t->point[i];
                int64_t at = count[0];
                curves->position[at] = p->position;
                curves->radius[at] = p->radius;
                curves->birth[at] = (float)(i - first) / (float)(end - first);
                curves->along[at] = 5.0f * (float)(i - first);
                if (curves->glow) {
                    curves->glow[at] = scale * p->shown * eruption_glow(p->kelvin, hottest);
                }
                if (!before) {
                    curves->first[count[1]] = at;
                    curves->id[count[1]] = (uint64_t)i;
                }
            }
            count[0]++;
            count[1] += !before;
        }
    }
    if (curves) {
        curves->first[count[1]] = count[0];
    }
}

static bool add_class(const Placing *placing, const Trails *t, int role, const EruptionParams *p,
                      Error *e)
{
    float hottest = p->temperature + 273.0f, own = 1.0f;
    if (placing->around.material && role != CRUST_ROLE) {
        own = luminance(placing->around.material[placing->material[role]].radiance);
    }
    float scale = p->radiance / fmaxf(own, 1e-9f);
    int64_t count[2];
    visit(t, role, hottest, scale, count, NULL);
    if (count[1] == 0) {
        return true;
    }
    CurveSet *curves = curves_new(count[0], count[1], e);
    if (!curves) {
        return false;
    }
    if (role != CRUST_ROLE) {
        curves->glow = memory_alloc(count[0], sizeof *curves->glow, e);
        if (!curves->glow) {
            curves_free(curves);
            return false;
        }
    }
    visit(t, role, hottest, scale, count, curves);
    return placing_add(placing, (Part){.kind = PART_CURVES, .curves = curves}, role, e);
}

bool eruption_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const EruptionParams *p = given;
    const HeightField *land = placing->recipe->land;
    if (!land) {
        error_set(e, ERROR_INPUT, "'on' names no terrain; an eruption needs one");
        return recipe_fail(placing->recipe, NULL, e);
    }
    uint64_t seed = placing->recipe->seed;
    Trails glowing = {0}, crust = {0};
    bool done = eruption_fly(&glowing, p, land, random_key(seed, 1), e) &&
                eruption_flow(&glowing, &crust, p, land, random_key(seed, 2), e);
    for (int role = 0; done && role < CLASSES; role++) {
        done = add_class(placing, &glowing, role, p, e);
    }
    done = done && add_class(placing, &crust, CRUST_ROLE, p, e);
    trails_clear(&glowing);
    trails_clear(&crust);
    return done;
}
