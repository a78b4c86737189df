// Encodes a video as H.264 in an .mp4 through an ffmpeg process.
//
// 8 bits, yuv420p, colours tagged and converted as BT.709; an odd width or height loses its last
// column or row. The file gets its name when it is complete. Equal frames give equal files with the
// same ffmpeg.
#ifndef RAMIFY_ANIMATE_VIDEO_H
#define RAMIFY_ANIMATE_VIDEO_H

#include "image/image.h"

typedef struct Video Video;

// Checks that ffmpeg is installed. ERROR_IO names it if it is missing.
bool video_check(Error *e);

// Starts a video with frames of width x height pixels, each at least 2. part: name until complete,
// on the same file system; replaces an existing file.
Video *video_open(const char *file, const char *part, int width, int height, double fps, Error *e);

// Adds a frame of display values, 3 or 4 channels (alpha is composited over black). ERROR_IO with
// ffmpeg's message if it has failed.
bool video_add(Video *video, const Image *frame, Error *e);

// keep: finishes the video and renames it. Otherwise ends ffmpeg and removes the partial file.
// Frees the video (NULL is fine). True if the video exists.
bool video_close(Video *video, bool keep, Error *e);

#endif
