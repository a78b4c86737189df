// What the files that write POV-Ray scenes share. docs/povray.md says what becomes of what.
#ifndef RAMIFY_EXPORT_POV_POV_H
#define RAMIFY_EXPORT_POV_POV_H

#include "base/file_writer.h"
#include "export/export.h"
#include "export/pov/palette.h"
#include "render/light/lights.h"
#include "render/material/appearance.h"
#include "render/material/pattern.h"
#include "render/world.h"

typedef struct Pov {
    const World *world;
    FileWriter *out;
    const Run *run;
    Error *e;
    const char *file;   // the .pov
    char *folder;       // where its pictures go, with the file's own folder before it
    const char *beside; // the same as the scene names it: without that folder
    float unit;         // POV-Ray units a metre: a power of ten
    Vec3 center;        // m, of all there is
    float radius;       // m, about the center, camera and lamps included
    World far;          // sky and sun alone ...
    float top, height;  // m, of all there is: the highest point, and from the lowest to it
    Lights *lights;     // ... and their light
    const Sun *sun;     // NULL = none
    bool glow_lights;   // glowing geometry became light sources
} Pov;

// Numbers. Points and lengths in metres are turned into units.
void pov_vector(Pov *pov, Vec3 v);
void pov_point(Pov *pov, Vec3 p);
void pov_number(Pov *pov, float value);
void pov_number_list(Pov *pov, const float *value, int count); // with commas

// Most colours of a part's instances or curves.
enum { POV_COLORS = 64 };

// Each writes its section of the file. False and pov->e on failure; what goes wrong with the file
// itself shows when it is closed.
void pov_camera(Pov *pov);
bool pov_sky(Pov *pov);
void pov_medium(Pov *pov);

// Haze as POV-Ray's fog, which covers the sky too: its colour, and its optical depth straight up
// from the camera. All zero without haze.
typedef struct PovHaze {
    Vec3 color;
    float depth;
} PovHaze;
PovHaze pov_haze(const Pov *pov);
// The colour of the sky that shows as `color` behind that fog.
Vec3 pov_haze_undo(const PovHaze *haze, Vec3 direction, Vec3 color);

void pov_lamps(Pov *pov);
bool pov_glow(Pov *pov); // light sources along glowing geometry
bool pov_materials(Pov *pov);
// number: of the part, for the names of what it declares.
bool pov_mesh_part(Pov *pov, int64_t number, const Part *part);
bool pov_curve_part(Pov *pov, int64_t number, const Part *part);

// Declares textures P<number>_0, P<number>_1, ... of a part: its material in the palette's colours,
// and transmittances as what goes with them.
void pov_textures(Pov *pov, int64_t number, int material, const Palette *colors);
// What follows a part's texture: its interior and how light treats it.
void pov_interior(Pov *pov, int material);
bool pov_has_picture(const Material *material);

// Writes one picture that a material is painted with; what the file calls it.
bool pov_bake_picture(Pov *pov, int material, char *name, int size);
// Makes the folder for pictures.
bool pov_make_folder(Pov *pov);

#endif
