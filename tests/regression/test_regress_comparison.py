"""What a comparison says survives its JSON."""

import json

import pytest

from bench.errors import BadResults
from bench.findings.judgement import Judgement, Said
from bench.regression.revisions import comparison
from bench.regression.revisions.comparison import Benchmark, Comparison, Finding, Gate, Side, Timed
from bench.regression.revisions.measurement import Measurement, Spread

OPERATIONS = {"typical": {"add": 3, "mul": 4, "flops": 7}}
BASE = Measurement("rotation-matrix", "law", Spread(0.34, 0.33, 0.35), 60, 69.0, OPERATIONS, "c0de")
TIMED = Timed(1.21, 1.20, 1.22, 1e-9, 60, "slower", True)
FINDING = Finding("time", "regression", "rotation-matrix", "time a tick", "0.34", "0.41", "rotation-matrix is slower")


def of(*findings):
    benchmarks = (
        Benchmark("rotation-matrix", "law", BASE, BASE._replace(instructions=None), TIMED),
        Benchmark("gone", "law", BASE._replace(name="gone", kernel_steps=None), None),
    )
    gates = (Gate("exact", "skipped", "same sources"), Gate("time", "failed", "1 of 2"))
    sides = Side("main", "abc", "123"), Side("working tree")
    said = (Said("Half gain.", "03-regulators", "half gain"), Said("Its damping is 1 kv.", "03-regulators"))
    judgement = Judgement("mine", said, ({"law": "mine", "median s": None},), False)
    return Comparison(*sides, {"key": "cpu-2-cores"}, gates, findings, benchmarks, (judgement,))


@pytest.mark.parametrize("findings", [(), (FINDING,)])
def test_comparison_is_the_same_after_a_file(findings, tmp_path):
    comparison.write(tmp_path / "said.json", of(*findings))
    assert comparison.read(tmp_path / "said.json") == of(*findings)


@pytest.mark.parametrize(
    ("findings", "verdict"),
    [((), "clean"), ((FINDING._replace(verdict="change"),), "clean"), ((FINDING,), "regression")],
)
def test_json_names_its_schema_and_the_verdict(findings, verdict):
    said = of(*findings).as_json()
    assert said["schema"] == comparison.SCHEMA
    assert said["verdict"] == verdict


def test_json_holds_what_the_module_says_it_does():
    said = json.loads(json.dumps(of(FINDING).as_json()))
    fields = ("schema", "verdict", "base", "head", "machine", "gates", "findings", "benchmarks", "judgements")
    assert set(said) == set(fields)
    assert set(said["judgements"][0]) == {"name", "said", "beside", "is_lost"}
    assert set(said["judgements"][0]["said"][0]) == {"text", "page", "fault"}
    assert set(said["findings"][0]) == {"gate", "verdict", "name", "what", "was", "now", "says", "rows"}
    assert set(said["benchmarks"][0]) == {"name", "what", "base", "head", "time", "same_code"}
    assert set(said["benchmarks"][0]["time"]) == {"ratio", "low", "high", "p", "rounds", "verdict", "confirmed"}
    assert said["benchmarks"][0]["base"]["kernel_steps"] == [0.34, 0.33, 0.35]


def test_json_of_another_schema_is_refused_with_the_cure():
    with pytest.raises(BadResults, match=r"schema 'orientation-bench comparison 0'.*compare again"):
        comparison.from_json({**of().as_json(), "schema": "orientation-bench comparison 0"})
