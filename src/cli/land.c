#include "cli/land.h"

#include "cli/command.h"
#include "image/image.h"
#include "scene/kind.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

int land_count(const Scene *scene)
{
    int count = 0;
    for (int i = 0; i < scene->object_count; i++) {
        count += kind_of(&scene->objects[i])->heights ? 1 : 0;
    }
    return count;
}

// Key and value pairs as image.h wants them; ends with an empty key.
static void describe_field(const HeightField *field, float low, float high, char *text, size_t size)
{
    const struct {
        const char *key;
        float value;
    } pairs[] = {{"ramify:low", low}, {"ramify:high", high}, {"ramify:cell", field->cell.x}};
    size_t used = 0;
    for (int i = 0; i < 3 && used + 64 < size; i++) {
        used += (size_t)snprintf(text + used, size - used, "%s", pairs[i].key) + 1;
        used += (size_t)snprintf(text + used, size - used, "%.9g", (double)pairs[i].value) + 1;
    }
    text[used] = '\0';
}

static bool write_field(const char *file, const HeightField *field, Error *e)
{
    float low, high;
    char metadata[256];
    height_field_range(field, &low, &high);
    describe_field(field, low, high, metadata, sizeof metadata);
    Image image = {field->columns, field->rows, 1, field->height};
    if (output_has_ending(file, ".exr")) {
        ImageLayer layer = {"", "Y", &image};
        return image_write_exr(file, &layer, 1, metadata, e);
    }
    Image *scaled = image_new(field->columns, field->rows, 1, e);
    if (!scaled) {
        return false;
    }
    float scale = high > low ? 1.0f / (high - low) : 0.0f;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        scaled->pixel[i] = (field->height[i] - low) * scale;
    }
    bool done = image_write_grey16(file, scaled, metadata, e);
    image_free(scaled);
    return done;
}

static bool write_land(const Options *options, const Scene *scene, int index, const OutTree *tree,
                       const Run *run, Error *e)
{
    HeightField *field = scene_heights(scene, index, tree, run, e);
    if (!field) {
        return false;
    }
    bool done;
    if (land_count(scene) == 1) {
        done = write_field(options->output, field, e);
    } else {
        char ending[128];
        snprintf(ending, sizeof ending, "-%s%s", scene->objects[index].name,
                 output_has_ending(options->output, ".png") ? ".png" : ".exr");
        char *file = output_with_ending(options->output, ending, e);
        done = file && write_field(file, field, e);
        free(file);
    }
    if (done && !options->quiet) {
        float low, high;
        height_field_range(field, &low, &high);
        fprintf(stderr, "%s: heights %.1f to %.1f m, hash %016" PRIx64 "\n",
                scene->objects[index].name, (double)low, (double)high, height_field_hash(field));
    }
    height_field_free(field);
    return done;
}

bool land_write(const Options *options, const Scene *scene, OutTree *const *trees, const Run *run,
                Error *e)
{
    bool done = true;
    for (int i = 0; done && i < scene->object_count; i++) {
        if (kind_of(&scene->objects[i])->heights) {
            done = write_land(options, scene, i, trees[i], run, e);
        }
    }
    return done;
}
