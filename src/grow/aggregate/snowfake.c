#include "grow/aggregate/snowfake.h"

#include "base/memory.h"
#include "base/random.h"
#include "base/vec.h"

#include <stdlib.h>

enum {
    UNIT = 1 << 22,             // of mass: seven cells of vapour fit 32 bits
    ICE = -1,                   // vapour of a cell of the crystal
    LEAST_ROWS = 64,            // for which more than one thread pays
    MOST_STEPS_PER_CELL = 3000, // of the tips' advance, after which it counts as standing still
    PROGRESS_STEPS = 512
};

// The lattice about the crystal. Cells outside its active hexagon hold the vapour of the air far
// away.
typedef struct Lattice {
    int radius, width; // of the arrays
    int active;        // radius of the hexagon in which vapour diffuses
    int32_t *vapour, *next;
    int32_t *quasi_liquid; // boundary mass
    int32_t *ice;          // crystal mass
    int32_t *born;         // step at which a cell froze
    uint8_t *neighbours;   // number of neighbours that are ice
    int64_t step[6];       // to the neighbours, in elements
    int64_t *boundary;     // cells beside the crystal, in the order of their appearance
    int64_t boundary_count, boundary_room;
    int size;       // steps from the middle to the farthest tip
    int32_t now;    // number of the step
    int64_t inflow; // mass from outside, in sevenths of the unit
    int32_t far;    // vapour per cell there
} Lattice;

int snowfake_distance(int q, int r)
{
    int s = abs(q + r);
    int most = abs(q) > abs(r) ? abs(q) : abs(r);
    return most > s ? most : s;
}

void snowfake_clear(Snowfake *fake)
{
    free(fake->ice);
    free(fake->born);
    *fake = (Snowfake){0};
}

static void lattice_clear(Lattice *lattice)
{
    free(lattice->vapour);
    free(lattice->next);
    free(lattice->quasi_liquid);
    free(lattice->ice);
    free(lattice->born);
    free(lattice->neighbours);
    free(lattice->boundary);
}

static int64_t cell_at(const Lattice *lattice, int q, int r)
{
    return (int64_t)(r + lattice->radius) * lattice->width + q + lattice->radius;
}

static bool lattice_init(Lattice *lattice, int radius, float far, Error *e)
{
    int width = 2 * radius + 1;
    int64_t cells = (int64_t)width * width;
    *lattice = (Lattice){.radius = radius,
                         .width = width,
                         .far = (int32_t)(far * UNIT),
                         .step = {1, -1, width, -width, 1 - width, width - 1}};
    lattice->vapour = memory_alloc(cells, sizeof *lattice->vapour, e);
    lattice->next = lattice->vapour ? memory_alloc(cells, sizeof *lattice->next, e) : NULL;
    lattice->quasi_liquid = lattice->next ? memory_alloc_zero(cells, sizeof(int32_t), e) : NULL;
    lattice->ice = lattice->quasi_liquid ? memory_alloc_zero(cells, sizeof(int32_t), e) : NULL;
    lattice->born = lattice->ice ? memory_alloc_zero(cells, sizeof(int32_t), e) : NULL;
    lattice->neighbours = lattice->born ? memory_alloc_zero(cells, 1, e) : NULL;
    if (!lattice->neighbours) {
        return false;
    }
    for (int64_t i = 0; i < cells; i++) {
        lattice->vapour[i] = lattice->next[i] = lattice->far;
    }
    return true;
}

