// Rain: the rainbow where Descartes finds it, energy, and shafts along rays.
#include "render/rain/airy.h"
#include "render/rain/rain.h"
#include "render/rain/rain_phase.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

// Degrees from the point opposite to the sun at which a ray of least deflection leaves, for
// `inside` reflections inside of the drop (Descartes 1637; Nussenzveig 1977).
static double bow(double n, int inside)
{
    double p = inside + 1.0, cos_i = sqrt((n * n - 1.0) / (p * p - 1.0));
    double i = acos(cos_i), r = asin(sin(i) / n);
    double deflection = fmod(2.0 * (i - r) + inside * (PI - 2.0 * r), 2.0 * PI);
    return 180.0 - fabs(deflection) * 180.0 / PI;
}

static float channel(Vec3 v, int c)
{
    return c == 0 ? v.x : c == 1 ? v.y : v.z;
}

// The brightest angle of a channel, degrees from the point opposite to the sun.
static double brightest(const RainPhase *phase, int c, double from, double to)
{
    double best = 0.0, at = from;
    for (double a = from; a < to; a += 0.02) {
        double value = (double)channel(rain_phase(phase, (float)cos((180.0 - a) * PI / 180.0)), c);
        at = value > best ? a : at;
        best = value > best ? value : best;
    }
    return at;
}

static void rainbows_stand_where_they_are_seen(void **state)
{
    (void)state;
    assert_true(fabs(rain_index(589.3) - 1.3325) < 2e-4); // sodium's light, at 25 degrees C
    assert_true(fabs(bow(rain_index(650.0), 1) - 42.4) < 0.2);
    RainPhase *phase = rain_phase_new(NULL);
    double red = brightest(phase, 0, 38, 46), blue = brightest(phase, 2, 38, 46);
    double red2 = fabs(brightest(phase, 0, 48, 56)), blue2 = brightest(phase, 2, 48, 56);
    print_message("first bow %.2f (red) to %.2f (blue) degrees, second %.2f to %.2f\n", red, blue,
                  red2, blue2);
    assert_true(fabs(red - bow(rain_index(610.0), 1)) < 0.5);
    assert_true(fabs(blue - bow(rain_index(460.0), 1)) < 0.5);
    assert_true(red > blue + 0.5 && blue2 > red2 + 0.8); // the colours of the second are reversed
    double between = (double)rain_phase(phase, (float)cos((180.0 - 46.0) * PI / 180.0)).y;
    double inside = (double)rain_phase(phase, (float)cos((180.0 - 36.0) * PI / 180.0)).y;
    double first = (double)rain_phase(phase, (float)cos((180.0 - 41.8) * PI / 180.0)).y;
    double second = (double)rain_phase(phase, (float)cos((180.0 - 51.2) * PI / 180.0)).y;
    print_message("green: first %.4f, second %.4f, inside %.4f, Alexander's band %.4f\n", first,
                  second, inside, between);
    assert_true(first > 1.8 * second && second > 2.0 * between && inside > 2.0 * between);
    free(phase);
}

// The integral of Ai from 0 is 1/3, it is greatest at the first zero of Ai and nears 1 (Olver
// 2010, 9.9 and 9.10); and Ai(0)^2 is what 1/sqrt(t) gives when folded with it.
static void airy_is_that_of_the_tables(void **state)
{
    (void)state;
    double *beyond = malloc(AIRY_STEPS * sizeof *beyond), best = 0.0, at = 0.0, folded = 0.0;
    const double twice = 1.5874010519681994; // 2^(2/3)
    airy_fill(beyond);
    for (double y = -4.0; y < 4.0; y += 1e-3) {
        double value = airy_beyond(beyond, y);
        at = value > best ? y : at;
        best = fmax(best, value);
    }
    for (double root = 0.0; root < 1.9; root += 1e-3) { // t = root^2
        double t0 = root * root, t1 = (root + 1e-3) * (root + 1e-3);
        double share = airy_beyond(beyond, twice * t0) - airy_beyond(beyond, twice * t1);
        folded += share / (root + 5e-4) / (2.0 * PI);
    }
    print_message("1/3: %.6f; greatest at %.4f; Ai(0)^2 folded: %.6f\n", airy_beyond(beyond, 0.0),
                  at, folded);
    assert_true(fabs(airy_beyond(beyond, 0.0) - 1.0 / 3.0) < 1e-6);
    assert_true(fabs(at + 2.338107) < 6e-3);
    assert_true(fabs(airy_beyond(beyond, -50.0) - 1.0) < 0.05);
    assert_true(fabs(folded - 0.355028054 * 0.355028054) < 1e-4);
    free(beyond);
}

