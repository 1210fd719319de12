"""The fold of a claim: its numbers as a table, where it is shown, the rows that decide it, and how to make them."""

from bench.experiments.tables.run import Run
from bench.findings.claims.verdict import Claim, Evidence, Verdict, Word
from report.figures.claims import evidence as page

CHOSEN = (("episodes", "regulator == 'a' and start_set in ['box']"),)


def fold(tmp_path, found, id="C06"):
    claim = Claim(id, "2.4", "It settles.", "", lambda results: None, quote="it settled")
    return page.section(Verdict(claim, Word.HOLDS, found), Run(tmp_path))


def test_numbers_of_an_evidence_are_a_table_that_keys_can_scroll(tmp_path):
    numbers = (("Law", "99 % settle in"), ("a", "never"))
    text = fold(tmp_path, Evidence("It holds.", 3, ("episodes",), numbers=numbers))
    assert '<th scope="col">Law</th>' in text
    assert "<td>never</td>" in text
    assert 'tabindex="0"' in text
    assert "<table" not in fold(tmp_path, Evidence("It holds.", 3, ("episodes",)))


def test_file_is_a_link_where_the_site_offers_it_and_a_name_elsewhere(tmp_path):
    found = Evidence("It holds.", 3, ("episodes",))
    assert "<code>episodes.parquet</code>" in fold(tmp_path, found)
    (tmp_path / "episodes.parquet").write_bytes(b"rows")
    assert 'href="../data/episodes.parquet"' in fold(tmp_path, found)


def test_rows_of_a_claim_are_chosen_by_lines_that_can_be_copied(tmp_path):
    text = fold(tmp_path, Evidence("It holds.", 3, ("episodes",), chosen=CHOSEN))
    assert "episodes = pandas.read_parquet(&quot;episodes.parquet&quot;)" in text
    assert "episodes.query(&quot;regulator == &#x27;a&#x27; and start_set in [&#x27;box&#x27;]&quot;)" in text


def test_commands_name_make_bench_only_where_a_table_of_a_run_decides(tmp_path):
    assert "<code>make bench</code>" in fold(tmp_path, Evidence("It holds.", 3, ("episodes",)))
    timed = fold(tmp_path, Evidence("It holds.", 3, ("timings",)))
    assert "make bench" not in timed
    assert "<code>bench claims</code>" in timed


def test_fold_leads_to_the_figure_that_shows_the_claim(tmp_path):
    assert 'href="02-three-regulators.html#fig-three-laws"' in fold(tmp_path, Evidence("It holds.", 3, ("episodes",)))
