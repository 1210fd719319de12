"""A page as its reader sees it: Markdown with the values of the published run in their places."""

import functools
import importlib
import re
from pathlib import Path
from typing import NamedTuple

from report.figures.kit import html
from report.figures.kit.page import modules_of, word_of
from support.pages import paste_published

FENCE = re.compile(r"^(`{3,}|:{3,}|~{3,})(.*)$")
GLUED = re.compile(r"\{glue:(?:text|md)\}`([^`]+)`")
ROLE = re.compile(r"\{[\w:]+\}`([^`<]*?)(?:\s*<[^`]*>)?`")
LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")
CODE = re.compile(r"`[^`]*`")
FORMULA = re.compile(r"\$\$.*?\$\$|\$[^$]+\$", re.DOTALL)
TAG = re.compile(r"<[^>]+>")
IS_CODE = re.compile(r"\{(?:code-cell|literalinclude|index|eval-rst|bibliography)|(?!\{)\w*$")
IS_PASTED = re.compile(r"\{glue:?(?:md|figure|)\} *(\S+)")
CELL_OF_COUNTS = re.compile(r"(?:all|none|no|[\d\s,;of\u202f\u00a0–.%()])+")


class Text(NamedTuple):
    """A paragraph, caption, list item or cell, or the heads of a table, with the page it is on."""

    page: str
    kind: str
    words: str


class Heads(NamedTuple):
    """The heads of one table of a page."""

    page: str
    key: str
    heads: list[str]


@functools.cache
def paste(path: Path) -> dict[str, object]:
    """Return what a page pastes, by the keys that its Markdown has."""
    text = path.read_text(encoding="utf-8")
    values: dict[str, object] = {}
    for name in modules_of(text):
        word = word_of(importlib.import_module(f"report.figures.{name}"), text)
        values |= {f"{word}{key}": value for key, value in paste_published(name).items()}
    return values


def plain(text: str) -> str:
    """Return Markdown or HTML as words: formulas and code as one sign, links as their words."""
    text = FORMULA.sub("…", text)
    text = LINK.sub(r"\1", text)
    text = ROLE.sub(r"\1", text)
    text = CODE.sub("…", text)
    return " ".join(TAG.sub("", text).replace("*", "").split())


def fill(text: str, values: dict[str, object]) -> str:
    """Return Markdown with the values of its keys in it."""
    return GLUED.sub(lambda key: str(values[key[1]]), text)


def list_blocks(text: str) -> list[tuple[str, str]]:
    """Return the paragraphs of a page's Markdown with their kind (text, caption or pasted), without code."""
    body = re.sub(r"\A---\n.*?\n---\n", "", text, count=1, flags=re.DOTALL)
    blocks: list[tuple[str, str]] = []
    lines: list[str] = []
    open_fences: list[tuple[str, str]] = []

    def close(kind: str) -> None:
        if lines:
            blocks.append((kind, " ".join(lines)))
            lines.clear()

    for line in body.splitlines():
        fence = FENCE.match(line.strip())
        kind = open_fences[-1][1] if open_fences else "text"
        if fence and open_fences and not fence[2] and fence[1] == open_fences[-1][0]:
            close(kind)
            open_fences.pop()
        elif fence:
            close(kind)
            name = fence[2].strip()
            inner = "caption" if name.startswith(("{glue:figure}", "{figure}")) else "text"
            inner = "code" if IS_CODE.match(name) else inner
            open_fences.append((fence[1], inner))
            pasted = IS_PASTED.match(name)
            if pasted:
                blocks.append(("pasted", pasted[1]))
            if name.startswith("{table}"):
                blocks.append(("caption", name.removeprefix("{table}").strip()))
        elif kind == "code" or line.strip().startswith(":name:") or line.strip().startswith(":format:"):
            continue
        elif not line.strip() or re.match(r"\s*(?:[-*]|\d+\.) |#|\(|\|", line):
            close(kind)
            if line.strip():
                lines.append(line)
        else:
            lines.append(line)
    return blocks


def list_texts(path: Path) -> tuple[list[Text], list[Heads]]:
    """Return all that a page says, with the values in their places, and the heads of its tables."""
    source = path.read_text(encoding="utf-8")
    values = paste(path)
    texts, tables = [], []
    for kind, words in list_blocks(source):
        if kind == "code":
            continue
        if kind != "pasted":
            texts.append(Text(path.stem, kind, plain(fill(words, values))))
            continue
        value = values[words]
        if hasattr(value, "alt"):
            texts.append(Text(path.stem, "alternative text", value.alt))
            continue
        rows = [row for row in str(value).splitlines() if row.strip()]
        is_table = isinstance(value, html.Markdown) and rows and rows[0].startswith("|")
        if not is_table:
            texts += [Text(path.stem, "text", plain(row)) for row in rows]
            continue
        heads, _, *body = [[plain(cell) for cell in re.split(r"(?<!\\)\|", row)[1:-1]] for row in rows]
        tables.append(Heads(path.stem, words, heads))
        for cells in body:
            texts += [Text(path.stem, "cell", cell) for cell in cells if not CELL_OF_COUNTS.fullmatch(cell or "–")]
    return texts, tables
