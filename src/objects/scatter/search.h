// The search for places: random spots, of which those are kept that the parameters allow. Private
// to this folder.
#ifndef RAMIFY_OBJECTS_SCATTER_SEARCH_H
#define RAMIFY_OBJECTS_SCATTER_SEARCH_H

#include "objects/common/surroundings.h"
#include "objects/scatter/ground.h"
#include "objects/scatter/scatter.h"
#include "shape/point_hash.h"

// Of the object's seed; PATCHES + i: of thing i.
enum { STREAM_PLACES = 1, STREAM_PATCHES = 10 };
// Of a place.
enum {
    STREAM_RADIUS = 1,
    STREAM_AZIMUTH = 2,
    STREAM_FACE = 3,
    STREAM_ACROSS = 4,
    STREAM_ALONG = 5,
    STREAM_THING = 6,
    STREAM_VARIANT = 7,
    STREAM_PATCH = 8,
    STREAM_SIZE = 9,
    STREAM_TURN = 10,
    STREAM_WHERE = 11,
    STREAM_TILT = 12,
    STREAM_TILT_AZIMUTH = 13,
    STREAM_STRETCH = 14,
    STREAM_COPIES = 15 // + i: of the place on copy i of the surface
};

typedef struct Search {
    const ScatteringParams *params;
    const Surroundings *around;
    const ShapeSurface *surface; // NULL = the land
    double *area;                // m^2, of the surface's faces 0 .. i; NULL with the land
    PointHash *taken;            // NULL = places may be as near as they like
    const HeightField *land;     // of the terrain they stand on; NULL = none, or not known
    Where where;                 // maps that places are chosen by
    const HeightField *wet; // the land that tells where its water is; NULL = unknown, or by_depth
    bool by_depth;          // conditions on the water's depth decide
    int copies;             // of the surface, on which they stand, too
    ScatterGround *ground;  // of a surface with copies in its mesh; else NULL
    uint64_t seed;
} Search;

typedef struct Spot {
    Vec3 p, normal;
    uint64_t key;
} Spot;

// spots.c: a random spot in the disc on the land, or on the surface, by areas: false if what was
// drawn is beside the face.
bool scatter_spot_on_land(const Search *search, uint64_t key, Spot *spot);
bool scatter_spot_on_surface(const Search *search, uint64_t key, Spot *spot);

// Sums of the areas in which spots are drawn for the surface's faces, 0 for those too far away. The
// caller frees the array.
double *scatter_sum_areas(const Search *search, Error *e);

// keep.c: do slope, altitude, water and maps allow it?
bool scatter_allows(const Search *search, const Spot *spot);
bool scatter_suits_water(const Search *search, Vec3 p);

// Is the spot in one of the thing's patches?
bool scatter_in_patch(const Search *search, const Spot *spot, int thing);

// Takes the spot if no other is too near. False: ERROR_MEMORY.
bool scatter_take(const Search *search, const Spot *spot, bool *taken, Error *e);

// m, the surface of the water at a place under it.
float scatter_surface_over(const Search *search, Vec3 p);

#endif
