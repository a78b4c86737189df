#!/usr/bin/env python3
"""Renders random scenes, drawn from the JSON Schema of scene files: each must give a picture, the same for any number
of threads, or one error that names its place.

usage: random_scenes.py RAMIFY COUNT [SEED] [FOLDER]      FOLDER keeps the scenes that failed; by default none is kept
       random_scenes.py --write RAMIFY COUNT SEED FOLDER  only writes the scenes, as FOLDER/NUMBER.yaml
"""
import concurrent.futures
import json
import math
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SECONDS = 400  # of processor time that a scene may take, with its threads
PATIENCE = 3600  # seconds to wait for it on a busy machine
# Keys that set how much work an object is: the largest value drawn.
MOST = {
    "attractors": 60, "resolution": 32, "generations": 4, "seasons": 6, "age": 6, "particles": 300, "spines": 30,
    "sides": 200, "grains": 200, "grass_tufts": 100, "fallen_leaves": 100, "ferns": 10, "stands": 1, "stand_trees": 2,
    "terminals": 60, "max_count": 60, "count": 12, "variants": 2, "levels": 1, "bolts": 3, "max_depth": 4,
    "height": 6, "radius": 20, "flat_radius": 20, "grass_radius": 10, "max_steps": 40, "iterations": 3, "leaflets": 12,
    "leaflets_of_part": 6, "per_node": 6, "per_cluster": 20, "streams": 1, "colonies": 2, "max_order": 3, "detail": 2,
    "nuclei": 4, "beyond": 1, "tips": 20, "cushions": 20, "swell": 10,
}
# Keys that choose between forms of a thing, on which other keys depend: drawn more often than others.
CHOICES = {"kind", "form", "habit", "surface", "pattern", "show", "shape", "rule"}
# Keys of files, of other objects, and of libraries that may not be there; what a scene needs of them is given below.
SKIPPED = {
    "file", "map", "grid", "config", "color_map", "density", "clear_of", "contest", "over", "denoiser", "golden",
    "targets", "animation", "crop", "texture", "image", "fit", "surface_of", "deform", "placed", "trace", "lift",
}
# What makes an object of a kind small, whatever else is drawn.
SMALL = {
    "tree": {"height": 3, "light": {"seasons": 6}, "leaves": {"max_count": 40},
             "crown": {"growth": {"levels": [{"attractors": 60}]}}, "roots": {"count": 2}},
    "forest": {"radius": 12, "spacing": 2, "stands": 1, "stand_trees": 2, "height": 5, "ferns": 4, "leaves": {"max_count": 30}},
    "ground": {"radius": 20, "flat_radius": 5, "grass_tufts": 60},
    "terrain": {"resolution": 32, "rivers": {"count": 40}, "ridges": {"count": 40}},
    "coral": {"attractors": 60}, "lsystem": {"generations": 3}, "dla": {"particles": 200},
    "frost": {"spines": 20, "sides": 100}, "sculpture": {"attractors": 8},
    "vessels": {"terminals": 30, "envelope": [{"shape": "sphere", "size": 0.5}]},
    "fracture": {"envelope": [{"shape": "sphere"}], "attractors": 30, "resolution": 24},
    "outtree": {"growth": {"levels": [{"attractors": 80}]}, "leaves": {"max_count": 10}},
    "lightning": {"height": 5, "bolts": 1}, "venation": {"width": 0.06, "length": 0.1}, "stone": {"resolution": 6},
    "shape": {"envelope": [{"shape": "sphere"}]},
    "mesh": {"file": str(ROOT / "scenes/meshes/hare.obj")},
    "skeleton": {"file": str(ROOT / "tests/fuzz/corpus/swc/header_types_crlf.swc")},
    "climber": {"climbs": "wall", "starts": [{"position": [0, 0, 0.5]}], "height": 0.8, "spread": 0.5, "spacing": 0.1,
                "leaves": {"max_count": 60}, "hanging": {"count": 3}},
    "snow_crystal": {"cells": 12}, "frost_flower": {"feathers": 5, "barbs": 6},
    "ice_cracks": {"size": 2, "grain": 0.03},
    "eruption": {"on": "cone", "bombs": 5},
    "cascade": {"over": "wall", "strands": 8},
    "scatter": {"count": 12, "radius": 4, "variants": 2},
    "swarm": {"count": 12, "envelope": [{"shape": "sphere"}], "variants": 2},
}
# What grows in a fraction of a second on every place of a scatter.
THINGS = ("tree", "coral", "lsystem", "frost", "shape", "stone", "venation", "sculpture", "frost_flower")
SPECIES = sorted(file.stem for file in (ROOT / "scenes/species").glob("*.yaml"))
HERBS = ("timothy", "bluebell", "oxeye_daisy", "cow_parsley", "meadow_buttercup", "common_sorrel")  # small at their own height


