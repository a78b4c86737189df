// The bolts as emissive round curves.
#include "base/color.h"
#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/lightning/lightning.h"
#include "outtree/chains.h"

// Radiance of the main channel if no power is given, W/(m^2 sr).
#define OWN_RADIANCE 40.0f

static void fill_curve(CurveSet *curves, int64_t curve, const OutTree *tree, const int32_t *node,
                       int64_t count, float core, float taper, float glow, float last_birth)
{
    int64_t first = curves->first[curve];
    curves->first[curve + 1] = first + count;
    float along = 0.0f;
    for (int64_t k = 0; k < count; k++) {
        // a branch has its own radius where it leaves another, not the parent's
        int32_t own = k == 0 && count > 1 && tree->radius[node[0]] > tree->radius[node[1]]
                          ? node[1]
                          : node[k];
        along += k > 0 ? vec3_distance(tree->position[node[k - 1]], tree->position[node[k]]) : 0.0f;
        curves->position[first + k] = tree->position[node[k]];
        curves->radius[first + k] = tree->radius[own];
        float thin = tree->radius[own] / core; // radiance ~ power / radius
        curves->glow[first + k] = glow * exact_pow(thin, 1.0f / taper - 1.0f);
        curves->along[first + k] = along;
        curves->birth[first + k] = (float)tree->birth[node[k]] / last_birth;
    }
}

// Luminance of the material's radiance, W/(m^2 sr); 0 = not known.
static float luminance_of(const Placing *placing)
{
    const Material *materials = placing->around.material;
    return materials ? luminance(materials[placing->material[0]].radiance) : 0.0f;
}

bool lightning_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const LightningParams *params = given;
    const OutTree *tree = grown->tree;
    ChainSet *chains = out_tree_chains(tree, e);
    if (!chains) {
        return false;
    }
    int64_t points = 0, drawn = 0;
    for (int64_t c = 0; c < chains->count; c++) {
        int64_t count = chains->first[c + 1] - chains->first[c];
        points += count > 1 ? count : 0;
        drawn += count > 1;
    }
    CurveSet *curves = drawn > 0 ? curves_new(points, drawn, e) : NULL;
    if (curves) {
        curves->glow = memory_alloc(points, sizeof *curves->glow, e);
    }
    bool done = drawn == 0 || (curves && curves->glow);
    if (done && drawn > 0) {
        // A cylinder of radius r and radiance L emits 2 pi^2 r L per metre.
        float core = lightning_radius(params, tree);
        float radiance =
            params->power > 0.0f ? params->power / (2.0f * PI_F * PI_F * core) : OWN_RADIANCE;
        float own = luminance_of(placing), glow = own > 0.0f ? radiance / own : 1.0f;
        float last_birth = 1.0f;
        for (int64_t i = 0; i < tree->count; i++) {
            float birth = (float)tree->birth[i];
            last_birth = birth > last_birth ? birth : last_birth;
        }
        int64_t curve = 0;
        for (int64_t c = 0; c < chains->count; c++) {
            int64_t count = chains->first[c + 1] - chains->first[c];
            if (count > 1) {
                fill_curve(curves, curve++, tree, chains->node + chains->first[c], count, core,
                           params->taper, glow, last_birth);
            }
        }
    }
    chains_free(chains);
    if (!done) {
        curves_free(curves);
        return false;
    }
    return drawn == 0 || placing_add(placing, (Part){.curves = curves}, 0, e);
}
