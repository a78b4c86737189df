// Man pages in mdoc(7). Text goes through put_text, which escapes roff's special characters.
#include "cli/manual.h"
#include "cli/manual_text.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put_character(char c, bool first)
{
    if (c == '\\') {
        printf("\\e");
    } else if (c == '-') {
        printf("\\-"); // a minus sign, which can be copied, not a hyphen
    } else if (first && (c == '.' || c == '\'')) {
        printf("\\&%c", c);
    } else {
        putchar(c);
    }
}

// Prints text on lines of its own, a new one for each sentence.
static void put_text(const char *text)
{
    for (const char *at = text; *at; at++) {
        bool sentence = at > text && at[-1] == '.' && *at == ' ' && isupper((unsigned char)at[1]);
        put_character(sentence ? '\n' : *at, at == text || at[-1] == '\n');
    }
    putchar('\n');
}

// Prints a phrase as a sentence: "Use N threads."
static void put_sentence(const char *phrase)
{
    char text[512];
    size_t length = strlen(phrase), word = strcspn(phrase, " ");
    bool ends = length > 0 && strchr(".!?", phrase[length - 1]);
    snprintf(text, sizeof text, "%s%s", phrase, ends ? "" : ".");
    if (strspn(text, "abcdefghijklmnopqrstuvwxyz") >= word - 1) { // not for names such as glTF
        text[0] = (char)toupper((unsigned char)text[0]);
    }
    put_text(text);
}

// "Ar WxH", for a macro line.
static void put_argument(const char *value)
{
    printf(" Ar ");
    for (; *value; value++) {
        put_character(*value, false);
    }
}

static void put_header(const char *page, const char *doc)
{
    char upper[64];
    snprintf(upper, sizeof upper, "%s", page);
    for (char *c = upper; *c; c++) {
        *c = (char)toupper((unsigned char)*c);
    }
    printf(".Dd %s\n.Dt %s 1\n.Os ramify %s\n", MANUAL_DATE, upper, ramify_version());
    printf(".Sh NAME\n.Nm %s\n.Nd %s\n", page, doc);
}

// ".Ar SCENE | FILE.swc"; several words are all needed unless | stands between them.
static void put_words(const char *before, const char *words, int length)
{
    char text[128], *rest = NULL;
    snprintf(text, sizeof text, "%.*s", length, words);
    bool either = strchr(text, '|');
    for (const char *word = strtok_r(text, " |", &rest); word; word = strtok_r(NULL, " |", &rest)) {
        printf("%s %s", before, word);
        before = either ? " | Ar" : " Ar";
    }
    printf("%s", *words ? "\n" : "");
}

// ".Op Ar COMMAND", or what stands in brackets and then the rest.
static void put_operand(const char *operand)
{
    if (*operand == '[') {
        int length = (int)strcspn(operand, "]");
        put_words(".Op Ar", operand + 1, length - 1);
        operand += length + 1;
        operand += *operand == ' ';
    }
    put_words(".Ar", operand, (int)strlen(operand));
}

static void put_synopsis(CommandId command)
{
    const Command *c = &command_table[command];
    printf(".Sh SYNOPSIS\n.Nm ramify %s\n", c->name);
    for (const Option *o = option_table; o->name; o++) {
        if (!option_is_of(o, command)) {
            continue;
        }
        if (o->letter) {
            printf(".Op Fl %c", o->letter);
        } else {
            printf(".Op Fl \\-%s", o->name);
        }
        if (o->value) {
            put_argument(o->value);
        }
        printf("\n");
    }
    put_operand(c->operand);
}

// Prints the values allowed for an option: words, or a range.
static void put_choices(const Option *option)
{
    char text[256];
    if (option->choices) {
        printf("One of");
        const char *before = " ";
        snprintf(text, sizeof text, "%s", option->choices);
        char *rest = NULL;
        for (const char *word = strtok_r(text, " ", &rest); word;
             word = strtok_r(NULL, " ", &rest)) {
            printf("%s%s", before, word);
            before = ", ";
        }
        printf(".\n");
    } else if (option->type == OPTION_INT || option->type == OPTION_REAL) {
        bool open = option->high >= 1e8; // a bound against nonsense, not documented
        int used = snprintf(text, sizeof text, "%s, %s%.9g",
                            option->type == OPTION_INT ? "A whole number" : "A number",
                            open ? "at least " : "", option->low);
        snprintf(text + used, sizeof text - (size_t)used, open ? "." : " to %.9g.", option->high);
        put_text(text);
    } else if (option->type == OPTION_SET) {
        printf("May be given several times.\n");
    }
}

