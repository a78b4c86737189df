#include "animate/checkpoint.h"

#include "animate/frames.h"
#include "base/file_name.h"
#include "base/memory.h"
#include "image/image.h"
#include "scene/picture.h"
#include "scene/picture_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char *name_beside(const char *picture, Error *e)
{
    int stem = (int)(strlen(picture) - strlen(file_name_ending(picture)));
    size_t room = (size_t)stem + sizeof CHECKPOINT_ENDING;
    char *name = memory_alloc((int64_t)room, 1, e);
    if (name) {
        snprintf(name, room, "%.*s%s", stem, picture, CHECKPOINT_ENDING);
    }
    return name;
}

bool checkpoint_begin(Checkpoint *checkpoint, const char *picture, const Scene *scene,
                      const char *mark, double every, const Run *run, Error *e)
{
    *checkpoint = (Checkpoint){
        .scene = scene, .mark = mark, .run = run, .clock = save_clock_start(every, run_seconds())};
    checkpoint->file = every > 0.0 ? name_beside(picture, e) : NULL;
    return checkpoint->file || every <= 0.0;
}

void checkpoint_clear(Checkpoint *checkpoint)
{
    free(checkpoint->file);
    checkpoint->file = NULL;
}

Film *checkpoint_read(const Checkpoint *checkpoint)
{
    if (!checkpoint->file || access(checkpoint->file, F_OK) != 0) {
        return NULL;
    }
    Error e = {0};
    char *mark = image_read_metadata(checkpoint->file, PICTURE_MARK, NULL, &e);
    bool ours = mark && strcmp(mark, checkpoint->mark) == 0;
    Film *film =
        ours ? picture_read_film(checkpoint->file, checkpoint->scene, false, checkpoint->run, &e)
             : NULL;
    if (!film && (ours || !mark)) {
        run_warn(checkpoint->run, "%s", e.message);
    }
    free(mark);
    return film;
}

void checkpoint_save(Checkpoint *checkpoint, const Film *film)
{
    if (!checkpoint->file) {
        return;
    }
    Error e = {0};
    double start = run_seconds();
    if (!picture_write_part(checkpoint->file, checkpoint->scene, film, checkpoint->mark, &e)) {
        run_warn(checkpoint->run, "%s", e.message);
        checkpoint_clear(checkpoint);
    }
    save_clock_saved(&checkpoint->clock, start, run_seconds());
}

void checkpoint_pass(void *user, const Film *film, int samples)
{
    Checkpoint *checkpoint = user;
    if (samples < render_end(&checkpoint->scene->render) &&
        save_clock_is_due(&checkpoint->clock, run_seconds())) {
        checkpoint_save(checkpoint, film);
    }
}

void checkpoint_remove(const char *picture)
{
    char *file = name_beside(picture, NULL);
    if (file) {
        unlink(file);
    }
    free(file);
}
