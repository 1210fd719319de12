"""What the front page shows: the answer, the paper's three laws in a line each, all verdicts, and the edition."""

import numpy as np

from bench.base.provenance import count_episodes
from bench.experiments.tables import read
from bench.findings import claims
from report.figures.answer import answer_box, which_law
from report.figures.claims import claims as judged
from report.figures.contact import compliance, in_contact
from report.figures.contact.rows import CARTESIAN, EULER, PAPERS, PAPERS_EULER
from report.figures.cost.cost import totals
from report.figures.cost.operations import CALLS
from report.figures.failures import maps
from report.figures.failures.failure_map import EXACT_RAD
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.rows import FEEDBACK, LINEARIZED, MATRIX, SHORT, lost, of
from report.figures.kit.share import share
from report.figures.method.provenance import cited
from report.figures.responses import hero, settling_time

BIBTEX = """```bibtex
@misc{{orientation-bench,
  author = {{{{The orientation-bench maintainers}}}},
  title  = {{{title}}},
  note   = {{Version {version}, run of {date} at commit {commit}.
            A replication of S. Murphy, On the Cartesian Control of
            Orientation and Force for Robotic Manipulators, TFRT-7396,
            Lund Institute of Technology, 1988}},
  year   = {{{year}}},
}}
```"""
"""An entry for this edition."""

SHORT_COMMIT = 10
"""Digits of a commit that tell it from every other."""


def facts(run: Run) -> dict:
    """Return the answer, the laws, how many criteria were revised, and which edition this is."""
    on_claims = judged.facts(run)
    return {
        **{name: on_claims[name] for name in ("decided", "changed", "turned")},
        "which_law": which_law.front_page(run),
        "pegs": in_contact.stuck(in_contact.all_rows(run), PAPERS, PAPERS_EULER),
        "pegs_by_accelerations": in_contact.stuck(in_contact.all_rows(run), CARTESIAN, EULER),
        "off": compliance.facts(run).get("off"),
        **of_the_paper(run),
        "mapped_l": maps.lost_at_rest(LINEARIZED),
        "mapped": maps.facts()["mapped"],
        **edition(read.provenance()),
    }


def tables(run: Run) -> dict:
    """Return the answer with its code; a square for every verdict, and how many there are of each."""
    every = claims.judge_all()
    return {
        "answer": answer_box.answer(run),
        "tiles": judged.tiles(every),
        "strip": judged.strip(every, "pages/40-claims.html"),
        "bibtex": bibtex(edition(read.provenance())),
    }


def figures(run: Run) -> dict:
    """Return the paper's three laws from every angle."""
    return {"hero": hero.hero(run.rows("episodes", engine="ideal-rk4"))}


def of_the_paper(run: Run) -> dict:
    """Return the paper's three laws on the continuous plant: what they settle, how fast, and what they cost."""
    episodes = run.rows("episodes", engine="ideal-rk4")
    tallies = totals(run.rows("costs", **read.FREE_BODY))
    half, poles = of(episodes, MATRIX, "half-turn"), of(episodes, FEEDBACK, "poles")
    on_pole = poles[np.pi / 2.0 - poles["beta0"].abs() < EXACT_RAD]
    _, exact = settling_time.near_and_exact(half)
    values = {
        "slope": f"{settling_time.slope(half):.3f}",
        "stuck": len(lost(exact)),
        "exact": len(exact),
        "least": f"{np.floor(np.degrees(lost(of(episodes, LINEARIZED))['alpha0'].abs().min())):.0f}",
        "polar": len(lost(on_pole)),
        "on_pole": len(on_pole),
    }
    for letter in "mf":
        name = SHORT[letter]
        rows = of(episodes, name)
        found = share(len(rows) - len(lost(rows)), len(rows))
        interval = f"{100 * found.low:.1f} to {100 * found.high:.1f} %"
        values[f"share_{letter}"] = f"{100 * found.value:.1f} % ({interval}, n = {html.number(found.n)})"
        values[f"slowest_{letter}"] = f"{rows['settling_time_s'].max():.2f}"
        values[f"flops_{letter}"] = int(tallies.loc[name, "flops"])
        values[f"calls_{letter}"] = int(tallies.loc[name, list(CALLS)].sum())
    return values


def bibtex(values: dict) -> html.Markdown:
    """How this edition is cited."""
    return html.Markdown(BIBTEX.format(**values, **cited(), year=values["date"].partition("-")[0]))


def edition(provenance: dict) -> dict:
    """Return the run that is shown."""
    commit = provenance["commit"][:SHORT_COMMIT] or "none"
    return {
        "date": provenance["finished"].partition("T")[0],
        "commit": f"{commit}, with changes" if provenance["dirty"] else commit,
        "suite": provenance["suite"],
        "episodes": count_episodes(provenance),
    }
