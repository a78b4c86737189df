#include "objects/tree/by_light.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "grow/room.h"
#include "objects/tree/hazards.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { STREAM_LIGHT = 5 };         // of the object's seed
enum { STREAM_TRIAL = 1 };         // of what forms a tree
enum { TRIAL_CELLS = 30000 };      // voxels of the grid of a trial
enum { LEAST_TRIAL_SEASONS = 30 }; // for limbs that attractors laid
#define CELLS_AMONG_RIVALS 150000

// Tangent of the splay (1/m) a metre from the stems' middle.
static float splay_per_metre(const TrunkParams *trunk)
{
    float sine, cosine;
    exact_sincos(trunk->splay * RADIANS_PER_DEGREE, &sine, &cosine);
    return sine / (cosine * trunk->stem_circle);
}

// The tree's stems, each leaning.
static OutTree *plant(const TreeParams *params, uint64_t seed, Error *e)
{
    OutTree *start = out_tree_new(e);
    if (!start || !tree_plant_stems(start, params, seed, e)) {
        out_tree_free(start);
        return NULL;
    }
    const TrunkParams *trunk = &params->trunk;
    float sine, cosine, lean_sine, lean_cosine;
    exact_sincos(trunk->lean_azimuth * RADIANS_PER_DEGREE, &sine, &cosine);
    exact_sincos(trunk->lean * RADIANS_PER_DEGREE, &lean_sine, &lean_cosine);
    Vec3 up = vec3(lean_sine * sine, lean_cosine, lean_sine * cosine);
    float spread = trunk->stems > 1 ? splay_per_metre(trunk) : 0.0f;
    for (int64_t i = 0; i < start->count; i++) {
        if (start->parent[i] < 0) { // below the foot, which follows it
            Vec3 foot = start->position[i + 1];
            Vec3 along = vec3_madd(up, spread, vec3_sub(foot, params->position));
            along = spread > 0.0f ? vec3_normalize(along) : up;
            start->position[i] = vec3_madd(foot, -trunk->radius, along);
        }
    }
    return start;
}

static LightSite plan_site(const TreePlan *plan, uint64_t seed)
{
    const TreeParams *tree = &plan->params;
    const ColonizeParams *growth = &tree->crown.element.growth;
    return (LightSite){.foot = tree->position,
                       .internode = 1.0f,
                       .seasons = plan->seasons,
                       .up = growth->tropism,
                       .field_weight = growth->field_weight,
                       .metamers = growth->max_nodes,
                       .tip = tree->radii.tip,
                       .girth = tree->trunk.radius,
                       .exponent = tree->radii.exponent,
                       .healing = tree->light.healing,
                       .colony = {TREE_TRUNK, TREE_CROWN, TREE_SNAGS, TREE_KNOTS},
                       .seed = random_key(seed, STREAM_LIGHT)};
}

static LightParams plan_growth(const TreePlan *plan)
{
    LightParams growth = plan->params.light.growth;
    growth.bole = plan->bole > 0.0f ? plan->bole / plan->params.height : growth.bole;
    return growth;
}

// All lengths follow from the height that free growth reaches.
static bool check_height(float height, Error *e)
{
    return height > 0.0f ||
           (error_set(e, ERROR_INPUT,
                      "without hindrance it grows no higher than its foot, so it has no size; "
                      "increase light.vigor, or let light.tropism point upward"),
            error_key(e, "light"));
}

static float top_of(const OutTree *tree)
{
    return out_tree_bounds(tree).high.y;
}

// A tree that grows freely is the same in every size.
static void scale_about(OutTree *tree, Vec3 foot, float factor)
{
    for (int64_t i = 0; i < tree->count; i++) {
        tree->position[i] = vec3_madd(foot, factor, vec3_sub(tree->position[i], foot));
    }
}

