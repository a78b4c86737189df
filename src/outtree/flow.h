// Steady flow of blood through an out-tree of round tubes, by Poiseuille's law: the pressure falls
// by 8 mu L Q / (pi r^4) along a tube of length L and radius r; flow is conserved at forks. Node
// i's tube runs from its parent to it and has its radius. SI units throughout.
#ifndef RAMIFY_OUTTREE_FLOW_H
#define RAMIFY_OUTTREE_FLOW_H

#include "outtree/segments.h"

typedef enum FlowViscosity {
    FLOW_CONSTANT, // 3.5 mPa s in every vessel, as Murray assumes
    // as measured in microvessels in vivo, dependent on diameter and hematocrit (Pries 1994)
    FLOW_MEASURED
} FlowViscosity;

// What is equal at all ends of a tree.
typedef enum FlowEnds {
    FLOW_EQUAL_PRESSURE, // flow divides by the resistances of the subtrees
    FLOW_EQUAL_FLOW      // as Murray's radii assume
} FlowEnds;

typedef struct FlowParams {
    FlowViscosity viscosity;
    FlowEnds ends;
    float hematocrit;      // volume of cells per volume of blood, 0 .. below 1; FLOW_MEASURED
    float velocity;        // m/s, mean over the section of each root, > 0
    float pressure;        // Pa, at the roots
    int32_t returning;     // colony whose flow runs from the ends to the root (veins); -1 = none
    float return_pressure; // Pa, at its roots
} FlowParams;

// An aorta: 0.2 m/s, 13.3 kPa (100 mmHg); veins 0.7 kPa; hematocrit 0.45; constant viscosity, equal
// pressure at the ends.
FlowParams flow_params_default(void);

// One entry per node, of the tube that ends there; a root has the sum of its tubes' flow and no
// resistance.
typedef struct Flow {
    double *flow;       // m^3/s, >= 0; toward the root in trees that return
    double *pressure;   // Pa, at the node
    double *viscosity;  // Pa s
    double *resistance; // Pa s/m^3
} Flow;

// ERROR_INPUT when a tube has no radius.
bool flow_init(Flow *flow, const OutTree *tree, const FlowParams *params, Error *e);
void flow_free(Flow *flow);

// Viscosity (Pa s) of blood in a vessel of this radius (m).
double flow_viscosity(const FlowParams *params, double radius);

// Mean shear (Pa) at the wall of a tube: 4 mu Q / (pi r^3).
double flow_wall_shear(double viscosity, double flow, double radius);

#define BLOOD_DENSITY 1060.0 // kg/m^3

// Stiffness E h / r of the wall (Pa), dependent on the radius (m), as fitted to arteries (Olufsen
// 1999).
double flow_wall_stiffness(double radius);

// A segment as lumped elements in series: its tubes' sums.
typedef struct FlowLumped {
    double resistance; // Pa s/m^3: 8 mu L / (pi r^4)
    double inertance;  // Pa s^2/m^3: rho L / (pi r^2)
    double compliance; // m^3/Pa: 3 pi r^3 L / (2 E h), of a thin incompressible wall
} FlowLumped;

FlowLumped flow_lumped(const Flow *flow, const OutTree *tree, const Segment *segment);

#endif
