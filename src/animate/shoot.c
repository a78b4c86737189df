#include "animate/shoot.h"

#include "animate/checkpoint.h"
#include "animate/finish.h"
#include "animate/frames.h"
#include "animate/pattern.h"
#include "animate/video.h"
#include "base/file_beside.h"
#include "base/file_name.h"
#include "base/file_replace.h"
#include "base/memory.h"
#include "base/random.h"
#include "scene/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { METERED_FRAMES = 4, METER_SIZE = 96, METER_SAMPLES = 16 };

// A frame to render.
typedef struct Shot {
    int frame;
    char mark[FRAME_MARK_SIZE];
} Shot;

typedef struct Shooting {
    const Scene *scene;
    const ShootParams *params;
    const Run *run;
    ShootStats *stats;
    Turntable *turntable;
    int start, end; // frames, inclusive
    char *video;    // path of the video file, links resolved; NULL = none
    char *folder;   // folder of a video's frames; NULL = none
    int hold;       // lock on the folder; -1 = none
    char *pattern;  // pattern of the frames' names
    Stage *stage;   // NULL until the first frame
    Vec3 *eye;      // the camera's position in each frame of the turntable
    Views views;    // of them
    Film *film[2];  // one is traced while the other is written
    Finisher *finisher;
    Shot *shot;
    int shot_count;
    int at;     // index of the shot being traced
    int handed; // number of shots passed to the finisher
} Shooting;

// ---- outputs

static bool is_film(const char *output)
{
    return file_name_ends(output, ".mp4");
}

// A pattern in the folder's name is not checked here; writing the frames fails.
static bool check_folder(const char *output, Error *e)
{
    const char *slash = strrchr(output, '/'), *percent = strchr(output, '%');
    return (slash && percent && percent < slash) || file_replace_check(output, e);
}

bool shoot_check_output(const char *output, Error *e)
{
    if (is_film(output)) {
        return file_replace_fits(output, FRAMES_EXTRA, e) && check_folder(output, e) &&
               video_check(e);
    }
    if (!file_name_ends(output, ".png") && !file_name_ends(output, ".jpg") &&
        !file_name_ends(output, ".jpeg") && !file_name_ends(output, ".exr")) {
        return error_set(e, ERROR_INPUT,
                         "'%s'; it must end in .mp4, or in .png, .jpg or .exr with the frame's "
                         "number in the name, as in oak-%%04d.png",
                         output);
    }
    return pattern_check(output, e) && check_folder(output, e);
}

static bool plan_output(Shooting *s, Error *e)
{
    if (!shoot_check_output(s->params->output, e) || !image_files_check(e)) {
        return false;
    }
    if (!is_film(s->params->output)) {
        s->pattern = memory_copy_string(s->params->output, e);
        return s->pattern;
    }
    int width = s->scene->film.width / s->scene->downsample;
    int height = s->scene->film.height / s->scene->downsample;
    if (width < 2 || height < 2) {
        return error_set(e, ERROR_INPUT, "a film of %d x %d pixels; it must have 2 x 2 at least",
                         width, height);
    }
    char target[PATH_MAX];
    s->video = file_target(s->params->output, target, e) ? memory_copy_string(target, e) : NULL;
    s->folder = s->video ? frames_folder(s->video, e) : NULL;
    s->pattern = s->folder ? frames_pattern(s->folder, e) : NULL;
    s->hold = s->pattern ? frames_folder_take(s->folder, e) : -1;
    return s->hold >= 0;
}

// ---- frames to render

// Number of the index-th frame from which the shared exposure is metered.
static int metered_frame(const Shooting *s, int index)
{
    return (int)((int64_t)turntable_frames(s->turntable) * index / METERED_FRAMES);
}

// Hash of everything the shared exposure is metered from; 0 = each frame has its scene's exposure.
static bool hash_metered(const Shooting *s, uint64_t *hash, Error *e)
{
    *hash = 0;
    for (int i = 0; i < METERED_FRAMES && turntable_exposes_itself(s->turntable); i++) {
        Scene *scene = turntable_scene(s->turntable, metered_frame(s, i), e);
        if (!scene) {
            return false;
        }
        *hash = random_key(*hash, frame_hash(scene));
        scene_free(scene);
    }
    return true;
}

