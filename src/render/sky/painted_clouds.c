#include "render/sky/painted_clouds.h"

#include "render/material/pattern_noise.h"

// Kilometres.
static const float EARTH_RADIUS = 6360.0f;
static const float LAYER_HEIGHT = 5.5f;
// Distance over which clouds fade into the haze of the horizon.
static const float FADE_DISTANCE = 45.0f;

// Distance to the layer's spherical shell in a direction of this sine of elevation.
static float distance_to_layer(float sine)
{
    float down = EARTH_RADIUS * sine;
    return sqrtf(down * down + LAYER_HEIGHT * (2.0f * EARTH_RADIUS + LAYER_HEIGHT)) - down;
}

// Optical thickness of the layer above the point (x, z), km: streaks along the wind, bent by slow
// eddies, torn by finer noise.
static float thickness(const PaintedClouds *clouds, float x, float z)
{
    Vec3 place = vec3(0.9f * x + 0.45f * z, -0.45f * x + 0.9f * z, 0.0f);
    float eddy = noise_fractal(vec3_scale(place, 0.035f), 3, clouds->seed);
    Vec3 bent = vec3(place.x * 0.055f + 1.1f * eddy, place.y * 0.13f - 0.7f * eddy, 0.37f);
    float sheet = noise_fractal(bent, 4, clouds->seed + 1u);
    Vec3 fine = vec3(place.x * 0.5f + 1.5f * sheet, place.y * 1.0f + eddy, 0.71f);
    float torn = noise_fractal(fine, 5, clouds->seed + 2u);
    float density = sheet + 0.30f * torn + 1.3f * (clouds->cover - 0.5f);
    return 1.6f * smoothstepf(0.0f, 0.75f, density);
}

Vec3 painted_clouds_before(const PaintedClouds *clouds, Vec3 direction, Vec3 behind)
{
    if (clouds->cover <= 0.0f || direction.y <= 0.0f) {
        return behind;
    }
    float distance = distance_to_layer(direction.y);
    float fade = expf(-distance / FADE_DISTANCE);
    float x = direction.x * distance, z = direction.z * distance;
    float depth = thickness(clouds, x, z);
    if (depth <= 0.0f || fade < 1e-3f) {
        return behind;
    }
    // Light decreases with the cloud between this point and the sun; thin edges near the sun glow
    // (forward scattering).
    Vec3 sun = clouds->sun_direction;
    float toward = thickness(clouds, x + 0.7f * sun.x, z + 0.7f * sun.z);
    float lit = 0.35f + 0.65f * expf(-0.9f * toward);
    float forward = fmaxf(vec3_dot(direction, sun), 0.0f);
    float phase = 0.22f + 0.55f * forward * forward * forward * forward;
    Vec3 light = vec3_scale(clouds->sunlight, lit * phase / PI_F * 2.0f);
    light = vec3_madd(light, 0.9f, clouds->skylight);
    float opacity = (1.0f - expf(-depth)) * fade;
    return vec3_lerp(behind, light, opacity);
}
