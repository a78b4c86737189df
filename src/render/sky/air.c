#include "render/sky/air.h"

#include "base/memory.h"
#include "render/sky/sun_sky.h"

#include <stdlib.h>

struct Air {
    Atmosphere *atmosphere;
    double scale;                // km of air for a metre of the scene
    Vec3 weight[SPECTRUM_BANDS]; // of sunlight in a band: radiance in the picture
    Vec3 white;                  // their sum
};

Air *air_new(Atmosphere *atmosphere, const Sky *sky, Error *e)
{
    Air *air = memory_alloc_zero(1, sizeof *air, e);
    if (!air) {
        atmosphere_free(atmosphere);
        return NULL;
    }
    air->atmosphere = atmosphere;
    air->scale = (double)sky->aerial_perspective / 1000.0;
    Spectrum solar = atmosphere_solar_irradiance();
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        air->weight[i] =
            vec3_scale(spectrum_band_rgb(i), solar.v[i] * sky->strength / SKY_CANDELA_PER_UNIT);
        air->white = vec3_add(air->white, air->weight[i]);
    }
    return air;
}

void air_free(Air *air)
{
    if (air) {
        atmosphere_free(air->atmosphere);
        free(air);
    }
}

static Vec3 color_of(const Air *air, const Spectrum *light)
{
    Vec3 sum = vec3_splat(0.0f);
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        sum = vec3_madd(sum, light->v[i], air->weight[i]);
    }
    return sum;
}

// One step stands for all, chosen by its green light.
static void choose_step(const Air *air, const AirStretch *stretch, float u, AirView *view)
{
    enum { GREEN = 4 }; // 540 to 580 nm
    float total = 0.0f;
    for (int i = 0; i < stretch->steps; i++) {
        total += stretch->sunlit[i].v[GREEN];
    }
    if (!(total > 0.0f)) {
        return;
    }
    int chosen = 0;
    float left = u * total;
    while (chosen < stretch->steps - 1 && left >= stretch->sunlit[chosen].v[GREEN]) {
        left -= stretch->sunlit[chosen++].v[GREEN];
    }
    float light = stretch->sunlit[chosen].v[GREEN];
    if (!(light > 0.0f)) {
        return;
    }
    double begin = chosen > 0 ? stretch->end[chosen - 1] : 0.0;
    double within = (double)clampf(left / light, 0.0f, 1.0f);
    view->at = (float)((begin + within * (stretch->end[chosen] - begin)) / air->scale);
    view->sunlit = vec3_scale(color_of(air, &stretch->sunlit[chosen]), total / light);
}

AirView air_view(const Air *air, Vec3 from, Vec3 direction, float distance, Vec3 sun, float u)
{
    AirStretch stretch;
    double height = (double)from.y * air->scale;
    atmosphere_stretch(air->atmosphere, height, direction, sun, (double)distance * air->scale,
                       &stretch);
    AirView view = {.glow = vec3_max(color_of(air, &stretch.glow), vec3_splat(0.0f))};
    Vec3 clear = color_of(air, &stretch.clear);
    view.clear =
        vec3(clampf(clear.x / air->white.x, 0.0f, 1.0f), clampf(clear.y / air->white.y, 0.0f, 1.0f),
             clampf(clear.z / air->white.z, 0.0f, 1.0f));
    choose_step(air, &stretch, u, &view);
    return view;
}
