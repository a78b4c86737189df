#include "cli/options.h"

#include "cli/fail.h"
#include "cli/option_table.h"

#include <errno.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BIT(command) (1u << (command))
#define GROWS                                                                                  \
    (BIT(COMMAND_RENDER) | BIT(COMMAND_TURNTABLE) | BIT(COMMAND_GROW) | BIT(COMMAND_MEASURE) | \
     BIT(COMMAND_EXPORT))
#define SCENES (GROWS | BIT(COMMAND_INFO))
#define COMPARES (BIT(COMMAND_COMPARE) | BIT(COMMAND_GOLDEN))
#define EVERY \
    (SCENES | COMPARES | BIT(COMMAND_SCHEMA) | BIT(COMMAND_COMPLETION) | BIT(COMMAND_HELP))
#define RENDERS (BIT(COMMAND_RENDER) | BIT(COMMAND_TURNTABLE))
#define TURNS BIT(COMMAND_TURNTABLE)
#define AT(member) offsetof(Options, member)

static const Option OPTIONS[] = {
    {.name = "output",
     .value = "FILE",
     .offset = AT(output),
     .type = OPTION_TEXT,
     .commands = RENDERS | BIT(COMMAND_GROW) | BIT(COMMAND_EXPORT),
     .letter = 'o',
     .doc =
         "what to write; render: .png or .jpg with the .exr beside it; turntable: .mp4, or .png, "
         ".jpg or .exr with the frame's number in the name, as in oak-%04d.png; grow: .swc, .json, "
         ".graphml or, of a leaf's veins or a terrain's heights, .png or .exr (heights also .asc); "
         "export: the format by its ending"},
    {.name = "frames",
     .value = "N",
     .offset = AT(turntable.frames),
     .low = 1,
     .high = 1000000,
     .type = OPTION_INT,
     .commands = TURNS,
     .doc = "how many frames; as the scene's animation says, else 72"},
    {.name = "fps",
     .value = "F",
     .offset = AT(turntable.fps),
     .low = 0.001,
     .high = 1000,
     .type = OPTION_REAL,
     .commands = TURNS,
     .doc = "frames a second; as the scene's animation says, else 24"},
    {.name = "start",
     .value = "I",
     .offset = AT(turntable.start),
     .low = 0,
     .high = 999999,
     .type = OPTION_INT,
     .commands = TURNS,
     .doc = "the first frame to render; they are counted from 0"},
    {.name = "end",
     .value = "I",
     .offset = AT(end),
     .low = 0,
     .high = 999999,
     .type = OPTION_INT,
     .commands = TURNS,
     .doc = "the last frame to render"},
    {.name = "turns",
     .value = "N",
     .offset = AT(turns),
     .low = -1000,
     .high = 1000,
     .type = OPTION_REAL,
     .commands = TURNS,
     .doc = "circles of the camera about its target, negative the other way; 1, but 0 where the "
            "scene has an animation"},
    {.name = "spin",
     .offset = AT(spin),
     .type = OPTION_YES,
     .commands = TURNS,
     .doc = "turn everything under a camera, a sky and lamps that stay"},
    {.name = "elevation",
     .value = "A:B:...",
     .offset = AT(turntable.elevation),
     .low = -89,
     .high = 89,
     .type = OPTION_KEYS,
     .commands = TURNS,
     .doc = "degrees of the camera above its target over time, as in 10:30:10"},
    {.name = "dolly",
     .value = "A:B:...",
     .offset = AT(turntable.dolly),
     .low = 0.001,
     .high = 1000,
     .type = OPTION_KEYS,
     .commands = TURNS,
     .doc = "factor on the camera's distance over time, as in 1:0.7"},
    {.name = "grow",
     .value = "A:B:...",
     .offset = AT(turntable.grow),
     .low = 0,
     .high = 1,
     .type = OPTION_KEYS,
     .commands = TURNS,
     .doc = "how much of the growth shows over time, as in 0:1"},
    {.name = "sun",
     .value = "A:B:...",
     .offset = AT(turntable.sun),
     .low = 0,
     .high = 24,
     .type = OPTION_KEYS,
     .commands = TURNS,
     .doc = "hours of the day that the sun stands at over time, as in 5:19"},
    {.name = "ease",
     .value = "HOW",
     .offset = AT(ease),
     .choices = "linear smooth",
     .type = OPTION_TEXT,
     .commands = TURNS,
     .doc = "how all of these go from value to value; smooth for elevation and dolly, linear for "
            "the rest"},
    {.name = "vary-noise",
     .offset = AT(vary_noise),
     .type = OPTION_YES,
     .commands = TURNS,
     .doc = "another pattern of noise in every frame, as film grain"},
    {.name = "frame",
     .value = "I",
     .offset = AT(frame),
     .low = 0,
     .high = 999999,
     .type = OPTION_INT,
     .commands = BIT(COMMAND_RENDER),
     .doc = "the scene as frame I of its turntable or animation shows it"},
    {.name = "time",
     .value = "T",
     .offset = AT(time),
     .low = 0,
     .high = 1,
     .type = OPTION_REAL,
     .commands = BIT(COMMAND_RENDER),
     .doc = "the same at a time, 0 the beginning, 1 the end"},
    {.name = "samples",
     .value = "N",
     .offset = AT(samples),
     .low = 1,
     .high = 1 << 24,
     .type = OPTION_INT,
     .commands = RENDERS,
     .doc = "paths per pixel"},
    {.name = "size",
     .value = "WxH",
     .offset = AT(size),
     .low = 1,
     .high = 65536,
     .type = OPTION_SIZE,
     .commands = RENDERS,
     .doc = "width and height in pixels"},
    {.name = "seconds",
     .value = "T",
     .offset = AT(seconds),
     .low = 0,
     .high = 1e8,
     .type = OPTION_REAL,
     .commands = RENDERS,
     .doc = "stop tracing after T seconds; 0 = no limit"},
    {.name = "noise",
     .value = "E",
     .offset = AT(noise),
     .low = 0,
     .high = 1,
     .type = OPTION_REAL,
     .commands = RENDERS,
     .doc = "a part is done when its relative error is below E; 0 = off"},
    {.name = "crop",
     .value = "x0,y0,x1,y1",
     .offset = AT(crop),
     .low = 0,
     .high = 1,
     .type = OPTION_CROP,
     .commands = RENDERS,
     .doc = "only this part of the picture, in 0..1 from the top left"},
    {.name = "exposure",
     .value = "E",
     .offset = AT(exposure),
     .low = -50,
     .high = 50,
     .type = OPTION_REAL,
     .commands = RENDERS,
     .doc = "brightness of the picture in stops: each doubles it"},
    {.name = "denoise",
     .offset = AT(denoise),
     .type = OPTION_YES,
     .commands = RENDERS,
     .doc = "remove the noise that is left from the .png"},
    {.name = "no-denoise",
     .offset = AT(denoise),
     .type = OPTION_NO,
     .commands = RENDERS,
     .doc = "leave it in"},
    {.name = "isa",
     .value = "NAME",
     .offset = AT(isa),
     .choices = "sse2 sse4.2 avx avx2 avx512",
     .type = OPTION_TEXT,
     .commands = RENDERS | BIT(COMMAND_GOLDEN),
     .doc = "instruction set of the ray tracer, such as sse4.2: the same bits on every machine; "
            "golden: sse4.2 if not given, native for the machine's own"},
    {.name = "grow-to",
     .value = "T",
     .offset = AT(grow_to),
     .low = 0,
     .high = 1,
     .type = OPTION_REAL,
     .commands = GROWS,
     .doc = "show growth as it was at this share of its time, 0..1"},
    {.name = "set",
     .value = "PATH=VALUE",
     .offset = AT(overrides),
     .type = OPTION_SET,
     .commands = SCENES,
     .doc = "change the scene: --set camera.fov=35 --set objects.oak.tree.height=9"},
    {.name = "object",
     .value = "NAME",
     .offset = AT(objects),
     .type = OPTION_OBJECT,
     .commands = BIT(COMMAND_EXPORT),
     .doc = "write only this object; may be repeated"},
    {.name = "instances",
     .value = "HOW",
     .offset = AT(instances),
     .choices = "auto nodes gpu flat",
     .type = OPTION_TEXT,
     .commands = BIT(COMMAND_EXPORT),
     .doc = "what .glb makes of instances: nodes, gpu (EXT_mesh_gpu_instancing), flat (copies) or "
            "auto (nodes up to 4096 of them, then gpu)"},
    {.name = "colors",
     .value = "WHAT",
     .offset = AT(colors),
     .choices = "all pattern growth none",
     .type = OPTION_TEXT,
     .commands = BIT(COMMAND_EXPORT),
     .doc = "what colours of vertices show: pattern, growth (red: birth, green: radius), none or "
            "all"},
    {.name = "tube-sides",
     .value = "N",
     .offset = AT(tube_sides),
     .low = 3,
     .high = 64,
     .type = OPTION_INT,
     .commands = BIT(COMMAND_EXPORT),
     .doc = "sides of the tubes that twigs and hairs become; 6"},
    {.name = "resolved",
     .offset = AT(resolved),
     .type = OPTION_YES,
     .commands = BIT(COMMAND_INFO),
     .doc = "print the whole scene with every default as YAML"},
    {.name = "markdown",
     .offset = AT(markdown),
     .type = OPTION_YES,
     .commands = BIT(COMMAND_SCHEMA),
     .doc = "print the reference for readers instead, as docs/scene.md"},
    {.name = "paths",
     .offset = AT(paths),
     .type = OPTION_YES,
     .commands = BIT(COMMAND_SCHEMA) | BIT(COMMAND_INFO),
     .doc = "print the paths of all keys instead, as --set takes them; info: of this scene"},
    {.name = "man",
     .offset = AT(man),
     .type = OPTION_YES,
     .commands = BIT(COMMAND_HELP),
     .doc = "print the man page instead"},
    {.name = "max-rmse",
     .value = "X",
     .offset = AT(max_rmse),
     .low = 0,
     .high = 1e9,
     .type = OPTION_REAL,
     .commands = COMPARES,
     .doc = "most root mean square difference of pictures that are alike"},
    {.name = "threshold",
     .value = "T",
     .offset = AT(threshold),
     .low = 0,
     .high = 1e9,
     .type = OPTION_REAL,
     .commands = COMPARES,
     .doc = "a pixel fails when a channel differs by more than T; 0.012 if not given"},
    {.name = "max-failing",
     .value = "S",
     .offset = AT(max_failing),
     .low = 0,
     .high = 1,
     .type = OPTION_REAL,
     .commands = COMPARES,
     .doc = "most pixels that fail in pictures that are alike, as a share of 1"},
    {.name = "exact",
     .offset = AT(exact),
     .type = OPTION_YES,
     .commands = BIT(COMMAND_GOLDEN),
     .doc = "every value must be the same, whatever the scenes say"},
    {.name = "statistical",
     .offset = AT(statistical),
     .type = OPTION_YES,
     .commands = BIT(COMMAND_GOLDEN),
     .doc = "equal but for noise, whatever the scenes say; stored images are EXRs"},
    {.name = "series",
     .value = "N",
     .offset = AT(series),
     .low = 1,
     .high = 1 << 24,
     .type = OPTION_INT,
     .commands = BIT(COMMAND_GOLDEN),
     .doc = "other seeds for what is compared statistically"},
    {.name = "update",
     .offset = AT(update),
     .type = OPTION_YES,
     .commands = BIT(COMMAND_GOLDEN),
     .doc = "store what is missing or differs"},
    {.name = "filter",
     .value = "GLOB",
     .offset = AT(filter),
     .type = OPTION_TEXT,
     .commands = BIT(COMMAND_GOLDEN),
     .doc = "only scenes of such names, with * and ?"},
    {.name = "report",
     .value = "FILE.html",
     .offset = AT(report),
     .type = OPTION_TEXT,
     .commands = COMPARES,
     .doc = "write a page that shows pictures, differences and numbers"},
    {.name = "junit",
     .value = "FILE.xml",
     .offset = AT(junit),
     .type = OPTION_TEXT,
     .commands = BIT(COMMAND_GOLDEN),
     .doc = "write the results as JUnit XML"},
    {.name = "threads",
     .value = "N",
     .offset = AT(threads),
     .low = 1,
     .high = 1024,
     .type = OPTION_INT,
     .commands = SCENES | BIT(COMMAND_GOLDEN),
     .doc = "use N threads; the result does not depend on it"},
    {.name = "json",
     .offset = AT(json),
     .type = OPTION_YES,
     .commands = SCENES | COMPARES,
     .doc = "print the numbers as JSON to stdout"},
    {.name = "quiet",
     .offset = AT(quiet),
     .type = OPTION_YES,
     .commands = SCENES | BIT(COMMAND_GOLDEN),
     .letter = 'q',
     .doc = "say nothing but errors"},
    {.name = "help",
     .offset = AT(help),
     .type = OPTION_YES,
     .commands = EVERY,
     .letter = 'h',
     .doc = "print the help of the command"},
};

