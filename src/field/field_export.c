// Writes guide fields as voxel grids.
#include "field/guide_field.h"

typedef struct FieldSamples {
    const GuideField *field;
    const Envelope *envelope;
    float voxel;
} FieldSamples;

// Gradient of the distance by central differences over a voxel.
static Vec3 outward(const Envelope *envelope, Vec3 p, float h)
{
    Vec3 x = vec3(h, 0, 0), y = vec3(0, h, 0), z = vec3(0, 0, h);
    return vec3_normalize(vec3(
        envelope_distance(envelope, vec3_add(p, x)) - envelope_distance(envelope, vec3_sub(p, x)),
        envelope_distance(envelope, vec3_add(p, y)) - envelope_distance(envelope, vec3_sub(p, y)),
        envelope_distance(envelope, vec3_add(p, z)) - envelope_distance(envelope, vec3_sub(p, z))));
}

// Samples the envelope and a margin around it, as wide as trilinear interpolation inside needs.
static bool sample(const void *context, Vec3 p, Vec3 *vector)
{
    const FieldSamples *samples = context;
    float reach = fminf(1.8f * samples->voxel, 0.99f * envelope_band(samples->envelope));
    if (envelope_distance(samples->envelope, p) > reach) {
        return false;
    }
    Vec3 normal = outward(samples->envelope, p, 0.5f * samples->voxel);
    *vector = guide_field_at(samples->field, p, normal);
    return true;
}

bool guide_field_add_to(const GuideField *field, const Envelope *envelope, int resolution,
                        const char *name, GridFile *grids, const Run *run, Error *e)
{
    Aabb box = envelope_bounds(envelope);
    FieldSamples samples = {field, envelope, aabb_extent(box) / (float)resolution};
    Vec3 margin = vec3_splat(2.0f * samples.voxel);
    Aabb around = {vec3_sub(box.low, margin), vec3_add(box.high, margin)};
    return grid_file_add_vectors(grids, name, around, samples.voxel, sample, &samples, run, e);
}
