// What damp rock faces carry: moss in cracks and on ledges, algae, iron and lime where water runs.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_DAMP_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_DAMP_H

#include "render/material/pattern_crags.h"
#include "render/material/pattern_mix.h"

// The ground of a rock face with what grows and runs on it. amount: 0..1, how damp the face is (0
// leaves the ground as it is); crags: of the place; upright: |y| of the face's normal.
Ground pattern_damp(float amount, const SurfacePoint *point, const Crags *crags, float upright,
                    Ground rock);

#endif
