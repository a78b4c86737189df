#include "render/material/bsdf_ggx.h"

#include "render/warp.h"

#include <string.h>

// wo as the facets of a hemisphere see it.
static Vec3 standard_direction(Vec3 wo, float alpha)
{
    return vec3_normalize(vec3(alpha * wo.x, alpha * wo.y, wo.z));
}

// s, c: sine and cosine of the azimuth that is drawn.
static inline Vec3 normal_about(Vec3 standard, float alpha, float s, float c, float u1)
{
    float z = 1.0f - u1 * (1.0f + standard.z);
    float r = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    Vec3 h = vec3_add(vec3(r * c, r * s, z), standard);
    h = vec3_normalize(vec3(alpha * h.x, alpha * h.y, fmaxf(h.z, 0.0f)));
    return h.z > 0.0f ? h : vec3(0.0f, 0.0f, 1.0f);
}

Vec3 ggx_draw_normal(Vec3 wo, float alpha, float u0, float u1)
{
    float s, c;
    sincos_turn(u0, &s, &c);
    return normal_about(standard_direction(wo, alpha), alpha, s, c, u1);
}

float fresnel_dielectric(float cosine, float eta, float *cosine_t)
{
    float sine2_t = (1.0f - cosine * cosine) / (eta * eta);
    if (sine2_t >= 1.0f) {
        if (cosine_t) {
            *cosine_t = 0.0f;
        }
        return 1.0f;
    }
    float t = sqrtf(fmaxf(0.0f, 1.0f - sine2_t));
    float parallel = (eta * cosine - t) / (eta * cosine + t);
    float perpendicular = (cosine - eta * t) / (cosine + eta * t);
    if (cosine_t) {
        *cosine_t = t;
    }
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

float ggx_table_at(const float *nodes, float cosine)
{
    float t = sqrtf(clampf(cosine, 0.0f, 1.0f)) * (float)(GGX_NODES - 1);
    int i = (int)t;
    i = i < GGX_NODES - 2 ? i : GGX_NODES - 2;
    return lerpf(nodes[i], nodes[i + 1], t - (float)i);
}

// 2 times the integral of nodes(mu) mu over mu in 0..1, of the interpolated table, so that the
// compensation adds exactly the missing energy.
static float table_mean(const float *nodes)
{
    const int steps = 64 * (GGX_NODES - 1);
    double sum = 0.0;
    for (int i = 0; i < steps; i++) { // midpoint rule in t = sqrt(mu): mu dmu = 2 t^3 dt
        double t = (i + 0.5) / steps;
        sum += (double)ggx_table_at(nodes, (float)(t * t)) * 4.0 * t * t * t / steps;
    }
    return (float)sum;
}

enum { DRAWS = 1597 }; // the quadrature over facet normals: a Fibonacci lattice

// Single scattering from the direction of one node: the share that leaves toward each node, for one
// side of the surface and then the other.
typedef struct Scattering {
    int count; // GGX_NODES or twice that
    float to[2 * GGX_NODES][2 * GGX_NODES];
} Scattering;

static Vec3 node_direction(int node)
{
    float t = (float)node / (float)(GGX_NODES - 1);
    float cosine = fmaxf(t * t, 1e-4f);
    return vec3(sqrtf(fmaxf(0.0f, 1.0f - cosine * cosine)), 0.0f, cosine);
}

// Splits a weight between the two nodes around a cosine, as the interpolation reads them.
static void deposit(float *row, float cosine, float weight)
{
    float t = sqrtf(clampf(cosine, 0.0f, 1.0f)) * (float)(GGX_NODES - 1);
    int i = (int)t;
    i = i < GGX_NODES - 2 ? i : GGX_NODES - 2;
    row[i] += weight * (1.0f - (t - (float)i));
    row[i + 1] += weight * (t - (float)i);
}

// G2 / G1: the share of a drawn direction that shadowing leaves.
static float shadowing(float alpha, Vec3 wo, Vec3 wi)
{
    float lambda_o = ggx_lambda(alpha, wo.z);
    float lambda_i = ggx_lambda(alpha, fmaxf(fabsf(wi.z), 1e-6f));
    return (1.0f + lambda_o) / (1.0f + lambda_o + lambda_i);
}

// Sines and cosines of the azimuths of the quadrature: the same for all nodes.
typedef struct Azimuths {
    float sine[DRAWS], cosine[DRAWS];
} Azimuths;

static void find_azimuths(Azimuths *azimuths)
{
    for (int k = 0; k < DRAWS; k++) {
        // half a turn: the lobe is symmetric about the plane of wo
        float u0 = 0.5f * ((float)(k * 987 % DRAWS) + 0.5f) / DRAWS;
        sincos_turn(u0, &azimuths->sine[k], &azimuths->cosine[k]);
    }
}

// standard: standard_direction of wo.
static Vec3 quadrature_normal(const Azimuths *azimuths, Vec3 standard, float alpha, int k)
{
    float u1 = ((float)k + 0.5f) / DRAWS;
    return normal_about(standard, alpha, azimuths->sine[k], azimuths->cosine[k], u1);
}

// Finds factors r with r_i sum_j to_ij r_j = 1: symmetric scaling of a matrix to unit rows
// (Sinkhorn and Knopp 1967), damped by the square root.
static void balance(const Scattering *scattering, float *factor)
{
    for (int i = 0; i < scattering->count; i++) {
        factor[i] = 1.0f;
    }
    for (int iteration = 0; iteration < 60; iteration++) {
        float next[2 * GGX_NODES] = {0};
        for (int i = 0; i < scattering->count; i++) {
            float sum = 0.0f;
            for (int j = 0; j < scattering->count; j++) {
                sum += scattering->to[i][j] * factor[j];
            }
            next[i] = clampf(sqrtf(factor[i] / fmaxf(sum, 1e-6f)), 0.1f, 20.0f);
        }
        memcpy(factor, next, (size_t)scattering->count * sizeof *factor);
    }
}

static void reflect_from_node(GgxTable *table, Scattering *scattering, const Azimuths *azimuths,
                              float alpha, int node)
{
    Vec3 wo = node_direction(node), standard = standard_direction(wo, alpha);
    float f0 = 0.0f, f90 = 0.0f;
    for (int k = 0; k < DRAWS; k++) {
        Vec3 h = quadrature_normal(azimuths, standard, alpha, k);
        float cosine = vec3_dot(wo, h);
        Vec3 wi = vec3_sub(vec3_scale(h, 2.0f * cosine), wo);
        if (wi.z > 0.0f) {
            float weight = shadowing(alpha, wo, wi) / DRAWS, s = schlick_weight(cosine);
            f0 += weight * (1.0f - s);
            f90 += weight * s;
            deposit(scattering->to[node], wi.z, weight);
        }
    }
    table->scale[node] = f0;
    table->bias[node] = f90;
}

void ggx_table_reflection(GgxTable *table, float alpha)
{
    Scattering scattering = {.count = GGX_NODES};
    Azimuths azimuths;
    find_azimuths(&azimuths);
    for (int node = 0; node < GGX_NODES; node++) {
        reflect_from_node(table, &scattering, &azimuths, alpha, node);
    }
    table->mean_scale = table_mean(table->scale);
    table->mean_bias = table_mean(table->bias);
    balance(&scattering, table->restore[0]);
}

static void refract_from_node(Scattering *scattering, const Azimuths *azimuths, float alpha,
                              float eta, int side, int node)
{
    Vec3 wo = node_direction(node), standard = standard_direction(wo, alpha);
    float *row = scattering->to[side * GGX_NODES + node];
    for (int k = 0; k < DRAWS; k++) {
        Vec3 h = quadrature_normal(azimuths, standard, alpha, k);
        float cosine = vec3_dot(wo, h), cosine_t;
        float f = fresnel_dielectric(cosine, eta, &cosine_t);
        Vec3 reflected = vec3_sub(vec3_scale(h, 2.0f * cosine), wo);
        Vec3 refracted = vec3_sub(vec3_scale(h, cosine / eta - cosine_t), vec3_scale(wo, 1 / eta));
        if (reflected.z > 0.0f) {
            float weight = f * shadowing(alpha, wo, reflected) / DRAWS;
            deposit(row + side * GGX_NODES, reflected.z, weight);
        }
        if (f < 1.0f && refracted.z < 0.0f) {
            float weight = (1.0f - f) * shadowing(alpha, wo, refracted) / DRAWS;
            deposit(row + (1 - side) * GGX_NODES, -refracted.z, weight);
        }
    }
}

void ggx_table_dielectric(GgxTable *table, float alpha, float ior)
{
    Scattering scattering = {.count = 2 * GGX_NODES};
    float factor[2 * GGX_NODES];
    Azimuths azimuths;
    find_azimuths(&azimuths);
    for (int side = 0; side < 2; side++) {
        for (int node = 0; node < GGX_NODES; node++) {
            refract_from_node(&scattering, &azimuths, alpha, side ? 1.0f / ior : ior, side, node);
        }
    }
    balance(&scattering, factor);
    memcpy(table->restore, factor, sizeof factor);
}
