"""Find the largest empty strip of each page of a PDF that Chromium wrote, from the places of its ink.

Only heights are followed: of texts, of painted paths, and of pictures. Clips and white fills paint nothing.
"""

import itertools
import re
import zlib
from typing import NamedTuple

ENTRY = re.compile(rb"(\d{10}) \d{5} n")
STREAM = re.compile(rb"\bstream\r?\n")
NUMBER_OR_WORD = re.compile(rb"\((?:\\.|[^\\()])*\)|<[0-9A-Fa-f\s]*>|\[|\]|/[^\s/<>\[\]()]+|[-+]?[\d.]+|[A-Za-z'\"*]+")
REFERENCE = re.compile(rb"(\d+) 0 R")
PAINTING = {b"f", b"F", b"f*", b"B", b"B*", b"b", b"b*", b"S", b"s"}
MOVES = {b"m": 2, b"l": 2, b"c": 6, b"v": 4, b"y": 4}
LINE_HEIGHT = 1.2
Matrix = tuple[float, ...]
IDENTITY: Matrix = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)


class NotOfChromium(Exception):
    """The file has not the form that Chromium writes."""


def find(pattern: bytes | re.Pattern[bytes], text: bytes) -> re.Match[bytes]:
    """Return the first place of a pattern; NotOfChromium if there is none."""
    found = re.search(pattern, text, re.DOTALL if isinstance(pattern, bytes) else 0)
    if not found:
        raise NotOfChromium(f"nothing like {pattern!r} in {text[:80]!r}")
    return found


class Strip(NamedTuple):
    """An interval of heights with ink, from the top of the page [pt]."""

    top: float
    bottom: float


class Page(NamedTuple):
    """A page: its height [pt] and its strips of ink."""

    height: float
    strips: list[Strip]

    def largest_gap(self) -> float:
        """Return the largest empty strip between the first ink and the end of the page, as a share of the page."""
        reached, gaps = min((one.top for one in self.strips), default=0.0), []
        for strip in sorted(self.strips):
            gaps.append(strip.top - reached)
            reached = max(reached, strip.bottom)
        gaps.append(self.height - reached)
        return max(gaps) / self.height


def multiply(m: Matrix, n: Matrix) -> Matrix:
    """Return the matrix that applies m first and then n."""
    a, b, c, d, e, f = m
    return (
        a * n[0] + b * n[2],
        a * n[1] + b * n[3],
        c * n[0] + d * n[2],
        c * n[1] + d * n[3],
        e * n[0] + f * n[2] + n[4],
        e * n[1] + f * n[3] + n[5],
    )


def height_of(matrix: Matrix, x: float, y: float) -> float:
    """Return the height of a point on the page, from its bottom."""
    return matrix[1] * x + matrix[3] * y + matrix[5]


def read_pages(data: bytes) -> list[Page]:
    """Return the pages of a file in their order."""
    objects = read_objects(data)
    pages = []
    for body in (objects[number] for number in _page_numbers(objects)):
        box = find(rb"/MediaBox\s*\[([^\]]*)\]", body)
        height = float(box[1].split()[3])
        contents = find(rb"/Contents\s+(\d+) 0 R", body)
        ink = find_ink(objects, int(contents[1]), IDENTITY, _resources(objects, body))
        pages.append(Page(height, [Strip(height - high, height - low) for low, high in ink]))
    return pages


def read_objects(data: bytes) -> dict[int, bytes]:
    """Return the bytes of each object, by its number: from its place in the table of the file to the next place."""
    table = int(data[data.rindex(b"startxref") :].split()[1])
    places = sorted(int(place) for place in ENTRY.findall(data[table:]))
    bodies = (data[place:end] for place, end in itertools.pairwise([*places, table]))
    return {int(body.split(maxsplit=1)[0]): body for body in bodies}


