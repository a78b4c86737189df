// L-systems (Lindenmayer 1968; Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants):
// bracketed, parametric and stochastic D0L-systems. Every symbol of a string is rewritten at once,
// generation after generation.
//
// A module is one symbol, with parameters in parentheses where it has them: F(0.5), A(l, w). Rules,
// one a line or parted by ';':
//
//     predecessor : condition -> successor : probability
//
// where condition and probability may be left out: "A(l) : l > 0.1 -> F(l)[+A(l*0.7)]A(l*0.8)".
// The first rule that fits is taken; when it has a probability, one is drawn among all that fit and
// have one, in proportion. A line "name = expression" makes a constant. '#' starts a comment.
#ifndef RAMIFY_GROW_LSYSTEM_LSYSTEM_H
#define RAMIFY_GROW_LSYSTEM_LSYSTEM_H

#include "base/run.h"

#include <stdint.h>

enum { MODULE_MOST_PARAMETERS = 8 };

typedef struct Module {
    char symbol;
    int8_t count;  // of parameters
    int64_t first; // of its parameters among the string's values
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
    int64_t most_modules;      // of a string; 0 = 4 million
    uint64_t seed;             // of stochastic rules: a draw is keyed by generation and place
} LSystemParams;

// The string after the last generation. ERROR_INPUT names the line and column of what is wrong with
// axiom or rules, or the generation that would be longer than most_modules; its key is that of the
// text.
bool lsystem_derive(const LSystemParams *params, const Run *run, ModuleString *string, Error *e);

// Are axiom and rules right? ERROR_INPUT as for lsystem_derive.
bool lsystem_check(const LSystemParams *params, Error *e);

void module_string_clear(ModuleString *string);

// Parameter number `place` of a module, or fallback where it has fewer.
double module_parameter(const ModuleString *string, int64_t module, int place, double fallback);

#endif
