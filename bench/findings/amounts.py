"""Counts in words, as pages and commands say them: none is a word, all is a word, and a number has its noun."""

from collections.abc import Iterable


def count(number: int, noun: str, nouns: str = "") -> str:
    """Return a number with its noun: no law, 1 law, 1,200 laws; `nouns` where the plural is not noun + s."""
    amount = f"{number:,}" if number else "no"
    return f"{amount} {noun if number in (0, 1) else nouns or f'{noun}s'}"


def count_of(part: int, whole: int, nouns: str) -> str:
    """Say how many of a group: none of the 14 laws, 3 of the 14 laws, all 14 laws, both laws."""
    if not 0 <= part <= whole:
        raise ValueError(f"{part} of {whole} {nouns} is no part of them; the first number goes from 0 to the second")
    if not whole:
        return f"no {nouns}"
    if part == whole == 2:
        return f"both {nouns}"
    if part == whole:
        return f"all {whole:,} {nouns}"
    return f"{part:,} of the {whole:,} {nouns}" if part else f"none of the {whole:,} {nouns}"


def part_of(part: int, whole: int) -> str:
    """Return how many of a group whose noun is said beside it: 'all 17', 'none of 17' or '3 of 17'."""
    many = {whole: "all", 0: "none of"}.get(part, f"{part:,} of")
    return f"{many} {whole:,}"


def capitalize(text: str) -> str:
    """Return a text as the start of a sentence: its first letter large, the others as they are."""
    return f"{text[:1].upper()}{text[1:]}"


def join_words(parts: Iterable[str]) -> str:
    """Return a list in words: 'a', 'a and b', 'a, b and c'; nothing of an empty list."""
    *first, last = list(parts) or [""]
    return f"{', '.join(first)} and {last}" if first else last
