// L-systems (Lindenmayer 1968): bracketed, parametric and stochastic D0L-systems. Each generation
// rewrites all symbols of the string in parallel.
//
// A module is one symbol with optional parameters in parentheses: F(0.5), A(l, w). Rules, one per
// line or separated by ';':
//
//     predecessor : condition -> successor : probability
//
// where condition and probability are optional: "A(l) : l > 0.1 -> F(l)[+A(l*0.7)]A(l*0.8)". The
// first matching rule applies; if it has a probability, one is drawn in proportion among all
// matching rules that have one. A line "name = expression" defines a constant, '#' a comment.
#ifndef RAMIFY_GROW_LSYSTEM_LSYSTEM_H
#define RAMIFY_GROW_LSYSTEM_LSYSTEM_H

#include "base/run.h"

#include <stdint.h>

enum { MODULE_MAX_PARAMETERS = 8 };

typedef struct Module {
    char symbol;
    int8_t count;  // of parameters
    int64_t first; // index of its first parameter in the string's values
} Module;

typedef struct ModuleString {
    Module *module; // owned
    int64_t count, capacity;
    double *value; // owned: the parameters of all modules
    int64_t value_count, value_capacity;
} ModuleString;

typedef struct LSystemParams {
    const char *axiom, *rules; // borrowed
    int generations;           // >= 0
    int64_t most_modules;      // length limit of a string; 0 = 4 million
    uint64_t seed;             // of stochastic rules: draws are keyed by generation and place
} LSystemParams;

// Derives the string of the last generation. ERROR_INPUT names the line and column of the fault in
// axiom or rules, or the generation that would exceed most_modules.
bool lsystem_derive(const LSystemParams *params, const Run *run, ModuleString *string, Error *e);

// Checks axiom and rules. ERROR_INPUT as for lsystem_derive.
bool lsystem_check(const LSystemParams *params, Error *e);

void module_string_clear(ModuleString *string);

// Parameter number `place` of a module, or fallback if it has fewer.
double module_parameter(const ModuleString *string, int64_t module, int place, double fallback);

#endif
