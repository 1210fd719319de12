"""Where the numbers come from: provenance, the tables with their digests, their columns, and links to take them."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

import pandas as pd
import pyarrow.parquet as pq

from bench.provenance import ROOT, rounded_on
from bench.tables import read
from bench.tables.schema import TABLES
from bench.tables.store import read_json
from report.figures.cost import times
from report.figures.kit import html

OFFERED_BYTES = 8_000_000
"""A larger file is named, not offered: the site stays small enough to be mailed or put on a stick."""
CITATION = ROOT / "CITATION.cff"
SETTINGS = ROOT / "results" / "settings" / "settings.json"
SITE_DATA = "../data"
"""Seen from a page in pages/; report/build.py copies there what pages link to."""


def digest(path: Path) -> str:
    """SHA-256 of a file, in hex."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def spelled(hex_digits: str) -> str:
    """A digest that may break into lines at every quarter, and is copied whole."""
    quarter = len(hex_digits) // 4
    parts = [hex_digits[at : at + quarter] for at in range(0, len(hex_digits), quarter)]
    return f'<code class="digest">{"<wbr>".join(parts)}</code>'


def files() -> list[Path]:
    """The files of the run, tables first, then every machine's timings."""
    folder = read.folder()
    tables = [folder / f"{name}.parquet" for name in sorted(TABLES)]
    plain = [folder / name for name in ("provenance.json", "plan.json")]
    return [*(path for path in (*tables, *plain) if path.is_file()), *times.files()]


def run() -> html.Markdown:
    """provenance.json in words, one fact a line."""
    given = read.provenance()
    said = {name: escaped(value) for name, value in given.items()}
    changed = "yes: the sources had changes that no commit holds" if said["dirty"] else "no"
    facts = {
        "Suite": f"{code(given['suite'])}, {html.number(said['episodes'])} episodes",
        "Command": code(given["command"]),
        "Seed": f"{said['seed']}",
        "Finished": said["finished"].replace("T", " ").replace("Z", " UTC"),
        "Wall time": f"{said['wall_s']:.0f} s with {said['workers']} workers",
        "Resumed after a stop": "yes" if said["resumed"] else "no",
        "Commit": code(given["commit"]) if said["commit"] else "none: not a checkout",
        "Uncommitted changes": changed,
        "Digest of the sources": code(given["sources"]),
        "Digest of the plan": code(given["plan"]),
        "Processor": f"{html.foreign(rounded_on(given))}, {said['cores']} cores",
        "System": said["platform"],
        **{html.foreign(name): version for name, version in sorted(said["versions"].items())},
        "Lock requirements/base.txt, SHA-256": spelled(said["lock"]) if said["lock"] else "none",
    }
    return html.table(pd.DataFrame({"Fact": list(facts), "Value": list(facts.values())}))


def code(text: str) -> str:
    """A text as Markdown's code, in which nothing is markup: between more backticks than it holds in a row."""
    text = " ".join(str(text).split())
    fence = "`" * (1 + max(map(len, re.findall("`+", text)), default=0))
    return f"{fence} {text} {fence}" if "`" in text else f"`{text}`"


def escaped(value):
    """A value of provenance.json as a page may show it: the file may come from anywhere."""
    if isinstance(value, dict):
        return {name: escaped(one) for name, one in value.items()}
    return html.foreign(value) if isinstance(value, str) else value


def settings() -> html.Markdown:
    """The published run made again under settings that round as other processors do: what differs from it."""
    every = [one for made in read_json(SETTINGS).values() for one in made.values()]
    return html.table(pd.DataFrame(map(_against_published, every)))


def _against_published(found: dict) -> dict:
    unlike = [
        f"{name} {html.number(one['differ'])} of {html.number(one['rows'])}"
        for name, one in found["tables"].items()
        if one["differ"]
    ]
    return {
        "Made on": html.foreign(found["made_on"]),
        "Equal bit for bit": ", ".join(name for name, one in found["tables"].items() if not one["differ"]),
        "Rows that differ in some bit": ", ".join(unlike) or "none",
        "Other outcome": sum(one["outcomes"] for one in found["tables"].values()),
        "Differences for the gate": found["gate"],
    }


def tables() -> html.Markdown:
    """Every file: rows, size, digest, and a link to it."""
    rows = []
    for path in files():
        is_table = path.suffix == ".parquet"
        rows.append(
            {
                "File": link(path),
                "Rows": pq.read_metadata(path).num_rows if is_table else None,
                "Size": size(path.stat().st_size),
                "SHA-256": spelled(digest(path)),
            }
        )
    return html.table(pd.DataFrame(rows))


def link(path: Path) -> str:
    """The file as a link, or its bare name where it is too large to offer."""
    name = f"timings/{path.name}" if path.parent.name == "timings" else path.name
    if path.stat().st_size > OFFERED_BYTES:
        return f"`{name}` (too large for this site)"
    return f'<a href="{SITE_DATA}/{name}" download>{name}</a>'


def size(count: int) -> str:
    """Bytes as a reader takes them in."""
    return (
        f"{count / 1e6:.1f}\N{NO-BREAK SPACE}MB"
        if count >= 1e6
        else f"{max(1, round(count / 1e3))}\N{NO-BREAK SPACE}kB"
    )


def columns() -> html.Html:
    """Name, type, unit and meaning of every column, one folded table a file."""
    parts = []
    for path in files():
        if path.suffix != ".parquet":
            continue
        schema = pq.read_schema(path)
        rows = []
        for field in schema:
            metadata = field.metadata or {}
            kind = "word" if str(field.type).startswith("dictionary") else str(field.type)
            unit, meaning = (metadata.get(key, b"").decode() for key in (b"unit", b"meaning"))
            rows.append({"Column": field.name, "Type": kind, "Unit": unit, "Meaning": meaning})
        table = html.plain_table(pd.DataFrame(rows))
        parts.append(
            f'<details class="columns"><summary><code>{path.name}</code>, {len(rows)} columns</summary>'
            f'<div class="card-costs" tabindex="0">{table}</div></details>'
        )
    return html.Html("".join(parts))


def version() -> str:
    """The version that CITATION.cff gives, and its date."""
    said = dict(
        re.findall(r"^(version|date-released): *[\"']?([^\"'\n]+)", CITATION.read_text(encoding="utf-8"), re.MULTILINE)
    )
    return f"{said['version']} ({said['date-released']})" if "date-released" in said else said["version"]
