"""The report's own tools: which results it takes, what makes it build again, what its page check refuses."""

import build
import check_site
import offline
import pytest
import typesetting
from docutils import nodes


def finished(folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / build.WRITTEN_LAST).write_text("{}")
    return folder


@pytest.fixture(autouse=True)
def unset(monkeypatch):
    monkeypatch.delenv(build.RESULTS_VARIABLE, raising=False)


@pytest.mark.parametrize(("done", "expected"), [(("latest", "reference"), "latest"), (("reference",), "reference")])
def test_report_takes_the_latest_finished_results(tmp_path, done, expected):
    (tmp_path / "results" / "latest").mkdir(parents=True)
    folders = {name: tmp_path / "results" / name for name in ("latest", "reference")}
    for name in done:
        finished(folders[name])
    assert build.results_folder(tmp_path) == folders[expected]


def test_report_takes_the_folder_the_environment_names(tmp_path, monkeypatch):
    monkeypatch.setenv(build.RESULTS_VARIABLE, str(finished(tmp_path / "elsewhere")))
    assert build.results_folder(tmp_path) == tmp_path / "elsewhere"


@pytest.mark.parametrize(("named", "cure"), [("", "cure: make bench"), ("here", r"holds no provenance\.json")])
def test_report_says_the_cure_when_there_are_no_results(tmp_path, monkeypatch, named, cure):
    monkeypatch.setenv(build.RESULTS_VARIABLE, str(tmp_path) if named else "")
    with pytest.raises(build.CannotBuild, match=cure):
        build.results_folder(tmp_path)


def test_report_refuses_results_that_lead_outside(tmp_path):
    reference = finished(tmp_path / "results" / "reference")
    (tmp_path / "secret").write_text("secret")
    (reference / "laws").mkdir()
    (reference / "laws" / "secret.py").symlink_to(tmp_path / "secret")
    with pytest.raises(build.CannotBuild, match=r"secret\.py is a link"):
        build.results_folder(tmp_path)


def test_data_of_a_page_come_from_the_results_and_stay_in_the_site(tmp_path):
    results, site = finished(tmp_path / "a" / "results"), tmp_path / "b" / "site"
    (tmp_path / "a" / "secret").write_text("secret")
    (results / "table").write_text("ours")
    site.mkdir(parents=True)
    (site / "index.html").write_text('<a href="data/table"></a><a href="data/../secret"></a><a href="data//x"></a>')
    build.offer_data(results, site)
    assert sorted(path.name for path in (tmp_path / "b").rglob("*") if path.is_file()) == ["index.html", "table"]


BEHIND_CELLS = (
    *("bench/law.py", "tasks/base.py", "report/figures/kit/style.py", "requirements/report.txt"),
    *("results/timings/a.parquet", "results/libraries/restated.json", "results/reference/episodes.parquet"),
)


