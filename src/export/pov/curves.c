// Round curves as spheres and cones; with many instances as tubes, because POV-Ray copies unions,
// but not meshes.
#include "export/pov/pov.h"

#include "base/memory.h"
#include "export/pov/shade.h"
#include "mesh/curve_tubes.h"
#include "render/light/emitter.h"

#include <stdlib.h>

// A sphere at each point and the tangent cone between two: what the ray tracer renders.
static void write_segment(Pov *pov, const CurveSet *curves, int64_t i, bool last)
{
    Vec3 a = curves->position[i], b = curves->position[i + 1];
    float ra = curves->radius[i], rb = curves->radius[i + 1];
    Emitter cone = emitter_cone(a, b, ra, rb, 1.0f, 1.0f, 0);
    file_writer_text(pov->out, "sphere { ");
    pov_point(pov, a);
    file_writer_text(pov->out, ",");
    pov_number(pov, ra * pov->unit);
    file_writer_text(pov->out, " }\n");
    if (vec3_dot(cone.b, cone.b) > 0.0f) {
        file_writer_text(pov->out, "cone { ");
        pov_point(pov, cone.a);
        file_writer_text(pov->out, ",");
        pov_number(pov, cone.radius0 * pov->unit);
        pov_point(pov, vec3_add(cone.a, cone.b));
        file_writer_text(pov->out, ",");
        pov_number(pov, cone.radius1 * pov->unit);
        file_writer_text(pov->out, " open }\n");
    }
    if (last) {
        file_writer_text(pov->out, "sphere { ");
        pov_point(pov, b);
        file_writer_text(pov->out, ",");
        pov_number(pov, rb * pov->unit);
        file_writer_text(pov->out, " }\n");
    }
}

// The segments of one colour, or of all where shade is NULL.
static void write_segments(Pov *pov, const CurveSet *curves, const uint8_t *shade, int wanted)
{
    int64_t n = 0;
    for (int64_t k = 0; k < curves->curve_count && !run_is_cancelled(pov->run); k++) {
        int64_t last = curves->first[k + 1] - 2;
        for (int64_t i = curves->first[k]; i <= last; i++, n++) {
            if (!shade || shade[n] == wanted) {
                write_segment(pov, curves, i, i == last);
            }
        }
    }
}

static void write_union(Pov *pov, int64_t number, const Part *part, const uint8_t *shade,
                        int wanted)
{
    file_writer_text(pov->out, "union {\n");
    write_segments(pov, part->curves, shade, wanted);
    file_writer_print(pov->out, "texture { P%lld_%d }", (long long)number, wanted);
    pov_interior(pov, part->material);
    file_writer_text(pov->out, " }\n");
}

// Colours are chosen with emission scaled to 0 .. 1 of the brightest.
static float brightest(const PovShades *shades)
{
    float most = 1.0f;
    for (int64_t i = 0; i < shades->count; i++) {
        Vec3 c = shades->color[i];
        most = fmaxf(most, fmaxf(c.x, fmaxf(c.y, c.z)));
    }
    return most;
}

static bool write_shaded_curves(Pov *pov, int64_t number, const Part *part, PovShades *shades,
                                uint8_t *shade)
{
    Palette colors;
    float most = brightest(shades);
    for (int64_t i = 0; i < shades->count; i++) {
        shades->color[i] = vec3_scale(shades->color[i], 1.0f / most);
    }
    if (!palette_make(shades->color, shades->transmittance, shades->count, POV_COLORS, &colors,
                      shade, pov->e)) {
        return false;
    }
    for (int i = 0; i < colors.count; i++) {
        colors.color[i] = vec3_scale(colors.color[i], most);
    }
    pov_textures(pov, number, part->material, &colors);
    for (int i = 0; i < colors.count; i++) {
        write_union(pov, number, part, shade, i);
    }
    return true;
}

// The number of sides of tubes that keeps a part small: each corner takes some 60 bytes of the
// file.
static int tube_sides(int64_t points)
{
    const int64_t corners = 300000, most = 2 * CURVE_TUBE_SIDES;
    int64_t sides = corners / points;
    return (int)(sides < CURVE_TUBE_SIDES ? CURVE_TUBE_SIDES : sides > most ? most : sides);
}

// A polygon inscribed in a circle is narrower from most sides; this factor makes it as wide on
// average.
static float tube_width(int sides)
{
    float half_turn = PI_F / (float)sides;
    return half_turn / sinf(half_turn);
}

static bool write_tubes(Pov *pov, int64_t number, const Part *part)
{
    CurveSet wide = *part->curves;
    int sides = tube_sides(wide.point_count);
    wide.radius = memory_alloc(wide.point_count, sizeof *wide.radius, pov->e);
    if (!wide.radius) {
        return false;
    }
    for (int64_t i = 0; i < wide.point_count; i++) {
        wide.radius[i] = tube_width(sides) * part->curves->radius[i];
    }
    Part tubes = *part;
    tubes.kind = PART_MESH;
    tubes.curves = NULL;
    tubes.mesh = curve_tubes(&wide, 0, wide.curve_count, sides, pov->e);
    free(wide.radius);
    bool done = tubes.mesh && pov_mesh_part(pov, number, &tubes);
    mesh_free(tubes.mesh);
    return done;
}

bool pov_curve_part(Pov *pov, int64_t number, const Part *part)
{
    const CurveSet *curves = part->curves;
    if (curves->curve_count < 1) {
        return true;
    }
    if (part->instance) {
        return write_tubes(pov, number, part);
    }
    PovShades shades;
    if (!pov_shade_curves(&pov->world->material[part->material], curves, &shades, pov->e)) {
        return false;
    }
    uint8_t *shade = memory_alloc(shades.count, 1, pov->e);
    bool done = shade && write_shaded_curves(pov, number, part, &shades, shade);
    free(shade);
    pov_shades_clear(&shades);
    return done;
}
