// Shoots a film: renders the frames of a turntable to files, or to an .mp4, and goes on where an
// earlier run was interrupted.
//
// A frame is set up by a Stage, which keeps what stays, and traced; developing and writing it goes
// on beside the tracing of the next one. Frames that are there already, whole and made from the
// same settings, are skipped. A film's frames wait as PNGs in FILM.frames until all are there.
#ifndef RAMIFY_ANIMATE_SHOOT_H
#define RAMIFY_ANIMATE_SHOOT_H

#include "animate/stage.h"
#include "animate/turntable.h"

typedef struct ShootParams {
    TurntableParams turntable;
    const char *output; // pattern (see pattern.h) ending in .png, .jpg or .exr; or .mp4
    int start, end;     // frames start .. end, both included; end negative = to the last
    const char *isa;    // as for renderer_new
} ShootParams;

typedef struct ShootStats {
    int frames;             // of the turntable
    int rendered, skipped;  // in this run
    double trace_seconds;   // of all frames
    double prepare_seconds; // reading frames' scenes, looking at files, metering
    double finish_seconds;  // developing and writing that had to be waited for
    double video_seconds;
    int64_t paths;
    StageStats stage;
} ShootStats;

// False and e when something failed or the user interrupted (ERROR_CANCELLED, after the tile that
// was being traced; the interrupted frame is not written). What was finished stays, and the same
// call goes on from there. stats is filled in either case.
bool shoot(const Scene *scene, const ShootParams *params, const Run *run, ShootStats *stats,
           Error *e);

// Is the output one that shoot can write to? ERROR_INPUT for a bad pattern or ending, ERROR_IO
// without ffmpeg or a folder to write to.
bool shoot_check_output(const char *output, Error *e);

#endif
