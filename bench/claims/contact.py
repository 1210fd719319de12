"""C25: complex compliant motions by both Jacobians (Murphy 1988, 3.3)."""

from bench.claims.verdict import claim

TURNED_DEG = 45.0
"""|beta| of the hand's frame from which on the two shall part: its x then leans to z as much as it lies level."""

PARTS = 2.0
"""Factor between two numbers that are not the same performance."""

FLOORS = {"rad": 1e-3, "N": 0.1, "N m": 0.01, "m": 1e-4}
"""By unit; a number below is taken for it, so that nothing is compared with almost nothing. About what the contact of a
simulated hand leaves at rest."""

C25 = claim(
    id="C25",
    section="3.3",
    sentence="How well complex compliant motions go depends on the Jacobian used.",
    question="Do contact tasks end differently with the two Jacobians?",
    criterion=f"""
        compliance.parquet, every task with contact whose order lets two or more turns comply: hybrid/zyx-euler against
        hybrid-base, the same law but for the Jacobian, on the same arm, scene and frame of the hand and in the same
        form. Compared: outcomes, and if both are done each number of performance that the task has: alignment error,
        rms error and peak of force and of moment, insertion depth. A pair parts if the outcomes differ or one number
        does by a factor of {PARTS:g} or more, numbers below {", ".join(f"{x:g} {unit}" for unit, x in FLOORS.items())}
        being taken for that. A task depends on the Jacobian if on every arm and in both forms some pair with |beta| >=
        {TURNED_DEG:g} degrees parts, and none with beta = 0: then the coordinates are to blame, and not the way to the
        joints. It holds if every such task depends on it; with a correction if on some task some pair with |beta| >=
        {TURNED_DEG:g} degrees parts; otherwise it does not hold. A task without both kinds of frames is no evidence.
        Reported: how often Euler is the worse of a pair that parts, and how many pairs part on tasks where fewer turns
        comply.
    """,
    open="""
        "The performance of complex compliant robot motions will depend upon which form of Jacobian is used in the
        controller." Neither motions nor performance are named. Complex is read from the sentence before it: two
        rotational axes comply. Tasks and frames are ours.
    """,
)

CLAIMS = (C25,)
