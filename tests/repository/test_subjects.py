"""`bench` names subjects and no page; the book says which page explains each, and the command line reads that."""

import re

import pytest
import subjects as book
from support.command_line import bench

from bench.base.provenance import ROOT
from bench.findings import subjects, why
from bench.findings.claims.errata import COVERAGE
from bench.findings.selection.robots import ROBOTS
from bench.findings.subjects import SentenceSubject

NAMES = sorted(book.list_pages())
NAME = re.compile(rf"(?<![\w-])({'|'.join(map(re.escape, NAMES))})(?![\w-])")
SOURCES = [path for path in sorted((ROOT / "bench").rglob("*")) if path.suffix in (".py", ".toml", ".md", ".txt")]
TEXTS = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in SOURCES}
MAP = dict(book.read_pages(book.MAP))


def find_page_names(text):
    return NAME.findall(text)


def test_no_file_of_the_benchmark_names_a_page_of_the_book():
    assert {name: found for name, text in TEXTS.items() if (found := find_page_names(text))} == {}


def test_planted_page_name_is_found_and_its_words_alone_are_not():
    assert find_page_names('page = "08-delay-noise-limits"  # and appendix-arms.md') == [
        "08-delay-noise-limits",
        "appendix-arms",
    ]
    assert not find_page_names("delay-noise-limits, appendix, the arms, 08-delay")


def test_book_says_where_it_explains_every_subject():
    assert book.find_faults(MAP, NAMES) == []


def test_subject_without_a_page_is_refused_with_the_line_to_write():
    without = {subject: page for subject, page in MAP.items() if subject != "noise"}
    [fault] = book.find_faults(without, NAMES)
    assert 'add the line noise = "PAGE"' in fault
    assert all(name in fault for name in NAMES)


def test_page_and_subject_that_do_not_exist_are_refused():
    [page] = book.find_faults(MAP | {"noise": "08-noise"}, NAMES)
    assert "'noise' is on the page '08-noise'" in page
    [subject] = book.find_faults(MAP | {"nois": "08-delay-noise-limits"}, NAMES)
    assert "'nois', which is no subject" in subject


def test_renaming_a_chapter_changes_no_other_file_than_the_map(tmp_path):
    renamed = tmp_path / "subjects.toml"
    renamed.write_text(book.MAP.read_text(encoding="utf-8").replace("08-delay-noise-limits", "09-noise"))
    assert subjects.find_reading(SentenceSubject.NOISE, renamed) == "09-noise"


def test_every_subject_is_that_of_a_sentence_a_part_of_the_paper_or_a_robot():
    used = {known["subject"] for words in why.SENTENCES.values() for known in words.values()}
    used |= {subject for item in COVERAGE for subject in item.subjects}
    used |= {robot.subject for robot in ROBOTS.values()}
    in_code = {word for text in TEXTS.values() for word in re.findall(r"SentenceSubject\.([A-Z]\w+)", text)}
    assert used | {SentenceSubject[word] for word in in_code} == set(SentenceSubject)


def test_word_that_is_no_subject_is_refused_with_the_line_to_write():
    with pytest.raises(ValueError, match=r'subject \'gimbal\' is unknown.*add the line GIMBAL = "gimbal"'):
        SentenceSubject("gimbal")


def test_every_sentence_has_a_known_subject():
    for words in why.SENTENCES.values():
        for known in words.values():
            assert SentenceSubject(known["subject"]) in SentenceSubject


def test_without_the_book_the_subject_itself_is_shown(tmp_path):
    missing = tmp_path / "subjects.toml"
    assert subjects.find_reading(SentenceSubject.GIMBAL_LOCK, missing) == "gimbal-lock"
    assert "not beside this package" in subjects.describe_readings(missing)


@pytest.mark.slow
def test_judgement_names_the_pages_to_read(capsys):
    shown = bench(capsys, "judge", "quaternion-unwinding").out
    assert "[appendix-laws]" in " ".join(shown.split())
    assert "pages of the book: report/pages, or make report" in " ".join(shown.split())
