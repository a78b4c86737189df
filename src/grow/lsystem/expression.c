#include "grow/lsystem/expression.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    OP_NUMBER,
    OP_VARIABLE,
    OP_NEGATE,
    OP_NOT,
    OP_POWER,
    OP_MULTIPLY,
    OP_DIVIDE,
    OP_ADD,
    OP_SUBTRACT,
    OP_LESS,
    OP_LESS_EQUAL,
    OP_GREATER,
    OP_GREATER_EQUAL,
    OP_EQUAL,
    OP_NOT_EQUAL,
    OP_AND,
    OP_OR
};

// Longer tokens come before their prefixes.
typedef struct Token {
    const char *text;
    int code, rank; // a higher rank binds tighter
} Token;

static const Token BINARY[] = {
    {"||", OP_OR, 1},         {"&&", OP_AND, 2},
    {"<=", OP_LESS_EQUAL, 3}, {">=", OP_GREATER_EQUAL, 3},
    {"==", OP_EQUAL, 3},      {"!=", OP_NOT_EQUAL, 3},
    {"<", OP_LESS, 3},        {">", OP_GREATER, 3},
    {"+", OP_ADD, 4},         {"-", OP_SUBTRACT, 4},
    {"*", OP_MULTIPLY, 5},    {"/", OP_DIVIDE, 5},
    {"^", OP_POWER, 7},
};

enum { RANK_UNARY = 6, MAX_NESTING = 24 };

