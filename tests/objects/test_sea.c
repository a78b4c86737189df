// The sea: its spectrum against what was measured at sea, its surface against its spectrum, its
// waves against the dispersion relation, its foam against observed whitecaps, and its surf against
// the depth.
#include "base/random.h"
#include "objects/sea/drops.h"
#include "objects/sea/sea.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>

static const double TURN = 6.28318530717958647692;

static Waves *waves_of(const SeaParams *sea, uint64_t seed, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Waves *waves = sea_waves(sea, seed, &run, &e);
    if (!waves) {
        fail_msg("%s", e.message);
    }
    return waves;
}

static double height_of(const Waves *waves)
{
    double sum = 0.0;
    for (int i = 0; i < WAVES_TILES; i++) {
        sum += waves_mean_square(&waves->tile[i], WAVE_HEIGHT);
    }
    return 4.0 * sqrt(sum);
}

// Hasselmann et al. 1973: variance g^2 / wind^4 = 1.6e-7 of the dimensionless fetch.
static void spectrum_has_the_height_of_jonswap(void **state)
{
    (void)state;
    const double fetch[] = {100, 300, 1000, 3000}; // dimensionless
    for (size_t i = 0; i < sizeof fetch / sizeof fetch[0]; i++) {
        double wind = 12.0;
        WaveSpectrum s = wave_spectrum(wind, fetch[i] * wind * wind / GRAVITY, 0.0);
        double height = 4.0 * sqrt(wave_spectrum_variance(&s));
        double measured = 4.0 * sqrt(1.6e-7 * fetch[i]) * wind * wind / GRAVITY;
        printf("    dimensionless fetch %4.0f: %.2f m, JONSWAP %.2f m\n", fetch[i], height,
               measured);
        assert_true(fabs(height / measured - 1.0) < 0.01);
    }
    // A fully developed sea: Pierson and Moskowitz 1964, 0.0246 wind^2 m.
    WaveSpectrum full = wave_spectrum(12.0, 1e7, 0.0);
    double height = 4.0 * sqrt(wave_spectrum_variance(&full));
    printf("    fully developed at 12 m/s: %.2f m, Pierson-Moskowitz %.2f m\n", height,
           0.0246 * 144.0);
    assert_true(fabs(height / (0.0246 * 144.0) - 1.0) < 0.15);
}

static void directions_add_up(void **state)
{
    (void)state;
    WaveSpectrum s = wave_spectrum(10.0, 1e5, 0.0);
    for (double ratio = 0.5; ratio < 20.0; ratio *= 1.7) {
        double sum = 0.0;
        WaveRing ring = wave_spectrum_ring(&s, wave_number(ratio * s.peak, 0.0));
        for (int i = 0; i < 3600; i++) {
            sum += wave_ring_density(&ring, (i + 0.5) / 3600.0 * TURN - 0.5 * TURN);
        }
        assert_true(fabs(sum * TURN / 3600.0 / ring.all - 1.0) < 1e-4);
    }
}

static void numbers_solve_the_dispersion_relation(void **state)
{
    (void)state;
    for (double depth = 0.0; depth < 200.0; depth = depth * 3.0 + 0.05) {
        for (double omega = 0.2; omega < 30.0; omega *= 1.9) {
            double k = wave_number(omega, depth);
            assert_true(fabs(wave_frequency(k, depth) / omega - 1.0) < 1e-9);
            double speed = (wave_frequency(1.0001 * k, depth) - wave_frequency(0.9999 * k, depth)) /
                           (0.0002 * k);
            assert_true(fabs(wave_group_speed(k, depth) / speed - 1.0) < 1e-5);
        }
    }
}

// The tiles together have the height of the spectrum: no band twice, none missing.
static void surface_has_the_height_of_its_spectrum(void **state)
{
    (void)state;
    const float wind[] = {5.0f, 12.0f, 20.0f}, depth[] = {0.0f, 0.0f, 15.0f};
    for (int i = 0; i < 3; i++) {
        SeaParams sea = sea_params_default();
        sea.wind = wind[i];
        sea.depth = depth[i];
        Waves *waves = waves_of(&sea, 7, 2);
        WaveSpectrum s = sea_spectrum(&sea);
        double want = 4.0 * sqrt(wave_spectrum_variance(&s)), have = height_of(waves);
        printf("    wind %2.0f m/s, depth %2.0f m: surface %.3f m, spectrum %.3f m\n",
               (double)wind[i], (double)depth[i], have, want);
        assert_true(fabs(have / want - 1.0) < 0.03);
        waves_free(waves);
    }
}

