"""Starts on arms that are kept with the sources: of every arm, those that a search finds, for these files alone."""

import pytest

import tasks
from bench.base.sources import reader
from tasks import found_starts

ARM, SET = "ur5e", "pole"
ARMS = sorted(path.stem for path in found_starts.FOLDER.glob("*.json"))


def kept_sets(arm):
    """Return the sets that the file of an arm has."""
    return [tasks.find_start_set(name, arm=True) for name in found_starts.read_sets(arm)]


KEPT = [(arm, chosen) for arm in ARMS for chosen in kept_sets(arm)]
CHOSEN = tasks.find_start_set(SET, arm=True)


def list_imports(module):
    """Return the modules of tasks that a module imports, and those that these import; no package."""
    files, waiting, found = reader(), [module], set()
    while waiting:
        name = waiting.pop()
        if files.find_file(name) is None:
            name = name.rpartition(".")[0]
        path = files.find_file(name) if name else None
        if path is not None and name not in found and path.name != "__init__.py":
            found.add(name)
            waiting += files.read(path).imports
    return found


def test_every_file_that_a_search_imports_decides():
    known = {f"tasks.{name}" for name in found_starts.DECIDING}
    used = set()
    for chosen in kept_sets(ARM):
        module = chosen.build.__module__
        assert list_imports(module) <= known | {module}, module
        used |= list_imports(module)
    assert known <= used


@pytest.mark.parametrize(("arm", "chosen"), KEPT)
def test_kept_set_was_found_by_these_files(arm, chosen):
    if found_starts.read(tasks.arm(arm), chosen, chosen.size, found_starts.SEED) is None:
        pytest.fail(f"{chosen.name} of {arm} was found by other files: run python -m tasks.found_starts and commit it")


@pytest.mark.weekly
@pytest.mark.parametrize("arm", ARMS)
def test_written_file_is_the_kept_one(arm, tmp_path):
    path = found_starts.write(tasks.arm(arm), kept_sets(arm), tmp_path)
    assert path.read_bytes() == (found_starts.FOLDER / path.name).read_bytes()


def test_written_set_is_read_as_it_was_found(tmp_path):
    arm, chosen = tasks.arm(ARM), CHOSEN._replace(size=2)
    assert found_starts.read(arm, chosen, 2, 0) is None
    found_starts.write(arm, [chosen], tmp_path)
    kept = found_starts.read(arm, chosen, 2, 0, tmp_path)
    assert list(map(repr, kept)) == list(map(repr, chosen.build(arm, 2, 0)[:2]))


@pytest.mark.parametrize(("count", "seed", "searches"), [(CHOSEN.size, 0, 0), (CHOSEN.size, 5, 1), (99, 0, 1)])
def test_set_of_the_usual_size_and_seed_is_not_searched_for(count, seed, searches):
    seeds = []

    def build(arm, count, seed):
        seeds.append(seed)
        return []

    build.__module__ = CHOSEN.build.__module__
    starts = tasks._starts_on.__wrapped__(tasks.arm(ARM), CHOSEN._replace(build=build), count, seed)
    assert len(seeds) == searches
    assert bool(starts) == (searches == 0)


def test_another_arm_set_file_or_version_is_another_digest():
    arm = tasks.arm(ARM)
    other_home = arm._replace(home=(*arm.home[:-1], 0.1))
    digests = [
        found_starts.digest_of(arm, CHOSEN),
        found_starts.digest_of(other_home, CHOSEN),
        found_starts.digest_of(arm, tasks.find_start_set("wrist", arm=True)),
        found_starts.digest_of(arm, CHOSEN._replace(size=2)),
        found_starts.digest_of(arm, CHOSEN, modules=found_starts.DECIDING[1:]),
        found_starts.digest_of(arm, CHOSEN, packages=("mujoco",)),
    ]
    assert len(set(digests)) == len(digests)
