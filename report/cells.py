"""Run the cells of all pages, on as many kernels as there are cores: Sphinx alone runs one page after another.

    python report/cells.py       as build.py calls it, in its environment

A kernel runs many pages, each in a namespace of its own: what they import and read is there from the first one on.
Outputs go where Sphinx looks for them, into the execution cache. A page whose cells fail has none there: Sphinx runs
it again, in a kernel of its own, and says what is wrong.
"""

import asyncio
import contextlib
import os
import re
import time
from pathlib import Path

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

PAGE = re.compile(r"kit\.page\(([^)]*)\)")

FORGET = "get_ipython().reset()"
"""Empties the namespace, and counts cells from 1 again."""


def notebooks(report: Path = REPORT) -> dict:
    """Every page that has cells, as Sphinx reads it; those that judge all claims first."""
    config = MdParserConfig(enable_extensions=set(CONFIG["parse"]["myst_enable_extensions"]))
    texts = {path: path.read_text(encoding="utf-8") for path in (report / "index.md", *report.glob("pages/*.md"))}
    return {
        path: read_myst_markdown_notebook(texts[path], config)
        for path in sorted(texts, key=lambda path: (not judges(texts[path]), path))
        if is_myst_markdown_notebook(texts[path])
    }


def is_known(cache, notebook) -> bool:
    """Whether the cache holds what these cells show."""
    try:
        cache.match_cache_notebook(notebook)
    except KeyError:
        return False
    return True


def judges(text: str) -> bool:
    """Whether a module of a page judges all claims, which takes a while and is kept in its kernel."""
    named = PAGE.search(text)
    modules = re.findall(r'"([\w.]+)"', named[1]) if named else []
    files = (REPORT / "figures" / f"{name.replace('.', '/')}.py" for name in modules)
    return any("judge_all" in path.read_text(encoding="utf-8") for path in files if path.is_file())


def batches(pages: list[Path]) -> list[list[Path]]:
    """Pages that one kernel runs in turn: those that judge all claims together, for one judging serves them all."""
    judging = [path for path in pages if judges(path.read_text(encoding="utf-8"))]
    return [batch for batch in (judging, *([path] for path in pages if path not in judging)) if batch]


async def work(todo: list[list[Path]], pages: dict, cache) -> None:
    """Execute batches of pages on one kernel until none is left, and keep the outputs of those that do not fail."""
    kernel = AsyncKernelManager(kernel_name="python3")
    try:
        while todo:
            for path in todo.pop(0):
                began = time.monotonic()
                with contextlib.suppress(CellExecutionError):
                    await execute(pages[path], path.parent, kernel)
                    data = {"execution_seconds": time.monotonic() - began}
                    bundle = CacheBundleIn(pages[path], str(path), data=data)
                    cache.cache_notebook_bundle(bundle, check_validity=False, overwrite=True)
                await execute(new_notebook(cells=[new_code_cell(FORGET)]), path.parent, kernel)
    finally:
        if kernel.has_kernel:
            await kernel.shutdown_kernel(now=True)


async def execute(notebook, folder: Path, kernel: AsyncKernelManager) -> None:
    """Run a notebook's cells on the kernel, which the first one starts."""
    resources = {"metadata": {"path": str(folder)}}
    options = {"timeout": CONFIG["execute"]["timeout"], "record_timing": False, "resources": resources}
    client = NotebookClient(notebook, km=kernel, **options)
    try:
        await client.async_execute()
    finally:
        if client.kc is not None:
            client.kc.stop_channels()


async def main(report: Path = REPORT) -> None:
    """Run what is not in the cache."""
    cache = get_cache(report / CONFIG["execute"]["cache"])
    pages = {path: notebook for path, notebook in notebooks(report).items() if not is_known(cache, notebook)}
    todo = batches(list(pages))
    kernels = min(MOST, os.cpu_count() or 1, len(todo))
    await asyncio.gather(*(work(todo, pages, cache) for _ in range(kernels)), return_exceptions=True)


if __name__ == "__main__":
    asyncio.run(main())
