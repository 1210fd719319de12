"""Write the offline archive: the built site, the published results, the committed source, and wheels.

make edition                        everything, into dist/orientation-bench-VERSION
make edition ARGS="data source"     parts of it
"""

import argparse
import hashlib
import shutil
import subprocess
import sys
import sysconfig
import time
from pathlib import Path

from bench.experiments.tables import data_package
from bench.experiments.tables.schema import RESULTS
from bench.export.wheel import build_wheel
from report.figures.method.provenance import cited

ROOT = Path(__file__).resolve().parents[1]
SITE = ROOT / "report" / "_build" / "html"
REFERENCE = RESULTS / "reference"
LOCKS = ("install", "report")  # the installer, and what make bench and make report need
SUMS = "SHA256SUMS"
README = """\
orientation-bench {version}

site/index.html   the book; every page reads without a network
data/             the results, with datapackage.json that says what each column means
source.tar.gz     the source
wheels/           what it runs on: {platform}, Python {python}; and orientation-audit, for any project
SHA256SUMS        checksums of all this: sha256sum --check SHA256SUMS

To rebuild without a network, with Python {python} and make:

    tar xzf source.tar.gz && cd orientation-bench
    make bench WHEELS=../wheels
    make report WHEELS=../wheels
"""


class CannotMake(Exception):
    """A part of the archive cannot be made; the message says why and what to do."""


def write_site(folder: Path) -> str:
    """Copy the built book (make report)."""
    if not (SITE / "index.html").is_file():
        raise CannotMake("the report is not built (cure: make report)")
    copy_tree(SITE, folder / "site")
    return f"{sum(1 for _ in (folder / 'site').rglob('*.html'))} pages"


def write_data(folder: Path) -> str:
    """Copy the published results and describe them as a Data Package (datapackage.org)."""
    target = folder / "data"
    copy_tree(REFERENCE, target)
    shutil.copyfile(RESULTS / "README.md", target / "README.md")
    (target / data_package.NAME).write_text(data_package.written(target), encoding="utf-8")
    return f"{sum(1 for _ in target.glob('*.parquet'))} tables"


def write_source(folder: Path) -> str:
    """Archive the committed source, without its history."""
    status = subprocess.run(["git", "status", "--porcelain"], cwd=ROOT, capture_output=True, text=True, check=False)
    if status.returncode:
        raise CannotMake("this is no git checkout, so nothing is committed (cure: make the edition in a clone)")
    if status.stdout:
        raise CannotMake(f"these differ from what is committed:\n{status.stdout}(cure: commit them, or git stash)")
    archive_tree("HEAD", folder / "source.tar.gz")
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True)
    return f"commit {head.stdout.strip()[:10]}"


def write_wheels(folder: Path) -> str:
    """Download all that make bench and make report install, as wheels for this system and Python, and build ours."""
    target = folder / "wheels"
    target.mkdir(exist_ok=True)
    locks = [word for name in LOCKS for word in ("-r", str(ROOT / "requirements" / f"{name}.txt"))]
    command = [sys.executable, "-P", "-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--no-input"]
    command += ["--require-hashes", "--no-deps", "--only-binary", ":all:", "--dest", str(target), *locks]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise CannotMake(f"pip could not fetch the wheels (cure: a network, or pip's cache):\n{done.stderr.strip()}")
    build_wheel(target)
    return f"{sum(1 for _ in target.glob('*.whl'))} wheels"


PARTS = {"site": write_site, "source": write_source, "data": write_data, "wheels": write_wheels}
"""Name of a part -> the function that writes it into the archive's folder."""


def copy_tree(source: Path, target: Path) -> None:
    """Copy a folder in place of what the target held."""
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(source, target)


def archive_tree(tree: str, file: Path) -> None:
    """Write a tree of git as a tar file with one top folder."""
    command = ["git", "archive", "--prefix=orientation-bench/", f"--output={file}", tree]
    subprocess.run(command, cwd=ROOT, check=True)


def write_front(folder: Path, version: str) -> None:
    """Write README.txt, the licence and how to cite."""
    for name in ("LICENSE", "CITATION.cff"):
        shutil.copyfile(ROOT / name, folder / name)
    python = "{}.{}".format(*sys.version_info)
    text = README.format(version=version, platform=sysconfig.get_platform(), python=python)
    (folder / "README.txt").write_text(text, encoding="utf-8")


def write_sums(folder: Path) -> None:
    """Write the SHA-256 of every file, one line each and sorted by path, in the form that sha256sum reads."""
    paths = sorted(path for path in folder.rglob("*") if path.is_file() and path.name != SUMS)
    with (folder / SUMS).open("w", encoding="utf-8") as file:
        for path in paths:
            file.write(f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.relative_to(folder).as_posix()}\n")


def main(arguments: list[str] | None = None) -> int:
    """Write the named parts, then the checksums of every file there."""
    parser = argparse.ArgumentParser(prog="make edition", description="Write the offline archive.")
    parser.add_argument("part", nargs="*", help=f"one of {', '.join(PARTS)}; without one, all")
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="parent of the archive's folder")
    options = parser.parse_args(arguments)
    unknown = sorted(set(options.part) - set(PARTS))
    if unknown:
        parser.error(f"no such part: {', '.join(unknown)}; known: {', '.join(PARTS)}")
    version = cited()["version"]
    folder = options.out / f"orientation-bench-{version}"
    folder.mkdir(parents=True, exist_ok=True)
    try:
        write_front(folder, version)
        for name in options.part or PARTS:
            began = time.monotonic()
            print(f"{name:8} {PARTS[name](folder)}, {time.monotonic() - began:.0f} s", flush=True)
        write_sums(folder)
    except CannotMake as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    print(f"wrote {folder} ({size / 1e6:,.0f} MB). Check it anywhere: cd there; sha256sum --check {SUMS}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