static bool check_size(const Shooting *s, const Scene *scene, int frame, Error *e)
{
    const FilmParams *first = &s->scene->film, *now = &scene->film;
    return (now->width == first->width && now->height == first->height) ||
           error_set(e, ERROR_INPUT,
                     "frame %d has %d x %d pixels, the scene %d x %d; all frames have one size",
                     frame, now->width, now->height, first->width, first->height);
}

static void note_view(Shooting *s, const Scene *scene)
{
    Views *views = &s->views;
    float angle = camera_frame(&scene->camera, scene->film.width, scene->film.height).pixel_angle;
    views->pixel_angle = views->count == 0 ? angle : fminf(views->pixel_angle, angle);
    s->eye[views->count++] = scene->camera.position;
}

// Reads the scenes of all frames, also of those that are not rendered now: a frame must not depend
// on the range in which it is rendered. An invalid frame outside of the range is no error.
static bool find_views(Shooting *s, Error *e)
{
    int frames = turntable_frames(s->turntable);
    s->eye = memory_alloc(frames, sizeof *s->eye, e);
    for (int frame = 0; s->eye && frame < frames; frame++) {
        if (run_is_cancelled(s->run)) {
            return run_cancel_error(e);
        }
        bool wanted = frame >= s->start && frame <= s->end;
        Scene *scene = turntable_scene(s->turntable, frame, wanted ? e : NULL);
        if (scene) {
            note_view(s, scene);
        }
        scene_free(scene);
        if (!scene && wanted) {
            return false;
        }
    }
    s->views.eye = s->eye;
    return s->eye;
}

// Reads every frame's scene, so that an invalid frame is detected before hours of rendering.
static bool find_shots(Shooting *s, Error *e)
{
    uint64_t metered;
    int oidn = 0;
    if (!picture_is_exr(s->pattern) && !picture_check_color(s->scene, e)) {
        return false;
    }
    if (s->scene->denoise && !picture_find_denoiser(s->scene, &oidn, s->run, e)) {
        return false;
    }
    s->shot = memory_alloc(s->end - s->start + 1, sizeof *s->shot, e);
    if (!s->shot || !hash_metered(s, &metered, e)) {
        return false;
    }
    uint64_t more = random_key(metered, frames_hash(s->scene, s->params->isa));
    more = oidn ? random_key(more, (uint64_t)oidn) : more;
    for (int frame = s->start; frame <= s->end; frame++) {
        if (run_is_cancelled(s->run)) {
            return run_cancel_error(e);
        }
        Scene *scene = turntable_scene(s->turntable, frame, e);
        char *file =
            scene && check_size(s, scene, frame, e) ? pattern_name(s->pattern, frame, e) : NULL;
        if (file) {
            Shot shot = {.frame = frame};
            frame_mark(scene, more, shot.mark);
            if (frame_is_finished(file, shot.mark)) {
                s->stats->skipped++;
            } else {
                s->shot[s->shot_count++] = shot;
            }
        }
        bool done = file;
        free(file);
        scene_free(scene);
        if (!done) {
            return false;
        }
    }
    return true;
}

// ---- exposure

// Renders a small picture of a frame and measures its exposure, stops. NAN and e on failure.
static double meter_frame(Shooting *s, int frame, Error *e)
{
    double stops = (double)NAN;
    Scene *scene = turntable_scene(s->turntable, frame, e);
    if (!scene) {
        return stops;
    }
    int most = scene->film.width > scene->film.height ? scene->film.width : scene->film.height;
    if (most > METER_SIZE) {
        scene->film.width = (scene->film.width * METER_SIZE + most - 1) / most;
        scene->film.height = (scene->film.height * METER_SIZE + most - 1) / most;
    }
    scene->render.samples = METER_SAMPLES;
    scene->render.first_sample = scene->render.end_sample = 0;
    scene->render.max_seconds = 0.0;
    scene->render.max_noise = 0.0f;
    float whole[4] = {0.0f, 0.0f, 1.0f, 1.0f};
    memcpy(scene->film.crop, whole, sizeof whole);
    Film *film = film_new(scene->film.width, scene->film.height, e);
    RenderStats stats;
    if (!film) {
        scene_free(scene);
    } else if (stage_set(s->stage, scene, s->run, e) &&
               stage_render(s->stage, film, s->run, &stats, e)) {
        stops = run_is_cancelled(s->run) ? (run_cancel_error(e), (double)NAN)
                                         : picture_metered_stops(film, e);
    }
    film_free(film);
    return stops;
}

