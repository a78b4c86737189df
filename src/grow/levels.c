#include "base/exact_math.h"
#include "base/random.h"
#include "grow/colonize.h"

#include <stddef.h>

// Moves the nodes from `first` on toward their parents simultaneously: in reverse order every
// parent is still at its old position (Runions 2007).
static void relax(OutTree *tree, int64_t first, float share)
{
    for (int64_t i = tree->count - 1; i >= first; i--) {
        if (tree->parent[i] >= 0) {
            tree->position[i] =
                vec3_lerp(tree->position[i], tree->position[tree->parent[i]], share);
        }
    }
}

static bool check_level(const GrowLevel *level, int number, Error *e)
{
    const float numbers[7] = {level->step,  level->kill,    level->influence, level->scale,
                              level->noise, level->tropism, level->relax};
    for (int i = 0; i < 7; i++) {
        if (!isfinite(numbers[i])) {
            return error_set(e, ERROR_INPUT, "level %d has a number that is not finite", number);
        }
    }
    if (level->attractors < 1) {
        return error_set(e, ERROR_INPUT, "level %d has %lld attractors; give it at least 1", number,
                         (long long)level->attractors);
    }
    if (level->relax < 0.0f || level->relax > 1.0f) {
        return error_set(e, ERROR_INPUT, "level %d relaxes by %g; it must be 0 to 1", number,
                         (double)level->relax);
    }
    return true;
}

static PointSet *scatter_level(const Envelope *envelope, const ScatterParams *scatter,
                               const GrowLevel *level, int number, const Run *run, Error *e)
{
    ScatterParams mine = *scatter;
    mine.count = level->attractors;
    mine.scale = scatter->scale * level->scale;
    mine.seed = random_key(scatter->seed, (uint64_t)number);
    return points_scatter(envelope, &mine, run, e);
}

static Vec3 furthest_from(const PointSet *points, Vec3 p)
{
    Vec3 best = p;
    float best2 = -1.0f;
    for (int64_t i = 0; i < points->count; i++) {
        Vec3 apart = vec3_sub(points->position[i], p);
        float distance2 = vec3_dot(apart, apart);
        if (distance2 > best2) {
            best2 = distance2;
            best = points->position[i];
        }
    }
    return best;
}

// Spacing that a level's lengths are multiples of, m. In an envelope thinner than the spacing of a
// volume or surface, attractors lie along a line, and n random points on a line of length L leave a
// gap of about L/n ln n somewhere. An influence of 2 spacings or more bridges it if the spacing is
// at least half of that.
static double level_spacing(const PointSet *attractors)
{
    double spacing = points_spacing(attractors), count = (double)attractors->count;
    if (attractors->count < 2) {
        return spacing;
    }
    Vec3 end = furthest_from(attractors, attractors->position[0]);
    double length = (double)vec3_distance(end, furthest_from(attractors, end));
    double along = 0.5 * length / count * exact_log(count);
    return along > spacing ? along : spacing;
}

static bool grow_level(OutTree *tree, const PointSet *attractors, const GrowLevel *level,
                       int number, ColonizeParams *params, const Run *run, GrowReport *report,
                       Error *e)
{
    double spacing = level_spacing(attractors);
    ColonizeParams mine = *params;
    colonize_auto(&mine, spacing, level->step, level->kill, level->influence);
    mine.noise = level->noise;
    mine.tropism = vec3_scale(params->tropism, level->tropism);
    int64_t first = tree->count;
    if (!colonize(tree, attractors, &mine, run, report, e)) {
        error_prefix(e, "level %d: ", number);
        return error_key(e, "growth.levels.%d", number - 1);
    }
    params->first_step += (int32_t)report->steps;
    relax(tree, first, level->relax);
    return true;
}

PointSet *colonize_first_attractors(const Envelope *envelope, const ScatterParams *scatter,
                                    const GrowLevel *level, float *influence, const Run *run,
                                    Error *e)
{
    PointSet *attractors =
        check_level(level, 1, e) ? scatter_level(envelope, scatter, level, 0, run, e) : NULL;
    if (attractors) {
        *influence = (float)((double)level->influence * level_spacing(attractors));
    }
    return attractors;
}

bool colonize_levels(OutTree *tree, const Envelope *envelope, const ScatterParams *scatter,
                     const GrowLevel *levels, int level_count, const ColonizeParams *params,
                     const Run *run, GrowReport *reports, Error *e)
{
    ColonizeParams mine = *params;
    for (int i = 0; i < level_count; i++) {
        GrowReport report = {.stop = STOP_NO_PULL};
        if (!check_level(&levels[i], i + 1, e)) {
            return error_key(e, "growth.levels.%d", i);
        }
        PointSet *attractors = scatter_level(envelope, scatter, &levels[i], i, run, e);
        bool grown =
            attractors && grow_level(tree, attractors, &levels[i], i + 1, &mine, run, &report, e);
        points_free(attractors);
        if (reports) {
            reports[i] = report;
        }
        if (!grown) {
            return false;
        }
    }
    return true;
}
