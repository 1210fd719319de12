"""The frame task of mink: the logarithm over the period of a tick, as a velocity; gain 1 takes all of it in a tick.

Its error is the logarithm of SE(3), whose rotation this is, and joint rates are solved for within limits. The commit is
of 2024-10-02; release 1.3.0 computes the logarithm otherwise.
"""

from bench.law.kinds import VELOCITY
from bench.law.shipped import as_shipped, logarithm

SHIPPED = as_shipped(
    "mink",
    "mink, frame task",
    "kevinzakka/mink@cf1a302ff31b1f620abecdcbdebfd2c42d125a54",
    "mink/tasks/frame_task.py, mink/tasks/task.py, mink/lie/so3.py",
    VELOCITY,
    r"e = \log(R_d R^\top)",
    logarithm,
    1.0,
    0.0,
    "default gain 1, over the period",
)
