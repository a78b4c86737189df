#include "field/volume_field.h"

bool volume_field_init(VolumeField *field, const FieldParams *params, const Run *run, Error *e)
{
    *field = (VolumeField){.from_file = params->from_file};
    transform_inverse(&field->from_file, &field->to_file);
    field->volume = volume_read(params->file, params->grid, run, e);
    return field->volume || error_key(e, "file");
}

void volume_field_free(VolumeField *field)
{
    volume_free(field->volume);
    *field = (VolumeField){0};
}

// Central differences over a voxel, in the file's space.
static Vec3 gradient(const Volume *volume, Vec3 at)
{
    Transform to_world;
    float rise[3];
    if (!transform_inverse(&volume->to_index, &to_world)) {
        return vec3(0, 0, 0);
    }
    for (int axis = 0; axis < 3; axis++) {
        Vec3 unit = vec3(axis == 0, axis == 1, axis == 2);
        Vec3 half = vec3_scale(transform_vector(&to_world, unit), 0.5f);
        float above, below;
        volume_at(volume, vec3_add(at, half), &above);
        volume_at(volume, vec3_sub(at, half), &below);
        rise[axis] = above - below;
    }
    // differences by sample number, carried into the world as gradients are
    return transform_normal(&volume->to_index, vec3(rise[0], rise[1], rise[2]));
}

Vec3 volume_field_at(const VolumeField *field, Vec3 p)
{
    const Volume *volume = field->volume;
    Vec3 at = transform_point(&field->to_file, p), x;
    if (volume->components == 3) {
        float value[3];
        volume_at(volume, at, value);
        x = vec3(value[0], value[1], value[2]);
    } else {
        x = gradient(volume, at);
    }
    x = transform_vector(&field->from_file, x); // rotated, and scaled evenly
    return vec3_dot(x, x) > 0.0f ? vec3_normalize(x) : vec3(0, 0, 0);
}
