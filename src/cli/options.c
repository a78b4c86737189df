#include "cli/options.h"

#include "cli/fail.h"
#include "cli/option_table.h"

#include <stdio.h>
#include <string.h>

bool options_unknown_command(const char *name, RamifyError *e)
{
    const char *names[COMMAND_COUNT];
    char hint[256];
    for (int i = 0; i < COMMAND_COUNT; i++) {
        names[i] = command_table[i].name;
    }
    ramify_suggest(name, names, COMMAND_COUNT, hint, sizeof hint);
    return fail(e, RAMIFY_BAD_INPUT, "unknown command '%.60s'; %s", name, hint);
}

// name: with its dashes, for the message.
static bool unknown_option(CommandId command, const char *name, int length, RamifyError *e)
{
    const char *known[MAX_OPTIONS], *of = command_table[command].name;
    char text[64], hint[512];
    int count = 0;
    snprintf(text, sizeof text, "%.*s", length, name + strspn(name, "-"));
    for (const Option *o = option_table; o->name; o++) {
        if (option_is_of(o, command)) {
            known[count++] = o->name;
        }
    }
    int nearest = ramify_nearest(text, known, count);
    if (nearest >= 0) {
        snprintf(hint, sizeof hint, "did you mean '--%s'?", known[nearest]);
    } else {
        snprintf(hint, sizeof hint, "see ramify %s --help", of);
    }
    return fail(e, RAMIFY_BAD_INPUT, "unknown option '%.60s' of %s; %s", name, of, hint);
}

static bool is_named(const Option *option, const char *word, size_t length)
{
    bool is_long = word[1] == '-';
    size_t dashes = is_long ? 2 : 1;
    const char *name = is_long ? option->name : &option->letter;
    size_t own = is_long ? strlen(name) : option->letter != 0;
    return own > 0 && length == own + dashes && memcmp(word + dashes, name, own) == 0;
}

bool option_given(const Options *options, const char *name)
{
    bool given = false;
    for (int i = 0; option_table[i].name; i++) {
        given = given || (options->given[i] && strcmp(option_table[i].name, name) == 0);
    }
    return given;
}

// Parses argv[*i], which begins with a dash, and if needed the word after it. argv ends with NULL.
static bool parse_option(Options *options, char **argv, int *i, RamifyError *e)
{
    const char *word = argv[*i], *equals = strchr(word, '=');
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    const Option *option = option_table;
    while (option->name &&
           !(option_is_of(option, options->command) && is_named(option, word, length))) {
        option++;
    }
    if (!option->name) {
        return unknown_option(options->command, word, (int)length, e);
    }
    const char *value = equals ? equals + 1 : (option->value ? argv[++*i] : NULL);
    options->given[option - option_table] = true;
    if (value && !option->value) {
        return fail(e, RAMIFY_BAD_INPUT, "--%s takes no value", option->name);
    }
    return (value || !option->value)
               ? option_take(options, option, value, e)
               : fail(e, RAMIFY_BAD_INPUT, "--%s needs a value; write --%s %s", option->name,
                      option->name, option->value);
}

// Parses the words after the command.
static bool parse_words(Options *options, int argc, char **argv, RamifyError *e)
{
    const Command *command = &command_table[options->command];
    const char *wanted = command->operand;
    bool many = strcmp(wanted, "PARTS") == 0;
    int count = 0, most = many ? argc : (*wanted ? (strchr(wanted, ' ') ? 2 : 1) : 0);
    char **operand = argv + 2; // operands move to the front; options have been read by then
    bool valid = true, only_operands = false;
    for (int i = 2; valid && i < argc; i++) {
        if (!only_operands && strcmp(argv[i], "--") == 0) {
            only_operands = true;
        } else if (!only_operands && argv[i][0] == '-' && argv[i][1]) {
            valid = parse_option(options, argv, &i, e);
        } else if (count < most) {
            operand[count++] = argv[i];
        } else {
            valid = fail(e, RAMIFY_BAD_INPUT, "'%.60s' is one word too many; usage: ramify %s %s",
                         argv[i], command->name, wanted);
        }
    }
    options->operand = count > 0 ? operand[0] : NULL;
    options->second = count > 1 ? operand[1] : NULL;
    options->operands = (const char *const *)operand;
    options->operand_count = count;
    bool needed = *wanted >= 'A' && *wanted <= 'Z' && !options->help;
    if (valid && needed && count < (many ? 1 : most)) {
        valid = fail(e, RAMIFY_BAD_INPUT, "no %s is named; usage: ramify %s %s",
                     many        ? "part"
                     : most == 2 ? "pair of pictures"
                                 : (*wanted == 'F' ? "folder" : "scene file"),
                     command->name, *wanted == 'S' ? "SCENE" : wanted);
    }
    return valid;
}

bool options_parse(Options *options, int argc, char **argv, RamifyError *e)
{
    *options = (Options){.command = COMMAND_HELP};
    const char *word = argc > 1 ? argv[1] : "";
    bool valid = true;
    if (argc < 2) {
        valid = fail(e, RAMIFY_BAD_INPUT, "no command; try ramify render SCENE, or ramify --help");
    } else if (word[0] == '-') {
        options->version = strcmp(word, "--version") == 0;
        valid = options->version || strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 ||
                unknown_option(COMMAND_HELP, word, (int)strlen(word), e);
    } else {
        options->command = command_by_name(word);
        valid = options->command == COMMAND_COUNT ? options_unknown_command(word, e)
                                                  : parse_words(options, argc, argv, e);
    }
    return valid;
}
