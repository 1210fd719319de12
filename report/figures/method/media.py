"""The rendered files of report/_static/media: what they show, in numbers, and the loops as parts of pages.

report/media.py made them and wrote media.json beside them; the joint motion is an episode of our own engine.
"""

from __future__ import annotations

import html as escape
import json
from pathlib import Path

from bench.provenance import ROOT
from bench.tables import read
from report.figures.arms import arm_poses
from report.figures.kit import html
from report.figures.kit.spelling import power

FOLDER = ROOT / "report" / "_static" / "media"
SOURCE = "../_static/media"
TYPES = {"webm": "video/webm", "mp4": "video/mp4"}


def facts(folder: Path = FOLDER) -> dict:
    """media.json."""
    return json.loads((folder / "media.json").read_text(encoding="utf-8"))


def said() -> dict[str, str]:
    """Numbers for the page: how far off, how much torque, how long a way, for both controllers."""
    about = facts()
    euler, geometric = about["episodes"]
    return {
        "film_arm": arm_poses.title(about["arm"]),
        "film_ratio": f"{euler['peak_torque_ratio']:.0f}",
        "film_ratio_geometric": f"{geometric['peak_torque_ratio']:.2f}",
        "film_path": f"{euler['path_ratio']:.1f}",
        "film_off": f"{100 * euler['position_error_m']:.0f}",
        "film_off_geometric": f"{1000 * geometric['position_error_m']:.1f}",
        "film_miss": miss(about["start"]),
        **family(about),
    }


def miss(start: str) -> str:
    """How near the pole a start's turn leads: pole-minus-1-k3 misses it by 10^-3 rad."""
    how = start.rpartition("-")[2]
    return "through the pole itself" if how == "exact" else f"past the pole at {power(10.0 ** -int(how[1:]))} rad"


def family(about: dict) -> dict[str, str]:
    """How many of the arm's starts at the same pole and pose the first controller loses in this run, of how many."""
    rows = read.episodes(arm=about["arm"], start_set=about["start_set"], variation="nominal", engine="native")
    rows = rows[rows["contender"] == about["episodes"][0]["contender"]]
    alike = rows[rows["start_id"].astype(str).str.startswith(about["start"].rpartition("-")[0])]
    failed = int((alike["outcome"] != "settled").sum())
    return {"film_alike": str(len(alike)), "film_lost": str(failed)}


def loop(alt: str, name: str = "pole-loop") -> html.Html:
    """A loop with its poster; a reader starts it. Where no video plays, the poster stands for it."""
    words = escape.escape(alt, quote=True)
    sources = "".join(f'<source src="{SOURCE}/{name}.{kind}" type="{mime}">' for kind, mime in TYPES.items())
    poster = f"{SOURCE}/{name}.png"
    return html.Html(
        f'<video controls loop muted playsinline preload="none" poster="{poster}" width="720" height="412" '
        f'aria-label="{words}">{sources}<img src="{poster}" alt="{words}"></video>'
    )
