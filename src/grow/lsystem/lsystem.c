#include "grow/lsystem/lsystem.h"

#include "base/memory.h"
#include "base/random.h"
#include "grow/lsystem/expression.h"

#include <ctype.h>
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WANTED_NUMBER                                                                          \
    "it must be a number within 3.4e38; keep divisors from 0, powers to positive numbers and " \
    "results small"

enum { MAX_RULES = 64, MAX_NAMES = 64, DEFAULT_MAX_MODULES = 4000000 };

// A module of a successor, its parameters still unevaluated expressions.
typedef struct Pattern {
    char symbol;
    int count;
    const char *at; // position in the text
    Expression parameter[MODULE_MAX_PARAMETERS];
} Pattern;

typedef struct Successor {
    Pattern *pattern; // owned
    int64_t count, capacity;
    Reader place; // position in the text, for errors
} Successor;

typedef struct Rule {
    char symbol;
    int count; // number of parameters
    bool has_condition, has_probability;
    Reader place; // position in the text, for errors
    double probability;
    Expression condition;
    Successor successor;
} Rule;

// Names are the constants, then the parameters of the current rule; values are in the same order.
typedef struct Grammar {
    Rule *rule; // owned
    int64_t count, capacity;
    bool replaced[UCHAR_MAX + 1]; // symbols that stand on a rule's left side
    char name[MAX_NAMES + MODULE_MAX_PARAMETERS][NAME_SIZE];
    double value[MAX_NAMES + MODULE_MAX_PARAMETERS];
    int constants;
} Grammar;

static void successor_clear(Successor *successor)
{
    for (int64_t i = 0; i < successor->count; i++) {
        for (int p = 0; p < successor->pattern[i].count; p++) {
            expression_clear(&successor->pattern[i].parameter[p]);
        }
    }
    free(successor->pattern);
    *successor = (Successor){0};
}

static void grammar_clear(Grammar *grammar)
{
    for (int64_t i = 0; i < grammar->count; i++) {
        expression_clear(&grammar->rule[i].condition);
        successor_clear(&grammar->rule[i].successor);
    }
    free(grammar->rule);
}

// ---- parsing ----

static bool is_symbol(char c)
{
    return isgraph((unsigned char)c) && !strchr("(),:;<>=#", c);
}

static bool ends_rule(char c)
{
    return c == '\0' || c == '\n' || c == ';' || c == '#' || c == '\r';
}

static bool at_arrow(const Reader *r)
{
    return r->at[0] == '-' && r->at[1] == '>';
}

static bool expect(Reader *r, char wanted, Error *e)
{
    reader_skip_blanks(r);
    if (*r->at != wanted) {
        return reader_fail(r, e, "'%c' is missing", wanted);
    }
    r->at++;
    return true;
}

static bool read_parameters(Reader *r, const Names *names, Pattern *pattern, Error *e)
{
    do {
        if (pattern->count == MODULE_MAX_PARAMETERS) {
            return reader_fail(r, e, "'%c' has more than %d parameters", pattern->symbol,
                               MODULE_MAX_PARAMETERS);
        }
        pattern->count++; // from here on it is freed with the pattern
        if (!expression_read(r, names, &pattern->parameter[pattern->count - 1], e)) {
            return false;
        }
        reader_skip_blanks(r);
    } while (*r->at == ',' && r->at++);
    return expect(r, ')', e);
}

// Parses modules as far as they go; brackets must match.
static bool read_successor(Reader *r, const Names *names, Successor *out, Error *e)
{
    int64_t open = 0;
    out->place = *r;
    for (;;) {
        reader_skip_blanks(r);
        if (!is_symbol(*r->at)) {
            break;
        }
        open += *r->at == '[' ? 1 : (*r->at == ']' ? -1 : 0);
        if (open < 0) {
            return reader_fail(r, e, "']' closes no '['");
        }
        if (!memory_reserve(&out->pattern, &out->capacity, out->count + 1, sizeof *out->pattern,
                            e)) {
            return false;
        }
        Pattern *pattern = &out->pattern[out->count++];
        *pattern = (Pattern){.symbol = *r->at, .at = r->at};
        r->at++;
        if (*r->at == '(' && r->at++ && !read_parameters(r, names, pattern, e)) {
            return false;
        }
    }
    return open == 0 || reader_fail(r, e, "'[' is not closed; put a ']' for each '['");
}

