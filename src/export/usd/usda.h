// Shared by the files of the USD exporter. Private to export/usd.
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
    Image *sky;                  // owned: the picture of the dome, not yet written; or NULL
} Usda;

// Write the prims /World/Camera and /World/Lights (light.c), /World/Materials (material.c), and one
// per object (geometry.c). They fail if something they need is missing or the run was cancelled;
// errors of the file itself are reported when it is closed.
void usda_camera(Usda *usda);
bool usda_lights(Usda *usda, Error *e);
bool usda_materials(Usda *usda, Error *e);
bool usda_objects(Usda *usda, Error *e);

// Writes the dome's picture, if there is one. Last, so that an earlier failure leaves an old
// picture intact.
bool usda_write_sky(const Usda *usda, Error *e);

#endif