static OutTree *grow_free(const TreePlan *plan, LightSite *site, const Recipe *recipe, Error *e)
{
    const TreeParams *params = &plan->params;
    LightParams growth = plan_growth(plan);
    OutTree *start = plant(params, site->seed, e);
    if (start) { // in internodes
        scale_about(start, params->position, (float)plan->seasons / params->height);
    }
    OutTree *tree = start ? light_grow(start, &growth, site, recipe->run, e) : NULL;
    out_tree_free(start);
    return tree;
}

// Reach of a tree that grows freely, internodes from the foot.
static bool try_free(const TreePlan *plan, const LightSite *site, const Recipe *recipe, Aabb *reach,
                     Error *e)
{
    LightSite trial = *site;
    trial.cells = TRIAL_CELLS;
    OutTree *tree = grow_free(plan, &trial, recipe, e);
    if (!tree) {
        return false;
    }
    *reach = out_tree_bounds(tree);
    reach->low = vec3_sub(reach->low, site->foot);
    reach->high = vec3_sub(reach->high, site->foot);
    out_tree_free(tree);
    return true;
}

static uint64_t key_of_words(uint64_t key, const void *words, size_t size)
{
    for (size_t i = 0; i + 4 <= size; i += 4) {
        uint32_t word;
        memcpy(&word, (const char *)words + i, sizeof word);
        key = random_key(key, word);
    }
    return key;
}

// Rivals of one habit share a trial: its key and, with it, its seed are of all that forms it.
static uint64_t trial_key(const TreePlan *plan, const LightSite *site)
{
    const TrunkParams *trunk = &plan->params.trunk;
    float height = plan->params.height;
    LightParams growth = plan_growth(plan);
    const float more[] = {(float)site->seasons,
                          site->up.x,
                          site->up.y,
                          site->up.z,
                          trunk->lean,
                          trunk->lean_azimuth,
                          (float)trunk->stems,
                          trunk->radius / height,
                          trunk->stem_circle / height,
                          trunk->stem_scatter};
    uint64_t key = key_of_words(STREAM_TRIAL, &growth, offsetof(LightParams, upkeep));
    key = key_of_words(key, more, sizeof more);
    key = trunk->splay > 0.0f ? key_of_words(key, &trunk->splay, sizeof trunk->splay) : key;
    return growth.upkeep > 0.0f ? key_of_words(key, &growth.upkeep, sizeof growth.upkeep) : key;
}

// trials: of all rivals; NULL = it has a trial of its own.
static bool find_reach(const TreePlan *plan, LightSite trial, RoomTrials *trials,
                       const Recipe *recipe, Aabb *reach, Error *e)
{
    if (!trials) {
        return try_free(plan, &trial, recipe, reach, e);
    }
    uint64_t key = trial_key(plan, &trial);
    const Aabb *found = room_find_trial(trials, key);
    if (found) {
        *reach = *found;
        return true;
    }
    trial.seed = key;
    return try_free(plan, &trial, recipe, reach, e) && room_keep_trial(trials, key, *reach, e);
}

// Sets the internode to that of a tree which grows freely to the plan's height.
static bool find_internode(const TreePlan *plan, LightSite *site, const Recipe *recipe, Error *e)
{
    LightSite trial = *site;
    if (plan->grown_by == GROWN_BY_BOTH && trial.seasons < LEAST_TRIAL_SEASONS) {
        trial.seasons = LEAST_TRIAL_SEASONS;
    }
    RoomTrials *trials = recipe->room ? recipe->room->trials : NULL;
    if (!find_reach(plan, trial, trials, recipe, &site->reach, e) ||
        !check_height(site->reach.high.y, e)) {
        return false;
    }
    site->internode = plan->params.height / site->reach.high.y;
    return true;
}