#define OPTION_COUNT ((int)(sizeof OPTIONS / sizeof OPTIONS[0]))

static const Command COMMANDS[COMMAND_COUNT] = {
    [COMMAND_RENDER] = {"render", "SCENE", "make a picture of a scene file",
                        "Writes SCENE's name with .png to the current folder if there is no -o, "
                        "and beside it the .exr with\nlinear colours, albedo, normal, depth, "
                        "position, object and samples. Ctrl-C writes what there is.\n"},
    [COMMAND_TURNTABLE] = {"turntable", "SCENE", "make a film of a scene file",
                           "Grows, skins and builds once what stays from frame to frame. Writes "
                           "SCENE's name with .mp4 to the current\nfolder if there is no -o. Run "
                           "again after an interruption it skips the frames that are finished.\n"},
    [COMMAND_GROW] = {"grow", "SCENE", "grow a scene's trees only",
                      "With -o writes the out-trees; of several, the objects' names are put "
                      "before the ending.\n"},
    [COMMAND_MEASURE] = {"measure", "SCENE|FILE.swc|FILE.asc",
                         "measure what a scene grows, or an out-tree in a file",
                         "Exit status 1 when a target that the scene states is missed.\n"},
    [COMMAND_EXPORT] = {"export", "SCENE", "write a scene as another program's file",
                        "The ending of -o FILE says the format; docs/formats.md tells what each "
                        "holds.\n"},
    [COMMAND_COMPARE] = {"compare", "A B", "compare two pictures",
                         "Alike is what is the same to the last bit, or within --max-rmse and "
                         "--max-failing where they are\ngiven. Exit status 1 when they are not "
                         "alike.\n"},
    [COMMAND_GOLDEN] = {"golden", "FOLDER", "compare a folder's scenes with their stored images",
                        "Renders every NAME.yaml and compares it with NAME.png, or NAME.exr where "
                        "the scene's golden.mode\nis statistical. Exit status 1 when one is not "
                        "alike. docs/golden.md tells more.\n"},
    [COMMAND_INFO] = {"info", "SCENE", "say what a scene file holds", ""},
    [COMMAND_SCHEMA] = {"schema", "", "print what may stand in a scene file, as JSON Schema", ""},
    [COMMAND_COMPLETION] = {"completion", "bash|zsh", "print what lets a shell complete commands",
                            "bash: eval \"$(ramify completion bash)\". zsh: put the output into a "
                            "file _ramify in a folder of fpath.\n"},
    [COMMAND_HELP] = {"help", "[COMMAND]", "explain a command", ""},
};

