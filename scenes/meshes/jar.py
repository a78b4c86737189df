"""Turns jar.obj, a preserving jar with outer and inner wall and a beaded neck, and flame.obj, a candle's flame, and
paints jar-frost.png, where frost lies on the jar (white: thick, black: thawed by the flame, and the far side), seen
steeply from above, for scenes/outtree-frost.yaml. Metres, Y up. Run in this folder."""

import math
import random
import struct
import zlib

random.seed(11)


def arc(x, y, radius, start, end, count):
    """Points on an arc about x, y, from start to end degrees."""
    angles = [math.radians(start + (end - start) * i / count) for i in range(count + 1)]
    return [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]


def bead(radius, y, height, out):
    """A ring that stands out of the neck."""
    return [(radius + out * math.sin(math.pi * i / 6) ** 2, y + height * (i / 6 - 0.5)) for i in range(7)]


def jar_profile():
    """(radius, height) from the middle of the foot up the outer wall, over the rim and down the inner one."""
    outer = [(0.0, 0.003), (0.026, 0.003), (0.031, 0.001)] + arc(0.038, 0.007, 0.007, -90, 0, 6)
    outer += [(0.045, 0.03), (0.0453, 0.06), (0.045, 0.09)] + arc(0.029, 0.1, 0.016, 0, 68, 9)
    outer += [(0.0340, 0.1165)] + bead(0.0335, 0.1215, 0.004, 0.0016) + bead(0.0335, 0.1275, 0.004, 0.0013)
    outer += bead(0.0335, 0.1325, 0.004, 0.0013) + [(0.0335, 0.139)] + arc(0.0322, 0.1405, 0.0015, 0, 180, 8)
    inner = [(0.0306, 0.139), (0.0306, 0.117), (0.0316, 0.1135)] + arc(0.0285, 0.1, 0.0135, 62, 0, 8)
    inner += [(0.0422, 0.09), (0.0424, 0.06), (0.042, 0.03)] + arc(0.036, 0.014, 0.006, 0, -90, 5) + [(0.0, 0.0075)]
    return outer + inner


def flame_profile():
    """A teardrop 31 mm high about the wick, widest at a third of its height."""
    rows = []
    for i in range(25):
        t = i / 24
        rows.append((0.0112 * t ** 0.55 * (1 - t) ** 1.05 * (1 + 0.25 * (1 - t)), 0.031 * t))
    return rows


def turned(profile, sides, sway=lambda y: 0.0):
    """Vertices and faces of a profile turned about the y axis; ends on the axis become single points."""
    vertices, faces, rows = [], [], []
    for radius, y in profile:
        if radius < 1e-9:
            rows.append([len(vertices)] * sides)
            vertices.append((sway(y), y, 0.0))
            continue
        rows.append([len(vertices) + k for k in range(sides)])
        for k in range(sides):
            a = 2 * math.pi * k / sides
            vertices.append((radius * math.sin(a) + sway(y), y, radius * math.cos(a)))
    for low, high in zip(rows, rows[1:]):
        for k in range(sides):
            n = (k + 1) % sides
            face = [low[k], low[n], high[n], high[k]]
            faces.append([v for i, v in enumerate(face) if v not in face[:i]])
    return vertices, faces


def write_obj(path, note, mesh):
    vertices, faces = mesh
    with open(path, "w") as file:
        file.write(f"# {note}, by jar.py\n")
        for v in vertices:
            file.write("v " + " ".join(f"{c:.5f}".rstrip("0") for c in v) + "\n")
        for f in faces:
            file.write("f " + " ".join(str(i + 1) for i in f) + "\n")


WIDE, HIGH = 64, 192  # of 0.1 m and 0.132 m
UP, BACK = math.sqrt(0.1), -math.sqrt(0.9)  # the picture's upward axis in y and z: so oblique that front and back fall apart
BOTTOM = -0.044  # of the picture, along this axis
LATTICE = [[random.random() for _ in range(40)] for _ in range(40)]


def noise(x, y):
    i, j = int(x), int(y)
    s, t = x - i, y - j
    s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
    a, b = LATTICE[j], LATTICE[j + 1]
    return (a[i] * (1 - s) + a[i + 1] * s) * (1 - t) + (b[i] * (1 - s) + b[i + 1] * s) * t


def frost(x, y):
    """Density of the frost 0..1 at x (from the axis) and height y, in metres."""
    ragged = noise((x + 0.05) * 90, y * 90) - 0.5 + 0.5 * (noise((x + 0.05) * 220, y * 220) - 0.5)
    thaw = math.hypot(x / 0.025, (y - 0.062) / 0.030) + 0.55 * ragged
    value = min(max((thaw - 0.85) / 0.35, 0.0), 1.0)
    value *= min(max((0.133 - y) / 0.02 + 1.2 * ragged, 0.0), 1.0)  # the neck is warm
    return value * (0.55 + 0.45 * min(max((0.038 - y) / 0.02, 0.0), 1.0))


def wall(y):
    """The jar's radius at height y, about."""
    return 0.045 if y < 0.1 else max(0.029 + math.sqrt(max(0.016 ** 2 - (y - 0.1) ** 2, 0.0)), 0.0335)


def seen(x, v):
    """Density at a point of the picture: that of the near wall behind it."""
    nearest, density = 0.003, 0.0
    for k in range(140):
        y = 0.001 * k
        if abs(x) <= wall(y):
            off = abs(y * UP + math.sqrt(wall(y) ** 2 - x * x) * BACK - v)
            if off < nearest:
                nearest, density = off, frost(x, y)
    return density


def write_png(path):
    rows = b""
    for j in range(HIGH):
        v = BOTTOM + 0.132 * (1 - (j + 0.5) / HIGH)
        rows += b"\0" + bytes(int(255 * seen(0.1 * ((i + 0.5) / WIDE - 0.5), v)) for i in range(WIDE))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDE, HIGH, 8, 0, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


write_obj("jar.obj", "A preserving jar, 142 mm high", turned(jar_profile(), 72))
write_obj("flame.obj", "A candle's flame, 31 mm high", turned(flame_profile(), 16, lambda y: 1.2 * max(y - 0.012, 0) ** 2 * 3))
write_png("jar-frost.png")
