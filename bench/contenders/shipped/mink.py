"""The frame task of mink: the logarithm over the period of a tick, as a velocity; with gain 1 all of it in one tick."""

from bench.law.shipped import VELOCITY, Shipped, logarithm

SHIPPED = Shipped(
    "mink",
    "mink, frame task",
    "kevinzakka/mink@cf1a302ff31b1f620abecdcbdebfd2c42d125a54",
    "mink/tasks/frame_task.py, mink/tasks/task.py, mink/lie/so3.py",
    VELOCITY,
    r"e = \log(R_d R^\top)",
    logarithm,
    1.0,
    None,
    "default gain 1, over the period",
    besides="solves for joint rates within limits; its error is the logarithm of SE(3), whose rotation is this one",
)