Options options_default(void)
{
    return (Options){.command = COMMAND_HELP,
                     .seconds = -1.0,
                     .noise = -1.0,
                     .exposure = (double)NAN,
                     .grow_to = -1.0,
                     .crop = {-1.0f, -1.0f, -1.0f, -1.0f},
                     .denoise = -1,
                     .max_rmse = -1.0,
                     .threshold = -1.0,
                     .max_failing = -1.0,
                     .turns = (double)NAN,
                     .end = -1,
                     .frame = -1,
                     .time = -1.0};
}

const Option *option_at(int index)
{
    return index < OPTION_COUNT ? &OPTIONS[index] : NULL;
}

bool option_is_of(const Option *option, CommandId command)
{
    return option->commands & BIT(command);
}

const Command *command_at(CommandId command)
{
    return &COMMANDS[command];
}

CommandId command_by_name(const char *name)
{
    int i = 0;
    while (i < COMMAND_COUNT && strcmp(COMMANDS[i].name, name) != 0) {
        i++;
    }
    return (CommandId)i;
}

static bool unknown_command(const char *name, RamifyError *e)
{
    const char *names[COMMAND_COUNT];
    char hint[256];
    for (int i = 0; i < COMMAND_COUNT; i++) {
        names[i] = COMMANDS[i].name;
    }
    ramify_suggest(name, names, COMMAND_COUNT, hint, sizeof hint);
    return fail(e, RAMIFY_BAD_INPUT, "unknown command '%.60s'; %s", name, hint);
}

