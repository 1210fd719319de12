"""Files that tests drop into a copy of the tree: one of each kind that grows by a file, path -> text."""


def renamed(room: str, of: str, kind: str) -> str:
    """The file of a contender that is another one by another name."""
    name = f'name="dropped-{kind}", title="Dropped {kind}"'
    constant = room.removesuffix("s").upper()
    head = f'"""By another name."""\n\nfrom bench.law.contenders.{room} import {of}\n\n'
    return f"{head}{constant} = {of}.{constant}._replace({name})\n"


DROPPED = {
    "bench/law/contenders/representations/dropped_coordinates.py": renamed(
        "representations", "zyx_euler", "coordinates"
    ),
    "bench/law/contenders/jacobians/dropped_jacobian.py": renamed("jacobians", "geometric", "jacobian"),
    "bench/law/contenders/inverses/dropped_inverse.py": renamed("inverses", "solve", "inverse"),
    "bench/law/contenders/impedances/dropped_impedance.py": renamed("impedances", "geometric", "impedance"),
    "bench/law/contenders/shipped/dropped_shipped.py": renamed("shipped", "crisp", "shipped"),
    "bench/law/contenders/springs/dropped_spring.py": renamed("springs", "vector_part", "spring"),
    "bench/law/contenders/compensators/dropped_compensator.py": renamed("compensators", "integral", "compensator"),
    "bench/law/contenders/baselines/dropped_baseline.py": renamed("baselines", "resolved_rate", "baseline"),
    "bench/law/contenders/regulators/dropped_regulator.py": '''
"""Damping, and a spring on the first coordinate."""

from bench.law import ANGLE, Display, Law, Look, kernel


def law_in(representation):
    """The law in the coordinates of one representation."""
    chart = representation.chart

    @kernel
    def law(R, omega, goal, gains):
        """u = -Kv omega - Kp alpha e_z."""
        E = chart(R).E
        return (-gains.kv * omega[0], -gains.kv * omega[1], -gains.kp * E[0] - gains.kv * omega[2])

    return law


REGULATOR = Law(
    name="dropped-regulator",
    title="Dropped regulator",
    source="none",
    formula="u",
    law_in=law_in,
    coordinates=("dropped-coordinates",),
    property="none",
    display=Display("dropped law", Look("green", "x", "dotted"), "Dropped family", ANGLE),
)
''',
    "bench/engines/metrics/motion/dropped_metric.py": '''
"""Ticks with a command: all of them."""

from bench.law import kernel
from bench.engines.metrics.metric import Metric


@kernel
def update(value, sample):
    """One more."""
    return value + 1.0


def finish(value, ending):
    """As it is."""
    return value


METRIC = Metric("dropped_column", "1", "ticks with a command", 0.0, update, finish)
''',
    "bench/engines/metrics/contact/dropped_touch.py": '''
"""Ticks recorded: all of them."""

from bench.engines.metrics.contact_metric import ContactMetric


def measure(pose):
    """Of all trials of the pose."""
    return float(sum(len(one.time) for one in pose.responses))


METRIC = ContactMetric("dropped_touch", "1", "ticks recorded", measure)
''',
    "tasks/domains/dropped_probe.py": '''
"""Known moments by another name, at two frames of the hand."""

from tasks.domains import wrench_probe


def trials(arm, dense=False):
    """Of the first two poses."""
    return wrench_probe.trials(arm)[:12]


TASK = wrench_probe.TASK._replace(name="dropped-probe", title="Dropped probe", horizon_s=0.05, trials=trials)
''',
    "tasks/arms/dropped_arm.py": '''
"""The UR5e by another title."""

from tasks.arm import arm


def xml() -> str:
    """Its MJCF text, otherwise as it is."""
    return arm("ur5e").xml.replace("Universal Robots UR5e", "Dropped arm")
''',
    "tasks/arm_starts/dropped_turns.py": '''
"""A small turn of the tool about the base z axis, from the arm's home."""

import math

from tasks.base import ArmStartSet, Start
from tasks.kinematics import Kinematics
from tasks.rotations import multiply


def build(arm, count, seed):
    """0.2 rad."""
    _, quat = Kinematics(arm).pose(arm.home)
    goal = multiply((math.cos(0.1), 0.0, 0.0, math.sin(0.1)), quat)
    return [Start("turn", quat, goal_wxyz=goal, q=arm.home, qdot=(0.0,) * arm.joints)]


STARTS = ArmStartSet("dropped-turns", "A small turn", 1, build)
''',
    "tasks/domains/dropped_arm_task.py": '''
"""Holding and turning by another name, from one start set."""

from tasks.domains import arm_regulation


def on(arm):
    """The task on one arm."""
    return arm_regulation.on(arm)._replace(name="dropped-arm-task", start_sets=("dropped-turns",))


TASK = arm_regulation.TASK._replace(
    name="dropped-arm-task", title="Dropped arm task", on=on, start_sets=("dropped-turns",)
)
''',
    "tasks/domains/dropped_task.py": '''
"""The free body by another name."""

from tasks.domains import free_body

TASK = free_body.TASK._replace(name="dropped-task", title="Dropped task", start_sets=("dropped-starts",))
''',
    "tasks/starts/dropped_starts.py": '''
"""Two starts about z."""

from tasks.base import Start, StartSet


def build(count, seed):
    """0.2 rad and a right angle, to rounding."""
    small, right = (0.9950041652780258, 0.0, 0.0, 0.09983341664682815), (0.5**0.5, 0.0, 0.0, 0.5**0.5)
    return [Start("small", small), Start("right", right)]


STARTS = StartSet("dropped-starts", "Two starts about z", 2, build)
''',
    "tasks/conditions/dropped_axis.py": '''
"""A bound on the command."""

from tasks.axis import Axis

AXIS = Axis("dropped-axis", "A dropped axis", "rad/s^2", (60.0, 70.0), None, sets=lambda level: {"bound": level})
''',
    "bench/findings/claims/dropped_claim.py": '''
"""A claim about nothing."""

from bench.findings.claims.tables import evidence
from bench.findings.claims.verdict import Word, claim


@claim("C99")
def c99(results):
    """One row."""
    return Word.HOLDS, evidence("1 row.", 1, ("experiment",))
''',
    "bench/findings/claims/dropped_claim.toml": """
[C99]
section = "9"
sentence = "A dropped claim."
criterion = "It holds."
""",
    "report/pages/90-dropped-page.md": """---
jupytext: {text_representation: {extension: .md, format_name: myst}}
kernelspec: {name: python3, display_name: Python 3}
---
# The dropped page

```{code-cell} python
from bench.experiments.tables import read
print("rows with the dropped column:", read.episodes(task="dropped-task")["dropped_column"].count())
```

```{code-cell} python
from bench.findings.theory.isotropic import EQUATIONS
from report.figures.kit import families, style
from report.figures.kit.inline import picture

@picture
def drawn():
    figure, axes = style.panels()
    [family] = families.present(read.episodes()["contender"].unique())
    for name, word in family.laws.items():
        look = style.look(name)
        axes.plot([0, 1], color=look.colour, marker=look.marker, linestyle=look.line, label=word)
    return figure, f"{family.title}: {word}, {look.colour} {look.marker}, f = {EQUATIONS[name].formula}"

drawn()
```
""",
}
