// Irradiance of glowing bodies and lamps against closed forms, from 0.1 m to 1 km and for sizes
// from 1 mm to 100 m: what rounding does to shadow rays shows at the ends of these ranges.
//
// What a convex body of radiance L sends to a point is L times Lambert's sum over the edges of its
// outline, cut off at the horizon (Lambert 1760; Arvo, "Analytic Methods for Simulated Light
// Transport", 1995, 3.2).
#include "tiny_world.h"

#include "mesh/curves.h"

#include "base/random.h"

#include <math.h>
#include <stdio.h>

typedef struct Point {
    double x, y, z;
} Point;

static Point point_of(Vec3 v)
{
    return (Point){(double)v.x, (double)v.y, (double)v.z};
}

static Point mad(Point a, double s, Point b)
{
    return (Point){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static Point minus(Point a, Point b)
{
    return mad(a, -1.0, b);
}

static double dot(Point a, Point b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static Point cross(Point a, Point b)
{
    return (Point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static Point unit(Point a)
{
    return mad((Point){0, 0, 0}, 1.0 / sqrt(dot(a, a)), a);
}

// ---- closed forms

enum { MOST_CORNERS = 4096 };

// What lies above the horizon y = 0; the number of corners in `kept`, which has room for one more
// than count twice over.
static int above_horizon(const Point *corner, int count, Point *kept)
{
    int n = 0;
    for (int i = 0; i < count; i++) {
        Point a = corner[i], b = corner[(i + 1) % count];
        if (a.y >= 0.0) {
            kept[n++] = a;
        }
        if ((a.y >= 0.0) != (b.y >= 0.0)) {
            kept[n++] = mad(a, a.y / (a.y - b.y), minus(b, a));
        }
    }
    return n;
}

// Irradiance at the origin of a plane facing +Y from an even radiance of 1 in a polygon.
static double polygon_irradiance(const Point *corner, int count)
{
    static Point kept[2 * MOST_CORNERS];
    int n = above_horizon(corner, count, kept);
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
        Point a = unit(kept[i]), b = unit(kept[(i + 1) % n]), across = cross(a, b);
        double sine = sqrt(dot(across, across));
        if (sine > 1e-15) {
            sum += atan2(sine, dot(a, b)) * across.y / sine;
        }
    }
    return 0.5 * fabs(sum);
}

// Directions of the outline of a ball, as points of a plane at distance 1 across `axis`.
static int ball_outline(Point center, double radius, int steps, Point *out)
{
    double distance = sqrt(dot(center, center)), sine = radius / distance;
    double cosine = sqrt(1.0 - sine * sine);
    Point axis = unit(center);
    Point side = unit(cross(axis, fabs(axis.x) < 0.5 ? (Point){1, 0, 0} : (Point){0, 0, 1}));
    Point other = cross(axis, side);
    for (int i = 0; i < steps; i++) {
        double turn = 2.0 * (double)PI_F * i / steps;
        Point d = mad((Point){0, 0, 0}, cosine, axis);
        out[i] = mad(mad(d, sine * cos(turn), side), sine * sin(turn), other);
    }
    return steps;
}

typedef struct Flat {
    double x, y;
    int from; // index into the points
} Flat;

static int by_place(const void *a, const void *b)
{
    const Flat *p = a, *q = b;
    return p->x != q->x ? (p->x < q->x ? -1 : 1) : (p->y < q->y ? -1 : p->y > q->y);
}

static double turn_of(Flat a, Flat b, Flat c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The convex outline of points about an axis (Andrew's monotone chain on their projections).
static int convex_outline(const Point *in, int count, Point axis, Point *out)
{
    static Flat flat[MOST_CORNERS], chain[2 * MOST_CORNERS];
    Point side = unit(cross(axis, fabs(axis.x) < 0.5 ? (Point){1, 0, 0} : (Point){0, 0, 1}));
    Point other = cross(axis, side);
    for (int i = 0; i < count; i++) {
        double depth = dot(in[i], axis);
        flat[i] = (Flat){dot(in[i], side) / depth, dot(in[i], other) / depth, i};
    }
    qsort(flat, (size_t)count, sizeof *flat, by_place);
    int n = 0;
    for (int pass = 0; pass < 2; pass++) {
        int begin = n;
        for (int k = 0; k < count; k++) {
            Flat next = flat[pass ? count - 1 - k : k];
            while (n >= begin + 2 && turn_of(chain[n - 2], chain[n - 1], next) <= 0.0) {
                n--;
            }
            chain[n++] = next;
        }
        n--;
    }
    for (int i = 0; i < n; i++) {
        out[i] = in[chain[i].from];
    }
    return n;
}

static double ball_irradiance(Point center, double radius)
{
    static Point outline[MOST_CORNERS];
    return polygon_irradiance(outline, ball_outline(center, radius, 2000, outline));
}

// The outline of a rod with round ends is the convex one about those of both end balls.
static double rod_irradiance(Point a, Point b, double radius)
{
    static Point both[MOST_CORNERS], outline[MOST_CORNERS];
    int n = ball_outline(a, radius, 2000, both);
    n += ball_outline(b, radius, 2000, both + n);
    Point middle = unit(mad(unit(a), 1.0, unit(b)));
    return polygon_irradiance(outline, convex_outline(both, n, middle, outline));
}

// Those of a mesh's triangles that face the point; the mesh is convex and closed, or one sheet.
static double mesh_irradiance(const Mesh *mesh, Point receiver, bool sheet)
{
    double sum = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        Point p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = minus(point_of(mesh->position[mesh->index[3 * f + k]]), receiver);
        }
        double facing = -dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), p[0]);
        sum += sheet || facing > 0.0 ? polygon_irradiance(p, 3) : 0.0;
    }
    return sum;
}

// ---- worlds

typedef enum Shape { BODY, SHEET, ROD, BALL, PANE, SHAPES } Shape;
static const char *const shape_name[] = {"octahedron", "triangle", "curve", "sphere", "quad"};

static Mesh *octahedron(Vec3 center, float radius)
{
    static const uint32_t index[] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                     2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    static const Vec3 corner[] = {{1, 0, 0}, {-1, 0, 0}, {0, 0, -1},
                                  {0, 0, 1}, {0, 1, 0},  {0, -1, 0}};
    Mesh *mesh = mesh_new(3, 6, 8, 0, NULL);
    assert_non_null(mesh);
    memcpy(mesh->index, index, sizeof index);
    for (int i = 0; i < 6; i++) {
        mesh->position[i] = vec3_madd(center, radius, corner[i]);
    }
    return mesh;
}

static Mesh *one_triangle(Vec3 center, float size)
{
    Mesh *mesh = mesh_new(3, 3, 1, 0, NULL);
    assert_non_null(mesh);
    memcpy(mesh->index, (uint32_t[]){0, 1, 2}, 12);
    mesh->position[0] = vec3_add(center, vec3(-0.5f * size, 0.0f, -0.3f * size));
    mesh->position[1] = vec3_add(center, vec3(0.5f * size, 0.1f * size, -0.3f * size));
    mesh->position[2] = vec3_add(center, vec3(0.0f, 0.0f, 0.6f * size));
    return mesh;
}

// A small patch of floor at `at`, white, seen straight from above.
static World *floor_world(Vec3 at, int samples)
{
    World *world = tiny_world(4, 4, samples, 1.0f);
    world->render.max_depth = 1;
    world->camera = (Camera){
        .position = vec3_add(at, vec3(0, 0.02f, 0)), .target = at, .up = {0, 0, 1}, .fov = 0.5f};
    add_mesh(world,
             quad_mesh(vec3_add(at, vec3(-0.01f, 0, 0.01f)), vec3(0.02f, 0, 0), vec3(0, 0, -0.02f)),
             0, 0);
    world->material[1] = material_default(MATERIAL_EMISSION);
    world->material[1].radiance = vec3_splat(1.0f);
    world->material_count = 2;
    return world;
}

// Puts a shape of `size` there; returns the irradiance that it gives to `at`.
static double add_shape(World *world, Shape shape, Vec3 center, float size, Vec3 at)
{
    Point to = minus(point_of(center), point_of(at));
    float radius = 0.5f * size;
    switch (shape) {
    case BODY:
    case SHEET: {
        Mesh *mesh = shape == BODY ? octahedron(center, radius) : one_triangle(center, size);
        add_mesh(world, mesh, 1, 1);
        return mesh_irradiance(mesh, point_of(at), shape == SHEET);
    }
    case ROD: {
        CurveSet *rod = curves_new(2, 1, NULL);
        assert_non_null(rod);
        rod->position[0] = vec3_sub(center, vec3(0.4f * size, 0.1f * size, 0.2f * size));
        rod->position[1] = vec3_add(center, vec3(0.4f * size, 0.1f * size, 0.2f * size));
        rod->radius[0] = rod->radius[1] = 0.05f * size;
        rod->first[1] = 2;
        add_part(world, (Part){.kind = PART_CURVES, .curves = rod, .material = 1});
        return rod_irradiance(minus(point_of(rod->position[0]), point_of(at)),
                              minus(point_of(rod->position[1]), point_of(at)),
                              (double)rod->radius[0]);
    }
    case BALL:
        add_light(world, (Light){.kind = LIGHT_SPHERE,
                                 .radiance = {1, 1, 1},
                                 .center = center,
                                 .radius = radius});
        return ball_irradiance(to, (double)radius);
    case PANE: {
        Light pane = {.kind = LIGHT_QUAD,
                      .radiance = {1, 1, 1},
                      .corner = vec3_sub(center, vec3(radius, 0, radius)),
                      .edge_u = {size, 0, 0},
                      .edge_v = {0, 0, size}};
        add_light(world, pane);
        Point corner = minus(point_of(pane.corner), point_of(at)), u = point_of(pane.edge_u),
              v = point_of(pane.edge_v);
        Point p[4] = {corner, mad(corner, 1, u), mad(mad(corner, 1, u), 1, v), mad(corner, 1, v)};
        return polygon_irradiance(p, 4);
    }
    case SHAPES:
        break;
    }
    return 0.0;
}

// Makes what glows so bright that the floor's irradiance is about 1: a film counts in quanta of
// 2^-28, which is more than what a body of 1 mm sends 1 km far at a radiance of 1.
static void brighten(World *world, double *irradiance)
{
    float factor = (float)(1.0 / *irradiance);
    world->material[1].radiance = vec3_scale(world->material[1].radiance, factor);
    for (int i = 0; i < world->light_count; i++) {
        world->light[i].radiance = vec3_scale(world->light[i].radiance, factor);
    }
    *irradiance *= (double)factor;
}

// The radiance of a white floor is its irradiance over pi.
static void expect_irradiance(World *world, double wanted, double tolerance, const char *what)
{
    Film *film = trace(world, 2, NULL);
    double got = mean_luminance(film) * (double)PI_F, error = 3.0 * mean_error(film) * (double)PI_F;
    if (!(fabs(got - wanted) <= tolerance * wanted + error)) {
        fail_msg("%s: %.4g times the closed form (noise %.2g)", what, got / wanted,
                 error / 3.0 / wanted);
    }
    assert_true(error < 0.1 * wanted);
    film_free(film);
}

static void every_size_from_every_distance(void **state)
{
    (void)state;
    static const float size[] = {1e-3f, 0.04f, 1.0f, 100.0f};
    static const float distance[] = {0.1f, 1.0f, 10.0f, 1000.0f};
    for (int i = 0; i < (int)SHAPES * 4 * 4 * 2; i++) {
        Shape shape = (Shape)(i % (int)SHAPES);
        int far = i / (int)SHAPES;
        float s = size[far % 4], d = distance[far / 4 % 4];
        // from the surface of what is near; the floor or the emitter is at the origin
        Vec3 away = vec3_scale(vec3(0.36f, 0.8f, 0.48f), d + 0.5f * s);
        Vec3 at = far / 16 ? vec3_neg(away) : vec3_splat(0.0f);
        World *world = floor_world(at, s > d ? 512 : 64); // what is near is met by chance
        double wanted = add_shape(world, shape, vec3_add(at, away), s, at);
        char what[120];
        snprintf(what, sizeof what, "%s of %g m at %g m, %s at the origin", shape_name[shape],
                 (double)s, (double)d, far / 16 ? "emitter" : "floor");
        brighten(world, &wanted);
        expect_irradiance(world, wanted, 0.01, what);
        world_free(world);
    }
}

// Many small lamps: of each the outside is seen, and no inside through it.
static void many_small_bodies(void **state)
{
    (void)state;
    enum { LAMPS = 400 };
    World *world = floor_world(vec3_splat(0.0f), 1024);
    double wanted = 0.0;
    for (int i = 0; i < LAMPS; i++) {
        uint64_t key = random_key(3, (uint64_t)i);
        Vec3 place =
            vec3(random_range(random_key(key, 0), -12, 12), random_range(random_key(key, 1), 1, 8),
                 random_range(random_key(key, 2), -12, 12));
        wanted += add_shape(world, BODY, place, 0.04f, vec3_splat(0.0f));
    }
    expect_irradiance(world, wanted, 0.01, "400 octahedra");
    world_free(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_size_from_every_distance),
        cmocka_unit_test(many_small_bodies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
