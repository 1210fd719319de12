"""Contenders and controllers that suites run, as the command line names them."""

ON_ANGULAR = (
    "rotation-matrix",
    "linearized-euler/zyx-euler",
    "linearized-euler-relative/zyx-euler",
    "feedback-linearized/zyx-euler",
)
IN_COORDINATES = ("zyx-euler", "zyz-euler", "xyz-euler", "rotation-vector", "mrp", "quaternion")
LAWS = tuple(f"{law}@geometric+standard" for law in ON_ANGULAR)
BEST = tuple(
    f"{law}@geometric+standard"
    for law in ("hybrid", "late-braking", "mrp-linearized", "quaternion-shortest", "mrp", "rotation-vector")
)
"""The later laws that run on arms: those that no noise holds at a 180° rotation, and of the simplest others three whose
springs differ. Whatever law is advised is among them (a test)."""
BY_WORD_ALONE = (
    *("bounded-command", "euler-gradient", "feedback-linearized-literal", "gibbs", "hybrid", "late-braking"),
    *("linearized-euler-literal", "mrp", "mrp-linearized", "paielli-bach", "quaternion-shortest"),
    *("quaternion-unwinding", "rotation-vector", "sliding", "square-root", "weighted-columns"),
)
"""Laws that run on arms only where a suite's words name them; a law that is in no list here runs there too."""
STREAMED = ("rotation-matrix", *(word.partition("@")[0] for word in BEST))
"""What follows goals that arrive as a stream: the paper's first, and those."""
ANALYTIC = tuple(f"feedback-linearized/{word}@analytic+standard" for word in IN_COORDINATES)
RESOLVED = "rotation-matrix@geometric"
BOUNDED = ("damped-least-squares", "damped-least-squares-variable", "truncated-svd", "dynamically-consistent")
INVERSES = (
    *(f"{RESOLVED}+{word}" for word in ("pseudo-inverse", *BOUNDED, "transpose")),
    *(f"feedback-linearized/zyx-euler@analytic+{word}" for word in BOUNDED),
)
TWINS = (
    "rotation-matrix@geometric-body+standard",
    "feedback-linearized/zyx-euler@analytic-differentiated+standard",
)
"""Controllers mathematically equivalent to another one: the same command by another Jacobian."""

AT_INVERSES = ("wrist", "uniform")
"""Start sets on which inverses are distinguished, and twins looked at: beside the arm's singularities, and anywhere."""

VARIED = (LAWS[0], LAWS[3], ANALYTIC[0])  # they settle every clear start of a perfect model

COMPLIANT = (
    "hybrid-base+transpose",
    "hybrid/zyx-euler+transpose",
    "hybrid/zyz-euler+transpose",
    "hybrid-unconverted/zyx-euler+transpose",
    "hybrid-base+inverse",
    "hybrid-base+projected",
    "hybrid-rate+inverse",
    "hybrid-hand+inverse",
    "hybrid/zyx-euler+inverse",
    "hybrid/zyx-euler+projected",
    "hybrid/zyz-euler+inverse",
    "hybrid-unconverted/zyx-euler+inverse",
    "impedance-geometric",
    "impedance-coordinates/zyx-euler",
    "impedance-coordinates-relative/zyx-euler",
)
"""Controllers in contact that tell the coordinates apart, the paper's form first, and the control and the form that
must not be blamed."""

MORE_COMPLIANT = (
    "hybrid-hand+projected",
    "hybrid/xyz-euler+inverse",
    "hybrid/rotation-vector+inverse",
    "hybrid/mrp+inverse",
    "impedance-rotation-vector",
    "impedance-quaternion",
)

REDUNDANT = (
    "hybrid-base+transpose",
    "hybrid/zyx-euler+transpose",
    "hybrid-base+inverse",
    "hybrid/zyx-euler+inverse",
)
"""The part of COMPLIANT that an arm of seven joints runs: the paper's form and the other, on both Jacobians."""

FIRST_SERIES, FIRST_SCENES = 48, 9
"""Poses on seven joints: of wrench-probe its first series up to beta = 75 degrees, of the other tasks all; of `quick`
three scenes of each task, every frame of the hand."""

FIRST_FRAMES = 90
"""Poses of `quick`: of wrench-probe its first series over beta and the frames that lean every way; of the other tasks
all."""
