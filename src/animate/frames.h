// Files of an animation's frames: their names, and which exist already.
#ifndef RAMIFY_ANIMATE_FRAMES_H
#define RAMIFY_ANIMATE_FRAMES_H

#include "scene/scene.h"

enum { FRAME_MARK_SIZE = 40 };

// The mark stored in a finished frame's picture: a hash of everything that determines it (all
// settings of the scene, size and time of the files it names, the program's version) combined with
// `more`.
void frame_mark(const Scene *scene, uint64_t more, char mark[FRAME_MARK_SIZE]);

// The hash in that mark, without `more`.
uint64_t frame_hash(const Scene *scene);

// Hash of what all frames share and no frame's scene contains: the camera for which view-dependent
// geometry is made, and the instruction set (NULL = this machine's best).
uint64_t frames_hash(const Scene *still, const char *isa);

// Whether the file exists, is complete and has this mark.
bool frame_is_finished(const char *file, const char *mark);

// The folder beside a video file that holds its frames, "oak.mp4.frames"; the pattern of their
// names; and the video there until it is complete. Heap text.
enum { FRAMES_EXTRA = 7 }; // bytes added to the file's name
char *frames_folder(const char *film, Error *e);
char *frames_pattern(const char *folder, Error *e);
char *frames_film(const char *folder, Error *e);

// Creates the folder if needed and locks it for this process. Returns a descriptor, to be closed
// when done; the system closes it if the process is killed. -1 and ERROR_IO when the folder cannot
// be created or is locked by another process.
int frames_folder_take(const char *folder, Error *e);

// Removes the frames, partial files of killed runs, and the folder if it is then empty.
void frames_folder_remove(const char *folder);

#endif