// From the outside in, red leads, then green, then blue, by more than the blue of the sky behind
// takes away.
static void the_bow_has_all_colours(void **state)
{
    (void)state;
    RainPhase *phase = rain_phase_new(NULL);
    double lead[3] = {0}, where[3] = {0};
    for (double a = 38.0; a < 44.0; a += 0.02) {
        Vec3 d = rain_phase(phase, (float)cos((180.0 - a) * PI / 180.0));
        for (int c = 0; c < 3; c++) {
            double least = fmax((double)channel(d, (c + 1) % 3), (double)channel(d, (c + 2) % 3));
            double ratio = (double)channel(d, c) / least;
            where[c] = ratio > lead[c] ? a : where[c];
            lead[c] = fmax(lead[c], ratio);
        }
    }
    print_message("red leads by %.2f at %.2f, green by %.2f at %.2f, blue by %.2f at %.2f\n",
                  lead[0], where[0], lead[1], where[1], lead[2], where[2]);
    assert_true(where[0] > where[1] && where[1] > where[2]);
    assert_true(lead[0] > 1.5 && lead[1] > 2.5 && lead[2] > 2.0);
    free(phase);
}

// All light leaves the drop; its mean cosine with the half that is bent by nothing: 0.884, of large
// spheres of index 1.33 without absorption (Kokhanovsky 2006).
static void drops_lose_no_light(void **state)
{
    (void)state;
    RainPhase *phase = rain_phase_new(NULL);
    for (int c = 0; c < 3; c++) {
        double sum = 0.0, cosine = 0.0;
        for (int i = 0; i < 18000; i++) {
            double a = (i + 0.5) * PI / 18000.0;
            double power = (double)channel(rain_phase(phase, (float)cos(a)), c) * 2.0 * PI *
                           sin(a) * PI / 18000.0;
            sum += power;
            cosine += cos(a) * power;
        }
        double whole = 0.5 * (1.0 + cosine / sum);
        print_message("channel %d: sum %.4f, mean cosine with diffraction %.4f\n", c, sum, whole);
        assert_true(fabs(sum - 1.0) < 5e-3);
        assert_true(fabs(whole - 0.884) < 0.01);
    }
    free(phase);
}

static void rain_lies_within_its_segment(void **state)
{
    (void)state;
    Shower shower = shower_default();
    shower.center_x = 800.0f;
    shower.lean = 30.0f;
    shower.wind = 70.0f;
    shower.bottom = 200.0f;
    shower.ragged = 0.5f;
    RainShaft shaft = rain_shaft(&shower, 3);
    int met = 0, wet = 0;
    for (int n = 0; n < 400; n++) {
        float a = (float)n * 0.37f, b = (float)(n % 19) * 0.1f - 0.9f;
        Vec3 origin = vec3(4000.0f * cosf(a), 60.0f * (float)(n % 30), 4000.0f * sinf(a));
        Vec3 direction =
            vec3_normalize(vec3(-cosf(a + b), 0.05f * (float)(n % 7) - 0.1f, -sinf(a + b)));
        float from, to;
        bool any = rain_segment(&shaft, origin, direction, 9000.0f, &from, &to);
        met += any;
        for (float t = 0.0f; t < 9000.0f; t += 25.0f) {
            float extinction = rain_extinction(&shaft, vec3_madd(origin, t, direction));
            wet += extinction > 0.0f;
            assert_true(extinction == 0.0f || (any && t >= from - 1.0f && t <= to + 1.0f));
        }
    }
    assert_true(met > 40 && met < 360 && wet > 1000);
}

// Drawn directions have the phase function's mean cosine.
static void directions_are_drawn_by_the_phase(void **state)
{
    (void)state;
    RainPhase *phase = rain_phase_new(NULL);
    double drawn = 0.0, exact = 0.0;
    Vec3 z = vec3(0, 0, 1);
    for (int i = 0; i < 100000; i++) {
        float pdf;
        Vec3 d = rain_phase_draw(phase, z, ((float)i + 0.5f) / 100000.0f, 0.37f, &pdf);
        assert_true(pdf > 0.0f);
        drawn += (double)d.z / 100000.0;
    }
    for (int i = 0; i < 18000; i++) {
        double a = (i + 0.5) * PI / 18000.0;
        exact += cos(a) * (double)rain_phase_pdf(rain_phase(phase, (float)cos(a))) * 2.0 * PI *
                 sin(a) * PI / 18000.0;
    }
    assert_true(fabs(drawn - exact) < 1e-3);
    free(phase);
}

