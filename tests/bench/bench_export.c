// Writing 5 million triangles: a bark-covered trunk of 2.5 million quads with everything at its
// vertices, to every mesh format; against plain writes of as many bytes to the same folder, brought
// to the disk as well. And how much more memory that took. TMPDIR names the folder.
#include "base/memory.h"
#include "export/export.h"
#include "export/formats.h"
#include "render/world.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { AROUND = 1000, ALONG = 2500 };

static void stop(const char *why)
{
    fprintf(stderr, "%s\n", why);
    exit(1);
}

static Mesh *trunk(Error *e)
{
    Mesh *mesh = mesh_new(4, (int64_t)AROUND * (ALONG + 1), (int64_t)AROUND * ALONG,
                          MESH_NORMAL | MESH_UV | MESH_RADIUS | MESH_BIRTH, e);
    if (!mesh) {
        stop(e->message);
    }
    for (int j = 0; j <= ALONG; j++) {
        for (int i = 0; i < AROUND; i++) {
            int64_t v = (int64_t)j * AROUND + i;
            float angle = 2.0f * PI_F * (float)i / (float)AROUND, y = 0.004f * (float)j;
            mesh->normal[v] = vec3(sinf(angle), 0.0f, cosf(angle));
            mesh->radius[v] = 0.6f - 0.02f * y;
            mesh->position[v] = vec3_scale(mesh->normal[v], mesh->radius[v]);
            mesh->position[v].y = y;
            mesh->uv[v] = (Vec2){0.6f * (float)(i < AROUND / 2 ? i : AROUND - i) * 0.00628f, y};
            mesh->birth[v] = (float)j / (float)ALONG;
        }
    }
    for (int64_t f = 0; f < mesh->face_count; f++) {
        uint32_t v = (uint32_t)f, next = f % AROUND + 1 < AROUND ? v + 1 : v + 1 - AROUND;
        memcpy(mesh->index + 4 * f, (uint32_t[]){v, next, next + AROUND, v + AROUND}, 16);
    }
    return mesh;
}

// Seconds to write that many bytes and bring them to the disk.
static double plain_write(const char *file, int64_t bytes)
{
    enum { BLOCK = 1 << 20 };
    static char block[BLOCK];
    for (int i = 0; i < BLOCK; i++) {
        block[i] = (char)(i * 7);
    }
    double start = run_seconds();
    int descriptor = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    for (int64_t left = bytes; left > 0;) {
        ssize_t done = write(descriptor, block, left < BLOCK ? (size_t)left : BLOCK);
        if (done <= 0) {
            stop("the plain write failed");
        }
        left -= done;
    }
    if (fsync(descriptor) != 0 || close(descriptor) != 0) {
        stop("the plain write failed");
    }
    return run_seconds() - start;
}

int main(void)
{
    Error e = {0};
    const char *folder = getenv("TMPDIR");
    char file[4096];
    World *world = world_new(&e);
    const char *name = "trunk";
    Run run = run_default();
    run.threads = 2;
    world->material = memory_alloc_zero(1, sizeof *world->material, &e);
    world->material[0] = material_default(MATERIAL_PRINCIPLED);
    world->material[0].pattern = PATTERN_BARK;
    world->material_count = 1;
    if (!geometry_add(&world->geometry, (Part){.kind = PART_MESH, .mesh = trunk(&e)}, &e)) {
        stop(e.message);
    }
    ExportSource source = {
        .title = "bench", .world = world, .object_count = 1, .object_name = &name};
    const char *const endings[] = {".ply", ".glb", ".stl", ".obj"};
    for (int i = 0; i < 4; i++) {
        snprintf(file, sizeof file, "%s/ramify-bench-%ld%s", folder ? folder : "/tmp",
                 (long)getpid(), endings[i]);
        int64_t before = memory_peak();
        double start = run_seconds();
        clock_t processor = clock();
        if (!export_format(file)->write(&source, file, &run, &e)) {
            stop(e.message);
        }
        double seconds = run_seconds() - start;
        double busy = (double)(clock() - processor) / CLOCKS_PER_SEC;
        struct stat status;
        if (stat(file, &status) != 0) {
            stop("the file is gone");
        }
        double plain = plain_write(file, status.st_size);
        unlink(file);
        printf("5 million triangles to %s: %.2f s (%.2f s of processors), %.0f MB, %.1f times a "
               "plain write (%.2f s); "
               "%.0f MB more memory at most\n",
               endings[i], seconds, busy, (double)status.st_size * 1e-6, seconds / plain, plain,
               (double)(memory_peak() - before) * 1e-6);
        if (strcmp(endings[i], ".obj") == 0) {
            snprintf(file + strlen(file) - 4, 5, ".mtl");
            unlink(file);
        }
    }
    world_free(world);
    return 0;
}
