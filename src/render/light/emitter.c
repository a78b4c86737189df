#include "render/light/emitter.h"

#include "render/warp.h"

// Cosine below which a surface counts as seen edge-on: there, rounding decides whether it faces the
// point.
static const float LEAST_COSINE = 1e-6f;

Emitter emitter_triangle(Vec3 a, Vec3 b, Vec3 c, bool two_sided, int part)
{
    return (Emitter){.kind = EMITTER_TRIANGLE,
                     .two_sided = two_sided,
                     .part = part,
                     .a = a,
                     .b = vec3_sub(b, a),
                     .c = vec3_sub(c, a),
                     .glow0 = 1.0f,
                     .glow1 = 1.0f};
}

// The tangent cone touches a ball of radius r in a circle of radius r cos t, displaced by r sin t,
// where sin t is the difference of the radii over the distance.
Emitter emitter_cone(Vec3 from, Vec3 to, float radius0, float radius1, float glow0, float glow1,
                     int part)
{
    Emitter e = {.kind = EMITTER_CONE, .part = part, .a = from, .glow0 = glow0, .glow1 = glow1};
    Vec3 between = vec3_sub(to, from);
    float length = vec3_length(between);
    if (!(length > fabsf(radius0 - radius1) * 1.0001f)) {
        return e;
    }
    Vec3 axis = vec3_scale(between, 1.0f / length);
    e.tilt = (radius0 - radius1) / length;
    float cosine = sqrtf(1.0f - e.tilt * e.tilt);
    e.radius0 = radius0 * cosine;
    e.radius1 = radius1 * cosine;
    e.a = vec3_madd(from, radius0 * e.tilt, axis);
    e.b = vec3_scale(axis, length * cosine * cosine);
    return e;
}

Emitter emitter_cap(Vec3 center, float radius, Vec3 axis, float glow, int part)
{
    return (Emitter){.kind = EMITTER_CAP,
                     .part = part,
                     .a = center,
                     .b = axis,
                     .radius0 = radius,
                     .glow0 = glow,
                     .glow1 = glow};
}

// ---- the side of a cone: a place along the axis, then an angle on the side that is seen

typedef struct Cone {
    Vec3 axis;
    float length, slant; // along the axis; along the side
    float cosine;        // of the lean of its normals
} Cone;

static inline Cone cone_of(const Emitter *e)
{
    float length = vec3_length(e->b), cosine = sqrtf(1.0f - e->tilt * e->tilt);
    return (Cone){vec3_scale(e->b, 1.0f / fmaxf(length, 1e-20f)), length, length / cosine, cosine};
}

// Positions along the axis, density with respect to its share s: uniform from afar, by equal angles
// from near (Kulla and Fajardo 2012).
typedef struct AxisView {
    bool even;
    float foot, distance; // of the point that sees it
    float angle0, angle1;
} AxisView;

static AxisView axis_view(const Emitter *e, const Cone *cone, Vec3 from)
{
    Vec3 to = vec3_sub(from, e->a);
    AxisView view = {.foot = vec3_dot(to, cone->axis)};
    float square = vec3_dot(to, to);
    view.even = cone->length * cone->length < 0.04f * square;
    if (!view.even) {
        float width = fmaxf(e->radius0, e->radius1);
        float aside = fmaxf(square - view.foot * view.foot, width * width);
        view.distance = sqrtf(fmaxf(aside, 1e-6f * cone->length * cone->length));
        view.angle0 = atanf(-view.foot / view.distance);
        view.angle1 = atanf((cone->length - view.foot) / view.distance);
    }
    return view;
}

static float axis_draw(const AxisView *view, const Cone *cone, float u)
{
    if (view->even) {
        return u;
    }
    float t = view->foot + view->distance * tanf(lerpf(view->angle0, view->angle1, u));
    return clampf(t / cone->length, 0.0f, 1.0f);
}

static float axis_density(const AxisView *view, const Cone *cone, float s)
{
    if (view->even) {
        return 1.0f;
    }
    float off = s * cone->length - view->foot;
    return cone->length * view->distance /
           ((view->angle1 - view->angle0) * (view->distance * view->distance + off * off));
}

// The circle at s as seen from a point: its visible points lie within an angle of `toward`.
typedef struct Rim {
    Vec3 center, toward, aside; // unit vectors across the axis
    float radius;
    float most;     // that angle
    float sin_most; // > 0: drawn by its cosine; 0: evenly
} Rim;