// name: with its dashes, for the message.
static bool unknown_option(CommandId command, const char *name, int length, RamifyError *e)
{
    const char *known[OPTION_COUNT];
    char text[64], hint[512];
    int count = 0;
    snprintf(text, sizeof text, "%.*s", length, name + strspn(name, "-"));
    for (int i = 0; i < OPTION_COUNT; i++) {
        if (OPTIONS[i].commands & BIT(command)) {
            known[count++] = OPTIONS[i].name;
        }
    }
    int nearest = ramify_nearest(text, known, count);
    if (nearest >= 0) {
        snprintf(hint, sizeof hint, "did you mean '--%s'?", known[nearest]);
    } else {
        snprintf(hint, sizeof hint, "see ramify %s --help", COMMANDS[command].name);
    }
    return fail(e, RAMIFY_BAD_INPUT, "unknown option '%.60s' of %s; %s", name,
                COMMANDS[command].name, hint);
}

static bool read_number(const char **text, double low, double high, double *value)
{
    char *end;
    errno = 0;
    *value = strtod(*text, &end);
    bool valid = end != *text && *value >= low && *value <= high;
    *text = end;
    return valid;
}

static bool read_size(const char *text, const Option *option, int *size)
{
    double width, height;
    if (!read_number(&text, option->low, option->high, &width) || (*text != 'x' && *text != 'X')) {
        return false;
    }
    text++;
    if (!read_number(&text, option->low, option->high, &height) || *text || floor(width) != width ||
        floor(height) != height || width * height > 1e8) {
        return false;
    }
    size[0] = (int)width;
    size[1] = (int)height;
    return true;
}

