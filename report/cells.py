"""Run the cells of all pages in parallel: Sphinx alone runs one page after another.

    python report/cells.py       as build.py calls it, in its environment

Outputs go where Sphinx looks for them, into the execution cache. A page whose cells fail has none there: Sphinx runs
it again and says what is wrong.
"""

import logging
from pathlib import Path

import yaml
from jupyter_cache import get_cache
from jupyter_cache.executors import load_executor
from myst_nb.core.read import is_myst_markdown_notebook

REPORT = Path(__file__).resolve().parent
CONFIG = yaml.safe_load((REPORT / "_config.yml").read_text(encoding="utf-8"))
READER = {"name": "myst_nb_md", "type": "plugin"}


def main(report: Path = REPORT) -> None:
    """Run what is not in the cache."""
    cache = get_cache(report / CONFIG["execute"]["cache"])
    for path in (report / "index.md", *sorted(report.glob("pages/*.md"))):
        if is_myst_markdown_notebook(path.read_text(encoding="utf-8")):
            cache.add_nb_to_project(str(path), read_data=READER)
    quiet = logging.getLogger("cells")
    quiet.setLevel(logging.ERROR)
    load_executor("local-parallel", cache, quiet).run_and_cache(timeout=CONFIG["execute"]["timeout"])


if __name__ == "__main__":
    main()