// Slopes that the tiles show and those that they hide are together those of Cox and Munk, and at
// any width the sum is the same.
static void slopes_are_those_of_cox_and_munk(void **state)
{
    (void)state;
    const float wind[] = {5.0f, 10.0f, 14.0f};
    for (int i = 0; i < 3; i++) {
        SeaParams sea = sea_params_default();
        sea.wind = wind[i];
        Waves *waves = waves_of(&sea, 7, 2);
        double shown = 0.0;
        for (int t = 0; t < WAVES_TILES; t++) {
            shown += waves_mean_square(&waves->tile[t], WAVE_SLOPE_X) +
                     waves_mean_square(&waves->tile[t], WAVE_SLOPE_Z);
        }
        WavePoint fine, coarse;
        waves_at(waves, 0.0f, 0.0f, 0.0f, &fine);
        waves_at(waves, 0.0f, 0.0f, 1e5f, &coarse);
        double all = shown + (double)fine.roughness2, seen = cox_munk_slopes((double)wind[i]);
        printf(
            "    wind %2.0f m/s: slopes %.4f shown + %.4f hidden, far away %.4f, Cox-Munk %.4f\n",
            (double)wind[i], shown, (double)fine.roughness2, (double)coarse.roughness2, seen);
        assert_true(all / seen > 0.9 && all / seen < 1.3);
        assert_true(fabs((double)coarse.roughness2 / all - 1.0) < 0.05);
        waves_free(waves);
    }
}

// A wave of the tile moves at g / omega: its phase in the transform of the heights, from time to
// time.
static void waves_move_as_water_waves_do(void **state)
{
    (void)state;
    const double step = 0.125;
    SeaParams sea = sea_params_default();
    sea.wind_azimuth = 270.0f; // from the west: toward +x
    Waves *at[2];
    for (int i = 0; i < 2; i++) {
        sea.time = (float)(100.0 + i * step);
        at[i] = waves_of(&sea, 7, 2);
    }
    const WaveTile *tile = &at[0]->tile[0];
    for (int number = 6; number <= 14; number += 4) {
        double phase[2];
        for (int i = 0; i < 2; i++) {
            double re = 0.0, im = 0.0;
            for (int row = 0; row < tile->side; row++) {
                for (int column = 0; column < tile->side; column++) {
                    const float *texel = at[i]->tile[0].texel[0] +
                                         ((int64_t)row * tile->side + column) * WAVE_CHANNELS;
                    double angle = TURN * number * column / tile->side;
                    re += (double)texel[WAVE_HEIGHT] * cos(angle);
                    im -= (double)texel[WAVE_HEIGHT] * sin(angle);
                }
            }
            phase[i] = atan2(im, re);
        }
        double k = TURN * number / (double)tile->size;
        double speed = -remainder(phase[1] - phase[0], TURN) / (step * k);
        double want = sqrt(GRAVITY / k);
        printf("    wave of %.0f m: %.2f m/s, g / omega = %.2f m/s\n", TURN / k, speed, want);
        assert_true(fabs(speed / want - 1.0) < 0.05); // some of it runs against the wind
    }
    waves_free(at[0]);
    waves_free(at[1]);
}

static void bits_do_not_depend_on_threads(void **state)
{
    (void)state;
    SeaParams sea = sea_params_default();
    sea.extent = 200.0f;
    sea.spokes = 64;
    Error e = {0};
    Mesh *mesh[2];
    for (int i = 0; i < 2; i++) {
        Run run = run_default();
        run.threads = 1 + 3 * i;
        mesh[i] = sea_mesh(&sea, NULL, waves_of(&sea, 11, run.threads), &run, &e);
        assert_non_null(mesh[i]);
    }
    size_t size = sizeof(Vec3) * (size_t)mesh[0]->vertex_count;
    assert_memory_equal(mesh[0]->position, mesh[1]->position, size);
    assert_memory_equal(mesh[0]->normal, mesh[1]->normal, size);
    for (int t = 0; t < WAVES_TILES; t++) {
        const WaveTile *tile = &mesh[0]->waves->tile[t];
        assert_memory_equal(tile->texel[0], mesh[1]->waves->tile[t].texel[0],
                            sizeof(float) * WAVE_CHANNELS * (size_t)(tile->side * tile->side));
    }
    mesh_free(mesh[0]);
    mesh_free(mesh[1]);
}

