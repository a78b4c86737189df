"""A panorama for the scenes, and Radiance's format to write it in."""

import numpy as np

WIDTH, HEIGHT = 1024, 512
SUN = {"azimuth": 130.0, "elevation": 38.0, "radius": 2.5, "radiance": (130.0, 110.0, 80.0)}
WINDOW = {"azimuth": -70.0, "elevation": 25.0, "half": (14.0, 9.0), "radiance": (9.0, 10.0, 12.0)}


def angles():
    """Azimuth and elevation in degrees of every pixel: arrays (HEIGHT, WIDTH)."""
    azimuth = (np.arange(WIDTH) + 0.5) / WIDTH * 360.0 - 180.0
    elevation = 90.0 - (np.arange(HEIGHT) + 0.5) / HEIGHT * 180.0
    return np.meshgrid(azimuth, elevation)


def soft_step(x, width):
    """From 0 below -width to 1 above width."""
    t = np.clip(0.5 + 0.5 * x / width, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def gradient(elevation):
    """Blue above, pale at the horizon, brown below."""
    high = np.clip(elevation / 90.0, 0.0, 1.0)[..., None] ** 0.6
    above = np.array([0.9, 0.95, 1.0]) * (1.0 - high) + np.array([0.15, 0.35, 0.9]) * high
    return np.where(elevation[..., None] >= 0.0, above, np.array([0.22, 0.19, 0.15]))


def sun_share(azimuth, elevation):
    """1 within the sun's disc, 0 outside, over an edge of one pixel."""
    a, e = np.radians(azimuth - SUN["azimuth"]), np.radians(elevation)
    sun = np.radians(SUN["elevation"])
    cosine = np.sin(e) * np.sin(sun) + np.cos(e) * np.cos(sun) * np.cos(a)
    return soft_step(SUN["radius"] - np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))), 180.0 / HEIGHT)


def window_share(azimuth, elevation):
    """1 within a rectangle of azimuth and elevation."""
    aside = np.abs((azimuth - WINDOW["azimuth"] + 180.0) % 360.0 - 180.0)
    over = np.abs(elevation - WINDOW["elevation"])
    wide, high = WINDOW["half"]
    return soft_step(wide - aside, 1.0) * soft_step(high - over, 1.0)


def panorama():
    """A veiled sun, a bright window and a gradient: radiance (HEIGHT, WIDTH, 3)."""
    azimuth, elevation = angles()
    sky = gradient(elevation)
    sky = sky + window_share(azimuth, elevation)[..., None] * np.array(WINDOW["radiance"])
    return sky + sun_share(azimuth, elevation)[..., None] * np.array(SUN["radiance"])


def to_rgbe(image):
    """Radiance's pixels: three mantissas and their common exponent, uint8 (height, width, 4)."""
    largest = image.max(axis=-1)
    mantissa, exponent = np.frexp(np.maximum(largest, 1e-30))
    scale = np.where(largest > 1e-30, mantissa * 256.0 / np.maximum(largest, 1e-30), 0.0)
    rgbe = np.empty(image.shape[:2] + (4,), np.uint8)
    rgbe[..., :3] = np.clip(image * scale[..., None], 0, 255)
    rgbe[..., 3] = np.where(largest > 1e-30, exponent + 128, 0)
    return rgbe


def write_hdr(path, image):
    """Writes a Radiance file without run lengths, which every reader of the format takes."""
    height, width = image.shape[:2]
    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
    path.write_bytes(header.encode() + to_rgbe(image).tobytes())
