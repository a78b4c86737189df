// ramify help, and --help of every command.
#include "cli/command.h"
#include "cli/manual.h"
#include "cli/option_table.h"

#include <stdio.h>
#include <string.h>

#define HELP_WIDTH 100

// The command that a part of a documentation string begins with, "grow: ..."; COMMAND_COUNT = all.
static CommandId part_command(const char *part, size_t *label)
{
    char name[32];
    size_t length = strspn(part, "abcdefghijklmnopqrstuvwxyz");
    if (part[length] != ':' || length >= sizeof name) {
        return COMMAND_COUNT;
    }
    memcpy(name, part, length);
    name[length] = 0;
    *label = length + 2;
    return command_by_name(name);
}

void option_doc(const Option *option, CommandId command, char *text, size_t size)
{
    size_t used = 0;
    text[0] = 0;
    for (const char *part = option->doc; *part && used < size;) {
        const char *end = strstr(part, "; ");
        size_t length = end ? (size_t)(end - part) : strlen(part), label = 0;
        CommandId of = part_command(part, &label);
        if (of == command || of == COMMAND_COUNT) {
            size_t from = of == command ? label : 0;
            const char *before = !used ? "" : from && !strchr(text, ':') ? ": " : "; ";
            int count = snprintf(text + used, size - used, "%s%.*s", before, (int)(length - from),
                                 part + from);
            used += (size_t)count;
        }
        part += length + (end ? 2 : 0);
    }
}

// Prints text word-wrapped at HELP_WIDTH, indented by this many columns.
static void print_wrapped(const char *text, int indent)
{
    int column = indent;
    while (*text) {
        int length = (int)strcspn(text, " ");
        if (column > indent && column + 1 + length > HELP_WIDTH) {
            printf("\n%*s", indent, "");
            column = indent;
        }
        column += printf("%s%.*s", column > indent ? " " : "", length, text);
        text += length + (text[length] == ' ');
    }
    printf("\n");
}

static void print_program_help(void)
{
    printf("ramify grows branching things, skins them and path traces stills of them.\n\n");
    for (int i = 0; i < COMMAND_COUNT; i++) {
        char usage[64];
        snprintf(usage, sizeof usage, "ramify %s %s", command_table[i].name,
                 command_table[i].operand);
        printf("  %-29s", usage);
        if (strlen(usage) > 29) {
            printf("\n%31s", "");
        }
        printf(" %s\n", command_table[i].doc);
    }
    printf("  %-29s %s\n\n", "ramify --version", "print version, commit and libraries");
    printf("'ramify COMMAND --help' lists a command's options, 'ramify help COMMAND --man' prints "
           "its man "
           "page.\nExit status: 0 done, 1 failed while running, 2 bad command line or scene, 130 "
           "interrupted.\n");
}

static void print_command_help(CommandId command)
{
    const Command *c = &command_table[command];
    printf("usage: ramify %s %s%s[options]\n\n%s: %s.\n%s\n", c->name, c->operand,
           *c->operand ? " " : "", c->name, c->doc, c->more);
    for (const Option *o = option_table; o->name; o++) {
        if (option_is_of(o, command)) {
            char name[64], letter[8] = "", doc[512];
            if (o->letter) {
                snprintf(letter, sizeof letter, "-%c, ", o->letter);
            }
            snprintf(name, sizeof name, "%s--%s%s%s", letter, o->name, o->value ? " " : "",
                     o->value ? o->value : "");
            option_doc(o, command, doc, sizeof doc);
            printf("  %-26s ", name);
            print_wrapped(doc, 29);
        }
    }
}

bool command_help(const Options *options, RamifyError *e)
{
    CommandId command = options->command;
    if (options->operand && command == COMMAND_HELP) {
        command = command_by_name(options->operand);
    }
    bool known = command != COMMAND_COUNT || options_unknown_command(options->operand, e);
    if (known && options->man) {
        manual_print(command, !options->operand);
    } else if (known && command == COMMAND_HELP) {
        print_program_help();
    } else if (known) {
        print_command_help(command);
    }
    return known;
}