@pytest.fixture
def tree(tmp_path):
    for name in (*BEHIND_CELLS, "report/index.md", f"results/reference/{build.WRITTEN_LAST}"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(name)
    return tmp_path


def keys(tree):
    return build.keys(tree / "results" / "reference", tree)


@pytest.mark.parametrize("name", [*BEHIND_CELLS, "report/index.md"])
def test_pages_build_again_when_a_file_changes_and_cells_run_when_it_is_no_text_of_theirs(tree, name):
    before = keys(tree)
    (tree / name).write_text("changed")
    after = keys(tree)
    assert after["site"] != before["site"]
    assert (after["cells"] != before["cells"]) == (name in BEHIND_CELLS)


def test_cells_run_again_when_a_law_of_the_results_is_trusted(tree):
    law = tree / "results" / "reference" / "laws" / "own.py"
    law.parent.mkdir()
    law.write_text("REGULATOR = 1")
    before = keys(tree)
    build.trust.remember(b"REGULATOR = 2")
    assert keys(tree) == before
    build.trust.remember(law.read_bytes())
    assert keys(tree)["cells"] != before["cells"]


def test_failed_build_shows_the_cell_that_raised():
    raised = f"X: {build.CELL_RAISED}:\nfigure()\nKeyError: 'n'"
    log = f"noise\nTraceback\n  File\n{raised}\n\x1b[31mThe end\nTraceback\nnoise"
    assert build.complaints(log)[1:3] == ["figure()", "KeyError: 'n'"]
    assert "noise" not in build.complaints(log)


GOOD = '<html><article><h1>Title</h1><p id="here"><a href="#here">on</a></p></article></html>'


@pytest.mark.parametrize(
    ("markup", "problem"),
    [
        (
            '<script src="https://example.org/a.js"></script>',
            "loads https://example.org/a.js from the network",
        ),
        ('<link rel="stylesheet" href="//example.org/a.css">', "loads //example.org/a.css from the network"),
        ('<p style="background: url(https://example.org/a.png)">', "loads https://example.org/a.png"),
        ('<a href="gone.html">x</a>', "dead link gone.html"),
        ('<a href="#gone">x</a>', "no anchor #gone"),
        ('<img src="data:," alt="">', "image data:, has no alternative text"),
        ('<img src="data:," alt="_images/a.svg">', "image data:, has no alternative text"),
        ('<svg role="img"></svg>', "svg  has no aria-label"),
        ("<figure><p>a table</p></figure>", "figure without a described picture"),
        ('<p id="here">', "id here appears twice"),
        ("<h1>Second</h1>", "2 main headings instead of one"),
        ("<p>```{table} A `b`.</p>", "shows ```{table}, a directive taken for text (a backtick in its caption?)"),
    ],
)
def test_page_check_refuses(tmp_path, markup, problem):
    (tmp_path / "index.html").write_text(GOOD.replace("</article>", f"{markup}</article>"))
    assert check_site.find_problems(tmp_path) == [f"index.html: {problem}"]


def test_page_check_says_the_cure_when_nothing_is_built_accepts_a_good_page_and_keeps_the_size_budget(tmp_path):
    assert "cure: make report" in check_site.find_problems(tmp_path)[0]
    (tmp_path / "index.html").write_text(GOOD)
    assert check_site.find_problems(tmp_path) == []
    assert "above its budget" in check_site.find_problems(tmp_path, budget_bytes=10)[0]


def test_front_page_keeps_its_own_budget_with_what_it_loads_and_its_fonts(tmp_path):
    (tmp_path / "style.css").write_text('@font-face { src: url("big.woff2") }')
    (tmp_path / "big.woff2").write_bytes(bytes(check_site.FRONT_BYTES))
    markup = '<link rel="stylesheet" href="style.css?v=1"></article>'
    (tmp_path / "index.html").write_text(GOOD.replace("</article>", markup))
    [problem] = check_site.find_problems(tmp_path)
    assert problem.startswith("index.html loads 1.50 MB, above its budget")


def test_icons_that_no_page_names_are_left_out_and_an_alias_keeps_its_icon():
    script = 'x={"arrow-up":[1,2,[],"f0",["M0","M1"]],bars:[3,4,["menu"],"f1","M2"],moon:[5,6,[9,"night"],"f2","M3"]};y'
    assert offline.reduce_icons(script, {"menu", "night", "solid"}) == (
        'x={bars:[3,4,["menu"],"f1","M2"],moon:[5,6,[9,"night"],"f2","M3"]};y',
        {"menu", "night"},
    )


def test_number_and_unit_stay_on_one_line_wherever_the_text_is_cut():
    pasted = nodes.inline("", "", nodes.Text("12"))
    block = nodes.paragraph("", "", pasted, nodes.Text(" % (n = 3) of starts in 5 ms, "), nodes.literal("", "2 s"))
    typesetting.close_up(block)
    assert block.astext() == "12\u00a0% (n\u00a0=\u00a03) of starts in 5\u00a0ms, 2 s"


def test_long_names_of_code_break_at_their_joints_and_short_names_and_numbers_do_not():
    words = ("of_quaternion", "np.copysign(1.0,", "bench.findings.selection_words", "resolution_of_1.25_arcseconds")
    context = {"body": "".join(f'<span class="pre">{word}</span>' for word in words)}
    typesetting.let_names_break(None, "", "", context, None)
    shown = context["body"].removesuffix("</span>").removeprefix('<span class="pre">')
    assert shown.split('</span><span class="pre">') == [
        *words[:2],
        "bench.<wbr>findings.<wbr>selection_<wbr>words",
        "resolution_<wbr>of_<wbr>1.25_<wbr>arcseconds",
    ]


def test_punctuation_joins_its_own_formula_where_the_same_stands_elsewhere():
    word, formula = nodes.strong("", "a"), nodes.math("", "x")
    nodes.paragraph("", "", word, nodes.Text(", "), formula, nodes.Text(", "))
    typesetting.keep_punctuation(formula)
    assert formula["punctuation"] == ","
    assert [one.astext() for one in formula.parent.children] == ["a", ", ", "x", " "]
