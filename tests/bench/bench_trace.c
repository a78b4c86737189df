// The path tracer's figure of speed: paths per second on a tree of some 600,000 triangles, diffuse
// grey under an even sky, 8 bounces, 960 x 540, 2 threads, with the whole integrator at work.
//
//     bench_trace [YARDSTICK [MESH.ply [SAMPLES]]]
//
// YARDSTICK is a program that is given a PLY file, a number of samples and a file to write, and
// prints "... PATHS Msamples/s". It is run in turn with ours; the best round of each counts.
// Without MESH.ply a tree is grown and skinned crudely with open tubes.
#include "base/memory.h"
#include "base/random.h"
#include "grow/colonize.h"
#include "outtree/radii.h"
#include "render/renderer.h"
#include "render/world.h"
#include "shape/import.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ROUNDS = 3, WIDTH = 960, HEIGHT = 540, SIDES = 8 };

static void stop(const char *what, const Error *e)
{
    fprintf(stderr, "bench_trace: %s: %s\n", what, e ? e->message : "failed");
    exit(1);
}

static OutTree *grow_tree(void)
{
    Error e = {0};
    PointSet *points = points_new(&e);
    points->measure = 4.18879;
    points->dimension = 3;
    for (uint64_t draw = 0; points->count < 100000; draw++) {
        uint64_t key = random_key(42, draw);
        Vec3 p =
            vec3(random_range(random_key(key, 0), -1, 1), random_range(random_key(key, 1), -1, 1),
                 random_range(random_key(key, 2), -1, 1));
        if (vec3_dot(p, p) < 1.0f && !points_add(points, p, vec3(0, 1, 0), draw, &e)) {
            stop("points", &e);
        }
    }
    OutTree *tree = out_tree_new(&e);
    out_tree_add_node(tree, vec3(0, -1, 0), -1, 0, 0, 1, &e);
    ColonizeParams params = colonize_params_default();
    colonize_auto(&params, points_spacing(points), 0.5f, 1.5f, 6.0f);
    Run run = run_default();
    GrowReport report;
    if (!colonize(tree, points, &params, &run, &report, &e)) {
        stop("growth", &e);
    }
    out_tree_pipe_radii(tree, 2.3f, 0.0006f, 0.05f);
    points_free(points);
    return tree;
}

static void write_tube(FILE *file, Vec3 from, Vec3 to, float radius)
{
    Vec3 d = vec3_normalize(vec3_sub(to, from)), u = vec3_perpendicular(d), w = vec3_cross(d, u);
    for (int k = 0; k < 2 * SIDES; k++) {
        float angle = 2.0f * PI_F * (float)(k % SIDES) / SIDES;
        Vec3 side = vec3_madd(vec3_scale(u, cosf(angle)), sinf(angle), w);
        Vec3 p = vec3_madd(k < SIDES ? from : to, radius, side);
        fwrite(&p, sizeof p, 1, file);
    }
}

static void write_faces(FILE *file, int64_t tubes)
{
    for (int64_t i = 0; i < tubes; i++) {
        for (int k = 0; k < SIDES; k++) {
            int32_t a = (int32_t)(i * 2 * SIDES) + k,
                    b = (int32_t)(i * 2 * SIDES) + (k + 1) % SIDES;
            const int32_t corner[2][3] = {{a, b, a + SIDES}, {b, b + SIDES, a + SIDES}};
            for (int t = 0; t < 2; t++) {
                fputc(3, file);
                fwrite(corner[t], sizeof corner[t], 1, file);
            }
        }
    }
}

// Returns the name of a temporary PLY file, to be unlinked and freed.
static char *write_tree(void)
{
    OutTree *tree = grow_tree();
    char name[] = "/tmp/bench_trace_XXXXXX.ply";
    int descriptor = mkstemps(name, 4);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "wb");
    if (!file) {
        stop(name, NULL);
    }
    int64_t tubes = tree->count - 1, vertices = tubes * 2 * SIDES; // and as many triangles
    fprintf(file,
            "ply\nformat binary_little_endian 1.0\nelement vertex %lld\nproperty float x\n"
            "property float y\nproperty float z\nelement face %lld\n"
            "property list uchar int vertex_indices\nend_header\n",
            (long long)vertices, (long long)vertices);
    for (int64_t i = 1; i < tree->count; i++) {
        write_tube(file, tree->position[tree->parent[i]], tree->position[i], tree->radius[i]);
    }
    write_faces(file, tubes);
    fclose(file);
    out_tree_free(tree);
    return strdup(name);
}

