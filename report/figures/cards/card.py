"""The page of a law of any kind: a card of fields, its files for other languages, and its source."""

import ast
import html as markup
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import PythonLexer

from bench.export.language import find_language, language_words
from bench.export.short import write_short
from bench.export.subject import find_subject
from bench.findings.proofs.certificate import DRAWN, describe_sampled, read_certificates
from bench.law.attribution import describe_source
from bench.law.kinds import Law
from report.figures.kit import html
from report.figures.kit.spelling import LETTERS, marked_up

CATALOGUE = Path(__file__).resolve().parents[2] / "pages" / "appendix-laws.md"
BACK = (
    '<nav class="crumbs"><a href="../pages/appendix-laws.html">Catalogue of laws</a> ›</nav>'
    if CATALOGUE.is_file()
    else ""
)
PROPERTIES = {
    "local": "The goal is stable, and near the goal the law has the stiffness and damping that the gains define.",
    "almost global": "The goal is stable, and the law brings the body to the goal from all starts except a set of "
    "measure zero. No continuous law without memory brings the body to a stable goal from all starts "
    "(Bhat & Bernstein 2000).",
    "almost global from rest": "The goal is stable. If the body starts at rest, the law brings the body to the goal "
    "from all starts except a set of measure zero.",
    "global with memory": "The goal is stable, and the law with its memory brings the body to the goal from every "
    "start. No continuous law without memory brings the body to a stable goal from every start "
    "(Bhat & Bernstein 2000).",
    "none": "We do not claim that the goal is stable.",
    "": "",
}
EQUILIBRIA = {
    "none": "For a body at rest, the command is zero only at the goal.",
    "none, but the command jumps at 180°": "For a body at rest, the command is zero only at the goal. "
    "The command of the law jumps at 180° rotations from the goal.",
    "not defined at 180°": "The command of the law is not defined at 180° rotations from the goal.",
    "every 180° rotation": "Every 180° rotation from the goal is also an equilibrium.",
    "180° rotations about n_d, o_d and a_d": "The three 180° rotations from the goal about the axes n_d, o_d and "
    "a_d of the goal are also equilibria.",
}
"""Say where a law can rest away from the goal: the words of a certificate -> a sentence of its card."""
METHODS = {"Z3": "the solver Z3", "algebra": "computer algebra"}
GREEK = {**LETTERS, "eps": "ε", "eta": "η", "lambda": "λ"}
DOTTED = re.compile(rf"\b({'|'.join(GREEK)}|[A-Za-z])(d?)dot\b")
SIGNS: tuple[tuple[str, Any], ...] = (
    (r"\b(eps|eta|lambda)(?=\b|_)", lambda found: GREEK[found[1]]),
    (r"\bsqrt(?=\()", "√"),
    (r"(?<=\w) \. (?=\w)", " · "),
    (r"(?<=\d) degrees\b", "°"),
    (r"(?<=[\w)\u0307\u0308] )-(?= [\w(])", "−"),
    (r"(?<== )-(?=\()", "−"),
    (r"\b(?:half-turn)(s?)\b", r"180° rotation\1"),
    (r"\bfirst tick\b", "first control step"),
    (r"\bthe last tick\b", "the last control step"),
    (r"\bticks?\b", "control step"),
)
CODE, GAIN = re.compile(r"`([^`]+)`"), re.compile(r"\b[Kk]([pvd])\b")


class LawPage(NamedTuple):
    """name: of the page, without a suffix. files: what it offers to take away, by name."""

    name: str
    title: str
    body: str
    files: dict[str, str]


class SourceFile(NamedTuple):
    """A contender's file on this machine, and its path as a reader sees it."""

    file: Path
    where: str


def make_page(
    name: str, title: str, card: str, source: SourceFile, word: str = "", live: str = ""
) -> LawPage:
    """Return the page of a law; word: by which it is exported, or empty; live: the page on which it runs."""
    subject = find_subject(word) if word else None
    languages = map(find_language, language_words() if word else ())
    laws = {each.title: next(iter(each.law(subject).items())) for each in languages if subject}
    files = {title: (Path(path).name, text) for title, (path, text) in laws.items()}
    take = take_files(word, files, live) if files else ""
    code = show_short(word) or show_code(source)
    body = f"<section>{BACK}<h1>{html.escape_untrusted(title)}</h1>{card}{take}{code}{fold(source)}</section>"
    return LawPage(name, title, body, dict(files.values()))


def make_card(
    record: Any,
    title: str,
    said: tuple[str, Mapping[str, str]],
    look: str,
    costs: str = "",
    attribution: str = "",
) -> str:
    """Return the card of a law; said: the docstring's text, and fields by their heads; look: its colour as CSS.

    attribution: whose the law is, where that is not the record's own word (in coordinates that its work has not).
    """
    formula = f'<div class="card-formula">{html.formula(record.formula)}</div>' if record.formula else ""
    source = html.escape_untrusted(
        describe_source(attribution or record.attribution, record.source)
    )
    lines = [set_paragraph(text) for text in said[0].split("\n\n") if text.strip()]
    for head, text in said[1].items():
        set_text = (
            text if isinstance(text, html.Html) else html.escape_untrusted(text)
        )  # only ours is markup
        lines += [f'<p class="card-fact"><b>{head}.</b> {set_text}</p>'] if text else []
    return (
        f'<section class="law-card" style="--law: {look}"'
        f' aria-label="{markup.escape(title, quote=True)}">'
        f'<header><span class="card-source">{source}</span></header>{formula}'
        f'<div class="card-body"><div class="card-text">{"".join(lines)}{costs}</div></div></section>'
    )


