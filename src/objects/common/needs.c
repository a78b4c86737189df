#include "objects/common/needs.h"

#include "base/vec.h"
#include "render/accel/accel.h"

#include <math.h>
#include <stdio.h>
#include <sys/stat.h>

// Measured on x86-64 with Embree 3.12.
#define COPY_FACE_BYTES 120.0 // of a face copied out, in the ray tracer
#define INSTANCE_BYTES 400.0  // of an instance that is not, or of a group of them
#define NODE_BYTES 700.0      // of a node while it grows, and of its curve
#define NODES_AN_ATTRACTOR 0.8
#define SKIN_TRIANGLE_BYTES 92.0
#define MESH_FILE_BYTES 3.4 // of a byte of OBJ; STL 2.5
#define SKIN_BYTES 10400.0  // of a node's skin at level 0; each level has four times as much
#define TWIG_EXPONENT \
    2.3 // by which the share of nodes thicker than a radius falls: the pipe model's

static void add(Needs *needs, const char *key, double count, double bytes)
{
    needs->bytes += bytes;
    if (bytes > needs->largest) {
        needs->largest = bytes;
        needs->largest_count = count;
        needs->largest_object = needs->object;
        snprintf(needs->largest_key, sizeof needs->largest_key, "%s", key);
    }
}

void needs_add(Needs *needs, const char *key, double count, double each)
{
    add(needs, key, count, count > 0.0 ? count * each : 0.0);
}

void needs_add_copies(Needs *needs, const char *key, double count, double faces)
{
    double room = (ACCEL_COPY_FACES_LIMIT - needs->copied_faces) / faces;
    double copied = faces > ACCEL_COPY_MESH_LIMIT ? 0.0 : fmax(0.0, fmin(count, room));
    double own = sizeof(Transform) + sizeof(float);
    needs->copied_faces += copied * faces;
    add(needs, key, count,
        count * own + copied * faces * COPY_FACE_BYTES + (count - copied) * INSTANCE_BYTES);
}

void needs_add_groups(Needs *needs, const char *key, double count, int parts)
{
    needs_add(needs, key, count, parts * (double)sizeof(Transform) + INSTANCE_BYTES);
}

void needs_add_growth(Needs *needs, const char *key, double attractors)
{
    needs_add(needs, key, NODES_AN_ATTRACTOR * attractors, NODE_BYTES);
}

void needs_add_skinned_growth(Needs *needs, const char *key, double attractors, int levels,
                              double twig)
{
    double share = pow(fmax(1.0, twig), -TWIG_EXPONENT);
    needs_add(needs, key, NODES_AN_ATTRACTOR * attractors,
              NODE_BYTES + SKIN_BYTES * share * exp2(2.0 * levels));
}

void needs_add_skin(Needs *needs, const char *key, double triangles)
{
    needs_add(needs, key, triangles, SKIN_TRIANGLE_BYTES);
}

void needs_add_file(Needs *needs, const char *key, const char *file, double each)
{
    struct stat status;
    if (file && stat(file, &status) == 0 && S_ISREG(status.st_mode)) {
        needs_add(needs, key, (double)status.st_size, each);
    }
}

void needs_add_mesh_file(Needs *needs, const char *key, const char *file)
{
    needs_add_file(needs, key, file, MESH_FILE_BYTES);
}
