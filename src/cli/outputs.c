#include "cli/outputs.h"

#include "cli/command.h"

#include <stdlib.h>

void outputs_clear(Outputs *outputs)
{
    free(outputs->display);
    free(outputs->exr);
    *outputs = (Outputs){0};
}

bool outputs_plan(const Options *options, Outputs *outputs, RamifyError *e)
{
    const char *named = options->output ? options->output : file_name(options->operand);
    bool exr = output_has_ending(named, ".exr"),
         jpeg = output_has_ending(named, ".jpg") || output_has_ending(named, ".jpeg");
    bool valid =
        !options->output || exr || jpeg || output_has_ending(named, ".png") ||
        fail(e, RAMIFY_BAD_INPUT, "--output %s; its ending must be .png, .jpg or .exr", named);
    bool as_named = options->output && !exr;
    outputs->display = as_named ? copy_text(named, e) : output_with_ending(named, ".png", e);
    outputs->exr = exr ? copy_text(named, e) : output_with_ending(named, ".exr", e);
    return valid && outputs->display && outputs->exr && output_check(outputs->display, e) &&
           output_check(outputs->exr, e);
}

bool outputs_write(const Outputs *outputs, RamifyFilm *film, const RamifyScene *scene,
                   const RamifyRun *run, RamifyError *e)
{
    RamifySceneInfo info;
    ramify_scene_info(scene, &info);
    RamifyRun patient = *run; // does not cancel: an interrupted picture is still written
    patient.cancelled = NULL;
    bool cut_short = *run->cancelled; // cancelled before writing started
    bool denoise = info.denoise && ramify_film_denoise(film, scene, cut_short ? &patient : run, e);
    // cancelled while denoising: write without
    bool done = denoise || !info.denoise || (!cut_short && *run->cancelled);
    done = done && ramify_film_write(film, scene, outputs->display, denoise, &patient, e);
    // the rendering itself is saved even if developing fails, e.g. in the denoiser's library
    return ramify_film_write(film, scene, outputs->exr, denoise, &patient, done ? e : NULL) && done;
}
