"""Out-trees and land."""

from __future__ import annotations

import ctypes as c
from typing import Dict, Tuple

import numpy as np

from . import _abi
from ._arrays import view
from ._call import File, Handle, call, lib, path, run


def measures(pointer: int) -> Dict[str, float]:
    """Converts a list of measures to a dict of numbers and frees it."""
    handle = Handle(pointer, "measures_free")
    found = {}
    for i in range(lib.ramify_measures_count(handle.pointer)):
        measure = _abi.Measure()
        lib.ramify_measures_get(handle.pointer, i, c.byref(measure))
        found[measure.name.decode()] = measure.value
    return found


class Tree:
    """An out-tree of n nodes, parents before children.

    positions   n x 3 float32, m
    parents     n int32: index of the parent, smaller than the node's own; -1 at a root
    radii       n float32, m
    births      n int32: growth step, 0 for what growth began with
    colonies    n int32: which root, or which element (trunk, branches, roots), it belongs to
    normals     n x 3 float32, unit
    ids         n uint64: stable names
    """

    def __init__(self, pointer):
        self._handle = Handle(pointer, "tree_free")
        self._count = lib.ramify_tree_count(pointer)

    @classmethod
    def read(cls, file: File) -> Tree:
        """Reads an SWC file or a QSM (.qsm, .txt, .csv), in metres, in a child process with limits."""
        name = path(file)
        return cls(run(lambda how, _, error: lib.ramify_tree_read(name, how, error), discard=lib.ramify_tree_free))

    def write(self, file: File) -> None:
        """Writes .swc, .json or .graphml, by the file's extension."""
        call("tree_write", self._handle.pointer, path(file))

    def _array(self, name, kind, *width):
        address = getattr(lib, "ramify_tree_" + name)(self._handle.pointer)
        return view(address, kind, (self._count, *width), self._handle)

    def __len__(self) -> int:
        return self._count

    positions = property(lambda self: self._array("positions", "f4", 3))
    parents = property(lambda self: self._array("parents", "i4"))
    radii = property(lambda self: self._array("radii", "f4"))
    births = property(lambda self: self._array("births", "i4"))
    colonies = property(lambda self: self._array("colonies", "i4"))
    normals = property(lambda self: self._array("normals", "f4", 3))
    ids = property(lambda self: self._array("ids", "u8"))

    @property
    def hash(self) -> int:
        """Hash of positions, parents, births, colonies and radii."""
        return lib.ramify_tree_hash(self._handle.pointer)

    def measure(self) -> Dict[str, float]:
        """Measures of any out-tree, as a dict; nan if not measurable."""
        return measures(call("tree_measure", self._handle.pointer))


class Land:
    """Heights of land: heights, rows x columns float32 in m (row: z, column: x); cell, sample spacing in m along
    (x, z); origin, (x, z) of the first sample in m."""

    def __init__(self, pointer):
        self._handle = Handle(pointer, "land_free")
        self._info = _abi.LandInfo()
        lib.ramify_land_info(pointer, c.byref(self._info))
        self.cell: Tuple[float, float] = tuple(self._info.cell)
        self.origin: Tuple[float, float] = tuple(self._info.origin)

    @classmethod
    def read(cls, file: File) -> Land:
        """Reads an Esri ASCII grid (.asc); missing heights are nan."""
        return cls(call("land_read", path(file)))

    def write(self, file: File) -> None:
        """Writes .png (16 bits, from the lowest to the highest point), .exr, .asc or .tif (m), by the file's extension."""
        call("land_write", self._handle.pointer, path(file))

    def map(self, name: str) -> Land:
        """A map in the place of the heights: slope, aspect, curvature, flow, wetness, river-distance, deposit, wear, bedrock,
        snow, lava, scoria, age, water-depth, sun-hours (also as sun-hours:LATITUDE:DAY) or altitude."""
        return Land(call("land_map", self._handle.pointer, name.encode()))

    @property
    def heights(self) -> np.ndarray:
        address = lib.ramify_land_heights(self._handle.pointer)
        return view(address, "f4", (self._info.rows, self._info.columns), self._handle)

    def measure(self) -> Dict[str, float]:
        """Measures of any land, as a dict."""
        return measures(call("land_measure", self._handle.pointer))
