// export/sky_bake: a sky that is turned by its rotation is the one whose sun stands there.
#include "export/sky_bake.h"
#include "render/world.h"
#include "testing.h"

static BakedSky bake(float azimuth, float rotation)
{
    World world = world_default();
    world.sky.kind = SKY_SUN_SKY;
    world.sky.sun_elevation = 12.0f;
    world.sky.sun_azimuth = azimuth;
    world.sky.rotation = rotation;
    BakedSky baked;
    Run run = run_default();
    assert_true(sky_bake(&world.sky, 64, &run, &baked, NULL));
    return baked;
}

static void turning_the_sky_takes_the_sun_along(void **state)
{
    (void)state;
    BakedSky turned = bake(30.0f, 90.0f), built = bake(120.0f, 0.0f), still = bake(30.0f, 0.0f);
    assert_true(vec3_distance(turned.sun.direction, built.sun.direction) < 1e-5f);
    assert_true(vec3_distance(turned.sun.direction, still.sun.direction) > 1.0f);
    double off = 0.0, apart = 0.0;
    for (int i = 0; i < 3 * 64 * 32; i++) {
        off += fabs((double)turned.image->pixel[i] - (double)built.image->pixel[i]);
        apart += fabs((double)still.image->pixel[i] - (double)built.image->pixel[i]);
    }
    assert_true(apart > 0.0 && off < 1e-3 * apart);
    baked_sky_clear(&turned);
    baked_sky_clear(&built);
    baked_sky_clear(&still);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(turning_the_sky_takes_the_sun_along)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
