// A cone of ash and scoria that one vent has thrown up (Wood 1980): straight flanks at repose, a
// wide crater with a steep inside, a rim that is higher to the lee and lower where the last
// explosions broke it, an apron of what has rolled and washed down.
#include "base/exact_math.h"
#include "base/random.h"
#include "objects/terrain/noise.h"
#include "objects/terrain/volcano.h"

#include <math.h>

// How concave the flanks are: 0 = straight, of cinder cones; 1 = each metre gentler than the one
// above.
static double concavity(const Volcano *v)
{
    return (double)smoothstepf(400.0f, 1800.0f, (float)v->relief);
}

double volcano_half_radius(const Volcano *v)
{
    double drawn_out = v->params.volcano.kind == VOLCANO_ASH ? concavity(v) : 1.0;
    double way = 0.5 + (0.693 - 0.5) * drawn_out;
    return v->summit.rim + way * v->relief / VOLCANO_STEEPEST;
}

// Height of the cone above the plain, m.
static double ash_height(const Volcano *v, const Away *away, uint64_t key)
{
    const double inside = 0.85; // tangent: ash that stands in its own beds
    double r = away->r > 0.0 ? away->r : 1.0, rim = v->summit.rim;
    double x = away->dx / r, z = away->dz / r, lee = x * v->wind[0] + z * v->wind[1];
    float oval = sparse_noise_fractal((float)(0.9 * x), (float)(0.9 * z), 2, 0.4f, 0.0f, key);
    float notch = sparse_noise_fractal((float)(1.7 * x), (float)(1.7 * z), 5, 0.65f, 0.3f, key + 1);
    double out = away->r - rim * (1.0 + 0.12 * (double)clampf(oval, -1.6f, 1.6f));
    double below = out > 0.0 ? out : 0.0; // notches of the rim do not go far down the flank
    double broken = 0.07 * (double)clampf(notch, -1.5f, 1.5f) * exact_exp(-below / (0.3 * rim));
    double top = v->relief * (1.0 + 0.07 * lee + broken), fall = VOLCANO_STEEPEST * below;
    double straight = top - fall + inside * (out - below);
    double cone = straight + concavity(v) * (fall - top * (1.0 - exact_exp(-fall / top)));
    double floor = out < 0.0 ? 0.45 * v->relief : 0.0;
    double apron = 0.12 * v->relief * exact_exp(-below / v->relief);
    return fmax(cone, fmax(floor, apron));
}

void volcano_heap_ash(const Volcano *v, Landscape *land)
{
    uint64_t key = random_key(v->terrain->seed, STREAM_CRATER);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        if (!land->base[i]) {
            Away away = volcano_away(land, &v->summit, i);
            double high = ash_height(v, &away, key);
            land->rock[i] += high;
            land->uplifted += high * land->cell * land->cell;
        }
    }
}