static bool read_crop(const char *text, const Option *option, float *crop)
{
    for (int i = 0; i < 4; i++) {
        double value;
        if (!read_number(&text, option->low, option->high, &value) || *text != (i < 3 ? ',' : 0)) {
            return false;
        }
        text += i < 3;
        crop[i] = (float)value;
    }
    return crop[0] < crop[2] && crop[1] < crop[3];
}

static bool read_keys(const char *text, const Option *option, RamifyKeys *keys)
{
    keys->count = 0;
    do {
        if (keys->count == RAMIFY_MOST_KEYS ||
            !read_number(&text, option->low, option->high, &keys->value[keys->count])) {
            return false;
        }
        keys->count++;
    } while (*text++ == ':');
    return text[-1] == 0;
}

static bool bad_value(const Option *option, const char *text, RamifyError *e)
{
    switch (option->type) {
    case OPTION_SIZE:
        return fail(e, RAMIFY_BAD_INPUT,
                    "--size %.60s; it must be WIDTHxHEIGHT, each 1 to 65536, at most 100 "
                    "million pixels",
                    text);
    case OPTION_CROP:
        return fail(e, RAMIFY_BAD_INPUT,
                    "--crop %.60s; it must be x0,y0,x1,y1 in 0..1 with x0 < x1 and y0 < y1", text);
    case OPTION_KEYS:
        return fail(e, RAMIFY_BAD_INPUT,
                    "--%s %.60s; it must be 1 to %d numbers of %.9g to %.9g with colons between",
                    option->name, text, (int)RAMIFY_MOST_KEYS, option->low, option->high);
    default:
        return fail(e, RAMIFY_BAD_INPUT, "--%s %.60s; it must be a %s of %.9g to %.9g",
                    option->name, text, option->type == OPTION_INT ? "whole number" : "number",
                    option->low, option->high);
    }
}

static bool add_override(Options *options, const char *text, RamifyError *e)
{
    if (options->override_count == MAX_OVERRIDES) {
        return fail(e, RAMIFY_BAD_INPUT, "more than %d --set; put some into the scene file",
                    MAX_OVERRIDES);
    }
    options->overrides[options->override_count++] = text;
    return true;
}

