#include "field/volume_field.h"

bool volume_field_init(VolumeField *field, const FieldParams *params, const Run *run, Error *e)
{
    *field = (VolumeField){.from_file = params->from_file};
    transform_inverse(&field->from_file, &field->to_file);
    field->volume = volume_read(params->file, params->grid, run, e);
    Transform to_world;
    if (!field->volume) {
        return e && e->key[0] ? false : error_key(e, "file"); // or it blames the grid
    }
    if (transform_inverse(&field->volume->to_index, &to_world)) {
        for (int axis = 0; axis < 3; axis++) {
            Vec3 unit = vec3(axis == 0, axis == 1, axis == 2);
            field->half_voxel[axis] = vec3_scale(transform_vector(&to_world, unit), 0.5f);
        }
    }
    return true;
}

void volume_field_free(VolumeField *field)
{
    volume_free(field->volume);
    *field = (VolumeField){0};
}

// Central differences over a voxel, in the file's space.
static Vec3 gradient(const VolumeField *field, Vec3 at)
{
    const Volume *volume = field->volume;
    float rise[3];
    for (int axis = 0; axis < 3; axis++) {
        float above, below;
        volume_at(volume, vec3_add(at, field->half_voxel[axis]), &above);
        volume_at(volume, vec3_sub(at, field->half_voxel[axis]), &below);
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
        x = gradient(field, at);
    }
    x = transform_vector(&field->from_file, x); // rotated, and scaled evenly
    return vec3_dot(x, x) > 0.0f ? vec3_normalize(x) : vec3(0, 0, 0);
}
