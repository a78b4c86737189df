// ramify replay: traces one path of a picture again and prints it.
#include "base/json.h"
#include "cli/command.h"

#include <stdio.h>

enum { MOST_STEPS = 1024 };

static void print_vector(const char *name, const float v[3])
{
    printf("  %-11s %12.6g %12.6g %12.6g\n", name, (double)v[0], (double)v[1], (double)v[2]);
}

static void print_step(const RamifyScene *scene, int number, const RamifyPathStep *step)
{
    printf("ray %d: %s", number, step->end);
    if (step->object >= 0) {
        printf(" of %s, %s", ramify_scene_object_name(scene, step->object), step->material);
    }
    printf("\n");
    print_vector("from", step->origin);
    print_vector("direction", step->direction);
    if (step->position[0] != step->origin[0] || step->position[1] != step->origin[1] ||
        step->position[2] != step->origin[2]) {
        print_vector("to", step->position);
    }
    if (step->object >= 0) {
        print_vector("normal", step->normal);
    }
    print_vector("throughput", step->throughput);
    print_vector("light", step->light);
}

static void put_vector(const char *name, const float v[3])
{
    printf(", \"%s\": [%.9g, %.9g, %.9g]", name, (double)v[0], (double)v[1], (double)v[2]);
}

static void print_json(const RamifyScene *scene, const RamifyPathStep *step, int count,
                       const float color[3])
{
    printf("{\"rays\": [");
    for (int i = 0; i < count; i++) {
        printf("%s{\"end\": ", i > 0 ? ",\n " : "");
        json_put_string(stdout, step[i].end);
        if (step[i].object >= 0) {
            printf(", \"object\": ");
            json_put_string(stdout, ramify_scene_object_name(scene, step[i].object));
            printf(", \"material\": ");
            json_put_string(stdout, step[i].material);
            put_vector("normal", step[i].normal);
        }
        put_vector("from", step[i].origin);
        put_vector("direction", step[i].direction);
        put_vector("to", step[i].position);
        put_vector("throughput", step[i].throughput);
        put_vector("light", step[i].light);
        printf("}");
    }
    printf("]");
    put_vector("color", color);
    printf("}\n");
}

static bool parse_pixel(const char *text, int pixel[2], RamifyError *e)
{
    char end;
    return sscanf(text, "%d,%d%c", &pixel[0], &pixel[1], &end) == 2 ||
           fail(e, RAMIFY_BAD_INPUT,
                "--pixel %.40s; it must be X,Y, counted from the upper left "
                "from 0, as in --pixel 310,207",
                text);
}

static bool replay(const Options *options, const RamifyScene *scene, const int pixel[2],
                   RamifyError *e)
{
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    RamifyWorld *world = ramify_build(scene, &run, e);
    RamifyRenderer *renderer = world ? ramify_renderer_new(world, options->isa, &run, e) : NULL;
    progress_end(&progress);
    RamifyPathStep step[MOST_STEPS];
    float color[3];
    int count = renderer ? ramify_renderer_replay(renderer, world, pixel[0], pixel[1],
                                                  options->sample, step, MOST_STEPS, color, e)
                         : -1;
    if (count >= 0 && options->json) {
        print_json(scene, step, count, color);
    } else if (count >= 0) {
        for (int i = 0; i < count; i++) {
            print_step(scene, i, &step[i]);
        }
        printf("sample %d of pixel %d, %d:\n", options->sample, pixel[0], pixel[1]);
        print_vector("color", color);
    }
    ramify_renderer_free(renderer);
    ramify_world_free(world);
    return count >= 0;
}

bool command_replay(const Options *options, RamifyError *e)
{
    int pixel[2] = {0, 0};
    bool valid = options->pixel ? parse_pixel(options->pixel, pixel, e)
                                : fail(e, RAMIFY_BAD_INPUT,
                                       "no pixel is named; add --pixel X,Y, as in --pixel 310,207");
    RamifyScene *scene =
        valid && ramify_check_isa(options->isa, e) ? command_scene(options, e) : NULL;
    bool done = scene && replay(options, scene, pixel, e);
    ramify_scene_free(scene);
    return done;
}
