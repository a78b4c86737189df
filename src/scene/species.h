// Species: files that hold what makes a plant of a kind, its materials and its targets, and that
// an object refers to by the key `species` of its kind: tree: {species: silver_birch}.
#ifndef RAMIFY_SCENE_SPECIES_H
#define RAMIFY_SCENE_SPECIES_H

#include "config/node.h"

// Replaces each `species` of the document's objects by what its file (species_file.h) gives.
// - All keys of the file but latin, materials and targets are keys of the object; values of the
//   scene stay. Lengths fit the height that the scene gives, envelopes its position
//   (species_size.h).
// - Its materials become materials of the scene, NAME of the species SPECIES as SPECIES_NAME, also
//   where the file refers to them; keys of the scene's own material of that name stay.
// - Its targets become targets of the object, except for measures that the scene has a target for;
//   none do where the object says species_targets: false.
// A species file can itself begin with a species that it changes.
// file, folder: of the scene. ERROR_INPUT names the place in the scene or in the species file.
bool species_apply(Node *root, const char *file, const char *folder, Arena *arena, Error *e);

#endif
