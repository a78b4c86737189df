#include "export/sky_bake.h"

#include "render/sky/night.h"

#include <stddef.h>

static Image *draw(const Dome *dome, int width, Error *e)
{
    Image *image = image_new(width, width / 2, 3, e);
    for (int y = 0; image && y < image->height; y++) {
        float elevation = PI_F * (0.5f - ((float)y + 0.5f) / (float)image->height);
        for (int x = 0; x < width; x++) {
            float azimuth = PI_F * (1.0f - 2.0f * ((float)x + 0.5f) / (float)width);
            Vec3 direction = vec3(cosf(elevation) * sinf(azimuth), sinf(elevation),
                                  cosf(elevation) * cosf(azimuth));
            Vec3 color = dome_lookup(dome, direction);
            float *pixel = image->pixel + 3 * ((int64_t)y * width + x);
            pixel[0] = color.x;
            pixel[1] = color.y;
            pixel[2] = color.z;
        }
    }
    return image;
}

// Applies Sky.rotation.
static void turn(const Sky *sky, Dome *dome, Sun *sun)
{
    float angle = sky->rotation * RADIANS_PER_DEGREE;
    dome->rotation += angle;
    sun->direction = vec3_rotate(sun->direction, vec3(0, 1, 0), cosf(angle), sinf(angle));
}

bool sky_bake(const Sky *sky, int width, const Run *run, BakedSky *baked, Error *e)
{
    *baked = (BakedSky){0};
    Dome *dome;
    if (sky->kind == SKY_SUN_SKY) {
        Atmosphere *atmosphere = sky_atmosphere(sky, run, e);
        dome = atmosphere ? sky_dome(sky, atmosphere, &baked->sun, run, e) : NULL;
        atmosphere_free(atmosphere);
    } else if (sky->kind == SKY_NIGHT) {
        dome = night_dome(sky, &baked->sun, e);
    } else {
        return true;
    }
    if (dome) {
        turn(sky, dome, &baked->sun);
        baked->image = draw(dome, width, e);
    }
    dome_free(dome);
    return baked->image;
}

void baked_sky_clear(BakedSky *baked)
{
    image_free(baked->image);
    baked->image = NULL;
}
