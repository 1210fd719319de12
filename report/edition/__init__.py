"""An edition: the book, its print, the data, the paper, the source, and wheels that rebuild it without a network."""


class CannotMake(Exception):
    """A part of the edition cannot be made; the message says why and what to do."""
