"""Errors of noisy images, and what they cost in time.

An image is an array (height, width, 3) of linear radiance. Each renderer is held against its own converged image, so that
small differences between renderers do not count as noise.
"""

from dataclasses import dataclass

import numpy as np

TRIMMED_SHARE = 0.001  # of the pixels: fireflies would make the mean of squares a lottery
BRIGHT = 10.0  # times the median
DARK_SHARE = 0.01  # of the squared mean radiance: bounds the weight of dark pixels


class Unmeasurable(ValueError):
    """The images or times are too few or too noisy for the figure."""


@dataclass(frozen=True)
class Reference:
    """A converged image: the mean of independent ones. noise: its relative MSE that is left."""

    image: np.ndarray
    variance: np.ndarray  # of each value of the image
    noise: float


def trimmed_mean(values, share=TRIMMED_SHARE):
    """Mean of the values without the largest `share` of them; at least one value is kept."""
    ordered = np.sort(np.asarray(values, dtype=np.float64), axis=None)
    kept = max(1, int(ordered.size * (1.0 - share)))
    return float(ordered[:kept].mean())


def relative_squares(squares, image):
    """Squared differences over the squared radiance of `image`, as one value a pixel."""
    weight = image**2 + DARK_SHARE * image.mean() ** 2
    return (squares / weight).mean(axis=-1)


def reference_of(images):
    """The Reference from two or more independent images of equally many samples."""
    if len(images) < 2:
        raise Unmeasurable("a reference needs two independent images: its noise is their difference")
    stack = np.stack(images).astype(np.float64)
    image, count = stack.mean(axis=0), len(images)
    variance = stack.var(axis=0, ddof=1) / count
    return Reference(image, variance, trimmed_mean(relative_squares(variance, image)))


def mean_and_error(reference, pixels=None):
    """Mean radiance of the pixels (a mask; None: all) and its standard error; the channels of a pixel err alike."""
    pixels = np.ones(reference.image.shape[:2], bool) if pixels is None else pixels
    variance = reference.variance[pixels].mean(axis=-1)
    return float(reference.image[pixels].mean()), float(np.sqrt(variance.sum()) / variance.size)


def dim_pixels(images):
    """The pixels at most ten times as bright as the median of those that are lit, in the mean of the images: a mask.

    Lamps in view can be nine tenths of an image's light; among them no error of what they light would be seen."""
    brightness = np.mean(images, axis=0).mean(axis=-1)
    lit = brightness[brightness > 0.0]
    return brightness <= BRIGHT * np.median(lit) if lit.size else brightness <= 0.0


def relative_mse(images, reference):
    """Relative mean squared error of the images' samples, averaged over the images, without the reference's own noise."""
    found = [trimmed_mean(relative_squares((image - reference.image) ** 2, reference.image)) for image in images]
    return float(np.mean(found)) - reference.noise


def seconds_per_sample(seconds):
    """Time of one more sample a pixel: the least time of the most samples less that of the fewest, by their difference.

    seconds: lists of times by number of samples. What a renderer does once for each picture falls out."""
    few, many = min(seconds), max(seconds)
    more = min(seconds[many]) - min(seconds[few])
    if few == many or not more > 0.0:
        raise Unmeasurable(f"{many} samples took no longer than {few}: a larger image or more repeats are needed")
    return more / (many - few)


def efficiency(error, seconds):
    """1 / (relative MSE x time): twice as high means the same error in half the time."""
    if not error > 0.0 or not seconds > 0.0:
        raise Unmeasurable(f"no efficiency of a relative MSE of {error:g} in {seconds:g} s: more samples are needed")
    return 1.0 / (error * seconds)


def geometric_mean(values):
    """Of positive numbers."""
    return float(np.exp(np.mean(np.log(np.asarray(values, dtype=np.float64)))))