// Scatters the attractors that buds reach for; *points is NULL if there are none. crown: the
// crown's envelope; NULL if it is not made.
static bool scatter_attractors(const TreePlan *plan, const LightSite *site, const Envelope *crown,
                               const Recipe *recipe, PointSet **points, Error *e)
{
    const ReachParams *reach = &plan->params.light.attractors;
    *points = NULL;
    if (reach->count == 0) {
        return true;
    }
    const Run *run = recipe->run;
    Envelope *own =
        reach->element.shape_count > 0 ? element_envelope(&reach->element, run, e) : NULL;
    const Envelope *envelope = reach->element.shape_count > 0 ? own : crown;
    ScatterParams scatter = reach->element.points;
    scatter.count = reach->count;
    scatter.scale = 1.0f;
    scatter.anchor = site->foot;
    scatter.seed = random_key(site->seed, STREAM_ELEMENT_POINTS);
    Density *density = NULL;
    if (envelope && element_density(&reach->element, &scatter, &density, run, e) &&
        (!own || growth_observe(recipe, "attractors", own, NULL, e))) {
        *points = points_scatter(envelope, &scatter, run, e);
    }
    density_free(density);
    envelope_free(own);
    return *points || error_key(e, "light.attractors");
}

// What forms the growth.
typedef struct Form {
    Envelope *envelope; // of the crown; NULL = not needed
    GuideField *field;  // NULL = none
    PointSet *points;   // NULL = none
    LightAttractors attractors;
} Form;

static void form_clear(Form *form)
{
    guide_field_free(form->field);
    envelope_free(form->envelope);
    points_free(form->points);
}

static bool form_init(Form *form, const TreePlan *plan, const OutTree *start, const LightSite *site,
                      const Recipe *recipe, Error *e)
{
    const ElementParams *crown = &plan->params.crown.element;
    const ReachParams *reach = &plan->params.light.attractors;
    *form = (Form){0};
    bool inside = reach->count > 0 && reach->element.shape_count == 0;
    bool shaped = plan->bounded || crown->field_count > 0 || inside;
    bool good = !shaped || (form->envelope = element_envelope(crown, recipe->run, e));
    good = good &&
           element_guide_field(start, start->count, crown, form->envelope,
                               random_key(site->seed, STREAM_ELEMENT_FIELD), recipe->run,
                               &form->field, e) &&
           (!shaped || growth_observe(recipe, "crown", form->envelope, form->field, e));
    good = (good || error_key(e, "crown")) &&
           scatter_attractors(plan, site, form->envelope, recipe, &form->points, e);
    if (good && form->points) {
        form->attractors = (LightAttractors){.position = form->points->position,
                                             .count = form->points->count,
                                             .weight = reach->weight,
                                             .pull = reach->pull,
                                             .reach = reach->reach,
                                             .occupied = reach->occupied};
    }
    if (!good) {
        form_clear(form);
    }
    return good;
}

// Grows from a start in the form and the room that the tree has.
static OutTree *grow_bounded(const TreePlan *plan, const OutTree *start, LightSite *site,
                             const Recipe *recipe, Error *e)
{
    LightParams growth = plan_growth(plan);
    Form form;
    if (!form_init(&form, plan, start, site, recipe, e)) {
        return NULL;
    }
    site->envelope = plan->bounded ? form.envelope : NULL;
    site->field = form.field;
    site->attractors = form.points ? &form.attractors : NULL;
    site->room = recipe->room;
    site->cells = recipe->room && recipe->room->meet ? (int64_t)CELLS_AMONG_RIVALS : 0;
    OutTree *tree = light_grow(start, &growth, site, recipe->run, e);
    form_clear(&form);
    return tree;
}

// Growth in internodes does not keep the distances between stems: moves each to its foot.
static bool place_stems(OutTree *tree, const TreeParams *params, uint64_t seed, Error *e)
{
    if (params->trunk.stems <= 1) {
        return true;
    }
    int64_t stem = 0;
    Vec3 *shift = memory_alloc(tree->count, sizeof *shift, e);
    for (int64_t i = 0; shift && i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            shift[i] = shift[tree->parent[i]];
        } else {
            Vec3 foot = tree_stem_foot(params, (int)stem++, seed); // that of the node above
            shift[i] = vec3_sub(foot, tree->position[i + 1]);
        }
        tree->position[i] = vec3_add(tree->position[i], shift[i]);
    }
    free(shift);
    return shift;
}

