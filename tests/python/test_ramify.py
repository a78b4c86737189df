"""What a pipeline does with the module."""

import copy
import ctypes
import gc
import inspect
import json
import os
import pickle
import signal
import threading
import time
import typing
import weakref

import numpy as np
import pytest

import ramify
from ramify._call import lib, run

BUSH = {
    "seed": 3,
    "camera": {"position": [0, 1, 4], "target": [0, 0.6, 0], "fov": 40},
    "film": {"width": 24, "height": 16},
    "render": {"samples": 4},
    "sky": {"kind": "constant", "color": [1, 1, 1]},
    "objects": [
        {
            "name": "bush",
            "tree": {
                "height": 3,
                "crown": {
                    "lobes": 0,
                    "growth": {"levels": [{"attractors": 20, "step": 0.1, "kill": 0.4, "influence": 4}, {"attractors": 300}]},
                },
                "leaves": {"max_count": 500},
            },
        },
        {"name": "ball", "shape": {"envelope": [{"shape": "sphere", "size": 0.3, "position": [1, 0.3, 0]}]}},
    ],
}
SLOW = {**BUSH, "render": {"samples": 1 << 22}}


@pytest.fixture(scope="module")
def scene():
    return ramify.Scene(BUSH)


@pytest.fixture(scope="module")
def world(scene):
    return scene.build()


def test_a_scene_tells_what_it_holds(scene):
    assert scene.objects == {"bush": "tree", "ball": "shape"}
    assert (scene.width, scene.height, scene.samples, scene.seed) == (24, 16, 4, 3)
    assert "phyllotaxis" in scene.resolved


def test_dict_file_and_overrides_are_the_same_scene(scene, tmp_path):
    file = tmp_path / "bush.yaml"
    file.write_text(json.dumps({**BUSH, "seed": 9}))
    loaded = ramify.Scene.load(file, {"seed": 3})
    assert loaded.grow("bush").hash == scene.grow("bush").hash
    assert ramify.Scene.load(file).grow("bush").hash != scene.grow("bush").hash


def test_numpy_numbers_and_awkward_names_pass_into_scenes():
    name = 'a "bush" — ü\n\t#: {x}'
    described = {**BUSH, "seed": np.int64(3), "objects": [{"name": "b", "ground": {}}]}
    described["camera"] = {"position": np.array([0, 1, 4], "f4"), "target": (0, 0.6, 1e-7), "fov": np.float32(40)}
    assert ramify.Scene(described).objects == {"b": "ground"}
    with pytest.raises(ramify.BadInput) as caught:
        ramify.Scene({**BUSH, name: 1})
    assert "unknown key" in str(caught.value)
    with pytest.raises(TypeError):
        ramify.Scene({**BUSH, "seed": object()})
    with pytest.raises(ValueError):
        ramify.Scene({**BUSH, "camera": {"fov": float("nan")}})


def test_errors_say_where_and_what(tmp_path):
    file = tmp_path / "wrong.yaml"
    file.write_text("seed: 1\ncamera:\n  fvo: 3\n")
    with pytest.raises(ramify.BadInput) as caught:
        ramify.Scene.load(file)
    assert (caught.value.code, caught.value.line, caught.value.column) == ("bad_input", 3, 3)
    assert caught.value.file == str(file) and "did you mean 'fov'?" in caught.value.message
    assert isinstance(caught.value, ValueError) and str(file) in str(caught.value)
    with pytest.raises(ramify.BadInput, match="does not grow"):
        ramify.Scene(BUSH).grow("ball")
    with pytest.raises(KeyError, match="bush"):
        ramify.Scene(BUSH).grow("bsh")


def test_out_trees_are_arrays(scene):
    tree = scene.grow("bush", threads=1)
    n = len(tree)
    assert n > 100 and tree.positions.shape == (n, 3) and tree.positions.dtype == np.float32
    assert tree.parents[0] == -1 and np.all(tree.parents < np.arange(n))
    child = tree.parents >= 0
    assert np.all(tree.births[child] >= tree.births[tree.parents[child]])
    assert np.all(tree.radii > 0) and len(np.unique(tree.ids)) == n
    assert np.allclose(np.linalg.norm(tree.normals, axis=1), 1, atol=1e-4)
    assert scene.grow("bush", threads=2).hash == tree.hash
    with pytest.raises(ValueError):
        tree.positions[0, 0] = 1


