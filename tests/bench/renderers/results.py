"""What the drawings of one scene say: do the renderers agree, and what does an error cost each of them."""

from dataclasses import dataclass, field

from . import measures

BASE = "cycles"
LIMIT = 0.005  # of the mean radiance, between converged images
CERTAIN = 3.0  # standard errors, below which a difference is noise
PARTS = ("all", "dim")  # of the pixels, of which the means must agree: see measures.dim_pixels


@dataclass
class Drawings:
    """Of one renderer and scene: images and seconds, lists by number of samples."""

    images: dict = field(default_factory=dict)
    seconds: dict = field(default_factory=dict)

    def add(self, samples, drawing):
        self.images.setdefault(samples, []).append(drawing.image)
        self.seconds.setdefault(samples, []).append(drawing.seconds)


@dataclass(frozen=True)
class Figures:
    """Of one renderer and scene. means: mean radiance and its standard error by part of the image. errors: relative MSE by
    samples. seconds: of one sample a pixel, and whole_seconds of
    the picture with the most samples, both the least; the latter with what is done once for each picture."""

    means: dict
    errors: dict
    seconds: float
    whole_seconds: float
    paths_per_second: float

    def efficiency(self, samples):
        return measures.efficiency(self.errors[samples], self.seconds * samples)


def figures_of(drawings, samples, reference_samples, reference, dim):
    """samples: the numbers of samples to tell the error of. dim: mask of the dim pixels."""
    seconds = measures.seconds_per_sample(drawings.seconds)
    return Figures(
        means={"all": measures.mean_and_error(reference), "dim": measures.mean_and_error(reference, dim)},
        errors={n: measures.relative_mse(drawings.images[n], reference) for n in samples},
        seconds=seconds,
        whole_seconds=min(drawings.seconds[reference_samples]),
        paths_per_second=dim.size / seconds,
    )


def all_figures(drawings, samples, reference_samples):
    """Figures by renderer, from the Drawings by renderer."""
    references = {name: measures.reference_of(found.images[reference_samples]) for name, found in drawings.items()}
    dim = measures.dim_pixels([reference.image for reference in references.values()])
    return {name: figures_of(found, samples, reference_samples, references[name], dim) for name, found in drawings.items()}


def mean_difference(figures, name, part):
    """Of the converged image's mean over a part from that of BASE, as a share, and its standard error."""
    (ours, our_error), (base, base_error) = figures[name].means[part], figures[BASE].means[part]
    return ours / base - 1.0, (our_error**2 + base_error**2) ** 0.5 / base


def beyond(figures, errors):
    """The names of the renderers of which a mean differs by more than LIMIT and by more than so many standard errors."""

    def within(name, part):
        difference, error = mean_difference(figures, name, part)
        return abs(difference) <= max(LIMIT, errors * error)

    return [name for name in figures if not all(within(name, part) for part in PARTS)]


def disagreeing(figures):
    """The names of the renderers whose converged image differs."""
    return beyond(figures, CERTAIN)


def uncertain(figures):
    """The names of those for which noise is too strong to tell."""
    return [name for name in beyond(figures, 0.0) if name not in disagreeing(figures)]


def error_ratio(figures, name, base=BASE):
    """Relative MSE at equal samples, over that of base: the geometric mean over the numbers of samples."""
    return measures.geometric_mean([figures[name].errors[n] / figures[base].errors[n] for n in figures[base].errors])


def efficiency_ratio(figures, name, base=BASE):
    """Efficiency over that of base: the geometric mean over the numbers of samples."""
    ours, theirs = figures[name], figures[base]
    return measures.geometric_mean([ours.efficiency(n) / theirs.efficiency(n) for n in theirs.errors])