static void put_options(CommandId command)
{
    printf(".Sh OPTIONS\n.Bl -tag -width Ds\n");
    for (const Option *o = option_table; o->name; o++) {
        if (!option_is_of(o, command)) {
            continue;
        }
        char doc[512];
        printf(".It ");
        if (o->letter) {
            printf("Fl %c , ", o->letter);
        }
        printf("Fl \\-%s", o->name);
        if (o->value) {
            put_argument(o->value);
        }
        printf("\n");
        option_doc(o, command, doc, sizeof doc);
        put_sentence(doc);
        put_choices(o);
    }
    printf(".El\n");
}

static void put_formats(void)
{
    printf(".Sh FILES\nThe formats, by the ending of the file:\n.Bl -tag -width .usda\n");
    for (int i = 0; i < ramify_export_format_count(); i++) {
        printf(".It Pa \\&%s\n", ramify_export_format_ending(i));
        put_sentence(ramify_export_format_doc(i));
    }
    printf(".El\n");
}

static void put_examples(const ManualText *text)
{
    printf(".Sh EXAMPLES\n");
    for (const ManualExample *x = text->examples; x->what; x++) {
        char what[256];
        snprintf(what, sizeof what, "%s:", x->what);
        what[0] = (char)toupper((unsigned char)what[0]);
        if (x > text->examples) {
            printf(".Pp\n");
        }
        put_text(what);
        printf(".Bd -literal -offset indent\n");
        put_text(x->command);
        printf(".Ed\n");
    }
}

static void put_exit_status(const ManualText *text)
{
    const char *failure = text ? text->failure : NULL;
    printf(".Sh EXIT STATUS\n.Bl -tag -width Ds\n.It 0\nDone.\n.It 1\n");
    printf("Failed while running%s%s.\n", failure ? ", or " : "", failure ? failure : "");
    printf(".It 2\nThe command line or the scene is wrong; nothing was done.\n"
           ".It 130\nInterrupted by Ctrl\\-C or SIGTERM.\n.El\n");
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

// own: the page's command; COMMAND_COUNT = the program itself.
static void put_see_also(CommandId own)
{
    const char *names[COMMAND_COUNT] = {NULL};
    int count = 0;
    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (i != (int)own) {
            names[count++] = command_table[i].name;
        }
    }
    qsort(names, (size_t)count, sizeof *names, compare_names);
    printf(".Sh SEE ALSO\n");
    if (own != COMMAND_COUNT) {
        printf(".Xr ramify 1 ,\n");
    }
    for (int i = 0; i < count; i++) {
        printf(".Xr ramify\\-%s 1%s\n", names[i], i + 1 < count ? " ," : "");
    }
    printf(".Pp\nThe scene file, key by key: docs/scene.md, or\n"
           ".Ql ramify schema \\-\\-markdown .\n");
}

static void put_paragraphs(const ManualText *text)
{
    for (const char *const *p = text->paragraphs; *p; p++) {
        printf("%s", p > text->paragraphs ? ".Pp\n" : "");
        put_text(*p);
    }
}

static void put_program(void)
{
    const ManualText *text = manual_text("");
    put_header("ramify", "grow branching things and render them");
    printf(
        ".Sh SYNOPSIS\n.Nm\n.Ar command\n.Op Ar options\n.Nm\n.Fl \\-version\n.Nm\n.Fl \\-help\n");
    printf(".Sh DESCRIPTION\n");
    put_paragraphs(text);
    printf(".Sh COMMANDS\n.Bl -tag -width completion\n");
    for (int i = 0; i < COMMAND_COUNT; i++) {
        const Command *c = &command_table[i];
        printf(".It Cm %s\n", c->name);
        put_sentence(c->doc);
        printf("See\n.Xr ramify\\-%s 1 .\n", c->name);
    }
    printf(".El\n");
    put_exit_status(text);
    put_examples(text);
    put_see_also(COMMAND_COUNT);
    printf(".Sh STANDARDS\nThe method is that of T. Tanaka, T. Ito and T. Kikuchi,\n"
           ".Em Controllable Field Space Colonization .\n");
}

void manual_print(CommandId command, bool program)
{
    if (program) {
        put_program();
        return;
    }
    const Command *c = &command_table[command];
    const ManualText *text = manual_text(c->name);
    char page[64];
    snprintf(page, sizeof page, "ramify-%s", c->name);
    put_header(page, c->doc);
    put_synopsis(command);
    printf(".Sh DESCRIPTION\n");
    if (text) {
        put_paragraphs(text);
    } else {
        put_sentence(c->doc);
        put_text(c->more);
    }
    put_options(command);
    if (command == COMMAND_EXPORT) {
        put_formats();
    }
    put_exit_status(text);
    if (text) {
        put_examples(text);
    }
    put_see_also(command);
}
