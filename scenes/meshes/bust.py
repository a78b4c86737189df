"""Cuts head and shoulders with closed eyes out of MakeHuman's base mesh (CC0), for scenes/vessels-body.yaml.

python3 bust.py makehuman/data > bust.obj, with the folder of https://github.com/makehumancommunity/makehuman
"""
import sys

DATA = sys.argv[1]
BELOW, ASIDE = 4.6, 2.4  # dm: what is kept, from the crown down and from the middle
TARGETS = (  # shapes to add, with their weights
    ("macrodetails/caucasian-male-young", 0.7),
    ("macrodetails/caucasian-male-old", 0.3),
    ("macrodetails/universal-male-young-averagemuscle-averageweight", 1.0),
    ("expression/units/caucasian/eye-left-closure", 1.0),
    ("expression/units/caucasian/eye-right-closure", 1.0),
)


def read_body():
    """The vertices, in dm, and the faces of the group `body`."""
    vertices, faces, group = [], [], ""
    for line in open(f"{DATA}/3dobjs/base.obj"):
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(w) for w in words[1:4]])
        elif words[:1] == ["g"]:
            group = words[1]
        elif words[:1] == ["f"] and group == "body":
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return vertices, faces


def add_target(vertices, name, weight):
    for line in open(f"{DATA}/targets/{name}.target"):
        words = line.split()
        if words and words[0][0] != "#":
            vertex = vertices[int(words[0])]
            for k in range(3):
                vertex[k] += weight * float(words[1 + k])


def largest_part(faces):
    """The faces that hang together with most others."""
    parent = {i: i for face in faces for i in face}

    def find(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for face in faces:
        for i in face[1:]:
            parent[find(i)] = find(face[0])
    roots = [find(face[0]) for face in faces]
    most = max(set(roots), key=roots.count)
    return [face for face, root in zip(faces, roots) if root == most]


def close(vertices, faces):
    """Fills each hole with a fan about its middle."""
    sides = {side for face in faces for side in zip(face, face[1:] + face[:1])}
    after = dict(side for side in sides if side[::-1] not in sides)
    while after:
        first, last = after.popitem()
        loop = [first, last]
        while loop[-1] != first:
            loop.append(after.pop(loop[-1]))
        vertices.append([sum(vertices[i][k] for i in loop[1:]) / (len(loop) - 1) for k in range(3)])
        faces += [[b, a, len(vertices) - 1] for a, b in zip(loop, loop[1:])]


vertices, faces = read_body()
for target in TARGETS:
    add_target(vertices, *target)
top = max(vertices[i][1] for face in faces for i in face)
faces = largest_part([f for f in faces
                      if all(vertices[i][1] > top - BELOW and abs(vertices[i][0]) < ASIDE for i in f)])
close(vertices, faces)
kept = sorted({i for face in faces for i in face})
number = {i: k + 1 for k, i in enumerate(kept)}
print("# head and shoulders, the crown at the origin, in metres; by bust.py from MakeHuman's base mesh; CC0")
for i in kept:
    x, y, z = vertices[i]
    print(f"v {0.1 * x:.4f} {0.1 * (y - top):.4f} {0.1 * z:.4f}")
for face in faces:
    print("f", *(number[i] for i in face))
