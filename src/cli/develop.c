// ramify develop: the finished picture in an .exr, developed anew with other film settings.
#include "cli/command.h"

#include <stdio.h>
#include <string.h>

// Does the override set this key, or a part of it?
static bool sets(const char *override, const char *key)
{
    size_t length = strlen(key);
    return strncmp(override, key, length) == 0 && strchr("=.", override[length]) != NULL &&
           override[length] != '\0';
}

// Only what comes after the samples can change.
static bool check_key(const char *override, RamifyError *e)
{
    static const char *const traced[] = {"film.width", "film.height", "film.filter",
                                         "film.filter_radius", "film.crop"};
    bool allowed = strncmp(override, "film.", 5) == 0;
    for (size_t i = 0; allowed && i < sizeof traced / sizeof *traced; i++) {
        allowed = !sets(override, traced[i]);
    }
    return allowed ||
           fail(e, RAMIFY_BAD_INPUT,
                "--set %s needs new samples: render the scene for it; develop changes how a film "
                "is shown, as film.exposure, contrast, white_balance, sharpen or grain",
                override);
}

static bool check_options(const Options *options, RamifyError *e)
{
    const char *output = options->output;
    bool valid =
        (output_has_ending(options->operand, ".exr") ||
         fail(e, RAMIFY_BAD_INPUT, "'%s' holds no film; the .exr of a rendering is needed",
              options->operand)) &&
        (output || fail(e, RAMIFY_BAD_INPUT, "no output is named; add -o FILE.png")) &&
        (output_has_ending(output, ".png") || output_has_ending(output, ".jpg") ||
         output_has_ending(output, ".jpeg") ||
         fail(e, RAMIFY_BAD_INPUT, "--output %s; its ending must be .png or .jpg", output));
    for (int i = 0; valid && i < options->override_count; i++) {
        valid = check_key(options->overrides[i], e);
    }
    return valid && output_check(output, e);
}

static bool develop(const Options *options, const RamifyScene *traced, const RamifyScene *shown,
                    RamifyError *e)
{
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    RamifySceneInfo info;
    ramify_scene_info(shown, &info);
    RamifyFilm *film = ramify_film_read(options->operand, traced, &run, e);
    bool done = film && ramify_film_write(film, shown, options->output, info.denoise, &run, e);
    progress_end(&progress);
    ramify_film_free(film);
    if (done && !options->quiet) {
        fprintf(stderr, "%s: %d x %d pixels\n", options->output, info.width, info.height);
    }
    return done;
}

bool command_develop(const Options *options, RamifyError *e)
{
    if (!check_options(options, e)) {
        return false;
    }
    RamifyScene *traced = ramify_scene_load_settings(options->operand, NULL, 0, e);
    RamifyScene *shown = traced ? command_settings(options, e) : NULL;
    bool done = shown && ramify_develop_check(shown, e) && develop(options, traced, shown, e);
    ramify_scene_free(traced);
    ramify_scene_free(shown);
    return done;
}
