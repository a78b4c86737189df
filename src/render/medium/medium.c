#include "render/medium/medium.h"

#include "render/warp.h"

Medium medium_default(MediumKind kind)
{
    switch (kind) {
    case MEDIUM_WATER: // clear sea: pure water's absorption near 610, 550 and 450 nm, some plankton
        return (Medium){.kind = kind,
                        .scattering = {0.030f, 0.036f, 0.042f},
                        .absorption = {0.270f, 0.062f, 0.030f},
                        .anisotropy = 0.8f,
                        .caustics = 1.0f};
    case MEDIUM_LAYER: // fog to see 100 m through
        return (Medium){
            .kind = kind, .scattering = vec3_splat(0.03f), .anisotropy = 0.7f, .falloff = 20.0f};
    case MEDIUM_EVERYWHERE: // haze to see 1 km through
    case MEDIUM_NONE:
        break;
    }
    return (Medium){.kind = kind, .scattering = vec3_splat(0.003f), .anisotropy = 0.6f};
}

Filling filling_of(Vec3 scattering, Vec3 absorption, float anisotropy)
{
    Vec3 sum = vec3_add(scattering, absorption);
    return (Filling){.extinction = sum,
                     .scattering = scattering,
                     .anisotropy = anisotropy,
                     .present = sum.x + sum.y + sum.z > 0.0f,
                     .scatters = scattering.x + scattering.y + scattering.z > 0.0f};
}

// ---- pieces

static float piece_length(const MediumPiece *p, float t)
{
    float step = t - p->near, fall = p->rate * step;
    if (!(step > 0.0f)) {
        return 0.0f;
    }
    float length = p->rate == 0.0f || fabsf(fall) < 1e-4f ? p->rho0 * step * (1.0f - 0.5f * fall)
                                                          : p->rho0 * -expm1f(-fall) / p->rate;
    return fminf(length, (float)MEDIUM_LONGEST);
}

static void add_piece(MediumLine *line, float near, float far, float rho0, float rate)
{
    if (far > near) {
        MediumPiece *p = &line->piece[line->count++];
        *p = (MediumPiece){near, fminf(far, (float)MEDIUM_LONGEST), rho0, rate, 0.0f};
        p->length = piece_length(p, p->far);
        line->length = fminf(line->length + p->length, (float)MEDIUM_LONGEST);
    }
}

MediumLine medium_line_inside(float far)
{
    MediumLine line = {.count = 0};
    add_piece(&line, 0.0f, far, 1.0f, 0.0f);
    return line;
}

static void add_ball(MediumLine *line, Vec3 center, float radius, Vec3 origin, Vec3 direction,
                     float far)
{
    Vec3 to = vec3_sub(center, origin);
    float middle = vec3_dot(to, direction);
    float half = radius * radius - vec3_dot(to, to) + middle * middle;
    if (half > 0.0f) {
        half = sqrtf(half);
        add_piece(line, fmaxf(middle - half, 0.0f), fminf(middle + half, far), 1.0f, 0.0f);
    }
}

// height: of the origin above the layer; rise: of the ray per metre.
static void add_layer(MediumLine *line, float height, float rise, float falloff, float far)
{
    const float highest = 60.0f * falloff; // nothing above that
    float start = 0.0f;
    if (height > highest) {
        if (rise >= 0.0f) {
            return;
        }
        start = (height - highest) / -rise;
    }
    float border = rise != 0.0f ? -height / rise : (height < 0.0f ? INFINITY : 0.0f);
    float rate = rise / falloff, above = expf(-clampf(height, 0.0f, highest) / falloff);
    if (height <= 0.0f) { // starts below: homogeneous up to the border, then thinning
        border = border >= 0.0f ? border : INFINITY;
        add_piece(line, 0.0f, fminf(border, far), 1.0f, 0.0f);
        add_piece(line, border, far, 1.0f, rate);
    } else { // starts above: down to the border if the ray meets it
        border = border > 0.0f ? border : INFINITY;
        add_piece(line, start, fminf(border, far), above, rate);
        add_piece(line, border, far, 1.0f, 0.0f);
    }
}

