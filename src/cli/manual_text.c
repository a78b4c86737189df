#include "cli/manual_text.h"

#include <stddef.h>
#include <string.h>

static const ManualText TEXTS[] = {
    {.command = "",
     .paragraphs =
         {"ramify grows branching things: trees, lightning, frost, blood vessels, corals, rivers "
          "and "
          "ridges, veins, cracks. It skins them with closed meshes and takes their picture with "
          "its "
          "own path tracer, all in one process, from one scene file.",
          "A scene file is YAML. Metres, degrees, Y up. What it does not say has a default in "
          "proportion to what it says; unknown keys are errors that name the line, the column and "
          "the nearest key. The same scene and the same seed make the same picture, with any "
          "number "
          "of threads.",
          "What a command finds out goes to the standard output; progress, warnings and errors go "
          "to the standard error. Files are written under another name and renamed when they are "
          "complete, so that a failure never leaves half a file or harms an old one. Ctrl-C ends "
          "a command soon; a picture that has begun is kept as far as it is."},
     .examples = {{"a quick look at a scene",
                   "ramify render pine.yaml --size 640x360 --samples 16 -o look.png"},
                  {"the same, with another height and another seed",
                   "ramify render pine.yaml --set objects.pine.tree.height=9 --set seed=4"},
                  {"what a scene grows, in numbers", "ramify measure pine.yaml"},
                  {"the tree for another program", "ramify export pine.yaml -o pine.glb"}}},
    {.command = "render",
     .paragraphs =
         {"Grows, skins and path traces a scene. Without -o the picture gets the scene's name with "
          ".png and goes to the current folder. Beside it goes an .exr of the same name with "
          "linear "
          "colours, albedo, normal, depth, position, object and number of samples, and the scene's "
          "text and all settings as metadata.",
          "The first picture is on disk after the first pass, one path per pixel, and is brought "
          "up "
          "to date as passes are finished. Rendering ends with the samples, the seconds or the "
          "noise asked for, whichever is met first; Ctrl-C writes what there is.",
          "The options for samples, size, seconds, noise, crop, exposure, denoising and growth "
          "stand "
          "for keys of the scene and go before them."},
     .examples =
         {{"a quick look", "ramify render pine.yaml --size 320x180 --samples 16"},
          {"a final picture, as long as it takes to be clean, an hour at most",
           "ramify render pine.yaml --samples 4096 --noise 0.02 --seconds 3600 -o final.png"},
          {"the upper left quarter only",
           "ramify render pine.yaml --crop 0,0,0.5,0.5 -o quarter.png"},
          {"another hour of the day and a longer lens",
           "ramify render pine.yaml --set sky.sun_elevation=3 --set camera.fov=20"},
          {"the tree when it was young", "ramify render pine.yaml --grow-to 0.3 -o young.png"}}},
    {.command = "turntable",
     .paragraphs =
         {"Makes a film of a scene: the camera goes once around its target. What stays from frame "
          "to frame is grown, skinned and built once. Where the scene has an animation, that is "
          "played, and the camera circles only if --turns says so. docs/animation.md tells more.",
          "-o FILE.mp4 makes a film with ffmpeg, for which it must be installed: H.264, yuv420p, "
          "BT.709; an odd width or height loses its last column or row. The frames wait in "
          "FILE.mp4.frames until all are there. -o NAME-%04d.png, .jpg or .exr writes frames, "
          "with their number, from 0, where %04d stands.",
          "Values with colons between are reached at even steps of time. When the last is the "
          "first, frame i of N shows the time i/N, so that the film loops without a jump; else "
          "i/(N-1), so that it ends on the last value.",
          "After an interruption the same command goes on: a frame that is there, whole and made "
          "from the same settings is skipped. With --start and --end several machines share the "
          "work."},
     .examples =
         {{"a small film", "ramify turntable pine.yaml --size 320x180 --samples 16 -o pine.mp4"},
          {"frames, with a camera that rises and comes closer",
           "ramify turntable pine.yaml --elevation 5:30:5 --dolly 1:0.7:1 -o pine-%04d.png"},
          {"growth while the camera circles",
           "ramify turntable pine.yaml --frames 120 --grow 0:1 -o growth.mp4"},
          {"a summer's day", "ramify turntable pine.yaml --turns 0 --sun 5:19 -o day.mp4"},
          {"one frame of it", "ramify render pine.yaml --frame 12 -o frame.png"}}},
    {.command = "grow",
     .paragraphs = {"Grows the objects of a scene and prints how many nodes each has, without skin "
                    "or picture. "
                    "With -o the out-trees are written: .swc, as neuroscience keeps its trees, "
                    "with one line a "
                    "node (number, type, x, y, z, radius, parent), or .json. Of several objects "
                    "the names are "
                    "put before the ending.",
                    "Of a leaf's veins .png and .exr hold the picture of the veins, of a terrain "
                    "its heights: "
                    ".png with 16 bits, .exr in metres."},
     .examples = {{"count", "ramify grow pine.yaml"},
                  {"the tree as a file", "ramify grow pine.yaml -o pine.swc"},
                  {"the numbers for a script", "ramify grow pine.yaml --json --quiet"}}},
    {.command = "measure",
     .paragraphs =
         {"Prints what botanists, physiologists and geographers count: lengths, radii, angles of "
          "branches, orders after Horton and Strahler, fractal dimension, how well forks keep "
          "Murray's law, drainage and slopes, each where it makes sense.",
          "Where the scene states targets, each is compared with what was measured; the command "
          "fails with status 1 when one is missed. A file in SWC format is measured as an "
          "out-tree, "
          "an ESRI ASCII grid (.asc) as surveyed heights, so that grown and real things are held "
          "against the same numbers."},
     .failure = "a target that the scene states is missed",
     .examples = {{"a table", "ramify measure pine.yaml"},
                  {"the same of a tree in a file",
                   "ramify grow pine.yaml -o pine.swc && ramify measure pine.swc"},
                  {"the numbers for a script", "ramify measure pine.yaml --json --quiet"}}},
    {.command = "export",
     .paragraphs = {"Writes what the scene grows for another program. The ending of the file says "
                    "the format; "
                    "docs/formats.md tells what each holds, and what it cannot hold."},
     .examples = {{"to Blender or a game engine", "ramify export pine.yaml -o pine.glb"},
                  {"with meshes instead of instances, for programs that know none",
                   "ramify export pine.yaml --instances flat -o pine.glb"},
                  {"one object, without its colours",
                   "ramify export pine.yaml --object pine --colors none -o pine.obj"}}},
    {.command = "compare",
     .paragraphs =
         {"Compares two pictures of one kind and prints how far they are apart: root mean square, "
          "maximum and where it is, share of pixels over a threshold, and FLIP, how different they "
          "look. Alike are pictures that are the same in every value, or within the limits given.",
          "The page of --report shows both behind a slider and their difference. Pictures of other "
          "sizes differ; a picture of radiance (EXR, HDR) cannot be compared with display values."},
     .failure = "the pictures are not alike",
     .examples = {{"are they the same to the bit", "ramify compare a.png b.png"},
                  {"near enough, and what is different",
                   "ramify compare a.exr b.exr --max-rmse 0.01 --report page.html"}}},
    {.command = "golden",
     .paragraphs =
         {"Renders every scene NAME.yaml of a folder, pinned to one instruction set, and compares "
          "it with its stored image: NAME.png within limits or to the bit, or, for pictures that "
          "shall be equal but for noise, NAME.exr with mean and variance. The scene's section "
          "golden says which; docs/golden.md explains the three.",
          "Fails with status 1 when a picture differs or is missing, or a scene cannot be "
          "rendered. With --update such pictures are stored instead; what is alike stays as it "
          "is."},
     .failure = "a picture differs from the stored one, or there is none",
     .examples = {{"the first time, and after a change that was meant",
                   "ramify golden golden --update"},
                  {"in continuous integration",
                   "ramify golden golden --report golden.html --junit golden.xml"},
                  {"some of them, to the bit", "ramify golden golden --filter 'pine*' --exact"}}},
    {.command = "info",
     .paragraphs = {"Reads and checks a scene and says what is in it, what it will cost in memory, "
                    "and, if asked, every value that it has, with nothing grown or rendered."},
     .examples = {{"what is in it", "ramify info pine.yaml"},
                  {"every key with its value, also those that the file leaves out",
                   "ramify info pine.yaml --resolved"},
                  {"the keys that --set can change in it", "ramify info pine.yaml --paths"}}},
    {.command = "schema",
     .paragraphs = {"Prints the JSON Schema of scene files, from which editors complete keys, show "
                    "what they mean and mark mistakes; or the same for readers."},
     .examples = {{"for an editor", "ramify schema > ramify.schema.json"},
                  {"every key that has to do with leaves", "ramify schema --paths | grep leaves"}}},
    {.command = "help",
     .paragraphs =
         {"Prints the commands, or the options of one. With --man it prints the man page, "
          "for systems on which it is not installed."},
     .examples = {{"the options of a command", "ramify help render"},
                  {"its man page", "ramify help render --man > ramify-render.1"}}},
    {.command = "completion",
     .paragraphs =
         {"Prints a script that lets the shell complete commands, options, their values, scene "
          "files and, after --set, the keys of the scene that is named before it. "
          "make install puts both scripts where the shells look for them."},
     .examples = {{"for this session of bash", "eval \"$(ramify completion bash)\""},
                  {"for zsh, in a folder of its fpath", "ramify completion zsh > _ramify"}}},
};

const ManualText *manual_text(const char *command)
{
    for (size_t i = 0; i < sizeof TEXTS / sizeof *TEXTS; i++) {
        if (strcmp(TEXTS[i].command, command) == 0) {
            return &TEXTS[i];
        }
    }
    return NULL;
}
