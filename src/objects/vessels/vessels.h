// Blood vessels (Tanaka et al., section 5.4): an arterial and a venous out-tree that fill the same
// organ side by side without touching, radii and angles by Murray's laws.
#ifndef RAMIFY_OBJECTS_VESSELS_VESSELS_H
#define RAMIFY_OBJECTS_VESSELS_VESSELS_H

#include "objects/common/element.h"
#include "objects/common/recipe.h"
#include "outtree/flow.h"
#include "outtree/murray.h"

enum { VESSELS_ARTERIES, VESSELS_VEINS }; // colonies of the out-tree and roles of materials

// A stretch of a great vessel, from which growth starts: straight, or bent by `by`.
typedef struct GreatVessel {
    bool vein;
    Vec3 from, to; // m
    Vec3 by;       // m: the way bends toward this point; meaningless unless bent
    bool bent;
    float sweep; // m: it leaves along its mother and turns off over about this way; 0 = at once
} GreatVessel;

typedef struct VesselsParams {
    ElementParams
        element; // the organ; omitted levels follow from `terminals`. If the first shape is a body,
                 // the great vessels from its heart supply it, otherwise the inlet
    int64_t terminals; // ends of arteries and veins together
    bool veins;        // two trees; otherwise arteries alone
    Vec3 inlet; // m: where the vessels enter; all 0 = the hilum, the surface point nearest to the
                // middle
    // Great vessels that the user places, instead of the stem at the inlet: the first artery and
    // the first vein begin their trees, each further one leaves the nearest vessel of its tree.
    GreatVessel *great;
    int great_count;
    float root_radius; // m, of the artery's root; 0 = in proportion to the organ
    float vein_radius; // of the veins' root, in units of the artery's
    MurrayLaw law;
    float gap; // least distance between an artery and a vein, in radii of the finest vessels
    bool turn; // turn daughters to Murray's angles
    float curve_radius; // m: thicker vessels get a skin; 0 = all are round curves
    int skin_levels;
    float ring_spacing; // of the skin, in radii: see SkinParams
    float wall;         // of roots that are cut open, in radii: see SkinParams
    FlowParams flow;    // for measures and exports
} VesselsParams;

VesselsParams vessels_params_default(void);

// The recipe (see recipe.h). Grows both trees in one out-tree, colonies VESSELS_ARTERIES and
// VESSELS_VEINS, radii and all. Every segment beyond the stems is inside the organ by its radius
// (or by the envelope's band, if that is less), at both ends and in the middle; no artery is closer
// to a vein than `gap`. Both hold at every time of the growth. Measures terminals, the fit to
// Murray's laws, the least distance between arteries and veins, flow and orders by diameter
// (flow_measures.c).
bool vessels_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool vessels_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                    Error *e);
bool vessels_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);
bool vessels_measure(const void *params, const Grown *grown, const Recipe *recipe,
                     MeasureList *list, Error *e);

// Appends, for prefix "artery" or "vein": PREFIX_inflow (of its roots; ml/min), PREFIX_resistance
// (mean fall of pressure from root to ends over the flow; Pa s/m^3), PREFIX_pressure_drop (Pa, that
// mean fall), PREFIX_wall_shear, PREFIX_wall_shear_low, PREFIX_wall_shear_high (Pa; median, 10th
// and 90th percentile over the segments), PREFIX_orders, PREFIX_order_number,
// PREFIX_order_diameter, PREFIX_order_length (orders by diameter and their ratios),
// PREFIX_segments_in_series (mean of an element). NAN without such vessels.
bool vessels_measure_flow(const OutTree *tree, const FlowParams *params, const char *prefix,
                          MeasureList *list, Error *e);

// The nodes of one colony as a separate out-tree.
OutTree *vessels_colony(const OutTree *tree, int32_t colony, Error *e);

extern const struct Table vessels_table; // of its parameters

#endif
