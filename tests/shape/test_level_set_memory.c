// Level sets made where memory ends: wherever it does, there is an error and no crash. C++'s
// operators new and delete are replaced below by some that count bytes up to a limit. Once it is
// met, only large blocks make room again when they are freed: small ones lie scattered, or other
// threads take them.
#include "shape/level_set.h"
#include "testing.h"

#include <malloc.h>
#include <math.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

typedef void Handler(void);

enum { LARGE = 32 << 20 }; // bytes; nothing that the work itself takes is

static int64_t used, peak, large, limit = INT64_MAX; // bytes
static bool ended;

_Noreturn void throw_bad_alloc(void) __asm__("_ZSt17__throw_bad_allocv");
Handler *get_new_handler(void) __asm__("_ZSt15get_new_handlerv");
void *operator_new(size_t size) __asm__("_Znwm");
void *operator_new_array(size_t size) __asm__("_Znam");
void operator_delete(void *memory) __asm__("_ZdlPv");
void operator_delete_array(void *memory) __asm__("_ZdaPv");
void operator_delete_sized(void *memory, size_t size) __asm__("_ZdlPvm");
void operator_delete_array_sized(void *memory, size_t size) __asm__("_ZdaPvm");

static bool count(int64_t bytes)
{
    int64_t now = __atomic_add_fetch(&used, bytes, __ATOMIC_RELAXED);
    if (bytes > 0 && now > limit) {
        __atomic_sub_fetch(&used, bytes, __ATOMIC_RELAXED);
        ended = true;
        return false;
    }
    peak = now > peak ? now : peak;
    large = bytes > LARGE && bytes > large ? bytes : large;
    return true;
}

void *operator_new(size_t size)
{
    void *made = malloc(size ? size : 1);
    while (!made || !count((int64_t)malloc_usable_size(made))) {
        Handler *handler = get_new_handler();
        if (!handler) {
            free(made);
            throw_bad_alloc();
        }
        handler(); // throws, or has freed some
    }
    return made;
}

void *operator_new_array(size_t size)
{
    return operator_new(size);
}

void operator_delete(void *memory)
{
    int64_t bytes = (int64_t)malloc_usable_size(memory);
    if (!ended || bytes > LARGE) {
        count(-bytes);
    }
    free(memory);
}

void operator_delete_array(void *memory)
{
    operator_delete(memory);
}

void operator_delete_sized(void *memory, size_t size)
{
    (void)size;
    operator_delete(memory);
}

void operator_delete_array_sized(void *memory, size_t size)
{
    (void)size;
    operator_delete(memory);
}

static double ball(const void *shape, Vec3 p, double *bound)
{
    double distance = (double)vec3_length(vec3_sub(p, *(const Vec3 *)shape)) - 1.0;
    *bound = fabs(distance);
    return distance;
}

static LevelSet *ball_at(Vec3 center, const Run *run, Error *e)
{
    Aabb box = {vec3_sub(center, vec3(1, 1, 1)), vec3_add(center, vec3(1, 1, 1))};
    return level_set_from_distance(ball, &center, box, (LevelSetFrame){vec3(0, 0, 0), 0.1f}, run,
                                   e);
}

static bool export(const LevelSet *set, Error *e)
{
    GridFile *grids = grid_file_new(e);
    bool done = grids && level_set_add_to(set, "ball", grids, e);
    if (grids) {
        grid_file_free(grids);
    }
    return done;
}

// Everything that makes, changes and frees a level set.
static bool make_and_free(Error *e)
{
    Run run = run_default();
    LevelSet *a = ball_at(vec3(0, 0, 0), &run, e), *b = NULL;
    Mesh *mesh = a ? level_set_surface(a, e) : NULL;
    b = mesh ? level_set_from_mesh(mesh, (LevelSetFrame){vec3(0, 0, 0), 0.1f}, &run, e) : NULL;
    level_set_free(a);
    a = b ? ball_at(vec3(1, 0, 0), &run, e) : NULL;
    bool done = a && level_set_combine(a, b, SHAPE_UNION, e) && level_set_smooth(a, 2, &run, e) &&
                level_set_finish(a, e) && export(a, e);
    mesh_free(mesh);
    level_set_free(a);
    level_set_free(b);
    return done;
}

// In a process of its own with so many bytes: 0 done, 1 an error, else it crashed.
static int outcome(int64_t bytes)
{
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        Error e = {0};
        limit = used + bytes;
        _exit(make_and_free(&e) ? 0 : e.code == ERROR_MEMORY ? 1 : 2);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 100 + WTERMSIG(status);
}

static void wherever_memory_ends_there_is_an_error(void **state)
{
    enum { LIMITS = 150 };
    (void)state;
    Error e = {0};
    int64_t before = used;
    assert_true(make_and_free(&e));
    int64_t all = peak - before, work = all - large;
    int errors = 0;
    for (int i = 0; i < LIMITS; i++) {
        int got = outcome(all - work * i / LIMITS);
        assert_in_range(got, 0, 1);
        errors += got;
    }
    assert_true(errors > LIMITS / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wherever_memory_ends_there_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
