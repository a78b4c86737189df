"""ctypes declarations of the functions and structs of ramify.h; tests/python compares them with the header."""

import ctypes as c
import ctypes.util
import os
from pathlib import Path

SONAME = "libramify.so.1"


class Error(c.Structure):
    _fields_ = [
        ("code", c.c_int32),
        ("line", c.c_int32),
        ("column", c.c_int32),
        ("file", c.c_char * 256),
        ("message", c.c_char * 768),
    ]


PROGRESS = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_double)
WARN = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p)
PASS = c.CFUNCTYPE(None, c.c_void_p, c.c_void_p, c.c_int)
EVALUATED = c.CFUNCTYPE(None, c.c_void_p, c.c_void_p)


class Run(c.Structure):
    _fields_ = [
        ("threads", c.c_int32),
        ("cancelled", c.POINTER(c.c_int)),
        ("progress", PROGRESS),
        ("warn", WARN),
        ("user", c.c_void_p),
    ]


class SceneInfo(c.Structure):
    _fields_ = [
        ("file", c.c_char_p),
        ("seed", c.c_uint64),
        ("width", c.c_int32),
        ("height", c.c_int32),
        ("crop", c.c_float * 4),
        ("samples", c.c_int32),
        ("denoise", c.c_int32),
        ("max_seconds", c.c_double),
        ("max_noise", c.c_float),
        ("grow_to", c.c_float),
        ("object_count", c.c_int32),
        ("material_count", c.c_int32),
        ("light_count", c.c_int32),
        ("target_count", c.c_int32),
        ("memory", c.c_int64),
    ]


class ObjectInfo(c.Structure):
    _fields_ = [
        ("name", c.c_char_p),
        ("kind", c.c_char_p),
        ("seed", c.c_uint64),
        ("grows", c.c_int32),
        ("is_land", c.c_int32),
        ("paints", c.c_int32),
        ("tiles", c.c_int32),
        ("attractors", c.c_int64),
        ("instances", c.c_int64),
    ]


class LandInfo(c.Structure):
    _fields_ = [
        ("columns", c.c_int32),
        ("rows", c.c_int32),
        ("cell", c.c_float * 2),
        ("origin", c.c_float * 2),
        ("low", c.c_float),
        ("high", c.c_float),
        ("hash", c.c_uint64),
    ]


class Measure(c.Structure):
    _fields_ = [
        ("name", c.c_char_p),
        ("unit", c.c_char_p),
        ("value", c.c_double),
        ("low", c.c_double),
        ("high", c.c_double),
    ]


class Target(c.Structure):
    _fields_ = [
        ("object", c.c_char_p),
        ("measure", c.c_char_p),
        ("low", c.c_double),
        ("high", c.c_double),
    ]


class Range(c.Structure):
    _fields_ = [
        ("path", c.c_char_p),
        ("low", c.c_double),
        ("high", c.c_double),
        ("logarithmic", c.c_int32),
    ]


class FitOptions(c.Structure):
    _fields_ = [
        ("ranges", c.POINTER(Range)),
        ("range_count", c.c_int32),
        ("evaluations", c.c_int32),
        ("until", c.c_int32),
        ("evaluated", EVALUATED),
        ("user", c.c_void_p),
    ]


class FitInfo(c.Structure):
    _fields_ = [
        ("evaluation_count", c.c_int32),
        ("range_count", c.c_int32),
        ("target_count", c.c_int32),
        ("best", c.c_int32),
        ("met", c.c_int32),
        ("cancelled", c.c_int32),
    ]


class Evaluation(c.Structure):
    _fields_ = [
        ("parameters", c.POINTER(c.c_double)),
        ("measures", c.POINTER(c.c_double)),
        ("misfit", c.c_double),
        ("failure", c.c_char_p),
    ]


class WorldInfo(c.Structure):
    _fields_ = [
        ("nodes", c.c_int64),
        ("triangles", c.c_int64),
        ("curve_segments", c.c_int64),
        ("instances", c.c_int64),
        ("bytes", c.c_int64),
        ("grow_seconds", c.c_double),
        ("mesh_seconds", c.c_double),
    ]


class Part(c.Structure):
    _fields_ = [
        ("object", c.c_int32),
        ("face_size", c.c_int32),
        ("material", c.c_char_p),
        ("vertex_count", c.c_int64),
        ("positions", c.c_void_p),
        ("normals", c.c_void_p),
        ("uvs", c.c_void_p),
        ("radii", c.c_void_p),
        ("births", c.c_void_p),
        ("face_count", c.c_int64),
        ("indices", c.c_void_p),
        ("curve_count", c.c_int64),
        ("starts", c.c_void_p),
        ("instance_count", c.c_int64),
        ("instances", c.c_void_p),
        ("variations", c.c_void_p),
    ]