static bool add_object(Options *options, const char *text, RamifyError *e)
{
    if (options->object_count == MAX_OBJECTS) {
        return fail(e, RAMIFY_BAD_INPUT, "more than %d --object; leave it out to write all of them",
                    MAX_OBJECTS);
    }
    options->objects[options->object_count++] = text;
    return true;
}

static bool take_value(Options *options, const Option *option, const char *text, RamifyError *e)
{
    char *at = (char *)options + option->offset;
    const char *rest = text;
    double value;
    switch (option->type) {
    case OPTION_TEXT:
        if (!*text) {
            return fail(e, RAMIFY_BAD_INPUT, "--%s is empty; it must be a %s", option->name,
                        option->value);
        }
        memcpy(at, &text, sizeof text);
        return true;
    case OPTION_SET:
        return add_override(options, text, e);
    case OPTION_OBJECT:
        return add_object(options, text, e);
    case OPTION_SIZE:
        return read_size(text, option, (int *)(void *)at) || bad_value(option, text, e);
    case OPTION_CROP:
        return read_crop(text, option, (float *)(void *)at) || bad_value(option, text, e);
    case OPTION_KEYS:
        return read_keys(text, option, (RamifyKeys *)(void *)at) || bad_value(option, text, e);
    default:
        break;
    }
    if (!read_number(&rest, option->low, option->high, &value) || *rest) {
        return bad_value(option, text, e);
    }
    if (option->type == OPTION_REAL) {
        memcpy(at, &value, sizeof value);
        return true;
    }
    int whole = (int)value;
    memcpy(at, &whole, sizeof whole);
    return (double)whole == value || bad_value(option, text, e);
}

static void take_flag(Options *options, const Option *option)
{
    char *at = (char *)options + option->offset;
    if (option->offset == AT(denoise)) {
        int value = option->type == OPTION_YES;
        memcpy(at, &value, sizeof value);
    } else {
        bool value = true;
        memcpy(at, &value, sizeof value);
    }
}

static const Option *find_option(CommandId command, const char *name, size_t length)
{
    for (int i = 0; i < OPTION_COUNT; i++) {
        const Option *o = &OPTIONS[i];
        bool named = name[1] == '-' ? strlen(o->name) == length - 2 &&
                                          strncmp(o->name, name + 2, length - 2) == 0
                                    : o->letter && name[1] == o->letter && length == 2;
        if (named && o->commands & BIT(command)) {
            return o;
        }
    }
    return NULL;
}

// argv[*i] begins with a dash: takes it and, where needed, the word after it.
static bool parse_option(Options *options, int argc, char **argv, int *i, RamifyError *e)
{
    const char *word = argv[*i], *equals = strchr(word, '=');
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    const Option *option = find_option(options->command, word, length);
    if (!option) {
        return unknown_option(options->command, word, (int)length, e);
    }
    if (!option->value) {
        if (equals) {
            return fail(e, RAMIFY_BAD_INPUT, "--%s takes no value", option->name);
        }
        take_flag(options, option);
        return true;
    }
    if (equals) {
        return take_value(options, option, equals + 1, e);
    }
    if (*i + 1 >= argc) {
        return fail(e, RAMIFY_BAD_INPUT, "--%s needs a value; write --%s %s", option->name,
                    option->name, option->value);
    }
    return take_value(options, option, argv[++*i], e);
}

// False when the command takes no more.
static bool take_operand(Options *options, const char *word)
{
    const char *wanted = COMMANDS[options->command].operand;
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
    const char *wanted = COMMANDS[options->command].operand;
    bool needed = *wanted >= 'A' && *wanted <= 'Z', two = strchr(wanted, ' ') != NULL;
    if (!needed || (options->operand && (!two || options->second))) {
        return true;
    }
    return fail(e, RAMIFY_BAD_INPUT, "no %s is named; usage: ramify %s %s",
                two ? "pair of pictures" : (*wanted == 'F' ? "folder" : "scene file"),
                COMMANDS[options->command].name, *wanted == 'S' ? "SCENE" : wanted);
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
                        argv[i], COMMANDS[options->command].name,
                        COMMANDS[options->command].operand);
        }
    }
    return options->help || check_operands(options, e);
}

bool options_parse(Options *options, int argc, char **argv, bool *version, RamifyError *e)
{
    *options = options_default();
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
        return unknown_command(argv[1], e);
    }
    return parse_words(options, argc, argv, e);
}
