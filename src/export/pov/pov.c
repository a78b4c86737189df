// A scene for POV-Ray 3.7, ready to render. docs/povray.md has the mapping and what is lost.
//
// The scene keeps its axes: the camera is given by its vectors, so handedness does not matter.
// Lengths are multiplied by a power of ten, so that POV-Ray's fixed tolerances of a thousandth of a
// unit are small.
#include "export/pov/pov.h"
#include "export/formats.h"

#include "base/number_text.h"
#include "export/asset_path.h"
#include "mesh/geometry_measure.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// ---- numbers

void pov_number(Pov *pov, float value)
{
    char text[FLOAT_TEXT_MOST];
    file_writer_bytes(pov->out, text, (size_t)(float_text(text, value) - text));
}

void pov_number_list(Pov *pov, const float *value, int count)
{
    char text[16 * (FLOAT_TEXT_MOST + 1)];
    file_writer_bytes(pov->out, text, (size_t)(floats_text(text, value, count, ',') - text));
}

void pov_vector(Pov *pov, Vec3 v)
{
    char text[3 * (FLOAT_TEXT_MOST + 1) + 2], *end = text;
    *end++ = '<';
    end = floats_text(end, (const float[3]){v.x, v.y, v.z}, 3, ',');
    *end++ = '>';
    file_writer_bytes(pov->out, text, (size_t)(end - text));
}

void pov_point(Pov *pov, Vec3 p)
{
    pov_vector(pov, vec3_scale(p, pov->unit));
}

// ---- the scene's size

static Aabb light_bounds(const Light *light)
{
    Aabb box = aabb_empty();
    if (light->kind == LIGHT_SPHERE) {
        Vec3 r = vec3_splat(light->radius);
        box = aabb_add(box, vec3_sub(light->center, r));
        return aabb_add(box, vec3_add(light->center, r));
    }
    Vec3 far = vec3_add(light->corner, light->edge_u);
    box = aabb_add(aabb_add(box, light->corner), far);
    box = aabb_add(box, vec3_add(light->corner, light->edge_v));
    return aabb_add(box, vec3_add(far, light->edge_v));
}

static void measure_world(Pov *pov)
{
    const World *world = pov->world;
    Aabb box = aabb_add(aabb_empty(), world->camera.position);
    box = aabb_union(box, geometry_bounds(&world->geometry, 0));
    for (int i = 0; i < world->light_count; i++) {
        box = aabb_union(box, light_bounds(&world->light[i]));
    }
    pov->center = vec3_scale(vec3_add(box.low, box.high), 0.5f);
    pov->radius = fmaxf(0.5f * vec3_distance(box.low, box.high), 1e-4f);
    pov->top = box.high.y;
    pov->height = box.high.y - box.low.y;
    const float wanted = 1000.0f; // units
    for (pov->unit = 1.0f; pov->unit * pov->radius < wanted;) {
        pov->unit *= 10.0f;
    }
}

// ---- the file

static const char *name_of(const char *file)
{
    const char *slash = strrchr(file, '/');
    return slash ? slash + 1 : file;
}

static void write_head(Pov *pov, const char *title)
{
    const FilmParams *film = &pov->world->film;
    file_writer_print(pov->out,
                      "// %s, written by ramify for POV-Ray 3.7\n"
                      "// povray +I%s +W%d +H%d +A0.1 +AM2 +R3\n"
                      "// One metre is %g units. x to the right, y up, z toward the viewer.\n"
                      "#version 3.7;\n",
                      name_of(title), name_of(pov->file), film->width, film->height,
                      (double)pov->unit);
    // max_trace_level bounds the number of transparent layers in front of each other.
    file_writer_text(pov->out, "global_settings {\n"
                               "    assumed_gamma 1.0\n"
                               "    max_trace_level 40\n"
                               "    irid_wavelength rgb <0.61, 0.55, 0.465>\n"
                               "}\n"
                               "#default { finish { ambient 0 diffuse 1 } }\n\n");
}

static bool write_parts(Pov *pov)
{
    const Geometry *geometry = &pov->world->geometry;
    for (int64_t i = 0; i < geometry->count; i++) {
        if (run_is_cancelled(pov->run)) {
            return run_cancel_error(pov->e);
        }
        run_progress(pov->run, "export", (double)i / (double)geometry->count);
        const Part *part = &geometry->part[i];
        if (!(part->kind == PART_MESH ? pov_mesh_part(pov, i, part)
                                      : pov_curve_part(pov, i, part))) {
            return false;
        }
    }
    return true;
}

static bool write_scene(Pov *pov, const char *title)
{
    write_head(pov, title);
    pov_camera(pov);
    if (!pov_sky(pov)) {
        return false;
    }
    pov_medium(pov);
    pov_lamps(pov);
    return pov_glow(pov) && pov_materials(pov) && write_parts(pov);
}

// "scenes/oak.pov" has its pictures in "scenes/oak-textures".
static bool name_folder(Pov *pov)
{
    pov->folder = asset_beside(pov->file, "-textures", pov->e);
    if (pov->folder) {
        const char *slash = strrchr(pov->folder, '/');
        pov->beside = slash ? slash + 1 : pov->folder;
    }
    return pov->folder != NULL;
}

static bool make_lights(Pov *pov)
{
    pov->far = *pov->world;
    pov->far.geometry = (Geometry){0};
    pov->far.light_count = 0;
    pov->far.medium.kind = MEDIUM_NONE;
    pov->lights = lights_new(&pov->far, 1.0f, pov->run, pov->e);
    pov->sun = pov->lights ? lights_sun(pov->lights) : NULL;
    return pov->lights != NULL;
}

static bool write_pov(const ExportSource *source, const char *file, const Run *run, Error *e)
{
    Pov pov = {.world = source->world, .run = run, .e = e, .file = file};
    if (!name_folder(&pov) || !(pov.out = file_writer_open(file, e))) {
        free(pov.folder);
        return false;
    }
    measure_world(&pov);
    bool whole = make_lights(&pov) && write_scene(&pov, source->title);
    lights_free(pov.lights);
    rmdir(pov.folder); // removes it only if it is empty
    free(pov.folder);
    if (whole && run_is_cancelled(run)) {
        whole = run_cancel_error(e);
    }
    return file_writer_close(pov.out, whole, e) && whole;
}

const ExportFormat pov_format = {
    ".pov", "a scene that POV-Ray renders as it is; pictures in NAME-textures/",
    (int)(sizeof "-textures" - sizeof ".pov"), EXPORT_WORLD, write_pov};
