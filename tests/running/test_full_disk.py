"""A disk that fills up at any moment of a run: one line, what was finished stays, and with room made it goes on."""

import subprocess
from pathlib import Path

import pytest
from support.command_line import digest

from bench.base import files
from bench.base.errors import BadResults
from bench.experiments import plan as planning
from bench.experiments.request import Request
from bench.law.contenders.registry import find_contender
from bench.running import run

KILOBYTES = 1024


@pytest.fixture(scope="module")
def plan():
    words = {"start_sets": ("paper",), "engines": ("reference",), "experiments": ("free-body",)}
    return planning.make(Request("quick", (find_contender("rotation-matrix"),), horizon_s=0.1, **words))


@pytest.fixture
def disk(tmp_path):
    """Mount a file system of KILOBYTES, gone afterwards: tmpfs, where mounting is allowed."""
    folder = tmp_path / "disk"
    folder.mkdir()
    words = ["mount", "-t", "tmpfs", "-o", f"size={KILOBYTES}k", "tmpfs", str(folder)]
    try:
        done = subprocess.run(words, capture_output=True, text=True)
    except FileNotFoundError:
        pytest.skip("there is no mount to make a small disk with")
    if done.returncode:
        pytest.skip(f"no small disk can be mounted here ({done.stderr.strip()})")
    try:
        yield folder
    finally:
        # a write that failed may still hold its file
        subprocess.run(["umount", "--lazy", str(folder)], check=True)


def fill(disk: Path, left: int) -> Path:
    """Fill the disk but for so many kilobytes; return the file to remove to make room."""
    filler = disk / "filler"
    filler.write_bytes(bytes((KILOBYTES - left) * 1024))
    return filler


@pytest.fixture
def undisturbed(plan, tmp_path):
    run.run(plan, tmp_path / "undisturbed", workers=1)
    return digest(tmp_path / "undisturbed")


@pytest.mark.parametrize("left", [0, 16, 40, 64], ids=lambda left: f"{left} kB left")
def test_run_on_a_full_disk_goes_on_when_there_is_room(plan, disk, undisturbed, left):
    filler, out = fill(disk, left), disk / "run"
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
    filler = fill(disk, 64)
    with pytest.raises(BadResults):
        run.run(plan, out, workers=1)
    leftover = out / "parts" / ".a.parquet.b.tmp"
    assert files.is_leftover(leftover)
    filler.unlink()
    leftover.write_bytes(bytes((KILOBYTES - 128) * 1024))
    assert run.run(plan, out, workers=1)
    assert not leftover.exists()
