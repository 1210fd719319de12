"""The command line that every study has."""

import pytest

from bench.studies.study import make_parser


@pytest.mark.parametrize("word", ["nan", "inf", "0", "-1", "1e3", "257", "two", ""])
def test_workers_that_cannot_work_are_refused_in_one_line(capsys, word):
    with pytest.raises(SystemExit) as stop:
        make_parser("robustness", "A study.", workers=2).parse_args([f"--workers={word}"])
    assert stop.value.code == 2
    assert f"'{word}' is no number of threads: give a whole number from 1 to 256" in capsys.readouterr().err


def test_workers_are_taken():
    assert make_parser("robustness", "A study.", workers=2).parse_args(["--workers", "3"]).workers == 3
