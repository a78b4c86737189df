// Tessellates primitives: a profile revolved about the axis, or six faces, then the transform.
#include "base/exact_math.h"
#include "base/memory.h"
#include "shape/affine.h"
#include "shape/primitive.h"

#include <math.h>

enum { AROUND = 128, ARC = 32 }; // facets per turn; per quarter turn

// One vertex of a profile: radius, height and the normal in the half plane.
typedef struct ProfilePoint {
    float r, y, nr, ny;
} ProfilePoint;

typedef struct Profile {
    ProfilePoint point[4 * ARC + 8];
    int count;
} Profile;

static void profile_add(Profile *profile, double r, double y, double nr, double ny)
{
    profile->point[profile->count++] = (ProfilePoint){(float)r, (float)y, (float)nr, (float)ny};
}

// Appends a quarter circle of this radius about (0, y), starting at angle `from` (-90 or 0
// degrees).
static void profile_quarter(Profile *profile, double radius, double y, int from)
{
    for (int i = 0; i <= ARC; i++) {
        float s, c;
        exact_sincos(0.5f * PI_F * ((float)i / ARC + (float)from), &s, &c);
        bool pole = (from < 0 && i == 0) || (from == 0 && i == ARC);
        double rise = pole ? 1.0 + 2.0 * from : (double)s, out = pole ? 0.0 : (double)c;
        profile_add(profile, radius * out, y + radius * rise, out, rise);
    }
}

static Profile profile_of(const Primitive *p)
{
    Profile profile = {.count = 0};
    const double *s = p->raw_size;
    if (p->kind == SHAPE_CONE) {
        double rise = s[0] - s[2], slant = sqrt(s[1] * s[1] + rise * rise);
        profile_add(&profile, 0.0, 0.0, 0.0, -1.0);
        profile_add(&profile, s[0], 0.0, 0.0, -1.0);
        profile_add(&profile, s[0], 0.0, s[1] / slant, rise / slant);
        profile_add(&profile, s[2], s[1], s[1] / slant, rise / slant);
        profile_add(&profile, s[2], s[1], 0.0, 1.0);
        profile_add(&profile, 0.0, s[1], 0.0, 1.0);
    } else {
        bool capsule = p->kind == SHAPE_CAPSULE;
        profile_quarter(&profile, capsule ? s[0] : 1.0, 0.0, -1);
        profile_quarter(&profile, capsule ? s[0] : 1.0, capsule ? s[1] : 0.0, 0);
    }
    return profile;
}

// Writes those of the two triangles between profile rows i and i + 1 that have an area; returns how
// many.
static int64_t turn_quads(const Profile *profile, int i, uint32_t *index)
{
    const ProfilePoint *a = &profile->point[i], *b = a + 1;
    if (a->r == b->r && a->y == b->y) {
        return 0;
    }
    int64_t n = 0;
    for (int j = 0; j < AROUND; j++) {
        uint32_t low = (uint32_t)(i * AROUND), high = low + AROUND;
        uint32_t here = (uint32_t)j, next = (uint32_t)((j + 1) % AROUND);
        if (a->r > 0.0f) {
            uint32_t *t = index + 3 * n++;
            t[0] = low + here, t[1] = high + next, t[2] = low + next;
        }
        if (b->r > 0.0f) {
            uint32_t *t = index + 3 * n++;
            t[0] = low + here, t[1] = high + here, t[2] = high + next;
        }
    }
    return n;
}

static Mesh *turn_profile(const Profile *profile, Error *e)
{
    Mesh *mesh = mesh_new(3, (int64_t)profile->count * AROUND,
                          2 * (int64_t)(profile->count - 1) * AROUND, MESH_NORMAL, e);
    if (!mesh) {
        return NULL;
    }
    for (int j = 0; j < AROUND; j++) {
        float s, c;
        exact_sincos(2.0f * PI_F * (float)j / AROUND, &s, &c);
        for (int i = 0; i < profile->count; i++) {
            const ProfilePoint *p = &profile->point[i];
            mesh->position[i * AROUND + j] = vec3(p->r * c, p->y, p->r * s);
            mesh->normal[i * AROUND + j] = vec3(p->nr * c, p->ny, p->nr * s);
        }
    }
    mesh->face_count = 0;
    for (int i = 0; i + 1 < profile->count; i++) {
        mesh->face_count += turn_quads(profile, i, mesh->index + 3 * mesh->face_count);
    }
    return mesh;
}

static Mesh *box_surface(const double size[3], Error *e)
{
    Mesh *mesh = mesh_new(3, 24, 12, MESH_NORMAL, e);
    if (!mesh) {
        return NULL;
    }
    for (int face = 0; face < 6; face++) {
        int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        float side = face & 1 ? 1.0f : -1.0f;
        for (int corner = 0; corner < 4; corner++) {
            float p[3], n[3] = {0, 0, 0};
            // counter-clockwise seen from outside, on both sides
            float a = corner == 1 || corner == 2 ? 1.0f : -1.0f, b = corner >= 2 ? 1.0f : -1.0f;
            p[axis] = side * (float)size[axis];
            p[u] = a * side * (float)size[u];
            p[v] = b * (float)size[v];
            n[axis] = side;
            mesh->position[4 * face + corner] = vec3(p[0], p[1], p[2]);
            mesh->normal[4 * face + corner] = vec3(n[0], n[1], n[2]);
        }
        static const uint32_t order[6] = {0, 1, 2, 0, 2, 3};
        for (int k = 0; k < 6; k++) {
            mesh->index[6 * face + k] = (uint32_t)(4 * face) + order[k];
        }
    }
    return mesh;
}

Mesh *primitive_surface(const Primitive *p, Error *e)
{
    Mesh *mesh;
    Transform t;
    bool round = p->kind == SHAPE_ELLIPSOID;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            // an ellipsoid is the unit sphere scaled along its axes
            t.m[i][j] =
                (float)(round ? p->forward[i][j] * (j < 3 ? p->size[j] : 1.0) : p->affine[i][j]);
        }
    }
    if (p->kind == SHAPE_BOX) {
        mesh = box_surface(p->raw_size, e);
    } else {
        Profile profile = profile_of(p);
        mesh = turn_profile(&profile, e);
    }
    if (mesh && !mesh_transform(mesh, &t, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}
