// The bits of a world's geometry as one number.
#ifndef RAMIFY_TESTS_GEOMETRY_HASH_H
#define RAMIFY_TESTS_GEOMETRY_HASH_H

#include "render/world.h"

#include "base/random.h"

#include <string.h>

static inline uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    for (size_t i = 0; bytes && i + 4 <= size; i += 4) {
        uint32_t word;
        memcpy(&word, (const char *)bytes + i, sizeof word);
        hash = random_key(hash, word);
    }
    return hash;
}

static inline uint64_t hash_mesh(uint64_t hash, const Mesh *mesh)
{
    size_t n = (size_t)mesh->vertex_count;
    hash = hash_bytes(hash, mesh->index,
                      sizeof *mesh->index * (size_t)(mesh->face_count * mesh->face_size));
    hash = hash_bytes(hash, mesh->position, sizeof(Vec3) * n);
    hash = hash_bytes(hash, mesh->normal, sizeof(Vec3) * n);
    hash = hash_bytes(hash, mesh->uv, sizeof(Vec2) * n);
    hash = hash_bytes(hash, mesh->radius, sizeof(float) * n);
    hash = hash_bytes(hash, mesh->birth, sizeof(float) * n);
    return hash_bytes(hash, mesh->withered, sizeof(float) * n);
}

static inline uint64_t hash_curves(uint64_t hash, const CurveSet *curves)
{
    size_t n = (size_t)curves->point_count;
    hash =
        hash_bytes(hash, curves->first, sizeof *curves->first * (size_t)(curves->curve_count + 1));
    hash = hash_bytes(hash, curves->position, sizeof(Vec3) * n);
    hash = hash_bytes(hash, curves->radius, sizeof(float) * n);
    hash = hash_bytes(hash, curves->birth, sizeof(float) * n);
    return hash_bytes(hash, curves->glow, sizeof(float) * n);
}

static inline uint64_t geometry_hash(const Geometry *geometry)
{
    uint64_t hash = random_mix((uint64_t)geometry->count);
    for (int64_t i = 0; i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        hash = part->mesh ? hash_mesh(hash, part->mesh) : hash_curves(hash, part->curves);
        hash = hash_bytes(hash, part->instance, sizeof(Transform) * (size_t)part->instance_count);
    }
    return hash;
}

#endif
