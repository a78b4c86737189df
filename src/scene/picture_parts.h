// What picture.c and picture_develop.c share.
#ifndef RAMIFY_SCENE_PICTURE_PARTS_H
#define RAMIFY_SCENE_PICTURE_PARTS_H

#include "scene/picture.h"

// Has every pixel of the scene's crop a sample?
bool picture_can_denoise(const Scene *scene, const Film *film);

// The film's radiance without noise, width * height; free() it. run may be NULL.
Vec3 *picture_denoised(const Scene *scene, const Film *film, const Run *run, Error *e);

#endif
