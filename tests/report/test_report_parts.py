"""What pages are made of besides the figures of results: diagrams, coordinates, cards, prices, origins, spelling."""

import fnmatch
import re

import pandas as pd
import pytest

from bench.base.provenance import ROOT
from bench.experiments.tables.run import Run, shown_run
from bench.experiments.tables.schema import RESULTS
from bench.export.language import language_words
from bench.law.contenders.registry import FOLDERS, contenders
from report.figures.cards import regulators
from report.figures.cost import cost
from report.figures.kit import families, html, spelling
from report.figures.method import method

BIBLIOGRAPHY = (ROOT / "report" / "references.bib").read_text(encoding="utf-8")


pytestmark = pytest.mark.usefixtures("reference")


def test_every_law_has_a_page_with_its_source_and_its_files():
    every = [regulators.page(one, shown_run()) for one in regulators.every_law()]
    pages = {made.name: made for made in every}
    assert len(pages) == len(regulators.every_law())
    for one in regulators.every_law():
        made, file = pages[families.anchor(one.on_free_body)], f"{one.regulator.name.replace('-', '_')}.py"
        assert f"bench/law/contenders/regulators/{file}" in made.body
        assert len(made.files) == (0 if one.regulator.costing_only else len(language_words()))
        assert all(f'href="code/{name}"' in made.body for name in made.files)


def test_page_says_so_when_nothing_was_timed(tmp_path):
    untimed = Run(RESULTS / "reference", timings=tmp_path / "timings")
    assert "make time" in cost.facts(untimed)["timed_on"]


def test_engines_are_compared_where_both_have_rows():
    runs = shown_run().table("episodes")
    both, equal = method.count_equal(runs, "reference", "native")
    assert both == equal > 0
    late = method.compute_lateness_ms(runs, "native")
    assert -1.0 < late.min() <= late.max() < 10.0


@pytest.mark.parametrize(
    ("plain", "page"),
    [
        ("+-pi/2", "±π/2"),
        ("B^-1 theta^2/2", "B⁻¹ θ²/2"),
        ("10^-k rad", "10⁻ᵏ\u00a0rad"),
        ("2^-26.5 to 1e-06", "2^-26.5 to 10⁻⁶"),
        ("5.0e+06 and 0e+00", "5.0·10⁶ and 0"),
        ("1 - cos(alpha_0) <= -Kp", "1 − cos(α_0) ≤ −Kp"),
        ("12,296 poses", "12\u202f296 poses"),
        ("0.5% in 3 ms, n = 12", "0.5\u00a0% in 3\u00a0ms, n\u00a0=\u00a012"),
        ("the arm's 'zero' of x'' = x'", "the arm’s ‘zero’ of x'' = x'"),
        ("alphabet", "alphabet"),
        ("half-turn", "half-turn"),
    ],
)
def test_spelling_takes_words_and_signs_only(plain, page):
    assert spelling.typeset(plain) == page


def test_spelling_in_html_sets_indices_and_fractions_and_escapes_the_rest():
    assert spelling.marked_up("J_E < R_d^T, peak_u") == "J<sub>E</sub> &lt; R<sub>d</sub>ᵀ, peak_u"
    assert spelling.marked_up("eps^(2/3)") == "eps<sup>2/3</sup>"


@pytest.mark.parametrize(("value", "text"), [(2.3e-7, "2·10⁻⁷"), (1e6, "10⁶"), (0.034, "0.03"), (0.0, "0")])
def test_powers_are_spelled_as_powers(value, text):
    assert spelling.power(value) == text


def test_card_says_of_a_law_without_rows_whether_it_is_costed_only():
    known, none = contenders("regulators"), pd.DataFrame({"start_set": [], "outcome": []})
    assert regulators.measured(none, known["hybrid"]) == "The law is not in this run."
    assert regulators.measured(none, known["feedback-linearized-literal"]).startswith("We only counted the operations")


def test_every_page_is_in_one_part_of_the_contents():
    globs = re.findall(r"glob: (\S+)", (ROOT / "report" / "_toc.yml").read_text())
    for page in (ROOT / "report" / "pages").glob("*.md"):
        assert sum(fnmatch.fnmatchcase(f"pages/{page.stem}", one) for one in globs) == 1, page


def test_every_work_that_a_law_cites_is_in_the_bibliography():
    works = re.findall(r"author\s*=\s*\{([^,]+?)[, ].*?year\s*=\s*\{(\d+)\}", BIBLIOGRAPHY, re.DOTALL)
    for folder in sorted(set(FOLDERS) - {"shipped"}):
        for name, one in contenders(folder).items():
            cited = re.sub(r"arXiv:[\d.]+|this benchmark, 2026", "", one.source)
            for year in re.findall(r"\b(?:1[89]|20)\d\d\b", cited):
                assert [author for author, of in works if of == year and author.strip("{}") in cited], (name, year)
            assert all(f"{{{number}}}" in BIBLIOGRAPHY for number in re.findall(r"arXiv:[\d.]+", one.source)), name


def test_numbers_in_cells_have_a_thin_space_from_ten_thousand_and_no_comma():
    assert html.cell("39 of the 1,726 starts, none of the 40,000") == "39 of the 1726 starts, none of the 40\u202f000"
