"""Make an edition of what is built and committed.

make edition                        everything, into dist/orientation-bench-VERSION
make edition ARGS="data paper"      parts of it
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from report.edition import CannotMake, bundle, data, paper, printed, sums, wheels
from report.figures.method.provenance import cited

ROOT = Path(__file__).resolve().parents[2]
PARTS = {
    "site": bundle.site,
    "source": bundle.source,
    "print": printed.book,
    "data": data.package,
    "paper": paper.written,
    "wheels": wheels.archive,
}
"""Name of a part -> what writes it into the edition's folder; each says in its first line what it is."""


def main(arguments: list[str] | None = None) -> int:
    """Write the parts that are asked for, then the checksums of all that lies there."""
    parser = argparse.ArgumentParser(
        prog="make edition",
        description="Make an edition of the built book and the committed source.",
        epilog="parts:\n"
        + "\n".join(f"  {name:8} {(make.__doc__ or '').splitlines()[0]}" for name, make in PARTS.items()),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("part", nargs="*", help=f"of {', '.join(PARTS)}; all where none is named")
    parser.add_argument(
        "--out", type=Path, default=ROOT / "dist", help="where the edition's folder goes (default: dist)"
    )
    given = parser.parse_args(arguments)
    unknown = sorted(set(given.part) - set(PARTS))
    if unknown:
        parser.error(f"no such part: {', '.join(unknown)}; known: {', '.join(PARTS)}")
    folder = given.out / f"orientation-bench-{cited()['version']}"
    folder.mkdir(parents=True, exist_ok=True)
    try:
        bundle.front(folder)
        for name in given.part or PARTS:
            began = time.monotonic()
            print(f"{name:8} {PARTS[name](folder)}, {time.monotonic() - began:.0f} s", flush=True)
        sums.write(folder)
    except CannotMake as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    print(f"wrote {folder} ({size / 1e6:,.0f} MB). Check it anywhere: cd there; sha256sum --check {sums.NAME}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
