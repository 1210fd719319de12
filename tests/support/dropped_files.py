"""Files that tests drop into a copy of the tree: one of each kind that grows by a file, path -> text."""

from pathlib import Path


def renamed(room: str, of: str, kind: str) -> str:
    """The file of a contender that is another one by another name."""
    name = f'name="dropped-{kind}", title="Dropped {kind}"'
    constant = room.removesuffix("s").upper()
    head = f'"""By another name."""\n\nfrom bench.law.contenders.{room} import {of}\n\n'
    return f"{head}{constant} = {of}.{constant}._replace({name})\n"


HERE = Path(__file__).with_name("dropped")
DROPPED = {
    "bench/law/contenders/representations/dropped_coordinates.py": renamed(
        "representations", "zyx_euler", "coordinates"
    ),
    "bench/law/contenders/jacobians/dropped_jacobian.py": renamed("jacobians", "geometric", "jacobian"),
    "bench/law/contenders/inverses/dropped_inverse.py": renamed("inverses", "solve", "inverse"),
    "bench/law/contenders/impedances/dropped_impedance.py": renamed("impedances", "geometric", "impedance"),
    "bench/law/contenders/shipped/dropped_shipped.py": renamed("shipped", "deoxys", "shipped"),
    "bench/law/contenders/springs/dropped_spring.py": renamed("springs", "vector_part", "spring"),
    "bench/law/contenders/compensators/dropped_compensator.py": renamed("compensators", "integral", "compensator"),
    "bench/law/contenders/baselines/dropped_baseline.py": renamed("baselines", "resolved_rate", "baseline"),
    **{str(path.relative_to(HERE)).removesuffix(".text"): path.read_text() for path in sorted(HERE.rglob("*.text"))},
}
EXPERIMENT, PLANTED = "bench/experiments/dropped_experiment.py", "tasks/conditions/planted_bias.py"
DROPPED_EXPERIMENT, PLANTED_AXIS, ASKED_OF_AXIS = (
    Path(__file__).with_name("planted_texts").joinpath(f"{name}.text").read_text()
    for name in ("dropped_experiment", "planted_axis", "asked_of_axis")
)
