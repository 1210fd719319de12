"""The file of all lines: results/history/history.jsonl.

It is appended to whole or not at all: a new file takes the old one's place, and two writers wait for each other.
"""

from collections.abc import Iterable
from pathlib import Path

from bench.errors import BadResults
from bench.files import refuse_link, write_atomically
from bench.regression.history.record import Record, from_json, to_json
from bench.tables import lock
from bench.tables.schema import RESULTS

LOG = RESULTS / "history" / "history.jsonl"
MOST_BYTES = 100_000_000
"""Of a file that is read: a hundred thousand lines."""


def read(path: Path = LOG) -> list[Record]:
    """All lines, in the order of their commits; none where there is no file.

    Errors:
        BadResults: a line is malformed, foreign, or there twice; the message gives its number.
    """
    path = Path(path)
    refuse_link(path)
    if not path.is_file():
        return []
    if path.stat().st_size > MOST_BYTES:
        raise BadResults(f"{path}: it has more than {MOST_BYTES:,} bytes, so it is none of ours; delete it")
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise BadResults(f"{path}: it is no text (byte {error.start}: {error.reason}); take it from git") from error
    found: dict[tuple, tuple[int, Record]] = {}
    for number, one in enumerate(text.splitlines(), 1):
        try:
            line = from_json(one)
        except BadResults as error:
            raise BadResults(f"{path}, line {number}: {error}; delete the line, or take the file from git") from error
        if line.key in found:
            raise BadResults(f"{path}, line {number}: line {found[line.key][0]} is about the same; delete one of them")
        found[line.key] = (number, line)
    return sorted((line for _, line in found.values()), key=lambda line: (line.place, line.date))


def append(lines: Iterable[Record], path: Path = LOG) -> int:
    """Add the lines that the file does not have yet; how many those were.

    A build that is measured a second time on a machine adds nothing: the first measurement stands.

    Errors:
        BadResults: see `read`; a line that could not be read again; or the file cannot be written.
    """
    path = Path(path)
    lines = [from_json(to_json(line)) for line in lines]
    path.parent.mkdir(parents=True, exist_ok=True)
    with lock.held(path.parent, waits=True):
        known = {line.key for line in read(path)}
        new = {line.key: line for line in lines if line.key not in known}
        if new:
            text = (path.read_text(encoding="utf-8") if path.is_file() else "") + "".join(
                to_json(line) + "\n" for line in new.values()
            )
            write_atomically(path, lambda temporary: Path(temporary).write_text(text, encoding="utf-8"))
    return len(new)
