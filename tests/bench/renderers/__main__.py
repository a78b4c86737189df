"""Draws scenes with ramify, Cycles and Mitsuba 3, checks that they converge to the same image, and compares their efficiency.

Exit status: 0; 1 when converged images differ, times or errors cannot be told or a renderer fails; 2 for wrong options.
"""

import argparse
import contextlib
import json
import os
import sys
import time
from pathlib import Path

from . import geometry, llvm, pictures, report, sky
from .ramify import Ramify
from .measures import Unmeasurable, mean_and_error, reference_of
from .results import Drawings, all_figures, disagreeing
from .scenes import SCENES, Job
from .worker import RendererFailed, Worker

SAMPLES = (16, 64)  # of which the error is told
REFERENCE_SAMPLES = 128  # of each of the images that make a reference
MEAN_ERROR = 0.0015  # to which the mean of a reference is made certain, by further images
MOST_REFERENCES = 12
FIRST_REFERENCE_SEED = 1001
BODY = Path(__file__).parents[3] / "scenes" / "meshes" / "hare.obj"


def scene_names(text):
    names = [name for name in text.split(",") if name]
    unknown = [name for name in names if name not in SCENES]
    if unknown or not names:
        raise argparse.ArgumentTypeError(f"no scene {', '.join(unknown) or 'named'}; the scenes are {', '.join(SCENES)}")
    return names


def image_size(text):
    width, _, height = text.partition("x")
    if not (width.isdigit() and height.isdigit() and int(width) and int(height)):
        raise argparse.ArgumentTypeError(f"'{text}' is no size; 320x180 is one")
    return int(width), int(height)


def reference_samples(text):
    if not text.isdigit() or int(text) <= min(SAMPLES) or (int(text) > 64 and int(text) % 64):
        raise argparse.ArgumentTypeError(f"'{text}' samples: {min(SAMPLES) + 1} to 64, or a multiple of 64")
    return int(text)


def repeats(text):
    if not text.isdigit() or int(text) < 2:
        raise argparse.ArgumentTypeError(f"'{text}' repeats: at least 2, whose difference is the reference's noise")
    return int(text)


def parse(arguments):
    parser = argparse.ArgumentParser(prog="bench-renderers", description=__doc__.splitlines()[0])
    parser.add_argument("--ramify", type=Path, required=True, help="the binary")
    parser.add_argument("--work", type=Path, required=True, help="folder for meshes and images")
    parser.add_argument("--scenes", type=scene_names, default=list(SCENES), help="comma-separated; all by default")
    parser.add_argument("--sky", type=Path, help="another panorama for the scenes under an HDR sky: .hdr")
    parser.add_argument("--size", type=image_size, default=(320, 180), help="of the images, 320x180 by default")
    parser.add_argument("--repeats", type=repeats, default=3, help="of each image, 3 by default; the least time counts")
    parser.add_argument("--reference", type=reference_samples, default=REFERENCE_SAMPLES, help="samples of its images")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)), help="of each renderer; all by default")
    parser.add_argument("--pictures", type=Path, help="draw each scene in equal time, side by side: .png or .jpg")
    parser.add_argument("--json", type=Path, help="write the numbers to this file too")
    options = parser.parse_args(arguments)
    if options.sky and not options.sky.is_file():
        parser.error(f"no sky {options.sky}")
    return options


def prepare(options):
    """Makes what the scenes are made of; what is there already is kept, unless the binary is newer."""
    options.work.mkdir(parents=True, exist_ok=True)
    picture = options.sky or options.work / "sky.hdr"
    if not options.sky:
        sky.write_hdr(picture, sky.panorama())
    done = options.work / "meshes-made"
    if not done.exists() or done.stat().st_mtime < options.ramify.stat().st_mtime:
        print("making the meshes", flush=True)
        geometry.make_meshes(options.ramify.resolve(), options.work, BODY)
        done.touch()
    return picture.resolve()


def start(job, options, stack):
    """The renderers with the job's scene loaded, which is not timed. stack: an ExitStack that ends them."""

    def worker(name):
        made = Worker(name, options.work / f"{name}.log", {"DRJIT_LIBLLVM_PATH": llvm.find()})
        stack.callback(made.close)
        made.load(job)
        return made

    return [Ramify(job, options.ramify.resolve()), worker("cycles"), worker("mitsuba3")]


def draw_rounds(renderers, samples, reference, rounds):
    """Drawings by renderer. One round after another, so that what else the machine does meets all alike."""
    found = {renderer.name: Drawings() for renderer in renderers}
    for renderer in renderers:
        renderer.draw(samples[0], 0)  # compiles kernels, builds acceleration structures
    for turn in range(rounds):
        for count in (*samples, reference):
            first = FIRST_REFERENCE_SEED if count == reference else 1
            for renderer in renderers:
                found[renderer.name].add(count, renderer.draw(count, first + turn))
    return found


def refine(renderer, drawings, reference):
    """Draws further images for the reference until its mean is certain, or there are MOST_REFERENCES."""
    images = drawings.images[reference]
    while len(images) < MOST_REFERENCES:
        mean, error = mean_and_error(reference_of(images))
        if error <= MEAN_ERROR * mean:
            break
        drawings.add(reference, renderer.draw(reference, FIRST_REFERENCE_SEED + len(images)))


def compare(name, picture, options):
    """Figures by renderer, of one scene, and a row of pictures (None unless asked for)."""
    width, height = options.size
    job = Job(SCENES[name], str(options.work.resolve()), str(picture), width, height, options.threads)
    samples = [count for count in SAMPLES if count < options.reference]
    with contextlib.ExitStack() as stack:
        renderers = start(job, options, stack)
        found = draw_rounds(renderers, samples, options.reference, options.repeats)
        for renderer in renderers:
            refine(renderer, found[renderer.name], options.reference)
        figures, line = all_figures(found, samples, options.reference), None
        if options.pictures:
            converged = reference_of(found[renderers[0].name].images[options.reference]).image
            line, counts = pictures.draw_row(renderers, figures, converged)
            print(f"{name}: samples in equal time: " + ", ".join(f"{who} {n}" for who, n in counts.items()), flush=True)
    return figures, line


def main(arguments):
    options = parse(arguments)
    if not llvm.find():
        print(llvm.MISSING, file=sys.stderr)
        return 2
    if os.getloadavg()[0] > 0.5 * options.threads:
        print(f"the machine is busy (load {os.getloadavg()[0]:.1f}): times will be noisy; more --repeats help")
    picture, results, rows, begin = prepare(options), {}, [], time.monotonic()
    for name in options.scenes:
        try:
            results[name], line = compare(name, picture, options)
            rows.append(line)
            print(report.proof_line(name, results[name]), flush=True)
        except Unmeasurable as reason:
            print(f"bench-renderers: {name} is left out: {reason}", file=sys.stderr)
    if results:
        print("\n" + report.table(results))
    print(f"\n{options.size[0]} x {options.size[1]} pixels, {options.threads} threads, {time.monotonic() - begin:.0f} s in all")
    if options.pictures and rows:
        pictures.write(options.pictures, rows)
    if options.json and results:
        options.json.write_text(json.dumps(report.as_json(results), indent=1) + "\n")
    different = [name for name in results if disagreeing(results[name])]
    if different:
        print(f"bench-renderers: converged images differ: {', '.join(different)}", file=sys.stderr)
    return 1 if different or len(results) < len(options.scenes) else 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except RendererFailed as failure:
        print(f"bench-renderers: {failure}", file=sys.stderr)
        sys.exit(1)
