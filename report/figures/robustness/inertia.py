"""The page on an inertia that the law does not know."""

from report.figures.kit import families
from report.figures.kit.page import Run
from report.figures.robustness.loops import farthest_ms, settling_times, theory
from report.figures.robustness.rows import along, gains, levels, losses, medians, slower, starts
from report.figures.robustness.tables import by_level, costs

EVEN, UNEVEN = "inertia", "uneven-inertia"


def facts(run: Run) -> dict:
    """Of bodies lighter and heavier than the model, and of uneven ones."""
    even, uneven = along(run, EVEN), along(run, UNEVEN)
    if even.empty or uneven.empty:
        return {}
    kp, kv = gains(even)
    curve, uneven_curve, most = theory(even, EVEN), theory(uneven, UNEVEN), max(levels(uneven))
    times = {level: curve(level) for level in levels(even)}
    quickest, lightest, heaviest = min(times, key=lambda level: times[level]), min(times), max(times)
    ratio = slower(uneven, UNEVEN)
    return {
        "n": starts(even),
        "losses": losses(even, EVEN),
        "far_ms": f"{farthest_ms(even, EVEN):.1g}",
        "light": f"{times[lightest]:.2f} s at {lightest:g}",
        "heavy": f"{times[heaviest]:.2f} s at {heaviest:g}",
        "fastest": f"{quickest:g}",
        "fastest_s": f"{times[quickest]:.2f}",
        "damped": f"{kv * kv / (4.0 * kp):g}",
        "uneven_losses": losses(uneven, UNEVEN),
        "slowest": f"{100.0 * (ratio.max() - 1.0):.0f}",
        "slowest_law": families.word(ratio.idxmax()),
        "uneven0": f"{uneven_curve(0.0):.2f}",
        "uneven1": f"{uneven_curve(most):.2f}",
        "path": f"{medians(uneven, 'path_ratio').loc[most].median():.2f}",
    }


def tables(run: Run) -> dict:
    """How it went by level, and what an uneven body takes."""
    even, uneven = along(run, EVEN), along(run, UNEVEN)
    return {
        "tab_even": by_level(even, EVEN),
        "tab_uneven": by_level(uneven, UNEVEN),
        "tab_costs": costs(uneven, UNEVEN),
    }


def figures(run: Run) -> dict:
    """Settling times by level, beside the linear loop's."""
    return {name: settling_times(run, name) for name in (EVEN, UNEVEN)}