// "A(l, w)": the parameters become names after the constants.
static bool read_predecessor(Reader *r, Grammar *grammar, Rule *rule, Error *e)
{
    if (!is_symbol(*r->at) || *r->at == '[' || *r->at == ']') {
        return reader_fail(r, e, "'%.1s' cannot stand on a rule's left side; a symbol must", r->at);
    }
    rule->symbol = *r->at++;
    grammar->replaced[(unsigned char)rule->symbol] = true;
    if (*r->at != '(') {
        return true;
    }
    do {
        r->at++;
        if (rule->count == MODULE_MAX_PARAMETERS) {
            return reader_fail(r, e, "'%c' has more than %d parameters", rule->symbol,
                               MODULE_MAX_PARAMETERS);
        }
        if (!reader_name(r, grammar->name[grammar->constants + rule->count])) {
            return reader_fail(r, e, "a parameter's name is missing; write %c(l, w)", rule->symbol);
        }
        rule->count++;
        reader_skip_blanks(r);
    } while (*r->at == ',');
    return expect(r, ')', e);
}

static bool read_condition(Reader *r, const Names *names, Rule *rule, Error *e)
{
    reader_skip_blanks(r);
    if (*r->at != ':') {
        return true;
    }
    r->at++;
    reader_skip_blanks(r);
    if (*r->at == '*') { // stands for "always" in The Algorithmic Beauty of Plants
        r->at++;
        return true;
    }
    rule->has_condition = true;
    return expression_read(r, names, &rule->condition, e);
}

static bool read_probability(Reader *r, const Grammar *grammar, Rule *rule, Error *e)
{
    reader_skip_blanks(r);
    if (*r->at != ':') {
        return true;
    }
    r->at++;
    Expression x = {0};
    const Names constants = {(const char(*)[NAME_SIZE])grammar->name, grammar->constants};
    bool read = expression_read(r, &constants, &x, e);
    rule->has_probability = true;
    rule->probability = read ? expression_value(&x, grammar->value) : 0.0;
    expression_clear(&x);
    return read &&
           ((rule->probability > 0.0 && isfinite(rule->probability)) ||
            reader_fail(r, e, "the probability is %g; it must be above 0", rule->probability));
}

static bool read_rule(Reader *r, Grammar *grammar, Error *e)
{
    if (grammar->count == MAX_RULES) {
        return reader_fail(r, e, "there are more than %d rules", MAX_RULES);
    }
    if (!memory_reserve(&grammar->rule, &grammar->capacity, grammar->count + 1,
                        sizeof *grammar->rule, e)) {
        return false;
    }
    Rule *rule = &grammar->rule[grammar->count++];
    *rule = (Rule){.place = *r};
    if (!read_predecessor(r, grammar, rule, e)) {
        return false;
    }
    const Names names = {(const char(*)[NAME_SIZE])grammar->name, grammar->constants + rule->count};
    if (!read_condition(r, &names, rule, e)) {
        return false;
    }
    reader_skip_blanks(r);
    if (!at_arrow(r)) {
        return reader_fail(r, e, "'->' is missing; a rule is written A : condition -> BA");
    }
    r->at += 2;
    return read_successor(r, &names, &rule->successor, e) && read_probability(r, grammar, rule, e);
}

// The turtle uses floats.
static bool fits_float(double value)
{
    return fabs(value) <= (double)FLT_MAX;
}

// Parses "name = expression", recognised by its '='; *is is false if the line is none.
static bool read_constant(Reader *r, Grammar *grammar, bool *is, Error *e)
{
    const char *start = r->at;
    char name[NAME_SIZE];
    *is = reader_name(r, name);
    reader_skip_blanks(r);
    *is = *is && r->at[0] == '=' && r->at[1] != '=';
    if (!*is) {
        r->at = start;
        return true;
    }
    r->at++;
    if (grammar->constants == MAX_NAMES) {
        return reader_fail(r, e, "there are more than %d constants", MAX_NAMES);
    }
    Expression x = {0};
    const Names names = {(const char(*)[NAME_SIZE])grammar->name, grammar->constants};
    bool read = expression_read(r, &names, &x, e);
    double value = read ? expression_value(&x, grammar->value) : 0.0;
    expression_clear(&x);
    if (read && !fits_float(value)) {
        const Reader place = {r->text, start, r->what};
        return reader_fail(&place, e, "constant '%s' is %g; " WANTED_NUMBER, name, value);
    }
    if (read) {
        memcpy(grammar->name[grammar->constants], name, sizeof name);
        grammar->value[grammar->constants++] = value;
    }
    return read;
}

