// Meshes and their instances: a mesh that is drawn many times is declared once.
#include "export/pov/pov.h"

#include "base/memory.h"
#include "base/number_text.h"
#include "export/pov/shade.h"
#include "export/vertex.h"

#include <stdlib.h>

enum { SMALL_MESH = 256 };

// A mesh to be written.
typedef struct MeshJob {
    const Mesh *mesh;
    float scale;          // of positions
    const Vec3 *normal;   // NULL = flat
    const uint8_t *shade; // of each vertex, the number of its texture; NULL = one for all
    Palette *colors;      // its textures
    int material;
    int64_t number; // of the part
} MeshJob;

// ---- meshes

// The text of one vertex.
static char *put_vec3(char *out, Vec3 v)
{
    *out++ = '<';
    out = floats_text(out, (const float[3]){v.x, v.y, v.z}, 3, ',');
    *out++ = '>';
    *out++ = '\n';
    return out;
}

enum { VECTOR_ROOM = 3 * (FLOAT_TEXT_MOST + 1) + 4, FACE_ROOM = 6 * (INTEGER_TEXT_MOST + 1) + 4 };

// Lines are made here and copied: file_writer_room would reserve the longest line each time.
static void write_vec3s(Pov *pov, const char *name, const Vec3 *v, int64_t count, float scale)
{
    char text[VECTOR_ROOM];
    file_writer_print(pov->out, "%s { %lld,\n", name, (long long)count);
    for (int64_t i = 0; i < count && !((i & 0xffff) == 0 && run_is_cancelled(pov->run)); i++) {
        file_writer_bytes(pov->out, text, (size_t)(put_vec3(text, vec3_scale(v[i], scale)) - text));
    }
    file_writer_text(pov->out, "}\n");
}

static void write_normals(Pov *pov, const MeshJob *job)
{
    char text[VECTOR_ROOM];
    file_writer_print(pov->out, "normal_vectors { %lld,\n", (long long)job->mesh->vertex_count);
    for (int64_t i = 0; i < job->mesh->vertex_count; i++) {
        Vec3 n = job->normal[i]; // rounded to visible precision
        n = vec3(roundf(n.x * 1e5f) / 1e5f, roundf(n.y * 1e5f) / 1e5f, roundf(n.z * 1e5f) / 1e5f);
        n = vec3_dot(n, n) > 0.0f ? n : vec3(0.0f, 1.0f, 0.0f);
        file_writer_bytes(pov->out, text, (size_t)(put_vec3(text, n) - text));
    }
    file_writer_text(pov->out, "}\n");
}

static void write_uvs(Pov *pov, const Mesh *mesh)
{
    char text[VECTOR_ROOM];
    file_writer_print(pov->out, "uv_vectors { %lld,\n", (long long)mesh->vertex_count);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        char *end = text;
        *end++ = '<';
        end = floats_text(end, &mesh->uv[i].x, 2, ',');
        *end++ = '>';
        *end++ = '\n';
        file_writer_bytes(pov->out, text, (size_t)(end - text));
    }
    file_writer_text(pov->out, "}\n");
}

// POV-Ray skips triangles without area, with a warning each.
static bool has_area(const Mesh *mesh, const uint32_t t[3])
{
    Vec3 a = mesh->position[t[0]];
    Vec3 across = vec3_cross(vec3_sub(mesh->position[t[1]], a), vec3_sub(mesh->position[t[2]], a));
    return vec3_dot(across, across) > 0.0f;
}

static void write_triangle(Pov *pov, const uint32_t t[3], const uint8_t *shade)
{
    char text[FACE_ROOM], *end = text;
    *end++ = '<';
    for (int k = 0; k < 3; k++) {
        end = integer_text(end, t[k]);
        *end++ = k < 2 ? ',' : '>';
    }
    int different = shade && (shade[t[0]] != shade[t[1]] || shade[t[0]] != shade[t[2]]) ? 3 : 1;
    for (int k = 0; shade && k < different; k++) {
        *end++ = ',';
        end = integer_text(end, shade[t[k]]);
    }
    *end++ = '\n';
    file_writer_bytes(pov->out, text, (size_t)(end - text));
}

