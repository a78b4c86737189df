"""The scenes that every renderer draws, and how a worker gets them."""

import dataclasses
import json
from dataclasses import dataclass

LEAF_UNDERSIDE = 1.45  # ramify's: the underside of a leaf reflects so much more


@dataclass(frozen=True)
class Material:
    """kind: diffuse (reflectance), leaf (reflectance, transmittance), glass (ior), emission (radiance) or medium
    (scattering and absorption in 1/m, behind an index-matched surface)."""

    kind: str
    reflectance: float = 0.0
    transmittance: float = 0.0
    ior: float = 1.0
    radiance: tuple = (0.0, 0.0, 0.0)
    scattering: float = 0.0
    absorption: float = 0.0


@dataclass(frozen=True)
class Camera:
    """position and target in metres; fov: the vertical angle of view in degrees."""

    position: tuple
    target: tuple
    fov: float


@dataclass(frozen=True)
class Scene:
    """objects: pairs of a mesh's name and a material. sky: white, picture or none. depth: most bounces of a path."""

    name: str
    title: str
    camera: Camera
    sky: str
    objects: tuple
    depth: int = 12


@dataclass(frozen=True)
class Job:
    """What a renderer draws: a scene with the folder of its meshes, the sky's picture and the image's size."""

    scene: Scene
    folder: str
    sky_file: str
    width: int
    height: int
    threads: int

    def to_json(self):
        return json.dumps(dataclasses.asdict(self))

    @staticmethod
    def from_json(text):
        fields = json.loads(text)
        scene = fields.pop("scene")
        scene["camera"] = Camera(**scene["camera"])
        scene["objects"] = tuple((mesh, Material(**material)) for mesh, material in scene["objects"])
        return Job(scene=Scene(**scene), **fields)


MATT = Material("diffuse", reflectance=0.5)
LEAF = Material("leaf", reflectance=0.3, transmittance=0.3)
GROUND = ("ground", MATT)
TREE = Camera(position=(-4.5, 1.45, 23.5), target=(0.6, 6.15, 0.0), fov=38.5)
BODY = Camera(position=(2.0, 1.3, -3.0), target=(0.0, 0.8, 0.0), fov=38.0)
BOX = Camera(position=(3.2, 2.4, 4.2), target=(0.0, 0.9, 0.0), fov=40.0)

SCENES = {
    scene.name: scene
    for scene in (
        Scene("s1", "bare tree, white sky", TREE, "white", (GROUND, ("bare", MATT))),
        Scene("s2", "bare tree, HDR sky", TREE, "picture", (GROUND, ("bare", MATT))),
        Scene("s3", "leaves, HDR sky", TREE, "picture", (GROUND, ("bark", MATT), ("leaves", LEAF))),
        Scene("s4", "glass, HDR sky", BODY, "picture", (GROUND, ("body", Material("glass", ior=1.5)))),
        Scene(
            "s5",
            "3,000 lamps",
            TREE,
            "none",
            (GROUND, ("bare", MATT), ("lamps", Material("emission", radiance=(40.0, 30.0, 15.0)))),
        ),
        Scene(
            "s6",
            "a medium",
            BOX,
            "none",
            (
                GROUND,
                ("box", Material("medium", scattering=1.6, absorption=0.4)),
                ("bulb", Material("emission", radiance=(20.0, 20.0, 20.0))),
            ),
            depth=100,
        ),
    )
}