// One step of diffusion in row r: each cell takes the mean of itself and its six neighbours; ice
// reflects the vapour (equation (1) of the paper).
static void diffuse_row(const Lattice *lattice, int r)
{
    int inside = lattice->active - 1;
    int first = r < 0 ? -inside - r : -inside;
    int last = r > 0 ? inside - r : inside;
    const int32_t *here = lattice->vapour + cell_at(lattice, first, r);
    const int32_t *below = here - lattice->width, *above = here + lattice->width;
    int32_t *out = lattice->next + cell_at(lattice, first, r);
    for (int i = 0; i <= last - first; i++) {
        int32_t self = here[i];
        int32_t sum = self;
        sum += here[i + 1] < 0 ? self : here[i + 1];
        sum += here[i - 1] < 0 ? self : here[i - 1];
        sum += above[i] < 0 ? self : above[i];
        sum += below[i] < 0 ? self : below[i];
        sum += below[i + 1] < 0 ? self : below[i + 1];
        sum += above[i - 1] < 0 ? self : above[i - 1];
        out[i] = self < 0 ? ICE : (int32_t)((uint32_t)(sum + 3) / 7u);
    }
}

// The vapour that the active hexagon gets from its surroundings in a step.
static int64_t edge_inflow(const Lattice *lattice)
{
    static const int TURN[6][2] = {{0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}, {1, 0}};
    int radius = lattice->active - 1; // the outermost cells that diffuse
    int64_t sum = 0;
    int q = radius, r = -radius;
    for (int side = 0; side < 6; side++) {
        for (int i = 0; i < radius; i++) {
            int64_t lacking = lattice->far - lattice->vapour[cell_at(lattice, q, r)];
            sum += (i == 0 ? 3 : 2) * lacking; // a corner has three neighbours outside
            q += TURN[side][0];
            r += TURN[side][1];
        }
    }
    return sum;
}

static void diffuse(Lattice *lattice, int threads)
{
    int rows = lattice->active - 1;
    lattice->inflow += edge_inflow(lattice);
#pragma omp parallel for schedule(static) num_threads(threads) if (rows > LEAST_ROWS)
    for (int r = -rows; r <= rows; r++) {
        diffuse_row(lattice, r);
    }
    int32_t *old = lattice->vapour;
    lattice->vapour = lattice->next;
    lattice->next = old;
}

static int32_t share(int32_t mass, float part)
{
    return (int32_t)((double)mass * (double)part);
}

// Vapour beside the crystal freezes or becomes boundary mass (equation (2)).
static void freeze(Lattice *lattice, const SnowfakeRates *rates, float noise, uint64_t seed)
{
    for (int64_t i = 0; i < lattice->boundary_count; i++) {
        int64_t cell = lattice->boundary[i];
        int32_t mass = lattice->vapour[cell];
        if (noise > 0.0f) {
            uint64_t key = random_key(seed, (uint64_t)cell);
            mass = share(mass, 1.0f + random_range(key, -noise, noise));
        }
        int32_t frozen = share(mass, rates->kappa);
        lattice->ice[cell] += frozen;
        lattice->quasi_liquid[cell] += mass - frozen;
        lattice->vapour[cell] = 0;
    }
}

// Whether a cell beside the crystal freezes on (section 2 of the paper, iii).
static bool attaches(const Lattice *lattice, int64_t cell, const SnowfakeRates *rates)
{
    int neighbours = lattice->neighbours[cell];
    double mass = (double)lattice->quasi_liquid[cell] / UNIT;
    if (neighbours <= 2) {
        return mass >= (double)rates->beta;
    }
    if (neighbours >= 4 || mass >= 1.0) {
        return true;
    }
    int64_t around = lattice->vapour[cell];
    for (int k = 0; k < 6; k++) {
        int32_t vapour = lattice->vapour[cell + lattice->step[k]];
        around += vapour > 0 ? vapour : 0;
    }
    return mass >= (double)rates->alpha && (double)around / UNIT < (double)rates->theta;
}

static bool add_boundary(Lattice *lattice, int64_t cell, Error *e)
{
    if (!memory_reserve(&lattice->boundary, &lattice->boundary_room, lattice->boundary_count + 1,
                        sizeof *lattice->boundary, e)) {
        return false;
    }
    lattice->boundary[lattice->boundary_count++] = cell;
    return true;
}

