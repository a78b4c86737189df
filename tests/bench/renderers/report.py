"""The comparison as text and as JSON. results: Figures by renderer, by scene."""

from .measures import geometric_mean
from .results import BASE, LIMIT, PARTS, disagreeing, efficiency_ratio, error_ratio, mean_difference, uncertain
from .scenes import SCENES

NAMES = {"ramify": "ramify", "cycles": "Cycles", "mitsuba3": "Mitsuba"}
EFFICIENCIES = (("ramify", BASE), ("mitsuba3", BASE), ("ramify", "mitsuba3"))


def title_of(scene):
    return f"{scene} {SCENES[scene].title}"


def proof_line(scene, figures):
    """Whether the renderers converge to the same image."""
    told = []
    for name in figures:
        if name != BASE:
            parts = [mean_difference(figures, name, part) for part in PARTS]
            numbers = [f"{100 * difference:+.2f} (+- {100 * error:.2f}) %" for difference, error in parts]
            told.append(f"{NAMES[name]} {numbers[0]}, dim pixels {numbers[1]}")
    verdict = "the same"
    if disagreeing(figures):
        verdict = f"DIFFERENT, more than {100 * LIMIT:g} %"
    elif uncertain(figures):
        verdict = "the same within noise; more samples (--reference) would tell"
    return f"{title_of(scene)}: mean against Cycles: {'; '.join(told)}: {verdict}"


def row(scene, figures):
    """The cells of a scene's row."""
    errors = [f"{figures[name].errors[n]:.2e}" for n in figures[BASE].errors for name in NAMES]
    speeds = [f"{figures[name].paths_per_second / 1e6:.2f}" for name in NAMES]
    ratios = [f"{efficiency_ratio(figures, name, base):.2f}" for name, base in EFFICIENCIES]
    return [title_of(scene), f"{error_ratio(figures, 'ramify'):.2f}", *speeds, *errors, *ratios]


def header(samples):
    speeds = [f"Mpaths/s {name}" for name in NAMES.values()]
    errors = [f"relMSE {n} {name}" for n in samples for name in NAMES.values()]
    ratios = [f"efficiency {NAMES[name]}/{NAMES[base]}" for name, base in EFFICIENCIES]
    return ["scene", "error ramify/Cycles", *speeds, *errors, *ratios]


def means(results):
    """Geometric means of the efficiencies over the scenes."""
    return [geometric_mean([efficiency_ratio(f, name, base) for f in results.values()]) for name, base in EFFICIENCIES]


def table(results):
    """A Markdown table, aligned, with the geometric means of the efficiencies below."""
    samples = list(next(iter(results.values()))[BASE].errors)
    rows = [header(samples)] + [row(scene, figures) for scene, figures in results.items()]
    last = [f"{value:.2f}" for value in means(results)]
    rows.append(["geometric mean"] + [""] * (len(rows[0]) - 1 - len(last)) + last)
    widths = [max(len(cells[i]) for cells in rows) for i in range(len(rows[0]))]
    rows.insert(1, ["-" * width for width in widths])
    return "\n".join("| " + " | ".join(cell.ljust(width) for cell, width in zip(cells, widths)) + " |" for cells in rows)


def as_json(results):
    """The same numbers, and those that the table rounds or leaves out, as values for json.dump."""
    scenes = {}
    for scene, figures in results.items():
        scenes[scene] = {
            name: {
                "mean": {part: f.means[part][0] for part in PARTS},
                "mean_difference": {part: mean_difference(figures, name, part)[0] for part in PARTS},
                "seconds_per_sample": f.seconds,
                "seconds_of_largest_picture": f.whole_seconds,
                "paths_per_second": f.paths_per_second,
                "relative_mse": {str(n): error for n, error in f.errors.items()},
                "efficiency": efficiency_ratio(figures, name),
            }
            for name, f in figures.items()
        }
    totals = {f"{name}/{base}": value for (name, base), value in zip(EFFICIENCIES, means(results))}
    return {"scenes": scenes, "efficiency_geometric_mean": totals}
