#include "cli/manual_text.h"

#include <stddef.h>
#include <string.h>

static const ManualText TEXTS[] = {
    {.command = "",
     .paragraphs =
         {"ramify grows branching things: trees, lightning, frost, blood vessels, corals, rivers "
          "and ridges, veins, cracks. It skins them with closed meshes and renders them with its "
          "own path tracer, all in one process, from one scene file.",
          "A scene file is YAML. Metres, degrees, Y up. Keys that are not given have defaults in "
          "proportion to those given; unknown keys are errors that name the line, the column and "
          "the nearest key. The same scene and the same seed make the same picture, with any "
          "number of threads.",
          "Results go to standard output; progress, warnings and errors go to standard error. "
          "Files are written under a temporary name and renamed when they are complete, so that a "
          "failure leaves no partial file and an existing one unchanged. Ctrl-C ends a command "
          "soon; an unfinished picture is kept as it is."},
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
          "The first picture is on disk after the first pass, one path per pixel, and is updated "
          "after further passes. Rendering stops when the number of samples, the time or the "
          "noise limit is reached, whichever comes first; Ctrl-C writes the picture so far.",
          "The .exr holds all that a rendering needs to go on. It is written every minute "
          "(--checkpoint) and at the end; after an interruption of any kind, kill -9 and power "
          "cuts included, the same command with --resume makes the same bits as one without it. "
          "--add-samples takes more samples for a finished picture. SCENE may itself be a picture "
          "that ramify has rendered: its metadata hold the scene with every setting.",
          "The options for samples, size, seconds, noise, crop, exposure, denoising and growth "
          "set keys of the scene and override the file."},
     .examples =
         {{"a quick look", "ramify render pine.yaml --size 320x180 --samples 16"},
          {"a final picture, as long as it takes to be clean, an hour at most",
           "ramify render pine.yaml --samples 4096 --noise 0.02 --seconds 3600 -o final.png"},
          {"go on after an interruption", "ramify render pine.yaml -o night.png --resume"},
          {"the upper left quarter only",
           "ramify render pine.yaml --crop 0,0,0.5,0.5 -o quarter.png"},
          {"another hour of the day and a longer lens",
           "ramify render pine.yaml --set sky.sun_elevation=3 --set camera.fov=20"},
          {"the tree when it was young", "ramify render pine.yaml --grow-to 0.3 -o young.png"}}},
    {.command = "turntable",
     .paragraphs =
         {"Renders an animation of a scene: the camera orbits its target once. Static parts are "
          "grown, skinned and built once. If the scene has an animation, it is played, and the "
          "camera orbits only if --turns is given. See docs/animation.md.",
          "-o FILE.mp4 encodes a video with ffmpeg, which must be installed: H.264, yuv420p, "
          "BT.709; an odd width or height loses its last column or row. The frames are kept in "
          "FILE.mp4.frames until all are finished. -o NAME-%04d.png, .jpg or .exr writes single "
          "frames, with their number, from 0, in place of %04d.",
          "Values separated by colons are reached at equal steps of time. If the last equals the "
          "first, frame i of N shows the time i/N, so that the animation loops without a jump; "
          "else i/(N-1), so that it ends on the last value.",
          "After an interruption the same command resumes: frames that exist, complete and made "
          "with the same settings, are skipped, and a frame that was saved on the way "
          "(--checkpoint) goes on with the same bits. --start and --end distribute the work over "
          "several machines."},
     .examples =
         {{"a small film", "ramify turntable pine.yaml --size 320x180 --samples 16 -o pine.mp4"},
          {"frames, with a camera that rises and comes closer",
           "ramify turntable pine.yaml --elevation 5:30:5 --dolly 1:0.7:1 -o pine-%04d.png"},
          {"growth while the camera circles",
           "ramify turntable pine.yaml --frames 120 --grow 0:1 -o growth.mp4"},
          {"a summer's day", "ramify turntable pine.yaml --turns 0 --sun 5:19 -o day.mp4"},
          {"one frame of it", "ramify render pine.yaml --frame 12 -o frame.png"}}},
    {.command = "grow",
     .paragraphs =
         {"Grows the objects of a scene and prints how many nodes each has, without "
          "skin or picture. With -o the out-trees are written: .swc, as neuroscience "
          "keeps its trees, with one line per node (number, type, x, y, z, radius, "
          "parent), or .json. If there are several objects, their names precede the "
          "extension.",
          "A .png or .exr holds a picture of a leaf's veins, or the heights of a terrain: "
          ".png with 16 bits, .exr in metres.",
          "A terrain with the key tiles is a world cut into tiles of finer ground. --tile makes "
          "one or "
          "a range of them; each is made alone, on any machine, and neighbours share the samples "
          "at "
          "their border, with the same bits."},
     .examples = {{"count", "ramify grow pine.yaml"},
                  {"the tree as a file", "ramify grow pine.yaml -o pine.swc"},
                  {"the numbers for a script", "ramify grow pine.yaml --json --quiet"}}},
    {.command = "measure",
     .paragraphs =
         {"Prints what botanists, physiologists and geographers count: lengths, radii, angles of "
          "branches, orders after Horton and Strahler, fractal dimension, how well forks keep "
          "Murray's law, drainage and slopes, each where applicable.",
          "If the scene has targets, each is compared with its measure; the exit status is 1 if "
          "one is missed. A file in SWC format is measured as an out-tree, a table of cylinders "
          "that TreeQSM fitted to a laser scan (.qsm, .txt, .csv) also, an ESRI ASCII grid (.asc) "
          "as surveyed heights, so that grown and real data are compared by the same measures."},
     .failure = "a target of the scene is missed",
     .examples = {{"a table", "ramify measure pine.yaml"},
                  {"the same of a tree in a file",
                   "ramify grow pine.yaml -o pine.swc && ramify measure pine.swc"},
                  {"the numbers for a script", "ramify measure pine.yaml --json --quiet"}}},
    {.command = "fit",
     .paragraphs =
         {"Finds values of numbers of a scene with which its measures meet its targets: for "
          "instance the height of a crown and the length of its internodes that give the angles "
          "and the ratios of lengths of real trees. Each evaluation grows and measures the objects "
          "that targets name, and prints one line; * marks the best so far.",
          "The misfit of a scene is 0 if all targets are met. Each missed target adds e^2 / (1 + "
          "e), where e is the distance from its range in half widths of the range (of a range with "
          "one end: relative to that end).",
          "The search goes around the scene's own values first, then through the whole ranges, "
          "then "
          "around the best found (NLopt's COBYLA, DIRECT-L, COBYLA again, and Sbplx). It draws no "
          "random numbers: the same command finds the same scene, with any number of threads. "
          "Keys of whole numbers get whole numbers.",
          "-o writes the scene file with the best values in place, its comments and layout as they "
          "were."},
     .failure = "a target is still missed after all evaluations",
     .examples = {{"two numbers of a pine, until its targets are met",
                   "ramify fit pine.yaml --vary objects.pine.tree.height=6:12 --vary "
                   "objects.pine.tree.radii.flare=0.3:1.2 -o fitted.yaml"},
                  {"with a picture of the way",
                   "ramify fit pine.yaml --vary objects.pine.tree.height=4:20:log --until "
                   "evaluations --evaluations 12 --picture way.svg"}}},
    {.command = "export",
     .paragraphs = {"Writes what the scene grows for another program. The file's extension "
                    "selects the format; docs/formats.md describes what each can hold."},
     .examples = {{"to Blender or a game engine", "ramify export pine.yaml -o pine.glb"},
                  {"with meshes instead of instances, for programs that know none",
                   "ramify export pine.yaml --instances flat -o pine.glb"},
                  {"one object, without its colours",
                   "ramify export pine.yaml --object pine --colors none -o pine.obj"}}},
    {.command = "merge",
     .paragraphs =
         {"Joins the .exr files of renderings of one scene with different crops (--crop), "
          "different samples (--sample-range), or both, into one picture and its .exr. The "
          "settings "
          "in the files prove that they belong together: only the crop, the samples and the limit "
          "of time may differ. Every sample of every pixel must be in exactly one part.",
          "Sums over samples are exact, so the result has the bits of the picture rendered at "
          "once, "
          "however the samples were divided and in whatever order the files are named.",
          "A pixel's value does not depend on the crop, so the result has the bits of the picture "
          "rendered at once. With --noise, regions are judged in tiles of 16 x 16 pixels, counted "
          "from the upper left of the whole picture: crops that end at multiples of 16 pixels keep "
          "the same bits then too.",
          "Machines whose processors differ may round differently; --isa sse4.2 makes them agree."},
     .failure = "pixels are missing",
     .examples = {{"two halves, rendered on two machines",
                   "ramify render pine.yaml --crop 0,0,1,0.5 -o top.exr; "
                   "ramify render pine.yaml --crop 0,0.5,1,1 -o low.exr; "
                   "ramify merge top.exr low.exr -o pine.exr"},
                  {"the samples on two machines",
                   "ramify render pine.yaml --samples 64 --sample-range 0:32 -o a.exr; "
                   "ramify render pine.yaml --samples 64 --sample-range 32:64 -o b.exr; "
                   "ramify merge a.exr b.exr -o pine.exr"}}},
    {.command = "develop",
     .paragraphs =
         {"Develops the film in the .exr of a finished rendering once more, as a "
          "darkroom does: with another exposure, view, contrast, white balance, bloom, "
          "sharpening or grain, with or without the denoiser. Only keys of film that come "
          "after the samples can change. Without a change the result has the bits of the "
          "picture that the rendering wrote; the .exr stays as it is."},
     .examples = {{"warmer, with the grain of a film",
                   "ramify develop pine.exr --set film.white_balance=5600 --set film.grain=0.012 "
                   "-o pine-film.png"},
                  {"with an exposure of half a stop",
                   "ramify develop pine.exr --exposure 0.5 -o light.png"}}},
    {.command = "batch",
     .paragraphs =
         {"Renders the tiles of a picture (--tiles), also by ranges of their samples "
          "(--sample-ranges), or the frames of an animation (--frames) as tasks that need not know "
          "of each other, on one machine or on the many of a cluster, and "
          "joins them. The result has the same bits as the picture rendered at once. "
          "docs/clusters.md tells more.",
          "The batch is a folder, by default NAME.batch beside the output, that all machines must "
          "see under the same name: plan (the command), scene.yaml (the scene's text), parts "
          "(finished tiles or frames), logs, and the engine's files. A part gets its name when it "
          "is complete. What is done is which parts are there: a task may be killed, repeated, or "
          "run twice at any time. A tile or frame is saved every minute (--checkpoint), so that "
          "its next task goes on with it.",
          "Run again, the same command renders what is missing; so does submit FOLDER. status "
          "FOLDER prints what is done and missing. run FOLDER --parts A-B renders some parts in "
          "this process: it is what all engines call. merge FOLDER makes the output.",
          "--engine local runs the tasks here, --jobs of them at once. slurm submits an array of "
          "tasks, with memory and time as estimated, and a merge that follows however they end and "
          "names what is missing; a task that reaches the end of its time saves what it has begun "
          "and is queued again. openjd writes template.yaml, an Open Job Description, into the "
          "folder, for the schedulers of other farms.",
          "Machines whose processors differ may round differently; --isa sse4.2 makes them agree."},
     .failure = "tiles or frames are missing",
     .examples = {{"two tiles, both at once", "ramify batch pine.yaml --tiles 2x1 --jobs 2"},
                  {"what is done", "ramify batch status pine.batch"},
                  {"a film's frames on a cluster, on nodes with 16 processors",
                   "ramify batch pine.yaml --frames 0-719 -o pine-%04d.png --folder turn.batch "
                   "--engine slurm --threads 16 --partition render --sbatch=--mail-type=END"},
                  {"a template for other farms",
                   "ramify batch pine.yaml --tiles 2x1 -o farm.png --engine openjd"}}},
    {.command = "replay",
     .paragraphs =
         {"Traces one sample of one pixel again and prints every ray of its path: where it begins "
          "and ends, the object and the material that it meets, the path's throughput, and the "
          "light that the end adds to the sample, what shadow rays bring included. With the .exr "
          "in place of the scene it is the path of that very picture. For finding out why a pixel "
          "is too bright."},
     .examples = {{"a bright dot in a picture", "ramify replay pine.yaml --pixel 20,15"}}},
    {.command = "compare",
     .paragraphs =
         {"Compares two pictures of one kind and prints their differences: root mean square, "
          "maximum and its position, share of pixels over a threshold, and FLIP, a perceptual "
          "difference. Pictures are alike if every value is equal, or within the limits given.",
          "The page of --report shows both with a slider, and their difference. Pictures of "
          "different sizes differ; a picture of radiance (EXR, HDR) cannot be compared with "
          "display values."},
     .failure = "the pictures are not alike",
     .examples = {{"are they the same to the bit", "ramify compare a.png b.png"},
                  {"near enough, and what is different",
                   "ramify compare a.exr b.exr --max-rmse 0.01 --report page.html"}}},
    {.command = "golden",
     .paragraphs =
         {"Renders every scene NAME.yaml of a folder, pinned to one instruction set, and compares "
          "it with its stored image: NAME.png within limits or to the bit, or, for pictures that "
          "are equal except for noise, NAME.exr with mean and variance. The scene's section "
          "golden selects the mode; see docs/golden.md.",
          "The exit status is 1 if a picture differs or is missing, or a scene cannot be "
          "rendered. --update stores such pictures instead; pictures that are alike stay "
          "unchanged."},
     .failure = "a picture differs from the stored one, or there is none",
     .examples = {{"the first time, and after a change that was meant",
                   "ramify golden golden --update"},
                  {"in continuous integration",
                   "ramify golden golden --report golden.html --junit golden.xml"},
                  {"some of them, to the bit", "ramify golden golden --filter 'pine*' --exact"}}},
    {.command = "info",
     .paragraphs = {"Reads and checks a scene and prints its contents, its memory requirement by "
                    "counts and optionally all its values, without growing or rendering anything.",
                    "--estimate does a part of the rendering: it grows and builds the scene, "
                    "traces some thousand paths and develops a small picture. From that it tells "
                    "peak memory and processor time of `ramify render`. On an idle machine, "
                    "tracing takes the time divided by the number of processors."},
     .examples = {{"what is in it", "ramify info pine.yaml"},
                  {"what a large picture will take, on a machine with 16 GB",
                   "ramify info pine.yaml --estimate --size 7680x4320 --memory 20G"},
                  {"every key with its value, also those that the file leaves out",
                   "ramify info pine.yaml --resolved"},
                  {"the keys that --set can change in it", "ramify info pine.yaml --paths"}}},
    {.command = "species",
     .paragraphs = {"Lists the species of the library: the name that a scene gives to a tree's or "
                    "climber's species, the Latin name, the form, the range of height that its "
                    "targets state, and the months in which leaves and organs are there."},
     .examples = {{"which of them flower", "ramify species | grep blossom"}}},
    {.command = "schema",
     .paragraphs = {"Prints the JSON Schema of scene files, which editors use to complete and "
                    "explain keys and to mark errors; or the same as a reference for readers."},
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
          "files and, after --set, the keys of the scene named before it. make install puts both "
          "scripts where the shells find them."},
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
