"""The frame task of pink: that of mink, by pinocchio's logarithm of SE(3), whose rotation this is."""

from bench.law.kinds import VELOCITY
from bench.law.shipped import as_shipped, logarithm

SHIPPED = as_shipped(
    "pink",
    "pink, frame task",
    "stephane-caron/pink@f568e80536549a3b7f627468eb29526d3404c85b",
    "pink/tasks/frame_task.py, pink/tasks/task.py",
    VELOCITY,
    r"e = \log(R_d R^\top)",
    logarithm,
    1.0,
    0.0,
    "default gain 1, over the period",
)