// Within a factor of 2 of Monahan's whitecaps, which scatter by as much themselves. Crests that
// break now are the smaller part of it: a tenth to a half (Monahan and Lu 1990). They roll down the
// front of the wave, and old foam is left on its back.
static void foam_covers_what_whitecaps_do(void **state)
{
    (void)state;
    enum { SIDE = 400 };
    const float wind[] = {10.0f, 15.0f, 20.0f};
    for (int i = 0; i < 3; i++) {
        SeaParams sea = sea_params_default();
        sea.wind = wind[i];
        Waves *waves = waves_of(&sea, 7, 2);
        double cover = 0.0, fresh = 0.0, front = 0.0, back = 0.0,
               size = (double)waves->tile[0].size;
        for (int k = 0; k < SIDE * SIDE; k++) {
            WavePoint point;
            waves_at(waves, (float)(size * (k % SIDE) / SIDE), (float)(size * (k / SIDE) / SIDE),
                     0.0f, &point);
            WaveFoam foam = waves_foam(waves, &point);
            assert_true(foam.cover >= 0.0f && foam.cover <= foam.bubbles && foam.bubbles <= 1.0f);
            cover += (double)foam.cover;
            fresh += (double)(foam.fresh * foam.cover);
            Vec3 n = point.normal;
            float rise = -(n.x * waves->way.x + n.z * waves->way.y) / n.y; // along the way
            front += (double)(foam.fresh * foam.cover * rise);
            back += (double)((1.0f - foam.fresh) * foam.cover * rise);
        }
        printf("    slope along the way: %.3f where foam is fresh, %.3f where it is old\n",
               front / fresh, back / (cover - fresh));
        assert_true(front < 0.0 && back > 0.0);
        cover /= SIDE * SIDE;
        fresh /= SIDE * SIDE;
        double seen = monahan_whitecaps((double)wind[i]);
        printf("    wind %2.0f m/s: foam %.2f %%, Monahan %.2f %%; breaks now %.2f %%\n",
               (double)wind[i], 100.0 * cover, 100.0 * seen, 100.0 * fresh);
        assert_true(cover > 0.5 * seen && cover < 2.0 * seen);
        assert_true(fresh > 0.1 * cover && fresh < 0.5 * cover);
        waves_free(waves);
    }
}

// Foam in lines along the wind has the mean that is asked for; places 20 m apart along the wind are
// more alike than places 2 m apart across it; a wide pixel shows the mean.
static void lines_of_foam_follow_the_wind(void **state)
{
    (void)state;
    enum { PLACES = 60000 };
    Waves waves = {.way = {0.6f, 0.8f}, .foam = 1.0f, .spread = 0.4f, .streaks = 0.01f};
    const Vec2 to[] = {{0.0f, 0.0f}, {12.0f, 16.0f}, {-1.6f, 1.2f}}; // none, 20 m along, 2 m across
    double sum = 0.0, product[3] = {0};
    for (uint64_t i = 0; i < PLACES; i++) {
        float foam[3];
        WavePoint point = {.depth = INFINITY, .normal = {0.0f, 1.0f, 0.0f}};
        Vec2 at = {random_range(random_key(5, 2 * i), -2000.0f, 2000.0f),
                   random_range(random_key(5, 2 * i + 1), -2000.0f, 2000.0f)};
        for (int k = 0; k < 3; k++) {
            point.place = (Vec2){at.x + to[k].x, at.y + to[k].y};
            foam[k] = waves_foam(&waves, &point).cover;
            product[k] += (double)(foam[0] * foam[k]);
        }
        sum += (double)foam[0];
        point.width = 50.0f;
        assert_float_equal(waves_foam(&waves, &point).cover, 0.01f, 1e-6f);
    }
    double mean = sum / PLACES, variance = product[0] / PLACES - mean * mean;
    double along = (product[1] / PLACES - mean * mean) / variance;
    double across = (product[2] / PLACES - mean * mean) / variance;
    printf("    mean %.4f; correlation %.2f over 20 m along, %.2f over 2 m across\n", mean, along,
           across);
    assert_true(fabs(mean - 0.01) < 0.001 && along > across + 0.1);
}

