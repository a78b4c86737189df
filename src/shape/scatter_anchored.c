// Points that stay fixed when the envelope moves or changes: each is a point of a lattice fixed in
// space, and the region only decides whether it exists. Candidates come in levels of cells, each
// level half as wide as the one before, seven candidates per cell. All coarser levels and a share
// of the finest, chosen by each candidate's own random rank, give the density wanted. A slightly
// higher density adds a few points and moves none.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "shape/scatter.h"

#include <math.h>
#include <stdlib.h>

enum { LEVELS = 8, CANDIDATES_PER_CELL = 7 };
// the mean spacing is rounded to one of these, so that it stays fixed too
#define SPACINGS_PER_OCTAVE 4.0
#define MAX_CANDIDATES 4e9
#define MAX_LEVELS 100.0 // halvings: finer than any number of candidates that could be counted
#define SLAB 0.5         // half the thickness of the layer projected onto the surface, in spacings

typedef struct LatticeLevel {
    double size; // cell width, m
    int64_t low[3], cells[3];
    int64_t first; // first candidate of the level
    double share;  // share of its candidates that exist
} LatticeLevel;

typedef struct Lattice {
    const Scatter *scatter;
    LatticeLevel level[LEVELS];
    int64_t count; // total candidates
    double inverse_scale;
    float slab; // m; 0 = a volume
} Lattice;

// Appends a level. All levels down to cells of width h together hold 8 / h^3 candidates per unit
// volume.
static void set_level(Lattice *lattice, int index, double size, double share, Aabb bounds)
{
    LatticeLevel *level = &lattice->level[index];
    Vec3 anchor = lattice->scatter->params->anchor;
    const double low[3] = {(double)bounds.low.x - (double)anchor.x,
                           (double)bounds.low.y - (double)anchor.y,
                           (double)bounds.low.z - (double)anchor.z};
    const double high[3] = {(double)bounds.high.x - (double)anchor.x,
                            (double)bounds.high.y - (double)anchor.y,
                            (double)bounds.high.z - (double)anchor.z};
    *level = (LatticeLevel){.size = size, .first = lattice->count, .share = share};
    int64_t cells = 1;
    for (int i = 0; i < 3; i++) {
        level->low[i] = (int64_t)floor(low[i] / size);
        level->cells[i] = (int64_t)floor(high[i] / size) - level->low[i] + 1;
        cells *= level->cells[i];
    }
    lattice->count += cells * CANDIDATES_PER_CELL;
}

// The region's box at the level's scale, widened by the slab about a surface.
static Aabb region_bounds(const Scatter *s, float slab)
{
    Aabb box = envelope_bounds(s->envelope);
    Vec3 margin = vec3_splat(slab);
    box.low = vec3_madd(s->center, s->params->scale, vec3_sub(box.low, s->center));
    box.high = vec3_madd(s->center, s->params->scale, vec3_sub(box.high, s->center));
    return (Aabb){vec3_sub(box.low, margin), vec3_add(box.high, margin)};
}

// 2^x for integer x.
static double power_of_two(int x)
{
    double power = 1.0;
    for (; x > 0; x--) {
        power *= 2.0;
    }
    for (; x < 0; x++) {
        power *= 0.5;
    }
    return power;
}

static bool lattice_init(Lattice *lattice, const Scatter *s, double spacing, Error *e)
{
    *lattice = (Lattice){.scatter = s, .inverse_scale = 1.0 / (double)s->params->scale};
    double density = 1.0 / (spacing * spacing * spacing * s->mean_weight);
    if (s->params->place == SCATTER_SURFACE) {
        float band = 0.8f * envelope_band(s->envelope) * s->params->scale;
        lattice->slab = fminf((float)(SLAB * spacing), band);
        density *= spacing / (2.0 * (double)lattice->slab);
    }
    double levels = ceil(exact_log(density / 8.0) / (3.0 * exact_log(2.0)));
    int finest = (int)fmin(levels, MAX_LEVELS); // clamped to fit an int; refused below
    Aabb bounds = region_bounds(s, lattice->slab);
    Vec3 size = vec3_sub(bounds.high, bounds.low);
    double cell = power_of_two(-finest), candidates = 10.0;
    candidates *= ((double)size.x / cell + 2.0) * ((double)size.y / cell + 2.0);
    if (!(candidates * ((double)size.z / cell + 2.0) < MAX_CANDIDATES)) {
        return scatter_empty_error(s, (int64_t)MAX_CANDIDATES, e);
    }
    for (int i = 0; i < LEVELS; i++) {
        int exponent = finest - LEVELS + 1 + i;
        double full = power_of_two(3 * exponent); // density of the coarser levels together
        double share = i < LEVELS - 1 ? 1.0 : (density - full) / (7.0 * full);
        set_level(lattice, i, power_of_two(-exponent), share, bounds);
    }
    return true;
}

