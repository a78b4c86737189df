// Measures of the landforms, for targets.
#include "base/exact_math.h"
#include "base/memory.h"
#include "land/dunes_measure.h"
#include "land/valley_profile.h"
#include "objects/terrain/form.h"
#include "objects/terrain/lakes.h"

#include <math.h>
#include <stdlib.h>

typedef struct LandformSurvey {
    const Landscape *land;
    TerrainParams params;
    double river;   // m: mean height of the bases
    double plateau; // m: the height above which a twentieth of the land lies
} LandformSurvey;

static double surface(const Landscape *land, int64_t i)
{
    return land->rock[i] + land->loose[i];
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool find_levels(LandformSurvey *s, Error *e)
{
    const Landscape *land = s->land;
    int64_t count = landscape_count(land), bases = 0;
    double *height = memory_alloc(count, sizeof *height, e);
    for (int64_t i = 0; height && i < count; i++) {
        height[i] = surface(land, i);
        s->river += land->base[i] ? height[i] : 0.0;
        bases += land->base[i];
    }
    if (height) {
        qsort(height, (size_t)count, sizeof *height, ascending);
        s->plateau = height[count - 1 - count / 20];
        s->river = bases > 0 ? s->river / (double)bases : (double)NAN;
    }
    free(height);
    return height;
}

// The median over all rows of the distance between the rims on both sides of the river: that skips
// side canyons. A rim is where the land rises above nine tenths of the depth.
static double canyon_width(const LandformSurvey *s, double *widths)
{
    const Landscape *land = s->land;
    double rim = s->river + 0.9 * (s->plateau - s->river);
    int rows = 0;
    for (int row = 0; row < land->side; row++) {
        int64_t first = (int64_t)row * land->side;
        int from = 0, to = land->side - 1;
        while (from < to && !land->base[first + from]) {
            from++;
        }
        while (to > from && !land->base[first + to]) {
            to--;
        }
        if (!land->base[first + from]) {
            continue;
        }
        while (from > 0 && surface(land, first + from) < rim) {
            from--;
        }
        while (to < land->side - 1 && surface(land, first + to) < rim) {
            to++;
        }
        widths[rows++] = (double)(to - from) * land->cell;
    }
    qsort(widths, (size_t)rows, sizeof *widths, ascending);
    return rows > 0 ? widths[rows / 2] : (double)NAN;
}

// The share of the samples that are above a share of the depth.
static double share_above(const LandformSurvey *s, double level)
{
    int64_t count = landscape_count(s->land), above = 0;
    for (int64_t i = 0; i < count; i++) {
        above += surface(s->land, i) > s->river + level * (s->plateau - s->river);
    }
    return (double)above / (double)count;
}

// m by which a neighbour is lower.
static double fall(const Landscape *land, int64_t i, int64_t step)
{
    return fmax(surface(land, i) - surface(land, i + step), 0.0);
}

// The gradient along the steepest falls of both axes.
static double steepness(const Landscape *land, int64_t i)
{
    double dx = fmax(fall(land, i, 1), fall(land, i, -1));
    double dz = fmax(fall(land, i, land->side), fall(land, i, -land->side));
    return sqrt(dx * dx + dz * dz) / land->cell;
}

static bool is_inner(const Landscape *land, int64_t i)
{
    int64_t column = i % land->side, row = i / land->side;
    return column > 0 && row > 0 && column < land->side - 1 && row < land->side - 1;
}

static bool is_face(const Landscape *land, int64_t i)
{
    const double bare = 0.5; // m
    return is_inner(land, i) && land->loose[i] < bare && steepness(land, i) > 1.0;
}

static bool is_rubble(const Landscape *land, int64_t i)
{
    return is_inner(land, i) && land->loose[i] > 2.0;
}

// Rubble at the foot of a bare face of more than 45 degrees: where talus begins.
static bool is_apex(const Landscape *land, int64_t i)
{
    bool below = false;
    for (int k = 0; k < 9 && is_rubble(land, i); k++) {
        int64_t n = i + (int64_t)(k / 3 - 1) * land->side + k % 3 - 1;
        below = below || (surface(land, n) > surface(land, i) && is_face(land, n));
    }
    return below;
}

// How far down talus reaches at each sample, m, negative: to 27.5 degrees below its apex, the least
// at which blocks come to rest (the shadow angle of Evans and Hungr 1993). The caller frees it.
static Landscape *talus_reach(const Landscape *land, Error *e)
{
    const double nowhere = 1e9, shadow = 0.5206;
    Landscape *reach = landscape_new(land->side - 1, land->cell * (land->side - 1), NULL, e);
    for (int64_t i = 0; reach && i < landscape_count(land); i++) {
        reach->rock[i] = is_apex(land, i) ? -surface(land, i) : nowhere;
    }
    if (reach) {
        landscape_fell(reach, shadow);
    }
    return reach;
}

typedef struct Slopes {
    double cliffs; // share of the samples that fall by more than 45 degrees
    double talus;  // degrees: mean fall of rubble that rockfall has brought
    double fans;   // degrees: mean fall of the other rubble, which flows and streams have brought
} Slopes;

// Of the samples between a tenth and nine tenths of the depth. Rubble is a cover of 2 m. Within
// reach of rockfall it is talus, which is nowhere gentler than 20 degrees; below that, and where at
// least 0.1 km^2 drain, flows, streams and ice have laid it (Melton 1965).
static bool measure_slopes(const LandformSurvey *s, Slopes *slopes, Error *e)
{
    const double flows = 1e5, gentle = 0.364; // m^2; tan 20 degrees
    const Landscape *land = s->land;
    double low = s->river + 0.1 * (s->plateau - s->river), steep = 0.0, all = 0.0;
    double high = s->river + 0.9 * (s->plateau - s->river), sum[2] = {0}, count[2] = {0};
    HeightField *field = landscape_heights(land, e);
    Drainage *drainage = field ? drainage_new(field, e) : NULL;
    Landscape *reach = drainage ? talus_reach(land, e) : NULL;
    for (int64_t i = 0; reach && i < landscape_count(land); i++) {
        double h = surface(land, i);
        if (!is_inner(land, i) || h < low || h > high) {
            continue;
        }
        double slope = steepness(land, i);
        all += 1.0;
        steep += slope > 1.0;
        if (is_rubble(land, i)) {
            bool fan = slope < gentle || h >= -reach->rock[i] || drainage->area[i] >= flows;
            sum[fan] += (double)exact_atan2((float)slope, 1.0f) * 57.29577951308232;
            count[fan] += 1.0;
        }
    }
    *slopes = (Slopes){.cliffs = all > 0.0 ? steep / all : (double)NAN,
                       .talus = count[0] > 0.0 ? sum[0] / count[0] : (double)NAN,
                       .fans = count[1] > 0.0 ? sum[1] / count[1] : (double)NAN};
    bool done = reach;
    landscape_free(reach);
    drainage_free(drainage);
    height_field_free(field);
    return done;
}

// Length of the river over the distance between its ends.
static double sinuosity(const OutTree *tree)
{
    double length = 0.0;
    for (int64_t i = 1; i < tree->count; i++) {
        Vec3 a = tree->position[i], b = tree->position[i - 1];
        length += (double)vec3_distance(vec3(a.x, 0, a.z), vec3(b.x, 0, b.z));
    }
    Vec3 a = tree->position[0], b = tree->position[tree->count - 1];
    return length / (double)vec3_distance(vec3(a.x, 0, a.z), vec3(b.x, 0, b.z));
}

// What tells the U of glaciers from the V of rivers.
bool terrain_measure_alps(const Terrain *terrain, MeasureList *list, Error *e)
{
    const Landscape *land = terrain->evolved;
    double size = (double)terrain->params->size;
    double exponent = 0.0, nan = (double)NAN;
    HeightField *field = landscape_heights(land, e);
    Drainage *drainage = field ? drainage_new(field, e) : NULL;
    bool done = drainage &&
                valley_profile_exponent(field, drainage, 0.01 * size * size, &exponent, e) &&
                measures_add(list, "valley_exponent", exponent, "", nan, nan, e);
    drainage_free(drainage);
    height_field_free(field);
    return done;
}

// Of dunes, under the wind that blew last.
static bool measure_dunes(const Terrain *terrain, MeasureList *list, Error *e)
{
    DuneWind wind = terrain_last_wind(terrain->params);
    DuneMeasures m;
    double nan = (double)NAN;
    return dunes_measure(terrain->dunes, &wind, &m, e) &&
           measures_add(list, "dune_height", m.height, "m", nan, nan, e) &&
           measures_add(list, "dune_length", m.length, "m", nan, nan, e) &&
           measures_add(list, "slip_slope", m.slip, "degrees", 30, 35, e) &&
           measures_add(list, "windward_slope", m.windward, "degrees", 4, 16, e) &&
           measures_add(list, "sand_cover", m.covered, "", nan, nan, e);
}

bool terrain_measure(const void *given, const Grown *grown, const Recipe *recipe, MeasureList *list,
                     Error *e)
{
    const Terrain *terrain = grown->state;
    (void)recipe;
    if (!terrain_measure_falls(terrain, list, e) || !terrain_measure_lakes(terrain, list, e)) {
        return false;
    }
    if (terrain->dunes) {
        return measure_dunes(terrain, list, e);
    }
    if (terrain->meander) {
        return terrain_measure_meander(terrain, list, e);
    }
    if (terrain->delta) {
        return terrain_measure_delta(terrain, list, e);
    }
    if (terrain->braid) {
        return terrain_measure_braided(terrain, list, e);
    }
    if (!terrain->evolved) { // terrain_heights came before
        return true;
    }
    LandformSurvey s = {.land = terrain->evolved, .params = terrain_params_resolve(given)};
    double *widths = memory_alloc(s.land->side, sizeof *widths, e), nan = (double)NAN;
    if (!widths || !find_levels(&s, e)) {
        free(widths);
        return false;
    }
    bool rubble = !terrain->ground; // a volcano's loose ground is not rubble alone
    bool canyon = s.params.form == TERRAIN_CANYON;
    Slopes slopes;
    bool done =
        measure_slopes(&s, &slopes, e) &&
        measures_add(list, "incision", s.plateau - s.river, "m", nan, nan, e) &&
        measures_add(list, "cliff_share", slopes.cliffs, "", nan, nan, e) &&
        (!rubble || (measures_add(list, "talus_slope", slopes.talus, "degrees", 25, 38, e) &&
                     measures_add(list, "fan_slope", slopes.fans, "degrees", nan, nan, e))) &&
        measures_add(list, "plateau_share", share_above(&s, 0.8), "", nan, nan, e);
    if (done && canyon) {
        done = measures_add(list, "canyon_width", canyon_width(&s, widths), "m", nan, nan, e) &&
               measures_add(list, "sinuosity", sinuosity(grown->tree), "", nan, nan, e);
    }
    free(widths);
    const Form *form = terrain_form(terrain->params);
    return done && (!form->measure || form->measure(terrain, list, e));
}
