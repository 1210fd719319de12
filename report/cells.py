"""Run the cells of all pages, as many pages at once as there are cores: Sphinx alone runs one page after another.

    python report/cells.py       as build.py calls it, in its environment

Outputs go where Sphinx looks for them, into the execution cache. A page whose cells fail has none there: Sphinx runs
it again and says what is wrong.
"""

import asyncio
import os
import time
from pathlib import Path

import yaml
from jupyter_cache import get_cache
from jupyter_cache.base import CacheBundleIn
from myst_nb.core.read import is_myst_markdown_notebook, read_myst_markdown_notebook
from myst_parser.config.main import MdParserConfig
from nbclient import NotebookClient

REPORT = Path(__file__).resolve().parent
CONFIG = yaml.safe_load((REPORT / "_config.yml").read_text(encoding="utf-8"))
MOST = 4
"""Pages run at once at the most: each takes some 300 MB."""


def notebooks() -> dict:
    """Every page that has cells, as Sphinx reads it; those that judge all claims first, as they take longest."""
    config = MdParserConfig(enable_extensions=set(CONFIG["parse"]["myst_enable_extensions"]))
    texts = {path: path.read_text(encoding="utf-8") for path in (REPORT / "index.md", *REPORT.glob("pages/*.md"))}
    return {
        path: read_myst_markdown_notebook(texts[path], config)
        for path in sorted(texts, key=lambda path: ("judge_all" not in texts[path], path))
        if is_myst_markdown_notebook(texts[path])
    }


def is_known(cache, notebook) -> bool:
    """Whether the cache holds what these cells show."""
    try:
        cache.match_cache_notebook(notebook)
    except KeyError:
        return False
    return True


async def run(path: Path, notebook, cache, turn: asyncio.Semaphore) -> None:
    """Execute one page's cells beside it, and keep their outputs."""
    resources = {"metadata": {"path": str(path.parent)}}
    async with turn:
        began = time.monotonic()
        await NotebookClient(
            notebook, timeout=CONFIG["execute"]["timeout"], record_timing=False, resources=resources
        ).async_execute()
    seconds = {"execution_seconds": time.monotonic() - began}
    cache.cache_notebook_bundle(CacheBundleIn(notebook, str(path), data=seconds), check_validity=False, overwrite=True)


async def main() -> None:
    """Run what is not in the cache."""
    cache = get_cache(CONFIG["execute"]["cache"])
    turn = asyncio.Semaphore(min(MOST, os.cpu_count() or 1))
    todo = {path: notebook for path, notebook in notebooks().items() if not is_known(cache, notebook)}
    await asyncio.gather(*(run(*page, cache, turn) for page in todo.items()), return_exceptions=True)


if __name__ == "__main__":
    asyncio.run(main())
