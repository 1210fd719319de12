"""A results folder as a Data Package: datapackage.json, made from the schema of its tables.

Source: Data Package 2.0 and Table Schema 2.0 (datapackage.org). `unit` is a property of our own, which they allow.
"""

import hashlib
import json
from pathlib import Path

from bench.base.errors import BadResults
from bench.experiments.columns import COUNT, NUMBER, SINGLE, WORD, Table
from bench.experiments.tables.schema import all_tables

NAME = "datapackage.json"
PROFILE = "https://datapackage.org/profiles/2.0/"
TYPES = {WORD: "string", NUMBER: "number", SINGLE: "number", COUNT: "integer"}
"""Types of columns -> those of Table Schema."""


def described_folder(folder: Path) -> dict:
    """Return the descriptor of a folder's tables, by name; BadResults if the schema knows none of them."""
    paths = [path for path in sorted(folder.glob("*.parquet")) if path.stem in all_tables()]
    if not paths:
        raise BadResults(f"{folder}: no tables there; give a results folder, such as results/reference")
    return {
        "$schema": PROFILE + "datapackage.json",
        "name": "orientation-bench",
        "licenses": [{"name": "Apache-2.0"}],
        "resources": [described_table(path, all_tables()[path.stem]) for path in paths],
    }


def described_table(path: Path, table: Table) -> dict:
    """One resource: the file, its size in bytes and SHA-256, and its fields as the schema has them."""
    content = path.read_bytes()
    return {
        "name": table.name,
        "path": path.name,
        "type": "table",
        "format": "parquet",
        "mediatype": "application/vnd.apache.parquet",
        "bytes": len(content),
        "hash": f"sha256:{hashlib.sha256(content).hexdigest()}",
        "schema": {"$schema": PROFILE + "tableschema.json", "fields": fields(table)},
    }


def fields(table: Table) -> list[dict]:
    """Return the fields of Table Schema: name, type, meaning, and the unit where a column has one."""
    return [
        {"name": one.name, "type": TYPES[one.type], "description": one.meaning}
        | ({"unit": one.unit} if one.unit else {})
        for one in table.columns()
    ]


def written(folder: Path) -> str:
    """Return the descriptor as the text of datapackage.json."""
    return json.dumps(described_folder(folder), indent=1, ensure_ascii=False) + "\n"
