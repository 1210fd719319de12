"""Rules for what a reader sees: zero and all are words, a number has its noun, a column head stands alone."""

import re

AMOUNT = r"\d(?:[\d,\u202f]*\d)?"
ZERO_OF = re.compile(rf"(?<![\d.,])0 of (?:the |its )?{AMOUNT}")
ALL_OF = re.compile(rf"(?<![\d.,])({AMOUNT}) of (?:the |its |all )?\1(?![\d.,]*\d)")
OF_WHICH = re.compile(r"\bof (?:which|whom) (?:\d|none|one\b)")
BARE_END = re.compile(rf"(?<!factor )\b(?:in|of|from|for|with|only|also|fails?|all) ({AMOUNT})(?=[.;:!?]*$|; )")
YEAR = re.compile(r"(?:19|20)\d\d")
LEFT_OF_A_REFERENCE = re.compile(r"\b(?:[Cc]hapters?|[Tt]ables?|[Ff]igures?|[Ss]ections?|[Pp]ages?|power|norm) \S+$")
SENTENCE_END = re.compile(r"(?<=[.!?])[\"”)]*\s+(?=[A-Z“‘(*])")
HEAD_ALONE = re.compile(r"[A-ZΑ-Ω*$(<]|t\d\d\b|\d+(?:st|nd|rd|th) \w")
PERCENT = re.compile(r"\d+ ?\u00a0?%")
PRIVATE_HEADS = re.compile(r"\b(?:felt|held|asked|ticks?|second number|its time)\b", re.IGNORECASE)


def split_sentences(text: str) -> list[str]:
    """Return the sentences of a paragraph."""
    return [sentence.strip() for sentence in SENTENCE_END.split(" ".join(text.split())) if sentence.strip()]


def find_counts_not_in_words(text: str) -> list[str]:
    """Return the places of a paragraph where zero or all is a number: 0 of 14, 96 of 96, of which 1."""
    places = []
    for rule in (ZERO_OF, ALL_OF, OF_WHICH):
        places += [place[0] for place in rule.finditer(text)]
    return places


def find_numbers_without_noun(text: str) -> list[str]:
    """Return the sentences of a paragraph that end, or pause at a semicolon, in a count without its noun."""
    sentences = []
    for sentence in split_sentences(text):
        for place in BARE_END.finditer(sentence):
            is_reference = LEFT_OF_A_REFERENCE.search(sentence[: place.end()])
            if not is_reference and not YEAR.fullmatch(place[1]):
                sentences.append(sentence)
    return sentences


def find_faults(text: str) -> list[str]:
    """Return what both rules find in a paragraph."""
    return [*find_counts_not_in_words(text), *find_numbers_without_noun(text)]


def find_head_faults(heads: list[str]) -> list[str]:
    """Return the column heads that need the head beside them, the text, or our private words."""
    faults = []
    for head in heads:
        words = head.partition("[")[0].strip()
        stands_alone = HEAD_ALONE.match(words) and not PERCENT.fullmatch(words)
        if not stands_alone or PRIVATE_HEADS.search(words):
            faults.append(head)
    return faults
