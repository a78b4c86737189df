// From the film to files: the developed picture and the EXR with its layers.
#ifndef RAMIFY_CLI_PICTURE_H
#define RAMIFY_CLI_PICTURE_H

#include "base/run.h"
#include "render/film.h"
#include "scene/scene.h"

// Develops and writes a .png or .jpg. denoise: take the noise out first.
bool picture_write_display(const char *file, const Scene *scene, const Film *film, bool denoise,
                           const Run *run, Error *e);

// Writes the linear EXR: RGBA, albedo, normal, depth, position, object id, samples; the scene's
// text and every setting as metadata.
bool picture_write_exr(const char *file, const Scene *scene, const Film *film, Error *e);

#endif
