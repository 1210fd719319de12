"""What was found about a run is kept, and found again when anything differs."""

import pytest

from bench.findings import kept


@pytest.fixture
def ask(tmp_path, monkeypatch):
    """Return what is kept of a run of one file, how often it was computed, and the run's folder."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    run, computed = tmp_path / "run", []
    run.mkdir()
    (run / "episodes.parquet").write_bytes(b"rows")

    def find():
        computed.append(None)
        return {"word": "holds"}

    return lambda: (kept.keep(run, "claims", find), len(computed)), run


def test_finding_is_computed_once_and_again_when_the_run_changes(ask):
    again, run = ask
    assert [again(), again()] == [({"word": "holds"}, 1)] * 2
    (run / "episodes.parquet").write_bytes(b"Rows")
    assert again()[1] == 2


@pytest.mark.parametrize(("old", "new"), [("holds", "fails"), ('"found"', '"fount"'), ("}", "")])
def test_damaged_finding_is_computed_again(ask, old, new):
    again, _ = ask
    again()
    (path,) = kept.home().iterdir()
    path.write_text(path.read_text().replace(old, new))
    assert again() == ({"word": "holds"}, 2)


def test_run_of_a_users_own_laws_is_never_kept(ask):
    again, run = ask
    (run / "laws").mkdir()
    assert [again()[1], again()[1]] == [1, 2]
