// Renders one still after another in one process through libramify.so, and prints what memory is in
// use after each, when all handles are freed.
//   soak FILE.png SCENE...      FILE.png is written again by each
// A line "number heap rss" for each still: bytes that are allocated, and bytes of the process in
// memory. A scene that cannot be rendered gives its error on stderr, and no line.
#include "ramify.h"

#include <inttypes.h>
#include <malloc.h>
#include <stdio.h>
#include <unistd.h>

static bool render(const char *file, const char *picture, RamifyError *e)
{
    RamifyRun run = {.threads = 2};
    RamifyRenderInfo info;
    int width = 0, height = 0;
    RamifyScene *scene = ramify_scene_load(file, NULL, 0, e);
    if (scene) {
        ramify_scene_size(scene, &width, &height);
    }
    RamifyWorld *world = scene ? ramify_build(scene, &run, e) : NULL;
    RamifyRenderer *renderer = world ? ramify_renderer_new(world, NULL, &run, e) : NULL;
    RamifyFilm *film = renderer ? ramify_film_new(width, height, e) : NULL;
    bool done = film && ramify_renderer_render(renderer, film, NULL, NULL, &run, &info, e) &&
                ramify_film_write(film, scene, picture, true, &run, e);
    ramify_film_free(film);
    ramify_renderer_free(renderer);
    ramify_world_free(world);
    ramify_scene_free(scene);
    return done;
}

// Of all arenas; mmapped blocks included.
static size_t heap_bytes(void)
{
    struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

static int64_t resident_bytes(void)
{
    int64_t pages = 0;
    FILE *stream = fopen("/proc/self/statm", "r");
    if (!stream || fscanf(stream, "%*d %" SCNd64, &pages) != 1) {
        pages = 0;
    }
    if (stream) {
        fclose(stream);
    }
    return pages * sysconf(_SC_PAGESIZE);
}

int main(int argc, char **argv)
{
    if (argc < 3) {
        fprintf(stderr, "usage: soak FILE.png SCENE...\n");
        return 2;
    }
    setvbuf(stdout, NULL, _IOLBF, 256); // no buffer that grows
    for (int i = 2; i < argc; i++) {
        RamifyError e = {0};
        if (render(argv[i], argv[1], &e)) {
            printf("%d %zu %" PRId64 "\n", i - 1, heap_bytes(), resident_bytes());
        } else {
            fprintf(stderr, "%s: %s\n", argv[i], e.message);
        }
    }
    return 0;
}
