"""Fits: the search for parameters with which a scene meets its targets."""

from __future__ import annotations

import ctypes as c
import warnings
from typing import Dict, List, Mapping, NamedTuple, Optional, Tuple, Union

from . import _abi
from ._call import File, Handle, call, lib, path

# What is varied: {"objects.oak.tree.height": (low, high)}, or (low, high, "log") for equal factors as equal steps.
Ranges = Mapping[str, Union[Tuple[float, float], Tuple[float, float, str]]]


class Target(NamedTuple):
    """A requirement of the scene: a measure of an object must lie in low .. high."""

    object: str
    measure: str
    low: float
    high: float


class Evaluation(NamedTuple):
    """A scene that the search tried. misfit: 0 if all targets are met; parameters: by path; measures: in the order of the
    fit's targets, nan if not measurable; failure: why it could not be grown."""

    misfit: float
    parameters: Dict[str, float]
    measures: Tuple[float, ...]
    failure: Optional[str]


def as_ranges(ranges: Ranges):
    """Converts ranges for the library."""
    made = (_abi.Range * len(ranges))()
    for entry, (name, (low, high, *scale)) in zip(made, ranges.items()):
        if scale not in ([], ["log"]):
            raise ValueError(f'the range of {name} ends with {scale}; it must be (low, high) or (low, high, "log")')
        entry.path, entry.low, entry.high, entry.logarithmic = name.encode(), float(low), float(high), len(scale)
    return made


def evaluation_at(pointer: int, index: int, paths: List[str]) -> Evaluation:
    """Evaluation number index of a fit of the library; -1 = the last one."""
    info, found = _abi.FitInfo(), _abi.Evaluation()
    lib.ramify_fit_info(pointer, c.byref(info))
    lib.ramify_fit_evaluation(pointer, range(info.evaluation_count)[index], c.byref(found))
    return Evaluation(
        found.misfit,
        dict(zip(paths, found.parameters[: info.range_count])),
        tuple(found.measures[: info.target_count]),
        None if found.failure is None else found.failure.decode(errors="replace"),
    )


class Fit:
    """What a search did and found.

    met           whether the best evaluation meets all targets
    targets       the scene's targets, a list of Target
    evaluations   a list of Evaluation, in the order of the search
    best          the best of them
    """

    def __init__(self, pointer, scene, paths):
        self._handle = Handle(pointer, "fit_free", scene)
        info = _abi.FitInfo()
        lib.ramify_fit_info(pointer, c.byref(info))
        self.met: bool = bool(info.met)
        self.targets: List[Target] = []
        for i in range(info.target_count):
            target = _abi.Target()
            lib.ramify_scene_target(scene.pointer, i, c.byref(target))
            self.targets.append(Target(target.object.decode(), target.measure.decode(), target.low, target.high))
        self.evaluations: List[Evaluation] = [evaluation_at(pointer, i, paths) for i in range(info.evaluation_count)]
        self.best: Evaluation = self.evaluations[info.best]

    def write(self, file: File) -> None:
        """Writes the scene's file with the best parameters in place, comments and layout kept. Warns if they cannot be."""
        whole = c.c_bool()
        call("fit_write", self._handle.pointer, path(file), c.byref(whole))
        if not whole:
            warnings.warn(
                f"{file} has all values written out and no comments: the scene's text could not be edited in place",
                RuntimeWarning,
                stacklevel=2,
            )

    def draw(self, file: File) -> None:
        """Draws misfit, parameters and measures over the evaluations as .svg."""
        call("fit_draw", self._handle.pointer, path(file))