class Drawer:
    """Draws values that a schema allows."""

    def __init__(self, schema, draw):
        self.root, self.draw = schema, draw

    def resolve(self, schema):
        while "$ref" in schema:
            schema = self.root["$defs"][schema["$ref"].rsplit("/", 1)[1]]
        return schema

    def number(self, schema, key):
        low, high = schema.get("minimum", -10), schema.get("maximum", 10)
        low, high = schema.get("exclusiveMinimum", low), schema.get("exclusiveMaximum", high)
        usual = schema.get("default")
        high = max(low, min(high, MOST.get(key, high)))
        if self.draw.random() < 0.1:
            value = self.draw.choice([low, high])
        elif isinstance(usual, (int, float)) and usual != 0:
            value = usual * 10 ** self.draw.uniform(-0.5, 0.5)
        else:
            value = self.draw.uniform(max(low, -2), min(high, 2)) if low <= 2 else low
        value = min(max(value, low), high)
        if schema.get("type") == "integer":
            value = int(min(max(round(value), math.ceil(low)), math.floor(high), MOST.get(key, 40)))
        return value

    def value(self, schema, key, depth):
        schema = self.resolve(schema)
        if "enum" in schema:
            return self.draw.choice(schema["enum"])
        if "anyOf" in schema:
            return self.value(self.draw.choice(schema["anyOf"]), key, depth)
        kind = schema.get("type")
        kind = next(k for k in kind if k != "null") if isinstance(kind, list) else kind
        if kind in ("number", "integer"):
            return self.number(schema, key)
        if kind == "boolean":
            return self.draw.random() < 0.5
        if kind == "array":
            least, most = schema.get("minItems", 0), min(schema.get("maxItems", 3), max(schema.get("minItems", 0), 3))
            return [self.value(schema["items"], key, depth + 1) for _ in range(self.draw.randint(least, most))]
        if kind == "object":
            return self.mapping(schema, depth + 1)
        if kind == "string" and schema.get("pattern", "").startswith("^#"):
            return "#%06x" % self.draw.getrandbits(24)
        return None

    def mapping(self, schema, depth=0):
        schema = self.resolve(schema)
        share = 0.3 if depth < 3 else 0.15
        found = {}
        for key, of in schema.get("properties", {}).items():
            wanted = key in schema.get("required", [])
            if key in SKIPPED or not (wanted or self.draw.random() < (0.7 if key in CHOICES else share)):
                continue
            value = self.value(of, key, depth)
            if value is not None and value != []:
                found[key] = value
        return found


def merged(found, small):
    """found with the values of small in place of its own."""
    result = dict(found)
    for key, value in small.items():
        own = result.get(key)
        result[key] = merged(own, value) if isinstance(value, dict) and isinstance(own, dict) else value
    return result


def draw_body(drawer, schema, kind):
    """The keys of an object of a kind, small."""
    body = merged(drawer.mapping(schema["$defs"]["object"]["properties"][kind]), SMALL[kind])
    if kind == "tree" and drawer.draw.random() < 0.4:
        body["species"] = drawer.draw.choice(SPECIES)
        if body["species"] in HERBS:
            body.pop("height")
    if kind == "terrain" and body.get("form") in ("map", "survey"):
        body["form"] = "alps"  # those need a file
    if kind == "climber":
        body["species"] = drawer.draw.choice(["ivy", "wisteria"])
    if kind in ("scatter", "swarm"):
        body["things"] = []
        for _ in range(drawer.draw.randint(1, 2)):
            thing = drawer.draw.choice(THINGS)
            body["things"].append({thing: draw_body(drawer, schema, thing)})
    return body


