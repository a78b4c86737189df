// Lightning (Tanaka et al., section 5.2): leaders grown by space colonization from a cloud to the
// ground, or over the surface of an object; the channel that gets there first carries the return
// stroke. Ways wander by fractional Brownian motion (eq. (14)). All lengths that are left out
// follow the height, and on a surface the envelope's extent: a bolt of any size looks the same.
#ifndef RAMIFY_OBJECTS_LIGHTNING_LIGHTNING_H
#define RAMIFY_OBJECTS_LIGHTNING_LIGHTNING_H

#include "objects/common/element.h"
#include "objects/common/recipe.h"
#include "outtree/out_tree.h"

typedef struct LightningParams {
    Vec3 position; // m, where the first bolt strikes; not used on a surface
    float height;  // m, from there to where the bolt leaves the cloud; on a surface it is the
                   // envelope's largest extent, whatever stands here
    float lean;    // degrees from straight up of the way to the cloud, less than 180; on a surface
                   // the first bolt starts at the point that lies furthest this way
    float lean_azimuth; // degrees from +Z toward +X
    int bolts;          // side by side, or starting points on the surface
    float bolt_spread;  // m between them; 0 = 0.45 of the height
    int ground_points;  // ends of a bolt's main channel; 2 = a forked flash
    int streamers;      // short leaders that rise from the ground about the strike
    float spread;       // half-width at the ground of the space that side branches fill, as a share
                        // of the height
    float branching;    // factor on the number of side branches
    ElementParams element; // growth of the side branches; on a surface, of everything
    float hurst;           // exponent of the jitter
    float jitter;  // standard deviation that an unbound way as long as the height would have at its
                   // end, as a share of the height
    float step;    // m, of the leader's steps: straight but for what is finer; 0 = height / 40
    float segment; // m, of what is drawn; 0 = height / 400
    float radius;  // m, of the main channel as it is drawn; 0 = height / 1600. In nature 1 to
                   // 5 cm, far less than a pixel; the power does not depend on it
    float power;   // W/m, radiant, of the main channel; 0 = in proportion to the radius
    float
        branch_power; // of a side branch where it leaves the main channel, as a share of its power
    float lift;       // m above the surface; 0 = twice the radius
} LightningParams;

// The documented defaults: a bolt of 1,000 m.
LightningParams lightning_params_default(void);

// The same parameters with the open numbers (0) filled in that follow from the height: in the air,
// not over a surface.
LightningParams lightning_params_resolve(const LightningParams *given);

// The recipe (see recipe.h). Grows the out-tree of all bolts; finishing draws their ways. A node's
// radius is the core's, and its cube in units of lightning_radius()'s is its power in units of the
// main channel's. Colony: the bolt's number, and bolts + that number for its streamers. Normals: of
// the surface where there is one.
bool lightning_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool lightning_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                      Error *e);

// Attractors that lightning_grow will scatter.
int64_t lightning_attractors(const LightningParams *params);

// Radius of the main channel, m: of a grown tree, because on a surface lengths follow the envelope.
float lightning_radius(const LightningParams *params, const OutTree *tree);

// Adds the bolts as round curves that glow: the one material should be an emission. The curves'
// glow makes up for its radiance's luminance, so that their radiance follows the power.
bool lightning_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

// Adds "turning" (mean absolute change of direction along the main channel, degrees, seen from the
// side; Hill 1968: 16 to 17) and "box_dimension" (of the bolts as seen from the side).
bool lightning_measure(const void *params, const Grown *grown, const Recipe *recipe,
                       MeasureList *list, Error *e);

extern const struct Table lightning_table; // of its parameters

#endif
