// Fits a species to the height and the place that the scene asks for.
#ifndef RAMIFY_SCENE_SPECIES_SIZE_H
#define RAMIFY_SCENE_SPECIES_SIZE_H

#include "config/table.h"

// Multiplies the lengths (keys with the unit m) of the species' trunk, crown, roots and
// light.attractors by the height that the object gives over that of the species. Nothing changes if
// one gives none. given, species: mappings of `table`, of the object and of the species file; the
// latter changes. false and e when out of memory.
bool species_fit_size(const Table *table, const Node *given, Node *species, Arena *arena, Error *e);

// Moves the species' envelopes and guide fields, which are given about its foot, to the position
// that the object gives. species: as above. false and e when out of memory.
bool species_fit_place(const Node *given, Node *species, Arena *arena, Error *e);

#endif
