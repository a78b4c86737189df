#include "mesh/spray.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WIDENING 0.25f // radius over way of a turbulent puff

bool spray_add(SprayParcels *spray, SprayParcel parcel, Error *e)
{
    if (!memory_reserve(&spray->parcel, &spray->capacity, spray->count + 1, sizeof parcel, e)) {
        return false;
    }
    spray->parcel[spray->count++] = parcel;
    return true;
}

bool spray_join(SprayParcels *spray, const SprayParcels *other, Error *e)
{
    int64_t count = spray->count + other->count;
    if (!memory_reserve(&spray->parcel, &spray->capacity, count, sizeof *spray->parcel, e)) {
        return false;
    }
    if (other->count > 0) {
        memcpy(spray->parcel + spray->count, other->parcel,
               sizeof *other->parcel * (size_t)other->count);
    }
    spray->count = count;
    return true;
}

float spray_puff_way(float radius, float speed, float seconds)
{
    float start = radius / WIDENING; // as if it came from a point
    float cubed = start * start * start;
    return sqrtf(sqrtf(cubed * (start + 4.0f * speed * seconds))) - start;
}

float spray_puff_radius(float radius, float way)
{
    return radius + WIDENING * way;
}

void spray_free(SprayParcels *spray)
{
    if (spray) {
        free(spray->parcel);
        free(spray);
    }
}
