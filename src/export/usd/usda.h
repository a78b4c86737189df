// What the files of the usda exporter share. Private to usda*.c.
#ifndef RAMIFY_EXPORT_USD_USDA_H
#define RAMIFY_EXPORT_USD_USDA_H

#include "export/export.h"
#include "export/usd/text.h"
#include "image/image.h"
#include "render/world.h"

typedef struct Usda {
    UsdaText text;
    const char *file; // being written
    const ExportSource *source;
    const Run *run;
    char (*material)[USDA_NAME]; // identifier of each of the world's materials
    bool *used;                  // of each: whether a part has it
    bool *glows;                 // of each: whether some of its curves glow unevenly
    Image *sky;                  // owned: the dome's picture, that is yet to be written; or NULL
} Usda;

// The prims /World/Camera and /World/Lights (usda_light.c), /World/Materials (usda_material.c),
// and one for each object (usda_geometry.c). False and e when something they need is missing or
// the run was cancelled; failures of the file itself show when it is closed.
void usda_camera(Usda *usda);
bool usda_lights(Usda *usda, Error *e);
bool usda_materials(Usda *usda, Error *e);
bool usda_objects(Usda *usda, Error *e);

// Writes the dome's picture, if there is one: last, so that no failure before it harms an old one.
bool usda_write_sky(const Usda *usda, Error *e);

#endif