def _page_numbers(objects: dict[int, bytes]) -> list[int]:
    [root] = [body for body in objects.values() if re.search(rb"/Type\s*/Catalog", body)]
    return list(_leaves(objects, int(find(rb"/Pages\s+(\d+) 0 R", root)[1])))


def _leaves(objects: dict[int, bytes], number: int):
    kids = re.search(rb"/Kids\s*\[([^\]]*)\]", objects[number])
    if not kids:
        yield number
        return
    for kid in REFERENCE.findall(kids[1]):
        yield from _leaves(objects, int(kid))


def _resources(objects: dict[int, bytes], body: bytes) -> dict[bytes, int]:
    """Return the numbers of the pictures and forms that a page or form may draw, by name."""
    indirect = re.search(rb"/Resources\s+(\d+) 0 R", body)
    text = objects[int(indirect[1])] if indirect else body
    listed = re.search(rb"/XObject\s*<<(.*?)>>", text, re.DOTALL)
    return {name: int(number) for name, number in re.findall(rb"(/\S+)\s+(\d+) 0 R", listed[1])} if listed else {}


def _stream(body: bytes) -> bytes:
    begin = find(STREAM, body)
    length = int(find(rb"/Length\s+(\d+)", body[: begin.start()])[1])
    raw = body[begin.end() : begin.end() + length]
    return zlib.decompress(raw) if b"/FlateDecode" in body[: begin.start()] else raw


def find_ink(objects: dict[int, bytes], number: int, start: Matrix, pictures: dict[bytes, int]) -> list:
    """Return (lowest, highest) of each thing that a content stream paints, from the bottom of the page."""
    ink: list[tuple[float, float]] = []
    matrix, stack, operands, path, is_white = start, [], [], [], False
    text = IDENTITY
    size = 1.0
    for token in NUMBER_OR_WORD.findall(_stream(objects[number])):
        if not token[:1].isalpha() and token not in (b"'", b'"'):
            operands.append(token)
            continue
        numbers = [float(one) for one in operands if re.fullmatch(rb"[-+]?[\d.]+", one)]
        if token == b"q":
            stack.append((matrix, is_white))
        elif token == b"Q":
            matrix, is_white = stack.pop()
        elif token in (b"rg", b"g", b"scn"):
            is_white = bool(numbers) and min(numbers) == 1.0
        elif token == b"cm":
            matrix = multiply(tuple(numbers[-6:]), matrix)
        elif token == b"re":
            x, y, width, height = numbers[-4:]
            path += [height_of(matrix, x, y), height_of(matrix, x + width, y + height)]
        elif token in MOVES:
            points = numbers[-MOVES[token] :]
            path += [height_of(matrix, *points[i : i + 2]) for i in range(0, len(points), 2)]
        elif token in PAINTING:
            is_paper = is_white and token in (b"f", b"f*")
            ink += [(min(path), max(path))] if path and not is_paper else []
            path = []
        elif token == b"n":
            path = []
        elif token == b"BT":
            text = IDENTITY
        elif token == b"Tf":
            size = numbers[-1]
        elif token == b"Tm":
            text = tuple(numbers[-6:])
        elif token in (b"Td", b"TD"):
            text = multiply((1.0, 0.0, 0.0, 1.0, *numbers[-2:]), text)
        elif token in (b"Tj", b"TJ"):
            placed = multiply(text, matrix)
            base, scale = height_of(placed, 0.0, 0.0), abs(placed[3]) or abs(placed[1])
            ink.append((base - 0.25 * size * scale, base + (LINE_HEIGHT - 0.25) * size * scale))
        elif token == b"Do":
            drawn = objects[pictures[operands[-1]]]
            if re.search(rb"/Subtype\s*/Form", drawn):
                ink += find_ink(objects, pictures[operands[-1]], matrix, _resources(objects, drawn))
            else:
                ends = [height_of(matrix, 0.0, 0.0), height_of(matrix, 1.0, 1.0)]
                ink.append((min(ends), max(ends)))
        operands = []
    return ink