static bool become_ice(Lattice *lattice, int64_t cell, Error *e)
{
    lattice->ice[cell] += lattice->quasi_liquid[cell];
    lattice->quasi_liquid[cell] = 0;
    lattice->vapour[cell] = lattice->next[cell] = ICE;
    lattice->born[cell] = lattice->now;
    int r = (int)(cell / lattice->width) - lattice->radius;
    int q = (int)(cell % lattice->width) - lattice->radius;
    int distance = snowfake_distance(q, r);
    lattice->size = distance > lattice->size ? distance : lattice->size;
    for (int k = 0; k < 6; k++) {
        int64_t beside = cell + lattice->step[k];
        if (lattice->vapour[beside] != ICE && lattice->neighbours[beside]++ == 0 &&
            !add_boundary(lattice, beside, e)) {
            return false;
        }
    }
    return true;
}

// Freezes on the cells that are ripe. All are chosen before the first one changes its neighbours.
static bool attach(Lattice *lattice, const SnowfakeRates *rates, Error *e)
{
    int64_t count = lattice->boundary_count, ripe = 0;
    for (int64_t i = 0; i < count; i++) {
        int64_t cell = lattice->boundary[i];
        if (attaches(lattice, cell, rates)) {
            lattice->boundary[i] = -1 - cell;
            ripe++;
        }
    }
    for (int64_t i = 0; i < count && ripe; i++) {
        if (lattice->boundary[i] < 0 && !become_ice(lattice, -1 - lattice->boundary[i], e)) {
            return false;
        }
    }
    int64_t kept = 0;
    for (int64_t i = 0; i < lattice->boundary_count && ripe; i++) {
        if (lattice->boundary[i] >= 0) {
            lattice->boundary[kept++] = lattice->boundary[i];
        }
    }
    lattice->boundary_count = ripe ? kept : count;
    return true;
}

// Boundary mass and ice evaporate (equation (3)).
static void melt(Lattice *lattice, const SnowfakeRates *rates)
{
    for (int64_t i = 0; i < lattice->boundary_count; i++) {
        int64_t cell = lattice->boundary[i];
        int32_t liquid = share(lattice->quasi_liquid[cell], rates->mu);
        int32_t ice = share(lattice->ice[cell], rates->gamma);
        lattice->quasi_liquid[cell] -= liquid;
        lattice->ice[cell] -= ice;
        lattice->vapour[cell] += liquid + ice;
    }
}

// Mass inside the active hexagon.
static int64_t total_mass(const Lattice *lattice)
{
    int inside = lattice->active - 1;
    int64_t sum = 0;
    for (int r = -inside; r <= inside; r++) {
        for (int q = -inside; q <= inside; q++) {
            if (snowfake_distance(q, r) <= inside) {
                int64_t cell = cell_at(lattice, q, r);
                int32_t vapour = lattice->vapour[cell];
                sum += lattice->ice[cell] + lattice->quasi_liquid[cell] + (vapour > 0 ? vapour : 0);
            }
        }
    }
    return sum;
}

static int64_t hexagon_cells(int radius)
{
    return 1 + 3 * (int64_t)radius * (radius + 1);
}

// The hexagon in which vapour diffuses stays well ahead of the tips.
static void widen(Lattice *lattice)
{
    int wanted = lattice->size * 7 / 5 + 24;
    if (wanted > lattice->active) {
        int64_t more = hexagon_cells(wanted - 1) - hexagon_cells(lattice->active - 1);
        lattice->inflow += 7 * more * lattice->far;
        lattice->active = wanted;
    }
}

SnowfakeRates snowfake_rates_between(const SnowfakeRates *a, const SnowfakeRates *b, float t)
{
    return (SnowfakeRates){.rho = lerpf(a->rho, b->rho, t),
                           .beta = lerpf(a->beta, b->beta, t),
                           .alpha = lerpf(a->alpha, b->alpha, t),
                           .theta = lerpf(a->theta, b->theta, t),
                           .kappa = lerpf(a->kappa, b->kappa, t),
                           .mu = lerpf(a->mu, b->mu, t),
                           .gamma = lerpf(a->gamma, b->gamma, t)};
}

