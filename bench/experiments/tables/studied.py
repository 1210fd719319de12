"""Tables that no experiment makes: times, shares of a study of perturbations, and what other libraries answer."""

from bench.experiments.columns import CONTENDER_KEY, LEVEL, LEVEL_KEY, Column, Table, counts, numbers, words


def timing_columns() -> list[Column]:
    """timings/<machine>.parquet: one row for everything timed, in one run whose passes visit all of it."""
    return [
        *words(
            what="law (alone), controller (kinematics, D, fg, law, Jacobian and inverse, without plant and judge), "
            "engine (a whole loop), loop (the empty loop that every law's time holds), or threads (two against one, on "
            "the wall)",
            arm="manipulator; empty for a law alone and for the free body",
            regulator="the law; empty for the empty loop and for rollout",
            representation="coordinates the law acts on; empty for a law on R",
            jacobian="Jacobian of the arm; empty for the free body",
            inverse="how the Jacobian is inverted; empty for the free body",
            engine="ideal-held, ideal-rk4, native, rollout (mujoco.rollout, open loop) or dm-control (its "
            "Environment.step and the law in numpy); empty for a law alone",
        ),
        *numbers("ns", "CPU time a tick, median over passes; of threads: time on the wall of two", "ns_per_tick"),
        *numbers("ns", "CPU time of one step of the reference kernel, median over passes", "ns_reference_kernel"),
        *numbers("1", "time a tick over the kernel's step of the same pass, median over passes", "ratio"),
        *numbers("1", "interval of that median, 95 % by order statistics", "ratio_low", "ratio_high"),
        *numbers(
            "1", "native, dm-control: time a tick over rollout's of the same pass, median over passes", "ratio_rollout"
        ),
        *numbers("1", "interval of that median, 95 % by order statistics", "ratio_rollout_low", "ratio_rollout_high"),
        *numbers(
            "1", "dm-control: its time a tick over native's of the same pass; threads: one's time over two's", "speedup"
        ),
        *numbers("1", "interval of that median, 95 % by order statistics", "speedup_low", "speedup_high"),
        *counts(
            passes="passes; of threads: repetitions",
            ticks="ticks of one round; 0 if the law fails and could not be timed",
        ),
    ]


def library_columns() -> list[Column]:
    """libraries/libraries.parquet: what robot libraries say at the same turns, a row a function and set."""
    how_many = {
        "turns": "how many were asked for",
        "raised": "of them, those that raised an error",
        "not_finite": "those answered with what is no number",
        "nought": "those answered with less than a millionth of the angle",
        "long_way": "those answered with the vector of the longer rotation",
        "astray": "those answered with a vector more than 0.1 rad off the axis",
        "other_sheet": "those answered otherwise when given as -q, for functions that take quaternions",
    }
    return [
        *words(
            library="who is asked",
            version="of its package",
            function="the function, with the factor that makes it theta k near the identity",
            kind="function: the library offers it; idiom: users write it on functions of the library",
            takes="matrix or quaternion",
            form="what it means to be: a word of bench/studies/libraries/judge.py",
            precision="double, or single by design of the library",
            thread="where the fault is known upstream: owner/repository#number; empty if no thread was found",
            turn_set="family of turns: bench/studies/libraries/turns.py",
        ),
        *numbers("rad", "angle of every turn of the set; null if they differ", "angle_rad"),
        *numbers("rad", "how much every turn of the set is short of half a turn; null if they differ", "distance_rad"),
        *counts(**how_many),
        *numbers("rad", "largest |e - theta k|, theta and k known; null if no answer is a number", "error_rad"),
        *numbers("rad", "largest error against its own closed form; of angles, of the turn rebuilt", "form_error_rad"),
        *numbers(
            "rad", "largest angle to the turn that an answer stands for, or excess over the short way", "turn_error_rad"
        ),
        *numbers("rad", "largest and smallest |e|", "largest_rad", "smallest_rad"),
    ]


def closed_loop_columns() -> list[Column]:
    """libraries/closed_loop.parquet: libraries' errors and controllers on the free body, a row an angle and sheet."""
    how_many = {
        "starts": "how many",
        "settled": "of them, those that settled as the judge says (tasks/rules.py)",
        "dead": "those that never move: at rest, and the command exactly zero",
        "lost": "those that had not settled at the horizon",
        "failed": "those for which no number came",
        "away": "those that turned away from the goal by more than a degree before they came to it",
    }
    return [
        *words(
            library="who is asked",
            version="of its package; of a controller that is restated, the commit that was read",
            function="its error, or its controller",
            kind="function or idiom: its error in u = kp e - kv omega; controller: as its users run it; our-loop: "
            "with their error and gains, in a loop written here; restated: by its source",
            title="of a controller: what is run, with its gains",
            error="the function that it takes for its error; itself but for controllers",
            command="acceleration or velocity",
            sheet="near: from the quaternion whose scalar is not negative; antipode: from the other one",
        ),
        *numbers("deg", "angle of the starts; at 180 exactly", "angle_deg"),
        *counts(**how_many),
        *numbers("s", "settling time of the fastest and of the slowest that settled", "fastest_s", "slowest_s"),
        *numbers("1", "stiffness felt near the goal over the one set; null for controllers", "stiffness_ratio"),
        *numbers(
            "1", "acceleration from rest over its slope at 1 deg, where it is no multiple of an error", "pull_ratio"
        ),
    ]


def verdict_columns() -> list[Column]:
    """libraries/verdicts.parquet: what `bench audit` says of each function, and what replaces it, a row a function."""
    return words(
        library="who is asked",
        version="of its package; of a controller that is restated, the commit that was read",
        function="its error",
        takes="matrix or quaternion",
        convention="what it means by its three numbers, as the audit found",
        faults="names of its faults, with commas between; empty if it has none",
        replacement="the smallest change that cures it, or a function of replacements.py; empty if it needs none",
        replacement_faults="what the audit says of that one",
        fixed="faults that an earlier version had and this one has not",
        fixed_since="that earlier version",
    )


def perturbed_columns() -> list[Column]:
    """robustness/perturbed.parquet: the perturbed free body from hundreds of starts, a row a law and level."""
    return [
        *LEVEL,
        *counts(
            starts="how many, the same for every law",
            good="of them, those that settled; where it lasts, those left within 3 degrees rms",
        ),
        *numbers("s", "median settling time, those that never settle counted as infinite", "median_s"),
        *numbers("s", "longest settling time of those that settled; null if none did", "longest_s"),
    ]


STUDIED = (
    Table("perturbed", perturbed_columns, LEVEL_KEY),
    Table("timings", timing_columns, ("what", "arm", *CONTENDER_KEY, "engine")),
    Table("libraries", library_columns, ("library", "function", "takes", "turn_set")),
    Table("closed_loop", closed_loop_columns, ("library", "function", "kind", "sheet", "angle_deg")),
    Table("verdicts", verdict_columns, ("library", "function", "takes")),
)
