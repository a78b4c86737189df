"""Cycles through Blender as a Python module (bpy); loaded by renderers.worker.

Blender's z points up: a vector (x, y, z) of the scenes is (z, x, y) there, a rotation.
"""

import os
import time

import bpy
import numpy as np
from mathutils import Matrix, Vector

from .scenes import LEAF_UNDERSIDE
from .worker import Drawing

TRANSPARENT_BOUNCES = 1024  # index-matched surfaces that a path crosses, more than any does


def turned(v):
    return Vector((v[2], v[0], v[1]))


# ---- materials


class Nodes:
    """The node tree of a material or world, emptied."""

    def __init__(self, owner):
        owner.use_nodes = True
        self.tree = owner.node_tree
        self.tree.nodes.clear()

    def add(self, kind, **inputs):
        node = self.tree.nodes.new(kind)
        for name, value in inputs.items():
            socket = node.inputs[name.replace("_", " ")]
            if isinstance(value, bpy.types.Node):
                self.tree.links.new(value.outputs[0], socket)
            else:
                socket.default_value = value
        return node

    def join(self, a, b):
        """The sum of two shaders."""
        node = self.tree.nodes.new("ShaderNodeAddShader")
        self.tree.links.new(a.outputs[0], node.inputs[0])
        self.tree.links.new(b.outputs[0], node.inputs[1])
        return node


def grey(value):
    return (value, value, value, 1.0)


def diffuse(nodes, material):
    return "Surface", nodes.add("ShaderNodeBsdfDiffuse", Color=grey(material.reflectance))


def leaf(nodes, material):
    side = nodes.tree.nodes.new("ShaderNodeNewGeometry")
    color = nodes.add("ShaderNodeMapRange", To_Min=material.reflectance, To_Max=material.reflectance * LEAF_UNDERSIDE)
    nodes.tree.links.new(side.outputs["Backfacing"], color.inputs["Value"])
    through = nodes.add("ShaderNodeBsdfTranslucent", Color=grey(material.transmittance))
    return "Surface", nodes.join(nodes.add("ShaderNodeBsdfDiffuse", Color=color), through)


def glass(nodes, material):
    return "Surface", nodes.add("ShaderNodeBsdfGlass", Color=grey(1.0), Roughness=0.0, IOR=material.ior)


def emission(nodes, material):
    strength = max(material.radiance)
    color = tuple(c / strength for c in material.radiance) + (1.0,)
    return "Surface", nodes.add("ShaderNodeEmission", Color=color, Strength=strength)


def medium(nodes, material):
    scatters = nodes.add("ShaderNodeVolumeScatter", Color=grey(1.0), Density=material.scattering, Anisotropy=0.0)
    absorbs = nodes.add("ShaderNodeVolumeAbsorption", Color=grey(0.0), Density=material.absorption)
    return "Volume", nodes.join(scatters, absorbs)


SHADERS = {"diffuse": diffuse, "leaf": leaf, "glass": glass, "emission": emission, "medium": medium}


def make_material(name, material):
    made = bpy.data.materials.new(name)
    nodes = Nodes(made)
    output = nodes.add("ShaderNodeOutputMaterial")
    socket, shader = SHADERS[material.kind](nodes, material)
    nodes.tree.links.new(shader.outputs[0], output.inputs[socket])
    made.cycles.emission_sampling = "FRONT" if material.kind == "emission" else "NONE"
    return made


# ---- the scene


def add_mesh(scene, folder, name, material):
    with np.load(os.path.join(folder, f"{name}.npz")) as file:
        vertices, triangles = file["vertices"][:, [2, 0, 1]], file["triangles"]
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(vertices))
    mesh.vertices.foreach_set("co", np.ascontiguousarray(vertices).ravel())
    mesh.loops.add(triangles.size)
    mesh.loops.foreach_set("vertex_index", triangles.ravel())
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, triangles.size, 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    mesh.shade_flat()
    mesh.materials.append(make_material(name, material))
    scene.collection.objects.link(bpy.data.objects.new(name, mesh))


def set_camera(scene, camera):
    position, target = turned(camera.position), turned(camera.target)
    ahead = (target - position).normalized()
    right = ahead.cross(Vector((0, 0, 1))).normalized()
    up = right.cross(ahead)
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit, lens.angle = "VERTICAL", np.radians(camera.fov)
    lens.clip_start, lens.clip_end = 0.01, 1e4
    scene.camera = bpy.data.objects.new("camera", lens)
    axes = Matrix((right, up, -ahead)).transposed()
    scene.camera.matrix_world = Matrix.Translation(position) @ axes.to_4x4()
    scene.collection.objects.link(scene.camera)


def set_sky(scene, job):
    scene.world = bpy.data.worlds.new("sky")
    nodes = Nodes(scene.world)
    light = nodes.add("ShaderNodeBackground", Color=grey(1.0), Strength=0.0 if job.scene.sky == "none" else 1.0)
    if job.scene.sky == "picture":
        picture = nodes.add("ShaderNodeTexEnvironment")
        picture.image = bpy.data.images.load(job.sky_file)
        picture.image.colorspace_settings.name = "Linear Rec.709"
        nodes.tree.links.new(picture.outputs[0], light.inputs["Color"])
    nodes.tree.links.new(light.outputs[0], nodes.add("ShaderNodeOutputWorld").inputs["Surface"])


def set_tracer(scene, job):
    """Unbiased, without adaption or denoising; its light tree and its sampling pattern are left on."""
    scene.render.engine = "CYCLES"
    tracer, bounces = scene.cycles, job.scene.depth - 1
    tracer.device = "CPU"
    tracer.use_denoising = tracer.use_adaptive_sampling = tracer.use_fast_gi = tracer.volume_biased = False
    tracer.sample_clamp_direct = tracer.sample_clamp_indirect = tracer.blur_glossy = tracer.light_sampling_threshold = 0.0
    tracer.caustics_reflective = tracer.caustics_refractive = tracer.use_light_tree = True
    for kind in ("max", "diffuse", "glossy", "transmission", "volume"):
        setattr(tracer, f"{kind}_bounces", bounces)
    tracer.transparent_max_bounces = TRANSPARENT_BOUNCES
    tracer.pixel_filter_type, tracer.use_auto_tile = "BOX", False


def set_film(scene, job):
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = job.width, job.height, 100
    render.threads_mode, render.threads, render.use_persistent_data = "FIXED", job.threads, True
    render.film_transparent = render.use_compositing = render.use_sequencer = False
    render.dither_intensity = 0.0
    settings = render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"


def last_picture(path, width, height):
    """The last render's radiance, by way of a file: bpy gives no pixels of it without a window."""
    bpy.data.images["Render Result"].save_render(path)
    picture = bpy.data.images.load(path)
    pixels = np.empty(width * height * picture.channels, np.float32)
    picture.pixels.foreach_get(pixels)
    channels = picture.channels
    bpy.data.images.remove(picture)
    return pixels.reshape(height, width, channels)[::-1, :, :3]


def load(job):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    for name, material in job.scene.objects:
        add_mesh(scene, job.folder, name, material)
    set_camera(scene, job.scene.camera)
    set_sky(scene, job)
    set_tracer(scene, job)
    set_film(scene, job)
    path = os.path.join(job.folder, "cycles.exr")

    def draw(samples, seed):
        scene.cycles.samples, scene.cycles.seed = samples, seed
        start = time.perf_counter()
        bpy.ops.render.render()
        seconds = time.perf_counter() - start
        return Drawing(last_picture(path, job.width, job.height), seconds)

    return draw