static void skip_to_line(Reader *r)
{
    for (;;) {
        if (*r->at == '#') {
            r->at += strcspn(r->at, "\n");
        }
        if (*r->at == '\0' || !strchr(" \t\r\n;", *r->at)) {
            return;
        }
        r->at++;
    }
}

static bool read_grammar(const char *text, Grammar *grammar, Error *e)
{
    Reader r = {text, text, "the L-system's rules"};
    for (skip_to_line(&r); *r.at; skip_to_line(&r)) {
        bool constant;
        if (!read_constant(&r, grammar, &constant, e) ||
            (!constant && !read_rule(&r, grammar, e))) {
            return false;
        }
        reader_skip_blanks(&r);
        if (!ends_rule(*r.at)) {
            return reader_fail(&r, e,
                               "'%.1s' does not belong here; end the rule with ';' or a new "
                               "line",
                               r.at);
        }
    }
    return true;
}

// ---- rewriting ----

// Appends the modules of a successor, evaluated with these values.
static bool append(const Successor *successor, const double *values, ModuleString *string, Error *e)
{
    int64_t count = string->count + successor->count;
    if (!memory_reserve(&string->module, &string->capacity, count, sizeof *string->module, e)) {
        return false;
    }
    for (int64_t i = 0; i < successor->count; i++) {
        const Pattern *pattern = &successor->pattern[i];
        if (!memory_reserve(&string->value, &string->value_capacity,
                            string->value_count + pattern->count, sizeof *string->value, e)) {
            return false;
        }
        string->module[string->count++] =
            (Module){pattern->symbol, (int8_t)pattern->count, string->value_count};
        for (int p = 0; p < pattern->count; p++) {
            double value = expression_value(&pattern->parameter[p], values);
            if (!fits_float(value)) {
                const Reader place = {successor->place.text, pattern->at, successor->place.what};
                return reader_fail(&place, e, "parameter %d of '%c' is %g; " WANTED_NUMBER, p + 1,
                                   pattern->symbol, value);
            }
            string->value[string->value_count++] = value;
        }
    }
    return true;
}

// *undefined is set to the rule if its condition is NaN.
static bool fits(const Rule *rule, const ModuleString *from, int64_t place, const Grammar *grammar,
                 double *values, const Rule **undefined)
{
    const Module *module = &from->module[place];
    if (rule->symbol != module->symbol || rule->count != module->count) {
        return false;
    }
    for (int p = 0; p < rule->count; p++) {
        values[grammar->constants + p] = from->value[module->first + p];
    }
    double met = rule->has_condition ? expression_value(&rule->condition, values) : 1.0;
    if (isnan(met)) {
        *undefined = rule;
    }
    return met != 0.0;
}

// Chooses the rule for a module; NULL = it stays unchanged.
static const Rule *choose(const Grammar *grammar, const ModuleString *from, int64_t place,
                          double *values, uint64_t key, const Rule **undefined)
{
    if (!grammar->replaced[(unsigned char)from->module[place].symbol]) { // most modules, soon done
        return NULL;
    }
    double sum = 0.0;
    for (int64_t i = 0; i < grammar->count; i++) {
        const Rule *rule = &grammar->rule[i];
        if (fits(rule, from, place, grammar, values, undefined)) {
            if (!rule->has_probability && sum == 0.0) {
                return rule;
            }
            sum += rule->probability;
        }
    }
    if (!(sum > 0.0)) {
        return NULL;
    }
    double draw = sum * (double)random_unit(key);
    const Rule *chosen = NULL;
    for (int64_t i = 0; i < grammar->count && draw >= 0.0; i++) {
        const Rule *rule = &grammar->rule[i];
        if (rule->has_probability && fits(rule, from, place, grammar, values, undefined)) {
            chosen = rule;
            draw -= rule->probability;
        }
    }
    return chosen;
}

static bool copy_module(const ModuleString *from, int64_t place, ModuleString *to, Error *e)
{
    const Module *module = &from->module[place];
    if (!memory_reserve(&to->module, &to->capacity, to->count + 1, sizeof *to->module, e) ||
        !memory_reserve(&to->value, &to->value_capacity, to->value_count + module->count,
                        sizeof *to->value, e)) {
        return false;
    }
    to->module[to->count++] = (Module){module->symbol, module->count, to->value_count};
    for (int p = 0; p < module->count; p++) {
        to->value[to->value_count++] = from->value[module->first + p];
    }
    return true;
}

