"""Pictures that the renderers draw in the same time, side by side."""

import numpy as np

BASE_SAMPLES = 16  # of the first renderer; the others take as many as fit into its time
WHITE_PERCENTILE = 95.0  # of the reference's radiance: what the display shows as white
GAP = 4  # pixels between pictures


def equal_time_samples(seconds, first):
    """Samples by renderer, from the seconds of a sample by renderer: those that `first` draws in BASE_SAMPLES' time."""
    budget = BASE_SAMPLES * seconds[first]
    return {name: max(1, round(budget / each)) for name, each in seconds.items()}


def displayed(image, white):
    """Linear radiance as 8-bit sRGB; `white` becomes 1."""
    x = np.clip(np.asarray(image, dtype=np.float64) / white, 0.0, 1.0)
    curve = np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1.0 / 2.4) - 0.055)
    return np.round(255.0 * curve).astype(np.uint8)


def row(images, reference):
    """The images and their reference from left to right, all at the same exposure."""
    white = max(float(np.percentile(reference, WHITE_PERCENTILE)), 1e-9)
    shown = [displayed(image, white) for image in (*images, reference)]
    gap = np.full((shown[0].shape[0], GAP, 3), 255, np.uint8)
    parts = [part for picture in shown for part in (gap, picture)][1:]
    return np.concatenate(parts, axis=1)


def sheet(rows):
    """Rows of the same width, one below the other."""
    gap = np.full((GAP, rows[0].shape[1], 3), 255, np.uint8)
    return np.concatenate([part for line in rows for part in (gap, line)][1:], axis=0)


def draw_row(renderers, figures, reference):
    """Draws one row. figures: by renderer; reference: an image. Returns it and the samples by renderer."""
    samples = equal_time_samples({name: found.seconds for name, found in figures.items()}, renderers[0].name)
    images = [renderer.draw(samples[renderer.name], 1).image for renderer in renderers]
    return row(images, reference), samples


def write(path, rows):
    """Writes the sheet as the file's ending tells: .png or .jpg."""
    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    mitsuba.Bitmap(sheet(rows)).write(str(path))
