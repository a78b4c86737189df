#!/usr/bin/env python3
"""Lets allocations, readings, writings and starts of a process or thread fail in turn, while small scenes are rendered,
exported and read. Each time ramify must end with the right files, or with one error and the files as they were before.

usage: faults.py RAMIFY SHIM [--places | --all] [--case NAME] [--family NAME] [--jobs N]

By default a sample that takes less than a minute: the first calls of each family, then every k-th for a prime k. --places: of
the calls of all cases that have the same eight places on top of their stacks the first one, once and all from it on. --all:
every call. RAMIFY may be built with AddressSanitizer, which then finds leaks and wrong accesses after a fault. Prints
"ok CASE_FAMILY" or "not ok CASE_FAMILY", and what went wrong with the places of the calls that failed.
"""
import argparse
import array
import collections
import concurrent.futures
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SECONDS = 20  # a run may take; some tenths are usual
FAMILIES = ("memory", "read", "write", "process")
PLACES, PLACE_TEXT, MOST_TRACED = 64, 1536, 1 << 20  # as in shim.c
LEAKED = 99
OLD = b"what was there before\n"

TREE = """
camera: {position: [0, 1.5, 7], target: [0, 1.4, 0]}
film: {width: 32, height: 18, denoise: %s}
render: {samples: 1, max_depth: 2}
sky: {kind: constant}
objects:
  - name: bush
    tree: {height: 3, grown_by: attractors, leaves: {max_count: 20}, roots: {count: 0}, radii: {tip: 0.006},
           crown: {lobes: 0, growth: {levels: [{attractors: 40}]}}, trunk: {growth: {levels: [{attractors: 60}]}},
           skin: {curve_radius: 0.02}}
  - {name: floor, ground: {grass_tufts: 0, fallen_leaves: 0, radius: 20, flat_radius: 1}}
"""
LIT = """
camera: {position: [0, 1.5, 7], target: [0, 1.4, 0]}
film: {width: 32, height: 18}
render: {samples: 1, max_depth: 2}
sky: {kind: environment, file: sky.hdr}
materials: [{name: painted, kind: diffuse, texture: paint.png}]
objects: [{name: pebble, material: painted, mesh: {file: pebble.obj}}]
"""
NET = "objects: [{name: net, outtree: {envelope: [{shape: sphere}, {shape: sphere}], voxel: 0.2, growth: {levels: [{attractors: 20}]}}}]\n"
BALL = "objects: [{name: ball, shape: {envelope: [{shape: sphere}], voxel: 0.3}}]\n"
MESH = "objects: [{name: pebble, mesh: {file: pebble.%s}}]\n"
CLOUD = """
objects:
  - name: net
    outtree: {envelope: [{shape: mesh, file: ball.vdb}], voxel: 0.2, growth: {levels: [{attractors: 20}]}}
"""
NEURON = "objects: [{name: cell, skeleton: {file: cell.swc, skin: {levels: 1}}}]\n"
RIVERS = "objects: [{name: land, terrain: {resolution: 32, rivers: {file: cell.swc}}}]\n"
PEBBLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nf 1/1 3/1 2/1\nf 1/1 2/1 4/1\nf 2/1 3/1 4/1\nf 3/1 1/1 4/1\n"
CELL = "1 1 0 0 0 1 -1\n2 3 5 1 0 0.6 1\n3 3 9 4 1 0.4 2\n4 3 9 -4 0 0.4 2\n5 3 14 -5 2 0.3 4\n"