static bool rim_at(const Emitter *e, const Cone *cone, Vec3 from, float s, Rim *rim)
{
    rim->center = vec3_madd(e->a, s, e->b);
    rim->radius = lerpf(e->radius0, e->radius1, s);
    Vec3 to = vec3_sub(from, rim->center);
    float along = vec3_dot(to, cone->axis);
    Vec3 across = vec3_madd(to, -along, cone->axis);
    float width = vec3_length(across);
    if (!(width > 0.0f) || !(rim->radius > 0.0f)) {
        return false;
    }
    rim->toward = vec3_scale(across, 1.0f / width);
    rim->aside = vec3_cross(cone->axis, rim->toward);
    float least = (rim->radius - along * e->tilt / cone->cosine) / width; // cosine of `most`
    if (least >= 1.0f) {
        return false;
    }
    rim->most = acosf(fmaxf(least, -1.0f));
    rim->sin_most = least > 0.0f ? sqrtf(1.0f - least * least) : 0.0f;
    return true;
}

static inline float rim_density(const Rim *rim, float cosine)
{
    return rim->sin_most > 0.0f ? fmaxf(cosine, 0.0f) / (2.0f * rim->sin_most)
                                : 1.0f / (2.0f * rim->most);
}

// Density per steradian of a position drawn with a density per area. The cosine at the emitter is
// positive but for rounding, which must not discard a hit.
static float steradian_density(float area_density, Vec3 normal, Vec3 to)
{
    float distance = vec3_length(to);
    float cosine = fmaxf(vec3_dot(normal, to), LEAST_COSINE * distance) / distance;
    return area_density * distance * distance / cosine;
}

// Density per steradian of the point of the rim in the direction (cosine, sine) from `toward`.
static float cone_pdf_at(const Emitter *e, const Cone *cone, const Rim *rim, Vec3 from,
                         float cosine, float sine, float density_along, EmitterSample *at)
{
    Vec3 out = vec3_madd(vec3_scale(rim->toward, cosine), sine, rim->aside);
    at->position = vec3_madd(rim->center, rim->radius, out);
    at->normal = vec3_madd(vec3_scale(out, cone->cosine), e->tilt, cone->axis);
    float area_density = density_along * rim_density(rim, cosine) / (rim->radius * cone->slant);
    return steradian_density(area_density, at->normal, vec3_sub(from, at->position));
}

static bool cone_sample(const Emitter *e, Vec3 from, const float u[2], bool pivoted,
                        EmitterSample *sample)
{
    Cone cone = cone_of(e);
    if (!(cone.length > 0.0f)) {
        return false;
    }
    AxisView view = axis_view(e, &cone, from);
    float s = pivoted ? u[0] : axis_draw(&view, &cone, u[0]);
    float density_along = axis_density(&view, &cone, s);
    Rim rim;
    if (!rim_at(e, &cone, from, s, &rim)) {
        return false;
    }
    float sine, cosine;
    if (rim.sin_most > 0.0f) {
        sine = (2.0f * u[1] - 1.0f) * rim.sin_most;
        cosine = sqrtf(fmaxf(0.0f, 1.0f - sine * sine));
    } else {
        float angle = (2.0f * u[1] - 1.0f) * rim.most;
        sine = sinf(angle);
        cosine = cosf(angle);
    }
    sample->glow = lerpf(e->glow0, e->glow1, s);
    sample->pivot = rim.center;
    sample->pivot_ratio = 1.0f / density_along;
    sample->pdf = cone_pdf_at(e, &cone, &rim, from, cosine, sine, density_along, sample);
    return true;
}

static float cone_pdf(const Emitter *e, Vec3 from, Vec3 position)
{
    Cone cone = cone_of(e);
    if (!(cone.length > 0.0f)) {
        return 0.0f;
    }
    AxisView view = axis_view(e, &cone, from);
    float s = clampf(vec3_dot(vec3_sub(position, e->a), cone.axis) / cone.length, 0.0f, 1.0f);
    Rim rim;
    if (!rim_at(e, &cone, from, s, &rim)) {
        return 0.0f;
    }
    Vec3 out = vec3_sub(position, rim.center);
    float x = vec3_dot(out, rim.toward), y = vec3_dot(out, rim.aside);
    float length = fmaxf(sqrtf(x * x + y * y), 1e-20f);
    float cosine = fmaxf(x / length, cosf(rim.most) + LEAST_COSINE);
    EmitterSample ideal;
    return cone_pdf_at(e, &cone, &rim, from, cosine, y / length, axis_density(&view, &cone, s),
                       &ideal);
}