def test_lengths_agree_with_the_measures(scene):
    tree = scene.grow("bush")
    child = tree.parents >= 0
    steps = tree.positions[child].astype("f8") - tree.positions[tree.parents[child]]
    assert np.isclose(np.linalg.norm(steps, axis=1).sum(), tree.measure()["length"], rtol=1e-5)
    assert scene.measure("bush")["length"] == tree.measure()["length"]


def test_arrays_outlive_what_gave_them(scene):
    positions = ramify.Scene(BUSH).grow("bush").positions
    again = scene.grow("bush").positions
    vertices = ramify.Scene(BUSH).build().parts[0].positions
    kept = vertices.copy()
    gc.collect()
    ballast = [ramify.Scene(BUSH).grow("bush") for _ in range(3)]
    assert np.array_equal(positions, again) and np.array_equal(vertices, kept) and len(ballast) == 3


def test_memory_goes_with_the_last_that_needs_it(scene):
    """At once: pictures are large, and the garbage collector does not see how large."""
    gc.collect()
    gc.disable()
    try:
        film = scene.render(progress=lambda stage, done: None, each_pass=lambda film, samples: film.samples)
        tree, world = scene.grow("bush", progress=lambda stage, done: None), scene.build()
        vertices = world.parts[0].positions
        held = [weakref.ref(thing) for thing in (film.handle, tree._handle, world.handle)]
        film = tree = world = None
        assert [ref() is None for ref in held] == [True, True, False]
        vertices = None
        assert held[2]() is None
    finally:
        gc.enable()


def test_what_the_library_holds_is_not_copied(scene):
    for thing in (scene, scene.grow("bush"), scene.render()):
        with pytest.raises(TypeError, match="copy its arrays"):
            copy.deepcopy(thing)
        with pytest.raises(TypeError, match="copy its arrays"):
            pickle.dumps(thing)
    film = scene.render()
    again = copy.copy(film)
    assert again.color.base is not None and np.array_equal(again.color, film.color)


def test_names_of_files_end_where_they_end(scene, tmp_path):
    for write in (scene.grow("bush").write, scene.export, scene.render().save, ramify.Scene.load, ramify.Tree.read):
        with pytest.raises(ValueError, match="NUL"):
            write(f"{tmp_path}/a.swc\0.glb")
        with pytest.raises(TypeError):
            write(None)
    assert not list(tmp_path.iterdir())


def test_trees_are_written_and_read(scene, tmp_path):
    tree = scene.grow("bush")
    tree.write(tmp_path / "bush.swc")
    back = ramify.Tree.read(tmp_path / "bush.swc")
    assert np.array_equal(back.positions, tree.positions) and np.array_equal(back.radii, tree.radii)
    (tmp_path / "bad.swc").write_text("1 0 0 0 0 x -1\n")
    with pytest.raises(ramify.BadInput) as caught:
        ramify.Tree.read(tmp_path / "bad.swc")
    assert caught.value.line == 1


def test_land_is_an_array(tmp_path):
    scene = ramify.Scene({"objects": [{"name": "hills", "terrain": {"resolution": 64}}]})
    land = scene.land("hills")
    assert land.heights.ndim == 2 and land.heights.dtype == np.float32 and np.ptp(land.heights) > 0
    assert land.cell[0] > 0 and "relief" in land.measure()
    with pytest.raises(ramify.Error):
        scene.tile("hills", land, 0, 0)  # it is not cut
    land.write(tmp_path / "hills.asc")
    assert np.allclose(ramify.Land.read(tmp_path / "hills.asc").heights, land.heights, atol=1e-3)


