#include "mesh/curves.h"

#include "base/memory.h"

#include <stdlib.h>

CurveSet *curves_new(int64_t point_count, int64_t curve_count, Error *e)
{
    CurveSet *curves = memory_alloc_zero(1, sizeof *curves, e);
    if (!curves) {
        return NULL;
    }
    curves->point_count = point_count;
    curves->curve_count = curve_count;
    curves->position = memory_alloc_zero(point_count, sizeof(Vec3), e);
    curves->radius = memory_alloc_zero(point_count, sizeof(float), e);
    curves->birth = memory_alloc_zero(point_count, sizeof(float), e);
    curves->along = memory_alloc_zero(point_count, sizeof(float), e);
    curves->id = memory_alloc_zero(curve_count, sizeof(uint64_t), e);
    curves->first = memory_alloc_zero(curve_count + 1, sizeof(int64_t), e);
    if (!curves->position || !curves->radius || !curves->birth || !curves->along || !curves->id ||
        !curves->first) {
        curves_free(curves);
        return NULL;
    }
    return curves;
}

void curves_free(CurveSet *curves)
{
    if (curves) {
        free(curves->position);
        free(curves->radius);
        free(curves->birth);
        free(curves->along);
        free(curves->glow);
        free(curves->id);
        free(curves->first);
        free(curves);
    }
}
