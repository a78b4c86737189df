#include "shape/point_hash.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A point and the next one of its bucket; buckets may hold points of several cells.
typedef struct Entry {
    Vec3 p;
    int64_t next; // index; -1 = the last
} Entry;

struct PointHash {
    float cell; // m
    Entry *entry;
    int64_t count, capacity;
    int64_t *bucket; // first entry; -1 = none
    int64_t buckets; // a power of two
};

enum { FIRST_BUCKETS = 1024 };

static bool make_buckets(PointHash *hash, int64_t buckets, Error *e)
{
    int64_t *bucket = memory_alloc(buckets, sizeof *bucket, e);
    if (bucket) {
        free(hash->bucket);
        hash->bucket = bucket;
        hash->buckets = buckets;
        memset(bucket, 0xff, (size_t)buckets * sizeof *bucket); // -1
    }
    return bucket;
}

PointHash *point_hash_new(float reach, Error *e)
{
    PointHash *hash = memory_alloc_zero(1, sizeof *hash, e);
    if (hash) {
        hash->cell = reach;
    }
    if (!hash || !make_buckets(hash, FIRST_BUCKETS, e)) {
        point_hash_free(hash);
        return NULL;
    }
    return hash;
}

void point_hash_free(PointHash *hash)
{
    if (hash) {
        free(hash->entry);
        free(hash->bucket);
        free(hash);
    }
}

void point_hash_clear(PointHash *hash)
{
    hash->count = 0;
    memset(hash->bucket, 0xff, (size_t)hash->buckets * sizeof *hash->bucket);
}

static int64_t cell_along(const PointHash *hash, float at)
{
    return (int64_t)floorf(clampf(at / hash->cell, -1e15f, 1e15f));
}

static int64_t *bucket_of(const PointHash *hash, const int64_t cell[3])
{
    uint64_t key = random_key(random_key((uint64_t)cell[0], (uint64_t)cell[1]), (uint64_t)cell[2]);
    return &hash->bucket[key & (uint64_t)(hash->buckets - 1)];
}

static void link_entry(PointHash *hash, int64_t i)
{
    Vec3 p = hash->entry[i].p;
    const int64_t cell[3] = {cell_along(hash, p.x), cell_along(hash, p.y), cell_along(hash, p.z)};
    int64_t *first = bucket_of(hash, cell);
    hash->entry[i].next = *first;
    *first = i;
}

bool point_hash_add(PointHash *hash, Vec3 p, Error *e)
{
    if (!memory_reserve(&hash->entry, &hash->capacity, hash->count + 1, sizeof *hash->entry, e)) {
        return false;
    }
    hash->entry[hash->count++].p = p;
    if (hash->count <= 2 * hash->buckets) {
        link_entry(hash, hash->count - 1);
        return true;
    }
    if (!make_buckets(hash, 4 * hash->buckets, e)) {
        return false;
    }
    for (int64_t i = 0; i < hash->count; i++) {
        link_entry(hash, i);
    }
    return true;
}

bool point_hash_nearest(const PointHash *hash, Vec3 p, float *least, Vec3 *nearest)
{
    const int64_t middle[3] = {cell_along(hash, p.x), cell_along(hash, p.y), cell_along(hash, p.z)};
    int64_t best = -1;
    for (int i = 0; i < 27; i++) {
        const int64_t cell[3] = {middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1,
                                 middle[2] + i / 9 - 1};
        for (int64_t k = *bucket_of(hash, cell); k >= 0; k = hash->entry[k].next) {
            float distance = vec3_distance(hash->entry[k].p, p);
            if (distance < *least || (distance == *least && best >= 0 && k < best)) {
                *least = distance;
                best = k;
            }
        }
    }
    if (best >= 0) {
        *nearest = hash->entry[best].p;
    }
    return best >= 0;
}
