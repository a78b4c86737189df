#include "mesh/spray.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WIDENING 0.25f  // radius over way of a turbulent puff
#define DROP 0.006f     // m: mean diameter of drops of falls
#define EXTINCTION 0.2f // 1/m: of the densest spray (render/cloud/cloud.c)

// An ellipsoid of revolution reaches along an axis as far as its half axes' parts along it
// together.
float spray_reach(const SprayParcel *parcel, int axis, float least)
{
    float radius = fmaxf(parcel->radius, least), drawn = vec3_length(parcel->drawn);
    if (!(drawn > 0.0f)) {
        return radius;
    }
    float part = vec3_axis(parcel->drawn, axis) / drawn, half = radius + drawn;
    return sqrtf(radius * radius * (1.0f - part * part) + half * half * part * part);
}

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

float spray_of_water(void)
{
    return 3.0f / (DROP * EXTINCTION); // each drop takes twice its cross-section out of light
}

void spray_free(SprayParcels *spray)
{
    if (spray) {
        free(spray->parcel);
        free(spray);
    }
}
