#include "grow/venation/tertiaries.h"

#include "base/random.h"

#define FIRST 0.12f  // place on the lower vein from which they leave
#define LAST 0.98f   // ... up to which
#define LEAN 0.11f   // how much nearer to the midrib they meet the upper vein, at most
#define UNEVEN 0.30f // of their distance: random
#define BOW 0.32f    // of their distance: random, of the course
#define SWING 0.22f

Tertiary tertiary_make(int number, int count, uint64_t key)
{
    uint64_t own = random_key(key, (uint64_t)number);
    float distance = (LAST - FIRST) / (float)count;
    float shift = random_range(random_key(own, 0), -UNEVEN, UNEVEN);
    float from = FIRST + distance * ((float)number + 0.5f + shift);
    float lean = LEAN * random_range(random_key(own, 1), 0.7f, 1.0f) * fminf(3.0f * from, 1.0f);
    return (Tertiary){.from = from,
                      .to = from - lean,
                      .bow = distance * random_range(random_key(own, 2), -BOW, BOW),
                      .swing = distance * random_range(random_key(own, 3), -SWING, SWING)};
}

Vec3 tertiary_point(const LeafOutline *outline, const Secondary *lower, const Secondary *upper,
                    const Tertiary *vein, float t)
{
    float arc = 4.0f * t * (1.0f - t); // 0 at both ends, 1 in the middle
    float at =
        lerpf(vein->from, vein->to, t) + arc * (vein->bow + 2.0f * vein->swing * (1.0f - 2.0f * t));
    return vec3_lerp(secondary_point(outline, lower, at), secondary_point(outline, upper, at), t);
}
