// The noise that roughens land and moves its places.
#include "base/random.h"
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

float terrain_noise_wavelength(const TerrainParams *params)
{
    return terrain_params_resolve(params).noise.wavelength * params->size;
}

float terrain_warp_reach(const TerrainParams *params)
{
    return params->noise.iterations > 0 ? params->noise.warp * terrain_noise_wavelength(params)
                                        : 0.0f;
}

void terrain_warp(const Terrain *terrain, float share, float *x, float *z)
{
    float wavelength = terrain_noise_wavelength(terrain->params);
    float u = *x / wavelength, v = *z / wavelength;
    float reach = 0.4f * terrain_warp_reach(terrain->params) * share;
    float push_x = sparse_noise_fractal(0.5f * u, 0.5f * v, 2, 0.5f, 0.0f,
                                        random_key(terrain->seed, STREAM_WARP_X));
    float push_z = sparse_noise_fractal(0.5f * u, 0.5f * v, 2, 0.5f, 0.0f,
                                        random_key(terrain->seed, STREAM_WARP_Z));
    *x += reach * clampf(push_x, -2.0f, 2.0f);
    *z += reach * clampf(push_z, -2.0f, 2.0f);
}

float terrain_noise_at(const Terrain *terrain, float x, float z)
{
    const TerrainNoiseParams *noise = &terrain->params->noise;
    float wavelength = terrain_noise_wavelength(terrain->params);
    float n = sparse_noise_fractal(x / wavelength, z / wavelength, noise->iterations, noise->gain,
                                   noise->ridged, random_key(terrain->seed, STREAM_NOISE));
    return n * noise->amplitude * wavelength;
}
