"""The published results with their machine-readable description."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

from bench.tables import data_package
from bench.tables.schema import RESULTS

REFERENCE = RESULTS / "reference"


def package(folder: Path) -> str:
    """The published results, a Data Package (datapackage.org)."""
    target = folder / "data"
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(REFERENCE, target)
    shutil.copyfile(RESULTS / "README.md", target / "README.md")
    descriptor = data_package.described_folder(target)
    (target / data_package.NAME).write_text(json.dumps(descriptor, indent=1) + "\n", encoding="utf-8")
    return f"{len(descriptor['resources'])} tables"
