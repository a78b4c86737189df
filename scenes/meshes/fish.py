"""Lays the side view of fish.obj on its uv (u along x, v along y) and paints fish.png, which multiplies a
fish's colour: paler below, a dark back, eye, gill and a stripe under the eye. Run in this folder."""

import math
import struct
import zlib

WIDE, HIGH = 512, 256
LOW, SIZE = (-0.53, -0.205), (1.03, 0.4203)  # of the mesh's box, x and y


def smooth(a, b, x):
    t = min(max((x - a) / (b - a), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def colour(x, y):
    body = mix((1.0, 0.97, 0.9), (0.66, 0.46, 0.42), smooth(-0.05, 0.1, y))
    body = mix((0.95, 1.0, 1.0), body, smooth(-0.12, -0.01, y))
    fins = smooth(0.115, 0.15, abs(y + 0.01)) if x > -0.3 else smooth(-0.36, -0.42, x)
    ray = math.sin(300 * (x + 0.5 * abs(y))) if x > -0.3 else math.sin(60 * math.atan2(y, x + 0.22))
    body = mix(body, tuple((0.8 + 0.2 * ray) * c for c in (1.0, 0.8, 0.62)), fins)
    row = 44 * y + 0.5 * math.floor(48 * x)  # rows of scales, each darker at its rim
    rim = math.hypot(48 * x % 1 - 0.75, row % 1 - 0.5)
    body = mix(body, tuple(0.66 * c for c in body), smooth(0.35, 0.75, rim) * (1 - fins) * (1 - smooth(0.22, 0.28, x)))
    streak = abs((y + 0.005) - 0.22 * (x - 0.37))  # from the eye to below the breast fin
    body = mix(body, (0.62, 0.42, 0.85), 0.8 * (1 - smooth(0.006, 0.014, streak)) * smooth(0.14, 0.2, x) * (1 - smooth(0.36, 0.4, x)))
    gill = abs(math.hypot(x - 0.37, y) - 0.16)
    body = mix(body, tuple(0.6 * c for c in body), (1 - smooth(0.003, 0.012, gill)) * smooth(-0.09, -0.06, y) * (1 - smooth(0.06, 0.09, y)) * (x < 0.3))
    eye = math.hypot(x - 0.385, y - 0.022)
    body = mix(body, (0.9, 0.75, 0.7), 1 - smooth(0.03, 0.036, eye))
    body = mix(body, (0.01, 0.01, 0.015), 1 - smooth(0.019, 0.024, eye))
    return body


def write_png(path):
    rows = b""
    for j in range(HIGH):
        y = LOW[1] + SIZE[1] * (1 - (j + 0.5) / HIGH)
        row = [colour(LOW[0] + SIZE[0] * (i + 0.5) / WIDE, y) for i in range(WIDE)]
        code = lambda c: 12.92 * c if c < 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055
        rows += b"\0" + bytes(min(255, int(255 * code(max(c, 0)) + 0.5)) for p in row for c in p)
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDE, HIGH, 8, 2, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def lay_uv(path):
    lines = [line for line in open(path) if not line.startswith("vt ")]
    places = [tuple(map(float, line.split()[1:4])) for line in lines if line.startswith("v ")]
    uv = [f"vt {(p[0] - LOW[0]) / SIZE[0]:.4f} {(p[1] - LOW[1]) / SIZE[1]:.4f}\n" for p in places]
    faces = [line for line in lines if line.startswith("f ")]
    rest = [line for line in lines if not line.startswith("f ")]
    names = lambda line: " ".join(f"{n.split('/')[0]}/{n.split('/')[0]}" for n in line.split()[1:])
    with open(path, "w") as file:
        file.writelines(rest + uv + [f"f {names(line)}\n" for line in faces])


lay_uv("fish.obj")
write_png("fish.png")
