"""A user's laws in a process of their own: it compiles them once, and makes rows in forks.

`pool.LawProcess` asks. The first request is a plan (wire_format.py); then each names a unit: to
compile what its rows need, or, in a fork, to make them.
"""

from bench.base.errors import BadLaw, BenchError
from bench.base.isolated import CRASHED, Line, NoAnswer
from bench.base.serving import answer_in_fork, serve
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.plan import Plan
from bench.experiments.tables.packed import pack
from bench.experiments.tables.store import table_of_unit
from bench.law.contenders.described_law import TRIAL_LIMITS
from bench.law.contenders.law_file import load_law, trial_error
from bench.running.wire_format import plan_of


class UnitServer:
    """Makes the rows of units of a plan.

    Attributes:
        plan: With the laws themselves, once they are loaded.
        units: Its units by their keys.
    """

    plan: Plan
    units: dict[str, Unit]

    def answer(self, request: dict, line: Line) -> bytes:
        """Return the answer to a request of `pool.LawProcess`."""
        if "plan" in request:
            self.load(request["plan"])
            return b""
        unit = self.units[request["key"]]
        if request["in_fork"]:
            return self.make_rows(unit.part(*request["starts"]) if request["starts"] else unit)
        self.prepare(unit, line)
        return b""

    def load(self, content: dict) -> None:
        """Load the laws of a plan."""
        try:
            self.plan = plan_of(content, load_law)
        except BadLaw as error:
            # It did load when its words were read: it has changed, or the sources have.
            raise NoAnswer(CRASHED, str(error)) from error
        self.units = {unit.key: unit for unit in self.plan.units}

    def prepare(self, unit: Unit, line: Line) -> None:
        """Compile, import and build what the rows of a unit need.

        Errors:
            NoAnswer: The law always raises, or hangs.
            BenchError: It is beyond the dialect.
        """
        try:
            experiment_of(unit).prepare(self.plan.request, unit)
        except BenchError:
            answer_in_fork(lambda: self.try_law(unit), TRIAL_LIMITS, line)
            raise

    def try_law(self, unit: Unit) -> bytes:
        """Call a law once; NoAnswer if it raises."""
        raised = trial_error(self.plan.request.contender(unit.contender))
        if raised:
            raise NoAnswer(CRASHED, raised)
        return b""

    def make_rows(self, unit: Unit) -> bytes:
        """Return the rows of a unit."""
        return pack(table_of_unit(self.plan.request, unit), experiment_of(unit).table)


if __name__ == "__main__":
    serve(UnitServer().answer)
