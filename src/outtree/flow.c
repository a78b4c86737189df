#include "outtree/flow.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <stdlib.h>

#define PI 3.14159265358979323846
#define MURRAY_VISCOSITY 3.5e-3 // Pa s
#define PLASMA_VISCOSITY 1.2e-3 // Pa s
#define LEAST_LENGTH 1e-6       // of a tube, in radii: nodes may coincide

FlowParams flow_params_default(void)
{
    return (FlowParams){.hematocrit = 0.45f,
                        .velocity = 0.2f,
                        .pressure = 13300.0f,
                        .returning = -1,
                        .return_pressure = 700.0f};
}

static double power(double x, double exponent)
{
    return x > 0.0 ? exact_exp(exponent * exact_log(x)) : 0.0;
}

// Relative apparent viscosity in vivo (Pries 1994, eqs. 1 to 4); diameter in micrometres.
static double pries_viscosity(double diameter, double hematocrit)
{
    double d = diameter > 2.5 ? diameter : 2.5; // the law's range begins with capillaries
    double far = 1.0 / (1.0 + 1e-11 * power(d, 12.0));
    double shape = (0.8 + exact_exp(-0.075 * d)) * (far - 1.0) + far;
    double at_45 = 6.0 * exact_exp(-0.085 * d) + 3.2 - 2.44 * exact_exp(-0.06 * power(d, 0.645));
    double cells = (power(1.0 - hematocrit, shape) - 1.0) / (power(1.0 - 0.45, shape) - 1.0);
    double wall = d / (d - 1.1) * (d / (d - 1.1));
    return (1.0 + (at_45 - 1.0) * cells * wall) * wall;
}

double flow_viscosity(const FlowParams *params, double radius)
{
    return params->viscosity == FLOW_CONSTANT
               ? MURRAY_VISCOSITY
               : PLASMA_VISCOSITY * pries_viscosity(2e6 * radius, (double)params->hematocrit);
}

double flow_wall_shear(double viscosity, double flow, double radius)
{
    return 4.0 * viscosity * flow / (PI * radius * radius * radius);
}

static bool find_resistances(Flow *flow, const OutTree *tree, const FlowParams *params, Error *e)
{
    for (int64_t i = 0; i < tree->count; i++) {
        double r = (double)tree->radius[i];
        int32_t parent = tree->parent[i];
        if (!(r > 0.0)) {
            return error_set(e, ERROR_INPUT,
                             "node %lld has radius 0; flow needs vessels with a radius",
                             (long long)i);
        }
        double length =
            parent < 0 ? 0.0 : (double)vec3_distance(tree->position[i], tree->position[parent]);
        length = parent >= 0 && length < LEAST_LENGTH * r ? LEAST_LENGTH * r : length;
        flow->viscosity[i] = flow_viscosity(params, r);
        flow->resistance[i] = 8.0 * flow->viscosity[i] * length / (PI * r * r * r * r);
    }
    return true;
}

// share[i]: what node i takes of its parent's flow, relative to its siblings: the number of ends,
// or the conductance of the subtree with the tube to it. below[i]: the sum of its children's.
static void find_shares(const Flow *flow, const OutTree *tree, FlowEnds ends, double *share,
                        double *below)
{
    for (int64_t i = 0; i < tree->count; i++) {
        below[i] = 0.0;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        if (ends == FLOW_EQUAL_FLOW) {
            share[i] = below[i] > 0.0 ? below[i] : 1.0;
        } else if (tree->parent[i] >= 0) {
            share[i] = 1.0 / (flow->resistance[i] + (below[i] > 0.0 ? 1.0 / below[i] : 0.0));
        }
        if (tree->parent[i] >= 0) {
            below[tree->parent[i]] += share[i];
        }
    }
}

static void distribute(Flow *flow, const OutTree *tree, const FlowParams *params,
                       const double *share, const double *below)
{
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        double r = (double)tree->radius[i];
        bool returns = tree->colony[i] == params->returning;
        if (parent < 0) {
            flow->flow[i] = (double)params->velocity * PI * r * r;
            flow->pressure[i] = (double)(returns ? params->return_pressure : params->pressure);
        } else {
            flow->flow[i] = flow->flow[parent] * (share[i] / below[parent]);
            double drop = flow->flow[i] * flow->resistance[i];
            flow->pressure[i] = flow->pressure[parent] + (returns ? drop : -drop);
        }
    }
}

bool flow_init(Flow *flow, const OutTree *tree, const FlowParams *params, Error *e)
{
    size_t size = sizeof(double);
    *flow = (Flow){.flow = memory_alloc(tree->count, size, e),
                   .pressure = memory_alloc(tree->count, size, e),
                   .viscosity = memory_alloc(tree->count, size, e),
                   .resistance = memory_alloc(tree->count, size, e)};
    double *share = memory_alloc(tree->count, size, e), *below = memory_alloc(tree->count, size, e);
    bool done = flow->flow && flow->pressure && flow->viscosity && flow->resistance && share &&
                below && find_resistances(flow, tree, params, e);
    if (done) {
        find_shares(flow, tree, params->ends, share, below);
        distribute(flow, tree, params, share, below);
    } else {
        flow_free(flow);
    }
    free(share);
    free(below);
    return done;
}

void flow_free(Flow *flow)
{
    free(flow->flow);
    free(flow->pressure);
    free(flow->viscosity);
    free(flow->resistance);
    *flow = (Flow){0};
}

double flow_wall_stiffness(double radius)
{
    return 2e6 * exact_exp(-2253.0 * radius) + 8.65e4;
}

FlowLumped flow_lumped(const Flow *flow, const OutTree *tree, const Segment *segment)
{
    FlowLumped sum = {0};
    for (int32_t i = segment->to; i != segment->from; i = tree->parent[i]) {
        double r = (double)tree->radius[i], area = PI * r * r;
        double length = (double)vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
        sum.resistance += flow->resistance[i];
        sum.inertance += BLOOD_DENSITY * length / area;
        sum.compliance += 1.5 * area * length / flow_wall_stiffness(r);
    }
    return sum;
}