static int64_t count_triangles(const Mesh *mesh)
{
    int64_t count = 0;
    uint32_t t[6]; // POV-Ray sees a face from outside clockwise
    for (int64_t f = 0; f < mesh->face_count; f++) {
        for (int k = export_face_triangles(mesh, f, true, t) - 1; k >= 0; k--) {
            count += has_area(mesh, t + 3 * k);
        }
    }
    return count;
}

static void write_faces(Pov *pov, const MeshJob *job, int64_t count)
{
    uint32_t t[6]; // POV-Ray sees a face from outside clockwise
    file_writer_print(pov->out, "face_indices { %lld,\n", (long long)count);
    for (int64_t f = 0; f < job->mesh->face_count; f++) {
        int triangles = export_face_triangles(job->mesh, f, true, t);
        for (int k = 0; k < triangles; k++) {
            if (has_area(job->mesh, t + 3 * k)) {
                write_triangle(pov, t + 3 * k, job->shade);
            }
        }
    }
    file_writer_text(pov->out, "}\n");
}

static void write_palette(Pov *pov, const MeshJob *job)
{
    file_writer_print(pov->out, "texture_list { %d,\n", job->colors->count);
    for (int i = 0; i < job->colors->count; i++) {
        file_writer_print(pov->out, "texture { P%lld_%d }\n", (long long)job->number, i);
    }
    file_writer_text(pov->out, "}\n");
}

// The contents of "mesh2 { }", without a texture for all.
static void write_mesh(Pov *pov, const MeshJob *job, int64_t triangles)
{
    const Mesh *mesh = job->mesh;
    write_vec3s(pov, "vertex_vectors", mesh->position, mesh->vertex_count, job->scale);
    if (job->normal) {
        write_normals(pov, job);
    }
    if (mesh->uv && pov_has_picture(&pov->world->material[job->material])) {
        write_uvs(pov, mesh);
    }
    if (job->shade) {
        write_palette(pov, job);
    }
    write_faces(pov, job, triangles);
    if (material_has(&pov->world->material[job->material], TRAIT_BODY)) {
        file_writer_text(pov->out, "inside_vector <0,1,0>\n");
    }
}

// ---- instances

static void write_matrix(Pov *pov, const Transform *t)
{
    float u = pov->unit;
    const float m[12] = {t->m[0][0] * u, t->m[1][0] * u, t->m[2][0] * u, t->m[0][1] * u,
                         t->m[1][1] * u, t->m[2][1] * u, t->m[0][2] * u, t->m[1][2] * u,
                         t->m[2][2] * u, t->m[0][3] * u, t->m[1][3] * u, t->m[2][3] * u};
    file_writer_text(pov->out, " matrix <");
    pov_number_list(pov, m, 12);
    file_writer_text(pov->out, ">");
}

static void own_colors(const Material *m, Palette *colors)
{
    Appearance a = material_appearance(m);
    colors->count = 1;
    colors->color[0] = appearance_display_color(&a);
    colors->second[0] = m->transmittance;
}

// shade: for each instance, the index of its texture; NULL = the first.
static void write_instances(Pov *pov, const MeshJob *job, const Part *part, const uint8_t *shade)
{
    long long number = job->number;
    for (int64_t i = 0; i < part->instance_count && !run_is_cancelled(pov->run); i++) {
        file_writer_print(pov->out, "object { P%lld", number);
        if (!job->shade) { // else the mesh has textures
            file_writer_print(pov->out, " texture { P%lld_%d }", number, shade ? shade[i] : 0);
        }
        write_matrix(pov, &part->instance[i]);
        pov_interior(pov, part->material);
        file_writer_text(pov->out, " }\n");
    }
}