MediumLine medium_line(const Medium *m, Vec3 center, float radius, Vec3 origin, Vec3 direction,
                       float far)
{
    MediumLine line = {.count = 0};
    float height = origin.y - m->height, rise = direction.y;
    switch (m->kind) {
    case MEDIUM_NONE:
        break;
    case MEDIUM_EVERYWHERE:
        add_ball(&line, center, radius, origin, direction, far);
        break;
    case MEDIUM_WATER:
        if (height < 0.0f) {
            add_piece(&line, 0.0f, rise > 0.0f ? fminf(far, -height / rise) : far, 1.0f, 0.0f);
        } else if (rise < 0.0f) {
            add_piece(&line, -height / rise, far, 1.0f, 0.0f);
        }
        break;
    case MEDIUM_LAYER:
        add_layer(&line, height, rise, fmaxf(m->falloff, 1e-3f), far);
        break;
    }
    return line;
}

float medium_line_near(const MediumLine *line)
{
    return line->piece[0].near;
}

float medium_line_far(const MediumLine *line)
{
    return line->piece[line->count - 1].far;
}

float medium_line_length(const MediumLine *line, float t)
{
    float sum = 0.0f;
    for (int i = 0; i < line->count; i++) {
        const MediumPiece *p = &line->piece[i];
        sum += t >= p->far ? p->length : piece_length(p, t);
    }
    return sum;
}

float medium_line_density(const MediumLine *line, float t)
{
    for (int i = 0; i < line->count; i++) {
        const MediumPiece *p = &line->piece[i];
        if (t >= p->near && t <= p->far) {
            return p->rho0 * (p->rate == 0.0f ? 1.0f : expf(-p->rate * (t - p->near)));
        }
    }
    return 0.0f;
}

float medium_line_at(const MediumLine *line, float length)
{
    for (int i = 0; i < line->count; i++) {
        const MediumPiece *p = &line->piece[i];
        if (length < p->length) {
            float even = length / p->rho0, fall = even * p->rate;
            float step = p->rate == 0.0f || fabsf(fall) < 1e-4f ? even * (1.0f + 0.5f * fall)
                                                                : -log1pf(-fall) / p->rate;
            return p->near + clampf(step, 0.0f, p->far - p->near);
        }
        length -= p->length;
    }
    return medium_line_far(line);
}

// ---- lengths

Vec3 medium_transmittance(Vec3 extinction, float length)
{
    return vec3(expf(-extinction.x * length), expf(-extinction.y * length),
                expf(-extinction.z * length));
}

static float chosen(Vec3 extinction, Vec3 weight, float choice)
{
    if (choice < weight.x) {
        return extinction.x;
    }
    return choice < weight.x + weight.y ? extinction.y : extinction.z;
}

float medium_draw_length(Vec3 extinction, Vec3 weight, float longest, float choice, float u,
                         float *pdf)
{
    float rate = chosen(extinction, weight, choice);
    float length = rate > 0.0f ? -logf(1.0f - u) / rate : longest;
    bool through = length >= longest;
    Vec3 rest = medium_transmittance(extinction, through ? longest : length);
    *pdf = through ? vec3_dot(weight, rest) : vec3_dot(weight, vec3_mul(extinction, rest));
    return length;
}

float medium_draw_within(Vec3 extinction, Vec3 weight, float longest, float choice, float u)
{
    float rate = chosen(extinction, weight, choice), depth = rate * longest;
    if (depth < 1e-4f) {
        return u * longest;
    }
    return fminf(-log1pf(u * expm1f(-depth)) / rate, longest);
}

static float density_within(float rate, float longest, float length)
{
    float depth = rate * longest;
    return depth < 1e-4f ? 1.0f / longest : rate * expf(-rate * length) / -expm1f(-depth);
}

float medium_density_within(Vec3 extinction, Vec3 weight, float longest, float length)
{
    return weight.x * density_within(extinction.x, longest, length) +
           weight.y * density_within(extinction.y, longest, length) +
           weight.z * density_within(extinction.z, longest, length);
}

// ---- the phase function

float phase_density(float g, float cosine)
{
    float d = fmaxf(1.0f + g * g - 2.0f * g * cosine, 1e-6f);
    return (1.0f - g * g) / (4.0f * PI_F * d * sqrtf(d));
}

Vec3 phase_draw(float g, Vec3 direction, float u, float v)
{
    float cosine = 1.0f - 2.0f * u;
    if (fabsf(g) > 1e-3f) {
        float s = (1.0f - g * g) / (1.0f + g * cosine);
        cosine = clampf((1.0f + g * g - s * s) / (2.0f * g), -1.0f, 1.0f);
    }
    return warp_cone(direction, cosine, sqrtf(fmaxf(0.0f, 1.0f - cosine * cosine)), v);
}
