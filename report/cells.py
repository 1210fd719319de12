"""Run the cells of all pages, on as many kernels as there are cores: Sphinx alone runs one page after another.

    python report/cells.py       as build.py calls it, in its environment

A kernel runs many pages, each in a namespace of its own: what they import and read is there from the first one on.
Outputs go where Sphinx looks for them, into the execution cache. A page whose cells fail has none there: Sphinx runs
it again, in a kernel of its own, and says what is wrong.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
from pathlib import Path
from typing import Any

import yaml
from jupyter_cache import get_cache
from jupyter_cache.base import CacheBundleIn
from jupyter_client.manager import AsyncKernelManager
from myst_nb.core.read import is_myst_markdown_notebook, read_myst_markdown_notebook
from myst_parser.config.main import MdParserConfig
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError
from nbformat.v4 import new_code_cell, new_notebook

REPORT = Path(__file__).resolve().parent
CONFIG = yaml.safe_load((REPORT / "_config.yml").read_text(encoding="utf-8"))
MOST = 4
"""Greatest number of kernels: each takes some 500 MB."""
JUDGING = ("index", "40-claims")
"""Pages that judge all claims: one kernel runs them, for one judging serves both."""
FORGET = new_notebook(cells=[new_code_cell("get_ipython().reset()")])


def read_notebooks(report: Path) -> dict[Path, Any]:
    """Read every page that has cells, as Sphinx does."""
    config = MdParserConfig(enable_extensions=set(CONFIG["parse"]["myst_enable_extensions"]))
    texts = {
        path: path.read_text(encoding="utf-8") for path in (report / "index.md", *sorted(report.glob("pages/*.md")))
    }
    notebooks = {path: text for path, text in texts.items() if is_myst_markdown_notebook(text)}
    return {path: read_myst_markdown_notebook(text, config) for path, text in notebooks.items()}


def is_known(cache: Any, notebook: Any) -> bool:
    """Tell whether the cache holds what these cells show."""
    with contextlib.suppress(KeyError):
        return bool(cache.match_cache_notebook(notebook))
    return False


async def work(todo: list[list[Path]], pages: dict[Path, Any], cache: Any) -> None:
    """Execute batches of pages on one kernel until none is left, and keep the outputs of those that do not fail."""
    kernel = AsyncKernelManager(kernel_name="python3")
    try:
        while todo:
            for path in todo.pop(0):
                with contextlib.suppress(CellExecutionError):
                    await execute(pages[path], path.parent, kernel)
                    cache.cache_notebook_bundle(
                        CacheBundleIn(pages[path], str(path)), check_validity=False, overwrite=True
                    )
                await execute(FORGET, path.parent, kernel)
    finally:
        if kernel.has_kernel:
            await kernel.shutdown_kernel(now=True)


async def execute(notebook: Any, folder: Path, kernel: AsyncKernelManager) -> None:
    """Run a notebook's cells on the kernel, which the first one starts."""
    options = {"timeout": CONFIG["execute"]["timeout"], "record_timing": False}
    client = NotebookClient(notebook, km=kernel, resources={"metadata": {"path": str(folder)}}, **options)
    try:
        await client.async_execute()
    finally:
        if client.kc is not None:
            client.kc.stop_channels()


async def main(report: Path = REPORT) -> None:
    """Run what is not in the cache."""
    cache = get_cache(report / CONFIG["execute"]["cache"])
    pages = {path: notebook for path, notebook in read_notebooks(report).items() if not is_known(cache, notebook)}
    judging = [path for path in pages if path.stem in JUDGING]
    todo = [batch for batch in (judging, *([path] for path in pages if path not in judging)) if batch]
    kernels = range(min(MOST, os.cpu_count() or 1, len(todo)))
    await asyncio.gather(*(work(todo, pages, cache) for _ in kernels), return_exceptions=True)


if __name__ == "__main__":
    asyncio.run(main())
