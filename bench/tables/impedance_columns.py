"""Tables of impedances that shape no inertia: episodes in free motion, and the modes about the goal."""

from bench.tables.column import COUNT, SINGLE, Column, numbers, words
from bench.tables.motion_columns import JUDGED

WHAT = [
    *words(arm="manipulator", damping="design of the damping"),
    *numbers("N/m", "stiffness of translation", "stiffness_n_m"),
    *numbers("N m/rad", "stiffness of turns, that of the error vector 1 rad long", "stiffness_nm_rad"),
    *numbers("1", "damping ratio that is asked for", "zeta"),
]


def impedance_columns() -> list[Column]:
    """impedance.parquet: tau = J^T (K e - D v) + g in free motion, from rest, and where its energy goes; an episode.

    stored_j = left_j + damped_j + elbow_j - added_j + unaccounted: the integrator's, of the order of the tick.
    """
    energies = {
        "stored_j": "potential energy of the springs at the start",
        "left_j": "potential and kinetic energy at the end",
        "damped_j": "energy taken by the damping of the hand",
        "elbow_j": "energy taken by the damping of the null space; 0 on six joints",
        "added_j": "work of what is compensated beside gravity; negative of friction that is not",
    }
    seen = {
        "overshoot": ("1", "greatest error against the first one's direction, over the first one"),
        "off_m": ("m", "greatest distance of the tool from its place"),
        "strain": ("1", "greatest torque of a joint over its rated one"),
        **{name: ("J", meaning) for name, meaning in energies.items()},
    }
    return [
        *words(suite="plan the row belongs to"),
        *WHAT,
        *words(
            compensated="gravity, or bias: gravity, Coriolis torques and friction",
            law="whose command at rest, over kp, is the error of orientation",
            start_set="family of starts, all at rest",
            start_id="start within its family",
        ),
        *numbers("rad", "initial angle to the goal, by the judge", "angle0_rad"),
        *numbers("s", "control period", "dt_s"),
        *numbers("s", "longest time simulated", "horizon_s"),
        *JUDGED,
        *(Column(name, SINGLE, unit, meaning) for name, (unit, meaning) in seen.items()),
    ]


def mode_columns() -> list[Column]:
    """impedance-modes.parquet: modes about the goal, from one tick of the loop, differentiated at the arm's home.

    What theory says of it: bench/findings/theory/impedance_modes.py.
    """
    return [
        *WHAT,
        *numbers("s", "control period", "dt_s"),
        Column("mode", COUNT, "1", "place by frequency, from 1"),
        *numbers("1/s", "natural frequency", "omega"),
        *numbers("1", "damping ratio felt: of the mode's damping to its critical one", "ratio"),
        *numbers("1/s", "slowest decay of all modes' errors; negative if one grows", "decay"),
        *numbers("1", "greatest eigenvalue of the tick's map, as it is sampled; 1 and above is unstable", "radius"),
    ]
