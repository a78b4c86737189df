// Meshes a waterfall: the sheet that bends over the lip, and strands, three vertices across.
#include "base/noise.h"
#include "objects/terrain/fall.h"
#include "objects/terrain/white_water.h"

#include <math.h>

// A fall being meshed.
typedef struct FallMesher {
    const Fall *fall;
    Mesh *mesh;
    int64_t vertices, faces;
} FallMesher;

// A quad between vertices v and v + 1 of a row and those of the row above it, `columns` before:
// seen from the front, counter-clockwise.
static void add_quad(FallMesher *f, uint32_t v, uint32_t columns)
{
    uint32_t *corner = f->mesh->index + 4 * f->faces++;
    corner[0] = v - columns;
    corner[1] = v;
    corner[2] = v + 1;
    corner[3] = v + 1 - columns;
}

static void put_vertex(FallMesher *f, int64_t v, Vec3 at, float foam)
{
    const Fall *fall = f->fall;
    f->mesh->position[v] = vec3_add(at, fall->terrain->params->position);
    Vec3 from = fall->terrain->water->position[fall->lip];
    float down = from.y - at.y,
          fast = fmaxf(fall->speed, sqrtf(2.0f * FALL_GRAVITY * fmaxf(down, 0.0f)));
    f->mesh->uv[v] =
        (Vec2){terrain_drawn_out(fast) * down, vec3_dot(vec3_sub(at, from), fall->across)};
    f->mesh->foam[v] = foam;
}

static void add_strand_row(FallMesher *f, Vec3 p, Vec3 along, float half, float foam)
{
    const Fall *fall = f->fall;
    Vec3 front = vec3_normalize(vec3_cross(along, fall->across));
    for (int i = 0; i < 3; i++) {
        Vec3 at = vec3_madd(p, (float)(i - 1) * half, fall->across);
        put_vertex(f, f->vertices++, i == 1 ? vec3_madd(at, 0.6f * half, front) : at, foam);
    }
}

static void add_strand(FallMesher *f, int strand)
{
    const Fall *fall = f->fall;
    Vec3 place[FALL_STEPS];
    float step;
    int count = fall_strand_path(fall, strand, place, &step);
    if (count < 2) {
        return;
    }
    float lip = fall->terrain->flow[fall->lip].foam;
    float white = fall_strand_white(fall, strand);
    for (int row = 0; row < fall->detail.rows; row++) {
        float at = (float)row / (float)(fall->detail.rows - 1) * (float)(count - 1);
        int k = (int)at < count - 2 ? (int)at : count - 2;
        Vec3 p = vec3_lerp(place[k], place[k + 1], at - (float)k);
        float share = (place[0].y - p.y) / fmaxf(place[0].y - fall->level, 1e-6f);
        if (fall->breaks && white_water_share(share) >= 1.0f) {
            break;
        }
        float foam = lerpf(fmaxf(lip, 0.35f), white, smoothstepf(0.0f, 0.12f, share));
        foam = lerpf(foam, 1.0f, smoothstepf(0.6f, 1.0f, share));
        add_strand_row(f, p, vec3_sub(place[k + 1], place[k]),
                       fall_strand_half(fall, strand, share), foam);
        for (uint32_t i = 0; i < 2 && row > 0; i++) {
            add_quad(f, (uint32_t)f->vertices - 3 + i, 3);
        }
    }
}

// ---- the sheet

static int sheet_columns(const Fall *fall)
{
    return 2 * fall->detail.columns + 1;
}

static float share_fallen(const Fall *fall, const Vec3 *place, int k)
{
    return (place[0].y - place[k].y) / fmaxf(place[0].y - fall->level, 1e-6f);
}

// The place on a path, in steps, where it has fallen by this share of its height.
static float step_at(const Fall *fall, const Vec3 *place, int count, float share)
{
    int k = 0;
    while (k < count - 2 && share_fallen(fall, place, k + 1) < share) {
        k++;
    }
    float from = share_fallen(fall, place, k), to = share_fallen(fall, place, k + 1);
    return (float)k + clampf((share - from) / fmaxf(to - from, 1e-6f), 0.0f, 1.0f);
}

// Water bends over the lip as one sheet, clear at first, then white in streaks; it is torn where
// the strands of it are wide enough, earlier where rocks hold it back. Its columns begin as level
// as the river ends.
static void add_sheet(FallMesher *f)
{
    const Fall *fall = f->fall;
    uint32_t columns = (uint32_t)sheet_columns(fall), rows = (uint32_t)fall->detail.sheet;
    uint32_t first = (uint32_t)f->vertices;
    uint64_t seed = fall_stream(fall, FALL_STREAM_SHEET);
    float lip = fall->terrain->flow[fall->lip].foam;
    f->vertices += (int64_t)columns * rows;
    for (uint32_t column = 0; column < columns; column++) {
        float side = 2.0f * (float)column / (float)(columns - 1) - 1.0f, step;
        Vec3 place[FALL_STEPS];
        int count = fall_sheet_path(fall, side, place, &step);
        float x = side * fall->half, streak = noise_plane_fractal(2.7f * x, 0.7f, 3, seed);
        float ends =
            lerpf(0.05f, 0.2f, fminf(fall_tongue(fall, side), 1.0f)) * (1.0f + 0.5f * streak);
        float last = count > 1 ? step_at(fall, place, count, ends) : 0.0f;
        for (uint32_t row = 0; row < rows; row++) {
            float along = (float)row / (float)(rows - 1), at = along * last;
            int k = count > 1 && (int)at > count - 2 ? count - 2 : (int)at;
            Vec3 p = count > 1 ? vec3_lerp(place[k], place[k + 1], at - (float)k)
                               : fall_start(fall, 0.97f * side);
            float white = smoothstepf(0.1f, 0.9f, along + 0.7f * streak * (1.0f - along));
            uint32_t v = first + row * columns + column;
            put_vertex(f, v, p, lerpf(lip, 1.0f, white));
            if (row > 0 && column + 1 < columns) {
                add_quad(f, v, columns);
            }
        }
    }
}

Mesh *fall_mesh(const Fall *fall, Error *e)
{
    int strands = fall_strand_count(fall);
    int64_t columns = sheet_columns(fall), rows = fall->detail.rows, sheet = fall->detail.sheet;
    FallMesher f = {.fall = fall,
                    .mesh = mesh_new(4, strands * rows * 3 + columns * sheet,
                                     strands * (rows - 1) * 2 + (columns - 1) * (sheet - 1),
                                     MESH_NORMAL | MESH_UV | MESH_FOAM, e)};
    if (!f.mesh) {
        return NULL;
    }
    add_sheet(&f);
    for (int i = 0; i < strands; i++) {
        add_strand(&f, i);
    }
    f.mesh->vertex_count = f.vertices;
    f.mesh->face_count = f.faces;
    if (!mesh_compute_normals(f.mesh, e) || !drawn_move(fall->land, f.mesh, e)) {
        mesh_free(f.mesh);
        return NULL;
    }
    return f.mesh;
}
