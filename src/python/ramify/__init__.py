"""ramify: grows branching things, skins them with watertight meshes and path traces them.

    import ramify

    scene = ramify.Scene.load("oak.yaml", {"camera.fov": 35})
    tree = scene.grow("oak")                    # tree.positions, tree.parents, ... are NumPy arrays
    film = scene.render()                       # film.rgba is height x width x 4, linear, premultiplied
    film.save("oak.png")

    ramify.Scene({"sky": {"kind": "sun_sky"}, "objects": [{"name": "oak", "tree": {"height": 9}}]}).export("oak.glb")

Metres, degrees, Y up, right-handed, linear Rec. 709 colours. The same scene and seed give the same bits for any number of
threads. Arrays are read-only views of the library's memory; copy one to change it. Objects are named by their name in
the scene or by their number. Everything that takes long takes threads (0 = all processors) and progress, a function of
(stage, done) with done in 0..1; Ctrl-C and an exception in progress end it early.
"""

from typing import Any, Dict, Mapping, Optional, Union

from ._call import BadInput, Error, File, VERSION as __version__, call, path
from .fit import Evaluation, Fit, Target
from .scene import Scene, schema, species
from .tree import Land, Tree
from .world import Film, Mesh, Curves, World

__all__ = [
    "BadInput",
    "Curves",
    "Error",
    "Evaluation",
    "Film",
    "Fit",
    "Land",
    "Mesh",
    "Scene",
    "Target",
    "Tree",
    "World",
    "schema",
    "species",
    "render",
]


def render(
    scene: Union[Scene, Dict[str, Any], File],
    file: Optional[File] = None,
    overrides: Optional[Mapping[str, Any]] = None,
    folder: File = "",
    **how: Any,
) -> Film:
    """Renders a scene, a dict or the name of a scene file, and writes it to file if given. Returns the Film."""
    if not isinstance(scene, Scene):
        scene = Scene(scene, overrides, folder) if isinstance(scene, dict) else Scene.load(scene, overrides)
    if file is not None:
        call("image_check", path(file))  # before the work, not after it
        if not path(file).lower().endswith(b".exr"):
            call("develop_check", scene._handle.pointer)
    film = scene.render(**how)
    if file is not None:
        film.save(file)
    return film