class ExportOptions(c.Structure):
    _fields_ = [
        ("objects", c.POINTER(c.c_char_p)),
        ("object_count", c.c_int32),
        ("instances", c.c_int32),
        ("colors", c.c_int32),
        ("tube_sides", c.c_int32),
    ]


class ExportReport(c.Structure):
    _fields_ = [
        ("vertices", c.c_int64),
        ("triangles", c.c_int64),
        ("low", c.c_float * 3),
        ("high", c.c_float * 3),
        ("bytes", c.c_int64),
    ]


class RenderInfo(c.Structure):
    _fields_ = [
        ("paths", c.c_int64),
        ("rays", c.c_int64),
        ("bytes", c.c_int64),
        ("seconds", c.c_double),
        ("samples", c.c_int32),
    ]


# Name in ramify.h of each struct above.
class Estimate(c.Structure):
    _fields_ = [
        ("memory", c.c_int64),
        ("paths", c.c_int64),
        ("grow_seconds", c.c_double),
        ("build_seconds", c.c_double),
        ("trace_seconds", c.c_double),
        ("preview_seconds", c.c_double),
        ("write_seconds", c.c_double),
    ]


class PathStep(c.Structure):
    _fields_ = [
        ("end", c.c_char_p),
        ("material", c.c_char_p),
        ("object", c.c_int32),
        ("origin", c.c_float * 3),
        ("position", c.c_float * 3),
        ("direction", c.c_float * 3),
        ("normal", c.c_float * 3),
        ("throughput", c.c_float * 3),
        ("light", c.c_float * 3),
    ]


STRUCTS = {
    "RamifyError": Error,
    "RamifyRun": Run,
    "RamifySceneInfo": SceneInfo,
    "RamifyObjectInfo": ObjectInfo,
    "RamifyLandInfo": LandInfo,
    "RamifyMeasure": Measure,
    "RamifyTarget": Target,
    "RamifyRange": Range,
    "RamifyFitOptions": FitOptions,
    "RamifyFitInfo": FitInfo,
    "RamifyEvaluation": Evaluation,
    "RamifyWorldInfo": WorldInfo,
    "RamifyPart": Part,
    "RamifyExportOptions": ExportOptions,
    "RamifyExportReport": ExportReport,
    "RamifyRenderInfo": RenderInfo,
    "RamifyEstimate": Estimate,
    "RamifyPathStep": PathStep,
}

_handle, _text, _int, _error = c.c_void_p, c.c_char_p, c.c_int, c.POINTER(Error)
_texts, _run = c.POINTER(c.c_char_p), c.POINTER(Run)