def draw_scene(schema, seed):
    draw = random.Random(seed)
    drawer = Drawer(schema, draw)
    properties = schema["properties"]
    scene = {"seed": draw.getrandbits(31)}
    for part in ("film", "render", "sky", "medium"):
        if draw.random() < 0.6:
            scene[part] = drawer.mapping(properties[part])
    if scene.get("sky", {}).get("kind", "environment" if draw.random() < 0.8 else "") == "environment":
        scene["sky"] = {"kind": "constant"}  # that needs a file; the default, sun and sky, takes half a second to build
    scene["film"] = merged(scene.get("film", {}), {"width": 24, "height": 16})
    scene["render"] = merged(scene.get("render", {}), {"samples": 1, "max_depth": draw.randint(1, 6)})
    scene["camera"] = {"position": [draw.uniform(-4, 4), draw.uniform(0.5, 4), 8], "target": [0, 1, 0]}
    if draw.random() < 0.5:
        scene["lights"] = [drawer.mapping(schema["$defs"]["light"])]
    if draw.random() < 0.2:
        scene["clouds"] = [drawer.mapping(schema["$defs"]["cloud"])]
        if scene["clouds"][0].get("kind") == "grid":
            scene["clouds"][0]["kind"] = "storm"  # that needs a file
    names = []
    for i in range(draw.randint(0, 2)):
        material = drawer.mapping(schema["$defs"]["material"])
        names.append(f"m{i}")
        scene.setdefault("materials", []).append(merged(material, {"name": names[-1]}))
    scene["objects"] = []
    for i in range(draw.randint(1, 3)):
        kind = draw.choice(sorted(SMALL))
        if kind in ("climber", "cascade") and not any(one["name"] == "wall" for one in scene["objects"]):
            scene["objects"].append({"name": "wall", "shape": {"envelope": [{"shape": "sphere", "size": 0.5}]}})
        if kind == "eruption" and not any(one["name"] == "cone" for one in scene["objects"]):
            scene["objects"].append({"name": "cone", "terrain": {"form": "volcano", "resolution": 32}})
        one = {"name": f"o{i}", kind: draw_body(drawer, schema, kind)}
        for key in schema["$defs"]["object"]["properties"]:
            if names and key.endswith("material") and draw.random() < (0.7 if key == "material" else 0.1):
                one[key] = draw.choice(names)
        scene["objects"].append(one)
    return scene


def step(node, word):
    """The child of a map, or the entry of a list with this number or name; None if there is none."""
    if isinstance(node, dict):
        return node.get(word)
    if isinstance(node, list):
        for i, entry in enumerate(node):
            if str(i) == word or (isinstance(entry, dict) and entry.get("name") == word):
                return entry
    return None


def remove(scene, path):
    """Takes out what a path names, or else the deepest key above it that is there; False if there is none."""
    words, node, last = path.split("."), scene, None
    for word in words:
        if isinstance(node, dict) and word in node and word not in ("name", "objects", "materials", "lights"):
            last = (node, word)
        node = step(node, word)
        if node is None:
            break
    if last is None or (last[1] in SMALL and "name" in last[0]):
        return False
    del last[0][last[1]]
    return True


def repair(ramify, scene, file):
    """Takes out what the program refuses, by the path that its message names: keys of other kinds above all."""
    for _ in range(100):
        file.write_text(json.dumps(scene, indent=1))
        result = subprocess.run([ramify, "info", file], capture_output=True, text=True, timeout=PATIENCE)
        if result.returncode == 0:
            return
        message = re.sub(r"^.*?:\d+:\d+: ", "", result.stderr)
        none = re.match(r"(objects\.\w+): an? \w+ has no (\w+); remove", message)
        other = re.match(r"key '(\w+)' does not apply to ([\w.]+?)(?: of kind|;|:| )", message)
        named = re.search(r"((?:objects|materials|lights|film|render|sky|medium|camera)(?:\.\w+)+)", message)
        path = f"{other[2]}.{other[1]}" if other else f"{none[1]}.{none[2]}" if none else named[1] if named else ""
        if not remove(scene, path):
            return


