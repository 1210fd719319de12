"""shipped.parquet: controllers as they are shipped, and laws of ours at the same gains."""

from bench.tables.column import COUNT, Column, numbers, words

FELT_RAD = {"stiffness_1mrad": 1e-3, "stiffness_50mrad": 5e-2, "stiffness_1rad": 1.0}
"""Where stiffness is felt: inside any deadband, outside it and under any clip of torques, and under clips."""
BENT_DEG = (10, 30, 90, 150)
"""Where the direction of the command is looked at."""
SETTLING_DEG = {"1": 1.0, "30": 30.0, "90": 90.0, "150": 150.0, "179": 179.0, "179_9": 179.9}


def shipped_columns() -> list[Column]:
    """shipped.parquet: controllers as they are shipped, and laws of ours at the same gains (bench/contenders/shipped).

    A row a controller, and one more for each law of ours in its place, with the same two gains. Of velocity commands
    what is a function of the orientation alone.
    """
    times = {f"settling_{name}_s": f"{name.replace('_', '.')}°" for name in SETTLING_DEG}
    return [
        *words(
            shipped="the controller whose gains they are",
            law="empty: the controller as shipped; else the law of ours in its place",
            level="what is commanded: torque, velocity or position",
            shapes_inertia="whether unit inertia is felt whatever the body's: yes or no",
        ),
        *numbers("1/s^2", "stiffness as set, of unit inertia; of a velocity command 1/tick", "kp"),
        *numbers("1/s", "damping as set, of unit inertia; null of a velocity command", "kv"),
        *numbers("1", "command along a base axis over stiffness set times angle, the least of three", *FELT_RAD),
        *numbers("1", "damping ratio felt at 50 mrad of a body of unit inertia; null of a velocity", "damping_ratio"),
        *numbers("kg m^2", "inertia that is critically damped at 50 mrad; null where inertia is shaped", "critical"),
        *numbers(
            "rad",
            "largest angle between command and axis at so many degrees, over directions; null where all rest",
            *(f"bent_{angle}_rad" for angle in BENT_DEG),
        ),
        Column("half_turns", COUNT, "1", "exact 180° rotations that were looked at"),
        Column("dead", COUNT, "1", "of them, those at which it rests for ever"),
        Column("starts", COUNT, "1", "episodes, from both signs of the quaternion; 0 of a velocity"),
        Column("lost", COUNT, "1", "of them, those that never settle"),
        Column("away", COUNT, "1", "of them, those that turn away from the goal by more than 1°: that unwind"),
        *(
            one
            for name, angle in times.items()
            for one in numbers("s", f"settling time of the slowest start at {angle}; null if one is lost", name)
        ),
        *numbers("s", "likewise at 1e-6 rad before 180°", "settling_near_180_s"),
        *words(
            findings="what the audit says of its error, faults and notes, with commas between; empty of laws of ours"
        ),
    ]
