"""ramify, run as its command: the time is the one that it reports for tracing."""

import json
import os
import subprocess

import mitsuba
import numpy

from .worker import Drawing, RendererFailed

SKIES = {"white": "{kind: constant, color: 1}", "none": "{kind: none}"}


def material_text(name, material):
    values = {
        "diffuse": f"kind: diffuse, color: {material.reflectance}",
        "leaf": f"kind: leaf, color: {material.reflectance}, transmittance: {material.transmittance}, specular: 0",
        "glass": f"kind: dielectric, ior: {material.ior}, roughness: 0",
        "emission": f"kind: emission, radiance: {list(material.radiance)}",
        "medium": f"kind: dielectric, ior: 1, scattering: {material.scattering}, absorption: {material.absorption}",
    }[material.kind]
    return f"  - {{name: of-{name}, {values}}}\n"


def scene_text(job):
    """The scene file: no lens, no filter wider than a pixel, nothing done to the light."""
    scene, camera = job.scene, job.scene.camera
    sky = SKIES.get(scene.sky) or f"{{kind: environment, file: {json.dumps(job.sky_file)}}}"
    objects = "".join(f"  - {{name: {mesh}, material: of-{mesh}, mesh: {{file: {mesh}.ply}}}}\n" for mesh, _ in scene.objects)
    return (
        f"camera: {{position: {list(camera.position)}, target: {list(camera.target)}, fov: {camera.fov}}}\n"
        f"film: {{width: {job.width}, height: {job.height}, filter: box, filter_radius: 0.5, bloom: 0, vignette: 0}}\n"
        f"render: {{max_depth: {scene.depth}, clamp: 0, noise: 0}}\n"
        f"sky: {sky}\n"
        f"materials:\n{''.join(material_text(*pair) for pair in scene.objects)}"
        f"objects:\n{objects}"
    )


def read_exr(path):
    """The radiance of an EXR file, (height, width, 3)."""
    mitsuba.set_variant("scalar_rgb")
    color = dict(mitsuba.Bitmap(path).split())["<root>"]
    return numpy.array(color, dtype=numpy.float32)[..., :3]


class Ramify:
    name = "ramify"

    def __init__(self, job, binary):
        self.job, self.binary = job, binary
        self.scene = os.path.join(job.folder, f"{job.scene.name}.yaml")
        with open(self.scene, "w") as file:
            file.write(scene_text(job))

    def draw(self, samples, seed):
        target = os.path.join(self.job.folder, "ramify.png")
        done = subprocess.run(
            [self.binary, "render", self.scene, "-o", target, "--samples", str(samples)]
            + ["--threads", str(self.job.threads), "--set", f"render.noise_seed={seed}", "--no-denoise", "--no-preview", "--json", "-q"],
            capture_output=True,
            text=True,
        )
        if done.returncode:
            raise RendererFailed(f"ramify: {done.stderr.strip()}")
        return Drawing(read_exr(target.replace(".png", ".exr")), json.loads(done.stdout)["seconds"]["trace"])
