"""What coordinates of a rotation are: the record that each file of bench/law/contenders/representations holds."""

from collections.abc import Callable
from typing import NamedTuple

from bench.law.equation import Equation
from bench.law.look import Look


class Representation(NamedTuple):
    """Coordinates E of a rotation, with omega = B(E) Edot (Murphy 1988, 2.8): three, or four of a quaternion.

    A `chart` is E together with what its extraction has computed already (sines and cosines, say), so that nothing is
    computed twice in a tick; `chart.E` is E.

    chart(R) -> chart
    chart_of(E) -> chart
    to_matrix(E) -> R
    rates(chart, omega) -> Edot = B^-1 omega                     (2.9)
    accelerate(chart, Edot, Eddot) -> B Eddot + Bdot Edot        (2.10 solved for u = omegadot)
    angular_velocity(chart, Edot) -> B Edot                      (2.8)
    generalized(chart, m) -> B^T m                               (3.12, rotational part)
    margin(R) -> number in [0, 1], 0 exactly on the singular set

    Of an extraction that can be differentiated element by element, as (3.5) does (else None):
    differentiate(R, Rdot) -> Edot                               dE/dR along Rdot, Rdot by columns
    differentiate_twice(R, Rdot, Rddot) -> Eddot

    about: which coordinate a user takes for the turn about x, about y and about z; None if there is no such choice.
    short: what it is called beside a curve, in the plural. look: how it is drawn.
    papers: whether it is the paper's own (Murphy 1988, 2.2).
    linear: what E making a linear motion from rest is, as an equation of the angle; None if it depends on the axis.
    """

    name: str
    title: str
    source: str
    formula: str
    symbols: tuple
    chart: Callable
    chart_of: Callable
    to_matrix: Callable
    rates: Callable
    accelerate: Callable
    angular_velocity: Callable
    generalized: Callable
    margin: Callable
    differentiate: Callable | None = None
    differentiate_twice: Callable | None = None
    about: tuple[int, int, int] | None = (0, 1, 2)
    short: str = ""
    look: Look | None = None
    papers: bool = False
    linear: Equation | None = None

    @property
    def goal_chart(self) -> Callable:
        """The chart again, for the goal: a name of its own, so that its cost is a stage of its own."""
        return self.chart
