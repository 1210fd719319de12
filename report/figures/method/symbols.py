"""The symbols of the formulas and the terms of the text, each with its meaning and unit."""

from __future__ import annotations

from report.figures.kit.page import Run
from report.figures.kit.tables import Table

SYMBOLS = (
    (r"R,\ R_d", "rotation matrix from the hand's or body's frame to the base frame, and the desired one", ""),
    (r"\omega", "angular velocity", "rad/s"),
    (r"u", "command of a law: angular acceleration", "rad/s²"),
    (r"K_p,\ K_v", "position and velocity gain of a law near the goal", "1/s², 1/s"),
    (r"\theta,\ k", "angle and axis of the rotation from the orientation to the goal", "rad"),
    (r"\phi = \theta\,k", "rotation vector to the goal", "rad"),
    (r"\eta,\ \epsilon", "scalar and vector part of the unit quaternion of that rotation", ""),
    (r"\sigma", "its modified Rodrigues parameters", ""),
    (r"\alpha,\ \beta,\ \gamma", "Euler angles, about Z, Y, X in that order unless another is named", "rad"),
    (r"E,\ E_d", "coordinates of an orientation, and of the goal", ""),
    (r"B", "angular velocity by the rate of the coordinates", ""),
    (r"q,\ \tau", "joint angles and joint torques", "rad, N m"),
    (r"D,\ f_g", "inertia matrix of an arm, and its torques of gravity and motion", "kg m², N m"),
    (r"J,\ J_E", "geometric Jacobian, and the one whose lower rows are rates of coordinates", "m, 1"),
    (r"\Lambda", "inertia that the hand feels", "kg, kg m²"),
    (r"S", "selection matrix: 1 where motion is controlled, 0 where force is", ""),
    (r"K,\ D", "stiffness and damping matrix of an impedance", "N/m, N m/rad; N s/m, N m s/rad"),
    (r"h", "control period", "s"),
)
TERMS = (
    ("directed start", "one aimed at a place where a law may fail; the others are spread evenly"),
    ("pole", "an orientation at which coordinates lose a direction, as Z-Y-X angles do at 90° of the second"),
    ("settled", "inside the band, 2 % of the first angle, and slow until the end"),
    ("saturated", "the command is beyond any use"),
    ("singular", "the command is not a number, or the Jacobian cannot be inverted"),
    ("start set", "starts drawn or listed under one name; a result is given for each"),
    ("stuck", "outside the band at the end, without speed or command: at an equilibrium away from the goal"),
    ("tick", "one control period"),
    ("unwinding", "taking the longer rotation because a quaternion and its negative are answered differently"),
    ("worst and typical branch", "the path through a law's conditions that takes most operations, and the usual path"),
)
OF_SYMBOLS, OF_TERMS = Table("Symbol | Meaning | Unit"), Table("Term | Meaning")


def tables(_: Run) -> dict:
    """Both."""
    return {
        "symbols": OF_SYMBOLS((f"${symbol}$", meaning, unit or "1") for symbol, meaning, unit in SYMBOLS),
        "terms": OF_TERMS(TERMS),
    }
