// Finds species files: by name beside the scene or in the built-in library, or by path.
#ifndef RAMIFY_SCENE_SPECIES_FILE_H
#define RAMIFY_SCENE_SPECIES_FILE_H

#include "config/node.h"

typedef struct SpeciesFile {
    const char *stem; // of the file's name: "silver_birch"
    const char *path; // for messages and files named in it; of the library "<species>/NAME.yaml"
    const char *text;
    Node *root; // the document, a mapping; each node has the path as its file
} SpeciesFile;

// Reads the species that a node names. A text with '/' or ending in ".yaml" is a path relative to
// the folder of the file that the node is in; any other text is a name: first of a file NAME.yaml
// in the folder `species` beside the scene, then of the built-in library (scenes/species/ when
// ramify was built). folder: of the scene. Everything is allocated in the arena. ERROR_INPUT names
// the place of the node, or that in the species file.
bool species_file_read(SpeciesFile *file, const Node *named, const char *scene, const char *folder,
                       Arena *arena, Error *e);

// Name number index of the built-in library, in alphabetical order; NULL past the last one.
// *text: its file, if not NULL.
const char *species_builtin(int index, const char **text);

#endif
