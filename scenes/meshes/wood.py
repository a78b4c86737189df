"""Paints wood.png, the grain of a plank that multiplies a wood's colour: the grain along x, growth rings cut
lengthwise, fibres, pores. It repeats at its edges and is as long as high. Run in this folder."""

import math
import random
import struct
import zlib

WIDE, HIGH, SHADES = 400, 640, 48

random.seed(3)


def lattice(columns, rows):
    return [[random.random() for _ in range(columns)] for _ in range(rows)]


def noise(grid, x, y):
    """Periodic value noise: x, y in 0..1, smooth between the grid's values."""
    rows, columns = len(grid), len(grid[0])
    x, y = x * columns, y * rows
    i, j = int(x), int(y)
    s, t = x - i, y - j
    s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
    a, b = grid[j % rows], grid[(j + 1) % rows]
    i, k = i % columns, (i + 1) % columns
    return (a[i] * (1 - s) + a[k] * s) * (1 - t) + (b[i] * (1 - s) + b[k] * s) * t


SWAY, WARP, KNOTTED = lattice(2, 2), lattice(3, 4), lattice(4, 11)
TINT, FIBRE, FINE = lattice(2, 9), lattice(9, 200), lattice(36, 520)


def shade(x, y):
    """Reflectance at x, y of 0..1, as a share of the wood's colour."""
    depth = 0.25 + 0.30 * math.sin(math.pi * x) ** 2 + 0.12 * noise(SWAY, x, y)  # of the cut beside the pith
    across = math.sin(math.pi * (y + 0.10 * (noise(WARP, x, y) - 0.5)))  # periodic: 0 at the edges
    ring = 15 * math.hypot(across * 1.1, depth) + 0.9 * noise(KNOTTED, x, y)
    late = ring - math.floor(ring)
    late = late ** 3 * (1 - max(0.0, late - 0.9) * 10)  # darkens to the latewood, then starts anew
    value = 0.92 - 0.5 * late + 0.16 * (noise(TINT, x, y) - 0.5)
    value *= 0.86 + 0.28 * noise(FIBRE, x, y)
    pore = noise(FINE, x, y)
    return value * (1 - 0.55 * max(0.0, pore - 0.72) / 0.28)


def write_png(path):
    rows = b""
    for j in range(HIGH):
        values = [shade((i + 0.5) / WIDE, (j + 0.5) / HIGH) for i in range(WIDE)]
        code = [1.055 * min(max(v, 0.01), 1.0) ** (1 / 2.4) - 0.055 for v in values]
        rows += b"\0" + bytes(int(c * SHADES + 0.5) * 255 // SHADES for c in code)
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDE, HIGH, 8, 0, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


write_png("wood.png")
