#include "render/film_merge.h"

#include "base/color.h"

static void sum_vector(double sum[3], Vec3 v)
{
    sum[0] += (double)v.x;
    sum[1] += (double)v.y;
    sum[2] += (double)v.z;
}

static void sum_seen(PixelSum *sum, const PathResult *path)
{
    if (path->seen != SEEN_SURFACE) {
        bool light = path->seen == SEEN_LIGHT;
        sum_vector(light ? sum->light : sum->sky, vec3_scale(path->color, path->sharpness));
        *(light ? &sum->light_share : &sum->sky_share) += (double)path->sharpness;
    }
}

void pixel_sum_add(PixelSum *sum, const PathResult *path)
{
    double l = (double)luminance(path->color);
    sum_vector(sum->color, path->color);
    sum_seen(sum, path);
    sum->alpha += (double)path->alpha;
    sum->luminance += l;
    sum->luminance_squared += l * l;
    sum->rays += path->rays;
    sum_vector(sum->albedo, path->albedo);
    if (path->hit) {
        sum_vector(sum->normal, path->normal);
        sum_vector(sum->position, path->position);
        sum->depth += (double)path->depth;
        sum->object = sum->hits++ ? sum->object : path->object + 1;
    }
}

// The mean of `old` (of weight n) and a sum over m more.
static float merged(float old, double n, double sum, double m)
{
    return (float)(((n > 0.0 ? (double)old * n : 0.0) + sum) / (n + m));
}

static Vec3 merged_vector(Vec3 old, double n, const double sum[3], double m)
{
    return vec3(merged(old.x, n, sum[0], m), merged(old.y, n, sum[1], m),
                merged(old.z, n, sum[2], m));
}

// Variance of the mean from the sums of squared deviations of both parts (Chan et al. 1979).
static float merged_variance(const Film *film, int64_t i, double n, const PixelSum *s, double m)
{
    double old_mean = n > 0.0 ? (double)luminance(film->color[i]) : 0.0, mean = s->luminance / m;
    double deviations = n > 1.0 ? (double)film->variance[i] * n * (n - 1.0) : 0.0;
    deviations += fmax(0.0, s->luminance_squared - mean * s->luminance);
    deviations += (mean - old_mean) * (mean - old_mean) * n * m / (n + m);
    double all = n + m;
    return all > 1.0 ? (float)(deviations / (all * (all - 1.0))) : 0.0f;
}

void film_merge(Film *film, int64_t i, int samples_before, int samples_added, const PixelSum *s)
{
    double n = samples_before, m = samples_added, hits = s->hits;
    double hits_before = samples_before > 0 ? (double)film->hits[i] : 0.0;
    film->variance[i] = merged_variance(film, i, n, s, m);
    film->color[i] = merged_vector(film->color[i], n, s->color, m);
    film->light[i] = merged_vector(film->light[i], n, s->light, m);
    film->sky[i] = merged_vector(film->sky[i], n, s->sky, m);
    film->light_share[i] = merged(film->light_share[i], n, s->light_share, m);
    film->sky_share[i] = merged(film->sky_share[i], n, s->sky_share, m);
    film->alpha[i] = merged(film->alpha[i], n, s->alpha, m);
    film->albedo[i] = merged_vector(film->albedo[i], n, s->albedo, m);
    film->normal[i] = merged_vector(film->normal[i], n, s->normal, m);
    if (hits_before + hits > 0.0) {
        film->depth[i] = merged(film->depth[i], hits_before, s->depth, hits);
        film->position[i] = merged_vector(film->position[i], hits_before, s->position, hits);
    } else {
        film->depth[i] = INFINITY;
        film->position[i] = vec3_splat(0.0f);
    }
    if (hits_before <= 0.0) {
        film->object[i] = (float)s->object;
    }
    film->hits[i] = (float)(hits_before + hits);
    film->samples[i] = (float)(n + m);
}
