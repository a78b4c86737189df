// USD's text format (usda, version 1.0; openusd.org): geometry, instances, materials, camera and
// lights of a scene, in metres with +Y up. docs/formats.md has the mapping.
#include "export/usd/usda.h"

#include "base/memory.h"
#include "export/formats.h"

#include <stdlib.h>

static bool look_through(Usda *usda, Error *e)
{
    const World *world = usda->source->world;
    usda->material = memory_alloc(world->material_count, sizeof *usda->material, e);
    usda->used = memory_alloc_zero(world->material_count, sizeof *usda->used, e);
    usda->glows = memory_alloc_zero(world->material_count, sizeof *usda->glows, e);
    if (!usda->material || !usda->used || !usda->glows) {
        return false;
    }
    for (int i = 0; i < world->material_count; i++) {
        usda_unique_identifier(world->material[i].name, usda->material, i, NULL);
    }
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        usda->used[part->material] = true;
        usda->glows[part->material] |=
            part->curves && part->curves->glow &&
            material_has(&world->material[part->material], TRAIT_EMISSIVE);
    }
    return true;
}

static void header(Usda *usda)
{
    usda_line(&usda->text, "#usda 1.0");
    usda_line(&usda->text, "(");
    usda_line(&usda->text, "    defaultPrim = \"World\"");
    usda_quoted(&usda->text, "    doc = ", usda->source->title);
    usda_line(&usda->text, "    metersPerUnit = 1");
    usda_line(&usda->text, "    upAxis = \"Y\"");
    usda_line(&usda->text, ")");
    usda_line(&usda->text, "%s", "");
}

static bool write_stage(Usda *usda, Error *e)
{
    header(usda);
    usda_begin(&usda->text, "kind = \"assembly\"", "def Xform \"World\"");
    usda_camera(usda);
    bool done = usda_materials(usda, e) && usda_objects(usda, e) && usda_lights(usda, e);
    usda_end(&usda->text);
    return done;
}

static bool write(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    Usda usda = {.file = file, .source = source, .run = run};
    bool done = look_through(&usda, e);
    if (done) {
        usda.text.out = file_writer_open(file, e);
        done = usda.text.out && write_stage(&usda, e) && file_writer_settle(usda.text.out, e) &&
               usda_write_sky(&usda, e);
        done = usda.text.out && file_writer_close(usda.text.out, done, e);
    }
    image_free(usda.sky);
    free(usda.material);
    free(usda.used);
    free(usda.glows);
    return done;
}

const ExportFormat usda_format = {".usda", "USD as text: all of the scene",
                                  (int)(sizeof "-sky.exr" - sizeof ".usda"), EXPORT_WORLD, write};
