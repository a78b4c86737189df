// An element: the envelope, attractors, growth parameters and guide fields of one out-tree (Tanaka
// et al., section 5.1: trunk, branches and roots are grown as separate elements).
#ifndef RAMIFY_OBJECTS_COMMON_ELEMENT_H
#define RAMIFY_OBJECTS_COMMON_ELEMENT_H

#include "field/guide_field.h"
#include "grow/colonize.h"
#include "objects/common/density.h"
#include "objects/common/recipe.h"
#include "shape/envelope.h"
#include "shape/points.h"

// An element's parameters in the scene file. Empty lists and numbers that are 0 take the kind's
// defaults.
typedef struct ElementParams {
    Shape *shapes; // the envelope
    int shape_count;
    float voxel;            // m, of level sets; 0 = automatic
    ScatterParams points;   // the levels set count and scale, the growth anchor and seed
    ColonizeParams growth;  // the levels set lengths; noise: of levels that give none
    DensityParams *density; // of the attractors; NULL = even
    GrowLevel *levels;
    int level_count;
    FieldParams *fields;
    int field_count;
} ElementParams;

// Observer of the envelopes and guide fields that objects grow in, set as Run.observer.
typedef struct GrowthObserver {
    // Called before each growth. part: "crown"; NULL = the object has no parts. field: NULL = none.
    // envelope and field are valid during the call only. False and e stop the growth.
    bool (*see)(void *user, const char *part, const Envelope *envelope, const GuideField *field,
                Error *e);
    void *user;
} GrowthObserver;

// Calls the run's observer, if there is one.
bool growth_observe(const Recipe *recipe, const char *part, const Envelope *envelope,
                    const GuideField *field, Error *e);

// Streams of the seed that an element grows from.
enum { STREAM_ELEMENT_FIELD = 1, STREAM_ELEMENT_POINTS = 2, STREAM_ELEMENT_GROWTH = 3 };

// Attractors of all levels in its list; 0 if the list is empty.
int64_t element_attractors(const ElementParams *element);

// The envelope of the element's shapes.
Envelope *element_envelope(const ElementParams *element, const Run *run, Error *e);

// Grows the element into tree, whose existing nodes are the type-0 points and the nuclei of its
// guide fields. seed: the element's own.
// part: the element's name in warnings and errors ("crown"); NULL = the whole object.
bool element_grow(OutTree *tree, const ElementParams *element, uint64_t seed, const Recipe *recipe,
                  const char *part, Error *e);

// The same in an existing envelope: the element's shapes are ignored, and errors do not name the
// element. nuclei: only so many of the tree's first nodes are nuclei.
bool element_grow_in(OutTree *tree, int64_t nuclei, const ElementParams *element,
                     const Envelope *envelope, uint64_t seed, const Recipe *recipe,
                     const char *part, Error *e);

// The steps of element_grow, for recipes that grow level by level.
ColonizeParams element_colonize_params(const OutTree *tree, const ElementParams *element,
                                       const GuideField *field, uint64_t seed);
ScatterParams element_scatter_params(const OutTree *tree, const ElementParams *element,
                                     uint64_t seed);

// The density of the element's attractors, set in scatter; *density is NULL if it has none. Free it
// with density_free after the scattering.
bool element_density(const ElementParams *element, ScatterParams *scatter, Density **density,
                     const Run *run, Error *e);

// The element's guide fields with the tree's first nodes as nuclei; *field is NULL if it has none.
bool element_guide_field(const OutTree *tree, int64_t nuclei, const ElementParams *element,
                         const Envelope *envelope, uint64_t seed, const Run *run,
                         GuideField **field, Error *e);

#endif
