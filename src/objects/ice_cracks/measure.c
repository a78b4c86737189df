// Measures of cracks in ice.
#include "base/exact_math.h"
#include "objects/ice_cracks/crack_field.h"
#include "objects/ice_cracks/ice_cracks.h"

#include <math.h>

static Vec3 step_to(const OutTree *tree, int64_t i)
{
    return vec3_sub(tree->position[i], tree->position[tree->parent[i]]);
}

static bool fill_field(CrackField *field, const OutTree *tree, double *length, Error *e)
{
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            *length += (double)vec3_length(step_to(tree, i));
            if (!crack_field_add(field, tree->position[parent], tree->position[i], tree->colony[i],
                                 e)) {
                return false;
            }
        }
    }
    return true;
}

// Mean angle in degrees between the last step of arms that touch another crack and that crack; NaN
// if none does.
static double mean_junction(const CrackField *field, const OutTree *tree, float touch)
{
    double sum = 0.0;
    int64_t count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        bool ends = tree->parent[i] >= 0 && (i + 1 == tree->count || tree->parent[i + 1] != i);
        CrackContact contact;
        if (ends && crack_field_nearest(field, tree->position[i], tree->colony[i], &contact) &&
            contact.distance < touch) {
            Vec3 way = vec3_normalize(step_to(tree, i));
            float across = fabsf(vec3_dot(way, contact.along));
            sum += (double)(exact_acos(across) / RADIANS_PER_DEGREE);
            count++;
        }
    }
    return count > 0 ? sum / (double)count : NAN;
}

bool ice_cracks_measure(const void *given, const Grown *grown, const Recipe *recipe,
                        MeasureList *list, Error *e)
{
    (void)recipe;
    const IceCracksParams *params = given;
    const OutTree *tree = grown->tree;
    int32_t cracks = tree->count > 0 ? tree->colony[tree->count - 1] + 1 : 0;
    double length = 0.0, size = (double)params->size;
    CrackField field;
    if (!crack_field_new(&field, params->size, 0.5f * params->spacing, e)) {
        return false;
    }
    bool done =
        fill_field(&field, tree, &length, e) &&
        measures_add(list, "cracks", (double)cracks, "", NAN, NAN, e) &&
        measures_add(list, "crack_spacing", 1.5707963 * size * size / length, "m", NAN, NAN, e) &&
        measures_add(list, "junction_angle",
                     mean_junction(&field, tree, 0.01f * ice_cracks_step(params)), "degrees", NAN,
                     NAN, e);
    crack_field_clear(&field);
    return done;
}