static SnowfakeRates rates_at(const SnowfakeParams *params, int size)
{
    float at = (float)size / (float)params->radius * (float)(params->life_count - 1);
    int i = (int)at;
    if (i >= params->life_count - 1) {
        return params->life[params->life_count - 1];
    }
    return snowfake_rates_between(&params->life[i], &params->life[i + 1], at - (float)i);
}

static bool step(Lattice *lattice, const SnowfakeParams *params, int64_t number, int threads,
                 Error *e)
{
    SnowfakeRates rates = rates_at(params, lattice->size);
    lattice->now = (int32_t)number;
    diffuse(lattice, threads);
    freeze(lattice, &rates, params->noise, random_key(params->seed, (uint64_t)number));
    if (!attach(lattice, &rates, e)) {
        return false;
    }
    melt(lattice, &rates);
    widen(lattice);
    return true;
}

static bool grow(Lattice *lattice, const SnowfakeParams *params, const Run *run, int64_t *steps,
                 Error *e)
{
    int reached = 0;
    int64_t since = 0;
    for (int64_t number = 0; lattice->size < params->radius; number++) {
        if (number % PROGRESS_STEPS == 0) {
            run_progress(run, "grow", (double)lattice->size / params->radius);
            if (run_is_cancelled(run)) {
                return run_cancel_error(e);
            }
        }
        if (!step(lattice, params, number, run->threads, e)) {
            return false;
        }
        if (lattice->size > reached) {
            reached = lattice->size;
            since = number;
        }
        if (number - since > MOST_STEPS_PER_CELL) {
            return error_set(e, ERROR_INPUT,
                             "the crystal stands still after %d of %d cells: the air holds too "
                             "little vapour",
                             lattice->size, params->radius);
        }
        *steps = number + 1;
    }
    return true;
}

static bool take_ice(const Lattice *lattice, int radius, Snowfake *fake, Error *e)
{
    *fake = (Snowfake){.radius = radius, .width = 2 * radius + 1};
    int64_t cells = (int64_t)fake->width * fake->width;
    fake->ice = memory_alloc_zero(cells, sizeof *fake->ice, e);
    fake->born = fake->ice ? memory_alloc_zero(cells, sizeof *fake->born, e) : NULL;
    if (!fake->born) {
        snowfake_clear(fake);
        return false;
    }
    for (int r = -radius; r <= radius; r++) {
        for (int q = -radius; q <= radius; q++) {
            int64_t cell = cell_at(lattice, q, r);
            if (lattice->vapour[cell] == ICE) {
                int64_t to = snowfake_cell(fake, q, r);
                fake->ice[to] = (float)lattice->ice[cell] / UNIT;
                fake->born[to] = (float)lattice->born[cell] / (float)(lattice->now + 1);
            }
        }
    }
    return true;
}

bool snowfake_grow(const SnowfakeParams *params, const Run *run, Snowfake *fake, Error *e)
{
    *fake = (Snowfake){0};
    Lattice lattice;
    bool good = lattice_init(&lattice, params->radius * 7 / 5 + 32, params->life[0].rho, e);
    if (good) {
        lattice.ice[cell_at(&lattice, 0, 0)] = UNIT;
        widen(&lattice);
        lattice.inflow = 0;
        int64_t start = hexagon_cells(lattice.active - 1) * lattice.far - lattice.far + UNIT;
        int64_t steps = 0;
        good = become_ice(&lattice, cell_at(&lattice, 0, 0), e) &&
               grow(&lattice, params, run, &steps, e) &&
               take_ice(&lattice, params->radius, fake, e);
        if (good) {
            double given = (double)start + (double)lattice.inflow / 7.0;
            fake->steps = steps;
            fake->mass_error = ((double)total_mass(&lattice) - given) / given;
        }
    }
    lattice_clear(&lattice);
    return good;
}