# name: (files to read, what makes them, arguments, files to write)
CASES = {
    "render": ({"scene.yaml": TREE % "true"}, "render scene.yaml -o x.png -q", ["x.png", "x.exr"]),
    "render_lit": ({"scene.yaml": LIT, "sky.hdr": None, "paint.png": None, "pebble.obj": None},
                   "render scene.yaml -o x.jpg -q --no-preview", ["x.jpg", "x.exr"]),
    "resume": ({"scene.yaml": TREE % "false", "x.exr": None},
               "render scene.yaml -o x.png -q --resume --no-preview", ["x.png", "x.exr"]),
    "export_obj": ({"scene.yaml": TREE % "false"}, "export scene.yaml -o x.obj -q", ["x.obj", "x.mtl"]),
    "export_glb": ({"scene.yaml": TREE % "false"}, "export scene.yaml -o x.glb -q", ["x.glb"]),
    "export_usda": ({"scene.yaml": TREE % "false"}, "export scene.yaml -o x.usda -q", ["x.usda"]),
    "export_vdb": ({"scene.yaml": NET}, "export scene.yaml -o x.vdb -q", ["x.vdb"]),
    "read_ply": ({"scene.yaml": MESH % "ply", "pebble.ply": None}, "export scene.yaml -o x.stl -q", ["x.stl"]),
    "read_obj": ({"scene.yaml": MESH % "obj", "pebble.obj": None}, "export scene.yaml -o x.stl -q", ["x.stl"]),
    "read_vdb": ({"scene.yaml": CLOUD, "ball.vdb": None}, "export scene.yaml -o x.swc -q", ["x.swc"]),
    "read_swc": ({"scene.yaml": NEURON, "cell.swc": CELL}, "export scene.yaml -o x.stl -q", ["x.stl"]),
    "read_rivers": ({"scene.yaml": RIVERS, "cell.swc": CELL}, "export scene.yaml -o x.exr -q", ["x.exr"]),
    "measure": ({"scene.yaml": TREE % "false"}, "measure scene.yaml", []),
    "turntable": ({"scene.yaml": TREE % "false"}, "turntable scene.yaml -o x-%02d.png -q --frames 2",
                  ["x-00.png", "x-01.png"]),
    "golden": ({"scene.yaml": TREE % "false", "scene.png": None}, "golden . -q --report x.html --junit x.xml",
               ["x.html", "x.xml"]),
}
# The error of the command, or of a library that ends the program itself: GCC's OpenMP, libjpeg.
ERROR = re.compile(r"(ramify: (?!warning)|libgomp: |[^ :]+(:\d+){0,2}: |Insufficient memory )\S.{5,}")
# What outside libraries do wrong, out of our reach: what happens, the function that could not allocate.
KNOWN = [("signal 11", "TableRepMap", "OpenImageIO's table of strings does not check what it allocates"),
         ("leaks", "TopologyRefiner", "OpenSubdiv loses a level of refinement that it could not complete"),
         ("leaks", "DeepCopy", "OpenVDB loses the nodes that it copied before one failed"),
         ("leaks", "setValueOnlyAndCache", "OpenVDB loses a node that its table could not take"),
         ("signal 11", "stealNodes", "OpenVDB allocates while it destroys a tree, where no exception may pass"),
         ("signal 11", "blosc", "c-blosc, which compresses VDB files, does not check what it allocates")]
# libpng's own words beside it; LeakSanitizer's of threads that a fork does not have.
NOISE = re.compile(r"libpng error: .*|==\d+==Running thread .*|")
WARNING = re.compile(r"(ramify: warning: |[^ :]+(:\d+:\d+)?: warning: )")


def make_inputs(ramify, folder):
    """Files of each kind that cases read."""
    def run(*arguments):
        subprocess.run([ramify, *arguments], cwd=folder, check=True, capture_output=True)
    (folder / "scene.yaml").write_text(TREE % "false")
    (folder / "ball.yaml").write_text(BALL)
    (folder / "net.yaml").write_text(NET)
    run("render", "scene.yaml", "-o", "x.png", "-q")
    run("render", "ball.yaml", "-o", "paint.png", "-q", "--size", "32x32", "--samples", "1")
    (folder / "pebble.obj").write_text(PEBBLE)
    (folder / "pebble.yaml").write_text(MESH % "obj")
    run("export", "pebble.yaml", "-o", "pebble.ply", "-q")
    run("export", "net.yaml", "-o", "ball.vdb", "-q")
    shutil.copy(ROOT / "tests/golden/sky.hdr", folder / "sky.hdr")
    run("golden", ".", "-q", "--update", "--filter", "scene")


