"""The options of `advise` for an arm, in N m/rad: which go together, and what they ask."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import rich_click as click
from click.core import ParameterSource

from bench.cli import options

if TYPE_CHECKING:
    from bench.findings.selection.arm_question import ArmQuestion
    from bench.findings.selection.tool_chain import ToolChain

STIFFNESS = options.NumberOption(1e-3, 1e6, 50)
"""[N m/rad]: a millinewton metre a radian moves no arm; a meganewton metre a radian is a wall."""

DAMPING = options.NumberOption(0.0, 1e6, 10)
TORQUE = options.NumberOption(1e-6, 1e6, 12, infinite="no bound")

SOURCES = ("arm", "mjcf", "urdf")
"""The options that name an arm; one of them makes the question one of an arm."""

NUMBERS = ("stiffness", "damping", "torque", "site", "body")
"""What makes sense with an arm alone."""

COMPUTED = {
    "kp": "is the stiffness over the inertia felt, which is computed",
    "kv": "is the damping over the inertia felt, which is computed; give --damping",
    "bound": "is the torque over the inertia felt, which is computed; give --torque",
    "inertia": "is the true inertia over a model's, and an orientation spring has no model",
    "unevenness": "is computed from the arm",
    "robot": "is known: an orientation spring commands torque and cancels no inertia",
}
"""Options of the older question that an arm's cannot take, and why."""

ARM_OPTIONS = (
    click.option(
        "--arm", metavar="NAME", help="An arm of the benchmark, as panda (bench list arms)."
    ),
    click.option(
        "--mjcf", type=options.PATH, metavar="FILE", help="Your arm's MJCF; needs --site or --body."
    ),
    click.option(
        "--urdf", type=options.PATH, metavar="FILE", help="Your arm's URDF; the tool is --body."
    ),
    click.option("--site", metavar="NAME", help="With --mjcf: the site that is the tool."),
    click.option(
        "--body",
        metavar="NAME",
        help="With --mjcf or --urdf: the tool's body; of URDF the last one.",
    ),
    click.option("--stiffness", type=STIFFNESS, help="K of the orientation spring [N m/rad]."),
    click.option(
        "--damping", type=DAMPING, help="D beside it [N m s/rad]; without it, D is proposed."
    ),
    click.option(
        "--torque",
        type=TORQUE,
        help="Greatest torque on the tool [N m].",
        show_default="of --arm its smallest rated torque, else none",
    ),
)


def take_arm_options(command: Callable) -> Callable:
    """Add the options of an arm to a command."""
    for option in reversed(ARM_OPTIONS):
        command = option(command)
    return command


def is_asked_of_arm(context: click.Context) -> bool:
    """Tell whether the options name an arm; UsageError if the options do not go together."""
    words = context.params
    named = [name for name in SOURCES if words[name] is not None]
    if not named:
        lonely = [name for name in NUMBERS if words[name] is not None]
        if lonely:
            raise click.UsageError(
                f"--{lonely[0]} is a number or name of an arm; name the arm, too (try: --arm panda "
                "--stiffness 50)"
            )
        return False
    if len(named) > 1:
        raise click.UsageError(
            f"--{named[0]} and --{named[1]} both name an arm; give one of them (try: --{named[0]})"
        )
    if words["stiffness"] is None:
        raise click.UsageError(
            f"--{named[0]} needs the stiffness of its orientation spring (try: --stiffness 50)"
        )
    for name, reason in COMPUTED.items():
        if context.get_parameter_source(name) is not ParameterSource.DEFAULT:
            raise click.UsageError(f"--{name} {reason} (try: leave --{name} out)")
    _check_effector(named[0], words)
    if words["damping"] == 0.0:
        raise click.UsageError(
            "--damping 0: nothing settles without damping (try: leave --damping out; D is proposed)"
        )
    return True


def _check_effector(source: str, words: dict[str, Any]) -> None:
    """Refuse a site or a body where the arm takes none."""
    if source == "arm" and (words["site"] or words["body"]):
        raise click.UsageError(
            "the tool of --arm is its site 'tool' (try: leave --site and --body out)"
        )
    if source == "urdf" and words["site"]:
        raise click.UsageError(
            "a URDF has no sites; name the link that is the tool (try: --body NAME)"
        )
    if words["site"] and words["body"]:
        raise click.UsageError(
            "--site and --body both name the tool; give one of them (try: --site)"
        )


def load_chain(words: dict[str, Any]) -> ToolChain:
    """Return the arm that the options name."""
    from bench.findings.selection import tool_chain

    if words["arm"] is not None:
        return tool_chain.load_arm(words["arm"])
    if words["mjcf"] is not None:
        return tool_chain.load_mjcf(words["mjcf"], words["site"], words["body"])
    return tool_chain.load_urdf(words["urdf"], words["body"])


def read_question(words: dict[str, Any]) -> ArmQuestion:
    """Return the question that the options ask."""
    import tasks
    from bench.findings.selection.arm_question import ArmQuestion

    torque = words["torque"]
    if torque is None:
        # A torque on the tool asks at most itself of every joint: the axes are unit vectors.
        torque = min(tasks.arm(words["arm"]).rated) if words["arm"] else math.inf
    return ArmQuestion(
        stiffness=words["stiffness"],
        damping=words["damping"],
        torque=torque,
        period=1.0 / words["rate"],
        delay=words["delay"],
        spin=words["spin"],
        jump=words["jump"],
    )
