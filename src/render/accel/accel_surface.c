// Where a hit is: the piece of the geometry, and the point of its surface.
#include "render/accel/accel_internal.h"

int accel_light(const Accel *accel, const Hit *hit)
{
    AccelEntry entry = accel->entry[hit->geometry];
    return entry.piece < 0 ? (int)entry.instance : -1;
}

// A hit of a piece in terms of its mesh or curves.
typedef struct PieceHit {
    const AccelPiece *own;
    uint32_t instance, primitive;
    float u, v;
} PieceHit;

static PieceHit piece_hit(const Accel *accel, const Hit *hit)
{
    AccelEntry entry = accel->entry[hit->geometry];
    const AccelPiece *own = &accel->piece[entry.piece + (int32_t)hit->member];
    PieceHit at = {own, entry.instance, hit->primitive, hit->u, hit->v};
    if (own->copied) {
        uint32_t faces = (uint32_t)own->mesh->face_count;
        at.instance = accel_instance(own, hit->primitive / faces);
        at.primitive = hit->primitive % faces;
    } else if (own->pairs.count > 0) {
        at.primitive = pairs_triangle(own->pairs.face[hit->primitive], &at.u, &at.v);
    }
    return at;
}

SurfacePlace accel_place(const Accel *accel, const Hit *hit)
{
    PieceHit at = piece_hit(accel, hit);
    SurfacePlace place = {.part = at.own->number,
                          .instance = at.instance,
                          .primitive = at.primitive,
                          .u = at.u,
                          .v = at.v};
    if (!at.own->mesh) {
        place.point = at.own->segment[hit->primitive];
    }
    return place;
}

// Normals transform by the cofactor matrix: right for any scale, without an inverse. The sign of
// the determinant keeps them outside when the transform mirrors.
static Vec3 normal_to_world(const Transform *t, Vec3 n)
{
    Vec3 x = vec3(t->m[0][0], t->m[1][0], t->m[2][0]);
    Vec3 y = vec3(t->m[0][1], t->m[1][1], t->m[2][1]);
    Vec3 z = vec3(t->m[0][2], t->m[1][2], t->m[2][2]);
    Vec3 yz = vec3_cross(y, z);
    Vec3 sum = vec3_madd(vec3_scale(yz, n.x), n.y, vec3_cross(z, x));
    sum = vec3_madd(sum, n.z, vec3_cross(x, y));
    return vec3_dot(x, yz) < 0.0f ? vec3_neg(sum) : sum;
}

// The point lifted to the tangent planes of the vertices: Hanika, "Hacking the Shadow Terminator",
// Ray Tracing Gems II, 2021. All in the part's space; normals on the ray's side.
static Vec3 lift(const Vec3 *position, const Vec3 *normal, const Corners *c, Vec3 p, float side)
{
    Vec3 lifted = p;
    for (int i = 0; i < 3; i++) {
        Vec3 n = vec3_scale(normal[c->vertex[i]], side);
        float depth = vec3_dot(vec3_sub(p, position[c->vertex[i]]), n);
        if (depth < 0.0f) {
            lifted = vec3_madd(lifted, -depth * c->weight[i], n);
        }
    }
    return lifted;
}

// dP/du and dP/dv of the triangle of c; false where uv is degenerate.
static bool uv_tangents(const Mesh *mesh, const Corners *c, Vec3 e1, Vec3 e2, SurfacePoint *point)
{
    Vec2 a = mesh->uv[c->vertex[0]], b = mesh->uv[c->vertex[1]], d = mesh->uv[c->vertex[2]];
    float u1 = b.x - a.x, v1 = b.y - a.y, u2 = d.x - a.x, v2 = d.y - a.y;
    float determinant = u1 * v2 - v1 * u2;
    if (fabsf(determinant) < 1e-20f) {
        return false;
    }
    float scale = 1.0f / determinant;
    point->tangent_u = vec3_scale(vec3_madd(vec3_scale(e1, v2), -v1, e2), scale);
    point->tangent_v = vec3_scale(vec3_madd(vec3_scale(e2, u1), -u2, e1), scale);
    return true;
}

