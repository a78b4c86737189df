#include "objects/venation/venation.h"

#include "base/random.h"
#include "grow/venation/veinlets.h"
#include "objects/venation/blade.h"
#include "objects/venation/margin_hairs.h"
#include "objects/venation/vein_curves.h"
#include "objects/venation/vein_hairs.h"
#include "outtree/join.h"
#include "outtree/radii.h"

#include <math.h>
#include <stddef.h>

enum { STREAM_VEINS = 1, STREAM_PETIOLE = 7 }; // of the object's seed

enum { PETIOLE_PIECES = 12, AREA_ROWS = 1000 };

#define EXPONENT 3.0f // Murray's
#define STUB 1.2f     // births: free ends that are shorter are cleared away

VenationParams venation_params_default(void)
{
    return (VenationParams){.outline = {.length = 0.1f, .widest = 0.42f, .tip = 1.4f},
                            .closed = true,
                            .detail = 100,
                            .petiole = 0.02f,
                            .curl = 12.0f,
                            .fold = 6.0f,
                            .blade = true};
}

VenationParams venation_params_resolve(const VenationParams *given)
{
    VenationParams params = *given;
    float length = params.outline.length, mesh = length / (float)params.detail;
    params.outline.width = params.outline.width > 0.0f ? params.outline.width : 0.5f * length;
    params.midrib = params.midrib > 0.0f ? params.midrib : 0.008f * length;
    params.vein = params.vein > 0.0f ? params.vein : 0.06f * mesh;
    params.embedded = fminf(params.embedded, 0.95f * params.midrib); // the stalk stands out
    if (!params.blade) {
        params.wear = params.spots = params.autumn = 0.0f;
        params.hairs = params.vein_hairs = 0.0f;
    }
    return params;
}

// The id of the root of the leaf with this seed. What is uneven about its blade follows from it.
static uint64_t root_id(const VenationParams *params, uint64_t seed)
{
    return params->petiole > 0.0f ? random_key(seed, STREAM_PETIOLE)
                                  : veins_root_id(random_key(seed, STREAM_VEINS));
}

VenationParams venation_params_of(const VenationParams *given, const OutTree *tree)
{
    VenationParams params = venation_params_resolve(given);
    params.outline.key = tree->count > 0 ? tree->id[0] : 0;
    return params;
}

static VeinParams vein_params(const VenationParams *params, uint64_t seed)
{
    VeinParams veins = vein_params_default();
    veins.outline = params->outline;
    veins.closed = params->closed;
    veins.marginal = params->marginal;
    veins.secondaries = params->secondaries;
    veins.tertiaries = params->tertiaries;
    veins.birth = params->outline.length / (float)params->detail;
    veins.kill = 0.5f * veins.birth;
    veins.step = 0.25f * veins.birth;
    veins.seed = seed;
    return veins;
}

static bool add_petiole(OutTree *tree, const VenationParams *params, uint64_t seed, Error *e)
{
    int64_t node = -1;
    for (int i = 0; i < PETIOLE_PIECES; i++) {
        float y = params->petiole * ((float)i / PETIOLE_PIECES - 1.0f);
        uint64_t id =
            node < 0 ? random_key(seed, STREAM_PETIOLE) : out_tree_child_id(tree->id[node], 0);
        node = out_tree_add_node(tree, vec3(0, y, 0), node, 0, 0, id, e);
        if (node < 0) {
            return false;
        }
        tree->normal[node] = vec3(0, 0, 1);
    }
    return true;
}