// Outside the ball around the nearest position on the axis?
static bool cone_faces(const Emitter *e, Vec3 from)
{
    Cone cone = cone_of(e);
    float foot = vec3_dot(vec3_sub(from, e->a), cone.axis);
    float s = cone.length > 0.0f ? clampf(foot / cone.length, 0.0f, 1.0f) : 0.0f;
    float radius = lerpf(e->radius0, e->radius1, s);
    return vec3_distance(from, vec3_madd(e->a, s, e->b)) > radius;
}

// ---- triangles and caps: even over the area

static float triangle_pdf(const Emitter *e, Vec3 from, Vec3 position, Vec3 *normal)
{
    Vec3 across = vec3_cross(e->b, e->c), to = vec3_sub(from, position);
    float area = 0.5f * vec3_length(across);
    *normal = vec3_scale(across, 0.5f / area);
    if (e->two_sided && vec3_dot(*normal, to) < 0.0f) {
        *normal = vec3_neg(*normal);
    }
    return steradian_density(1.0f / area, *normal, to);
}

static Vec3 triangle_point(const Emitter *e, const float u[2])
{
    float root = sqrtf(u[0]);
    return vec3_madd(vec3_madd(e->a, root * (1.0f - u[1]), e->b), root * u[1], e->c);
}

static float cap_pdf(const Emitter *e, Vec3 from, Vec3 position, Vec3 *normal)
{
    float area = 2.0f * PI_F * e->radius0 * e->radius0;
    *normal = vec3_normalize(vec3_sub(position, e->a));
    return steradian_density(1.0f / area, *normal, vec3_sub(from, position));
}

static Vec3 cap_point(const Emitter *e, const float u[2])
{
    float sine = sqrtf(fmaxf(0.0f, 1.0f - u[0] * u[0]));
    return vec3_madd(e->a, e->radius0, warp_cone(e->b, u[0], sine, u[1]));
}

// ---- all of them

bool emitter_faces(const Emitter *emitter, Vec3 from)
{
    switch (emitter->kind) {
    case EMITTER_TRIANGLE:
        return emitter->two_sided ||
               vec3_dot(vec3_cross(emitter->b, emitter->c), vec3_sub(from, emitter->a)) > 0.0f;
    case EMITTER_CONE:
        return cone_faces(emitter, from);
    case EMITTER_CAP:
        break;
    }
    return vec3_distance(from, emitter->a) > emitter->radius0;
}

// Neighbouring segments overlap at bends by about a radius. Embree 3.13 lengthens segments of a
// millimetre or less by some radii at their first point (by 1e-7 m^2 over the length).
static float slack_of(const Emitter *e)
{
    switch (e->kind) {
    case EMITTER_TRIANGLE:
        return 0.0f;
    case EMITTER_CONE:
        return fmaxf(e->radius0, e->radius1);
    case EMITTER_CAP:
        break;
    }
    return 3.0f * e->radius0;
}

static bool sample_emitter(const Emitter *e, Vec3 from, const float u[2], bool pivoted,
                           EmitterSample *sample)
{
    if (!emitter_faces(e, from)) {
        return false;
    }
    if (e->kind == EMITTER_CONE) {
        if (!cone_sample(e, from, u, pivoted, sample)) {
            return false;
        }
    } else {
        bool triangle = e->kind == EMITTER_TRIANGLE;
        sample->position = triangle ? triangle_point(e, u) : cap_point(e, u);
        sample->pdf = triangle ? triangle_pdf(e, from, sample->position, &sample->normal)
                               : cap_pdf(e, from, sample->position, &sample->normal);
        sample->pivot = sample->position;
        sample->glow = e->glow0;
        sample->pivot_ratio = 1.0f;
    }
    Vec3 to = vec3_sub(sample->position, from);
    sample->distance = vec3_length(to);
    sample->direction = vec3_scale(to, 1.0f / sample->distance);
    sample->extent = e->kind == EMITTER_CAP ? e->radius0 : vec3_length(e->b);
    sample->extent += e->kind == EMITTER_TRIANGLE ? vec3_length(e->c) : 0.0f;
    sample->slack = slack_of(e);
    bool seen = vec3_dot(sample->normal, to) < 0.0f; // else its back
    return seen && sample->pdf > 0.0f && isfinite(sample->pdf);
}

bool emitter_sample(const Emitter *emitter, Vec3 from, const float u[2], EmitterSample *sample)
{
    return sample_emitter(emitter, from, u, false, sample);
}

Vec3 emitter_pivot(const Emitter *emitter, const float u[2])
{
    switch (emitter->kind) {
    case EMITTER_TRIANGLE:
        return triangle_point(emitter, u);
    case EMITTER_CONE:
        return vec3_madd(emitter->a, u[0], emitter->b);
    case EMITTER_CAP:
        break;
    }
    return cap_point(emitter, u);
}

