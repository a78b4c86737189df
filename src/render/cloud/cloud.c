#include "render/cloud/cloud.h"

#include <stdlib.h>

// Extinctions: a liquid water content of 0.2 to 0.5 g/m^3 in droplets of 8 to 10 um (Pruppacher and
// Klett 1997, ch. 2). Fog: 0.1 g/m^3, in which one sees 100 m far. Spray: 10 g/m^3 in
// drops of 150 um. Ash: some g/m^3 of grains of 20 um of glass and dark minerals, which absorb
// a tenth of what meets them, blue more than red.
static Cloud form_of(CloudKind kind)
{
    switch (kind) {
    case CLOUD_STRATUS:
        return (Cloud){.kind = kind,
                       .base = 1500.0f,
                       .thickness = 400.0f,
                       .cover = 0.7f,
                       .size = 1800.0f,
                       .extinction = 0.05f,
                       .resolution = 512};
    case CLOUD_STORM:
        return (Cloud){.kind = kind,
                       .base = 1000.0f,
                       .thickness = 10500.0f,
                       .cover = 1.0f,
                       .size = 5000.0f,
                       .extinction = 0.1f,
                       .softness = 0.5f,
                       .resolution = 512};
    case CLOUD_FOG:
        return (Cloud){.kind = kind,
                       .base = -100.0f,
                       .thickness = 200.0f,
                       .cover = 1.0f,
                       .size = 600.0f,
                       .extinction = 0.03f,
                       .pool = 500.0f,
                       .resolution = 512};
    case CLOUD_PLUME:
        return (Cloud){.kind = kind,
                       .base = 0.0f,
                       .thickness = 3000.0f,
                       .cover = 1.0f,
                       .size = 200.0f,
                       .extinction = 0.08f,
                       .softness = 0.25f,
                       .drift = 0.4f,
                       .resolution = 512};
    case CLOUD_GRID:
        return (Cloud){.kind = kind, .extinction = 0.05f, .scale = 1.0f};
    case CLOUD_SPRAY:
        return (Cloud){.kind = kind, .extinction = 0.2f};
    case CLOUD_CUMULUS:
        break;
    }
    return (Cloud){.kind = CLOUD_CUMULUS,
                   .base = 1200.0f,
                   .thickness = 1100.0f,
                   .cover = 0.3f,
                   .size = 1500.0f,
                   .extinction = 0.09f,
                   .softness = 0.5f,
                   .resolution = 512};
}

Cloud cloud_default(CloudKind kind)
{
    Cloud cloud = form_of(kind);
    cloud.albedo = kind == CLOUD_PLUME ? vec3(0.94f, 0.92f, 0.895f) : vec3_splat(1.0f);
    return cloud;
}

void cloud_grounds_free(Cloud *cloud, int count)
{
    for (int i = 0; i < count; i++) {
        if (cloud[i].floor) {
            free(cloud[i].floor->height);
            free(cloud[i].floor);
            cloud[i].floor = NULL;
        }
        spray_free(cloud[i].spray);
        cloud[i].spray = NULL;
    }
}
