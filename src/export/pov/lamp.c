// Lamps. In POV-Ray a white diffuse surface facing a light of colour c shows c; in nature it shows
// E / pi under an irradiance E. So every light's colour is irradiance over pi, divided by the
// factor 2 of POV-Ray's fading, 2 / (1 + (d / fade_distance)^2).
#include "export/pov/pov.h"

enum { LAMP_GRID = 8 }; // light points along a lamp's side; a power of two

// fade_distance as a share of the lamp's size: small enough for an inverse square law to within a
// millionth.
static const float FADE_SHARE = 1e-3f;

// Points of a grid lie in the middle of equal cells.
static float grid_side(float side)
{
    return side * (float)(LAMP_GRID - 1) / (float)LAMP_GRID;
}

static void write_fade(Pov *pov, float distance)
{
    file_writer_print(pov->out, "    fade_distance %.9g fade_power 2\n}\n", (double)distance);
}

// A spotlight of tightness 1 has the cosine falloff of a lamp's face.
static void write_quad(Pov *pov, const Light *light)
{
    Vec3 normal = vec3_cross(light->edge_u, light->edge_v);
    float area = vec3_length(normal) * pov->unit * pov->unit;
    if (!(area > 0.0f)) {
        return;
    }
    float fade = FADE_SHARE * sqrtf(area);
    Vec3 middle = vec3_madd(vec3_madd(light->corner, 0.5f, light->edge_u), 0.5f, light->edge_v);
    file_writer_text(pov->out, "light_source {\n    ");
    pov_point(pov, middle);
    file_writer_text(pov->out, " rgb ");
    pov_vector(pov, vec3_scale(light->radiance, area / (2.0f * PI_F * fade * fade)));
    file_writer_text(pov->out, "\n    spotlight radius 90 falloff 90 tightness 1 point_at ");
    pov_point(pov, vec3_add(middle, vec3_normalize(normal)));
    file_writer_text(pov->out, "\n    area_light ");
    pov_point(pov, vec3_scale(light->edge_u, grid_side(1.0f)));
    file_writer_text(pov->out, ", ");
    pov_point(pov, vec3_scale(light->edge_v, grid_side(1.0f)));
    file_writer_print(pov->out, ", %d, %d adaptive 2 area_illumination on\n", LAMP_GRID, LAMP_GRID);
    write_fade(pov, fade);
}

// Outside of it, a sphere lights like a point at its centre.
static void write_ball(Pov *pov, const Light *light)
{
    float radius = light->radius * pov->unit, fade = FADE_SHARE * radius;
    file_writer_text(pov->out, "light_source {\n    ");
    pov_point(pov, light->center);
    file_writer_text(pov->out, " rgb ");
    pov_vector(pov, vec3_scale(light->radiance, radius * radius / (2.0f * fade * fade)));
    float side = grid_side(2.0f * radius);
    file_writer_print(
        pov->out, "\n    area_light <%.9g,0,0>, <0,%.9g,0>, %d, %d adaptive 2 circular orient\n",
        (double)side, (double)side, LAMP_GRID, LAMP_GRID);
    write_fade(pov, fade);
}

// The visible surface of a lamp. It casts no shadow, since its light source lies inside, and
// radiosity must not gather it a second time.
static void write_face(Pov *pov, const Light *light)
{
    if (light->kind == LIGHT_SPHERE) {
        file_writer_text(pov->out, "sphere { ");
        pov_point(pov, light->center);
        file_writer_print(pov->out, ", %.9g", (double)(light->radius * pov->unit));
    } else {
        Vec3 u = vec3_add(light->corner, light->edge_u), v = vec3_add(light->corner, light->edge_v);
        file_writer_text(pov->out, "mesh2 { vertex_vectors { 4, ");
        pov_point(pov, light->corner);
        pov_point(pov, u);
        pov_point(pov, vec3_add(u, light->edge_v));
        pov_point(pov, v);
        // POV-Ray's faces are clockwise.
        file_writer_text(pov->out, " } face_indices { 2, <0,3,1>, <2,1,3> }");
    }
    file_writer_text(pov->out, "\n    texture { pigment { rgb ");
    pov_vector(pov, light->radiance);
    file_writer_text(pov->out, " } finish { diffuse 0 emission 1 } }\n");
    if (light->kind == LIGHT_QUAD) {
        file_writer_text(pov->out,
                         "    interior_texture { pigment { rgb 0 } finish { diffuse 0 } }\n");
    }
    file_writer_text(pov->out, "    no_shadow no_radiosity\n}\n\n");
}

void pov_lamps(Pov *pov)
{
    for (int i = 0; i < pov->world->light_count; i++) {
        const Light *light = &pov->world->light[i];
        if (light->kind == LIGHT_QUAD) {
            write_quad(pov, light);
        } else {
            write_ball(pov, light);
        }
        write_face(pov, light);
    }
}
