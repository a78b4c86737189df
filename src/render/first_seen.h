// What a camera ray meets first; a mirror that shows a lamp counts as the lamp. The film keeps the
// samples of lights and of the sky apart from those of surfaces, so that a picture can be filtered
// after the highlights are compressed.
#ifndef RAMIFY_RENDER_FIRST_SEEN_H
#define RAMIFY_RENDER_FIRST_SEEN_H

#include "render/integrator.h"

// Fills kind and sharpness of the result for a camera ray that met hit, or nothing. Only the
// geometry decides, not the path that a sample takes through a medium, because the samples of one
// place must be of one kind.
void first_seen(const Tracer *tracer, const Ray *ray, bool met, const Hit *hit, PathResult *result);

// Is it a lamp or a surface that glows?
bool hit_glows(const Tracer *tracer, const Hit *hit);

#endif