// Projects a point of the slab onto the surface; false when it lies outside the slab.
static bool settle_on_surface(const Lattice *lattice, Vec3 p, float scale, Draw *draw)
{
    const Envelope *envelope = lattice->scatter->envelope;
    float distance = envelope_distance(envelope, p), h = 0.25f * lattice->slab / scale;
    if (!(fabsf(distance) * scale < lattice->slab)) {
        return false;
    }
    Vec3 slope;
    slope.x = envelope_distance(envelope, vec3_add(p, vec3(h, 0, 0))) -
              envelope_distance(envelope, vec3_add(p, vec3(-h, 0, 0)));
    slope.y = envelope_distance(envelope, vec3_add(p, vec3(0, h, 0))) -
              envelope_distance(envelope, vec3_add(p, vec3(0, -h, 0)));
    slope.z = envelope_distance(envelope, vec3_add(p, vec3(0, 0, h))) -
              envelope_distance(envelope, vec3_add(p, vec3(0, 0, -h)));
    draw->normal = vec3_dot(slope, slope) > 0.0f ? vec3_normalize(slope) : vec3(0, 1, 0);
    draw->position = vec3_madd(draw->position, -distance * scale, draw->normal);
    return true;
}

static double unit_double(uint64_t key)
{
    return (double)(random_mix(key) >> 11) * 0x1p-53;
}

// Evaluates candidate number n.
static Draw lattice_draw(const Lattice *lattice, int64_t n)
{
    const Scatter *s = lattice->scatter;
    int l = LEVELS - 1;
    while (n < lattice->level[l].first) {
        l--;
    }
    const LatticeLevel *level = &lattice->level[l];
    int64_t cell = (n - level->first) / CANDIDATES_PER_CELL, at[3];
    at[0] = level->low[0] + cell % level->cells[0];
    at[1] = level->low[1] + cell / level->cells[0] % level->cells[1];
    at[2] = level->low[2] + cell / level->cells[0] / level->cells[1];
    // keyed by the cell width, not by the level's number, which depends on the density
    uint64_t key = random_key(s->params->seed, (uint64_t)(int64_t)(level->size * 0x1p40));
    for (int i = 0; i < 3; i++) {
        key = random_key(key, (uint64_t)at[i]);
    }
    key = random_key(key, (uint64_t)((n - level->first) % CANDIDATES_PER_CELL));
    Draw draw = {.id = key, .normal = vec3(0, 1, 0)};
    if (unit_double(random_key(key, STREAM_LEVEL)) >= level->share) {
        return draw;
    }
    double p[3];
    for (int i = 0; i < 3; i++) {
        p[i] = ((double)at[i] + unit_double(random_key(key, STREAM_POSITION + (uint64_t)i))) *
               level->size;
    }
    Vec3 anchor = s->params->anchor;
    draw.position = vec3((float)((double)anchor.x + p[0]), (float)((double)anchor.y + p[1]),
                         (float)((double)anchor.z + p[2]));
    // the same point relative to the unscaled envelope
    Vec3 inner =
        vec3_madd(s->center, (float)lattice->inverse_scale, vec3_sub(draw.position, s->center));
    draw.inside = lattice->slab > 0.0f ? settle_on_surface(lattice, inner, s->params->scale, &draw)
                                       : envelope_contains(s->envelope, inner);
    draw.kept = draw.inside && scatter_faces(s, draw.normal) && scatter_keeps(s, inner, key);
    return draw;
}

// The allowed spacing nearest to the one that gives params->count points.
static double choose_spacing(const PointSet *points, int64_t count)
{
    double octave = exact_log(2.0) / SPACINGS_PER_OCTAVE;
    double share = points->measure / (double)count;
    double wanted = exact_log(share) / (double)points->dimension;
    return exact_exp(octave * floor(wanted / octave + 0.5));
}

bool scatter_anchored(const Scatter *s, PointSet *points, const Run *run, Error *e)
{
    double spacing = choose_spacing(points, s->params->count);
    Lattice lattice;
    if (!lattice_init(&lattice, s, spacing, e)) {
        return false;
    }
    Draw *draws = memory_alloc(SCATTER_ROUND, sizeof *draws, e);
    bool done = draws;
    for (int64_t first = 0; done && first < lattice.count; first += SCATTER_ROUND) {
        int64_t left = lattice.count - first, size = left < SCATTER_ROUND ? left : SCATTER_ROUND;
#pragma omp parallel for schedule(dynamic, 1024) num_threads(run->threads)
        for (int64_t i = 0; i < size; i++) {
            draws[i] = lattice_draw(&lattice, first + i);
        }
        for (int64_t i = 0; done && i < size; i++) {
            done = !draws[i].kept ||
                   points_add(points, draws[i].position, draws[i].normal, draws[i].id, e);
        }
        if (done && run_is_cancelled(run)) {
            done = run_cancel_error(e);
        }
        run_progress(run, "scatter", (double)first / (double)lattice.count);
    }
    free(draws);
    double square = spacing * spacing, area = (double)points->count * square;
    // makes points_spacing return this spacing
    points->measure = points->dimension == 3 ? area * spacing : area;
    return done && (points->count > 0 || scatter_empty_error(s, lattice.count, e));
}