def say_property(law: Law, exception: str = "") -> dict[str, str]:
    """Return the property of a law: what is proved from its source, by what, about what, and what is cited.

    exception: a sentence on the goals for which a measured property does not hold.
    """
    certificate = read_certificates().get(law.name)
    text = PROPERTIES.get(law.property, f"{law.property[:1].upper()}{law.property[1:]}.")
    if not certificate or not certificate["is_proved"] or certificate["declared"] != law.property:
        head = "Stability" if law.property == "none" else "Measured, not proved"
        # a word that is not ours shows its backticks and stars as they are
        words = set_words(text) if law.property in PROPERTIES else html.escape_untrusted(text)
        return {head: html.Html(f"{words} {set_words(exception)}".strip())}
    lemmas = [lemma for lemma in certificate["lemmas"] if lemma["by"] != DRAWN]
    by = " and ".join(METHODS.get(by, by) for by in sorted({lemma["by"] for lemma in lemmas}))
    text += f" The proof holds {certificate['scope']}."
    steps = [f"({i}) {step}" for i, step in enumerate(certificate["cited"], 1)]
    text += f" The proof uses the function V below. A program read the source code of the law and proved {len(lemmas)} "
    text += f"lemmas in {certificate['seconds']:.1f} s with {by}."
    text += f" No program checked {'these steps' if len(steps) > 1 else 'this step'} of the proof: {' '.join(steps)}"
    text += f" {EQUILIBRIA.get(certificate['equilibria'], certificate['equilibria'])}"
    if "upper" in certificate["settling"]:
        upper = f"{certificate['settling']['upper']:.4f} s"
        text += (
            " With the gains of Murphy 1988 and from every start at rest, the angle to the goal falls below 2 % of its "
            f"initial value within {upper}, and then stays below this limit of 2 %. We proved the bound {upper} with "
            "the library Arb for interval arithmetic."
        )
    text += f" {describe_sampled(certificate)}"
    return {"Proved": html.Html(f"{set_words(text)} {html.formula(certificate['V'])}")}


def docstring(file: Path) -> tuple[str, str]:
    """Return what a contender's file says of it, and what it says of its limitations."""
    text = ast.get_docstring(ast.parse(file.read_bytes())) or ""
    about, _, fails = text.partition("Limitations:")
    return about, " ".join(fails.split())[:1].upper() + " ".join(fails.split())[1:]


def set_paragraph(text: str) -> str:
    """Return a paragraph as HTML: an indented one is equations, a line each; a dash begins an item of a list."""
    if text.startswith("    "):
        equations = map(set_words, re.split(r" {3,}|,? *\n", text.strip()))
        return f'<p class="card-equations">{"<br>".join(equations)}</p>'
    head, *items = re.split(r"(?:^|\n)- ", text)
    each = "".join(f"<li>{set_words(item)}</li>" for item in items)
    return f"<p>{set_words(head)}</p>" + (f"<ul>{each}</ul>" if each else "")


def set_words(text: str) -> html.Html:
    """Return text in the spelling of sources as HTML: letters, derivatives, roots, gains, and names in backticks."""
    text = DOTTED.sub(lambda found: f"{GREEK.get(found[1], found[1])}{chr(0x308 if found[2] else 0x307)}", text)
    for pattern, sign in SIGNS:
        text = re.sub(pattern, sign, text)
    text = marked_up(" ".join(text.split()))
    return html.Html(GAIN.sub(r"<i>K</i><sub>\1</sub>", CODE.sub(r"<code>\1</code>", text)))


def show_short(word: str) -> str:
    """Return the short form of a law; nothing of a law that has none."""
    code = write_short(word)
    imports = "<code>import jax.numpy as np</code> or <code>import torch as np</code>"
    others = f"This code uses NumPy as <code>np</code>. With {imports}, the code also runs in JAX or PyTorch."
    return f"<h2>The law in NumPy</h2><p>{others}</p>{colour(code)}" if code else ""


def show_code(source: SourceFile) -> str:
    """Return the function that is the law, without its docstring; nothing of a file that has none or is no Python."""
    text = source.file.read_text(encoding="utf-8", errors="replace")
    try:
        found = [one for one in ast.parse(text).body if isinstance(one, ast.FunctionDef) and one.name.startswith("law")]
    except (SyntaxError, ValueError):
        return ""
    lines, codes = text.splitlines(), []
    for one in found:
        first = one.body[0]
        end = first.end_lineno if ast.get_docstring(one) is not None else first.lineno - 1
        codes.append("\n".join([*lines[one.lineno - 1 : first.lineno - 1], *lines[end : one.end_lineno]]))
    code = "\n\n".join(codes)
    return f"<h2>Code of the law</h2>{colour(code)}" if codes else ""


def colour(code: str) -> str:
    """Return Python in the colours of its words."""
    coloured = highlight(code, PythonLexer(), HtmlFormatter(nowrap=True))
    return f'<div class="highlight"><pre tabindex="0">{coloured}</pre></div>'


def fold(source: SourceFile) -> str:
    """Return a file's text behind its name."""
    text = source.file.read_text(encoding="utf-8", errors="replace")
    return (
        '<details class="law-source"><summary>Complete source file of the law: '
        f"<code>{markup.escape(source.where)}</code></summary>"
        f"{colour(text)}</details>"
    )


def take_files(word: str, files: dict[str, tuple[str, str]], live: str) -> str:
    """Return what leads to its files and to the page on which it runs."""
    links = ", ".join(f'<a href="code/{name}" download>{title}</a>' for title, (name, _) in files.items())
    tried = f'<a href="../{live}.html#a={word}">Try this law</a>, or download' if live else "Download"
    command = f"<code>bench export {word} --to c</code>"
    also = f"The command {command} writes the C code of the law, test vectors and a test."
    return f"<p>{tried} the code of the law: {links}. {also}</p>"
