// The files of a film's frames: where they go, and which are there already.
#ifndef RAMIFY_ANIMATE_FRAMES_H
#define RAMIFY_ANIMATE_FRAMES_H

#include "scene/scene.h"

enum { FRAME_MARK_SIZE = 40 };

// What a finished frame's picture says of itself: a hash over all that made it (every setting of
// the scene, the files that it names by size and time, the program's version) and `more`.
void frame_mark(const Scene *scene, uint64_t more, char mark[FRAME_MARK_SIZE]);

// The hash in it.
uint64_t frame_hash(const Scene *scene);

// A hash over what all frames of a film share and no frame's scene tells: the camera for which is
// made what depends on the point of view, and the instruction set (NULL = this machine's best).
uint64_t frames_hash(const Scene *still, const char *isa);

// Is the file there, whole, and of this mark?
bool frame_is_finished(const char *file, const char *mark);

// The folder beside a film's file in which its frames wait: "oak.mp4.frames"; the pattern of their
// names in it; and the film there until it is whole. Heap text.
enum { FRAMES_EXTRA = 7 }; // bytes that it is longer by
char *frames_folder(const char *film, Error *e);
char *frames_pattern(const char *folder, Error *e);
char *frames_film(const char *folder, Error *e);

// Makes the folder unless it is there and takes it for this run alone: a descriptor, to be closed
// when the work is done; closed by the system when the run is killed. -1 and ERROR_IO when it
// cannot be made or another run has it.
int frames_folder_take(const char *folder, Error *e);

// Removes the frames, what a killed run left of one, and the folder if nothing else is in it.
void frames_folder_remove(const char *folder);

#endif