static bool rewrite(const Grammar *grammar, const ModuleString *from, ModuleString *to,
                    uint64_t key, int generation, int64_t most, Error *e)
{
    double values[MAX_NAMES + MODULE_MAX_PARAMETERS];
    memcpy(values, grammar->value, sizeof values);
    for (int64_t i = 0; i < from->count; i++) {
        const Rule *undefined = NULL;
        const Rule *rule =
            choose(grammar, from, i, values, random_key(key, (uint64_t)i), &undefined);
        if (rule) { // evaluates its parameters again, since other rules have overwritten them
            fits(rule, from, i, grammar, values, &undefined);
        }
        if (undefined) {
            return reader_fail(&undefined->place, e,
                               "the condition of '%c' has no value; " WANTED_NUMBER,
                               undefined->symbol);
        }
        if (!(rule ? append(&rule->successor, values, to, e) : copy_module(from, i, to, e))) {
            return error_key(e, "rules");
        }
        if (to->count > most) {
            error_set(e, ERROR_INPUT,
                      "generation %d of the L-system has more than %lld symbols; lower "
                      "generations or the rules' growth",
                      generation, (long long)most);
            return error_key(e, "generations");
        }
    }
    return true;
}

static bool derive(const Grammar *grammar, const LSystemParams *params, const Run *run,
                   ModuleString *string, Error *e)
{
    int64_t most = params->most_modules > 0 ? params->most_modules : DEFAULT_MAX_MODULES;
    ModuleString last = {0}; // its arrays are reused by the generation after the next
    bool done = true;
    for (int g = 1; done && g <= params->generations; g++) {
        ModuleString next = last;
        next.count = next.value_count = 0;
        last = *string;
        *string = next;
        done = run_is_cancelled(run) ? run_cancel_error(e)
                                     : rewrite(grammar, &last, string,
                                               random_key(params->seed, (uint64_t)g), g, most, e);
    }
    module_string_clear(&last);
    return done;
}

static bool read_axiom(const char *text, const Grammar *grammar, ModuleString *string, Error *e)
{
    Reader r = {text, text, "the L-system's axiom"};
    const Names names = {(const char(*)[NAME_SIZE])grammar->name, grammar->constants};
    Successor axiom = {0};
    bool read = read_successor(&r, &names, &axiom, e);
    if (read) {
        r.at += strspn(r.at, " \t\r\n");
        read = *r.at ? reader_fail(&r, e, "'%.1s' is no symbol", r.at)
                     : axiom.count > 0 || reader_fail(&r, e, "it is empty; give it a symbol");
    }
    read = read && append(&axiom, grammar->value, string, e);
    successor_clear(&axiom);
    return read;
}

static bool read_both(const LSystemParams *params, Grammar *grammar, ModuleString *string, Error *e)
{
    if (!read_grammar(params->rules, grammar, e)) {
        return error_key(e, "rules");
    }
    return read_axiom(params->axiom, grammar, string, e) || error_key(e, "axiom");
}

bool lsystem_check(const LSystemParams *params, Error *e)
{
    LSystemParams unchanged = *params;
    unchanged.generations = 0;
    ModuleString string;
    Run run = run_default();
    bool done = lsystem_derive(&unchanged, &run, &string, e);
    module_string_clear(&string);
    return done;
}

bool lsystem_derive(const LSystemParams *params, const Run *run, ModuleString *string, Error *e)
{
    Grammar *grammar = memory_alloc_zero(1, sizeof *grammar, e); // too large for the stack
    *string = (ModuleString){0};
    bool done =
        grammar && read_both(params, grammar, string, e) && derive(grammar, params, run, string, e);
    if (grammar) {
        grammar_clear(grammar);
    }
    free(grammar);
    if (!done) {
        module_string_clear(string);
    }
    return done;
}

void module_string_clear(ModuleString *string)
{
    free(string->module);
    free(string->value);
    *string = (ModuleString){0};
}

double module_parameter(const ModuleString *string, int64_t module, int place, double fallback)
{
    const Module *m = &string->module[module];
    return place < m->count ? string->value[m->first + place] : fallback;
}
