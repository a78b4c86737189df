"""Networks of vessels in .network.json and .vtp: Poiseuille, conservation, orders, and that both hold the same."""

import json
import math
import sys
import xml.etree.ElementTree as ElementTree

network_file, vtp_file = sys.argv[1:]
text = json.load(open(network_file))
assert text["format"] == "ramify network" and text["unit"] == "SI"


def near(a, b, relative=1e-5):
    return abs(a - b) <= relative * max(abs(a), abs(b))


def distance(p, q):
    return math.dist(p[:3], q[:3])


columns = None
points = lines = 0
for number, network in enumerate(text["networks"]):
    segments = network["segments"]
    inflow, ends = {}, []
    for segment in segments:
        line = segment["points"]
        tubes = [(distance(p, q), q[3]) for p, q in zip(line, line[1:])]
        assert near(sum(length for length, _ in tubes), segment["length"])
        assert near(sum(8 * 3.5e-3 * length / (math.pi * r**4) for length, r in tubes), segment["resistance"])
        assert near(sum(1060 * length / (math.pi * r**2) for length, r in tubes), segment["inertance"])
        stiff = [1.5 * math.pi * r**2 * length / (2e6 * math.exp(-2253 * r) + 8.65e4) for length, r in tubes]
        assert near(sum(stiff), segment["compliance"])
        sign = -1 if network["colony"] == 1 else 1  # veins: toward the root
        fall = sign * (segment["pressure_from"] - segment["pressure_to"])
        assert near(fall, segment["flow"] * segment["resistance"], 1e-4), (fall, segment)
        shear = 4 * 3.5e-3 * segment["flow"] / (math.pi * line[-1][3] ** 3)
        assert near(shear, segment["wall_shear"])
        if segment["parent"] >= 0:
            assert segments[segment["parent"]]["to"] == segment["from"]
            assert segments[segment["parent"]]["points"][-1][:3] == line[0][:3]
        inflow.setdefault(segment["from"], []).append(segment["flow"])
    for segment in segments:
        below = inflow.get(segment["to"])
        if below:
            assert near(sum(below), segment["flow"], 1e-6)
        else:
            ends.append(segment["pressure_to"])
    assert max(ends) - min(ends) < 1e-6 * abs(max(ends))
    # what the table of orders says, counted anew
    highest = len(network["orders"])
    matrix = [[0] * highest for _ in range(highest)]
    elements = {}
    for segment in segments:
        elements.setdefault(segment["element"], []).append(segment)
    for run in elements.values():
        assert len({segment["order"] for segment in run}) == 1
        if run[0]["parent"] >= 0:
            matrix[run[0]["order"] - 1][segments[run[0]["parent"]]["order"] - 1] += 1
    for n, row in enumerate(network["orders"]):
        mine = [segment for segment in segments if segment["order"] == n + 1]
        runs = [run for run in elements.values() if run[0]["order"] == n + 1]
        assert row["order"] == n + 1 and row["segments"] == len(mine) and row["elements"] == len(runs)
        assert near(row["diameter"], sum(2 * s["radius"] for s in mine) / len(mine))
        assert near(row["length"], sum(s["length"] for s in mine) / len(runs))
        for m in range(highest):
            assert near(network["connectivity"][m][n], matrix[m][n] / len(runs))
    lines += len(segments)

root = ElementTree.parse(vtp_file).getroot()
assert root.tag == "VTKFile" and root.attrib["type"] == "PolyData"
piece = root.find("PolyData/Piece")


def array(path, name):
    for entry in piece.find(path):
        if entry.attrib["Name"] == name:
            values = [float(word) for word in entry.text.split()]
            return values
    raise KeyError(name)


assert int(piece.attrib["NumberOfLines"]) == lines
coordinates = array("Points", "Points")
count = int(piece.attrib["NumberOfPoints"])
assert len(coordinates) == 3 * count
assert len(array("PointData", "radius")) == len(array("PointData", "pressure")) == count
connectivity, offsets = array("Lines", "connectivity"), array("Lines", "offsets")
assert len(offsets) == lines and offsets[-1] == len(connectivity) and max(connectivity) < count
pressure = array("PointData", "pressure")
start = at = 0
cells = {name: array("CellData", name) for name in ("flow", "wall_shear", "order", "element", "network", "colony", "length")}
for number, network in enumerate(text["networks"]):
    for segment in network["segments"]:
        line = [int(i) for i in connectivity[start : int(offsets[at])]]
        assert len(line) == len(segment["points"])
        for i, point in zip(line, segment["points"]):
            assert all(near(a, b) for a, b in zip(coordinates[3 * i : 3 * i + 3], point))
        assert near(pressure[line[0]], segment["pressure_from"]) and near(pressure[line[-1]], segment["pressure_to"])
        for name in ("flow", "wall_shear", "order", "element", "length"):
            assert near(cells[name][at], segment[name]), name
        assert cells["network"][at] == number and cells["colony"][at] == network["colony"]
        start, at = int(offsets[at]), at + 1
assert at == lines
print(len(text["networks"]), "networks,", lines, "segments")
