"""Geometry and pictures of a scene."""

from __future__ import annotations

import ctypes as c
from typing import Any, Callable, Dict, Iterable, List, NamedTuple, Optional, Tuple, Union

import numpy as np

from . import _abi
from ._arrays import view
from ._call import File, Handle, Progress, call, check, lib, path, run

MOST_STEPS = 1024  # of a path


class _Part:
    def __init__(self, world, part, name):
        self._world, self._part = world, part
        self.object: str = name
        self.material: str = part.material.decode()

    def _vertices(self, name, *width):
        return view(getattr(self._part, name), "f4", (self._part.vertex_count, *width), self._world)

    positions = property(lambda self: self._vertices("positions", 3), doc="n x 3 float32, m")
    radii = property(lambda self: self._vertices("radii"), doc="n float32, m, of the branch; or None")
    births = property(lambda self: self._vertices("births"), doc="n float32, 0..1 of the growth; or None")

    @property
    def instances(self) -> Optional[np.ndarray]:
        """k x 3 x 4 float32: instance matrices, last column the translation in m. None = drawn once, untransformed."""
        return view(self._part.instances, "f4", (self._part.instance_count, 3, 4), self._world)

    @property
    def variations(self) -> Optional[np.ndarray]:
        """k float32, 0..1 per instance, for colour variation; or None."""
        return view(self._part.variations, "f4", (self._part.instance_count,), self._world)


class Mesh(_Part):
    """A mesh of a scene's object: positions, radii, births, instances and members below. object, material: names."""

    normals = property(lambda self: self._vertices("normals", 3), doc="n x 3 float32, unit; None = flat")
    uvs = property(lambda self: self._vertices("uvs", 2), doc="n x 2 float32; or None")

    @property
    def faces(self) -> np.ndarray:
        """m x 3 or m x 4 uint32: indices of corners, counter-clockwise seen from outside."""
        return view(self._part.indices, "u4", (self._part.face_count, self._part.face_size), self._world)

    @property
    def triangles(self) -> np.ndarray:
        """The faces as triangles, m x 3 uint32."""
        faces = self.faces
        return faces if faces.shape[1] == 3 else np.concatenate([faces[:, [0, 1, 3]], faces[:, [2, 3, 1]]])


class Curves(_Part):
    """Round curves of a scene's object (twigs, grass): chains of points with radii."""

    @property
    def starts(self) -> np.ndarray:
        """curves + 1 int64: curve i has the points starts[i] .. starts[i + 1] - 1."""
        return view(self._part.starts, "i8", (self._part.curve_count + 1,), self._world)


class World:
    """A scene grown, skinned and placed. parts: its Mesh and Curves, in the order of the scene's objects."""

    def __init__(self, pointer, scene, names):
        self.handle = Handle(pointer, "world_free", scene)
        self._scene = scene
        self.parts: List[Union[Mesh, Curves]] = []
        for i in range(lib.ramify_world_part_count(pointer)):
            part = _abi.Part()
            lib.ramify_world_part(pointer, i, c.byref(part))
            kind = Mesh if part.face_size else Curves
            self.parts.append(kind(self.handle, part, names[part.object]))

    @property
    def info(self) -> Dict[str, Any]:
        """Counts and seconds as a dict: nodes, triangles, curve_segments, instances, bytes, grow_seconds, mesh_seconds."""
        info = _abi.WorldInfo()
        lib.ramify_world_info(self.handle.pointer, c.byref(info))
        return {name: getattr(info, name) for name, *_ in info._fields_}

    def _renderer(self, isa, threads, progress):
        name = None if isa is None else isa.encode()
        return Handle(
            run(
                lambda how, _, error: lib.ramify_renderer_new(self.handle.pointer, name, how, error),
                threads,
                progress,
                discard=lib.ramify_renderer_free,
            ),
            "renderer_free",
            self.handle,
        )

    def render(
        self,
        isa: Optional[str] = None,
        threads: int = 0,
        progress: Progress = None,
        each_pass: Optional[Callable[[Film, int], object]] = None,
        resume: Optional[Film] = None,
    ) -> Film:
        """Path traces the world. isa: "sse4.2" and others pin the instruction set, for the same bits on every machine.
        each_pass(film, samples) is called after 1, 4, 16, 32, 64, ... samples with the Film so far. resume: a Film with
        samples (Film.read), to which the missing ones are added; of an interrupted rendering it becomes what that would
        have made, to the bit. Returns the Film."""
        size = _abi.SceneInfo()
        lib.ramify_scene_info(self._scene.pointer, c.byref(size))
        renderer = self._renderer(isa, threads, progress)
        film = Film(size.width, size.height, self._scene) if resume is None else resume

        def show(_user, _pointer, samples):
            each_pass(film, samples)

        def trace(how, each, error):
            of = renderer.pointer, film.handle.pointer, each
            if resume is None:
                return lib.ramify_renderer_render(*of, None, how, c.byref(film.info), error)
            return lib.ramify_renderer_resume(*of, 0.0, None, how, c.byref(film.info), error)

        run(trace, threads, progress, show if each_pass else None)
        return film

    def replay(self, x: int, y: int, sample: int = 0, isa: Optional[str] = None, threads: int = 0) -> Path:
        """Traces one sample of a pixel again: every ray of its path, for debugging."""
        renderer, error = self._renderer(isa, threads, None), _abi.Error()
        steps, color = (_abi.PathStep * MOST_STEPS)(), (c.c_float * 3)()
        count = lib.ramify_renderer_replay(
            renderer.pointer, self.handle.pointer, x, y, sample, steps, MOST_STEPS, color, c.byref(error)
        )
        check(count + 1, error)  # -1 = failed
        return Path([_step(step) for step in steps[: min(count, MOST_STEPS)]], tuple(color))