# Each function that the module calls: its result, then its arguments.
FUNCTIONS = {
    "version": (_text, []),
    "free": (None, [c.c_void_p]),
    "memory_peak": (c.c_int64, []),
    "schema": (c.c_void_p, [_error]),
    "species": (c.c_void_p, [_error]),
    "scene_load": (_handle, [_text, _texts, _int, _error]),
    "scene_load_settings": (_handle, [_text, _texts, _int, _error]),
    "scene_load_text": (_handle, [_text, c.c_size_t, _text, _text, _texts, _int, _error]),
    "scene_free": (None, [_handle]),
    "scene_info": (None, [_handle, c.POINTER(SceneInfo)]),
    "scene_text": (_text, [_handle]),
    "scene_resolved": (_text, [_handle]),
    "scene_object": (None, [_handle, _int, c.POINTER(ObjectInfo)]),
    "grow": (_handle, [_handle, _int, _run, _error]),
    "tree_read": (_handle, [_text, _run, _error]),
    "tree_write": (c.c_bool, [_handle, _text, _error]),
    "tree_free": (None, [_handle]),
    "tree_count": (c.c_int64, [_handle]),
    "tree_positions": (c.c_void_p, [_handle]),
    "tree_parents": (c.c_void_p, [_handle]),
    "tree_radii": (c.c_void_p, [_handle]),
    "tree_births": (c.c_void_p, [_handle]),
    "tree_colonies": (c.c_void_p, [_handle]),
    "tree_normals": (c.c_void_p, [_handle]),
    "tree_ids": (c.c_void_p, [_handle]),
    "tree_hash": (c.c_uint64, [_handle]),
    "land": (_handle, [_handle, _int, _handle, _run, _error]),
    "land_read": (_handle, [_text, _error]),
    "land_map": (_handle, [_handle, _text, _error]),
    "land_tile": (_handle, [_handle, _int, _handle, _text, _int, _int, _run, _error]),
    "land_free": (None, [_handle]),
    "land_info": (None, [_handle, c.POINTER(LandInfo)]),
    "land_heights": (c.c_void_p, [_handle]),
    "land_write": (c.c_bool, [_handle, _text, _error]),
    "measure": (_handle, [_handle, _int, _run, _error]),
    "tree_measure": (_handle, [_handle, _error]),
    "land_measure": (_handle, [_handle, _error]),
    "measures_free": (None, [_handle]),
    "measures_count": (_int, [_handle]),
    "measures_get": (None, [_handle, _int, c.POINTER(Measure)]),
    "scene_target": (None, [_handle, _int, c.POINTER(Target)]),
    "fit": (_handle, [_handle, c.POINTER(FitOptions), _run, _error]),
    "fit_free": (None, [_handle]),
    "fit_info": (None, [_handle, c.POINTER(FitInfo)]),
    "fit_evaluation": (None, [_handle, _int, c.POINTER(Evaluation)]),
    "fit_write": (c.c_bool, [_handle, _text, c.POINTER(c.c_bool), _error]),
    "fit_draw": (c.c_bool, [_handle, _text, _error]),
    "build": (_handle, [_handle, _run, _error]),
    "world_free": (None, [_handle]),
    "world_info": (None, [_handle, c.POINTER(WorldInfo)]),
    "world_part_count": (c.c_int64, [_handle]),
    "world_part": (None, [_handle, c.c_int64, c.POINTER(Part)]),
    "export": (
        c.c_bool,
        [_handle, _text, c.POINTER(ExportOptions), _run, c.POINTER(ExportReport), _error],
    ),
    "film_new": (_handle, [_int, _int, _error]),
    "film_free": (None, [_handle]),
    "film_read": (_handle, [_text, _handle, _run, _error]),
    "film_join": (_handle, [_texts, _int, _handle, c.POINTER(c.c_int64), _run, _error]),
    "film_layer": (c.c_void_p, [_handle, _text, c.POINTER(_int)]),
    "film_denoise": (c.c_bool, [_handle, _handle, _run, _error]),
    "film_noise": (c.c_bool, [_handle, _handle, c.POINTER(c.c_double), _error]),
    "film_write": (c.c_bool, [_handle, _handle, _text, c.c_bool, _run, _error]),
    "image_check": (c.c_bool, [_text, _error]),
    "develop_check": (c.c_bool, [_handle, _error]),
    "renderer_new": (_handle, [_handle, _text, _run, _error]),
    "renderer_free": (None, [_handle]),
    "renderer_render": (
        c.c_bool,
        [_handle, _handle, PASS, c.c_void_p, _run, c.POINTER(RenderInfo), _error],
    ),
    "renderer_resume": (
        c.c_bool,
        [_handle, _handle, PASS, c.c_double, c.c_void_p, _run, c.POINTER(RenderInfo), _error],
    ),
    "renderer_replay": (
        _int,
        [_handle, _handle, _int, _int, _int, c.POINTER(PathStep), _int, c.POINTER(c.c_float), _error],
    ),
    "estimate": (c.c_bool, [_handle, _text, c.c_int64, _run, c.POINTER(Estimate), _error]),
}


def _candidates():
    """Candidate paths of the library: as configured, under the same prefix as this module, the loader's search path."""
    told = os.environ.get("RAMIFY_LIBRARY")
    if told:
        yield told
        return
    for folder in Path(__file__).resolve().parents:
        for name in (SONAME, "libramify.so"):
            for place in (folder / name, folder / "build" / name):
                if place.is_file():
                    yield str(place)
    yield SONAME
    found = ctypes.util.find_library("ramify")
    if found:
        yield found


def load(version):
    """Loads the library and declares its functions. ImportError if it is missing or has another version."""
    reasons = []
    for name in _candidates():
        try:
            library = c.CDLL(name)
        except OSError as reason:
            reasons.append(str(reason))
            continue
        lacking = []
        for function, (result, arguments) in FUNCTIONS.items():
            try:
                entry = getattr(library, "ramify_" + function)
                entry.restype, entry.argtypes = result, arguments
            except AttributeError:
                lacking.append(function)
        found = "another program" if "version" in lacking else "ramify " + library.ramify_version().decode()
        if lacking or found != "ramify " + version:
            raise ImportError(f"{name} is {found}, which is not of this module, {version}; install both from the same source")
        return library
    raise ImportError(
        "libramify.so is not found; run 'make install', or name the file in the environment variable "
        "RAMIFY_LIBRARY (" + "; ".join(reasons) + ")"
    )