// 1.076 R^0.67 dB/km without diffraction's half, in the middle of an even shower.
static void extinction_is_that_of_the_rate(void **state)
{
    (void)state;
    Shower shower = shower_default();
    shower.streaks = 0.0f;
    shower.rate = 25.0f;
    RainShaft shaft = rain_shaft(&shower, 3);
    double km = 1000.0 * (double)rain_extinction(&shaft, vec3(0, 999, 0)) * 2.0 * 10.0 / log(10.0);
    assert_true(fabs(km - 1.076 * pow(25.0, 0.67)) < 1e-3 * km);
    assert_true(rain_extinction(&shaft, vec3(0, 1200, 0)) == 0.0f);
}

// A shower of even rain with a frayed edge, 100 m below its base of 2000 m.
static RainShaft frayed_shaft(float ragged)
{
    Shower shower = shower_default();
    shower.streaks = 0.0f;
    shower.lean = 0.0f;
    shower.base = 2000.0f;
    shower.radius = 1500.0f;
    shower.ragged = ragged;
    return rain_shaft(&shower, 3);
}

// Share of the rain in the middle at a distance from it that way, `fallen` m below the base.
static double share_at(const RainShaft *shaft, double turn, double away, double fallen)
{
    Vec3 p = vec3((float)(away * cos(turn)), (float)(2000.0 - fallen), (float)(away * sin(turn)));
    Vec3 top = vec3(0, 2000, 0);
    return (double)(rain_extinction(shaft, p) / rain_extinction(shaft, top));
}

// Where less than a tenth of the rain is left, from the circle inward: least and greatest distance
// about the shaft.
static void edge_of(const RainShaft *shaft, double *least, double *greatest)
{
    *least = 1500.0;
    *greatest = 0.0;
    for (int i = 0; i < 360; i++) {
        double away = 1500.0;
        while (away > 0.0 && share_at(shaft, i * PI / 180.0, away, 100.0) < 0.1) {
            away -= 10.0;
        }
        *least = fmin(*least, away);
        *greatest = fmax(*greatest, away);
    }
}

// A round shaft has its edge at one distance, a frayed one in lobes and threads, nowhere with a
// step, and none beyond the circle.
static void frayed_edges_are_ragged_without_steps(void **state)
{
    (void)state;
    RainShaft even = frayed_shaft(0.0f), frayed = frayed_shaft(1.0f);
    double least, greatest, step = 0.0;
    edge_of(&even, &least, &greatest);
    assert_true(greatest - least < 15.0);
    edge_of(&frayed, &least, &greatest);
    print_message("the frayed edge lies at %.0f to %.0f m of 1500 m\n", least, greatest);
    assert_true(greatest - least > 500.0 && greatest < 1500.0);
    for (int i = 0; i < 360; i += 5) {
        double last = 0.0;
        for (double away = 1500.0; away > 0.0; away -= 2.0) {
            double share = share_at(&frayed, i * PI / 180.0, away, 100.0);
            step = fmax(step, fabs(share - last));
            last = share;
        }
    }
    print_message("greatest change in 2 m: %.3f of the rain in the middle\n", step);
    assert_true(step < 0.05);
}

// Thin rain at a frayed edge dries up before it reaches the ground; rain in the middle does not.
static void frayed_edges_dry_up(void **state)
{
    (void)state;
    RainShaft even = frayed_shaft(0.0f), frayed = frayed_shaft(1.0f);
    int thin = 0, dry = 0;
    for (int i = 0; i < 360; i += 3) {
        for (double away = 0.0; away < 1500.0; away += 30.0) {
            double turn = i * PI / 180.0, high = share_at(&frayed, turn, away, 10.0);
            double low = share_at(&frayed, turn, away, 1990.0);
            assert_true(low <= high + 1e-6);
            assert_true(high < 0.7 || low > 0.95 * high);
            thin += high > 1e-3 && high < 0.03;
            dry += high > 1e-3 && high < 0.03 && low == 0.0;
            double same = share_at(&even, turn, away, 1990.0);
            assert_true(fabs(same - share_at(&even, turn, away, 10.0)) < 1e-6);
        }
    }
    print_message("%d of %d places with thin rain are dry on the ground\n", dry, thin);
    assert_true(thin > 50 && dry == thin);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rainbows_stand_where_they_are_seen),
        cmocka_unit_test(airy_is_that_of_the_tables),
        cmocka_unit_test(the_bow_has_all_colours),
        cmocka_unit_test(drops_lose_no_light),
        cmocka_unit_test(directions_are_drawn_by_the_phase),
        cmocka_unit_test(rain_lies_within_its_segment),
        cmocka_unit_test(extinction_is_that_of_the_rate),
        cmocka_unit_test(frayed_edges_are_ragged_without_steps),
        cmocka_unit_test(frayed_edges_dry_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
