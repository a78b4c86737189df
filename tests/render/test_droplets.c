// The phase function of droplets against integrals of itself and counts of what it draws.
#include "base/random.h"
#include "render/medium/droplets.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static double integral(const DropletPhase *p, double low, double high, int moment)
{
    enum { STEPS = 100000 };
    double sum = 0.0, scale = sqrt(1.0 - low) - sqrt(1.0 - high);
    for (int i = 0; i < STEPS; i++) { // finer toward the forward peak: cosine = 1 - r^2
        double r = sqrt(1.0 - high) + (i + 0.5) * scale / STEPS, cosine = 1.0 - r * r;
        sum += 2.0 * r * (moment == 1 ? cosine : 1.0) *
               (double)droplet_phase_density(p, (float)cosine);
    }
    return 2.0 * M_PI * sum * scale / STEPS;
}

static void assert_close(double value, double wanted, double tolerance)
{
    if (!(fabs(value - wanted) <= tolerance)) {
        fail_msg("%.8g, not %.8g +- %.2g", value, wanted, tolerance);
    }
}

static void droplets_scatter_all_light_as_far_forward_as_told(void **state)
{
    (void)state;
    for (float d = 5.0f; d <= 50.0f; d += 7.5f) {
        double tolerance = d < 25.0f ? 1e-4 : 3e-4; // steps of a float's cosine in the narrow peak
        for (int left = 0; left <= 6; left++) {
            DropletPhase whole = droplet_phase(d),
                         p = droplet_phase_widened(&whole, (float)left / 6);
            assert_close(integral(&p, -1.0, 1.0, 0), 1.0, tolerance);
            assert_close(integral(&p, -1.0, 1.0, 1), (double)droplet_phase_mean_cosine(&p),
                         tolerance);
        }
    }
}

// Mie's theory: asymmetry 0.86 to 0.88 for droplets of clouds, and more for larger ones.
static void larger_droplets_scatter_further_forward(void **state)
{
    (void)state;
    float last = 0.0f;
    for (float d = 6.0f; d <= 50.0f; d += 4.0f) {
        DropletPhase p = droplet_phase(d);
        float mean = droplet_phase_mean_cosine(&p);
        assert_true(mean > last && mean > 0.82f && mean < 0.90f);
        last = mean;
    }
    DropletPhase p = droplet_phase(20.0f);
    assert_close((double)droplet_phase_mean_cosine(&p), 0.873, 0.01);
}

// Chi-square over bins of the cosine that hold as many each if drawn evenly in r, 1 - cosine = r^2.
static void drawn_directions_have_the_density(void **state)
{
    (void)state;
    enum { BINS = 64, DRAWS = 200000 };
    for (int left = 0; left <= 6; left += 2) {
        DropletPhase whole = droplet_phase(20.0f),
                     p = droplet_phase_widened(&whole, (float)left / 6);
        int count[BINS] = {0};
        Vec3 axis = vec3_normalize(vec3(0.3f, -0.5f, 0.8f));
        for (uint64_t i = 0; i < DRAWS; i++) {
            Vec3 d = droplet_phase_draw(&p, axis, random_unit(random_key(i, 0)),
                                        random_unit(random_key(i, 1)));
            double r = sqrt(fmax(1.0 - (double)vec3_dot(axis, d), 0.0) / 2.0);
            count[r < 1.0 ? (int)(r * BINS) : BINS - 1]++;
        }
        double chi = 0.0;
        for (int i = 0; i < BINS; i++) {
            double a = (double)i / BINS, b = (i + 1.0) / BINS;
            double wanted = DRAWS * integral(&p, 1.0 - 2.0 * b * b, 1.0 - 2.0 * a * a, 0);
            chi += (count[i] - wanted) * (count[i] - wanted) / wanted;
        }
        assert_true(chi < 63.0 + 4.0 * sqrt(2.0 * 63.0));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(droplets_scatter_all_light_as_far_forward_as_told),
        cmocka_unit_test(larger_droplets_scatter_further_forward),
        cmocka_unit_test(drawn_directions_have_the_density),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
