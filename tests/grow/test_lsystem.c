// L-systems and their turtle against what the book derives by hand and what arithmetic says.
#include "testing.h"

#include "base/exact_math.h"
#include "grow/lsystem/expression.h"
#include "grow/lsystem/lsystem.h"
#include "grow/lsystem/turtle.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static ModuleString derive(const char *axiom, const char *rules, int generations)
{
    Run run = run_default();
    Error e = {0};
    ModuleString string;
    LSystemParams params = {.axiom = axiom, .rules = rules, .generations = generations, .seed = 5};
    if (!lsystem_derive(&params, &run, &string, &e)) {
        fail_msg("%s", e.message);
    }
    return string;
}

// "F(1.5)[+A]".
static void assert_string(const ModuleString *string, const char *wanted)
{
    char text[512];
    size_t used = 0;
    for (int64_t i = 0; i < string->count && used < sizeof text - 64; i++) {
        const Module *m = &string->module[i];
        text[used++] = m->symbol;
        for (int p = 0; p < m->count; p++) {
            used += (size_t)snprintf(text + used, sizeof text - used, "%c%g", p ? ',' : '(',
                                     string->value[m->first + p]);
        }
        if (m->count) {
            text[used++] = ')';
        }
    }
    text[used] = '\0';
    assert_string_equal(text, wanted);
}

static void the_algae_grow_by_fibonacci(void **state)
{
    (void)state;
    int64_t a = 1, b = 2; // lengths of generations 0 and 1
    for (int generation = 0; generation <= 20; generation++) {
        ModuleString string = derive("A", "A -> AB; B -> A", generation);
        assert_int_equal(string.count, a);
        module_string_clear(&string);
        int64_t next = a + b;
        a = b;
        b = next;
    }
    ModuleString string = derive("A", "A -> AB; B -> A", 4);
    assert_string(&string, "ABAABABA");
    module_string_clear(&string);
}

static void the_snowflake_has_four_times_the_segments(void **state)
{
    (void)state;
    int64_t segments = 3;
    for (int generation = 0; generation <= 6; generation++) {
        ModuleString string = derive("F--F--F", "F -> F+F--F+F", generation);
        int64_t count = 0;
        for (int64_t i = 0; i < string.count; i++) {
            count += string.module[i].symbol == 'F';
        }
        assert_int_equal(count, segments);
        segments *= 4;
        module_string_clear(&string);
    }
}

// The coral paper's rule: X's and F's triple, so that generation g has (3^(g+1) - 3) / 2 F's.
static void the_coral_rule_triples(void **state)
{
    (void)state;
    ModuleString string = derive("X", "X -> [+FX][-FX]FX", 7);
    int64_t forward = 0;
    for (int64_t i = 0; i < string.count; i++) {
        forward += string.module[i].symbol == 'F';
    }
    assert_int_equal(forward, (6561 - 3) / 2);
    module_string_clear(&string);
}

// The Algorithmic Beauty of Plants, section 1.10.1, re-derived by hand.
static void parameters_and_conditions_work(void **state)
{
    (void)state;
    const char *rules = "A(x, y) : y <= 3 -> A(x*2, x+y)\n"
                        "A(x, y) : y > 3 -> B(x)A(x/y, 0)\n"
                        "B(x) : x < 1 -> C\n"
                        "B(x) : x >= 1 -> B(x-1)";
    static const char *const wanted[] = {
        "B(2)A(4,4)", "B(1)B(4)A(1,0)", "B(0)B(3)A(2,1)", "CB(2)A(4,3)", "CB(1)A(8,7)",
    };
    for (int generation = 0; generation < 5; generation++) {
        ModuleString string = derive("B(2)A(4, 4)", rules, generation);
        assert_string(&string, wanted[generation]);
        module_string_clear(&string);
    }
}

static void expressions_obey_the_usual_order(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } cases[] = {{"1+2*3", 7},   {"(1+2)*3", 9},  {"2^3^2", 512},    {"-2^2", -4},
                 {"8/4/2", 1},   {"7-4-2", 1},    {"1<2 && 2<1", 0}, {"1<2 || 2<1", 1},
                 {"!(1==1)", 0}, {"1+1 == 2", 1}, {"3 != 3", 0},     {"k*2+1", 7},
                 {"2*-3", -6},   {".5*4", 2},     {"1e2/10", 10},    {"5>=5", 1}};
    const char name[1][NAME_SIZE] = {"k"};
    const double values[1] = {3};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Reader reader = {cases[i].text, cases[i].text, "test"};
        Expression x = {0};
        Error e = {0};
        assert_true(expression_read(&reader, &(Names){name, 1}, &x, &e));
        assert_int_equal(*reader.at, '\0');
        assert_float_equal((float)expression_value(&x, values), (float)cases[i].value, 1e-6f);
        expression_clear(&x);
    }
}

