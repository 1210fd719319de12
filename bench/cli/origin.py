"""Describe where a run comes from, in one line."""

from pathlib import Path

from bench.base.errors import BadResults
from bench.base.files import read_json
from bench.base.provenance import count_episodes
from bench.cli.screen import counted, shown_path

NEEDED = ("suite", "episodes", "commit", "dirty", "cpu", "wall_s")


def origin(folder: Path) -> str:
    """Suite, size, commit, processor and time of a run.

    Errors:
        BadResults: provenance.json lacks one of them.
    """
    path = folder / "provenance.json"
    found = read_json(path)
    lacking = [name for name in NEEDED if name not in found]
    if lacking:
        raise BadResults(f"{path}: it lacks {', '.join(lacking)}; delete the folder and run again")
    episodes = count_episodes(found)
    changed = " with changes" if found["dirty"] else ""
    return (
        f"{shown_path(folder)}: suite {found['suite']}, {counted(episodes, 'episode')}, commit "
        f"{found['commit'][:10] or 'none'}{changed}, {found['cpu']}, {found['wall_s']} s"
    )
