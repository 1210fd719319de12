"""Build the wheel `orientation-audit`: the audit with its command and pytest plugin, and every law as a Python module.

    python -m bench.export.wheel [FOLDER]      (make wheels)

Its sources are those of `bench/audit` under another name, and what the export writes; none of them is kept.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from string import Template

from bench.base.provenance import ROOT
from bench.export.heading import PROJECT
from bench.export.language import find_language
from bench.export.subject import find_subject, subject_words

PACKAGE = "orientation_audit"
SHARED = ("errors", "isolated", "processes", "serving", "signs")
"""Modules of `bench.base` that the audit uses."""
NAMES = {"bench.audit": PACKAGE, "bench/audit": PACKAGE}
NAMES |= {f"bench.base.{module}": f"{PACKAGE}.{module}" for module in SHARED}
"""What the sources are called here -> in the wheel."""
EPOCH = "315532800"
"""Date of the files in a wheel, 1980-01-01. With it, and with modes as below, the same sources make the same bytes."""


def write_sources(folder: Path) -> None:
    """Write the project that the wheel is built from into a folder."""
    package = folder / PACKAGE
    shutil.copytree(ROOT / "bench" / "audit", package, ignore=shutil.ignore_patterns("__pycache__"))
    for module in SHARED:
        shutil.copy(ROOT / "bench" / "base" / f"{module}.py", package)
    for path in package.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        for ours, theirs in NAMES.items():
            text = text.replace(ours, theirs)
        path.write_text(text, encoding="utf-8")
    (package / "py.typed").touch()
    values = {"version": PROJECT["version"], "author": PROJECT["authors"][0]["name"], "laws": write_laws(package)}
    for ours, theirs in (("wheel.toml", "pyproject.toml"), ("wheel.md", "README.md")):
        text = Path(__file__).with_name(ours).read_text(encoding="utf-8")
        (folder / theirs).write_text(Template(text).substitute(values), encoding="utf-8")
    shutil.copy(ROOT / "LICENSE", folder)
    for path in (folder / "LICENSE", package / "py.typed"):  # setuptools keeps their modes
        path.chmod(0o644)


def write_laws(package: Path) -> str:
    """Write `laws`, one module a subject of the export, and return the rows of a table of them."""
    laws = package / "laws"
    laws.mkdir()
    rows = []
    for subject in map(find_subject, subject_words()):
        name, text = next(iter(find_language("python").law(subject).items()))
        (laws / name).write_text(text, encoding="utf-8")
        coordinates = f" in {subject.representation.title}" if subject.representation else ""
        rows.append(f"| `{subject.identifier}` | {subject.record.title}{coordinates} |")
    heading = f'"""Laws, one module each, on the standard library alone: from {PACKAGE}.laws import late_braking."""'
    (laws / "__init__.py").write_text(f"{heading}\n", encoding="utf-8")
    return "\n".join(rows)


def build_wheel(folder: Path) -> None:
    """Build the wheel into a folder, without a network."""
    with tempfile.TemporaryDirectory() as sources:
        write_sources(Path(sources))
        command = [sys.executable, "-P", "-m", "pip", "--disable-pip-version-check", "wheel", "--quiet", "--no-index"]
        command += ["--no-deps", "--no-build-isolation", "--wheel-dir", str(folder.resolve()), sources]
        subprocess.run(command, env=os.environ | {"SOURCE_DATE_EPOCH": EPOCH}, umask=0o022, check=True)


if __name__ == "__main__":
    build_wheel(Path(*sys.argv[1:] or ["dist"]))
