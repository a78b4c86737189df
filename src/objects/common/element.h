// An element of a model: one out-tree's worth of envelope, points, growth and field (Tanaka et al.,
// section 5.1: trunk, branches and roots are grown as separate elements). Every kind of model is
// made of these.
#ifndef RAMIFY_OBJECTS_COMMON_ELEMENT_H
#define RAMIFY_OBJECTS_COMMON_ELEMENT_H

#include "field/guide_field.h"
#include "grow/colonize.h"
#include "objects/common/recipe.h"
#include "shape/envelope.h"
#include "shape/points.h"

// What the scene file says of an element. Lists that are empty and numbers that are 0 take the
// model's own defaults.
typedef struct ElementParams {
    Shape *shapes; // the envelope
    int shape_count;
    float voxel;           // m, of level sets; 0 = automatic
    ScatterParams points;  // count and scale are the levels', anchor and seed the growth's
    ColonizeParams growth; // lengths are the levels'; noise: for levels that name none
    GrowLevel *levels;
    int level_count;
    FieldParams *fields;
    int field_count;
} ElementParams;

// Who wants to know of the envelopes and guide fields that things grow in, through Run.witness.
typedef struct GrowthWitness {
    // Before something grows. label: of the object and its part ("object 'oak', crown"). field:
    // NULL = none. Both are gone later. False and e end the growth.
    bool (*see)(void *user, const char *label, const Envelope *envelope, const GuideField *field,
                Error *e);
    void *user;
} GrowthWitness;

// Tells the run's witness, if it has one.
bool growth_witness(const Recipe *recipe, const char *part, const Envelope *envelope,
                    const GuideField *field, Error *e);

// Streams of the seed that an element grows from.
enum { STREAM_ELEMENT_FIELD = 1, STREAM_ELEMENT_POINTS = 2, STREAM_ELEMENT_GROWTH = 3 };

// Attractors of all its own levels; 0 where it has none.
int64_t element_attractors(const ElementParams *element);

// The envelope of the element's shapes.
Envelope *element_envelope(const ElementParams *element, const Run *run, Error *e);

// Grows the element into tree, whose nodes so far are the type-0 points. seed: the element's own.
// part names the element in warnings and errors ("crown"); NULL = it is all of the object.
bool element_grow(OutTree *tree, const ElementParams *element, uint64_t seed, const Recipe *recipe,
                  const char *part, Error *e);

// The same in an envelope that is there already; the element's shapes are not looked at, and errors
// do not name the element.
bool element_grow_in(OutTree *tree, const ElementParams *element, const Envelope *envelope,
                     uint64_t seed, const Recipe *recipe, const char *part, Error *e);

// The parts of element_grow, for recipes that grow level by level themselves.
ColonizeParams element_colonize_params(const OutTree *tree, const ElementParams *element,
                                       const GuideField *field, uint64_t seed);
ScatterParams element_scatter_params(const OutTree *tree, const ElementParams *element,
                                     uint64_t seed);

// The element's guide fields about the roots of the tree so far; *field is NULL when it has none.
bool element_guide_field(const OutTree *tree, const ElementParams *element,
                         const Envelope *envelope, uint64_t seed, const Run *run,
                         GuideField **field, Error *e);

#endif
