// Interference in a thin film that hangs in air, such as a soap bubble's: the colour it mirrors.
#ifndef RAMIFY_RENDER_MATERIAL_THIN_FILM_H
#define RAMIFY_RENDER_MATERIAL_THIN_FILM_H

#include "base/error.h"
#include "base/vec.h"

#define THIN_FILM_MOST_NM 2000.0f // thickness; thicker films' colours have washed out

typedef struct ThinFilmTable ThinFilmTable; // immutable; the same for all films

ThinFilmTable *thin_film_table_new(Error *e);
void thin_film_table_free(ThinFilmTable *table); // NULL is fine

// Reflectance of both sides together, all inner reflections summed, for unpolarised light whose
// colour is (1, 1, 1): linear Rec. 709, each channel in 0..1. thickness in nm, cosine > 0 of the
// angle in air. What is not reflected passes.
Vec3 thin_film_color(const ThinFilmTable *table, float thickness, float ior, float cosine);

// The mean over thicknesses, without colour: the reflectance of a film of unknown thickness.
float thin_film_mean(float ior, float cosine);

#endif
