// A guide field from a grid of an OpenVDB file.
#ifndef RAMIFY_FIELD_VOLUME_FIELD_H
#define RAMIFY_FIELD_VOLUME_FIELD_H

#include "field/guide_field.h"
#include "shape/volume.h"

typedef struct VolumeField {
    Volume *volume; // owned
    Transform from_file, to_file;
    Vec3 half_voxel[3]; // m of the file, along the grid's axes
} VolumeField;

// Reads params->file. Errors have the key "file". Clear with volume_field_free, also on failure.
bool volume_field_init(VolumeField *field, const FieldParams *params, const Run *run, Error *e);
void volume_field_free(VolumeField *field);

// The unit vector at p: of a vector grid its direction, of a scalar grid that in which its values
// rise. Zero beside the grid and where it has none. Thread-safe.
Vec3 volume_field_at(const VolumeField *field, Vec3 p);

#endif
