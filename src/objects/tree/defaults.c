#include "objects/tree/defaults.h"

#include "base/exact_math.h"
#include "base/random.h"

enum { STREAM_LOBE_SIZE = 1, STREAM_LOBE_TURN = 2 }; // of a lobe

// Radius / height of the default trunk of a grown-up tree.
#define GIRTH_BY_LIGHT 0.0205f
#define GIRTH_BY_ATTRACTORS 0.03f

#define SLOWING 2.5f     // of growth in height, over the years until a tree is mature
#define LEAST_SEASONS 3  // of the youngest tree
#define OLD_SEASONS 0.5f // that the oldest trees grow beyond maturity, share of those until then

TreeParams tree_params_default(void)
{
    return (TreeParams){
        .light = {light_params_default(),
                  .attractors = {.weight = 0.5f, .pull = 0.15f, .reach = 6.0f, .occupied = 1.0f},
                  .mature_height = 14.0f, .mature_age = 120.0f},
        .trunk = {.element.growth = {.max_children = 1,
                                     .noise = 0.2f,
                                     .tropism = {0, 0.4f, 0},
                                     .field_weight = 1.0f},
                  .lean = 3.0f,
                  .lean_azimuth = 60.0f,
                  .stems = 1,
                  .rib_depth = 0.15f},
        .crown = {.element = {.points.shell = 0.3f,
                              .growth = {.max_children = 3,
                                         .noise = 0.3f,
                                         .tropism = {0, 1, 0},
                                         .field_weight = 1.0f}},
                  .lobes = 14,
                  .branches = 7,
                  .branch_from = 0.72f,
                  .branch_angle = 62.0f},
        .roots = {.element.growth = {.max_children = 2,
                                     .noise = 0.25f,
                                     .tropism = {0, -1, 0},
                                     .field_weight = 1.0f},
                  .count = 6,
                  .radius = 0.42f},
        .radii = {.model = RADIUS_PIPE, .exponent = 2.3f, .tip = 0.0019f, .flare = 0.55f},
        .leaves = {.max_count = 250000,
                   .spacing = 0.018f,
                   .twig_radius = 0.0045f,
                   .length = 0.105f,
                   .width = 0.062f,
                   .size_variation = 0.35f,
                   .petiole = 0.012f,
                   .fold = 22.0f,
                   .curl = 25.0f,
                   .wave = 0.05f,
                   .lobes = 4,
                   .lobe_depth = 0.42f,
                   .crowding = 0.75f,
                   .emergence = 1.0f,
                   .angle = 55.0f,
                   .droop = 0.45f,
                   .phyllotaxis = 137.5f,
                   .variants = 4,
                   .detail = 1},
        .skin = {.curve_radius = 0.014f, .levels = 2, .ring_spacing = 1.0f},
        .latitude = 50.0f,
        .phenology = phenology_default(),
        .snow = snow_params_default(),
        .hoar = hoar_params_default(),
    };
}

static void fill(float *value, float default_value)
{
    if (*value == 0.0f) {
        *value = default_value;
    }
}

static void fill_envelope(ElementParams *element, Shape *shapes, int count)
{
    if (element->shape_count == 0) {
        element->shapes = shapes;
        element->shape_count = count;
    }
}

static void fill_levels(ElementParams *element, GrowLevel *levels, int count)
{
    if (element->level_count == 0) {
        element->levels = levels;
        element->level_count = count;
    }
}

// Height of a tree of this age, share of its mature height: growth slows down from year to year.
static float height_at(float age)
{
    return (float)((1.0 - exact_exp(-(double)(SLOWING * age))) /
                   (1.0 - exact_exp(-(double)SLOWING)));
}

// The age, share of the mature age, at which a tree has this share of its mature height; at most 1.
static float age_at(float height)
{
    double left = 1.0 - (double)height * (1.0 - exact_exp(-(double)SLOWING));
    return height < 1.0f ? (float)(-exact_log(left) / (double)SLOWING) : 1.0f;
}

