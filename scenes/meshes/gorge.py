"""Sculpts the rock of a gorge: an ESRI grid of heights in centimetres, for scenes/waterfall.yaml."""
import sys
import numpy as np

SIZE, N = 132.0, 367
SHIFT = 20.0  # m: z of the pool in the square
x, z = np.meshgrid(np.linspace(-SIZE / 2, SIZE / 2, N), np.linspace(-SIZE / 2, SIZE / 2, N) - SHIFT)


def noise(x, z, wave, seed):
    """Value noise, -1..1, of a wavelength in metres."""
    table = np.random.default_rng(seed).uniform(-1, 1, (64, 64))
    u, v = x / wave + 100, z / wave + 100
    i, j = np.floor(u).astype(int), np.floor(v).astype(int)
    f, g = u - i, v - j
    f, g = f * f * f * (f * (6 * f - 15) + 10), g * g * g * (g * (6 * g - 15) + 10)
    at = lambda a, b: table[(i + a) % 64, (j + b) % 64]
    return (at(0, 0) * (1 - f) + at(1, 0) * f) * (1 - g) + (at(0, 1) * (1 - f) + at(1, 1) * f) * g


def fractal(x, z, wave, octaves, seed):
    return sum(noise(x, z, wave / 2**k, seed + k) / 2**k for k in range(octaves)) / 1.6


def blocks(x, z, size, seed):
    """A number -1..1 of each joint-bounded block, about `size` metres wide."""
    r = np.random.default_rng(seed)
    jitter, value = r.uniform(0, 1, (64, 64, 2)), r.uniform(-1, 1, (64, 64))
    a = 0.5
    u, v = (x * np.cos(a) - z * np.sin(a)) / size + 100, (x * np.sin(a) + z * np.cos(a)) / (1.5 * size) + 100
    best, out = np.full(x.shape, 9.0), np.zeros(x.shape)
    for di in (-1, 0, 1):
        for dj in (-1, 0, 1):
            i, j = np.floor(u).astype(int) + di, np.floor(v).astype(int) + dj
            p = jitter[i % 64, j % 64]
            d = np.abs(i + p[..., 0] - u) + np.abs(j + p[..., 1] - v)
            nearer = d < best
            best, out = np.where(nearer, d, best), np.where(nearer, value[i % 64, j % 64], out)
    return out


# ---- the stream below the fall: x and z of its middle, from the plunge pool on
course = np.array([(0.6, -3), (0.2, -1.5), (-1.2, 0), (-1.0, 6), (0.6, 12), (1.6, 18), (0.8, 24), (-0.8, 31), (-1.2, 38),
                   (0, 46), (1, 56)], float)
t = np.linspace(0, len(course) - 1, 220)
cx, cz = np.interp(t, range(len(course)), course[:, 0]), np.interp(t, range(len(course)), course[:, 1])
kernel = np.hanning(25) / np.hanning(25).sum()
cx = np.convolve(np.pad(cx, 12, "edge"), kernel, "valid")
along = np.concatenate([[0], np.cumsum(np.hypot(np.diff(cx), np.diff(cz)))])
d2 = (x[..., None] - cx) ** 2 + (z[..., None] - cz) ** 2
nearest = d2.argmin(-1)
away, s = np.sqrt(d2.min(-1)), along[nearest]
side = np.sign(x - cx[nearest])

# ---- the bed: pools and steps of rock
jag = 1.1 * blocks(x, z, 1.1, 3) + 0.5 * fractal(x, z, 3, 2, 4)
bed = 5.6 - 0.012 * s
for at, drop in ((8, 0.8), (12.5, 0.5), (17.5, 0.45), (23, 0.6), (29.5, 0.45), (36, 0.6), (42, 0.6)):
    bed -= drop * np.clip((s + jag - at) / 0.3 + 0.5, 0, 1)

# ---- walls: talus, cliffs and ledges; the beds of rock are level and as hard everywhere
head = np.clip((-2.0 - z) / 4.0, 0, 1)  # 1 at the head of the gorge
width = 5.0 + 2.2 * np.exp(-((s - 4) / 7) ** 2) + 1.4 * fractal(x, z, 16, 2, 20)
width += np.where(side > 0, 1.2, 0.0) * np.clip((s - 12) / 10, 0, 1)
ragged = 1.3 * fractal(x, z, 9, 3, 30) + (0.55 + 0.2 * head) * blocks(x, z, 1.7, 31) + 0.22 * blocks(x, z, 0.8, 32)
w = away - width + ragged
step = lambda at, wide=0.35: np.clip((w - at) / wide + 0.5, 0, 1)
b = blocks(x, z, 2.6, 33)
talus = (1 - head) * (1.2 + 1.1 * fractal(x, z, 7, 2, 40))
ledge1 = (1.6 + 1.3 * fractal(x, z, 11, 2, 41)).clip(0.1) * (1 - head) + 2.6 * head
ledge2 = (2.8 + 2.0 * fractal(x, z, 13, 2, 42)).clip(0.2) * (1 - head) + 0.35 * head
ledge3 = (1.5 + 1.2 * fractal(x, z, 9, 2, 43)).clip(0.2) * (1 - head) + 0.5 * head
first = 2.6 * (1 - head)
rise = talus * np.clip((w + 1.5) / 3.5, 0, 1)
rise += (4.4 + 0.5 * b - talus) * step(first)
rise += 0.5 * (1 - head) * np.clip((w - first) / ledge1, 0, 1)
p1 = first + ledge1
rise += (4.6 + 0.7 * b) * step(p1)
p2 = p1 + ledge2
rise += 0.8 * (1 - head) * np.clip((w - p1) / ledge2, 0, 1)
rise += (4.2 - 0.6 * b) * step(p2)
p3 = p2 + ledge3
rise += (3.0 + 1.0 * fractal(x, z, 10, 2, 44)) * step(p3) * (1 - 0.9 * head)
rise += (0.62 + 2 * head) * np.maximum(w - p3, 0)
base = np.minimum(bed, 5.6)
gorge = base + rise + 0.12 * np.abs(w).clip(0, 2.0) * fractal(x, z, 2, 3, 50) * (w > -3)

# ---- the valley above the fall
vx = 0.6 + 9 * np.clip((-z - 14) / 16, 0, 1) ** 1.5 - 6 * np.clip((-z - 32) / 20, 0, 1)
off = np.abs(x - vx) + 1.0 * fractal(x, z, 8, 3, 60) + 0.35 * blocks(x, z, 1.3, 61)
up = np.maximum(-z - 10, 0)
floor = 18.6 + 0.07 * up
for at, drop in ((9, 1.0), (15, 1.6), (23, 1.6)):
    floor += drop * np.clip((up + 0.8 * jag - at) / 0.3 + 0.5, 0, 1)
valley = floor + 0.35 * np.clip(off - 1.2, 0, 1.5) + 0.75 * np.maximum(off - 3.2, 0) + 1.4 * np.clip((off - 3.0) / 0.5, 0, 1)
land = np.minimum(gorge, valley)
land = np.where(land > 34, 34 + (land - 34) * 0.7, land)
rows = ["ncols %d" % N, "nrows %d" % N, "xllcorner 0", "yllcorner 0", "cellsize %.9g" % (SIZE / (N - 1))]
rows += [" ".join("%d" % h for h in np.rint(100 * row)) for row in land]
open(sys.argv[1], "w").write("\n".join(rows) + "\n")
