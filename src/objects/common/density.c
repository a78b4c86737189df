#include "objects/common/density.h"

#include "base/file_name.h"
#include "base/memory.h"
#include "objects/common/grey.h"
#include "shape/volume.h"

#include <stdlib.h>

struct Density {
    Volume *volume; // either
    Image *grey;    // or
    Transform to_file;
    bool invert;
};

static bool read_volume(Density *density, const DensityParams *params, const Run *run, Error *e)
{
    density->volume = volume_read(params->file, params->grid, run, e);
    if (density->volume && density->volume->components == 1) {
        return true;
    }
    if (density->volume) {
        error_set(e, ERROR_INPUT, "the grid holds vectors; a density needs a grid of floats");
    }
    bool blamed = e && e->key[0]; // the grid, because the file has none of its name
    return blamed ? false : error_key(e, params->grid && density->volume ? "grid" : "file");
}

Density *density_new(const DensityParams *params, const Run *run, Error *e)
{
    Density *density = memory_alloc_zero(1, sizeof *density, e);
    if (!density) {
        return NULL;
    }
    density->invert = params->invert;
    transform_inverse(&params->transform, &density->to_file);
    bool done;
    if (file_name_ends(params->file, ".vdb")) {
        done = read_volume(density, params, run, e);
    } else {
        density->grey = grey_read(params->file, run, e);
        done = density->grey || error_key(e, "file");
    }
    if (!done) {
        density_free(density);
        return NULL;
    }
    return density;
}

void density_free(Density *density)
{
    if (density) {
        volume_free(density->volume);
        image_free(density->grey);
        free(density);
    }
}

static float volume_density(const Volume *volume, Vec3 at)
{
    float value;
    volume_at(volume, at, &value);
    if (volume->lowest < 0.0f) { // a level set
        return value < 0.0f ? 1.0f : 0.0f;
    }
    return volume->highest > 0.0f ? value / volume->highest : 0.0f;
}

static float grey_density(const Image *grey, Vec3 at)
{
    float u = at.x + 0.5f, v = at.z + 0.5f;
    return u < 0.0f || u > 1.0f || v < 0.0f || v > 1.0f ? 0.0f : grey_at(grey, u, v);
}

float density_at(const void *user, Vec3 p)
{
    const Density *density = user;
    Vec3 at = transform_point(&density->to_file, p);
    float value =
        density->volume ? volume_density(density->volume, at) : grey_density(density->grey, at);
    value = clampf(value, 0.0f, 1.0f);
    return density->invert ? 1.0f - value : value;
}
