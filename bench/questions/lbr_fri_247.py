"""An impedance oscillates: its damping was set for unit inertia."""

import numpy as np
from scipy.integrate import solve_ivp

from bench.questions.question import Curves, Question

INERTIA, K = np.geomspace(0.1, 10.0, 25), 250.0


def overshoot(inertia: float, D: float) -> float:
    """Of I x'' + D x' + K x = 0 from x = 1 at rest, how far x goes beyond zero [%]."""
    length = 12.0 * max(D / K, inertia / D)
    found = solve_ivp(
        lambda _, x: (x[1], -(K * x[0] + D * x[1]) / inertia),
        (0.0, length),
        (1.0, 0.0),
        rtol=1e-8,
        max_step=length / 200,
    )
    return 100.0 * max(0.0, -float(found.y[0].min()))


def curves() -> Curves:
    """D = 2 sqrt(K), and D = 2 sqrt(K I)."""
    before = [overshoot(inertia, 2.0 * np.sqrt(K)) for inertia in INERTIA]
    after = [overshoot(inertia, 2.0 * np.sqrt(K * inertia)) for inertia in INERTIA]
    return Curves(INERTIA, np.array(before), np.array(after))


QUESTION = Question(
    "lbr-fri-247",
    "Rotational stiffness oscillates",
    ("lbr-stack/lbr_fri_ros2_stack#247", "matthias-mayr/Cartesian-Impedance-Controller#30"),
    "Raised stiffness makes two arms oscillate. One of the authors finds the cause: D = 2 ξ √K holds for unit "
    "mass, and their arm is heavy.",
    "Without inertia shaping the inertia is the arm's own: the damping ratio is 1/√I of the one that was set.",
    "D of the inertia at the pose: 2 √(K I) about one axis, by double diagonalization of Λ and K about all.",
    "inertia about the axis [kg m²]",
    "overshoot of a step [%]",
    curves,
    tolerance=0.5,
    is_log_x=True,
)