// Height, age and seasons follow from each other.
static void plan_age(TreePlan *plan)
{
    TreeParams *tree = &plan->params;
    const TreeLight *light = &tree->light;
    if (tree->height == 0.0f) {
        float age = tree->age > 0.0f ? tree->age / light->mature_age : 1.0f;
        tree->height = light->mature_height * height_at(age);
    }
    fill(&tree->age, light->mature_age * age_at(tree->height / light->mature_height));
    float age = tree->age / light->mature_age;
    float share = age <= 1.0f ? height_at(age) : 1.0f + OLD_SEASONS * (1.0f - 1.0f / age);
    int seasons = (int)(share * (float)light->growth.seasons + 0.5f);
    plan->seasons = seasons > LEAST_SEASONS ? seasons : LEAST_SEASONS;
}

// Thickness of the trunk: by elastic similarity, a tree grows thicker faster than taller, and goes
// on doing so when it grows no more.
static void plan_girth(TreePlan *plan)
{
    TreeParams *tree = &plan->params;
    bool light = plan->grown_by != GROWN_BY_ATTRACTORS;
    float girth = light ? GIRTH_BY_LIGHT : GIRTH_BY_ATTRACTORS;
    girth = tree->trunk.slenderness > 0.0f ? 0.5f / tree->trunk.slenderness : girth;
    float radius = girth * tree->height * sqrtf(tree->height / tree->light.mature_height);
    float age = tree->age / tree->light.mature_age;
    fill(&tree->trunk.radius, light && age > 1.0f ? radius * sqrtf(age) : radius);
    fill(&tree->trunk.slenderness, 0.5f / girth);
}

static void plan_trunk(TreePlan *plan)
{
    TreeParams *tree = &plan->params;
    TrunkParams *trunk = &tree->trunk;
    fill(&trunk->height, 0.32f * tree->height);
    fill(&trunk->stem_circle, trunk->radius);
    // A capsule about the leaning axis; stems that share it need room for their circle.
    float radius = 0.7f * trunk->radius + (trunk->stems > 1 ? trunk->stem_circle : 0.0f);
    float azimuth = trunk->lean_azimuth * RADIANS_PER_DEGREE, sine, cosine, lean_sine, lean_cosine;
    exact_sincos(azimuth, &sine, &cosine);
    exact_sincos(trunk->lean * RADIANS_PER_DEGREE, &lean_sine, &lean_cosine);
    Vec3 up = vec3(lean_sine * sine, lean_cosine, lean_sine * cosine);
    Vec3 x = vec3_normalize(vec3_cross(up, vec3(0, 0, 1))), z = vec3_cross(x, up);
    plan->trunk_shape = (Shape){.kind = SHAPE_CAPSULE,
                                .size = vec3(radius, trunk->height, 0),
                                .transform = transform_from_axes(x, up, z, tree->position)};
    plan->trunk_level[0] = (GrowLevel){.attractors = 40 * (trunk->stems > 0 ? trunk->stems : 1),
                                       .step = 0.35f,
                                       .kill = 0.8f,
                                       .influence = 5.0f,
                                       .scale = 1.0f,
                                       .noise = trunk->element.growth.noise,
                                       .tropism = 1.0f,
                                       .relax = 0.3f};
    fill_envelope(&trunk->element, &plan->trunk_shape, 1);
    fill_levels(&trunk->element, plan->trunk_level, 1);
}

static Shape ellipsoid(Vec3 center, Vec3 half)
{
    return (Shape){.kind = SHAPE_ELLIPSOID,
                   .op = SHAPE_UNION,
                   .size = half,
                   .transform = transform_compose(center, vec3_splat(0), vec3_splat(1))};
}

// The default crown: an ellipsoid, or a smaller one with lobes spread evenly over it (by the golden
// angle), of uneven size, as limbs compete for light. Returns the number of shapes.
static int crown_shapes(TreePlan *plan, uint64_t seed)
{
    const TreeParams *tree = &plan->params;
    const CrownParams *crown = &tree->crown;
    float height = 0.5f * (tree->height - crown->base);
    Vec3 half = vec3(0.5f * crown->width, height, 0.5f * crown->width);
    Vec3 center = vec3_add(tree->position, vec3(0, crown->base + height, 0));
    int lobes = crown->lobes < TREE_MOST_LOBES ? crown->lobes : TREE_MOST_LOBES;
    if (lobes <= 0) {
        plan->crown_shape[0] = ellipsoid(center, half);
        return 1;
    }
    plan->crown_shape[0] = ellipsoid(center, vec3_scale(half, 0.74f));
    for (int i = 0; i < lobes; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        float sine, cosine, size = random_range(random_key(key, STREAM_LOBE_SIZE), 0.26f, 0.44f);
        float y = 1.0f - 1.7f * ((float)i + 0.5f) / (float)lobes; // few at the shaded bottom
        float turn =
            (float)i * 2.39996f + random_range(random_key(key, STREAM_LOBE_TURN), -0.4f, 0.4f);
        exact_sincos(turn, &sine, &cosine);
        float r = sqrtf(1.0f - y * y), reach = 1.0f - size;
        Vec3 place = vec3_mul(half, vec3(reach * r * sine, reach * y, reach * r * cosine));
        plan->crown_shape[1 + i] = ellipsoid(vec3_add(center, place), vec3_scale(half, size));
    }
    return 1 + lobes;
}

