"""Triangles of the scenes: those that ramify exports, and small bodies made here.

A mesh is a pair of arrays, vertices (n, 3) float32 in metres and triangles (m, 3) int32, without normals: all renderers
shade it flat.
"""

import subprocess

import numpy as np

from .worker import RendererFailed

SCALARS = {"float": "<f4", "uchar": "u1", "int": "<i4", "uint": "<u4"}
OCTAHEDRON = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
OCTAHEDRON_FACES = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
CUBE_QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


# ---- PLY files


def read_header(data):
    """Vertex record, number of faces and where the records begin, of a binary PLY."""
    start = data.index(b"end_header\n") + len(b"end_header\n")
    counts, fields, element = {}, [], None
    for line in data[:start].decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        elif words[0] == "property" and element == "vertex":
            fields.append((words[2], SCALARS[words[1]]))
    return np.dtype(fields), counts["vertex"], counts["face"], start


def read_faces(data, count):
    """Triangles of `count` lists of three or four corners; quads are split. data: the bytes of the lists."""
    raw, place, triangles = np.frombuffer(data, np.uint8), 0, []
    while count:
        corners = int(raw[place])
        size = 1 + 4 * corners
        records = raw[place : place + min(count, (len(raw) - place) // size) * size].reshape(-1, size)
        other = np.flatnonzero(records[:, 0] != corners)
        run = len(records) if other.size == 0 else int(other[0])
        face = np.ascontiguousarray(records[:run, 1:]).view("<i4")
        triangles += [face[:, [0, k, k + 1]] for k in range(1, corners - 1)]
        place, count = place + run * size, count - run
    return np.concatenate(triangles)


def read_ply(path):
    """Vertex records, a structured array, and triangles of a file that ramify exported."""
    data = path.read_bytes()
    record, vertex_count, face_count, start = read_header(data)
    vertices = np.frombuffer(data, record, vertex_count, start)
    return vertices, read_faces(data[start + vertices.nbytes :], face_count)


def write_ply(path, vertices, triangles):
    """A binary PLY of positions and triangles alone."""
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    faces = np.empty(len(triangles), [("count", "u1"), ("corner", "<i4", 3)])
    faces["count"], faces["corner"] = 3, triangles
    path.write_bytes(header.encode() + vertices.astype("<f4").tobytes() + faces.tobytes())


def positions_of(records):
    """The positions of vertex records, (n, 3)."""
    return np.stack([records["x"], records["y"], records["z"]], axis=1)


# ---- meshes


def compact(vertices, triangles):
    """The mesh without unused vertices and without triangles of no area."""
    corner = vertices[triangles].astype(np.float64)
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    used, triangles = np.unique(triangles[area > 1e-14], return_inverse=True)
    return vertices[used].astype(np.float32), triangles.reshape(-1, 3).astype(np.int32)


def ground():
    """A square of 200 m, facing up."""
    return np.array([[-100, 0, -100], [-100, 0, 100], [100, 0, 100], [100, 0, -100]], float), np.array([[0, 1, 2], [0, 2, 3]])


def octahedra(centers, radius):
    """A closed octahedron around each centre (n, 3)."""
    vertices = centers[:, None, :] + radius * OCTAHEDRON
    triangles = OCTAHEDRON_FACES + len(OCTAHEDRON) * np.arange(len(centers))[:, None, None]
    return vertices.reshape(-1, 3), triangles.reshape(-1, 3)


def box(center):
    """A closed cube of 2 m."""
    return CUBE + center, np.concatenate([CUBE_QUADS[:, [0, 1, 2]], CUBE_QUADS[:, [0, 2, 3]]])


def lamp_places(records, count):
    """Places just off a tree's branches above head height, (count, 3): the same ones each time."""
    high = np.flatnonzero(records["y"] > 1.5)
    chosen = records[np.random.default_rng(1).choice(high, count, replace=False)]
    normals = np.stack([chosen["nx"], chosen["ny"], chosen["nz"]], axis=1)
    return positions_of(chosen) + 0.05 * normals


# ---- what the scenes need


def export(ramify, folder, name, scene):
    """Has ramify export a scene's text; returns the PLY's vertex records and triangles."""
    source, target = folder / f"{name}.yaml", folder / f"{name}-exported.ply"
    source.write_text(scene)
    done = subprocess.run([ramify, "export", source, "-o", target, "--colors", "none", "-q"], capture_output=True, text=True)
    if done.returncode:
        raise RendererFailed(f"ramify: {done.stderr.strip()}")
    mesh = read_ply(target)
    target.unlink()
    return mesh


def oak(leaves):
    """A scene of an oak with at most so many leaves."""
    return f"seed: 7\nobjects:\n  - name: oak\n    tree: {{height: 14, radii: {{flare: 0.9}}, leaves: {{max_count: {leaves}}}}}\n"


def make_meshes(ramify, folder, body):
    """Writes every mesh of the scenes as FOLDER/NAME.ply and .npz (vertices, triangles). body: a closed mesh file."""
    bare, bare_faces = export(ramify, folder, "bare", oak(0))
    leafy, leafy_faces = export(ramify, folder, "leafy", oak(60000))
    solid, solid_faces = export(ramify, folder, "body", f"objects:\n  - name: body\n    mesh: {{file: {body}}}\n")
    solid = positions_of(solid)
    bark = (leafy["radius"] > 0.0)[leafy_faces].all(axis=1)  # leaves have no branch's radius
    meshes = {
        "ground": ground(),
        "bare": (positions_of(bare), bare_faces),
        "bark": (positions_of(leafy), leafy_faces[bark]),
        "leaves": (positions_of(leafy), leafy_faces[~bark]),
        "body": (solid - [0.0, solid[:, 1].min() - 0.002, 0.0], solid_faces),  # just off the ground
        "lamps": octahedra(lamp_places(bare, 3000), 0.02),
        "bulb": octahedra(np.array([[0.0, 1.02, 0.0]]), 0.15),
        "box": box(np.array([0.0, 1.02, 0.0])),
    }
    for name, mesh in meshes.items():
        vertices, triangles = compact(*mesh)
        write_ply(folder / f"{name}.ply", vertices, triangles)
        np.savez(folder / f"{name}.npz", vertices=vertices, triangles=triangles)