// Mean foam over places where the water is so thick: waves stand `rise` m above the still water.
static double swash_of(float swash, float thick, float rise)
{
    enum { PLACES = 4000 };
    Waves waves = {.way = {0.6f, 0.8f}, .foam = 1.0f, .spread = 0.4f, .swash = swash};
    double sum = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        WavePoint point = {.depth = thick - rise,
                           .displacement = {0.0f, rise, 0.0f},
                           .normal = {0.0f, 1.0f, 0.0f},
                           .place = {random_range(random_key(5, 2 * i), -200.0f, 200.0f),
                                     random_range(random_key(5, 2 * i + 1), -200.0f, 200.0f)}};
        WaveFoam foam = waves_foam(&waves, &point);
        assert_true(foam.cover >= 0.0f && foam.cover <= 1.0f);
        assert_true(foam.fresh >= 0.0f && foam.fresh <= 1.0f);
        sum += (double)foam.cover;
    }
    return sum / PLACES;
}

// The edge of the water is white where it really is, also where a wave has carried it up the shore;
// the sheet behind it less and less, deeper water not at all.
static void edge_of_the_water_is_white(void **state)
{
    (void)state;
    const float thick[] = {0.0f, 0.01f, 0.04f, 0.12f, 0.3f};
    double last = 1.0;
    for (int i = 0; i < 5; i++) {
        double foam = swash_of(1.0f, thick[i], 0.0f);
        printf("    %.2f m of water: foam %.3f\n", (double)thick[i], foam);
        assert_true(foam < last);
        assert_true(fabs(swash_of(1.0f, thick[i], 0.2f) - foam) < 1e-3);
        assert_true(swash_of(0.0f, thick[i], 0.0f) == 0.0);
        last = foam;
    }
    assert_true(swash_of(1.0f, 0.0f, 0.0f) > 0.6 && last == 0.0);
    assert_true(swash_of(0.5f, 0.0f, 0.0f) < 0.7 * swash_of(1.0f, 0.0f, 0.0f));
}

// The height of the longest waves at a place.
static float long_height(const Waves *waves, float x, float z)
{
    Waves alone = *waves;
    for (int i = 1; i < WAVES_TILES; i++) {
        alone.tile[i].levels = 0;
    }
    WavePoint point;
    waves_at(&alone, x, z, 0.0f, &point);
    return point.displacement.y;
}

// The crest is as high as asked for at its place and time, the highest about it, and has left a
// period later, downwind; far off the sea is what it was.
static void great_wave_stands_where_it_is_asked_for(void **state)
{
    (void)state;
    SeaParams sea = sea_params_default();
    sea.wind = 12.0f;
    sea.wind_azimuth = 270.0f;
    sea.choppiness = 0.0f;
    Waves *plain = waves_of(&sea, 7, 2);
    sea.crest[0] = 40.0f;
    sea.crest[1] = -25.0f;
    sea.crest_height = 1.3f * (float)height_of(plain);
    sea.crest_time = 3.0f;
    sea.time = 3.0f;
    Waves *great = waves_of(&sea, 7, 2);
    float there = long_height(great, 40.0f, -25.0f);
    printf("    asked for %.2f m, is %.2f m\n", (double)sea.crest_height, (double)there);
    assert_true(fabsf(there - sea.crest_height) < 0.01f * sea.crest_height);
    float aside = 0.25f * great->tile[0].longest;
    for (int i = 0; i < 8; i++) {
        double angle = TURN * i / 8.0;
        float x = 40.0f + aside * (float)cos(angle), z = -25.0f + aside * (float)sin(angle);
        assert_true(long_height(great, x, z) < 0.9f * there);
    }
    waves_free(great);
    sea.time = 3.0f + 0.25f * (float)(TURN / sea_spectrum(&sea).peak);
    great = waves_of(&sea, 7, 2);
    float left = long_height(great, 40.0f, -25.0f),
          ahead = long_height(great, 40.0f + aside, -25.0f);
    printf("    a quarter of a period later: %.2f m there, %.2f m ahead\n", (double)left,
           (double)ahead);
    assert_true(ahead > left + 0.2f * sea.crest_height);
    waves_free(great);
    waves_free(plain);
}

