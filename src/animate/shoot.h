// Renders the frames of a turntable to files or to an .mp4, resuming after an interruption.
//
// A Stage sets up each frame, keeping what did not change, and traces it; developing and writing
// run in parallel to the tracing of the next frame. Frames that exist, complete and made with the
// same settings, are skipped. A video's frames are kept as PNGs in FILM.frames until all exist.
#ifndef RAMIFY_ANIMATE_SHOOT_H
#define RAMIFY_ANIMATE_SHOOT_H

#include "animate/stage.h"
#include "animate/turntable.h"

typedef struct ShootParams {
    TurntableParams turntable;
    const char *output; // pattern (see pattern.h) ending in .png, .jpg or .exr; or .mp4
    int start, end;     // frames start .. end, inclusive; negative end = to the last
    const char *isa;    // as for renderer_new
    double checkpoint;  // s between savings of a frame being traced (checkpoint.h); 0 = never
} ShootParams;

typedef struct ShootStats {
    int frames;             // of the turntable
    int rendered, skipped;  // in this call
    double trace_seconds;   // of all frames
    double prepare_seconds; // reading the frames' scenes, checking files, metering
    double finish_seconds;  // waiting for frames to be developed and written
    double video_seconds;
    int64_t paths;
    StageStats stage;
} ShootStats;

// False and e on failure or cancellation (ERROR_CANCELLED, after the tile being traced; the
// interrupted frame is saved to go on with). Finished frames stay, and the same call resumes. stats
// is filled in either case.
bool shoot(const Scene *scene, const ShootParams *params, const Run *run, ShootStats *stats,
           Error *e);

// Checks that shoot can write the output. ERROR_INPUT for a bad pattern or extension, ERROR_IO
// without ffmpeg or a folder to write to.
bool shoot_check_output(const char *output, Error *e);

#endif
