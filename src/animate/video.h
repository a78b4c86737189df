// A film as H.264 in an .mp4: frames go to an ffmpeg process through a pipe.
//
// 8 bits, yuv420p, colours tagged and converted as BT.709; an odd width or height loses its last
// column or row. The file appears under its name when it is whole. The same frames give the same
// file with the same ffmpeg.
#ifndef RAMIFY_ANIMATE_VIDEO_H
#define RAMIFY_ANIMATE_VIDEO_H

#include "image/image.h"

typedef struct Video Video;

// Is ffmpeg there to be run? ERROR_IO names it when it is not.
bool video_check(Error *e);

// Starts the film of frames of width x height pixels, each 2 at least. part: what it is called
// until it is whole, on the same disk; an old file of that name goes.
Video *video_open(const char *file, const char *part, int width, int height, double fps, Error *e);

// Adds a frame of display values, 3 or 4 channels (alpha is shown over black). ERROR_IO with what
// ffmpeg said when it has ended.
bool video_add(Video *video, const Image *frame, Error *e);

// keep: waits for the film and gives it its name. Not keep: ends ffmpeg and leaves nothing behind.
// Frees the video (NULL is fine). True when the film is there.
bool video_close(Video *video, bool keep, Error *e);

#endif