class Log:
    """The file that shim.c maps."""

    def __init__(self, file):
        self.file = file
        self.clear()

    def clear(self):
        size = 8 * (len(FAMILIES) + 1) + PLACES * PLACE_TEXT
        if not self.file.exists() or self.file.stat().st_size != size:
            self.file.write_bytes(bytes(size))
            return
        with open(self.file, "r+b") as f:  # in place: it stays mapped
            f.write(bytes(size))

    def read(self):
        data = self.file.read_bytes()
        *calls, failed = struct.unpack_from(f"{len(FAMILIES) + 1}q", data)
        start = 8 * (len(FAMILIES) + 1)
        places = [data[start + i * PLACE_TEXT:start + (i + 1) * PLACE_TEXT].rstrip(b"\0").decode(errors="replace")
                  for i in range(min(failed, PLACES))]
        return dict(zip(FAMILIES, calls)), failed, places


class Runner:
    """Runs the program under the shim in a folder of its own; loaded once, or anew each time (fresh)."""

    def __init__(self, ramify, shim, folder):
        self.ramify, self.shim, self.folder = ramify, shim, folder
        folder.mkdir()
        self.log = Log(folder / "log")
        self.server = None
        self.trace = folder / "trace"
        self.environment = dict(os.environ, OMP_WAIT_POLICY="passive", LD_PRELOAD=str(shim), FAULT_LOG=str(self.log.file),
                                FAULT_TRACE=str(self.trace))
        asan = self.environment.get("ASAN_OPTIONS")
        self.environment.setdefault("LSAN_OPTIONS", f"suppressions={ROOT}/tests/leaks.supp:print_suppressions=0")
        self.environment["ASAN_OPTIONS"] = (asan + ":" if asan else "") + "verify_asan_link_order=0:allocator_may_return_null=1"

    def serve(self):
        plugins = ":".join(str(Path(self.ramify).parent / f"ramify-{name}.so") for name in ("oiio", "vdb"))
        self.server = subprocess.Popen([self.ramify], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                       env=dict(self.environment, FAULT_SERVE=plugins))

    def run(self, work, arguments, fault, fresh):
        """Exit status (below 0: of a signal), text on stdout and stderr."""
        self.log.clear()
        out, err = self.folder / "out", self.folder / "err"
        if fresh:
            try:
                with open(out, "wb") as o, open(err, "wb") as e:
                    status = subprocess.run([self.ramify, *arguments], cwd=work, stdin=subprocess.DEVNULL, stdout=o, stderr=e,
                                            env=dict(self.environment, FAULT=fault), timeout=SECONDS).returncode
            except subprocess.TimeoutExpired:
                status = -14
        else:
            if not self.server:
                self.serve()
            words = [fault, str(work), str(out), str(err), str(SECONDS), "ramify", *arguments]
            self.server.stdin.write("\t".join(words) + "\t\n")
            self.server.stdin.flush()
            status = int(self.server.stdout.readline())
        return status, out.read_bytes(), err.read_text(errors="replace")

    def close(self):
        if self.server:
            self.server.stdin.close()
            self.server.wait()
            self.server.stdout.close()


