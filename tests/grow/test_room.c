// Steps that give way to taken space.
#include "grow/room.h"

#include "testing.h"

// A wall that takes x > 1.
static float wall(const void *user, Vec3 p, Vec3 *away)
{
    (void)user;
    *away = vec3(-1, 0, 0);
    return 1.0f - p.x;
}

// A ball of radius 1 about the origin.
static float ball(const void *user, Vec3 p, Vec3 *away)
{
    (void)user;
    *away = vec3_normalize(p);
    return vec3_length(p) - 1.0f;
}

static void a_free_step_stays(void **state)
{
    (void)state;
    Room room = {.clearance = wall};
    Vec3 child = vec3(0.5f, 0.2f, 0);
    assert_true(room_give_way(&room, vec3(0, 0, 0), vec3(0, 0, 0), &child));
    assert_float_equal(child.x, 0.5f, 0);
    assert_float_equal(child.y, 0.2f, 0);
}

static void a_step_turns_along_the_wall(void **state)
{
    (void)state;
    Room room = {.clearance = wall};
    Vec3 from = vec3(0.8f, 0, 0), child = vec3(1.1f, 0.4f, 0.1f);
    float step = vec3_distance(from, child);
    assert_true(room_give_way(&room, from, vec3(0, 0, 0), &child));
    assert_true(child.x <= 1.0f && child.y > 0.3f);
    assert_float_equal(vec3_distance(from, child), step, 1e-5f);
}

static void a_step_straight_into_the_wall_is_dropped(void **state)
{
    (void)state;
    Room room = {.clearance = wall};
    Vec3 child = vec3(1.9f, 0, 0);
    assert_true(!room_give_way(&room, vec3(0.95f, 0, 0), vec3(1, 0, 0), &child));
}

// On a surface with its normal up, a step gives way sideways and stays level.
static void a_step_on_a_surface_stays_on_it(void **state)
{
    (void)state;
    Room room = {.clearance = ball};
    Vec3 from = vec3(-1.2f, 0.3f, 0), up = vec3(0, 1, 0), level = vec3(-0.8f, 0.3f, 0.05f),
         free = level;
    assert_true(room_give_way(&room, from, up, &level));
    assert_float_equal(level.y, 0.3f, 1e-5f);
    assert_true(room_give_way(&room, from, vec3(0, 0, 0), &free));
    assert_true(free.y > 0.32f);
}

// Growth that starts inside an obstacle may leave it, but not go deeper.
static void growth_leaves_what_it_starts_in(void **state)
{
    (void)state;
    Room room = {.clearance = ball};
    Vec3 from = vec3(0, 0.5f, 0), out = vec3(0, 0.8f, 0), in = vec3(0, 0.2f, 0);
    assert_true(room_give_way(&room, from, vec3(0, 0, 0), &out));
    assert_float_equal(out.y, 0.8f, 0);
    assert_true(!room_give_way(&room, from, vec3(0, 1, 0), &in) || vec3_length(in) > 0.5f);
}

// A wall 12 cm thick is not jumped over by a step of 1 m.
static float sheet(const void *user, Vec3 p, Vec3 *away)
{
    (void)user;
    *away = vec3(p.x < 0.5f ? -1.0f : 1.0f, 0, 0);
    return fabsf(p.x - 0.5f) - 0.06f;
}

static void a_long_step_does_not_jump_over_a_sheet(void **state)
{
    (void)state;
    Room room = {.clearance = sheet};
    Vec3 child = vec3(1, 0.1f, 0);
    bool made = room_give_way(&room, vec3(0, 0, 0), vec3(0, 0, 0), &child);
    assert_true(!made || child.x < 0.5f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_free_step_stays),
        cmocka_unit_test(a_step_turns_along_the_wall),
        cmocka_unit_test(a_step_straight_into_the_wall_is_dropped),
        cmocka_unit_test(a_step_on_a_surface_stays_on_it),
        cmocka_unit_test(growth_leaves_what_it_starts_in),
        cmocka_unit_test(a_long_step_does_not_jump_over_a_sheet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
