"""Let two processes time in turns: one works while the other waits for a byte on a socket."""

import contextlib
import io
import json

import pytest

OTHER_ENDED = 77
"""Exit code of a process that lost the other one; `bench.regression.timer` knows it, too."""


class Turns:
    """The turns of this process and another one; without a socket this process always has the turn.

    Args:
        descriptor: File descriptor of the socket to the other process; None if this process is
            alone.
        is_first: Whether this process has the first turn.
    """

    def __init__(self, descriptor: int | None, is_first: bool):
        self.line = None if descriptor is None else io.FileIO(descriptor, "r+")
        self.is_first = is_first

    @property
    def is_alone(self) -> bool:
        """Return whether there is no other process."""
        return self.line is None

    def exchange(self, message: list) -> list:
        """Tell the other process something, and return what it tells; alone: return the message."""
        if self.line is None:
            return message
        self._write(json.dumps(message).encode() + b"\n")
        answer = b""
        with contextlib.suppress(ConnectionError):
            answer = self.line.readline()
        if not answer:
            self._leave()
        return json.loads(answer)

    def begin(self) -> None:
        """Give the first process its first turn, once a benchmark."""
        if not self.is_first:
            self._write(b".")

    def wait(self) -> None:
        """Wait for the turn of this process."""
        if self.line is None:
            return
        with contextlib.suppress(ConnectionError):
            if self.line.read(1):
                return
        self._leave()

    def give(self) -> None:
        """Give the turn to the other process."""
        self._write(b".")

    def end(self) -> None:
        """Take back the last turn, so that the next benchmark begins with an empty line."""
        if self.is_first:
            self.wait()

    def _write(self, words: bytes) -> None:
        # Where the other process has ended, the next `wait` or `exchange` says so.
        with contextlib.suppress(ConnectionError):
            if self.line is not None:
                self.line.write(words)

    def _leave(self) -> None:
        pytest.exit("the other side has ended", OTHER_ENDED)