// What breaks leans over downwind, the more the higher it stands and the more it is crowded; what
// does not break stays in its place to the bit.
static void crests_that_break_fall_forward(void **state)
{
    (void)state;
    SeaParams sea = sea_params_default();
    sea.wind = 15.0f;
    Waves *plain = waves_of(&sea, 7, 2);
    sea.breakers = 0.7f;
    Waves *waves = waves_of(&sea, 7, 2);
    int broken = 0;
    double ahead = 0.0, aside = 0.0;
    for (int i = 0; i < 40000; i++) {
        float x = 5.3f * (float)(i % 200), z = 5.3f * (float)(i / 200);
        WavePoint still, thrown;
        waves_at(plain, x, z, 0.1f, &still);
        waves_at(waves, x, z, 0.1f, &thrown);
        Vec3 by = vec3_sub(thrown.displacement, still.displacement);
        assert_true(fabsf(vec3_length(thrown.normal) - 1.0f) < 1e-4f);
        if (still.crowding <= plain->foam) {
            assert_memory_equal(&still, &thrown, sizeof still);
            continue;
        }
        float rise = fmaxf(still.displacement.y, 0.0f);
        assert_true(vec3_length(by) <= 1.5f * sea.breakers * rise + 1e-5f);
        ahead += (double)(by.x * waves->way.x + by.z * waves->way.y);
        aside += (double)fabsf(by.z * waves->way.x - by.x * waves->way.y);
        broken++;
    }
    printf("    %d of 40000 places break, %.3f m ahead\n", broken, ahead / broken);
    assert_true(broken > 100 && ahead / broken > 0.02 && aside / broken < 1e-4);
    float sum[WAVE_CHANNELS] = {0};
    sum[WAVE_HEIGHT] = 2.0f;
    float last = 0.0f;
    for (int i = 1; i <= 3; i++) { // wide, so that nothing boils
        sum[WAVE_CROWDING] = (waves->foam + (float)i * waves->spread) / waves->choppiness;
        Vec3 by = waves_thrown(waves, 0.0f, 0.0f, 10.0f, sum);
        float along = by.x * waves->way.x + by.z * waves->way.y;
        assert_true(along > last && by.y <= 0.0f);
        last = along;
    }
    assert_true(fabsf(last - 0.7f * 2.0f) < 0.01f); // the whole height times the parameter
    waves_free(plain);
    waves_free(waves);
}

// Normals of thrown crests are those of the surface that the mesh shows.
static void normals_of_breakers_are_those_of_the_surface(void **state)
{
    (void)state;
    SeaParams sea = sea_params_default();
    sea.wind = 15.0f;
    sea.breakers = 0.7f;
    Waves *waves = waves_of(&sea, 7, 2);
    int seen = 0;
    double off = 0.0;
    for (int i = 0; i < 40000; i++) {
        float x = 5.3f * (float)(i % 200), z = 5.3f * (float)(i / 200), step = 0.02f;
        WavePoint at[3];
        waves_at(waves, x, z, 0.02f, &at[0]);
        if (at[0].crowding < waves->foam + 0.1f) {
            continue;
        }
        waves_at(waves, x + step, z, 0.02f, &at[1]);
        waves_at(waves, x, z + step, 0.02f, &at[2]);
        Vec3 to[2];
        for (int k = 0; k < 2; k++) {
            to[k] = vec3_sub(at[k + 1].displacement, at[0].displacement);
        }
        to[0].x += step;
        to[1].z += step;
        Vec3 normal = vec3_normalize(vec3_cross(to[1], to[0]));
        off += (double)(1.0f - vec3_dot(normal, at[0].normal));
        seen++;
    }
    printf("    %d places, 1 - cosine %.4f\n", seen, off / seen);
    assert_true(seen > 30 && off / seen < 0.02);
    waves_free(waves);
}