bool emitter_sample_pivoted(const Emitter *emitter, Vec3 from, const float u[2],
                            EmitterSample *sample)
{
    return sample_emitter(emitter, from, u, true, sample);
}

float emitter_pdf(const Emitter *emitter, Vec3 from, Vec3 position)
{
    Vec3 normal;
    switch (emitter->kind) {
    case EMITTER_TRIANGLE:
        return triangle_pdf(emitter, from, position, &normal);
    case EMITTER_CONE:
        return cone_pdf(emitter, from, position);
    case EMITTER_CAP:
        break;
    }
    return cap_pdf(emitter, from, position, &normal);
}

static EmissionSpot cone_emit(const Emitter *e, const float u[2])
{
    Cone cone = cone_of(e);
    Vec3 beside = fabsf(cone.axis.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
    Vec3 across = vec3_normalize(vec3_cross(cone.axis, beside));
    Vec3 aside = vec3_cross(cone.axis, across);
    float sine, cosine, radius = lerpf(e->radius0, e->radius1, u[0]);
    sincos_turn(u[1], &sine, &cosine);
    Vec3 out = vec3_madd(vec3_scale(across, cosine), sine, aside);
    return (EmissionSpot){
        .position = vec3_madd(vec3_madd(e->a, u[0], e->b), radius, out),
        .normal = vec3_madd(vec3_scale(out, cone.cosine), e->tilt, cone.axis),
        .extent = cone.length,
        .glow = lerpf(e->glow0, e->glow1, u[0]),
        .area = cone.length > 0.0f ? 2.0f * PI_F * radius * cone.slant : 0.0f,
    };
}

static EmissionSpot triangle_emit(const Emitter *e, const float u[2], float side)
{
    Vec3 across = vec3_cross(e->b, e->c), normal = vec3_normalize(across);
    float sides = e->two_sided ? 2.0f : 1.0f;
    return (EmissionSpot){
        .position = triangle_point(e, u),
        .normal = e->two_sided && side < 0.5f ? vec3_neg(normal) : normal,
        .extent = vec3_length(e->b) + vec3_length(e->c),
        .glow = 1.0f,
        .area = sides * 0.5f * vec3_length(across),
    };
}

EmissionSpot emitter_emit(const Emitter *emitter, const float u[2], float side)
{
    switch (emitter->kind) {
    case EMITTER_TRIANGLE:
        return triangle_emit(emitter, u, side);
    case EMITTER_CONE:
        return cone_emit(emitter, u);
    case EMITTER_CAP:
        break;
    }
    Vec3 place = cap_point(emitter, u);
    return (EmissionSpot){place, vec3_normalize(vec3_sub(place, emitter->a)), emitter->radius0,
                          emitter->glow0, 2.0f * PI_F * emitter->radius0 * emitter->radius0};
}

static LightBounds triangle_bounds(const Emitter *e, float luminance)
{
    Vec3 across = vec3_cross(e->b, e->c);
    float area = 0.5f * vec3_length(across);
    Aabb box = aabb_add(aabb_empty(), e->a);
    box = aabb_add(aabb_add(box, vec3_add(e->a, e->b)), vec3_add(e->a, e->c));
    return (LightBounds){.box = box,
                         .axis = vec3_normalize(across),
                         .cos_normal = 1.0f,
                         .power = (e->two_sided ? 2.0f : 1.0f) * PI_F * area * luminance,
                         .two_sided = e->two_sided};
}

LightBounds emitter_bounds(const Emitter *e, float luminance)
{
    if (e->kind == EMITTER_TRIANGLE) {
        return triangle_bounds(e, luminance);
    }
    bool cone = e->kind == EMITTER_CONE;
    Vec3 wide0 = vec3_splat(e->radius0), wide1 = vec3_splat(e->radius1);
    Aabb box = {vec3_sub(e->a, wide0), vec3_add(e->a, wide0)};
    float area = 2.0f * PI_F * e->radius0 * e->radius0;
    if (cone) {
        Vec3 end = vec3_add(e->a, e->b);
        box = aabb_union(box, (Aabb){vec3_sub(end, wide1), vec3_add(end, wide1)});
        area = PI_F * (e->radius0 + e->radius1) * cone_of(e).slant;
    }
    return (LightBounds){.box = box,
                         .axis = cone ? vec3(0.0f, 1.0f, 0.0f) : e->b,
                         .cos_normal = cone ? -1.0f : 0.0f,
                         .power = PI_F * area * 0.5f * (e->glow0 + e->glow1) * luminance};
}