static void plan_crown(TreePlan *plan, uint64_t seed)
{
    TreeParams *tree = &plan->params;
    CrownParams *crown = &tree->crown;
    fill(&crown->width, 1.05f * tree->height);
    fill(&crown->base, 0.18f * tree->height);
    fill(&crown->branch_length, 0.08f * tree->height);
    int shapes = crown_shapes(plan, seed);
    // Coarse to fine: few long-reaching limbs first, then ten times as many branches, and so on.
    float noise = crown->element.growth.noise;
    GrowLevel levels[TREE_DEFAULT_LEVELS] = {
        {30, 0.10f, 0.4f, 4.0f, 0.70f, noise, 0.0f, 0.5f},
        {300, 0.20f, 0.7f, 2.5f, 0.90f, noise, 0.0f, 0.5f},
        {3000, 0.30f, 0.9f, 2.2f, 0.97f, noise, 0.0f, 0.5f},
        {30000, 0.45f, 1.0f, 2.0f, 1.00f, noise, 0.1f, 0.5f},
    };
    for (int i = 0; i < TREE_DEFAULT_LEVELS; i++) {
        plan->crown_level[i] = levels[i];
    }
    if (crown->element.shape_count == 0) {
        fill(&crown->element.voxel, tree->height / 80.0f); // lobes are smooth: no finer is needed
    }
    fill_envelope(&crown->element, plan->crown_shape, shapes);
    fill_levels(&crown->element, plan->crown_level, TREE_DEFAULT_LEVELS);
}

static void plan_roots(TreePlan *plan)
{
    TreeParams *tree = &plan->params;
    RootParams *roots = &tree->roots;
    fill(&roots->spread, 0.2f * tree->height);
    fill(&roots->depth, 0.25f * roots->spread);
    Vec3 center = vec3_add(tree->position, vec3(0, -0.75f * roots->depth, 0));
    plan->root_shape =
        (Shape){.kind = SHAPE_ELLIPSOID,
                .size = vec3(roots->spread, roots->depth, roots->spread),
                .transform = transform_compose(center, vec3_splat(0), vec3_splat(1))};
    float noise = roots->element.growth.noise;
    plan->root_level[0] = (GrowLevel){40, 0.15f, 0.6f, 4.0f, 0.9f, noise, 0.02f, 0.5f};
    plan->root_level[1] = (GrowLevel){250, 0.3f, 0.8f, 2.2f, 1.0f, noise, 0.1f, 0.5f};
    fill_envelope(&roots->element, &plan->root_shape, 1);
    fill_levels(&roots->element, plan->root_level, 2);
}

void tree_plan_make(TreePlan *plan, const TreeParams *params, uint64_t seed)
{
    plan->params = *params;
    plan->grown_by = params->grown_by;
    if (params->grown_by == GROWN_BY_AUTO) {
        plan->grown_by =
            params->crown.element.level_count > 0 ? GROWN_BY_ATTRACTORS : GROWN_BY_LIGHT;
    }
    plan->bounded = plan->grown_by == GROWN_BY_BOTH || params->crown.width > 0.0f ||
                    params->crown.element.shape_count > 0;
    plan->bole = params->crown.base;
    plan_age(plan);
    plan_girth(plan);
    plan_trunk(plan);
    plan_crown(plan, random_key(seed, STREAM_TREE_LOBES));
    plan_roots(plan);
    fill(&plan->params.radii.flare_height, 2.5f * plan->params.trunk.radius);
}