static void stochastic_rules_keep_their_probabilities(void **state)
{
    (void)state;
    char axiom[4001];
    memset(axiom, 'A', 4000);
    axiom[4000] = '\0';
    ModuleString string = derive(axiom, "A -> B : 0.2; A -> C : 0.5; A -> D : 0.3", 1);
    int64_t count[3] = {0};
    for (int64_t i = 0; i < string.count; i++) {
        count[string.module[i].symbol - 'B']++;
    }
    const double wanted[3] = {0.2, 0.5, 0.3};
    for (int i = 0; i < 3; i++) { // five standard deviations
        double expected = 4000.0 * wanted[i], sigma = sqrt(expected * (1.0 - wanted[i]));
        assert_true(fabs((double)count[i] - expected) < 5.0 * sigma);
    }
    ModuleString again = derive(axiom, "A -> B : 0.2; A -> C : 0.5; A -> D : 0.3", 1);
    for (int64_t i = 0; i < string.count; i++) {
        assert_int_equal(string.module[i].symbol, again.module[i].symbol);
    }
    module_string_clear(&string);
    module_string_clear(&again);
}

static void assert_refused(const char *axiom, const char *rules, int generations, const char *words)
{
    Run run = run_default();
    Error e = {0};
    ModuleString string;
    LSystemParams params = {
        .axiom = axiom, .rules = rules, .generations = generations, .most_modules = 100000};
    assert_false(lsystem_derive(&params, &run, &string, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    if (strcmp(e.message, words) != 0) {
        fail_msg("said   %s\nwanted %s", e.message, words);
    }
    assert_null(string.module);
}

static void errors_name_the_place(void **state)
{
    (void)state;
    assert_refused("A", "A -> AB\nB - A", 1,
                   "the L-system's rules, line 2, column 3: '->' is missing; a rule is written A : "
                   "condition -> BA");
    assert_refused("A", "A(x) -> A(y)", 1,
                   "the L-system's rules, line 1, column 11: nothing is called 'y' here; name a "
                   "parameter of the rule's left side or a constant");
    assert_refused("A", "A -> [B", 1,
                   "the L-system's rules, line 1, column 8: '[' is not closed; put a ']' for each "
                   "'['");
    assert_refused("A", "A -> B]", 1, "the L-system's rules, line 1, column 7: ']' closes no '['");
    assert_refused("F(2+)", "", 1,
                   "the L-system's axiom, line 1, column 5: ')' starts no number, name or '('; an "
                   "expression is wanted");
    assert_refused("", "", 1,
                   "the L-system's axiom, line 1, column 1: it is empty; give it a symbol");
    assert_refused(
        "A", "A -> B : 0", 1,
        "the L-system's rules, line 1, column 11: the probability is 0; it must be above "
        "0");
}

#define WANTED                                                                                 \
    "it must be a number within 3.4e38; keep divisors from 0, powers to positive numbers and " \
    "results small"

static void undefined_and_boundless_numbers_are_refused(void **state)
{
    (void)state;
    assert_refused("A(0)", "A(x) -> A(1/x)", 1,
                   "the L-system's rules, line 1, column 9: parameter 1 of 'A' is inf; " WANTED);
    assert_refused("A", "k = 9999 ^ 99999999999999999999999999999999; A -> F(k)F", 1,
                   "the L-system's rules, line 1, column 1: constant 'k' is inf; " WANTED);
    assert_refused("A", "k = 2\nj = k - 1e999", 1,
                   "the L-system's rules, line 2, column 1: constant 'j' is -inf; " WANTED);
    assert_refused("F(1e39)", "", 1,
                   "the L-system's axiom, line 1, column 1: parameter 1 of 'F' is 1e+39; " WANTED);
    assert_refused("A(0)", "A(x) -> B(x ^ -1)", 1,
                   "the L-system's rules, line 1, column 9: parameter 1 of 'B' is inf; " WANTED);
    assert_refused(
        "A(0)", "B -> A\nA(x) : 0 / x < 2 -> F", 1,
        "the L-system's rules, line 2, column 1: the condition of 'A' has no value; " WANTED);
}

static void exponential_rules_end_with_one_error(void **state)
{
    (void)state;
    assert_refused("A", "A -> AA", 1000,
                   "generation 17 of the L-system has more than 100000 symbols; lower generations "
                   "or the rules' growth");
}

static OutTree *draw(const char *text, TurtleParams params)
{
    ModuleString string = derive(text, "", 0);
    Run run = run_default();
    Error e = {0};
    OutTree *tree = turtle_draw(&string, &params, &run, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    module_string_clear(&string);
    assert_true(out_tree_check(tree, NULL));
    return tree;
}

static void assert_end(const char *text, float angle, Vec3 wanted)
{
    TurtleParams params = turtle_params_default();
    params.angle = angle;
    OutTree *tree = draw(text, params);
    Vec3 end = tree->position[tree->count - 1];
    if (vec3_distance(end, wanted) > 1e-5f) {
        fail_msg("%s ends at %g %g %g", text, (double)end.x, (double)end.y, (double)end.z);
    }
    out_tree_free(tree);
}

static void the_turtle_goes_where_geometry_says(void **state)
{
    (void)state;
    const float c = 0.8660254f, s = 0.5f; // 30 degrees
    assert_end("F", 30, vec3(0, 1, 0));
    assert_end("F(2.5)", 30, vec3(0, 2.5f, 0));
    assert_end("+F", 30, vec3(-s, c, 0)); // to the left
    assert_end("-F", 30, vec3(s, c, 0));
    assert_end("&F", 30, vec3(0, c, -s)); // down is away from its back
    assert_end("^F", 30, vec3(0, c, s));
    assert_end("/(90)+F", 30, vec3(0, c, s)); // rolled right, its left is up
    assert_end("\\(90)+F", 30, vec3(0, c, -s));
    assert_end("F|F(2)", 30, vec3(0, -1, 0));
    assert_end("F[+F]F", 30, vec3(0, 2, 0));
    assert_end("+(90)F^(90)F", 30, vec3(-1, 0, 1));
    // five equal turns of 72 degrees close a pentagon
    assert_end("F+F+F+F+F", 72, vec3(0, 0, 0));
    // level: after a pitch and a roll $ makes the turtle's left horizontal again
    assert_end("&(60)/(37)$+(90)F", 30, vec3(-1, 0, 0));
}

// The snowflake's edge: after g generations the curve spans 3^g steps.
static void the_snowflake_closes(void **state)
{
    (void)state;
    ModuleString string = derive("F--F--F", "F -> F+F--F+F", 4);
    TurtleParams params = turtle_params_default();
    params.angle = 60.0f;
    Run run = run_default();
    OutTree *tree = turtle_draw(&string, &params, &run, NULL);
    assert_int_equal(tree->count, 3 * 256 + 1);
    assert_true(vec3_distance(tree->position[0], tree->position[768]) < 1e-2f);
    assert_float_equal(vec3_distance(tree->position[0], tree->position[256]), 81.0f, 1e-2f);
    out_tree_free(tree);
    module_string_clear(&string);
}

static void divergence_turns_leaves_about_the_stem(void **state)
{
    (void)state;
    TurtleParams params = turtle_params_default();
    OutTree *tree = draw("F[&(90)F]/(137.5)F[&(90)F]", params);
    Vec3 a = vec3_sub(tree->position[2], tree->position[1]);
    Vec3 b = vec3_sub(tree->position[4], tree->position[3]);
    float degrees = exact_acos(vec3_dot(a, b)) / RADIANS_PER_DEGREE;
    assert_float_equal(degrees, 137.5f, 1e-3f);
    out_tree_free(tree);
}

// A level branch under a downward pull turns by elasticity |H x T| a segment.
static void tropism_bends_by_the_book(void **state)
{
    (void)state;
    TurtleParams params = turtle_params_default();
    params.tropism = vec3(0, -2, 0);
    params.elasticity = 0.1f;
    OutTree *tree = draw("+(90)FFFF", params);
    float angle = 0.0f; // below the horizon
    Vec3 at = vec3(0, 0, 0);
    for (int i = 1; i <= 4; i++) {
        float s, c;
        exact_sincos(angle, &s, &c);
        at = vec3_add(at, vec3(-c, -s, 0));
        assert_true(vec3_distance(at, tree->position[i]) < 1e-5f);
        angle += 0.1f * 2.0f * c;
    }
    out_tree_free(tree);
}

static void widths_and_jumps_are_kept(void **state)
{
    (void)state;
    TurtleParams params = turtle_params_default();
    params.width = 0.2f;
    params.shrink = 0.5f;
    OutTree *tree = draw("F!F!(0.04)FfF", params);
    const float radius[6] = {0.1f, 0.1f, 0.05f, 0.02f, 0.02f, 0.02f};
    assert_int_equal(tree->count, 6);
    for (int i = 0; i < 6; i++) {
        assert_float_equal(tree->radius[i], radius[i], 1e-7f);
    }
    assert_int_equal(tree->parent[4], -1); // after the jump
    assert_float_equal(tree->position[4].y, 4.0f, 1e-6f);
    out_tree_free(tree);
}

static void strings_that_draw_nothing_are_refused(void **state)
{
    (void)state;
    Run run = run_default();
    TurtleParams params = turtle_params_default();
    ModuleString string = derive("+++", "", 0);
    Error e = {0};
    assert_null(turtle_draw(&string, &params, &run, &e));
    assert_string_equal(e.message, "the string draws nothing; it needs an F");
    module_string_clear(&string);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_algae_grow_by_fibonacci),
        cmocka_unit_test(the_snowflake_has_four_times_the_segments),
        cmocka_unit_test(the_coral_rule_triples),
        cmocka_unit_test(parameters_and_conditions_work),
        cmocka_unit_test(expressions_obey_the_usual_order),
        cmocka_unit_test(stochastic_rules_keep_their_probabilities),
        cmocka_unit_test(errors_name_the_place),
        cmocka_unit_test(undefined_and_boundless_numbers_are_refused),
        cmocka_unit_test(exponential_rules_end_with_one_error),
        cmocka_unit_test(the_turtle_goes_where_geometry_says),
        cmocka_unit_test(the_snowflake_closes),
        cmocka_unit_test(divergence_turns_leaves_about_the_stem),
        cmocka_unit_test(tropism_bends_by_the_book),
        cmocka_unit_test(widths_and_jumps_are_kept),
        cmocka_unit_test(strings_that_draw_nothing_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
