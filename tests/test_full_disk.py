"""A disk that fills up at any moment of a run: one line, what was finished stays, and with room made it goes on."""

import subprocess

import pytest
from command_line import digest

from bench import finish, run, store
from bench import plan as planning
from bench.choice import Choice
from bench.discovery import find_contender
from bench.errors import BadResults

KILOBYTES = 1024
"""Size of the disk."""


@pytest.fixture(scope="module")
def plan():
    choice = Choice(start_sets=("paper",), engines=("reference",))
    return planning.make("quick", [find_contender("rotation-matrix")], choice, horizon_s=0.1)


@pytest.fixture
def disk(tmp_path):
    """A file system of its own, of KILOBYTES."""
    folder = tmp_path / "disk"
    folder.mkdir()
    words = ["mount", "-t", "tmpfs", "-o", f"size={KILOBYTES}k", "tmpfs", str(folder)]
    try:
        mounted = subprocess.run(words, capture_output=True, text=True)
    except FileNotFoundError:
        pytest.skip("there is no mount to make a small disk with")
    if mounted.returncode:
        pytest.skip(f"no small disk can be mounted here ({mounted.stderr.strip()})")
    yield folder
    subprocess.run(["umount", "--lazy", str(folder)], check=True)  # a write that failed may still hold its file


@pytest.fixture
def few_costs(plan, monkeypatch):
    """Count the plan's law alone, to be fast."""
    monkeypatch.setattr(finish, "all_contenders", lambda: plan.laws)


@pytest.fixture
def undisturbed(plan, tmp_path, few_costs):
    run.run(plan, tmp_path / "undisturbed", workers=1)
    return digest(tmp_path / "undisturbed")


@pytest.mark.parametrize("left", [0, 16, 40, 64], ids=lambda left: f"{left} kB left")
def test_run_on_a_full_disk_goes_on_when_there_is_room(plan, disk, undisturbed, left):
    filler, out = disk / "filler", disk / "run"
    filler.write_bytes(bytes((KILOBYTES - left) * 1024))
    with pytest.raises(BadResults, match=r"cannot be written \(No space left on device\); make room and give the same"):
        run.run(plan, out, workers=1)
    kept = digest(out) if out.exists() else {}
    assert not [name for name in kept if name.endswith(".tmp")]
    filler.unlink()
    assert run.run(plan, out, workers=1)
    mended = digest(out)
    assert mended == undisturbed | {"provenance.json": mended["provenance.json"]}  # which tells the time
    assert {name for name in kept if not name.startswith("parts")} <= set(mended)


def test_temporary_files_of_killed_writes_make_room_first(plan, disk, undisturbed):
    out = disk / "run"
    (disk / "filler").write_bytes(bytes((KILOBYTES - 64) * 1024))
    with pytest.raises(BadResults):
        run.run(plan, out, workers=1)
    leftover = out / "parts" / ".a.parquet.b.tmp"
    assert store.is_leftover(leftover)
    (disk / "filler").unlink()
    leftover.write_bytes(bytes((KILOBYTES - 128) * 1024))
    assert run.run(plan, out, workers=1)
    assert not leftover.exists()