def run(ramify, file, output, *options):
    limit = ["prlimit", f"--cpu={SECONDS}:{SECONDS + 1}"]
    return subprocess.run([*limit, ramify, "render", file, "-q", "--no-preview", "-o", output, *options],
                          capture_output=True, text=True, timeout=PATIENCE)


def judge(ramify, scene, folder, threads):
    """What is wrong with a scene; "" = nothing, and whether it was rendered."""
    file, one, many = folder / "scene.yaml", folder / "one.png", folder / "many.png"
    file.write_text(json.dumps(scene, indent=1))
    for picture in folder.glob("*.png"):
        picture.unlink()
    try:
        result = run(ramify, file, one, "--threads", "1")
        if result.returncode == 2:
            sound = re.match(r".*:\d+:\d+: \S", result.stderr) and not one.exists()
            return "" if sound else f"refused without a place: {result.stderr[-300:]}", False
        if result.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return f"took more than {SECONDS} s of processor time", False
        if result.returncode != 0 or not one.exists():
            return f"exit status {result.returncode}: {result.stderr[-300:]}", False
        if threads and (run(ramify, file, many, "--threads", "3").returncode != 0 or
                        one.read_bytes() != many.read_bytes()):
            return "another picture with 3 threads", True
    except subprocess.TimeoutExpired:
        return f"took more than {PATIENCE} s", False
    return "", True


def read_schema(ramify):
    return json.loads(subprocess.run([ramify, "schema"], capture_output=True, check=True).stdout)


def write(ramify, count, seed, folder):
    """Writes scenes for other programs to build or render."""
    schema = read_schema(ramify)
    Path(folder).mkdir(parents=True, exist_ok=True)
    for number in range(int(seed), int(seed) + int(count)):
        scene, file = draw_scene(schema, number), Path(folder) / f"{number}.yaml"
        repair(ramify, scene, file)
        file.write_text(json.dumps(scene, indent=1))


def try_scene(ramify, schema, number, keep):
    """What is wrong with a scene, whether it was rendered, and the seconds it took."""
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as name:
        scene = draw_scene(schema, number)
        repair(ramify, scene, Path(name) / "scene.yaml")
        wrong, done = judge(ramify, scene, Path(name), number % 4 == 0)
    if wrong and keep:
        Path(keep).mkdir(parents=True, exist_ok=True)
        (Path(keep) / f"{number}.yaml").write_text(json.dumps(scene, indent=1))
    return wrong, done, time.monotonic() - start


def main(ramify, count, seed=1, keep=None):
    schema, numbers = read_schema(ramify), range(int(seed), int(seed) + int(count))
    start, tried, rendered, failed, longest = time.monotonic(), 0, 0, 0, (0.0, 0)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = pool.map(lambda number: try_scene(ramify, schema, number, keep), numbers)
        for number, (wrong, done, seconds) in zip(numbers, results):
            tried, rendered, failed = tried + 1, rendered + done, failed + (wrong != "")
            longest = max(longest, (seconds, number))
            if wrong:
                print(f"scene {number}: {wrong}", flush=True)
            if tried % 50 == 0 or tried == len(numbers):
                print(f"{tried} scenes: {rendered} rendered, {tried - rendered - failed} refused, {failed} failed, "
                      f"{time.monotonic() - start:.0f} s; the longest, {longest[1]}, took {longest[0]:.0f} s", flush=True)
    return failed > 0 or rendered < tried / 4


if __name__ == "__main__":
    sys.exit(write(*sys.argv[2:]) if sys.argv[1] == "--write" else main(*sys.argv[1:]))
