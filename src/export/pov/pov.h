// Shared by the files of the POV-Ray exporter. docs/povray.md has the mapping.
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
    char *folder;       // the folder of its pictures, with its path
    const char *beside; // the same relative to the .pov
    float unit;         // POV-Ray units a metre: a power of ten
    Vec3 center;        // m, of everything
    float radius;       // m, around the center, with camera and lamps
    World far;          // sky and sun alone ...
    float top, height;  // m, of everything: the highest point, and the height above the lowest
    Lights *lights;     // ... and their light
    const Sun *sun;     // NULL = none
    bool glow_lights;   // glowing geometry became light sources
} Pov;

// Write numbers. Points and lengths are converted from metres to units.
void pov_vector(Pov *pov, Vec3 v);
void pov_point(Pov *pov, Vec3 p);
void pov_number(Pov *pov, float value);
void pov_number_list(Pov *pov, const float *value, int count); // with commas

// Limit of the colours of a part's instances or curves.
enum { POV_COLORS = 64 };

// Each writes its section of the file; false and pov->e on failure. Errors of the file itself are
// reported when it is closed.
void pov_camera(Pov *pov);
bool pov_sky(Pov *pov);
void pov_medium(Pov *pov);

// Haze as POV-Ray's fog, which covers the sky too: colour, and optical depth straight up from the
// camera. Zero without haze.
typedef struct PovHaze {
    Vec3 color;
    float depth;
} PovHaze;
PovHaze pov_haze(const Pov *pov);
// The sky's colour that looks like `color` behind that fog.
Vec3 pov_haze_undo(const PovHaze *haze, Vec3 direction, Vec3 color);

void pov_lamps(Pov *pov);
bool pov_glow(Pov *pov); // light sources along glowing geometry
bool pov_materials(Pov *pov);
// number: of the part, used in the names that it declares.
bool pov_mesh_part(Pov *pov, int64_t number, const Part *part);
bool pov_curve_part(Pov *pov, int64_t number, const Part *part);

// Declares the textures P<number>_0, P<number>_1, ... of a part: its material in each of the
// palette's colours and transmittances.
void pov_textures(Pov *pov, int64_t number, int material, const Palette *colors);
// Writes what follows a part's texture: its interior and its flags for light.
void pov_interior(Pov *pov, int material);
bool pov_has_picture(const Material *material);

// Bakes the picture of a material; name: how the scene refers to it.
bool pov_bake_picture(Pov *pov, int material, char *name, int size);
// Makes the folder for pictures.
bool pov_make_folder(Pov *pov);

#endif
