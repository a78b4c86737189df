#include "golden/golden.h"

#include "base/file_replace.h"
#include "base/memory.h"
#include "golden/folder.h"
#include "golden/pinned.h"
#include "scene/needs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { STORED_SERIES = 0 };

const char *golden_status_name(GoldenStatus status)
{
    static const char *const names[] = {"alike",  "different", "missing",
                                        "failed", "stored",    "orphan"};
    return names[status];
}

GoldenOptions golden_options_default(void)
{
    return (GoldenOptions){
        .isa = PINNED_ISA, .mode = -1, .series = 1, .limits = {-1.0, -1.0, -1.0}};
}

static void clear_result(GoldenResult *result)
{
    free(result->name);
    comparison_clear(&result->comparison);
}

void golden_results_clear(GoldenResults *results)
{
    for (int64_t i = 0; i < results->count; i++) {
        clear_result(&results->item[i]);
    }
    free(results->item);
    *results = (GoldenResults){0};
}

static Limits limits_of(const SceneGolden *golden, GoldenMode mode, const Limits *asked)
{
    if (mode == GOLDEN_STATISTICAL) {
        return (Limits){-1.0, -1.0, -1.0};
    }
    bool exact = mode == GOLDEN_EXACT;
    Limits own = {exact ? 0.0 : golden->max_rmse, exact ? 0.0 : golden->threshold,
                  exact ? 0.0 : golden->max_failing};
    return (Limits){asked->max_rmse >= 0.0 ? asked->max_rmse : own.max_rmse,
                    asked->threshold >= 0.0 ? asked->threshold : own.threshold,
                    asked->max_failing >= 0.0 ? asked->max_failing : own.max_failing};
}

// Whether the stored image is missing, to be stored by an update; otherwise the status is not
// decided yet.
static bool is_missing(GoldenResult *result, const char *file)
{
    if (access(file, F_OK) == 0) {
        return false;
    }
    result->status = GOLDEN_MISSING;
    snprintf(result->message, sizeof result->message, "there is no %.600s; an update stores one",
             file);
    return true;
}

static void conclude(GoldenResult *result)
{
    result->compared = true;
    result->status = result->comparison.alike ? GOLDEN_ALIKE : GOLDEN_DIFFERENT;
    memcpy(result->message, result->comparison.message, sizeof result->comparison.message);
}

static void stored(GoldenResult *result)
{
    if (result->status == GOLDEN_MISSING) {
        strcpy(result->message, "there was none");
    }
    result->status = GOLDEN_STORED;
}

// ---- by PNG

static bool compare_with_png(const GoldenOptions *options, const Png *png, const char *file,
                             GoldenResult *result, Error *e)
{
    bool linear;
    Image *kept = image_read_color(file, &linear, NULL, e);
    Image *ours = kept ? image_decode_png(png->bytes, png->size, e) : NULL;
    bool done = ours && compare_images(ours, kept, false, &result->limits, options->pictures,
                                       &result->comparison, e);
    if (done) {
        conclude(result);
    }
    image_free(kept);
    image_free(ours);
    return done;
}

// Without a stored image only ours is shown.
static void show_ours(const Image *image, Png *png, Comparison *comparison)
{
    *comparison = (Comparison){.width = image->width, .height = image->height, .ours = *png};
    *png = (Png){0};
}

// The rendering is encoded as the PNG that would be stored; that PNG is compared.
static bool work_with_png(const GoldenOptions *options, const Scene *scene, const char *file,
                          const Run *run, GoldenResult *result, Error *e)
{
    Png png = {0};
    Image *linear = pinned_render(scene, options->isa, run, e);
    Image *shown = linear ? pinned_develop(scene, linear, e) : NULL;
    bool done = shown && image_encode_png(shown, NULL, &png.bytes, &png.size, e) &&
                (is_missing(result, file) || compare_with_png(options, &png, file, result, e));
    if (done && options->update && result->status != GOLDEN_ALIKE) {
        done = file_replace(file, png.bytes, png.size, e);
        if (done) {
            stored(result);
        }
    }
    if (done && options->pictures && !result->compared) {
        show_ours(shown, &png, &result->comparison);
    }
    image_free(linear);
    image_free(shown);
    free(png.bytes);
    return done;
}

// ---- by mean and variance

static bool compare_means(const GoldenOptions *options, const Scene *scene,
                          const NoisyPicture *ours, const NoisyPicture *kept, GoldenResult *result,
                          Error *e)
{
    Image *ours_shown = pinned_develop(scene, ours->mean, e);
    Image *kept_shown = ours_shown ? pinned_develop(scene, kept->mean, e) : NULL;
    Sides sides = {ours->mean, kept->mean, ours_shown, kept_shown};
    bool done = kept_shown && compare_noisy(&sides, ours, kept, result->alpha, options->pictures,
                                            &result->comparison, e);
    if (done) {
        conclude(result);
    }
    image_free(ours_shown);
    image_free(kept_shown);
    return done;
}

