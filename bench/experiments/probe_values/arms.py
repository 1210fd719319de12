"""Values of what is measured of arms under the controllers of Murphy 1988."""

TASK = "arm-regulation"
BY_EULER = "feedback-linearized/zyx-euler@analytic"
ON_MATRIX = "rotation-matrix@geometric"
"""(3.7), and (2.2) with the law on R; the inverse goes by the number of joints."""

INVERSES = {6: "solve", 7: "pseudo-inverse"}
"""The inverse of the claims, by number of joints: what J^-1 means on six, and its least-squares heir on seven."""

CURVES = 8
"""Clear starts whose curves are computed at both steps."""

SIX_JOINTS = ("puma560", "ur5e")
"""Arms of the paper's six joints."""

STATES = 20
"""Random states of each arm of six joints."""

OFF = "mass-1.30"
"""The plant that the model does not describe."""
