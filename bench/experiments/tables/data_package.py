"""A results folder as a Data Package: datapackage.json, made from the schema of its tables.

Source: Data Package 2.0 and Table Schema 2.0 (datapackage.org). `unit` is a property of our own, which they allow.
"""

import hashlib
import json
from pathlib import Path

from bench.base.errors import BadResults
from bench.base.provenance import describe_project
from bench.experiments.columns import COUNT, NUMBER, SINGLE, WORD, Column, Table
from bench.experiments.tables.schema import all_tables

NAME = "datapackage.json"
TITLE = "Orientation control: simulated episodes, costs and contacts of many laws"
PROFILE = "https://datapackage.org/profiles/2.0/"
TYPES = {WORD: "string", NUMBER: "number", SINGLE: "number", COUNT: "integer"}
"""Types of columns -> those of Table Schema."""

MOST_WORDS = 100
"""A column of more different words, such as names of starts, has names rather than a list of words to choose from."""


def described_folder(folder: Path) -> dict:
    """Return the descriptor of a folder's tables, by name; BadResults if the schema knows none of them."""
    paths = [path for path in sorted(folder.glob("*.parquet")) if path.stem in all_tables()]
    if not paths:
        raise BadResults(f"{folder}: no tables there; give a results folder, such as results/reference")
    return {
        "$schema": PROFILE + "datapackage.json",
        "name": "orientation-bench",
        "title": TITLE,
        "version": describe_project()["version"],
        "licenses": [{"name": "Apache-2.0"}],
        "resources": [described_table(path, all_tables()[path.stem]) for path in paths],
    }


def described_table(path: Path, table: Table) -> dict:
    """Return one resource: the file, its SHA-256, and its fields and key as the schema has them.

    An empty word is a word, as of a law that acts in no coordinates; so no text stands for a missing value.
    """
    about = " ".join(table.about.split())
    return {
        "name": table.name,
        "title": table.name.replace("-", " ").capitalize(),
        "description": about.partition(": ")[2],
        "path": path.name,
        "type": "table",
        "format": "parquet",
        "mediatype": "application/vnd.apache.parquet",
        # No size in bytes: frictionless counts none of a parquet file, and would call every size wrong.
        "hash": f"sha256:{hashlib.sha256(path.read_bytes()).hexdigest()}",
        "schema": {
            "$schema": PROFILE + "tableschema.json",
            "fields": describe_fields(path, table),
            "primaryKey": list(table.key),
            "missingValues": [],
        },
    }


def describe_fields(path: Path, table: Table) -> list[dict]:
    """Return the fields of Table Schema, in the order of the columns."""
    words = list_words(path)
    return [describe_field(column, words.get(column.name, [])) for column in table.columns()]


def describe_field(column: Column, words: list[str]) -> dict:
    """Return a field: name, type, meaning, unit if there is one; words: all of its column, or none if too many."""
    field: dict = {"name": column.name, "type": TYPES[column.type], "description": column.meaning}
    if column.unit:
        field["unit"] = column.unit
    if words:
        field["constraints"] = {"enum": words}
    return field


def list_words(path: Path) -> dict[str, list[str]]:
    """Return the words of each column of a file that has few different ones, sorted."""
    import pyarrow as pa  # names of tables need it not
    import pyarrow.parquet as pq

    file = pq.ParquetFile(path)
    names = [field.name for field in file.schema_arrow if pa.types.is_dictionary(field.type)]
    found = {}
    for name, column in zip(names, file.read(columns=names).columns, strict=True):
        words = column.cast(pa.string()).unique().drop_null()
        if len(words) <= MOST_WORDS:
            found[name] = sorted(words.to_pylist())
    return found


def written(folder: Path) -> str:
    """Return the descriptor as the text of datapackage.json."""
    return json.dumps(described_folder(folder), indent=1, ensure_ascii=False) + "\n"
