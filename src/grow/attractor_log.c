#include "grow/attractor_log.h"

#include "base/memory.h"

#include <stdlib.h>

static bool reserve(AttractorLog *log, int64_t count, Error *e)
{
    return memory_reserve(&log->position, &log->capacity[0], count, sizeof *log->position, e) &&
           memory_reserve(&log->normal, &log->capacity[1], count, sizeof *log->normal, e) &&
           memory_reserve(&log->removed, &log->capacity[2], count, sizeof *log->removed, e);
}

static AttractorGroup *add_group(AttractorLog *log, float kill, float influence, int32_t born,
                                 Error *e)
{
    if (!memory_reserve(&log->group, &log->group_capacity, log->group_count + 1, sizeof *log->group,
                        e)) {
        return NULL;
    }
    AttractorGroup *group = &log->group[log->group_count++];
    *group =
        (AttractorGroup){.first = log->count, .kill = kill, .influence = influence, .born = born};
    return group;
}

static void add(AttractorLog *log, AttractorGroup *group, Vec3 position, Vec3 normal,
                int32_t removed)
{
    log->position[log->count] = position;
    log->normal[log->count] = normal;
    log->removed[log->count++] = removed;
    group->count++;
}

bool attractor_log_add(AttractorLog *log, const PointSet *points, float kill, float influence,
                       int32_t born, Error *e)
{
    AttractorGroup *group = add_group(log, kill, influence, born, e);
    if (!group || !reserve(log, log->count + points->count, e)) {
        return false;
    }
    for (int64_t i = 0; i < points->count; i++) {
        add(log, group, points->position[i], points->normal[i], ATTRACTOR_LEFT);
    }
    return true;
}

bool attractor_log_at(const AttractorLog *log, int32_t birth, AttractorLog *then, Error *e)
{
    *then = (AttractorLog){0};
    bool done = reserve(then, log->count, e);
    for (int64_t g = 0; done && g < log->group_count && log->group[g].born <= birth; g++) {
        const AttractorGroup *from = &log->group[g];
        AttractorGroup *to = add_group(then, from->kill, from->influence, from->born, e);
        done = to;
        for (int64_t i = from->first; done && i < from->first + from->count; i++) {
            if (log->removed[i] > birth) {
                add(then, to, log->position[i], log->normal[i], log->removed[i]);
            }
        }
    }
    if (!done) {
        attractor_log_clear(then);
    }
    return done;
}

void attractor_log_clear(AttractorLog *log)
{
    free(log->position);
    free(log->normal);
    free(log->removed);
    free(log->group);
    *log = (AttractorLog){0};
}
