// ramify completion: completion scripts for bash and zsh. The parts generated from the tables of
// commands and options are inserted into fixed parts (completion.bash, completion.zsh).
#include "cli/command.h"
#include "cli/option_table.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

// Embedded while building (see the Makefile).
extern const char completion_bash[], completion_zsh[];

// Completions of a value: "words a b", "file yaml swc" (extensions; none = all files), "output png"
// (the same for a file to be written), "folder", "command", "set", "object", "free" (none).
typedef struct Offer {
    char text[256];
} Offer;

static void offer_add(Offer *offer, const char *word, size_t length)
{
    size_t used = strlen(offer->text);
    snprintf(offer->text + used, sizeof offer->text - used, "%s%.*s", used ? " " : "", (int)length,
             word);
}

static void offer_words(Offer *offer, const char *words)
{
    offer_add(offer, words, strlen(words));
}

// Extensions listed in a text: ".png or .jpg" gives "png jpg".
static void offer_add_endings(Offer *offer, const char *text)
{
    for (const char *dot = strchr(text, '.'); dot; dot = strchr(dot + 1, '.')) {
        size_t length = strspn(dot + 1, "abcdefghijklmnopqrstuvwxyz0123456789.");
        while (length > 0 && dot[length] == '.') { // the end of a sentence
            length--;
        }
        if (length > 0 && (dot == text || strchr(" E(/", dot[-1]))) {
            offer_add(offer, dot + 1, length);
        }
    }
}

static Offer offer_of_option(const Option *option, CommandId command)
{
    Offer offer = {""};
    char doc[512];
    if (option->choices) {
        offer_words(&offer, "words");
        offer_words(&offer, option->choices);
    } else if (option->type == OPTION_OBJECT) {
        offer_words(&offer, "object");
    } else if (option->type == OPTION_SET || option->type == OPTION_VARY) {
        offer_words(&offer, "set");
    } else if (strcmp(option->name, "output") == 0) {
        offer_words(&offer, "output");
        option_doc(option, command, doc, sizeof doc);
        offer_add_endings(&offer, doc);
        for (int i = 0; command == COMMAND_EXPORT && i < ramify_export_format_count(); i++) {
            offer_add_endings(&offer, ramify_export_format_ending(i));
        }
    } else if (strncmp(option->value, "FILE", 4) == 0) {
        offer_words(&offer, "file");
        offer_add_endings(&offer, option->value);
    } else {
        offer_words(&offer, strcmp(option->value, "FOLDER") == 0 ? "folder" : "free");
    }
    return offer;
}

static Offer offer_of_operand(const char *operand)
{
    Offer offer = {""};
    if (strstr(operand, "COMMAND")) {
        offer_words(&offer, "command");
    } else if (strcmp(operand, "FOLDER") == 0) {
        offer_words(&offer, "folder");
    } else if (islower((unsigned char)*operand)) {
        offer_words(&offer, "words");
        for (const char *word = operand; *word; word += strspn(word, "|")) {
            offer_add(&offer, word, strcspn(word, "|"));
            word += strcspn(word, "|");
        }
    } else if (*operand) {
        offer_words(&offer, "file");
        if (strstr(operand, "SCENE")) {
            offer_words(&offer, "yaml");
        }
        offer_add_endings(&offer, operand);
    } else {
        offer_words(&offer, "free");
    }
    return offer;
}

// ---- bash ----

static void bash_options(CommandId command)
{
    printf("    %s) echo \"", command_table[command].name);
    const char *before = "";
    for (const Option *o = option_table; o->name; o++) {
        if (option_is_of(o, command)) {
            printf("%s--%s", before, o->name);
            if (o->letter) {
                printf(" -%c", o->letter);
            }
            before = " ";
        }
    }
    printf("\" ;;\n");
}

static void bash_values(CommandId command)
{
    const char *name = command_table[command].name;
    for (const Option *o = option_table; o->name; o++) {
        if (option_is_of(o, command) && o->value) {
            printf("    \"%s --%s\"", name, o->name);
            if (o->letter) {
                printf(" | \"%s -%c\"", name, o->letter);
            }
            printf(") echo \"%s\" ;;\n", offer_of_option(o, command).text);
        }
    }
    printf("    \"%s \") echo \"%s\" ;;\n", name,
           offer_of_operand(command_table[command].operand).text);
}