// Grows freely, then scales to the height.
static OutTree *grow_to_height(const TreePlan *plan, LightSite *site, const Recipe *recipe,
                               Error *e)
{
    const TreeParams *params = &plan->params;
    OutTree *tree = grow_free(plan, site, recipe, e);
    if (!tree) {
        return NULL;
    }
    float height = top_of(tree) - params->position.y;
    bool done = check_height(height, e);
    if (done) {
        scale_about(tree, params->position, params->height / height);
        done = place_stems(tree, params, site->seed, e);
    }
    if (!done) {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}

bool tree_grow_by_light(OutTree **tree, const TreePlan *plan, const Recipe *recipe, Error *e)
{
    const TreeParams *params = &plan->params;
    LightSite site = plan_site(plan, recipe->seed);
    OutTree *grown = NULL;
    bool limbs = (*tree)->count > 0;
    bool formed = plan->bounded || params->crown.element.field_count > 0 ||
                  params->light.attractors.count > 0;
    if (!limbs && !formed && !recipe->room) {
        grown = grow_to_height(plan, &site, recipe, e);
    } else if (find_internode(plan, &site, recipe, e)) {
        OutTree *start = limbs ? NULL : plant(params, site.seed, e);
        grown = limbs || start ? grow_bounded(plan, limbs ? *tree : start, &site, recipe, e) : NULL;
        out_tree_free(start);
    }
    if (!grown) {
        return recipe_fail(recipe, "crown", e);
    }
    out_tree_free(*tree);
    *tree = grown;
    return true;
}

static bool plan_stand(StandTree *tree, int count, TreePlan *plan, StandPlant *plant_of,
                       const Recipe *recipe, Error *e)
{
    RoomTrials trials = {0};
    bool done = true;
    for (int i = 0; done && i < count; i++) {
        TreeParams params = *tree[i].params;
        params.position = tree[i].foot;
        params.roots.count = 0;
        params.grown_by = GROWN_BY_LIGHT;
        tree_plan_make(&plan[i], &params, tree[i].seed);
        StandPlant *one = &plant_of[i];
        one->params = plan_growth(&plan[i]);
        one->site = plan_site(&plan[i], tree[i].seed);
        done = find_reach(&plan[i], one->site, &trials, recipe, &one->site.reach, e) &&
               check_height(one->site.reach.high.y, e);
        if (done) {
            one->site.internode = plan[i].params.height / one->site.reach.high.y;
            one->start = plant(&plan[i].params, one->site.seed, e);
            done = one->start;
        }
    }
    free(trials.trial);
    return done;
}

// Radii and hazards of the trees that have grown; on failure no tree is left.
static bool finish_stand(StandTree *tree, int count, const TreePlan *plan, bool grown, Error *e)
{
    bool done = grown;
    for (int i = 0; done && i < count; i++) {
        tree_compute_radii(tree[i].grown, &plan[i].params, true);
        done = tree_befall(tree[i].grown, &plan[i].params, tree[i].seed, e);
    }
    for (int i = 0; !done && i < count; i++) {
        out_tree_free(tree[i].grown);
        tree[i].grown = NULL;
    }
    return done;
}

bool tree_grow_stand(StandTree *tree, int count, const Vec3 *copy, int copies, const Recipe *recipe,
                     Error *e)
{
    TreePlan *plan = memory_alloc(count, sizeof *plan, e);
    StandPlant *plant_of = plan ? memory_alloc_zero(count, sizeof *plant_of, e) : NULL;
    bool done = plant_of && plan_stand(tree, count, plan, plant_of, recipe, e) &&
                light_grow_stand(plant_of, count, copy, copies, recipe->run, e);
    for (int i = 0; plant_of && i < count; i++) {
        out_tree_free(plant_of[i].start);
        tree[i].grown = plant_of[i].grown;
    }
    done = plant_of && finish_stand(tree, count, plan, done, e);
    free(plant_of);
    free(plan);
    return done || recipe_fail(recipe, NULL, e);
}
