"""Contracts that every contender keeps, of whatever kind; a new file, and a new kind, are under them unnamed."""

import inspect
from importlib import import_module
from pathlib import Path

import pytest
from support.command_line import bench
from support.in_contact import IMPEDANCES

from bench.engines.counting.dialect import violations
from bench.law.contenders import registry
from bench.law.control import impedance
from bench.law.scalar import KERNELS

EVERY = [
    pytest.param(kind, one, id=f"{kind}-{one.name}")
    for kind in registry.FOLDERS
    for one in registry.contenders(kind).values()
]
PLAIN = {"refuses", "polynomial", "bound"}
"""Functions of a record that no loop calls."""
MADE_HERE = {"springs"}
"""Kinds that may have no source."""

on_every = pytest.mark.parametrize(("kind", "one"), EVERY)


def module_of(kind, one):
    return import_module(f"bench.law.contenders.{kind}.{one.name.replace('-', '_')}")


@on_every
def test_contender_says_what_it_is_and_where_it_is_from(kind, one):
    assert one.title
    assert one.source or kind in MADE_HERE
    assert getattr(one, "formula", "none")
    assert inspect.getdoc(module_of(kind, one))


@on_every
def test_functions_of_a_contender_are_kernels(kind, one):
    every = one._asdict()
    for part in (every.get("state"), every.get("shipped")):
        every |= part._asdict() if part else {}
    called = {field: value for field, value in every.items() if inspect.isfunction(value)}
    assert [
        field for field in called.keys() - PLAIN if not field.endswith("_in") and called[field] not in KERNELS
    ] == []


@pytest.mark.parametrize("one", registry.all_contenders(), ids=lambda one: one.name)
def test_law_in_coordinates_is_a_kernel(one):
    assert one.law in KERNELS


@pytest.mark.parametrize("one", IMPEDANCES, ids=lambda one: one.name)
def test_impedance_in_coordinates_is_a_kernel(one):
    assert impedance.law_of(one.impedance, one.representation) in KERNELS


@pytest.mark.parametrize(("kind", "one"), [pair for pair in EVERY if pair.values[0] != "shipped"])
def test_file_of_a_contender_keeps_to_the_dialect(kind, one):
    text = Path(module_of(kind, one).__file__).read_text()
    assert violations(text) == []


def test_every_contender_is_listed(capsys):
    listed = {line.split()[0] for line in bench(capsys, "list").out.splitlines() if line.strip()}
    assert {one.name for kind in registry.FOLDERS for one in registry.contenders(kind).values()} <= listed