// An interpolated normal on the facet's side, bent until it faces the ray's origin at least
// grazingly.
static Vec3 smooth_normal(Vec3 n, Vec3 facet, Vec3 direction)
{
    const float least = 1e-3f;
    n = vec3_dot(n, facet) < 0.0f ? vec3_neg(n) : n;
    float cosine = -vec3_dot(n, direction);
    return cosine >= least ? n : vec3_normalize(vec3_madd(n, cosine - 2.0f * least, direction));
}

static Vec3 weighted(const Vec3 *value, const Corners *c)
{
    Vec3 sum = vec3_scale(value[c->vertex[0]], c->weight[0]);
    sum = vec3_madd(sum, c->weight[1], value[c->vertex[1]]);
    return vec3_madd(sum, c->weight[2], value[c->vertex[2]]);
}

// What patterns need of the surface before displacement: they are looked up there, and their places
// follow `along` and the smooth normal from vertex to vertex. Diced meshes have no transform.
static void undisplaced(const DicedMesh *diced, const Corners *c, float side, SurfacePoint *point)
{
    point->object_position = weighted(diced->mesh->position, c);
    point->smooth_normal = vec3_scale(vec3_normalize(weighted(diced->mesh->normal, c)), side);
    point->along = vec3_normalize(weighted(diced->along, c));
    point->coarsening = diced->coarsening;
    for (int i = 0; i < 3; i++) {
        point->displaced += c->weight[i] * diced->share[c->vertex[i]];
    }
}

// What vertices tell beside their place: each mesh has only some of it.
static void add_attributes(const Mesh *mesh, const Corners *c, SurfacePoint *point)
{
    for (int i = 0; i < 3 && mesh->radius; i++) {
        point->radius += c->weight[i] * mesh->radius[c->vertex[i]];
    }
    for (int i = 0; i < 3 && mesh->birth; i++) {
        point->birth += c->weight[i] * mesh->birth[c->vertex[i]];
    }
    for (int i = 0; i < 3 && mesh->site; i++) {
        point->site.x += c->weight[i] * mesh->site[c->vertex[i]].x;
        point->site.y += c->weight[i] * mesh->site[c->vertex[i]].y;
    }
    for (int i = 0; i < 3 && mesh->foam; i++) {
        point->foam += c->weight[i] * mesh->foam[c->vertex[i]];
    }
    for (int i = 0; i < 3 && mesh->young; i++) {
        point->young += c->weight[i] * mesh->young[c->vertex[i]];
    }
    for (int i = 0; i < 3 && mesh->withered; i++) {
        point->withered += c->weight[i] * mesh->withered[c->vertex[i]];
    }
    for (int i = 0; i < 3 && mesh->shore; i++) {
        point->shore += c->weight[i] * mesh->shore[c->vertex[i]];
    }
}

static void mesh_surface(const PieceHit *at, const Transform *t, Vec3 direction,
                         SurfacePoint *point)
{
    const Mesh *mesh = at->own->mesh;
    const DicedMesh *diced = at->own->diced.mesh ? &at->own->diced : NULL;
    const Vec3 *position = diced ? diced->displaced : mesh->position;
    const Vec3 *normal = diced ? diced->normal : mesh->normal;
    Corners c = accel_corners(mesh, at->primitive, at->u, at->v);
    Vec3 a = position[c.vertex[0]];
    Vec3 e1 = vec3_sub(position[c.vertex[1]], a);
    Vec3 e2 = vec3_sub(position[c.vertex[2]], a);
    Vec3 p = vec3_madd(vec3_madd(a, c.weight[1], e1), c.weight[2], e2);
    Vec3 facet = vec3_cross(e1, e2);
    Vec3 geometric = vec3_normalize(t ? normal_to_world(t, facet) : facet);
    point->backface = vec3_dot(geometric, direction) > 0.0f;
    float side = point->backface ? -1.0f : 1.0f;
    point->object_position = p;
    point->position = point->lifted = t ? transform_point(t, p) : p;
    point->facet_normal = point->normal = vec3_scale(geometric, side);
    if (normal) {
        Vec3 n = weighted(normal, &c);
        n = vec3_normalize(t ? normal_to_world(t, n) : n);
        if (vec3_dot(n, n) > 0.0f) {
            point->normal = smooth_normal(n, point->facet_normal, direction);
            Vec3 lifted = lift(position, normal, &c, p, side);
            point->lifted = t ? transform_point(t, lifted) : lifted;
        }
    }
    point->geometric_normal = point->normal;
    if (diced) {
        undisplaced(diced, &c, side, point);
    }
    if (mesh->uv) {
        point->uv = accel_uv(mesh, &c);
        point->has_uv = true;
    }
    if (!mesh->uv || !uv_tangents(mesh, &c, e1, e2, point)) {
        point->tangent_u = e1;
        point->tangent_v = e2;
    }
    if (t) {
        point->tangent_u = transform_vector(t, point->tangent_u);
        point->tangent_v = transform_vector(t, point->tangent_v);
    }
    add_attributes(mesh, &c, point);
    const Mesh *given = at->own->part->mesh; // NULL of what is skinned around curves
    point->strata = given ? given->strata : NULL;
    point->waves = given ? given->waves : NULL;
    point->epsilon = 4e-6f * vec3_largest(point->position) + 1e-7f;
}