def test_meshes_are_watertight_arrays(scene, world):
    ball = next(p for p in world.parts if p.object == "ball")
    assert isinstance(ball, ramify.Mesh) and ball.instances is None
    _, same = np.unique(ball.positions, axis=0, return_inverse=True)  # seams of uv hold a place twice
    t = same.reshape(-1)[ball.triangles]
    t = t[(t[:, 0] != t[:, 1]) & (t[:, 1] != t[:, 2]) & (t[:, 2] != t[:, 0])]
    edges = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    forward, backward = edges[:, 0] << 32 | edges[:, 1], edges[:, 1] << 32 | edges[:, 0]
    assert len(np.unique(forward)) == len(forward) and set(forward) == set(backward)
    a, b, c = (ball.positions[ball.triangles[:, k]].astype("f8") - [1, 0.3, 0] for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    assert np.isclose(volume, 4 / 3 * np.pi * 0.3**3, rtol=0.03)
    stored = sum(len(p.triangles) for p in world.parts if isinstance(p, ramify.Mesh))
    assert stored == world.info["triangles"]
    leaves = [p for p in world.parts if p.instances is not None]
    assert leaves and leaves[0].instances.shape[1:] == (3, 4)
    for p in world.parts:
        if isinstance(p, ramify.Curves):
            assert p.starts[-1] == len(p.positions)


def test_pictures_are_arrays_and_files(scene, tmp_path):
    stages = []
    film = scene.render(isa="sse4.2", progress=lambda stage, done: stages.append((stage, done)))
    assert film.rgba.shape == (16, 24, 4) and np.isfinite(film.rgba).all()
    assert film.color.shape == (16, 24, 3) and film.depth.shape == (16, 24) and film.info.samples == 4
    assert {"build"} <= {stage for stage, _ in stages} and all(0 <= done <= 1 for _, done in stages)
    assert np.array_equal(film.rgba, ramify.render(BUSH, tmp_path / "bush.png", isa="sse4.2", threads=1).rgba)
    assert (tmp_path / "bush.png").read_bytes()[:4] == b"\x89PNG"
    film.save(tmp_path / "bush.exr")
    assert (tmp_path / "bush.exr").stat().st_size > 1000
    with pytest.raises(KeyError):
        film.denoised
    film.denoise()
    assert film.denoised.shape == (16, 24, 3) and not np.array_equal(film.denoised, film.color)
    assert 0.0 < film.noise() < 0.5
    film.save(tmp_path / "both.exr", denoise=True)
    assert b"denoised.R" in (tmp_path / "both.exr").read_bytes()
    with pytest.raises(ramify.Error):
        film.save(tmp_path / "nowhere" / "bush.png")
    with pytest.raises(AttributeError):
        film.colour


def test_a_picture_is_read_and_finished(tmp_path):
    few, many = ramify.Scene({**BUSH, "render": {"samples": 2, "planned_samples": 4}}), ramify.Scene(
        {**BUSH, "render": {"samples": 4, "planned_samples": 4}}
    )
    few.render(isa="sse4.2").save(tmp_path / "few.exr")
    film = ramify.Film.read(tmp_path / "few.exr", many)
    assert film.samples.max() == 2
    many.render(isa="sse4.2", resume=film)
    assert film.samples.max() == 4 and np.allclose(film.rgba, many.render(isa="sse4.2").rgba, rtol=1e-5, atol=1e-6)
    with pytest.raises(ramify.BadInput):
        ramify.Film.read(tmp_path / "few.exr", ramify.Scene({**BUSH, "seed": 5}))


def test_parts_are_joined(tmp_path):
    parts = []
    for name, crop in (("left", [0, 0, 0.5, 1]), ("right", [0.5, 0, 1, 1])):
        parts.append(tmp_path / f"{name}.exr")
        ramify.Scene({**BUSH, "film": {**BUSH["film"], "crop": crop}}).render(isa="sse4.2").save(parts[-1])
    whole = ramify.Scene(BUSH)
    assert np.array_equal(ramify.Film.join(parts, whole).rgba, whole.render(isa="sse4.2").rgba)
    assert (ramify.Film.join(parts[:1], whole).samples == 0).any()


def test_paths_add_up_to_the_pixel(world):
    film = world.render(isa="sse4.2")
    paths = [world.replay(12, 8, i, isa="sse4.2") for i in range(film.info.samples)]
    assert np.allclose(np.mean([p.color for p in paths], axis=0), film.color[8, 12], rtol=1e-4, atol=1e-6)
    assert paths[0].steps[0]["end"] in ("surface", "lamp", "medium", "outside")
    with pytest.raises(ramify.BadInput):
        world.replay(1000, 0)


def test_estimate_and_species(scene):
    estimate = scene.estimate()
    assert estimate["paths"] == 24 * 16 * 4 and estimate["memory"] > 1e6 and estimate["trace_seconds"] > 0
    assert "Quercus robur" in ramify.species()


def test_a_wrong_file_is_refused_before_the_work(tmp_path):
    for file in (tmp_path / "x.xyz", tmp_path / "nowhere" / "x.png", tmp_path):
        start = time.monotonic()
        with pytest.raises(ramify.Error):
            ramify.render(SLOW, file)
        assert time.monotonic() - start < 60


def test_a_missing_denoiser_is_told_before_the_work(tmp_path, monkeypatch):
    monkeypatch.setenv("RAMIFY_OIDN", str(tmp_path / "none.so"))
    scene = {**SLOW, "film": {"denoise": True, "denoiser": "oidn"}}
    start = time.monotonic()
    with pytest.raises(ramify.BadInput, match="film.denoiser is oidn, but Open Image Denoise cannot be loaded"):
        ramify.render(scene, tmp_path / "x.png")
    assert time.monotonic() - start < 60


def test_an_argument_that_c_cannot_take_is_an_error_and_no_hang(scene, world):
    film = scene.render()
    with pytest.raises(ValueError):
        film.save("x.png", denoise=np.zeros(2))
    for what in ({"progress": 3}, {"threads": "two"}, {"each_pass": 3}):
        with pytest.raises(TypeError):
            world.render(**what)
    with pytest.raises(ctypes.ArgumentError):
        run(lambda how, _, error: lib.ramify_grow(scene._handle.pointer, "bush", how, error))


def test_every_pass_can_be_seen(world):
    seen = []
    film = world.render(each_pass=lambda film, samples: seen.append((samples, float(film.samples.min()))))
    assert [s for s, _ in seen] == sorted({s for s, _ in seen}) and seen[-1][0] == 4
    assert film.samples.min() == 4


def test_export_reports_what_it_wrote(scene, tmp_path):
    report = scene.export(tmp_path / "ball.ply", objects=["ball"])
    assert report["bytes"] == (tmp_path / "ball.ply").stat().st_size and report["triangles"] > 100
    assert np.allclose(report["high"], (1.3, 0.6, 0.3), atol=0.02)
    assert scene.export(tmp_path / "ball.ply", objects="ball") == report == scene.export(tmp_path / "ball.ply", objects=[1])
    with pytest.raises(ramify.BadInput, match="did you mean 'ball'"):
        scene.export(tmp_path / "ball.ply", objects=["bal"])
    with pytest.raises(ramify.BadInput):
        scene.export(tmp_path / "ball.xyz")
    with pytest.raises(ValueError, match="auto, nodes"):
        scene.export(tmp_path / "ball.glb", instances="none")


def test_an_exception_in_progress_ends_the_run():
    class Enough(Exception):
        pass

    def stop(stage, done):
        raise Enough

    with pytest.raises(Enough):
        ramify.Scene(SLOW).render(progress=stop)


def test_ctrl_c_ends_the_run():
    signal.signal(signal.SIGINT, signal.default_int_handler)  # which a program in the background is started without
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    start = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        ramify.Scene(SLOW).render()
    assert time.monotonic() - start < 120


def test_threads_of_python_may_grow_at_the_same_time(scene):
    expected, found = scene.grow("bush").hash, []
    workers = [threading.Thread(target=lambda: found.append(ramify.Scene(BUSH).grow("bush").hash)) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert found == [expected] * 4


def test_warnings_are_pythons():
    far = {"attractors": 300, "influence": 2e-3, "kill": 1e-3, "step": 1e-3}
    alone = {"name": "bush", "tree": {"height": 3, "crown": {"growth": {"levels": [far]}}}}
    with pytest.warns(RuntimeWarning, match="influence"):
        try:
            ramify.Scene({"objects": [alone]}).grow("bush")
        except ramify.Error:
            pass


WEED = {
    "objects": [{"name": "weed", "lsystem": {"height": 12, "generations": 3}}],
    "targets": [{"object": "weed", "measure": "height", "low": 6, "high": 7}],
}
HEIGHT = "objects.weed.lsystem.height"


def test_a_fit_meets_targets(tmp_path):
    seen = []
    scene = ramify.Scene(WEED)
    fit = scene.fit({HEIGHT: (np.float32(2), 20)}, each_evaluation=seen.append)
    assert fit.met and fit.best == fit.evaluations[-1] and seen == fit.evaluations
    assert fit.targets == [("weed", "height", 6, 7)]
    assert fit.evaluations[0].misfit > 0 and fit.evaluations[0].parameters == {HEIGHT: pytest.approx(12, abs=1e-3)}
    assert fit.best.misfit == 0 and fit.best.failure is None
    assert fit.best.measures == (scene_height(ramify.Scene(WEED, fit.best.parameters)),)
    del scene
    fit.write(tmp_path / "fitted.yaml")
    assert 6 <= scene_height(ramify.Scene.load(tmp_path / "fitted.yaml")) <= 7
    fit.draw(tmp_path / "way.svg")
    assert "<svg" in (tmp_path / "way.svg").read_text()


def scene_height(scene):
    return scene.measure("weed")["height"]


def test_a_fit_spends_what_it_may(tmp_path):
    alike = {"height": 3, "generations": 3}
    text = f"objects: [{{name: a, lsystem: &same {alike}}}, {{name: b, lsystem: *same}}]\n".replace("'", "")
    file = tmp_path / "alias.yaml"
    file.write_text(text + "targets: [{object: b, measure: height, low: 3.9, high: 4.5}]\n")
    fit = ramify.Scene.load(file).fit({"objects.b.lsystem.height": (2, 5, "log")}, 4, "evaluations")
    assert len(fit.evaluations) == 4
    with pytest.warns(RuntimeWarning, match="all values written out"):
        fit.write(tmp_path / "whole.yaml")


def test_a_fit_refuses_and_ends():
    scene = ramify.Scene(WEED)
    for ranges, how in (({}, {}), ({HEIGHT: (20, 2)}, {}), ({"objects.weed.lsystem.hight": (2, 20)}, {})):
        with pytest.raises(ramify.BadInput):
            scene.fit(ranges, **how)
    for ranges, how in (({HEIGHT: (2, 20, "ln")}, {}), ({HEIGHT: (2, 20)}, {"until": "morning"})):
        with pytest.raises(ValueError, match="must be"):
            scene.fit(ranges, **how)

    def stop(evaluation):
        raise StopIteration(evaluation.misfit)

    with pytest.raises(StopIteration):
        scene.fit({HEIGHT: (2, 20)}, each_evaluation=stop)
    with pytest.raises(ramify.Error, match="/nowhere/fit.yaml"):
        scene.fit({HEIGHT: (2, 20)}).write("/nowhere/fit.yaml")


def test_what_is_public_has_types():
    public = [ramify.render, ramify.schema]
    for kind in (ramify.Scene, ramify.Tree, ramify.Land, ramify.World, ramify.Film, ramify.Fit):
        public += [getattr(kind, name) for name, f in vars(kind).items() if name[0] != "_" and not isinstance(f, property)]
    assert len(public) > 15
    for function in public:
        taken = [name for name in inspect.signature(function).parameters if name != "self"]
        assert {"return", *taken} <= set(typing.get_type_hints(function)), function


def test_the_schema_is_a_dict():
    assert ramify.schema()["title"] == "ramify scene"
