// Cascades: water falls as bodies do, slides no faster than its bed lets it, parts at bulges, and
// drifts on the pool until its foam is gone.
#include "objects/cascade/cascade.h"

#include "making.h"
#include "shape/envelope.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>

static CascadePlace place[CASCADE_STEPS];

// All below y = 1 and behind z = 0: a ledge.
static void ledge(const void *user, Vec3 *p, Vec3 *normal)
{
    (void)user;
    bool before = p->z > 0.0f, over = p->y > 1.0f;
    bool front = before ? !over : !over && p->z > p->y - 1.0f;
    *normal = front ? vec3(0, 0, 1) : vec3(0, 1, 0);
    *p = vec3(p->x, front ? p->y : 1.0f, front || before ? 0.0f : p->z);
}

// A plane that falls by 45 degrees toward +z.
static void slope(const void *user, Vec3 *p, Vec3 *normal)
{
    (void)user;
    *normal = vec3(0.0f, 0.70710678f, 0.70710678f);
    *p = vec3_madd(*p, -vec3_dot(*p, *normal), *normal);
}

static void ball(const void *user, Vec3 *p, Vec3 *normal)
{
    (void)user;
    *normal = vec3_normalize(*p);
    *p = vec3_scale(*normal, 0.5f);
}

static CascadeParams still_params(void)
{
    CascadeParams p = cascade_params_default();
    p.wander = p.gather = 0.0f;
    p.strands = 40;
    return p;
}

// What leaves a ledge at v lands v sqrt(2 h / g) before it.
static void water_falls_freely(void **state)
{
    (void)state;
    CascadeParams p = still_params();
    ShapeSurface surface = {.nearest = ledge};
    for (int i = 0; i < p.strands; i++) {
        int count = cascade_way(&p, &surface, 3, i, place, CASCADE_STEPS), k = 0;
        while (k < count && !place[k].afloat) {
            k++;
        }
        assert_true(k < count);
        double speed = (double)place[0].velocity.z, high = (double)place[0].at.y;
        double far = speed * sqrt(2.0 * high / 9.81);
        assert_true(fabs((double)place[k].at.z - far) < 0.04 * far);
        assert_true(place[k].white > 0.3f); // air has come into it
    }
}

// On a slope water is as fast as its friction, 0.01 v^2 / depth, lets it be, and clear films stay
// on the rock.
static void water_slides_on_rock(void **state)
{
    (void)state;
    CascadeParams p = still_params();
    p.from = vec3(-0.5f, 3.0f, -3.0f);
    p.to = vec3(0.5f, 3.0f, -3.0f);
    p.level = -100.0f;
    ShapeSurface surface = {.nearest = slope};
    for (int i = 0; i < p.strands; i++) {
        int count = cascade_way(&p, &surface, 3, i, place, CASCADE_STEPS);
        const CascadePlace *last = &place[count - 1];
        double film = (double)vec3_dot(last->at, vec3(0.0f, 0.70710678f, 0.70710678f));
        double most = sqrt(9.81 * 0.70710678 * (film + 0.003) / 0.01);
        double speed = (double)vec3_length(last->velocity);
        assert_true(last->on_rock && film > 0.0009 && film < 0.0091);
        assert_true(speed > 0.5 * most && speed < 1.03 * most);
    }
}

static void water_parts_at_a_bulge(void **state)
{
    (void)state;
    CascadeParams p = still_params();
    p.from = vec3(-0.2f, 0.5f, 0.1f);
    p.to = vec3(0.2f, 0.5f, 0.1f);
    p.level = -0.6f;
    ShapeSurface surface = {.nearest = ball};
    int parted = 0;
    for (int i = 0; i < p.strands; i++) {
        int count = cascade_way(&p, &surface, 3, i, place, CASCADE_STEPS), k = 0;
        while (k < count && !place[k].afloat) {
            k++;
        }
        assert_true(k < count);
        float from = place[0].at.x, to = place[k].at.x;
        parted += fabsf(to) > fabsf(from) && (to > 0.0f) == (from > 0.0f);
    }
    assert_true(parted > 34);
}

static void foam_drifts_on_the_pool_and_fades(void **state)
{
    (void)state;
    CascadeParams p = still_params();
    ShapeSurface surface = {.nearest = ledge};
    float before = 1.0f;
    int afloat = 0, count = cascade_way(&p, &surface, 3, 7, place, CASCADE_STEPS);
    for (int k = 0; k < count; k++) {
        if (place[k].afloat) {
            assert_float_equal(place[k].at.y, p.level, 0.0f);
            assert_true(place[k].at.z > 0.0f && place[k].white <= before);
            before = place[k].white;
            afloat++;
        }
    }
    assert_true(afloat > 20 && before < 0.021f);
}

static double contents(const CascadeParams *p, int strand)
{
    ShapeSurface surface = {.nearest = ledge};
    SprayParcels white = {0};
    int count = cascade_way(p, &surface, 3, strand, place, CASCADE_STEPS);
    assert_true(cascade_whiten(p, 3, strand, place, count, &(CascadeWater){.white = &white}, NULL));
    double sum = 0.0;
    for (int64_t i = 0; i < white.count; i++) {
        sum += (double)white.parcel[i].content;
    }
    free(white.parcel);
    return sum;
}

// As much is seen as flows, however many strands there are.
static void white_water_is_as_much_as_flows(void **state)
{
    (void)state;
    CascadeParams few = still_params(), many = few, more = few;
    many.strands = 160;
    more.discharge *= 3.0f;
    double sum[3] = {0};
    for (int i = 0; i < many.strands; i++) {
        sum[0] += i < few.strands ? contents(&few, i) : 0.0;
        sum[1] += contents(&many, i);
        sum[2] += i < more.strands ? contents(&more, i) : 0.0;
    }
    assert_true(sum[0] > 0.0);
    assert_true(fabs(sum[1] / sum[0] - 1.0) < 0.1);
    assert_true(fabs(sum[2] / sum[0] - 3.0) < 1e-5);
}

static SprayParcels *made_by(int threads)
{
    CascadeParams p = cascade_params_default();
    p.strands = 100;
    ShapeSurface surface = {.nearest = ledge};
    Run run = {.threads = threads};
    Recipe recipe = {.seed = 5, .label = "cascade", .run = &run, .surface = &surface};
    Geometry geometry = {0};
    Placing placing = placing_in(&geometry, &recipe);
    placing.keep_water = placing.keep_spray = true;
    assert_true(kind_cascade.geometry(&p, &(Grown){0}, &placing, NULL));
    assert_int_equal(geometry.count, 1);
    assert_true(geometry.part[0].spray->count > 0);
    SprayParcels *water = geometry.part[0].water;
    geometry.part[0].water = NULL;
    geometry_clear(&geometry);
    return water;
}

static void any_threads_make_the_same_water(void **state)
{
    (void)state;
    SprayParcels *one = made_by(1), *three = made_by(3);
    assert_true(one->count > 1000 && one->count == three->count);
    assert_memory_equal(one->parcel, three->parcel, sizeof *one->parcel * (size_t)one->count);
    spray_free(one);
    spray_free(three);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(water_falls_freely),
        cmocka_unit_test(water_slides_on_rock),
        cmocka_unit_test(water_parts_at_a_bulge),
        cmocka_unit_test(foam_drifts_on_the_pool_and_fades),
        cmocka_unit_test(white_water_is_as_much_as_flows),
        cmocka_unit_test(any_threads_make_the_same_water),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