def _step(step):
    """A step of a path as a dict."""
    values = {name: getattr(step, name) for name, *_ in step._fields_}
    for name, value in values.items():
        if isinstance(value, bytes):
            values[name] = value.decode()
        elif hasattr(value, "_length_"):
            values[name] = tuple(value)
    return values


class Path(NamedTuple):
    """A path of light: steps, dicts from the camera on (end, material, object, origin, position, direction, normal,
    throughput, light), and the color that it adds to its pixel."""

    steps: List[Dict[str, Any]]
    color: Tuple[float, float, float]


class Film:
    """The result of rendering, with all layers: height x width (x 3) float32 arrays."""

    def __init__(self, width, height, scene, pointer=None):
        error = _abi.Error()
        pointer = pointer or lib.ramify_film_new(width, height, c.byref(error))
        if not pointer:
            raise MemoryError(error.message.decode())
        self.handle = Handle(pointer, "film_free")
        self._scene = scene
        self.width, self.height = width, height
        self.info = _abi.RenderInfo()

    @classmethod
    def _of(cls, scene, make, threads):
        """A Film of the scene that make(how, error) of the library gives."""
        pointer = run(lambda how, _, error: make(how, error), threads, discard=lib.ramify_film_free)
        info = _abi.SceneInfo()
        lib.ramify_scene_info(scene._handle.pointer, c.byref(info))
        return cls(info.width, info.height, scene._handle, pointer)

    @classmethod
    def read(cls, file: File, scene: Any, threads: int = 0) -> Film:
        """Reads the .exr of a picture of this Scene, to go on with it (World.render's resume). BadInput if it is of
        another scene."""
        name = path(file)
        return cls._of(
            scene, lambda how, error: lib.ramify_film_read(name, scene._handle.pointer, how, error), threads
        )

    @classmethod
    def join(cls, files: Iterable[File], scene: Any, threads: int = 0) -> Film:
        """Joins .exr files of parts of this Scene's picture (film.crop); pixels that are in none have 0 samples."""
        names = [path(file) for file in files]
        texts = (c.c_char_p * len(names))(*names)
        return cls._of(
            scene,
            lambda how, error: lib.ramify_film_join(texts, len(names), scene._handle.pointer, None, how, error),
            threads,
        )

    def layer(self, name: str) -> np.ndarray:
        """The layer with this name; KeyError if there is none."""
        channels = c.c_int()
        address = lib.ramify_film_layer(self.handle.pointer, name.encode(), c.byref(channels))
        if not address:
            raise KeyError(name)
        shape = (self.height, self.width) + ((channels.value,) if channels.value > 1 else ())
        return view(address, "f4", shape, self.handle)

    color = property(lambda self: self.layer("color"), doc="x 3: linear mean radiance, premultiplied")
    alpha = property(lambda self: self.layer("alpha"), doc="share that met something, 0..1")
    albedo = property(lambda self: self.layer("albedo"), doc="x 3: of the first hit, 0..1")
    normal = property(lambda self: self.layer("normal"), doc="x 3: of the first hit, mean, not unit")
    depth = property(lambda self: self.layer("depth"), doc="m; inf where nothing was hit")
    position = property(lambda self: self.layer("position"), doc="x 3: of the first hit, m")
    object = property(lambda self: self.layer("object"), doc="number of the scene's object + 1; 0 = none")
    samples = property(lambda self: self.layer("samples"), doc="taken")
    variance = property(lambda self: self.layer("variance"), doc="of the mean luminance")
    denoised = property(lambda self: self.layer("denoised"), doc="x 3: color as denoise() left it")

    @property
    def rgba(self) -> np.ndarray:
        """A copy of color and alpha, height x width x 4."""
        return np.dstack([self.layer("color"), self.layer("alpha")])

    def denoise(self, threads: int = 0) -> None:
        """Removes the noise by the scene's film.denoiser: makes the layer denoised, which save then uses. The layer goes
        when the film is rendered again. There is none if the first pass was cancelled."""
        run(
            lambda how, _, error: lib.ramify_film_denoise(self.handle.pointer, self._scene.pointer, how, error),
            threads,
        )

    def noise(self) -> float:
        """The noise of the developed picture before denoising, as a share of white: the standard error of its display
        values, mean over the crop, as if samples were independent. NaN if no pixel has two samples."""
        noise = c.c_double()
        call("film_noise", self.handle.pointer, self._scene.pointer, c.byref(noise))
        return noise.value

    def save(self, file: File, denoise: Optional[bool] = None, threads: int = 0) -> None:
        """Writes .png or .jpg, developed by the scene's film, or .exr, linear with all layers, denoised among them if
        denoise. denoise: None = the scene's setting."""
        if denoise is None:
            info = _abi.SceneInfo()
            lib.ramify_scene_info(self._scene.pointer, c.byref(info))
            denoise = info.denoise
        name = path(file)
        denoise = bool(denoise)
        run(
            lambda how, _, error: lib.ramify_film_write(
                self.handle.pointer, self._scene.pointer, name, denoise, how, error
            ),
            threads,
        )
