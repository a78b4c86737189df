"""Scenes."""

from __future__ import annotations

import ctypes as c
import json
import os
from typing import Any, Callable, Dict, Iterable, Mapping, Optional, Union

import numpy as np

from . import _abi
from ._call import File, Handle, Progress, call, lib, path, run
from .fit import Evaluation, Fit, Ranges, as_ranges, evaluation_at
from .tree import Land, Tree, measures
from .world import Film, World

Name = Union[str, int]  # of an object, or its number
Overrides = Optional[Mapping[str, Any]]

_INSTANCES = ("auto", "nodes", "gpu", "flat")
_COLORS = ("all", "pattern", "growth", "none")
_UNTIL = ("targets", "evaluations")


def _plain(value):
    """Converts types that json does not support: NumPy numbers and arrays, paths."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"a scene cannot hold a {type(value).__name__}")


def _yaml(value):
    # JSON is YAML, as long as nothing is escaped that need not be
    return json.dumps(value, default=_plain, allow_nan=False, ensure_ascii=False)


def _overrides(overrides):
    """Converts overrides such as {"camera.fov": 35} for the library."""
    texts = [f"{path}={_yaml(value)}".encode() for path, value in (overrides or {}).items()]
    return (c.c_char_p * len(texts))(*texts), len(texts)


def _choice(name, value, known):
    if value not in known:
        raise ValueError(f"{name} is {value!r}; it must be one of {', '.join(known)}")
    return known.index(value)


def species() -> str:
    """The built-in library of species, a line each: name, Latin name, form, height, months of leaves and organs."""
    text = call("species")
    try:
        return c.string_at(text).decode()
    finally:
        lib.ramify_free(text)


def schema() -> Dict[str, Any]:
    """The JSON Schema of scene files, as a dict."""
    text = call("schema")
    try:
        return json.loads(c.string_at(text))
    finally:
        lib.ramify_free(text)


class Scene:
    """A scene from a dict with the keys of a scene file. overrides: {"objects.oak.tree.height": 9}. Files named in it are
    relative to folder."""

    def __init__(self, description: Dict[str, Any], overrides: Overrides = None, folder: File = ""):
        text = _yaml(description).encode()
        self._take(call("scene_load_text", text, len(text), b"scene", path(folder), *_overrides(overrides)))

    @classmethod
    def load(cls, file: File, overrides: Overrides = None) -> Scene:
        """Reads a scene file."""
        scene = cls.__new__(cls)
        scene._take(call("scene_load", path(file), *_overrides(overrides)))
        return scene

    def _take(self, pointer):
        self._handle = Handle(pointer, "scene_free")
        info = _abi.SceneInfo()
        lib.ramify_scene_info(pointer, c.byref(info))
        self.width: int = info.width
        self.height: int = info.height
        self.samples: int = info.samples
        self.seed: int = info.seed
        self.objects: Dict[str, str] = {}
        for i in range(info.object_count):
            entry = _abi.ObjectInfo()
            lib.ramify_scene_object(pointer, i, c.byref(entry))
            self.objects[entry.name.decode()] = entry.kind.decode()

    @property
    def resolved(self) -> str:
        """The scene with all defaults and overrides written out, as YAML."""
        return lib.ramify_scene_resolved(self._handle.pointer).decode()

    def _index(self, name):
        names = list(self.objects)
        if isinstance(name, str):
            if name not in self.objects:
                raise KeyError(f"no object is called {name!r}; there are {', '.join(names)}")
            return names.index(name)
        return range(len(names))[name]

    def grow(self, name: Name, threads: int = 0, progress: Progress = None) -> Tree:
        """Grows one object; returns its Tree."""
        index = self._index(name)
        return Tree(
            run(
                lambda how, _, error: lib.ramify_grow(self._handle.pointer, index, how, error),
                threads,
                progress,
                discard=lib.ramify_tree_free,
            )
        )

    def land(self, name: Name, threads: int = 0, progress: Progress = None) -> Land:
        """Heights of a terrain; returns its Land."""
        index = self._index(name)
        return Land(
            run(
                lambda how, _, error: lib.ramify_land(self._handle.pointer, index, None, how, error),
                threads,
                progress,
                discard=lib.ramify_land_free,
            )
        )

    def tile(self, name: Name, world: Land, column: int, row: int, map: Optional[str] = None) -> Land:
        """Tile (column, row) of a terrain that the key tiles cuts, finer than `world`, its land; or a map of the tile."""
        kind = map.encode() if map else None
        return Land(call("land_tile", self._handle.pointer, self._index(name), world._handle.pointer, kind, column, row, None))

    def measure(self, name: Name, threads: int = 0, progress: Progress = None) -> Dict[str, float]:
        """Grows one object and measures it, as a dict; nan if not measurable."""
        index = self._index(name)
        return measures(
            run(
                lambda how, _, error: lib.ramify_measure(self._handle.pointer, index, how, error),
                threads,
                progress,
                discard=lib.ramify_measures_free,
            )
        )

    def fit(
        self,
        ranges: Ranges,
        evaluations: int = 0,
        until: str = "targets",
        threads: int = 0,
        progress: Progress = None,
        each_evaluation: Optional[Callable[[Evaluation], object]] = None,
    ) -> Fit:
        """Searches parameters with which the scene meets its targets. ranges: {"objects.oak.tree.height": (15, 24)}, or
        (low, high, "log"); evaluations: most scenes to grow, 0 = 64; until: "targets" to stop at the first scene that
        meets all, or "evaluations". each_evaluation(evaluation) is called after each. Returns the Fit."""
        made, paths = as_ranges(ranges), list(ranges)
        end = _choice("until", until, _UNTIL)

        def show(_user, pointer):
            each_evaluation(evaluation_at(pointer, -1, paths))

        def search(how, each, error):
            options = _abi.FitOptions(made, len(made), evaluations, end, each)
            return lib.ramify_fit(self._handle.pointer, c.byref(options), how, error)

        pointer = run(
            search,
            threads,
            progress,
            show if each_evaluation else None,
            discard=lib.ramify_fit_free,
            each_type=_abi.EVALUATED,
        )
        return Fit(pointer, self._handle, paths)

    def build(self, threads: int = 0, progress: Progress = None) -> World:
        """Grows, skins and places everything; returns the World."""
        pointer = run(
            lambda how, _, error: lib.ramify_build(self._handle.pointer, how, error),
            threads,
            progress,
            discard=lib.ramify_world_free,
        )
        return World(pointer, self._handle, list(self.objects))

    def render(
        self,
        isa: Optional[str] = None,
        threads: int = 0,
        progress: Progress = None,
        each_pass: Optional[Callable[[Film, int], object]] = None,
        resume: Optional[Film] = None,
    ) -> Film:
        """Builds and path traces the scene; returns the Film (see World.render)."""
        return self.build(threads, progress).render(isa, threads, progress, each_pass, resume)

    def estimate(self, isa: Optional[str] = None, threads: int = 0) -> Dict[str, Any]:
        """Estimates what rendering takes, by a part of the work: memory (bytes at most), paths, and processor seconds:
        grow_seconds, build_seconds, trace_seconds, preview_seconds, write_seconds."""
        found, name = _abi.Estimate(), None if isa is None else isa.encode()
        run(
            lambda how, _, error: lib.ramify_estimate(self._handle.pointer, name, 0, how, c.byref(found), error),
            threads,
        )
        return {name: getattr(found, name) for name, *_ in found._fields_}

    def export(
        self,
        file: File,
        objects: Union[Name, Iterable[Name]] = (),
        instances: str = "auto",
        colors: str = "all",
        tube_sides: int = 0,
        threads: int = 0,
        progress: Progress = None,
    ) -> Dict[str, Any]:
        """Exports the scene in the format of the file's extension. objects: names of the objects to write, or one name;
        instances: "auto", "nodes", "gpu" or "flat"; colors: "all", "pattern", "growth" or "none"; tube_sides: of curves
        written as tubes. Returns what was written as a dict: vertices, triangles, low, high (m), bytes."""
        objects = [objects] if isinstance(objects, (str, int)) else objects
        known = list(self.objects)
        names = [(name if isinstance(name, str) else known[name]).encode() for name in objects]
        options = _abi.ExportOptions(
            (c.c_char_p * len(names))(*names),
            len(names),
            _choice("instances", instances, _INSTANCES),
            _choice("colors", colors, _COLORS),
            tube_sides,
        )
        report = _abi.ExportReport()
        target = path(file)
        run(
            lambda how, _, error: lib.ramify_export(
                self._handle.pointer, target, c.byref(options), how, c.byref(report), error
            ),
            threads,
            progress,
        )
        return {
            "vertices": report.vertices,
            "triangles": report.triangles,
            "low": tuple(report.low),
            "high": tuple(report.high),
            "bytes": report.bytes,
        }