// The petiole followed by the veins, with shifted indices.
static OutTree *with_petiole(const OutTree *veins, const VenationParams *params, uint64_t seed,
                             Error *e)
{
    OutTree *tree = out_tree_new(e);
    bool done = tree && (params->petiole <= 0.0f || add_petiole(tree, params, seed, e));
    int32_t first = done ? (int32_t)tree->count : 0;
    for (int64_t i = 0; done && i < veins->count; i++) {
        int32_t parent = veins->parent[i] < 0 ? first - 1 : veins->parent[i] + first;
        int64_t node = out_tree_add_node(tree, veins->position[i], parent, veins->birth[i], 0,
                                         veins->id[i], e);
        done = node >= 0;
        if (done) {
            tree->normal[node] = veins->normal[i];
        }
    }
    if (!done) {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}

bool venation_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    VenationParams params = venation_params_resolve(given);
    params.outline.key = root_id(&params, recipe->seed);
    VeinParams grow = vein_params(&params, random_key(recipe->seed, STREAM_VEINS));
    OutTree *veins = veins_grow(&grow, NULL, NULL, recipe->run, e);
    if (veins && params.closed && params.veinlets > 0.0f &&
        !(veins_trim(veins, STUB * grow.birth, e) &&
          veins_add_veinlets(veins, &grow, params.veinlets, recipe->run, e))) {
        out_tree_free(veins);
        return false;
    }
    whole->tree = veins ? with_petiole(veins, &params, recipe->seed, e) : NULL;
    out_tree_free(veins);
    return whole->tree;
}

bool venation_finish(const void *given, const Recipe *recipe, const Grown *whole, Grown *grown,
                     Error *e)
{
    (void)recipe, (void)whole, (void)e;
    VenationParams params = venation_params_resolve(given);
    out_tree_pipe_radii(grown->tree, EXPONENT, params.vein, params.midrib);
    return true;
}

// ---- geometry ----

bool venation_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    VenationParams params = venation_params_of(given, grown->tree);
    Transform place = transform_compose(params.position, params.rotation, vec3_splat(1.0f));
    Relief relief;
    if (!relief_init(&relief, &params, grown->tree, e)) {
        return false;
    }
    Part veins = {.curves = venation_curves(grown->tree, &params, &relief, &place, e)};
    bool done = placing_add(placing, veins, VENATION_VEINS, e);
    if (done && params.blade) {
        Part blade = {.mesh = venation_blade(&params, &relief, &place, e)};
        done = placing_add(placing, blade, VENATION_BLADE, e);
    }
    if (done && params.hairs > 0.0f) {
        Part hairs = {.curves = margin_hairs(&params, &relief, &place, e)};
        done = placing_add(placing, hairs, VENATION_VEINS, e);
    }
    if (done && params.vein_hairs > 0.0f) {
        Part hairs = {.curves = vein_hairs(grown->tree, &params, &relief, &place, e)};
        done = placing_add(placing, hairs, VENATION_VEINS, e);
    }
    relief_clear(&relief);
    return done;
}

// ---- measures ----

// Area of the flat leaf, m^2.
static double blade_area(const LeafOutline *outline)
{
    double row = (double)outline->length / AREA_ROWS, sum = 0.0;
    for (int i = 0; i < AREA_ROWS; i++) {
        float y = ((float)i + 0.5f) * (float)row;
        sum += row * (double)(leaf_margin(outline, -1.0f, y) + leaf_margin(outline, 1.0f, y));
    }
    return sum;
}

bool venation_measure(const void *given, const Grown *grown, const Recipe *recipe,
                      MeasureList *list, Error *e)
{
    (void)recipe;
    const OutTree *tree = grown->tree;
    VenationParams params = venation_params_of(given, tree);
    int64_t pieces, loops;
    double length = 0.0, area = 1e6 * blade_area(&params.outline), none = (double)NAN;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0 && tree->position[i].y > 0.0f) { // beyond the petiole
            length += (double)vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
        }
    }
    return out_tree_count_pieces(tree, &pieces, &loops, e) &&
           measures_add(list, "areoles", (double)loops, "", none, none, e) &&
           measures_add(list, "areole_area", loops > 0 ? area / (double)loops : none, "mm^2", none,
                        none, e) &&
           measures_add(list, "vein_density", 1000.0 * length / area, "mm/mm^2", none, none, e);
}