bool reader_fail(const Reader *reader, Error *e, const char *format, ...)
{
    char message[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    int line = 1, column = 1;
    for (const char *c = reader->text; c < reader->at; c++) {
        column = *c == '\n' ? 1 : column + 1;
        line += *c == '\n';
    }
    return error_set(e, ERROR_INPUT, "%s, line %d, column %d: %s", reader->what, line, column,
                     message);
}

void reader_skip_blanks(Reader *reader)
{
    while (*reader->at == ' ' || *reader->at == '\t') {
        reader->at++;
    }
}

bool reader_name(Reader *reader, char name[NAME_SIZE])
{
    reader_skip_blanks(reader);
    int length = 0;
    while (isalnum((unsigned char)reader->at[length]) || reader->at[length] == '_') {
        length++;
    }
    if (!isalpha((unsigned char)*reader->at) || length >= NAME_SIZE) {
        return false;
    }
    memcpy(name, reader->at, (size_t)length);
    name[length] = '\0';
    reader->at += length;
    return true;
}

typedef struct Compiler {
    Reader *reader;
    const Names *names;
    Expression *expression;
    Error *e;
    int nesting, depth; // depth: current height of the value stack
} Compiler;

// effect: change of the stack's height.
static bool emit(Compiler *c, Operation operation, int effect)
{
    Expression *x = c->expression;
    c->depth += effect;
    if (c->depth > EXPRESSION_STACK) {
        return reader_fail(c->reader, c->e, "the expression is too deep; use fewer parentheses");
    }
    if (!memory_reserve(&x->operation, &x->capacity, x->count + 1, sizeof *x->operation, c->e)) {
        return false;
    }
    x->operation[x->count++] = operation;
    return true;
}

static bool read_binary(Compiler *c, int rank);

static bool read_variable(Compiler *c)
{
    Reader *r = c->reader;
    const char *start = r->at;
    char name[NAME_SIZE];
    if (!reader_name(r, name)) {
        return reader_fail(r, c->e,
                           "'%.1s' starts no number, name or '('; an expression is "
                           "wanted",
                           *r->at ? r->at : " ");
    }
    for (int i = 0; i < c->names->count; i++) {
        if (strcmp(name, c->names->name[i]) == 0) {
            return emit(c, (Operation){.code = OP_VARIABLE, .variable = i}, 1);
        }
    }
    r->at = start;
    return reader_fail(r, c->e,
                       "nothing is called '%s' here; name a parameter of the rule's left "
                       "side or a constant",
                       name);
}

static bool read_primary(Compiler *c)
{
    Reader *r = c->reader;
    reader_skip_blanks(r);
    if (*r->at == '-' || *r->at == '!') {
        int code = *r->at++ == '-' ? OP_NEGATE : OP_NOT;
        return read_binary(c, RANK_UNARY) && emit(c, (Operation){.code = code}, 0);
    }
    if (*r->at == '(') {
        r->at++;
        if (!read_binary(c, 1)) {
            return false;
        }
        reader_skip_blanks(r);
        if (*r->at != ')') {
            return reader_fail(r, c->e, "')' is missing");
        }
        r->at++;
        return true;
    }
    if (isdigit((unsigned char)*r->at) || *r->at == '.') {
        char *end;
        double value = strtod(r->at, &end);
        if (end == r->at) {
            return reader_fail(r, c->e, "'.' alone is no number");
        }
        r->at = end;
        return emit(c, (Operation){.code = OP_NUMBER, .value = value}, 1);
    }
    return read_variable(c);
}

static const Token *next_binary(Reader *r)
{
    reader_skip_blanks(r);
    for (size_t i = 0; i < sizeof BINARY / sizeof BINARY[0]; i++) {
        bool arrow = r->at[0] == '-' && r->at[1] == '>'; // ends a condition
        if (!arrow && strncmp(r->at, BINARY[i].text, strlen(BINARY[i].text)) == 0) {
            return &BINARY[i];
        }
    }
    return NULL;
}

// Precedence climbing over operators of at least this rank; powers associate to the right, others
// to the left.
static bool read_binary(Compiler *c, int rank)
{
    if (++c->nesting > MAX_NESTING) {
        return reader_fail(c->reader, c->e, "the expression is too deep; use fewer parentheses");
    }
    if (!read_primary(c)) {
        return false;
    }
    const Token *token;
    while ((token = next_binary(c->reader)) && token->rank >= rank) {
        c->reader->at += strlen(token->text);
        if (!read_binary(c, token->code == OP_POWER ? token->rank : token->rank + 1) ||
            !emit(c, (Operation){.code = token->code}, -1)) {
            return false;
        }
    }
    c->nesting--;
    return true;
}

bool expression_read(Reader *reader, const Names *names, Expression *expression, Error *e)
{
    Compiler compiler = {reader, names, expression, e, 0, 0};
    return read_binary(&compiler, 1);
}

void expression_clear(Expression *expression)
{
    free(expression->operation);
    *expression = (Expression){0};
}

static double apply(int code, double a, double b)
{
    if (isnan(a) || isnan(b)) { // comparisons too, which would hide it otherwise
        return NAN;
    }
    switch (code) {
    case OP_POWER:
        return a < 0.0 ? NAN : (double)exact_pow((float)a, (float)b);
    case OP_MULTIPLY:
        return a * b;
    case OP_DIVIDE:
        return a / b;
    case OP_ADD:
        return a + b;
    case OP_SUBTRACT:
        return a - b;
    case OP_LESS:
        return a < b;
    case OP_LESS_EQUAL:
        return a <= b;
    case OP_GREATER:
        return a > b;
    case OP_GREATER_EQUAL:
        return a >= b;
    case OP_EQUAL:
        return a == b;
    case OP_NOT_EQUAL:
        return a != b;
    case OP_AND:
        return a != 0.0 && b != 0.0;
    default:
        return a != 0.0 || b != 0.0;
    }
}

double expression_value(const Expression *expression, const double *values)
{
    double stack[EXPRESSION_STACK + 1] = {0};
    int top = 0; // stack[top - 1] is the top value
    for (int64_t i = 0; i < expression->count; i++) {
        const Operation *op = &expression->operation[i];
        if (op->code == OP_NUMBER) {
            stack[top++] = op->value;
        } else if (op->code == OP_VARIABLE) {
            stack[top++] = values[op->variable];
        } else if (op->code == OP_NEGATE) {
            stack[top - 1] = -stack[top - 1];
        } else if (op->code == OP_NOT) {
            stack[top - 1] = isnan(stack[top - 1]) ? NAN : stack[top - 1] == 0.0;
        } else {
            top--;
            stack[top - 1] = apply(op->code, stack[top - 1], stack[top]);
        }
    }
    return stack[0];
}