// Drops are in the air above crests that break and downwind of them, closed bodies of millimetres;
// the same bits for any threads that made the waves; none in a light breeze or if none are wanted.
static void drops_fly_above_breakers(void **state)
{
    (void)state;
    Error e = {0};
    SeaParams sea = sea_params_default();
    sea.wind = 17.0f;
    sea.fetch = 40000.0f;
    sea.crest_height = 3.0f;
    sea.breakers = 0.6f;
    sea.drops = 1.0f;
    bool none;
    Mesh *mesh[2];
    for (int i = 0; i < 2; i++) {
        Waves *waves = waves_of(&sea, 7, 1 + 3 * i);
        mesh[i] = sea_drops(&sea, waves, (Vec2){0.0f, 0.0f}, 7, &none, &e);
        assert_true(mesh[i] && !none);
        waves_free(waves);
    }
    assert_int_equal(mesh[0]->vertex_count, mesh[1]->vertex_count);
    assert_memory_equal(mesh[0]->position, mesh[1]->position,
                        sizeof(Vec3) * (size_t)mesh[0]->vertex_count);
    MeshTopology topology;
    assert_true(mesh_topology(mesh[0], &topology, &e));
    assert_int_equal(topology.open_edges + topology.overused_edges + topology.misoriented_edges, 0);
    Aabb box = mesh_bounds(mesh[0]);
    printf("    %lld drops, up to %.2f m\n", (long long)(mesh[0]->vertex_count / 6),
           (double)box.high.y);
    assert_true(mesh[0]->vertex_count > 6 * 1000 && box.high.y > 3.0f && box.high.y < 8.0f);
    assert_true(box.low.x > -70.0f && box.high.x < 70.0f);
    mesh_free(mesh[0]);
    mesh_free(mesh[1]);
    for (int i = 0; i < 2; i++) {
        SeaParams calm = sea;
        calm.drops = i == 0 ? 0.0f : 1.0f;
        calm.wind = i == 0 ? 17.0f : 3.0f;
        calm.crest_height = 0.0f;
        Waves *waves = waves_of(&calm, 7, 2);
        assert_null(sea_drops(&calm, waves, (Vec2){0.0f, 0.0f}, 7, &none, &e));
        assert_true(none);
        waves_free(waves);
    }
}

// A beach that rises toward +x by 1 in 25, with the shore line at x = 0.
static HeightField *beach(void)
{
    Error e = {0};
    HeightField *land =
        height_field_new(321, 161, (Vec2){5.0f, 5.0f}, (Vec2){-1400.0f, -400.0f}, &e);
    assert_non_null(land);
    for (int row = 0; row < land->rows; row++) {
        for (int column = 0; column < land->columns; column++) {
            land->height[row * land->columns + column] =
                0.04f * (land->origin.x + 5.0f * (float)column);
        }
    }
    return land;
}

// Significant height about a place, over 600 m of shore and a wave's length of depths.
static double height_near(const Waves *waves, float x)
{
    double squares = 0.0;
    int count = 0;
    for (float z = -300.0f; z < 300.0f; z += 1.0f, count++) {
        WavePoint point;
        waves_at(waves, x + 2.0f * remainderf(0.618f * z, 1.0f), z, 0.0f, &point);
        squares += (double)point.displacement.y * (double)point.displacement.y;
    }
    return 4.0 * sqrt(squares / count);
}

static void surf_is_limited_by_depth(void **state)
{
    (void)state;
    SeaParams sea = sea_params_default();
    sea.wind = 12.0f;
    sea.wind_azimuth = 235.0f; // from the south-west: 35 degrees off the beach's normal
    Error e = {0};
    Run run = run_default();
    Waves *waves = waves_of(&sea, 7, 2);
    double open = height_of(waves);
    HeightField *land = beach();
    waves->shore = sea_shore(&sea, land, waves, &run, &e);
    assert_non_null(waves->shore);
    for (float depth = 1.0f; depth <= 4.0f; depth *= 2.0f) {
        double height = height_near(waves, -25.0f * depth);
        printf("    depth %.0f m: waves of %.2f m; open sea %.2f m\n", (double)depth, height, open);
        assert_true(height < 0.78 * (double)depth);
        assert_true(height > 0.3 * (double)depth);
    }
    double far = height_near(waves, -1300.0f);
    assert_true(fabs(far / open - 1.0) < 0.25);
    waves_free(waves);
    height_field_free(land);
}

// Mean foam about a place, over 600 m of shore.
static double foam_near(const Waves *waves, float x)
{
    double sum = 0.0;
    int count = 0;
    for (float z = -300.0f; z < 300.0f; z += 0.7f, count++) {
        WavePoint point;
        waves_at(waves, x + 4.0f * remainderf(0.618f * z, 1.0f), z, 0.0f, &point);
        float foam = waves_foam(waves, &point).cover;
        assert_true(foam >= 0.0f && foam <= 1.0f);
        sum += (double)foam;
    }
    return sum / count;
}

