// The colour of a leaf by its season. Chlorophyll goes from the edge inward and last along the
// veins; what is left is the autumn colour, and brown where the edge dries first. A young leaf is
// thin and has little chlorophyll.
#include "base/mesh.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

// Share 0..1 of the way to the autumn colour at this point: 0 at season 0 and 1 at season 1
// everywhere.
static float turned_here(const SurfacePoint *point)
{
    float inward = 1.0f - fabsf(2.0f * point->uv.x - 1.0f);
    Vec3 p = vec3(4.0f * point->uv.x, 6.0f * point->uv.y, 17.0f * point->variation);
    float blotch = clampf(0.5f + 0.7f * noise_fractal(p, 2, 43), 0.0f, 1.0f);
    float late = 0.6f * inward + 0.4f * blotch; // 0..1
    return clampf(1.7f * point->season - 0.7f * late, 0.0f, 1.0f);
}

static void turn(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float share = turned_here(point);
    // A turned blade scatters as before and absorbs like its reflectance: it transmits about as
    // much as it reflects.
    Vec3 through = vec3_scale(m->autumn_color, 0.85f);
    shade->color = vec3_lerp(shade->color, m->autumn_color, share);
    shade->transmittance = vec3_lerp(shade->transmittance, through, share);
    // Dry edges of leaves that turned long ago.
    float edge = fabsf(2.0f * point->uv.x - 1.0f);
    float dry = smoothstepf(0.75f, 1.0f, point->season) * smoothstepf(0.55f, 1.0f, edge) *
                smoothstepf(0.3f, 0.9f, point->variation);
    Vec3 brown = vec3(0.11f, 0.062f, 0.026f);
    shade->color = vec3_lerp(shade->color, brown, 0.8f * dry);
    shade->transmittance = vec3_lerp(shade->transmittance, vec3_scale(brown, 0.4f), 0.8f * dry);
}

void pattern_season(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    if (point->season > 0.0f) {
        turn(m, point, shade);
        return;
    }
    float young = fminf(fmaxf(-point->season, point->young), 1.0f);
    Vec3 pale = vec3(1.55f * shade->color.x, 1.35f * shade->color.y, 1.1f * shade->color.z);
    Vec3 thin = vec3(2.1f * shade->transmittance.x, 1.8f * shade->transmittance.y,
                     1.5f * shade->transmittance.z);
    if (vec3_largest(m->young_color) > 0.0f) {
        pale = m->young_color;
        thin = vec3_scale(m->young_color, 0.9f); // thin: it lets as much through as it sends back
    }
    shade->color = vec3_lerp(shade->color, pale, young);
    shade->transmittance = vec3_lerp(shade->transmittance, thin, young);
}

// Chlorophyll goes first, which leaves yellow; then the tissue turns brown, and dries to a paler
// straw. Where it withers from a spot outward, these lie about it as rings.
void pattern_wither(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    const Vec3 brown = vec3(0.055f, 0.030f, 0.014f), brown_through = vec3(0.045f, 0.022f, 0.006f);
    const Vec3 straw = vec3(0.200f, 0.130f, 0.065f), straw_through = vec3(0.170f, 0.085f, 0.028f);
    float yellow = smoothstepf(0.0f, MESH_YELLOW, point->withered);
    float dead = smoothstepf(MESH_YELLOW, MESH_BROWN, point->withered);
    float dry = smoothstepf(0.75f, 1.0f, point->withered);
    Vec3 c = shade->color, t = shade->transmittance;
    Vec3 faded = vec3(fmaxf(c.x, 1.05f * c.y), 1.1f * c.y, 0.8f * c.z);
    Vec3 faded_through = vec3(fmaxf(t.x, 1.10f * t.y), 1.1f * t.y, 0.8f * t.z);
    if (vec3_largest(m->faded_color) > 0.0f) {
        faded = m->faded_color;
        faded_through = vec3_scale(faded, 0.85f); // it absorbs like its reflectance
    }
    c = vec3_lerp(c, faded, yellow);
    t = vec3_lerp(t, faded_through, yellow);
    shade->color = vec3_lerp(vec3_lerp(c, brown, dead), straw, dry);
    shade->transmittance = vec3_lerp(vec3_lerp(t, brown_through, dead), straw_through, dry);
}