// The mesh on a ground plane, as the yardstick has it.
static World *make_world(const char *ply, int samples)
{
    Error e = {0};
    World *world = world_new(&e);
    world->camera.position = vec3(0.0f, 0.2f, 3.2f);
    world->camera.target = vec3(0.0f, -0.1f, 0.0f);
    world->camera.fov = 0.8f / RADIANS_PER_DEGREE;
    world->film.width = WIDTH;
    world->film.height = HEIGHT;
    world->render.samples = samples;
    world->render.max_depth = world->render.roulette_depth = 8;
    world->sky.kind = SKY_CONSTANT;
    world->material = memory_alloc(1, sizeof *world->material, &e);
    world->material[0] = material_default(MATERIAL_DIFFUSE);
    world->material[0].color = vec3_splat(0.5f);
    world->material[0].roughness = 0.0f;
    world->material_count = 1;
    Mesh *mesh = mesh_import(ply, &(Run){.threads = 1}, &e);
    Mesh *ground = mesh_new(4, 4, 1, 0, &e);
    if (!mesh || !ground) {
        stop(ply, &e);
    }
    const Vec3 corner[4] = {{-10, -1, 10}, {10, -1, 10}, {10, -1, -10}, {-10, -1, -10}};
    memcpy(ground->position, corner, sizeof corner);
    memcpy(ground->index, (uint32_t[4]){0, 1, 2, 3}, 4 * sizeof(uint32_t));
    if (!geometry_add(&world->geometry, (Part){.kind = PART_MESH, .mesh = mesh}, &e) ||
        !geometry_add(&world->geometry, (Part){.kind = PART_MESH, .mesh = ground}, &e)) {
        stop("geometry", &e);
    }
    return world;
}

static double yardstick_rate(const char *program, const char *ply, int samples)
{
    char line[1024];
    snprintf(line, sizeof line, "%s %s %d /dev/null", program, ply, samples);
    FILE *pipe = popen(line, "r"); // NOLINT(cert-env33-c): a benchmark's own argument
    double rate = 0.0;
    while (pipe && fgets(line, sizeof line, pipe)) {
        char *unit = strstr(line, " Msamples/s");
        while (unit && unit > line && unit[-1] != ' ') {
            unit--;
        }
        rate = unit ? strtod(unit, NULL) * 1e6 : rate;
    }
    if (pipe) {
        pclose(pipe);
    }
    return rate;
}

int main(int argc, char **argv)
{
    const char *yardstick = argc > 1 && argv[1][0] ? argv[1] : NULL;
    char *own = argc > 2 ? NULL : write_tree();
    const char *ply = own ? own : argv[2];
    int samples = argc > 3 ? atoi(argv[3]) : 32;
    World *world = make_world(ply, samples);
    Error e = {0};
    Run run = run_default();
    run.threads = 2;
    double start = run_seconds();
    Renderer *renderer = renderer_new(world, NULL, &run, &e);
    Film *film = film_new(WIDTH, HEIGHT, &e);
    if (!renderer || !film) {
        stop("building", &e);
    }
    double building = run_seconds() - start, ours = 0.0, rays = 0.0, other = 0.0;
    for (int round = 0; round < ROUNDS; round++) {
        RenderStats stats = {0};
        if (!renderer_render(renderer, film, &run, NULL, NULL, &stats, &e)) {
            stop("rendering", &e);
        }
        double rate = (double)stats.paths / stats.seconds;
        ours = rate > ours ? rate : ours;
        rays = (double)stats.rays / (double)stats.paths;
        rate = yardstick ? yardstick_rate(yardstick, ply, samples) : 0.0;
        other = rate > other ? rate : other;
    }
    printf(
        "tracing, %lld triangles, %d samples, 2 threads: %.2f M paths/s, %.2f M rays/s, built in "
        "%.2f s\n",
        (long long)geometry_counts(&world->geometry).triangles, samples, ours * 1e-6,
        rays * ours * 1e-6, building);
    if (other > 0.0) {
        printf("  paths per second / yardstick    %6.2f   (at least 0.7; %.2f M/s and %.2f M/s)\n",
               ours / other, ours * 1e-6, other * 1e-6);
    }
    film_free(film);
    renderer_free(renderer);
    world_free(world);
    if (own) {
        unlink(own);
        free(own);
    }
    return 0;
}
