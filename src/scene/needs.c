#include "scene/needs.h"

#include "base/memory.h"
#include "render/accel/accel.h"
#include "render/film.h"
#include "scene/kind.h"
#include "scene/place.h"

#include <math.h>
#include <stdio.h>
#include <sys/stat.h>

// Measured on x86-64 with Embree 3.12.
#define PROGRAM_BYTES 1.4e8     // the program and its libraries
#define PIXEL_WRITE_BYTES 160.0 // of a pixel while it is denoised and written
#define COPY_FACE_BYTES 120.0   // of a face copied out, in the ray tracer
#define INSTANCE_BYTES 400.0    // of an instance that is not
#define NODE_BYTES 700.0        // of a node while it grows, and of its curve
#define NODES_AN_ATTRACTOR 0.8
#define MESH_FILE_BYTES 3.4 // of a byte of OBJ; STL 2.5
#define SKIN_BYTES 10400.0  // of a node's skin at level 0; each level has four times as much
#define TWIG_EXPONENT \
    2.3 // by which the share of nodes thicker than a radius falls: the pipe model's

void needs_add(Needs *needs, const char *key, double count, double each)
{
    double bytes = count > 0.0 ? count * each : 0.0;
    needs->bytes += bytes;
    if (bytes > needs->largest) {
        needs->largest = bytes;
        needs->largest_object = needs->object;
        snprintf(needs->largest_key, sizeof needs->largest_key, "%s", key);
    }
}

void needs_add_copies(Needs *needs, const char *key, double count, double faces)
{
    double room = (ACCEL_COPY_FACES_LIMIT - needs->copied_faces) / faces;
    double copied = faces > ACCEL_COPY_MESH_LIMIT ? 0.0 : fmax(0.0, fmin(count, room));
    double own = sizeof(Transform) + sizeof(float);
    needs->copied_faces += copied * faces;
    needs_add(needs, key, 1.0,
              count * own + copied * faces * COPY_FACE_BYTES + (count - copied) * INSTANCE_BYTES);
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

static Needs needs_of(const Scene *scene, int only)
{
    Needs needs = {.largest_object = -1};
    for (int i = 0; i < scene->object_count; i++) {
        const Kind *kind = scene->objects[i].kind;
        needs.object = i;
        if (kind->needs && (only < 0 || only == i)) {
            kind->needs(scene->objects[i].params, &needs);
        }
    }
    return needs;
}

double scene_memory(const Scene *scene)
{
    double pixels = (double)scene->film.width * scene->film.height;
    return PROGRAM_BYTES + needs_of(scene, -1).bytes +
           (FILM_PIXEL_BYTES + PIXEL_WRITE_BYTES) * pixels;
}

bool scene_check_memory(const Scene *scene, int object, Error *e)
{
    Needs needs = needs_of(scene, object);
    double there = memory_allowed();
    if (needs.bytes / NEEDS_FACTOR <= there || needs.largest_object < 0) {
        return true;
    }
    error_set(
        e, ERROR_INPUT,
        "%s asks for about %.1f GB of memory, and %.1f GB are there; a smaller number would be "
        "right",
        needs.largest_key, needs.largest * 1e-9, there * 1e-9);
    error_key(e, "%s", needs.largest_key);
    return scene_fail_object(scene, needs.largest_object, e);
}