static void print_bash(void)
{
    printf("# What bash completes after \"ramify\"; written by ramify completion bash.\n\n"
           "_ramify_commands=\"");
    for (int i = 0; i < COMMAND_COUNT; i++) {
        printf("%s%s", i ? " " : "", command_table[i].name);
    }
    printf("\"\n\n_ramify_options() { # COMMAND\n    case $1 in\n");
    for (int i = 0; i < COMMAND_COUNT; i++) {
        bash_options((CommandId)i);
    }
    printf(
        "    esac\n}\n\n_ramify_offer() { # COMMAND OPTION, or COMMAND and \"\" for its operand\n"
        "    case \"$1 $2\" in\n");
    for (int i = 0; i < COMMAND_COUNT; i++) {
        bash_values((CommandId)i);
    }
    printf("    esac\n}\n\n%s", completion_bash);
}

// ---- zsh ----

// Escapes for '...' and, in brackets, for _arguments.
static void zsh_text(const char *text)
{
    for (; *text; text++) {
        if (*text == '\'') {
            printf("'\\''");
        } else {
            printf(strchr("[]:\\", *text) ? "\\%c" : "%c", *text);
        }
    }
}

static void zsh_option(const Option *o, CommandId command)
{
    char doc[512], names[96] = "";
    bool repeats = o->type == OPTION_SET || o->type == OPTION_VARY || o->type == OPTION_OBJECT ||
                   o->type == OPTION_DIRECTIVE;
    option_doc(o, command, doc, sizeof doc);
    if (o->letter) {
        snprintf(names, sizeof names, "'(-%c --%s)'{-%c,--%s%s}'", o->letter, o->name, o->letter,
                 o->name, o->value ? "=" : "");
    } else {
        snprintf(names, sizeof names, "'%s--%s%s", repeats ? "*" : "", o->name,
                 o->value ? "=" : "");
    }
    printf("            %s[", names);
    zsh_text(doc);
    printf("]");
    if (o->value) {
        printf(":");
        zsh_text(o->value);
        printf(": _ramify_offer %s", offer_of_option(o, command).text);
    }
    printf("' \\\n");
}

static void zsh_command(CommandId command)
{
    const Command *c = &command_table[command];
    printf("    %s)\n        _arguments \\\n", c->name);
    for (const Option *o = option_table; o->name; o++) {
        if (option_is_of(o, command)) {
            zsh_option(o, command);
        }
    }
    const char *operand = c->operand;
    bool several = strchr(operand, ' ') || strcmp(operand, "PARTS") == 0;
    if (*operand) {
        printf("            '%s", several ? "*:" : "1:");
        zsh_text(operand);
        printf(": _ramify_offer %s'\n", offer_of_operand(operand).text);
    } else {
        printf("            '*: :'\n");
    }
    printf("        ;;\n");
}

static void print_zsh(void)
{
    printf("#compdef ramify\n# What zsh completes after \"ramify\"; written by ramify completion "
           "zsh.\n\n_ramify_commands=(\n");
    for (int i = 0; i < COMMAND_COUNT; i++) {
        printf("    '%s:", command_table[i].name);
        zsh_text(command_table[i].doc);
        printf("'\n");
    }
    printf(")\n\n%s", completion_zsh);
    printf("_ramify_command() {\n    case $1 in\n");
    for (int i = 0; i < COMMAND_COUNT; i++) {
        zsh_command((CommandId)i);
    }
    printf("    esac\n}\n\n_ramify \"$@\"\n");
}

bool command_completion(const Options *options, RamifyError *e)
{
    const char *shell = options->operand ? options->operand : "";
    if (strcmp(shell, "bash") == 0) {
        print_bash();
    } else if (strcmp(shell, "zsh") == 0) {
        print_zsh();
    } else {
        return fail(e, RAMIFY_BAD_INPUT, "%s%.60s%s; it must be bash or zsh",
                    *shell ? "no completion for '" : "no shell is named", shell, *shell ? "'" : "");
    }
    return true;
}
