"""The edges of a skin in a .ply are as long as its branches are thick: prints the number of faces."""

import math
import struct
import sys

data = open(sys.argv[1], "rb").read()
start = data.index(b"end_header\n") + len(b"end_header\n")
counts, properties, element = {}, [], ""
for line in data[:start].decode().splitlines():
    words = line.split()
    if words[0] == "element":
        element = words[1]
        counts[element] = int(words[2])
    elif words[0] == "property" and element == "vertex":
        properties.append((words[2], {"float": "f", "uchar": "B"}[words[1]]))
layout = struct.Struct("<" + "".join(kind for _, kind in properties))
radius = [name for name, _ in properties].index("radius")
vertices = [layout.unpack_from(data, start + i * layout.size) for i in range(counts["vertex"])]
at = start + counts["vertex"] * layout.size
edges = []
for _ in range(counts["face"]):
    corners = struct.unpack_from(f"<{data[at]}i", data, at + 1)
    at += 1 + 4 * data[at]
    for a, b in zip(corners, corners[1:] + corners[:1]):
        thick = 0.5 * (vertices[a][radius] + vertices[b][radius])
        edges.append((thick, math.dist(vertices[a][:3], vertices[b][:3]) / thick))
edges.sort()
fifth = len(edges) // 5
for i in range(5):
    ratios = sorted(ratio for _, ratio in edges[i * fifth : (i + 1) * fifth])
    assert 0.15 < ratios[fifth // 2] < 0.75, (i, ratios[fifth // 2])
    assert ratios[9 * fifth // 10] < 1.5, (i, ratios[9 * fifth // 10])
print(counts["face"])