static bool compare_with_exr(const GoldenOptions *options, const Scene *scene, Pinned *pinned,
                             const char *file, const Run *run, GoldenResult *result, Error *e)
{
    NoisyPicture kept = {0}, ours = {0};
    bool done = noisy_picture_read(&kept, file, e) &&
                pinned_render_noisy(pinned, options->series, scene->golden.runs, run, &ours, e) &&
                compare_means(options, scene, &ours, &kept, result, e);
    noisy_picture_clear(&kept);
    noisy_picture_clear(&ours);
    return done;
}

static bool store_exr(const Scene *scene, Pinned *pinned, const char *file, const Run *run,
                      GoldenResult *result, Error *e)
{
    NoisyPicture picture;
    bool done = pinned_render_noisy(pinned, STORED_SERIES, scene->golden.runs, run, &picture, e) &&
                noisy_picture_write(&picture, file, e);
    noisy_picture_clear(&picture);
    if (done) {
        stored(result);
    }
    return done;
}

static bool work_with_exr(const GoldenOptions *options, const Scene *scene, const char *file,
                          const Run *run, GoldenResult *result, Error *e)
{
    result->alpha = scene->golden.alpha;
    if (!pinned_check(scene, e)) {
        return false;
    }
    bool missing = is_missing(result, file);
    Pinned *pinned = !missing || options->update ? pinned_open(scene, options->isa, run, e) : NULL;
    bool done =
        (missing && !options->update) ||
        (pinned && (missing || compare_with_exr(options, scene, pinned, file, run, result, e)));
    if (done && options->update && result->status != GOLDEN_ALIKE) {
        done = store_exr(scene, pinned, file, run, result, e);
    }
    pinned_close(pinned);
    return done;
}

// ---- all scenes of a folder

static bool work(const char *scene_file, const GoldenOptions *options, const Run *run,
                 GoldenResult *result, Error *e)
{
    Scene *scene = scene_read(scene_file, NULL, 0, e);
    if (!scene || !scene_limit_memory(scene, (double)options->memory, 0.0, e)) {
        scene_free(scene);
        return false;
    }
    result->mode = options->mode >= 0 ? (GoldenMode)options->mode : scene->golden.mode;
    result->limits = limits_of(&scene->golden, result->mode, &options->limits);
    bool statistical = result->mode == GOLDEN_STATISTICAL;
    char *file = folder_with_ending(scene_file, statistical ? ".exr" : ".png", e);
    bool done =
        file && (statistical ? work_with_exr : work_with_png)(options, scene, file, run, result, e);
    free(file);
    scene_free(scene);
    return done;
}

static GoldenResult *add_result(GoldenResults *results, const char *name, Error *e)
{
    if (!memory_reserve(&results->item, &results->capacity, results->count + 1,
                        sizeof *results->item, e)) {
        return NULL;
    }
    GoldenResult *result = &results->item[results->count];
    *result = (GoldenResult){.name = memory_copy_string(name, e)};
    results->count += result->name != NULL;
    return result->name ? result : NULL;
}

static void hand_out(const GoldenOptions *options, GoldenResults *results,
                     const GoldenResult *result)
{
    results->counts[result->status]++;
    if (options->each) {
        options->each(options->user, result);
    }
}

// Runs a scene. A failing scene is a result; only errors of the whole run end it.
static bool run_scene(const FolderScene *scene, const GoldenOptions *options, const Run *run,
                      GoldenResults *results, Error *e)
{
    GoldenResult *result = add_result(results, scene->name, e);
    if (!result) {
        return false;
    }
    Error own = {0};
    double start = run_seconds();
    bool done = work(scene->file, options, run, result, &own);
    result->seconds = run_seconds() - start;
    if (!done && (own.code == ERROR_CANCELLED || own.code == ERROR_MEMORY)) {
        clear_result(&results->item[--results->count]);
        if (e) {
            *e = own;
        }
        return false;
    }
    if (!done) {
        result->status = GOLDEN_FAILED;
        error_format(&own, result->message, sizeof result->message);
    }
    hand_out(options, results, result);
    return true;
}

static bool add_orphans(const Folder *folder, const GoldenOptions *options, GoldenResults *results,
                        Error *e)
{
    for (int64_t i = 0; i < folder->orphan_count; i++) {
        GoldenResult *result = add_result(results, folder->orphans[i], e);
        if (!result) {
            return false;
        }
        result->status = GOLDEN_ORPHAN;
        strcpy(result->message, "a stored image without a scene");
        hand_out(options, results, result);
    }
    return true;
}

bool golden_run(const char *folder, const GoldenOptions *options, const Run *run,
                GoldenResults *results, Error *e)
{
    Folder listing;
    *results = (GoldenResults){0};
    bool done = folder_list(folder, options->filter, &listing, e);
    for (int64_t i = 0; done && i < listing.scene_count; i++) {
        done = (!run_is_cancelled(run) || run_cancel_error(e)) &&
               run_scene(&listing.scenes[i], options, run, results, e);
    }
    done = done && add_orphans(&listing, options, results, e);
    folder_clear(&listing);
    return done;
}
