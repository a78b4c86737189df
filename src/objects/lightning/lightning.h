// Lightning (Tanaka et al., section 5.2): leaders grown by space colonization from a cloud to the
// ground, or over the surface of an object; the first channel to arrive carries the return stroke.
// Channels are jittered by fractional Brownian motion (eq. (14)). Lengths that are omitted scale
// with the height, on a surface with the envelope's extent, so a bolt of any size looks the same.
#ifndef RAMIFY_OBJECTS_LIGHTNING_LIGHTNING_H
#define RAMIFY_OBJECTS_LIGHTNING_LIGHTNING_H

#include "objects/common/element.h"
#include "objects/common/recipe.h"
#include "outtree/out_tree.h"

typedef struct LightningParams {
    Vec3 position; // m, strike of the first bolt; not used on a surface
    float height;  // m, from the strike to the cloud; ignored on a surface, where it is the
                   // envelope's largest extent
    float lean;    // degrees of the direction to the cloud from the vertical, less than 180; on a
                   // surface the first bolt starts at the farthest point in this direction
    float lean_azimuth; // degrees from +Z toward +X
    int bolts;          // side by side; on a surface, starting points
    float bolt_spread;  // m between them; 0 = 0.45 of the height
    int ground_points;  // strikes of a bolt's main channel; 2 = a forked flash
    int streamers;      // short leaders that rise from the ground about the strike
    float
        spread; // half-width at the ground of the side branches' envelope, as a share of the height
    float branching;       // factor on the number of side branches
    ElementParams element; // growth of the side branches; on a surface, of everything
    float hurst;           // exponent of the jitter
    float jitter;  // standard deviation at the end of a free path as long as the height, as a share
                   // of the height
    float step;    // m, length of the leader's steps, jittered less within; 0 = height / 40
    float segment; // m, length of drawn segments; 0 = height / 400
    float radius;  // m, drawn radius of the main channel; 0 = height / 1600. In nature 1 to 5 cm,
                   // far below a pixel; the power does not depend on it
    float power;   // W/m, radiant, of the main channel; 0 = in proportion to the radius
    float branch_power; // power of a long side branch at the main channel, as a share of that one's
    float drain; // length of all channels beyond a channel with which it has that power, as a
                 // share of the height
    float taper; // a channel's radius is in proportion to its power to this exponent
    float lift;  // m above the surface; 0 = twice the radius
} LightningParams;

// The documented defaults: a bolt of 1,000 m.
LightningParams lightning_params_default(void);

// Fills in numbers that are 0 from the height: in the air only, not on a surface.
LightningParams lightning_params_resolve(const LightningParams *given);

// The recipe (see recipe.h). Grows the out-tree of all bolts; finish jitters their channels. A
// node's radius is that of the core; (radius / lightning_radius())^(1 / taper) is its power over
// the main channel's. Colony: the bolt's number, and bolts + that number for its streamers.
// Normals: the surface's, if there is one.
bool lightning_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool lightning_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                      Error *e);

// Number of attractors that lightning_grow scatters.
int64_t lightning_attractors(const LightningParams *params);

// Radius of the main channel, m. From the grown tree, because on a surface lengths follow the
// envelope.
float lightning_radius(const LightningParams *params, const OutTree *tree);

// Adds the bolts as round curves. The one material should be an emission, or one that is lit, as
// cracks in a block are; then the power sets radii only. The curves' glow is relative to an
// emission's luminance, so that their radiance follows the power.
bool lightning_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

// Adds "turning" (mean absolute change of direction along the main channel, degrees, seen from the
// side; Hill 1968: 16 to 17) and "box_dimension" (of the bolts as seen from the side).
bool lightning_measure(const void *params, const Grown *grown, const Recipe *recipe,
                       MeasureList *list, Error *e);

extern const struct Table lightning_table; // of its parameters

#endif