// Surf is whitest where it runs out, and foam that drifts from it thins out until the whitecaps of
// the open sea are left; without foam there is none in the surf, too.
static void surf_is_white(void **state)
{
    (void)state;
    SeaParams sea = sea_params_default();
    sea.wind = 10.0f;
    sea.wind_azimuth = 255.0f;
    Error e = {0};
    Run run = run_default();
    HeightField *land = beach();
    const float depth[] = {0.2f, 1.0f, 2.5f, 6.0f, 30.0f};
    for (int i = 0; i < 2; i++) {
        sea.foam = i == 0 ? 1.0f : 0.0f;
        Waves *waves = waves_of(&sea, 7, 2);
        waves->shore = sea_shore(&sea, land, waves, &run, &e);
        assert_non_null(waves->shore);
        double last = 1.0;
        for (int k = 0; k < 5; k++) {
            double foam = foam_near(waves, -25.0f * depth[k]);
            printf("    foam %.0f, depth %4.1f m: %.3f\n", (double)sea.foam, (double)depth[k],
                   foam);
            assert_true(i == 0 ? foam < last : foam < 1e-3);
            assert_true(i == 1 || depth[k] > 1.0f || foam > 0.4);
            last = foam;
        }
        assert_true(last < 0.04);
        waves_free(waves);
    }
    height_field_free(land);
}

// Snell's law: waves that come in at 35 degrees turn toward the shore as they slow down. The phase
// is that of the place where the tile is looked up.
static void waves_turn_toward_the_shore(void **state)
{
    (void)state;
    SeaParams sea = sea_params_default();
    sea.wind = 12.0f;
    sea.wind_azimuth = 235.0f;
    Error e = {0};
    Run run = run_default();
    Waves *waves = waves_of(&sea, 7, 2);
    HeightField *land = beach();
    WavesShore *shore = waves->shore = sea_shore(&sea, land, waves, &run, &e);
    assert_non_null(shore);
    WaveSpectrum s = sea_spectrum(&sea);
    double deep_speed = GRAVITY / s.peak;
    for (double depth = 2.0; depth <= 8.0; depth *= 2.0) {
        int column = (int)((-25.0 * depth - (double)shore->origin.x) / (double)shore->cell);
        int row = shore->rows / 2;
        const float *shift = shore->shift + ((int64_t)row * shore->columns + column) * WAVES_TILES;
        double reach = 2.0 * (double)shore->cell;
        double along_x =
            (double)waves->way.x + (double)(shift[WAVES_TILES] - shift[-WAVES_TILES]) / reach;
        int64_t line = (int64_t)shore->columns * WAVES_TILES;
        double along_z = (double)waves->way.y + (double)(shift[line] - shift[-line]) / reach;
        double angle = atan2(along_z, along_x) * 360.0 / TURN;
        double real = -0.04 * ((double)shore->origin.x + column * (double)shore->cell);
        double speed = s.peak / wave_number(s.peak, real);
        double snell = asin(fabs((double)waves->way.y) * speed / deep_speed) * 360.0 / TURN;
        printf("    depth %.1f m: %.1f degrees off the normal, Snell %.1f\n", real, angle, snell);
        assert_true(fabs(fabs(angle) - snell) < 3.0);
    }
    waves_free(waves);
    height_field_free(land);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spectrum_has_the_height_of_jonswap),
        cmocka_unit_test(directions_add_up),
        cmocka_unit_test(numbers_solve_the_dispersion_relation),
        cmocka_unit_test(surface_has_the_height_of_its_spectrum),
        cmocka_unit_test(slopes_are_those_of_cox_and_munk),
        cmocka_unit_test(waves_move_as_water_waves_do),
        cmocka_unit_test(bits_do_not_depend_on_threads),
        cmocka_unit_test(foam_covers_what_whitecaps_do),
        cmocka_unit_test(lines_of_foam_follow_the_wind),
        cmocka_unit_test(edge_of_the_water_is_white),
        cmocka_unit_test(great_wave_stands_where_it_is_asked_for),
        cmocka_unit_test(crests_that_break_fall_forward),
        cmocka_unit_test(normals_of_breakers_are_those_of_the_surface),
        cmocka_unit_test(drops_fly_above_breakers),
        cmocka_unit_test(surf_is_limited_by_depth),
        cmocka_unit_test(surf_is_white),
        cmocka_unit_test(waves_turn_toward_the_shore),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