// Automatic exposure per frame would flicker: all frames get the mean exposure of a few.
static bool lock_exposure(Shooting *s, Error *e)
{
    if (!turntable_exposes_itself(s->turntable)) {
        return true;
    }
    double sum = 0.0;
    for (int i = METERED_FRAMES - 1; i >= 0; i--) { // the first frame last, since it stays set up
        double stops = meter_frame(s, metered_frame(s, i), e);
        if (isnan(stops)) {
            return false;
        }
        sum += stops;
    }
    turntable_lock_exposure(s->turntable, sum / METERED_FRAMES);
    return true;
}

// ---- frames

// Reports overall progress, and for the first frame its stages as well.
static void tell(void *user, const char *stage, double done)
{
    const Shooting *s = user;
    if (strcmp(stage, "trace") == 0) {
        char text[64];
        snprintf(text, sizeof text, "frame %d of %d", s->stats->skipped + s->at + 1,
                 s->stats->skipped + s->shot_count);
        run_progress(s->run, text, ((double)s->at + done) / (double)s->shot_count);
    } else if (s->at == 0) {
        run_progress(s->run, stage, done);
    }
}

static void pass_warning(void *user, const char *message)
{
    const Shooting *s = user;
    if (s->at == 0 && s->run->warn) { // every frame would repeat it
        s->run->warn(s->run->user, message);
    }
}

static Run own_run(Shooting *s)
{
    Run run = *s->run;
    run.progress = tell;
    run.warn = pass_warning;
    run.user = s;
    return run;
}

// Makes *film the frame's: as an earlier run has saved it, or without samples.
static bool load_film(Shooting *s, const Scene *scene, const Checkpoint *checkpoint, Film **film,
                      Error *e)
{
    Film *saved = checkpoint_read(checkpoint);
    if (saved) {
        film_free(*film);
        *film = saved;
        return true;
    }
    if (*film) {
        film_forget(*film, scene->film.crop);
    } else {
        *film = film_new(s->scene->film.width, s->scene->film.height, e);
    }
    return *film;
}

// Traces the film of the scene that is set up, saving it now and then, and when cancelled.
static bool trace_film(Shooting *s, const Scene *scene, const char *file, Film **film,
                       const Run *run, Error *e)
{
    Checkpoint checkpoint;
    RenderStats stats;
    double every = s->params->checkpoint;
    if (!checkpoint_begin(&checkpoint, file, scene, s->shot[s->at].mark, every, s->run, e)) {
        return false;
    }
    bool done = load_film(s, scene, &checkpoint, film, e) &&
                stage_resume(s->stage, *film, run, checkpoint_pass, every, &checkpoint, &stats, e);
    if (done) {
        s->stats->trace_seconds += stats.seconds;
        s->stats->paths += stats.paths;
    }
    if (done && run_is_cancelled(s->run)) {
        checkpoint_save(&checkpoint, *film);
        done = run_cancel_error(e);
    }
    checkpoint_clear(&checkpoint);
    return done;
}

static bool trace_frame(Shooting *s, Film **film, Error *e)
{
    int frame = s->shot[s->at].frame;
    Run run = own_run(s);
    char *file = pattern_name(s->pattern, frame, e);
    Scene *scene = file ? turntable_scene(s->turntable, frame, e) : NULL;
    bool done = scene && stage_set(s->stage, scene, &run, e) && // which owns the scene from here
                trace_film(s, scene, file, film, &run, e);
    free(file);
    return done;
}

// Passes the film to the finisher once the previous write has ended.
static bool hand_over(Shooting *s, const Film *film, Error *e)
{
    const Shot *shot = &s->shot[s->at];
    double start = run_seconds();
    bool done = finisher_wait(s->finisher, e);
    s->stats->finish_seconds += run_seconds() - start;
    if (!done) {
        return false;
    }
    // the stage frees its own scene too early
    Scene *scene = turntable_scene(s->turntable, shot->frame, e);
    char *file = scene ? pattern_name(s->pattern, shot->frame, e) : NULL;
    if (!file) {
        scene_free(scene);
        return false;
    }
    s->handed++;
    return finisher_begin(s->finisher, file, scene, film, shot->mark, s->run->threads, e);
}

static bool has_track(const Shooting *s, const char *path)
{
    const SceneAnimation *animation = s->scene->animation;
    for (int i = 0; animation && i < animation->track_count; i++) {
        if (strncmp(animation->tracks[i].path, path, strlen(path)) == 0) {
            return true;
        }
    }
    return false;
}