class Case:
    def __init__(self, name, inputs):
        self.name = name
        self.files, line, self.outputs = CASES[name]
        self.arguments = line.split() + ["--threads", "2" if name == "render" else "1"]
        self.inputs = {file: text.encode() if text is not None else (inputs / file).read_bytes()
                       for file, text in self.files.items()}
        self.before = {**{file: OLD for file in self.outputs}, **self.inputs}
        if name == "turntable":  # which goes on with the frames that it finds
            self.before = self.inputs
        self.after = {}  # files of a run without faults

    def set_up(self, work):
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir()
        for file, data in self.before.items():
            (work / file).write_bytes(data)

    def trace(self, runner):
        """Runs without faults. Returns for each family the hashes of all calls' stacks, in their order."""
        with open(runner.trace, "wb") as f:
            f.truncate(8 * MOST_TRACED * len(FAMILIES))
        self.set_up(runner.folder / "work")
        status, _, err = runner.run(runner.folder / "work", self.arguments, "trace", False)
        if status != 0:
            sys.exit(f"{self.name}: exit status {status} while its calls are traced: {err}")
        hashes = array.array("Q", runner.trace.read_bytes())
        counts = runner.log.read()[0].values()
        return {family: hashes[i * MOST_TRACED:i * MOST_TRACED + min(count, MOST_TRACED)]
                for i, (family, count) in enumerate(zip(FAMILIES, counts))}

    def learn(self, runner):
        """Runs without faults, twice. Returns the number of calls of each family."""
        work = runner.folder / "work"
        for turn in range(2):
            self.set_up(work)
            status, out, err = runner.run(work, self.arguments, "none", False)
            if status != 0:
                sys.exit(f"{self.name}: exit status {status} without a fault: {err}")
            files = {f.name: f.read_bytes() for f in work.iterdir()}
            same = {f for f in files if turn == 0 or files[f] == self.after[f]}
            self.after, self.out = files, out
        self.steady = same - {"x.html", "x.xml"}
        assert set(self.after) == set(self.before) | set(self.outputs), set(self.after)
        return runner.log.read()[0]

    def judge(self, work, status, out, err):
        """What is wrong after a run with a fault; "" = nothing."""
        lines = [line for line in err.splitlines() if not WARNING.match(line) and not NOISE.fullmatch(line)]
        if status == LEAKED:
            return "leaks: " + next((line for line in lines if "SUMMARY" in line), "")
        if status == -14:
            return "hangs"
        if "AddressSanitizer: SEGV" in err:  # which ends the program itself
            status = -11
        if status < 0:
            return f"signal {-status}: {' / '.join(lines)[-200:]}"
        if status not in (0, 1, 2):
            return f"exit status {status}: {' / '.join(lines)[-200:]}"
        if status == 0 and lines:
            return f"succeeds, but says {lines[0][:200]}"
        if status != 0 and (len(lines) != 1 or not ERROR.fullmatch(lines[0])):
            return f"exit status {status} with {len(lines)} errors: {' / '.join(lines)[-300:]}"
        files = {f.name: f.read_bytes() for f in work.iterdir()}
        for file, data in files.items():
            if file not in self.after:
                return f"leaves {file}"
            sound = data == self.after[file] or file in self.outputs and file not in self.steady and len(data) > len(OLD)
            if file == "x.exr" and status != 0 and "denoise: true" in self.files.get("scene.yaml", "") and data.startswith(b"v/1\1"):
                sound = True  # without the denoised picture, when that failed: the rendering is not lost
            if not sound and (status == 0 or data != self.before.get(file)):
                return f"{'succeeds, but ' if status == 0 else ''}{file} is neither what it was nor what it should be"
        missing = (self.after if status == 0 else self.before).keys() - files.keys()
        if missing:
            return f"{'fails to write' if status == 0 else 'removes'} {', '.join(sorted(missing))}"
        if status == 0 and self.outputs == [] and out != self.out:
            return "succeeds, but prints something else"
        return ""


def prime_from(least):
    """The smallest prime that is no smaller."""
    number = max(int(least), 2)
    while any(number % i == 0 for i in range(2, int(number ** 0.5) + 1)):
        number += 1
    return number


def chosen(count, first, further):
    """The calls to fail: the first, then about so many further ones, every k-th for a prime k."""
    return list(range(1, min(first, count) + 1)) + list(range(first + 1, count + 1, prime_from((count - first) / further)))


def by_place(hashes, known):
    """The first call of each stack that is not known; known gets the stacks."""
    first = {}
    for number, stack in enumerate(hashes, 1):
        if stack not in known:
            first.setdefault(stack, number)
    known |= first.keys()
    return sorted(first.values())


def faults_of(family, count, places, everything, main):
    """The faults to try: of one call, and of all from one on."""
    if everything:
        once = on = range(1, count + 1)
    elif places is not None:
        once = on = places
    elif main and family == "memory":
        once, on = chosen(count, 20, 120), chosen(count, 2, 20)
    else:
        once, on = chosen(count, 4, 6), chosen(count, 1, 3)
    return [f"{family}:{n}" for n in once] + [f"{family}:{n}+" for n in on]


