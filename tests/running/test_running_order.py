"""The order in which units run: contender by contender, each compiled while the last one runs."""

from bench.contenders.registry import find_contender
from bench.experiments import plan as planning
from bench.experiments.choice import Choice
from bench.running.run import in_running_order


def test_first_unit_of_each_contender_runs_before_the_rest_of_the_one_before_it():
    laws = [find_contender(word) for word in ("rotation-matrix", "linearized-euler/zyx-euler")]
    plan = planning.make("quick", laws, Choice(arms=("ur5e",)), count=4)
    units = plan.of("free-body", "arm", "contact", "robustness")
    each = {name: [unit for unit in units if unit.contender == name] for name in [unit.contender for unit in units]}
    assert len(each) > 4
    assert all(len(own) > 1 for own in each.values())
    (first, *rest), *others = each.values()
    expected = [first]
    for head, *tail in others:
        expected += [head, *rest]
        rest = tail
    assert in_running_order(units) == [*expected, *rest]
    compiling_none = plan.of("costs", "jacobians")
    assert in_running_order((*compiling_none, *units)) == [*expected, *rest, *compiling_none]
