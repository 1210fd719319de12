"""Every page and its module: named alike, and what the one pastes the other gives; what a run does not hold is said."""

import importlib
import shutil
from types import ModuleType

import pytest
from support.pages import RUN, assert_is_whole, paste_published
from support.rendered import list_texts
from support.wording import find_faults, find_head_faults

from bench.experiments.tables.run import VARIABLE, choose_rows, run_in
from report.figures.kit.laws import FEEDBACK
from report.figures.kit.page import (
    ABSENT,
    REPORT,
    as_pasted,
    contents,
    kinds_of,
    modules_of,
    pasted,
    text_of,
)
from report.figures.responses import responses

PAGES = {
    name: path
    for path in (REPORT / "index.md", *sorted(REPORT.glob("pages/*.md")))
    for name in modules_of(path.read_text(encoding="utf-8"))
}
QUICK = sorted(set(PAGES) - {"index", "claims.claims", "claims.evidence"})
"""Without those that judge all claims, which are tested by themselves."""

READ = [path for path in sorted(set(PAGES.values())) if path.stem != "appendix-claims"]
"""Pages whose words are read; the appendix of claims quotes what was measured, and when, as it was recorded."""


@pytest.mark.parametrize("name", PAGES)
def test_module_is_pasted_by_one_page_which_names_no_other_s_keys(name):
    text = text_of(name)
    assert text == PAGES[name].read_text(encoding="utf-8")
    words = {key.partition(".")[0] for key in pasted(text) if "." in key}
    assert words == {other.rpartition(".")[2] for other in modules_of(text)[1:]}


@pytest.mark.parametrize("name", QUICK)
def test_module_gives_and_draws_what_its_page_pastes_of_the_published_run(name, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(RUN.folder))
    assert_is_whole(paste_published(name))


@pytest.mark.parametrize("path", READ, ids=lambda path: path.stem)
def test_page_says_its_counts_in_words_and_with_their_nouns(path, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(RUN.folder))
    texts, tables = list_texts(path)
    assert texts
    assert not [(text.kind, fault, text.words) for text in texts for fault in find_faults(text.words)]
    assert not [(table.key, head) for table in tables for head in find_head_faults(table.heads)]


@pytest.mark.parametrize("name", QUICK)
def test_module_says_that_it_is_not_in_a_run_without_tables(name, tmp_path, monkeypatch):
    monkeypatch.setenv("ORIENTATION_BENCH_RESULTS", str(tmp_path))
    shutil.copy("results/reference/provenance.json", tmp_path)
    module, text = importlib.import_module(f"report.figures.{name}"), text_of(name)
    assert set(contents(module, run_in(tmp_path), text)) == set(kinds_of(module, text))


def test_keys_of_a_page_are_told_apart_by_how_they_are_pasted():
    text = "{glue:text}`n` {glue:md}`why`\n```{glue:md} rows\n```\n```{glue:figure} curve\n```\n```{glue} tiles\n```\n"
    kinds = {"n": "fact", "why": "sentence", "rows": "table", "curve": "figure", "tiles": "piece"}
    assert pasted(text) == kinds


def test_further_module_of_a_page_has_the_keys_under_its_word():
    text = 'kit.page("book.own", "book.other")\n{glue:text}`n` {glue:text}`other.n` {glue:md}`other.why`\n'
    own, other = (ModuleType(f"report.figures.book.{name}") for name in ("own", "other"))
    assert kinds_of(own, text) == {"n": "fact"}
    assert kinds_of(other, text) == {"n": "fact", "why": "sentence"}


@pytest.mark.parametrize("kind", ["fact", "sentence", "table", "figure", "piece"])
def test_page_says_of_each_kind_that_it_is_not_in_this_run(kind):
    shown = as_pasted(None, kind, "a-key")
    assert ABSENT in getattr(shown, "alt", shown)


def test_page_takes_what_it_pastes_and_nothing_else():
    class Module:
        @staticmethod
        def facts(_):
            return {"n": 12296}

    with pytest.raises(ValueError, match=r"gives \['n'\], which its page does not paste"):
        contents(Module, None, "")
    assert contents(Module, None, "{glue:text}`n` of {glue:text}`missing`") == {"n": "12\u202f296", "missing": ABSENT}


def test_response_bends_are_nothing_under_feedback_linearization():
    traces, _ = responses.drawn(RUN)
    own = choose_rows(traces, {"start_id": "figure-2.5", "contender": FEEDBACK})
    assert responses.bend_deg(own, 100.0, 20.0).max() < 1e-6