def with_names(ramify, place):
    """The place with functions and lines of ramify's own frames, which have no dynamic symbols."""
    frames = []
    for frame in place.splitlines():
        own = re.fullmatch(r"\? (ramify(?:-\w+\.so)?)\+(0x[0-9a-f]+)", frame)
        if own:
            file = Path(ramify).parent / own[1]
            text = subprocess.run(["addr2line", "-Cfse", file, hex(int(own[2], 16) - 1)], capture_output=True, text=True).stdout
            frame = " ".join(text.split("\n")[:2]) or frame
        frames.append(frame)
    return frames


def signature(wrong, place):
    """What findings of one cause have in common."""
    frames = [frame for frame in place.splitlines() if "libc.so" not in frame and "shim.so" not in frame]
    return re.sub(r"\d+", "#", wrong)[:60] + "|" + "|".join(frames[:4])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("ramify")
    parser.add_argument("shim")
    parser.add_argument("--all", action="store_true", help="every call, once and all from it on")
    parser.add_argument("--places", action="store_true", help="one call of each stack, once and all from it on")
    parser.add_argument("--case", action="append", help="only these")
    parser.add_argument("--family", action="append")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    ramify, shim = Path(options.ramify).resolve(), Path(options.shim).resolve()
    total = collections.Counter()
    with tempfile.TemporaryDirectory(prefix="ramify-faults-") as name:
        folder = Path(name)
        (folder / "inputs").mkdir()
        make_inputs(ramify, folder / "inputs")
        runners = []
        mine = threading.local()
        # The one process that has the same places at the same addresses in all cases.
        tracer = Runner(ramify, shim, folder / "tracer") if options.places else None
        known = {family: set() for family in FAMILIES}

        def runner():
            if not hasattr(mine, "runner"):
                mine.runner = Runner(ramify, shim, folder / f"runner-{threading.get_ident()}")
                runners.append(mine.runner)
            return mine.runner

        def attempt(case, fault):
            own = runner()
            work = own.folder / "work"
            case.set_up(work)
            status, out, err = own.run(work, case.arguments, fault, fault.startswith("process"))
            _, failed, places = own.log.read()
            return fault, status, failed, case.judge(work, status, out, err), places[0] if places else ""

        def report(name, results):
            """Prints what came of the faults of one case and family, findings of one cause once."""
            findings = collections.defaultdict(list)
            count = 0
            for fault, status, failed, wrong, place in results:
                count += 1
                if count % 100 == 0 and sys.stderr.isatty():
                    print(f"\r{name} {count}", end="\r", file=sys.stderr)
                total["runs"] += 1
                places = " ".join(with_names(ramify, place)) if wrong else ""
                if any(wrong.startswith(what) and function in places for what, function, _ in KNOWN):
                    total["known"] += 1
                    continue
                total["tolerated" if failed and status == 0 else "reported" if failed else "not reached"] += 1
                if wrong:
                    findings[signature(wrong, place)].append((fault, wrong, place))
            total["wrong"] += sum(len(found) for found in findings.values())
            print(f"{'not ok' if findings else 'ok'} {name}_{count}_faults", flush=True)
            for found in findings.values():
                fault, wrong, place = found[0]
                print(f"   {len(found)} x {wrong}\n      as {' '.join(each[0] for each in found[:6])}")
                print("".join(f"        {frame}\n" for frame in with_names(ramify, place)[:16]), flush=True)

        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for case in [Case(name, folder / "inputs") for name in options.case or CASES]:
                counts = pool.submit(lambda c=case: c.learn(runner())).result()
                traced = case.trace(tracer) if tracer else {}
                for family in options.family or FAMILIES:
                    places = by_place(traced[family], known[family]) if tracer else None
                    faults = faults_of(family, counts[family], places, options.all, case.name == "render")
                    if faults:
                        report(f"{case.name}_{family}", pool.map(lambda f, c=case: attempt(c, f), faults))
        for each in runners + [tracer] * bool(tracer):
            each.close()
    print(f"# {total['runs']} runs: {total['reported']} reported, {total['tolerated']} tolerated, "
          f"{total['not reached']} not reached, {total['known']} known flaws of libraries, {total['wrong']} wrong")
    return total["wrong"] > 0


if __name__ == "__main__":
    sys.exit(main())
