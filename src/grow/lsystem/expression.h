// Arithmetic over named numbers, as parametric L-systems write it: + - * / ^, comparisons, && || !,
// parentheses. Compiled once to a stack program, so that a rule is cheap to apply.
#ifndef RAMIFY_GROW_LSYSTEM_EXPRESSION_H
#define RAMIFY_GROW_LSYSTEM_EXPRESSION_H

#include "base/error.h"

#include <stdint.h>

enum { EXPRESSION_STACK = 32, NAME_SIZE = 32 };

// A text being read; errors name the line and column of `at`.
typedef struct Reader {
    const char *text, *at;
    const char *what; // "the L-system's rules": begins its messages
} Reader;

// Sets ERROR_INPUT "what, line L, column C: ..." for the reader's place; returns false.
bool reader_fail(const Reader *reader, Error *e, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

void reader_skip_blanks(Reader *reader); // spaces and tabs, not line ends

// Reads a name (a letter, then letters, digits, _) into name; false when there is none.
bool reader_name(Reader *reader, char name[NAME_SIZE]);

typedef struct Operation {
    int code;     // of the stack machine
    double value; // a number's
    int variable; // a variable's place among the names
} Operation;

typedef struct Expression {
    Operation *operation; // owned
    int64_t count, capacity;
} Expression;

// Names that an expression may use; variable i stands for values[i] at evaluation.
typedef struct Names {
    const char (*name)[NAME_SIZE];
    int count;
} Names;

// Reads an expression from the reader's place as far as it goes. ERROR_INPUT names the place.
bool expression_read(Reader *reader, const Names *names, Expression *expression, Error *e);
void expression_clear(Expression *expression);

// The value; comparisons give 1 or 0. What is undefined (a power of a negative number, 0 / 0) makes
// the whole NaN, comparisons too; a division by zero is infinite. Callers check results.
double expression_value(const Expression *expression, const double *values);

#endif
