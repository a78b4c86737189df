// Figures of speed of blood vessels: an organ filled with arteries and veins, all of it (level set,
// growth, clearing, radii, angles). RAMIFY_ORGAN names a mesh to fill; without it a bean of
// ellipsoids, a level set too, is filled. User time of all threads counts, wall time is beside it.
#include "objects/vessels/vessels.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

static double user_seconds(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec;
}

static Shape ellipsoid(float x, float y)
{
    return (Shape){.kind = SHAPE_ELLIPSOID,
                   .size = vec3(0.025f, 0.028f, 0.023f),
                   .transform = transform_compose(vec3(x, y, 0), vec3(0, 0, 0), vec3(1, 1, 1))};
}

static int fill(VesselsParams *params, int64_t terminals, double limit)
{
    params->terminals = terminals;
    Run run = run_default();
    run.threads = 2;
    Recipe recipe = {.seed = 1, .label = "organ", .run = &run};
    Error e = {0};
    double user = user_seconds(), start = run_seconds();
    Grown grown = {0};
    bool done = vessels_grow(params, &recipe, &grown, &e);
    user = user_seconds() - user;
    double wall = run_seconds() - start;
    MeasureList list = {0};
    if (!done || !vessels_measure(params, &grown, &recipe, &list, &e)) {
        fprintf(stderr, "%s\n", e.message);
        grown_clear(&grown);
        return 1;
    }
    printf("vessels, %lld terminals: %lld nodes, flow conserved to %.1e, %.0f %% of forks exact, "
           "artery to vein at least %.2g m\n",
           (long long)terminals, (long long)grown.tree->count,
           measures_find(&list, "flow_residual")->value,
           100.0 * measures_find(&list, "murray_angle_exact_share")->value,
           measures_find(&list, "artery_vein_gap")->value);
    printf("  user time                       %6.2f s (at most %.0f; wall %.2f s, 2 threads)\n",
           user, limit, wall);
    measures_clear(&list);
    grown_clear(&grown);
    return 0;
}

int main(void)
{
    Shape bean[3] = {ellipsoid(0.006f, 0.026f), ellipsoid(-0.006f, 0), ellipsoid(0.006f, -0.026f)};
    Shape mesh = {.kind = SHAPE_MESH, .transform = transform_identity()};
    mesh.file = getenv("RAMIFY_ORGAN");
    VesselsParams params = vessels_params_default();
    params.element.shapes = mesh.file ? &mesh : bean;
    params.element.shape_count = mesh.file ? 1 : 3;
    return fill(&params, 3000, 2.0) || fill(&params, 1000000, 60.0);
}
