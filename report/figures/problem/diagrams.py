"""Block diagrams of the plant, the judge and the regulators.

The scan of the paper lacks its figures 2.1 and 2.2: here they are drawn from its text.
"""

from __future__ import annotations

from report.figures.kit import style
from report.figures.kit.blocks import Board
from report.figures.kit.inline import responsive_picture

PLANT = r"$\dot\omega = u,\;\; \dot R = [\omega]_{\times}\!R$"


@responsive_picture
def judge_and_contestants(*, narrow=False):
    """Who computes what in one tick."""
    board = Board(narrow, 2.7, 4.3, (2.72, 1.15), (1.5, 1.95), (0.8, 0.98), (1.0, 0.55))
    blue = style.look("rotation-matrix").colour
    wide, side = (1.55, 1.35) if narrow else (1.7, 1.7)
    board.block("goal", (0, 0), "goal $R_d$\nstart $R_0,\\ \\omega_0$", (1.25, 0.7))
    law = "representation $E$\nregulator $u$"
    board.block("law", (1, 0), law, (wide, 0.95), blue, "Contestant", 1.8)
    board.block("plant", (2, 0), f"{PLANT}\nMuJoCo", (wide, 0.95), style.INK, "Plant", 1.2)
    board.block("judge", (2, 1), "angle, band, limits", (side, 0.62), style.INK, "Judge", 1.2)
    board.block("row", (1, 1), "outcome,\nsettling time", (side, 0.62))
    board.wire("goal", "law")
    board.wire("law", "plant", colour=blue)
    board.wire("plant", "judge")
    board.wire("judge", "row", dashed=True)
    if narrow:
        board.label((1.5, 0), "$u$", shift=(0.1, 0.0), ha="left", va="center")
        board.label((2, 0.52), "quat", shift=(0.0, 0.05))
    else:
        board.label((1.5, 0), "$u$", shift=(0.0, 0.06))
        board.label((2, 0.5), "its own quaternion", shift=(-0.08, 0.0), ha="right", va="center", fontsize=9.5)
    feedback(board, blue)
    return board.figure, (
        "Block diagram. The goal and the start go to the contestant, a representation and a regulator, which sends "
        "the command u to the plant. The plant returns R and omega to the contestant and its own quaternion to the "
        "judge, who alone decides outcome and settling time."
    )


def feedback(board: Board, colour: str) -> None:
    """R and omega back from the plant to the contestant."""
    over = -0.47 if board.narrow else -0.62
    board.wire("plant", "law", via=[(2, over), (1, over)], colour=colour)
    if board.narrow:
        board.label((1.5, over), r"$R,\,\omega$", shift=(0.05, 0.0), ha="left", va="center")
    else:
        board.label((1.5, over), r"$R,\ \omega$", shift=(0.0, 0.04))


