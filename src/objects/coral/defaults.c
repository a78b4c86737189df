// Defaults of a coral by form, in proportion to its size.
#include "objects/coral/coral.h"

#include <stddef.h>

typedef struct FormDefaults {
    float height; // all lengths as shares of the colony's size
    int64_t attractors;
    const char *axiom, *rules;
    int generations;
    float angle, group; // degrees
    float regularity, noise;
    float length, length_tip;
    float tip_radius;
} FormDefaults;

static const FormDefaults FORMS[] = {
    // a leader that forks occasionally, each fork rotated by the golden angle from the last
    [CORAL_BRANCHING] = {.height = 0.62f,
                         .attractors = 1300,
                         .axiom = "[&(40)FX]/(120)[&(44)FX]/(120)[&(36)FX]/(60)FX",
                         .rules = "X -> F[+FX][-(50)FX]/(80)FX : 2; X -> F/(137)[+FX]FX : 3",
                         .generations = 9,
                         .angle = 38.0f,
                         .group = 95.0f,
                         .regularity = 0.5f,
                         .noise = 0.06f,
                         .length = 0.062f,
                         .length_tip = 0.048f,
                         .tip_radius = 0.0125f},
    [CORAL_TABLE] = {.height = 0.36f,
                     .attractors = 1800,
                     .axiom = "[FX]+(51)[FX]+(51)[FX]+(51)[FX]+(51)[FX]+(51)[FX]+(51)[FX]",
                     .rules = "X -> [+FX][-FX]FX",
                     .generations = 9,
                     .angle = 34.0f,
                     .group = 80.0f,
                     .regularity = 0.35f,
                     .noise = 0.05f,
                     .length = 0.06f,
                     .length_tip = 0.035f,
                     .tip_radius = 0.0065f},
    [CORAL_FAN] = {.height = 0.8f, // values of the paper
                   .attractors = 1500,
                   .axiom = "X",
                   .rules = "X -> [+FX][-FX]FX",
                   .generations = 7,
                   .angle = 30.0f,
                   .group = 60.0f,
                   .regularity = 0.0f,
                   .noise = 0.0f,
                   .length = 0.14f,
                   .length_tip = 0.05f,
                   .tip_radius = 0.005f},
    [CORAL_ENCRUSTING] = {.height = 0.4f,
                          .attractors = 1500,
                          .axiom = "[FX]+(60)[FX]+(60)[FX]+(60)[FX]+(60)[FX]+(60)[FX]",
                          .rules = "X -> [+FX]FX : 1; X -> [-FX]FX : 1",
                          .generations = 13,
                          .angle = 35.0f,
                          .group = 70.0f,
                          .regularity = 0.3f,
                          .noise = 0.08f,
                          .length = 0.06f,
                          .length_tip = 0.04f,
                          .tip_radius = 0.014f},
    [CORAL_MASSIVE] = {.height = 0.62f,
                       .attractors = 1500,
                       .axiom = "[FX]+(60)[FX]+(60)[FX]+(60)[FX]+(60)[FX]+(60)[FX]",
                       .rules = "X -> [+FX]FX : 1; X -> [-FX]FX : 1",
                       .generations = 13,
                       .angle = 35.0f,
                       .group = 75.0f,
                       .regularity = 0.3f,
                       .noise = 0.08f,
                       .length = 0.07f,
                       .length_tip = 0.06f,
                       .tip_radius = 0.04f},
};

CoralParams coral_params_default(void)
{
    return (CoralParams){.form = CORAL_BRANCHING,
                         .size = 0.5f,
                         .colonies = 1,
                         .regularity = -1.0f,
                         .noise = -1.0f,
                         .light = 0.5f,
                         .exponent = 4.0f,
                         .polyps = {.lean = 48.0f},
                         .levels = 2};
}

static void fill(float *value, float default_value)
{
    if (*value == 0.0f) {
        *value = default_value;
    }
}

CoralParams coral_params_resolve(const CoralParams *params)
{
    CoralParams p = *params;
    const FormDefaults *form = &FORMS[p.form];
    fill(&p.height, form->height * p.size);
    fill(&p.spread, p.colonies > 1 ? 0.42f * p.size : 0.0f);
    p.attractors = p.attractors > 0 ? p.attractors : form->attractors;
    p.axiom = p.axiom ? p.axiom : (char *)form->axiom;
    p.rules = p.rules ? p.rules : (char *)form->rules;
    p.generations = p.generations > 0 ? p.generations : form->generations;
    fill(&p.angle, form->angle);
    fill(&p.group, form->group);
    p.regularity = p.regularity >= 0.0f ? p.regularity : form->regularity;
    p.noise = p.noise >= 0.0f ? p.noise : form->noise;
    fill(&p.length, form->length * p.size);
    fill(&p.length_tip, form->length_tip * p.size);
    fill(&p.tip_radius, form->tip_radius * p.size);
    fill(&p.plate, 2.0f * (0.022f * p.size)); // doubling and halving change no bit
    fill(&p.pale, 4.0f * p.tip_radius);
    fill(&p.polyps.diameter, 0.0022f * p.size / 0.5f);
    fill(&p.polyps.spacing, 1.6f * p.polyps.diameter);
    fill(&p.polyps.height, 0.9f * p.polyps.diameter);
    return p;
}
