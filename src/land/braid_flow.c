// The water: local inertial flow between cells.
#include "land/braid_parts.h"

#define DAMPING 0.85f // share of a flow's own inertia; the rest is its neighbours'

float braid_step_limit(const Braid *b)
{
    float deepest = (float)b->mean;
    for (int row = 0; row < b->side; row++) {
        const float *depth = b->depth + (int64_t)row * b->side;
        for (int c = b->span[row].begin; c < b->span[row].end; c++) {
            deepest = depth[c] > deepest ? depth[c] : deepest;
        }
    }
    return 0.45f * (float)b->cell / sqrtf((float)BRAID_GRAVITY * deepest);
}

typedef struct FlowStep {
    float push;     // g * step / cell
    float friction; // step * friction coefficient
    float drop;     // m between rows
    float dry;      // m
} FlowStep;

// The flow through a side after a step. mean: of it and its neighbours along the flow; across: the
// flow along the side. Heights of bed and surface above and below, the fall added to those above.
static inline float flow_after(const FlowStep *s, float mean, float across, float bed_a,
                               float top_a, float bed_b, float top_b)
{
    float top = top_a > top_b ? top_a : top_b, sill = bed_a > bed_b ? bed_a : bed_b;
    float depth = top - sill, amount = sqrtf(mean * mean + across * across);
    float wet = depth > s->dry ? depth : s->dry;
    float q =
        (mean + s->push * wet * (top_a - top_b)) / (1.0f + s->friction * amount / (wet * wet));
    return depth > s->dry ? q : 0.0f;
}

static void flow_row(Braid *b, const FlowStep *s, int row)
{
    int side = b->side;
    int64_t here = (int64_t)row * side, north = (int64_t)((row + side - 1) % side) * side;
    int64_t south = (int64_t)((row + 1) % side) * side;
    const float *g = b->ground + here, *h = b->depth + here, *x = b->flow_x + here;
    const float *z = b->flow_z + here, *gn = b->ground + north, *hn = b->depth + north;
    const float *xn = b->flow_x + north, *zn = b->flow_z + north, *zs = b->flow_z + south;
    float *to_x = b->next_x + here, *to_z = b->next_z + here;
    float side_share = 0.5f * (1.0f - DAMPING);
    int begin = b->span[row].begin, end = b->span[row].end;
    to_x[0] = 0.0f;
#pragma omp simd
    for (int c = begin > 1 ? begin : 1; c < end; c++) {
        float after = c + 1 < side ? x[c + 1] : 0.0f;
        float mean = DAMPING * x[c] + side_share * (x[c - 1] + after);
        float across = 0.25f * (z[c - 1] + z[c] + zs[c - 1] + zs[c]);
        to_x[c] = flow_after(s, mean, across, g[c - 1], g[c - 1] + h[c - 1], g[c], g[c] + h[c]);
    }
#pragma omp simd
    for (int c = begin; c < end; c++) {
        float mean = DAMPING * z[c] + side_share * (zn[c] + zs[c]);
        float xe = c + 1 < side ? x[c + 1] + xn[c + 1] : 0.0f, across = 0.25f * (x[c] + xn[c] + xe);
        float bed = gn[c] + s->drop;
        to_z[c] = flow_after(s, mean, across, bed, bed + hn[c], g[c], g[c] + h[c]);
    }
}

static inline float positive(float value)
{
    return value > 0.0f ? value : 0.0f;
}

// The share of its outflow that each cell of a row can give.
static void limit_row(Braid *b, float scale, int row)
{
    int side = b->side;
    int64_t here = (int64_t)row * side, south = (int64_t)((row + 1) % side) * side;
    const float *x = b->next_x + here, *z = b->next_z + here, *zs = b->next_z + south;
    int begin = b->span[row].begin, end = b->span[row].end;
#pragma omp simd
    for (int c = begin; c < end; c++) {
        float east = c + 1 < side ? x[c + 1] : 0.0f;
        float out = positive(-x[c]) + positive(east) + positive(-z[c]) + positive(zs[c]);
        out *= scale;
        float depth = b->depth[here + c];
        b->share[here + c] = out > depth ? depth / out : 1.0f;
    }
}

static inline float given(float flow, float share_before, float share_after)
{
    return flow * (flow > 0.0f ? share_before : share_after);
}

static void fill_row(Braid *b, float scale, int row)
{
    int side = b->side;
    int64_t here = (int64_t)row * side, north = (int64_t)((row + side - 1) % side) * side;
    int64_t south = (int64_t)((row + 1) % side) * side;
    const float *x = b->next_x + here, *z = b->next_z + here, *zs = b->next_z + south;
    const float *share = b->share + here, *sn = b->share + north, *ss = b->share + south;
    float *h = b->depth + here;
    int begin = b->span[row].begin, end = b->span[row].end;
#pragma omp simd
    for (int c = begin; c < end; c++) {
        float west = c > 0 ? given(x[c], share[c - 1], share[c]) : 0.0f;
        float east = c + 1 < side ? given(x[c + 1], share[c], share[c + 1]) : 0.0f;
        float in = west - east + given(z[c], sn[c], share[c]) - given(zs[c], share[c], ss[c]);
        h[c] = positive(h[c] + scale * in);
    }
}

static void swap_flows(Braid *b)
{
    float *x = b->flow_x, *z = b->flow_z;
    b->flow_x = b->next_x;
    b->flow_z = b->next_z;
    b->next_x = x;
    b->next_z = z;
}

void braid_flow(Braid *b, float step, int threads)
{
    FlowStep s = {.push = (float)(BRAID_GRAVITY / b->cell) * step,
                  .friction = step * (float)(b->slope / (BRAID_FROUDE * BRAID_FROUDE)),
                  .drop = (float)(b->slope * b->cell),
                  .dry = (float)(BRAID_DRY * b->mean)};
    float scale = step / (float)b->cell;
    braid_widen(b);
#pragma omp parallel num_threads(threads)
    {
#pragma omp for schedule(static)
        for (int row = 0; row < b->side; row++) {
            flow_row(b, &s, row);
        }
#pragma omp for schedule(static)
        for (int row = 0; row < b->side; row++) {
            limit_row(b, scale, row);
        }
#pragma omp for schedule(static)
        for (int row = 0; row < b->side; row++) {
            fill_row(b, scale, row);
        }
    }
    swap_flows(b);
    for (int row = 0; row < b->side; row++) {
        b->wet[row] = braid_wet_span(b, b->span[row], row);
    }
}
