#include "grow/light/sky_parts.h"

// Sines of the elevation between the rings.
static const float BORDER[SKY_RINGS + 1] = {0.0f, 0.3f, 0.6f, 0.9f, 1.0f};

#define COS_EIGHTH 0.92387953f // of 22.5 degrees
#define SIN_EIGHTH 0.38268343f

int sky_ring(int ring, SkyPart part[SKY_RING_PARTS])
{
    static const Vec2 azimuth[SKY_RING_PARTS] = {
        {COS_EIGHTH, SIN_EIGHTH},  {SIN_EIGHTH, COS_EIGHTH},   {-SIN_EIGHTH, COS_EIGHTH},
        {-COS_EIGHTH, SIN_EIGHTH}, {-COS_EIGHTH, -SIN_EIGHTH}, {-SIN_EIGHTH, -COS_EIGHTH},
        {SIN_EIGHTH, -COS_EIGHTH}, {COS_EIGHTH, -SIN_EIGHTH}};
    float low = BORDER[ring], high = BORDER[ring + 1];
    float weight = 0.5f * ((high - low) + (high * high - low * low)); // integral of the radiance
    if (ring == SKY_RINGS - 1) {
        part[0] = (SkyPart){vec3(0, 1, 0), weight};
        return 1;
    }
    float sine = 0.5f * (low + high), cosine = sqrtf(1.0f - sine * sine);
    for (int i = 0; i < SKY_RING_PARTS; i++) {
        part[i] = (SkyPart){vec3(cosine * azimuth[i].x, sine, cosine * azimuth[i].y),
                            weight / SKY_RING_PARTS};
    }
    return SKY_RING_PARTS;
}
