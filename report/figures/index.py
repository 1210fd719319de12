"""What the front page shows: the answer, all verdicts, the hero of the paper's three laws, and forces."""

from bench.findings import claims
from report.figures.answer import answer_box, which_law
from report.figures.claims import claims as judged
from report.figures.contact import compliance, in_contact
from report.figures.contact.rows import CARTESIAN, EULER, PAPERS, PAPERS_EULER
from report.figures.kit.page import Run
from report.figures.responses import hero


def facts(run: Run) -> dict:
    """Return the answer, the laws, how many criteria were revised."""
    on_claims = judged.facts(run)
    return {
        **{name: on_claims[name] for name in ("decided", "changed", "turned")},
        "which_law": which_law.front_page(run),
        "pegs": in_contact.stuck(in_contact.all_rows(run), PAPERS, PAPERS_EULER),
        "pegs_by_accelerations": in_contact.stuck(in_contact.all_rows(run), CARTESIAN, EULER),
        "off": compliance.facts(run).get("off"),
    }


def tables(run: Run) -> dict:
    """Return the answer, and how many verdicts there are of each kind."""
    return {
        "answer": answer_box.answer(run),
        "tiles": judged.tiles(claims.judge_all()),
    }


def figures(run: Run) -> dict:
    """Return the paper's three laws from every angle."""
    return {"hero": hero.hero(run.rows("episodes", engine="ideal-rk4"))}
