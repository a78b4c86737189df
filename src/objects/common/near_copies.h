// Which copies of a model stand so near the camera that the coarse forms of its leaves would show;
// their leaves stay instances in full detail.
#ifndef RAMIFY_OBJECTS_COMMON_NEAR_COPIES_H
#define RAMIFY_OBJECTS_COMMON_NEAR_COPIES_H

#include "base/run.h"
#include "mesh/geometry.h"

// Places of a model, the near ones first.
typedef struct NearCopies {
    Transform *place; // owned
    int64_t near, count;
} NearCopies;

// Sorts the places: near are those whose origin is within reach (m) of the eye, at most `most` of
// them, those next to the eye. eye: in the space of the places; NULL = none is near. Else the order
// stays. False and e if memory is short.
bool near_copies_init(NearCopies *copies, const Transform *place, int64_t count, const Vec3 *eye,
                      float reach, int64_t most, Error *e);
void near_copies_free(NearCopies *copies);

// The part's leaves at all near places, as instances with their own colours. The mesh and the
// coarse forms stay the part's: the caller moves them over. False and e if memory is short; then
// there is nothing to free.
bool near_copies_leaves(const NearCopies *copies, const Part *part, Part *leaves, const Run *run,
                        Error *e);

#endif
