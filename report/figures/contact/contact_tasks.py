"""The page on the equations and tasks in contact: what each task is, when it ends, and how it looks."""

import tasks
from bench.experiments.tables.run import Run
from bench.findings.amounts import join_words
from report.figures.contact import limits
from report.figures.contact.compliance import PROBE
from report.figures.contact.in_contact import MEASURES, PAPERS_EULER, of, of_task
from report.figures.kit import media
from report.figures.kit.page import in_run
from tasks.contact_rest import HORIZON_S, REST

STILLS = (
    "Four renders of a PUMA 560 with a blue tool. A square tool flat on a tilted plate; a square peg in a leaning "
    "chamfered hole; a hand on a crank; a round tip on an inclined plane."
)


def facts(run: Run) -> dict:
    """Return what each task is and lets comply, when it ends, and the gain of the force; with real motors, too."""
    arm = tasks.arm(media.facts()["contact"]["arm"])
    orders = []
    for task in map(tasks.contact_task, MEASURES):
        along, _, about = task.trials(arm)[0].specification.name.partition(", about ")
        axes = f"in translation along {join_words(along.split(', '))}"
        axes += f", and in rotation about {about}" if about else ""
        name, title = task.name.replace("-", " ").capitalize(), f"{task.title[0].lower()}{task.title[1:]}"
        orders.append(f"- **{name}** ({title}): the hand is compliant {axes}.")
    return {
        **limits.facts(run),
        "settings": limits.LIMITS(limits.compare_settings()),
        "contact-tasks": media.still(STILLS, "contact-tasks"),
        "orders": "\n".join(orders),
        "rest_rule": f"{1e3 * REST.speed:g} mm/s and {REST.rate:g} rad/s for {REST.hold_s:g} s",
        "rest_horizon": f"{HORIZON_S:g}",
        "kf": in_run(lambda: f"{of(of_task(run, PROBE), PAPERS_EULER)['kf'].iloc[0]:g}"),
    }
