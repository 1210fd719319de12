"""The default suite's controllers in the compiled loop of each arm, and the usual ones alone."""

from benchmarks.arm_loops import (
    TASK,
    arm_loop,
    list_controllers,
    list_usual,
    turn_by_20_degrees,
)
from benchmarks.conftest import CHOICE
from benchmarks.controller_alone import controller_alone


def list_laws(config):
    """Return the laws that run in a loop."""
    laws = config.stash[CHOICE].laws
    return [law for law in laws if not law.regulator.costing_only]


def find_controller(config, arm, name):
    """Return the controller of a name."""
    for controller in list_controllers(list_laws(config), arm):
        if controller.name == name:
            return controller
    raise LookupError(name)


def name_loops(config, arm):
    """Return the names of an arm's benchmarks in its compiled loop."""
    controllers = list_controllers(list_laws(config), arm)
    return [f"engine {arm} native {controller.name}" for controller in controllers]


def name_controllers(config, arm):
    """Return the names of an arm's benchmarks of a controller alone."""
    controllers = list_usual(list_laws(config), arm)
    return [f"controller {arm} {controller.name}" for controller in controllers]


def pytest_generate_tests(metafunc):
    """Make a benchmark of each arm and controller."""
    config = metafunc.config
    name_them = name_controllers if metafunc.function is test_controller else name_loops
    names = []
    for arm in config.stash[CHOICE].arms:
        names += name_them(config, arm)
    metafunc.parametrize("name", names)


def test_arm(name, pytestconfig, time_ticks):
    _, arm, _, word = name.split(" ")
    controller = find_controller(pytestconfig, arm, word)
    time_ticks(arm_loop(arm, controller))


def test_controller(name, pytestconfig, time_ticks):
    _, arm, word = name.split(" ")
    controller = find_controller(pytestconfig, arm, word)
    start = turn_by_20_degrees(arm)
    time_ticks(controller_alone(TASK, arm, controller, start))
