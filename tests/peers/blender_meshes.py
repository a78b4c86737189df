"""blender -b --factory-startup --python blender_meshes.py -- FOLDER CHECK...

Imports files that ramify wrote and holds them against what it reported. CHECK is NAME:FILE:REPORT:WHAT, where REPORT holds
the line that ramify export --json printed and WHAT is a list of: closed (every edge of every mesh joins two faces, which look
outward), normals (those of the file's vertices are those of PLY.ply, whose vertices stand in the same order), instances,
objects=N (at most so many), textured, lit, glow=SCENE.usda (the light of one part's tubes is that of the curves in that file). Prints "ok NAME" or "not ok NAME: why" a line.
"""
import json
import re
import struct
import sys

import bmesh
import bpy
import numpy
from mathutils import Vector

if "bool" not in vars(numpy):
    numpy.bool = bool  # Debian 12's glTF add-on still asks for what its NumPy has dropped


def load(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if path.endswith(".glb"):
        bpy.ops.import_scene.gltf(filepath=path)
    elif path.endswith(".obj"):
        bpy.ops.wm.obj_import(filepath=path)  # turns Y up into Z up, as glTF's does
    elif path.endswith(".ply"):
        bpy.ops.import_mesh.ply(filepath=path)
    else:
        bpy.ops.import_mesh.stl(filepath=path)
    bpy.context.view_layer.update()
    return [o for o in bpy.context.scene.objects if o.type == "MESH"]


def ours(path, p):
    """A place of Blender's scene in the axes of the file."""
    return (p.x, p.z, -p.y) if path.endswith((".glb", ".obj")) else (p.x, p.y, p.z)


def measure(path, meshes):
    triangles, low, high = 0, [1e30] * 3, [-1e30] * 3
    for thing in meshes:
        mesh = thing.data
        mesh.calc_loop_triangles()
        triangles += len(mesh.loop_triangles)
        for vertex in mesh.vertices:
            for k, x in enumerate(ours(path, thing.matrix_world @ vertex.co)):
                low[k], high[k] = min(low[k], x), max(high[k], x)
    return triangles, low, high


def open_edges(meshes):
    """Edges that do not join two faces which run along it in opposite directions; and pieces that are inside out."""
    bad, inside_out = 0, 0
    for thing in meshes:
        body = bmesh.new()
        body.from_mesh(thing.data)
        bad += sum(1 for edge in body.edges if not edge.is_manifold or not edge.is_contiguous)
        inside_out += body.calc_volume(signed=True) <= 0.0
        body.free()
    return bad, inside_out


def read_ply(path):
    """Positions and normals of a PLY that begins with ten floats a vertex."""
    data = open(path, "rb").read()
    head = data.index(b"end_header\n") + len(b"end_header\n")
    text = data[:head].decode()
    count = int(text.split("element vertex ")[1].split()[0])
    size = 43 if "uchar red" in text else 40
    rows = [struct.unpack_from("<6f", data, head + i * size) for i in range(count)]
    return [Vector(r[:3]) for r in rows], [Vector(r[3:]) for r in rows]


def normal_error(path, meshes, ply):
    """The largest angle (as 1 - cosine) between a vertex's normal here and in the PLY; 9 when the vertices differ."""
    positions, normals = read_ply(ply)
    first, worst = 0, 0.0
    for thing in meshes:
        mesh = thing.data
        mesh.calc_normals_split()
        turn = thing.matrix_world.to_3x3()
        for loop in mesh.loops:
            k = first + loop.vertex_index
            place = Vector(ours(path, thing.matrix_world @ mesh.vertices[loop.vertex_index].co))
            if (place - positions[k]).length > 1e-5:
                return 9.0
            n = Vector(ours(path, turn @ loop.normal))
            worst = max(worst, 1.0 - n.normalized().dot(normals[k]))
        first += len(mesh.vertices)
    return worst if first == len(positions) else 9.0


def wrong_cards(meshes):
    """Cards one metre wide and high show their picture upright; one picture is cut out by another, four times as fine."""
    holed = [image for image in bpy.data.images if tuple(image.size) == (4, 4) and image.channels == 4]
    if len(bpy.data.images) != 3 or len(holed) != 1 or holed[0].pixels[3] != 0.0 or holed[0].pixels[4 + 3] != 1.0:
        return "the pictures are %s" % [(tuple(image.size), image.channels) for image in bpy.data.images]
    cards = [o for o in meshes if o.data.uv_layers and len(o.data.vertices) == 4]
    for card in cards:
        left = min(vertex.co.x for vertex in card.data.vertices)
        for loop, uv in zip(card.data.loops, card.data.uv_layers[0].data):
            place = card.data.vertices[loop.vertex_index].co
            if abs(uv.uv.x - (place.x - left)) > 1e-5 or abs(uv.uv.y - place.z) > 1e-5:
                return "uv %s at %s" % (uv.uv, place)
    return "" if len(cards) == 3 else "%d cards" % len(cards)


def numbers_of(text, declaration):
    """The numbers of an array in a USD file."""
    start = text.index(" = [", text.index(declaration)) + 4
    return numpy.array(re.findall(r"[-+.\de]+", text[start : text.index("]", start)]), dtype=float)


def linear(c):
    return numpy.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def wrong_glow(meshes, usda):
    """The emission that Blender's nodes make at each vertex against that of the curves' points."""
    mesh = meshes[0].data
    nodes = mesh.materials[0].node_tree.nodes
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    picture = shader.inputs["Emission"].links[0].from_node
    where = picture.inputs["Vector"].links[0].from_node.uv_map
    shades = linear(numpy.array(picture.image.pixels).reshape(-1, 4)[:, :3])
    u = numpy.zeros(len(mesh.vertices))
    for loop, uv in zip(mesh.loops, mesh.uv_layers[where].data):
        u[loop.vertex_index] = uv.uv.x
    at = u * len(shades) - 0.5
    got = numpy.stack([numpy.interp(at, range(len(shades)), shades[:, k]) for k in range(3)], axis=1)
    got *= shader.inputs["Emission Strength"].default_value
    with open(usda) as stream:
        text = stream.read()
    light = numbers_of(text, "color3f[] primvars:emission").reshape(-1, 3)
    wanted, first = [], 0
    for count in numbers_of(text, "int[] curveVertexCounts").astype(int):
        own = light[first : first + count]  # a tube is a cap, a ring of six at each point, a cap
        wanted += [own[:1], numpy.repeat(own, 6, axis=0), own[-1:]]
        first += count
    wanted = numpy.concatenate(wanted)
    if len(wanted) != len(got) or wanted.max() < 10 * wanted.min():
        return "%d glowing vertices, not %d" % (len(got), len(wanted))
    worst = (abs(got - wanted) / wanted).max()
    return "glow differs by %g" % worst if worst > 0.05 else ""


def agree(path, report, what, folder):
    meshes = load(path)
    triangles, low, high = measure(path, meshes)
    if triangles != report["triangles"]:
        return "%d triangles, not %d" % (triangles, report["triangles"])
    for mine, told in zip(low + high, report["low"] + report["high"]):
        if abs(mine - told) > 2e-5:
            return "bounds %s %s, not %s %s" % (low, high, report["low"], report["high"])
    if "closed" in what:
        bad, inside_out = open_edges(meshes)
        if bad or inside_out or not meshes:
            return "%d edges are open, %d of %d meshes are inside out" % (bad, inside_out, len(meshes))
    if "normals" in what:
        worst = normal_error(path, meshes, folder + "/" + what.split("normals=")[1].split(",")[0])
        if worst > 1e-3:
            return "normals differ by 1 - cosine = %g" % worst
    if "instances" in what and len({o.data.name for o in meshes}) * 10 > len(meshes):
        return "%d objects share %d meshes" % (len(meshes), len({o.data.name for o in meshes}))
    if "objects=" in what and len(bpy.data.objects) > int(what.split("objects=")[1].split(",")[0]):
        return "%d objects" % len(bpy.data.objects)
    if "textured" in what:
        return wrong_cards(meshes)
    if "glow" in what:
        return wrong_glow(meshes, folder + "/" + what.split("glow=")[1])
    if "lit" in what and not (bpy.data.lights and bpy.data.cameras):
        return "no light or no camera came along"
    if "colored" in what and not all(o.data.color_attributes for o in meshes):
        return "a mesh has no colours"
    return ""


def main():
    arguments = sys.argv[sys.argv.index("--") + 1 :]
    folder = arguments[0]
    for check in arguments[1:]:
        name, file, report, what = check.split(":")
        try:
            with open(folder + "/" + report) as stream:
                why = agree(folder + "/" + file, json.load(stream), what, folder)
        except Exception as failure:  # a reader that gives up is a verdict, too
            why = repr(failure)[-300:]
        print("\nnot ok %s: %s" % (name, why) if why else "\nok %s" % name)


main()
