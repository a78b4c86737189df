// Hoar frost: tufts of ice needles along branches and on meshes. In still air they grow all around;
// wind that brings droplets makes them grow against it (rime); where surfaces cool by radiation,
// they grow toward the open sky.
#ifndef RAMIFY_OBJECTS_COMMON_HOAR_H
#define RAMIFY_OBJECTS_COMMON_HOAR_H

#include "base/mesh.h"
#include "objects/common/branches.h"
#include "objects/common/recipe.h"

typedef enum HoarHabit {
    HOAR_NEEDLES,
    HOAR_FEATHERS // flat fronds
} HoarHabit;

typedef struct HoarParams {
    HoarHabit habit;
    float length;      // m, of the needles on thin twigs; 0 = none
    float density;     // 1 = as many tufts as stand free of each other
    float wind;        // degrees from +Z toward +X: where the wind blows
    float bias;        // 0 = all around; 1 = only against the wind
    float sky;         // 0 = all sides are equally cold; 1 = they cool by radiation to the sky
    float thickest;    // m: radius of branches on which needles are half as long
    float variety;     // 0 = tufts of much the same length, evenly strewn; 1 = few large in patches
    int64_t max_count; // tufts
} HoarParams;

enum { HOAR_TUFT_BYTES = 100 }; // memory of a placed tuft

extern const struct Table hoar_table; // of HoarParams

HoarParams hoar_params_default(void); // none

// Growth on a surface that faces `up` (the normal's y), relative to one that faces the whole sky:
// the share of the sky that it sees, of which a share `open` is free. 0 where too little grows.
float hoar_sky_share(const HoarParams *params, float up, float open);

// Growth on a surface whose normal has this cosine to the direction against the wind, relative to
// the mean over all directions: the density of the branches' law, side = lerp(any, against, bias);
// from a bias of 0.5 on, what a stream of droplets leaves: 4 times the cosine.
float hoar_wind_share(const HoarParams *params, float cosine);

// Length of the tuft at p relative to the mean of its kind of place; 0 = there is none.
float hoar_size_share(const HoarParams *params, Vec3 p, uint64_t key);

Vec3 hoar_against(const HoarParams *params); // the wind, unit

// Tufts on each m2 of a body of this radius: as many as on a branch.
float hoar_tufts_per_area(const HoarParams *params, float radius);

// Adds the frost on all branches of an out-tree above the ground.
bool hoar_add(const OutTree *tree, const SkinningParams *skinning, const HoarParams *params,
              const Placing *placing, int role, Error *e);

// Adds the frost on a mesh that faces outward. Thin parts and edges bear more and longer tufts: the
// radius that counts is that of the largest ball which touches the surface from inside. Half of the
// growth by wind and sky shows as number, half as length. Other objects shade nothing.
bool hoar_add_on_mesh(const Mesh *mesh, const HoarParams *params, const Placing *placing, int role,
                      Error *e);

#endif
