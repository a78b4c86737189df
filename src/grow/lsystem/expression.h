// Arithmetic expressions of parametric L-systems: + - * / ^, comparisons, && || !, parentheses.
// Compiled once to a stack program, so that rules are cheap to apply.
#ifndef RAMIFY_GROW_LSYSTEM_EXPRESSION_H
#define RAMIFY_GROW_LSYSTEM_EXPRESSION_H

#include "base/error.h"

#include <stdint.h>

enum { EXPRESSION_STACK = 32, NAME_SIZE = 32 };

// A parser's position in a text; errors name the line and column of `at`.
typedef struct Reader {
    const char *text, *at;
    const char *what; // prefix of messages, as "the L-system's rules"
} Reader;

// Sets ERROR_INPUT "what, line L, column C: ..." for the current position; returns false.
bool reader_fail(const Reader *reader, Error *e, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

void reader_skip_blanks(Reader *reader); // spaces and tabs, not line ends

// Reads a name (a letter, then letters, digits, _) into name; false if there is none.
bool reader_name(Reader *reader, char name[NAME_SIZE]);

typedef struct Operation {
    int code;     // opcode
    double value; // of a number
    int variable; // index among the names
} Operation;

typedef struct Expression {
    Operation *operation; // owned
    int64_t count, capacity;
} Expression;

// Names that an expression may use; variable i has values[i] at evaluation.
typedef struct Names {
    const char (*name)[NAME_SIZE];
    int count;
} Names;

// Parses the longest expression at the current position. ERROR_INPUT names the position. Free with
// expression_clear.
bool expression_read(Reader *reader, const Names *names, Expression *expression, Error *e);
void expression_clear(Expression *expression);

// Evaluates; comparisons give 1 or 0. An undefined subexpression (a power of a negative number, 0 /
// 0) makes the result NaN, even inside a comparison; division by zero is infinite. Callers check
// results.
double expression_value(const Expression *expression, const double *values);

#endif
