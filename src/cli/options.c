#include "cli/options.h"

#include "cli/fail.h"
#include "cli/option_table.h"

#include <stdio.h>
#include <string.h>

#define MOST_OPTIONS 128 // upper bound of names that a hint considers

bool options_unknown_command(const char *name, RamifyError *e)
{
    const char *names[COMMAND_COUNT];
    char hint[256];
    for (int i = 0; i < COMMAND_COUNT; i++) {
        names[i] = command_at((CommandId)i)->name;
    }
    ramify_suggest(name, names, COMMAND_COUNT, hint, sizeof hint);
    return fail(e, RAMIFY_BAD_INPUT, "unknown command '%.60s'; %s", name, hint);
}

// name: with its dashes, for the message.
static bool unknown_option(CommandId command, const char *name, int length, RamifyError *e)
{
    const char *known[MOST_OPTIONS];
    char text[64], hint[512];
    int count = 0;
    snprintf(text, sizeof text, "%.*s", length, name + strspn(name, "-"));
    const Option *o;
    for (int i = 0; (o = option_at(i)) && count < MOST_OPTIONS; i++) {
        if (option_is_of(o, command)) {
            known[count++] = o->name;
        }
    }
    int nearest = ramify_nearest(text, known, count);
    if (nearest >= 0) {
        snprintf(hint, sizeof hint, "did you mean '--%s'?", known[nearest]);
    } else {
        snprintf(hint, sizeof hint, "see ramify %s --help", command_at(command)->name);
    }
    return fail(e, RAMIFY_BAD_INPUT, "unknown option '%.60s' of %s; %s", name,
                command_at(command)->name, hint);
}

static const Option *find_option(CommandId command, const char *name, size_t length)
{
    const Option *o;
    for (int i = 0; (o = option_at(i)); i++) {
        bool named = name[1] == '-' ? strlen(o->name) == length - 2 &&
                                          strncmp(o->name, name + 2, length - 2) == 0
                                    : o->letter && name[1] == o->letter && length == 2;
        if (named && option_is_of(o, command)) {
            return o;
        }
    }
    return NULL;
}

bool option_given(const Options *options, const char *name)
{
    const Option *o;
    for (int i = 0; (o = option_at(i)); i++) {
        if (options->given >> i & 1 && strcmp(o->name, name) == 0) {
            return true;
        }
    }
    return false;
}

// Parses argv[*i], which begins with a dash, and if needed the word after it.
static bool parse_option(Options *options, int argc, char **argv, int *i, RamifyError *e)
{
    const char *word = argv[*i], *equals = strchr(word, '=');
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    const Option *option = find_option(options->command, word, length);
    if (!option) {
        return unknown_option(options->command, word, (int)length, e);
    }
    options->given |= 1ull << (option - option_at(0));
    if (!option->value) {
        if (equals) {
            return fail(e, RAMIFY_BAD_INPUT, "--%s takes no value", option->name);
        }
        option_take_flag(options, option);
        return true;
    }
    if (equals) {
        return option_take(options, option, equals + 1, e);
    }
    if (*i + 1 >= argc) {
        return fail(e, RAMIFY_BAD_INPUT, "--%s needs a value; write --%s %s", option->name,
                    option->name, option->value);
    }
    return option_take(options, option, argv[++*i], e);
}

// False when the command takes no further operand.
static bool take_operand(Options *options, const char *word)
{
    const char *wanted = command_at(options->command)->operand;
    if (*wanted && !options->operand) {
        options->operand = word;
    } else if (strchr(wanted, ' ') && !options->second) {
        options->second = word;
    } else {
        return false;
    }
    return true;
}

static bool check_operands(const Options *options, RamifyError *e)
{
    const char *wanted = command_at(options->command)->operand;
    bool needed = *wanted >= 'A' && *wanted <= 'Z', two = strchr(wanted, ' ') != NULL;
    if (!needed || (options->operand && (!two || options->second))) {
        return true;
    }
    return fail(e, RAMIFY_BAD_INPUT, "no %s is named; usage: ramify %s %s",
                two ? "pair of pictures" : (*wanted == 'F' ? "folder" : "scene file"),
                command_at(options->command)->name, *wanted == 'S' ? "SCENE" : wanted);
}

static bool parse_words(Options *options, int argc, char **argv, RamifyError *e)
{
    bool only_operands = false;
    for (int i = 2; i < argc; i++) {
        if (!only_operands && strcmp(argv[i], "--") == 0) {
            only_operands = true;
        } else if (!only_operands && argv[i][0] == '-' && argv[i][1]) {
            if (!parse_option(options, argc, argv, &i, e)) {
                return false;
            }
        } else if (!take_operand(options, argv[i])) {
            return fail(e, RAMIFY_BAD_INPUT, "'%.60s' is one word too many; usage: ramify %s %s",
                        argv[i], command_at(options->command)->name,
                        command_at(options->command)->operand);
        }
    }
    return options->help || check_operands(options, e);
}

bool options_parse(Options *options, int argc, char **argv, bool *version, RamifyError *e)
{
    *options = (Options){.command = COMMAND_HELP};
    *version = argc > 1 && strcmp(argv[1], "--version") == 0;
    if (argc < 2) {
        return fail(e, RAMIFY_BAD_INPUT, "no command; try ramify render SCENE, or ramify --help");
    }
    if (*version || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        return true;
    }
    if (argv[1][0] == '-') {
        return unknown_option(COMMAND_HELP, argv[1], (int)strlen(argv[1]), e);
    }
    options->command = command_by_name(argv[1]);
    if (options->command == COMMAND_COUNT) {
        return options_unknown_command(argv[1], e);
    }
    return parse_words(options, argc, argv, e);
}