// Quantises the colours of the instances of a small mesh to a palette.
static bool shade_instances(Pov *pov, const Part *part, Palette *colors, uint8_t **shade)
{
    PovShades shades;
    const Material *m = &pov->world->material[part->material];
    if (!pov_shade_instances(m, part, pov->run, &shades, pov->e)) {
        return false;
    }
    *shade = memory_alloc(part->instance_count, 1, pov->e);
    bool done = *shade && palette_make(shades.color, shades.transmittance, shades.count, POV_COLORS,
                                       colors, *shade, pov->e);
    pov_shades_clear(&shades);
    return done;
}

static bool write_instanced(Pov *pov, const Part *part, MeshJob *job, int64_t triangles)
{
    const Material *m = &pov->world->material[part->material];
    uint8_t *shade = NULL;
    bool differ =
        !job->shade && !pov_has_picture(m) && (material_varies(m) || material_has_pattern(m));
    if (differ && !shade_instances(pov, part, job->colors, &shade)) {
        free(shade);
        return false;
    }
    job->scale = 1.0f;
    pov_textures(pov, job->number, job->material, job->colors);
    file_writer_print(pov->out, "#declare P%lld = mesh2 {\n", (long long)job->number);
    write_mesh(pov, job, triangles);
    file_writer_text(pov->out, "}\n");
    write_instances(pov, job, part, shade);
    free(shade);
    return true;
}

// ---- one part

static void write_single(Pov *pov, MeshJob *job, int64_t triangles)
{
    job->scale = pov->unit;
    pov_textures(pov, job->number, job->material, job->colors);
    file_writer_text(pov->out, "mesh2 {\n");
    write_mesh(pov, job, triangles);
    if (!job->shade) {
        file_writer_print(pov->out, "texture { P%lld_0 }", (long long)job->number);
    }
    pov_interior(pov, job->material);
    file_writer_text(pov->out, " }\n");
}

// Assigns each vertex one of a few textures, which POV-Ray interpolates over the triangles.
static bool shade_vertices(Pov *pov, const Part *part, PovShades *shades, Palette *colors,
                           uint8_t **shade)
{
    const Material *m = &pov->world->material[part->material];
    const Mesh *mesh = part->mesh;
    if (!pov_shade_mesh(m, mesh, part->instance,
                        part->instance ? part_look(part, 0) : (InstanceLook){0.5f, 0.0f}, pov->run,
                        shades, pov->e)) {
        return false;
    }
    *shade = memory_alloc(mesh->vertex_count, 1, pov->e);
    return *shade && palette_make(shades->color, shades->transmittance, mesh->vertex_count,
                                  PALETTE_MOST, colors, *shade, pov->e);
}

bool pov_mesh_part(Pov *pov, int64_t number, const Part *part)
{
    const Material *m = &pov->world->material[part->material];
    int64_t triangles = count_triangles(part->mesh);
    if (triangles == 0 || (part->instance && part->instance_count < 1)) {
        return true;
    }
    PovShades shades = {0};
    Palette colors;
    uint8_t *shade = NULL;
    MeshJob job = {.mesh = part->mesh,
                   .normal = part->mesh->normal,
                   .colors = &colors,
                   .material = part->material,
                   .number = number};
    own_colors(m, &colors);
    bool by_vertex = !pov_has_picture(m) &&
                     (material_has_pattern(m) || (material_varies(m) && !part->instance)) &&
                     (!part->instance || part->mesh->vertex_count > SMALL_MESH);
    bool done = !by_vertex || shade_vertices(pov, part, &shades, &colors, &shade);
    if (by_vertex && done) {
        job.shade = shade;
        job.normal = shades.normal ? shades.normal : job.normal;
    }
    if (done && part->instance) {
        done = write_instanced(pov, part, &job, triangles);
    } else if (done) {
        write_single(pov, &job, triangles);
    }
    free(shade);
    pov_shades_clear(&shades);
    return done;
}