static bool shoot_frames(Shooting *s, Error *e)
{
    bool grows = s->params->turntable.grow.count > 0 || has_track(s, "grow_to");
    bool cropped = has_track(s, "film.crop"); // an existing film keeps the pixels outside the crop
    double start = run_seconds();
    s->stage = stage_new(&s->scene->camera, s->params->isa, grows, e);
    if (!s->stage || !find_views(s, e)) {
        return false;
    }
    stage_see_from(s->stage, &s->views);
    if (!lock_exposure(s, e)) {
        return false;
    }
    s->stats->prepare_seconds += run_seconds() - start;
    bool done = true;
    for (s->at = 0; done && s->at < s->shot_count; s->at++) {
        Film **film = &s->film[s->at & 1];
        if (cropped) {
            film_free(*film);
            *film = NULL;
        }
        done = trace_frame(s, film, e) && hand_over(s, *film, e);
    }
    double traced = run_seconds();
    bool finished = finisher_wait(s->finisher, done ? e : NULL); // also waits for an earlier write
    s->stats->finish_seconds += run_seconds() - traced;
    s->stats->rendered = finished || s->handed == 0 ? s->handed : s->handed - 1;
    s->stats->stage = *stage_stats(s->stage);
    return done && finished;
}

// ---- videos

static bool add_frames(Shooting *s, Video *video, Error *e)
{
    for (int frame = s->start; frame <= s->end; frame++) {
        if (run_is_cancelled(s->run)) {
            return run_cancel_error(e);
        }
        char *file = pattern_name(s->pattern, frame, e);
        Image *image = file ? image_read(file, s->run, e) : NULL;
        bool done = image && video_add(video, image, e);
        image_free(image);
        free(file);
        if (!done) {
            return false;
        }
        run_progress(s->run, "film", (double)(frame - s->start + 1) / (s->end - s->start + 1));
    }
    return true;
}

static bool make_film(Shooting *s, Error *e)
{
    if (!s->folder) {
        return true;
    }
    double start = run_seconds();
    char *part = frames_film(s->folder, e);
    int width = s->scene->film.width / s->scene->downsample;
    int height = s->scene->film.height / s->scene->downsample;
    Video *video =
        part ? video_open(s->video, part, width, height, turntable_fps(s->turntable), e) : NULL;
    free(part);
    bool sound = video && add_frames(s, video, e);
    bool done = video_close(video, sound, e);
    if (done) {
        frames_folder_remove(s->folder);
    }
    s->stats->video_seconds = run_seconds() - start;
    return done;
}

// ---- whole animation

static bool choose_range(Shooting *s, Error *e)
{
    int last = turntable_frames(s->turntable) - 1;
    s->stats->frames = last + 1;
    s->start = s->params->start;
    s->end = s->params->end < 0 ? last : s->params->end;
    if (s->start < 0 || s->start > s->end || s->end > last) {
        return error_set(e, ERROR_INPUT,
                         "frames %d to %d of %d; the first is number 0, the last number %d",
                         s->start, s->end, last + 1, last);
    }
    return true;
}

static void clear(Shooting *s)
{
    finisher_free(s->finisher);
    stage_free(s->stage);
    film_free(s->film[0]);
    film_free(s->film[1]);
    turntable_free(s->turntable);
    free(s->shot);
    free(s->eye);
    free(s->pattern);
    free(s->folder);
    free(s->video);
    if (s->hold >= 0) {
        close(s->hold);
    }
}

bool shoot(const Scene *scene, const ShootParams *params, const Run *run, ShootStats *stats,
           Error *e)
{
    Error own = {0};
    e = e ? e : &own;
    *stats = (ShootStats){0};
    Shooting s = {.scene = scene, .params = params, .run = run, .stats = stats, .hold = -1};
    double start = run_seconds();
    s.turntable = turntable_new(scene, &params->turntable, e);
    s.finisher = s.turntable ? finisher_new(e) : NULL;
    bool done = s.finisher && choose_range(&s, e) && plan_output(&s, e) && find_shots(&s, e);
    stats->prepare_seconds = run_seconds() - start;
    done = done && (s.shot_count == 0 || shoot_frames(&s, e)) && make_film(&s, e);
    clear(&s);
    return done;
}