@responsive_picture
def on_the_matrix(*, narrow=False):
    """The rotation-matrix regulator in its loop: figure 2.1 of the paper."""
    board = Board(narrow, 1.95, 4.9, (1.42, 1.0), (0.98, 1.45), (0.35, 0.6), (1.0, 0.35))
    blue = style.look("rotation-matrix").colour
    board.point("R_d", (0, 0))
    error = r"$\frac{1}{2}\,\sum\; r_i \times r_{d,i}$"
    board.block("error", (1, 0), error, (1.45, 0.56), blue, weight=1.6)
    board.block("gain", (2, 0), "$K_p$", (0.55, 0.42), blue, weight=1.6)
    board.sum("sum", (2.65, 0))
    board.block("plant", (3.75, 0), PLANT, (1.7, 0.56), style.INK)
    board.block("rate", (2.65, 0.62), "$K_v$", (0.55, 0.42), blue, weight=1.6)
    board.wire("R_d", "error")
    board.wire("error", "gain")
    board.wire("gain", "sum")
    board.wire("sum", "plant")
    board.wire("rate", "sum")
    board.wire("plant", "rate", via=[(3.75, 0.62)])
    board.wire("plant", "error", via=[(4.55, 0), (4.55, 1.05), (1, 1.05)])
    side = {"shift": (-0.08, 0.05), "ha": "right"} if narrow else {"shift": (0.0, 0.06)}
    start = {"shift": (0.1, -0.16), "ha": "left"} if narrow else {"shift": (0.1, 0.06)}
    board.label((0.0, 0), "$R_d$", **start)
    board.label((1.62, 0), "$e$", **side)
    board.label((2.98, 0), "$u$", **side)
    wrapped = {"shift": (0.0, 0.06), "ha": "center"}
    board.label((3.25, 0.62), r"$\omega$", **({"shift": (0.08, 0), "ha": "left"} if narrow else wrapped))
    board.label((3.3, 1.05), "$R$", **({"shift": (0.08, 0), "ha": "left"} if narrow else wrapped))
    minus = {"shift": (0.2, 0.04)} if narrow else {"shift": (0.1, -0.3)}
    board.label((2.65, 0), "\N{MINUS SIGN}", **minus)
    return board.figure, (
        "Block diagram of the rotation-matrix regulator: half the sum of the cross products of the columns of R and "
        "of the desired R, times K_p, minus K_v omega, is the command u of the plant; R and omega are fed back."
    )


@responsive_picture
def on_the_angles(*, narrow=False):
    """The feedback-linearized Euler regulator in its loop: figure 2.2 of the paper."""
    board = Board(narrow, 2.25, 5.2, (1.42, 1.0), (1.02, 1.7), (0.35, 0.45), (0.82, 0.2))
    green = style.look("feedback-linearized").colour
    board.point("E_d", (0, 0))
    board.block("law", (0.98, 0), "$K_p (E_d - E)$\n$-\\;K_d\\, \\dot E$", (1.3, 0.66), green, weight=1.6)
    board.block("linearize", (2.25, 0), r"$B\,u_E + \dot B\,\dot E$", (1.3, 0.56), green, weight=1.6)
    board.block("plant", (3.75, 0), PLANT, (1.55, 0.56), style.INK)
    side = (0.88, 0.5) if narrow else (1.3, 0.5)
    board.block("rates", (2.25, 0.72), r"$\dot E = B^{-1} \omega$", side, green, weight=1.6)
    board.block("angles", (2.25, 1.42), "$E$ from $R$", side, green, weight=1.6)
    board.wire("E_d", "law")
    board.wire("law", "linearize")
    board.wire("linearize", "plant")
    board.wire("plant", "rates", via=[(3.75, 0.72)])
    board.wire("plant", "angles", via=[(4.55, 0), (4.55, 1.42)])
    board.wire("rates", "linearize")
    board.wire("rates", "law", via=[(1.15, 0.72)])
    board.wire("angles", "law", via=[(0.8, 1.42)])
    board.wire("angles", "rates")
    beside = {"shift": (-0.08, 0.0), "ha": "right", "va": "center"} if narrow else {"shift": (0.0, 0.06)}
    start = {"shift": (0.1, -0.16), "ha": "left"} if narrow else {"shift": (0.08, 0.06)}
    across = {"shift": (0.06, 0.0), "ha": "left", "va": "center"} if narrow else {"shift": (0.0, 0.05)}
    board.label((0, 0), "$E_d$", **start)
    board.label((1.61, 0), "$u_E$", **beside)
    board.label((2.98, 0), "$u$", **beside)
    board.label((3.3, 0.72), r"$\omega$", **across)
    board.label((3.6, 1.42), "$R$", **across)
    board.label((1.45, 0.72), r"$\dot E$", **across)
    board.label((1.3, 1.42), "$E$", **across)
    return board.figure, (
        "Block diagram of the feedback-linearized Euler regulator: a PD law on the angles gives u_E; B u_E plus B-dot "
        "E-dot is the command u of the plant. Angles are extracted from R and their rates from omega by the inverse of "
        "B; both are fed back."
    )
