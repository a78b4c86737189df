// Barrancos: the gullies that rain cuts into a cone of ash, side by side like the folds of a
// half-open umbrella (parasol ribbing, Ollier 1988). Rain finds grooves about as far apart as asked
// for, and all that it then does is its own: gullies deepen by the water that they gather, walls
// fall to what ash bears, so that the ribs between them are as sharp as a knife, and side gullies
// grow on ever finer grids.
#include "base/exact_math.h"
#include "base/random.h"
#include "objects/terrain/noise.h"
#include "objects/terrain/volcano.h"

#include <math.h>

static const double TURN = 6.283185307179586;

// A groove down the flank.
typedef struct Groove {
    double turn; // radians, clockwise from +x seen from above
    double head; // where it begins: share of the way from the rim to half the height
} Groove;

// Those that are there at half the height, then half as many that begin below it.
enum { MOST_GROOVES = VOLCANO_MOST_BARRANCOS + VOLCANO_MOST_BARRANCOS / 2 };

typedef struct Grooves {
    Groove groove[MOST_GROOVES];
    int count, upper;
    double apart; // m: at half the height
    double half;  // m: radius there
    uint64_t key;
} Grooves;

// From one to the next at half the height, m; 0 = none are asked for.
static double spacing(const Volcano *v)
{
    int count = v->params.volcano.barrancos;
    return count > 0 ? TURN * volcano_half_radius(v) / count : 0.0;
}

static void place(const Volcano *v, Grooves *g)
{
    g->upper = v->params.volcano.barrancos;
    g->count = g->upper + g->upper / 2;
    g->half = volcano_half_radius(v);
    g->apart = spacing(v);
    g->key = random_key(v->terrain->seed, STREAM_BARRANCOS);
    for (int k = 0; k < g->count; k++) {
        uint64_t own = random_key(g->key, (uint64_t)k);
        bool upper = k < g->upper;
        int of = upper ? g->upper : g->count - g->upper;
        double shift = (double)random_range(random_key(own, 1), -0.3f, 0.3f);
        double late = (double)random_unit(random_key(own, 2));
        g->groove[k] = (Groove){.turn = TURN * ((upper ? k : k - g->upper) + 0.5 + shift) / of,
                                .head = upper ? 0.75 * late * late : 1.15 + 0.5 * late};
    }
}

// Depth of the grooves at a place, m.
static double groove_depth(const Grooves *g, const Volcano *v, const Away *away)
{
    double along = (away->r - v->summit.rim) / (g->half - v->summit.rim);
    if (along <= 0.0 || along > 3.0) {
        return 0.0;
    }
    float wavelength = (float)(2.5 * g->apart);
    float wind = sparse_noise_fractal((float)away->dx / wavelength, (float)away->dz / wavelength, 3,
                                      0.5f, 0.0f, g->key);
    double turn = (double)exact_atan2((float)away->dz, (float)away->dx);
    double across = turn * away->r + 0.13 * g->apart * (double)wind, deepest = 0.0;
    for (int k = 0; k < g->count; k++) {
        double begun = (along - g->groove[k].head) / 0.25;
        if (begun <= 0.0) {
            continue;
        }
        double off = across / away->r - g->groove[k].turn;
        off -= TURN * floor(off / TURN + 0.5);
        double near = 1.0 - fabs(off) * away->r / (0.5 * g->apart);
        double depth = 0.14 * g->apart * near * (begun < 1.0 ? begun : 1.0);
        deepest = depth > deepest ? depth : deepest;
    }
    return deepest;
}

static void groove(const Volcano *v, Landscape *land)
{
    Grooves g;
    place(v, &g);
    double own = land->cell * land->cell;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        Away away = volcano_away(land, &v->summit, i);
        double depth = land->base[i] ? 0.0 : groove_depth(&g, v, &away);
        land->rock[i] -= depth;
        land->outflow += depth * own;
    }
}

double volcano_find_barrancos(const Volcano *v, Landscape *land, bool finest)
{
    const double seen = 5.0; // cells from one to the next
    double cells = spacing(v) / land->cell;
    bool resolved = cells >= seen, before = 0.5 * cells >= seen;
    bool first = land->side <= VOLCANO_FIRST_CELLS + 1;
    if ((resolved && (!before || first)) || (cells > 0.0 && finest && !resolved)) {
        groove(v, land);
        return 0.6;
    }
    return resolved ? 0.2 : 0.0;
}

bool volcano_cut_barrancos(const Volcano *v, Landscape *land, double share, int steps,
                           const Run *run, Error *e)
{
    const double walls = 1.1; // tangent: of ash that is a little consolidated
    if (!(share > 0.0) || v->params.volcano.barrancos <= 0) {
        return true;
    }
    const EvolutionParams *evolution = &v->params.evolution;
    double half = volcano_half_radius(v), apart = spacing(v);
    double gathers = apart * (half - v->summit.rim) / 1.5; // m^2, of a barranco at half the height
    double depth = 0.6 * (double)v->params.volcano.age * apart;
    double incision = depth * (double)evolution->streams /
                      (sqrt(gathers) * VOLCANO_STEEPEST * landscape_erodibility(0.5));
    LandscapeRates rates = {.incision = incision,
                            .loose = incision,
                            .least_area = 2.0 * land->cell * land->cell,
                            .deposition = 0.1 * (double)evolution->deposition,
                            .seed = random_key(v->terrain->seed, STREAM_WATER_WAYS)};
    terrain_add_lumps(land, 0.12 * land->cell, 7.0 * land->cell, v->terrain->seed, run);
    for (int i = 0; i < steps; i++) {
        run_progress(run, "barrancos", (double)i / steps);
        if (!landscape_limit_slopes(land, walls, e) ||
            !landscape_cut_streams(land, &rates, share / steps, run, e)) {
            return false;
        }
    }
    return landscape_limit_slopes(land, walls, e);
}
