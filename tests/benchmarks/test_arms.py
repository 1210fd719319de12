"""Every controller of the default suite in the compiled loop of each arm, and the usual ones alone."""

from benchmarks.arm_loops import TASK, arm_loop, list_controllers, list_usual, turn_by_20_degrees
from benchmarks.conftest import CHOICE
from benchmarks.controller_alone import controller_alone


def find_laws(config):
    """Return the laws that run in a loop."""
    laws = config.stash[CHOICE].laws
    return [law for law in laws if not law.regulator.costing_only]


def pytest_generate_tests(metafunc):
    """Make a benchmark of each arm and controller."""
    config = metafunc.config
    is_alone = metafunc.function is test_controller
    list_them = list_usual if is_alone else list_controllers
    prefix, engine = ("controller", "") if is_alone else ("engine", " native")
    names = []
    for arm in config.stash[CHOICE].arms:
        controllers = list_them(find_laws(config), arm)
        names += [f"{prefix} {arm}{engine} {controller.name}" for controller in controllers]
    metafunc.parametrize("name", names)


def find_controller(config, arm, name):
    """Return the controller of a name."""
    controllers = list_controllers(find_laws(config), arm)
    return next(controller for controller in controllers if controller.name == name)


def test_arm(name, pytestconfig, time_ticks):
    _, arm, _, controller = name.split(" ")
    time_ticks(arm_loop(arm, find_controller(pytestconfig, arm, controller)))


def test_controller(name, pytestconfig, time_ticks):
    _, arm, controller = name.split(" ")
    found = find_controller(pytestconfig, arm, controller)
    time_ticks(controller_alone(TASK, arm, found, turn_by_20_degrees(arm)))
