"""What an edition copies: the built site, the committed source, and the files that stand in front."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

from report.edition import CannotMake

ROOT = Path(__file__).resolve().parents[2]
SITE = ROOT / "report" / "_build" / "html"
IN_FRONT = ("LICENSE", "CITATION.cff")
README = """\
orientation-bench {version}

site/index.html   the book; every page reads without a network
*.pdf             its chapters in print
data/             the results, with datapackage.json that says what each column means
paper.md          a paper about the software, with paper.bib
source.tar.gz     the source
wheels/           what it runs on: {tag}
SHA256SUMS        checksums of all this: sha256sum --check SHA256SUMS

To rebuild without a network, with Python {python} and make:

    tar xzf source.tar.gz && cd orientation-bench
    make bench WHEELS=../wheels
    make report WHEELS=../wheels
"""


def front(folder: Path) -> None:
    """README.txt, the licence and how to cite."""
    import sysconfig

    from report.figures.method.provenance import cited

    for name in IN_FRONT:
        shutil.copyfile(ROOT / name, folder / name)
    python = "{}.{}".format(*sys.version_info)
    tag = f"{sysconfig.get_platform()}, Python {python}"
    text = README.format(version=cited()["version"], tag=tag, python=python)
    (folder / "README.txt").write_text(text, encoding="utf-8")


def site(folder: Path) -> str:
    """The book as it is built (make report)."""
    if not (SITE / "index.html").is_file():
        raise CannotMake("the report is not built (cure: make report)")
    shutil.rmtree(folder / "site", ignore_errors=True)
    shutil.copytree(SITE, folder / "site")
    return f"{sum(1 for _ in (folder / 'site').rglob('*.html'))} pages"


def source(folder: Path) -> str:
    """The committed source, without its history."""
    asked = subprocess.run(["git", "status", "--porcelain"], cwd=ROOT, capture_output=True, text=True, check=False)
    if asked.returncode:
        raise CannotMake("this is no git checkout, so nothing is committed (cure: make the edition in a clone)")
    if asked.stdout:
        raise CannotMake(f"these differ from what is committed:\n{asked.stdout}(cure: commit them, or git stash)")
    archive("HEAD", folder / "source.tar.gz")
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True)
    return f"commit {head.stdout.strip()[:10]}"


def archive(tree: str, file: Path) -> None:
    """A tree of git as a tar in a folder of its own."""
    command = ["git", "archive", "--prefix=orientation-bench/", f"--output={file}", tree]
    subprocess.run(command, cwd=ROOT, check=True)