// Without vertex attributes the hit holds all that is needed, and no vertex is fetched from memory.
static void plain_surface(const Ray *ray, const Hit *hit, const Transform *t, SurfacePoint *point)
{
    Vec3 normal = vec3_normalize(t ? normal_to_world(t, hit->normal) : hit->normal);
    point->backface = vec3_dot(normal, ray->direction) > 0.0f;
    point->normal = point->backface ? vec3_neg(normal) : normal;
    point->facet_normal = point->geometric_normal = point->normal;
    point->position = point->lifted = vec3_madd(ray->origin, hit->t, ray->direction);
    point->object_position = point->position;
    Transform inverse;
    if (t && transform_inverse(t, &inverse)) {
        point->object_position = transform_point(&inverse, point->position);
    }
    float reach = vec3_largest(point->position);
    point->epsilon = 4e-6f * (reach > hit->t ? reach : hit->t) + 1e-7f;
}

static void curve_surface(const AccelPiece *own, const Ray *ray, const Hit *hit, const Transform *t,
                          SurfacePoint *point)
{
    plain_surface(ray, hit, t, point);
    const CurveSet *curves = own->part->curves;
    uint32_t k = own->segment[hit->primitive];
    Vec3 axis = vec3_sub(curves->position[k + 1], curves->position[k]);
    point->radius = lerpf(curves->radius[k], curves->radius[k + 1], hit->u);
    point->birth = curves->birth ? lerpf(curves->birth[k], curves->birth[k + 1], hit->u) : 0.0f;
    if (curves->along) {
        point->uv.y = lerpf(curves->along[k], curves->along[k + 1], hit->u);
    }
    point->tangent_v = vec3_normalize(t ? transform_vector(t, axis) : axis);
    point->tangent_u = vec3_cross(point->tangent_v, point->normal);
    point->epsilon *= 2.5f; // Embree meets curves less precisely than triangles
}

void accel_surface(const Accel *accel, const Ray *ray, const Hit *hit, SurfacePoint *point)
{
    PieceHit at = piece_hit(accel, hit);
    const AccelPiece *own = at.own;
    const Part *part = own->part;
    *point = (SurfacePoint){.variation = part->instance ? part_variation(part, at.instance)
                                                        : own->base_variation,
                            .season = part->season ? part->season[at.instance] : 0.0f,
                            .material = part->material,
                            .object = part->object,
                            .part = own->number};
    const Transform *t = part->instance ? &part->instance[at.instance] : NULL;
    point->transform = t;
    if (own->plain) {
        plain_surface(ray, hit, t, point);
        Vec3 n = point->normal; // any two directions in the plane
        point->tangent_u = fabsf(n.x) > 0.5f ? vec3(-n.y, n.x, 0.0f) : vec3(0.0f, -n.z, n.y);
        point->tangent_v = vec3_cross(n, point->tangent_u);
    } else if (own->mesh) {
        mesh_surface(&at, t, ray->direction, point);
    } else {
        curve_surface(own, ray, hit, t, point);
    }
}
