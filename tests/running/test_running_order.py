"""The order in which units run: contender by contender, each compiled while the last one runs."""

from bench.experiments import plan as planning
from bench.experiments.choice import Choice
from bench.law.contenders.registry import find_contender
from bench.running.run import in_running_order


def test_first_unit_of_each_contender_runs_before_the_rest_of_the_one_before_it():
    laws = [find_contender(word) for word in ("rotation-matrix", "linearized-euler/zyx-euler")]
    beside = Choice(experiments=("free-body", "contact", "robustness"))
    off_arms, on_arm = (planning.make("quick", laws, one, count=4) for one in (beside, Choice(arms=("ur5e",))))
    units = (*off_arms.units, *on_arm.of("arm"))
    each = {name: [unit for unit in units if unit.contender == name] for name in [unit.contender for unit in units]}
    assert len(each) > 4
    assert all(len(own) > 1 for own in each.values())
    (first, *rest), *others = each.values()
    expected = [first]
    for head, *tail in others:
        expected += [head, *rest]
        rest = tail
    assert in_running_order(units) == [*expected, *rest]
    compiling_none = on_arm.of("costs", "jacobians")
    assert in_running_order((*compiling_none, *units)) == [*expected, *rest, *compiling_none]
