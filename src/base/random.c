#include "base/random.h"

#include "base/exact_math.h"

enum { STREAM_RADIUS = 1, STREAM_ANGLE = 2 };   // of random_normal
enum { STREAM_HEIGHT = 1, STREAM_AZIMUTH = 2 }; // of random_direction

float random_normal(uint64_t key)
{
    float s, c;
    float u = random_unit(random_key(key, STREAM_RADIUS));
    float v = random_unit(random_key(key, STREAM_ANGLE));
    exact_sincos(2.0f * PI_F * v, &s, &c);
    return (float)sqrt(-2.0 * exact_log(1.0 - (double)u)) * c;
}

Vec3 random_direction(uint64_t key)
{
    float s, c;
    float z = 1.0f - 2.0f * random_unit(random_key(key, STREAM_HEIGHT));
    exact_sincos(2.0f * PI_F * random_unit(random_key(key, STREAM_AZIMUTH)), &s, &c);
    float r2 = 1.0f - z * z, r = r2 > 0.0f ? sqrtf(r2) : 0.0f;
    return vec3(r * c, r * s, z);
}
