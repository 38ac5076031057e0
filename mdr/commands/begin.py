"""`mdr shapes` and `mdr case`: what a file can name, and a file to begin with."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import fields
from typing import Any

from mdr.commands.output import WrongInput, answer, refusals
from mdr.files.case_files import nameable
from mdr.files.examples import LAWS, MOTIONS, PULLS, SHAKES, STILL, example, example_file
from mdr.tools.fields import facts_of
from mdr.tools.messages import offer


def add_options_of_case(command: argparse.ArgumentParser) -> None:
    """The parts of the example."""
    for option, kind, usual, meaning in (
        ("example", "shape", "Paraboloid", "its shape"),
        ("material", "model", "KelvinVoigt", "its material"),
        ("motion", "name", "NormalOscillation", ", ".join(MOTIONS)),
        ("pull", "name", "SpringPull", " or ".join(PULLS)),
        ("shake", "name", STILL, ", ".join(SHAKES)),
        ("friction", "law", "Coulomb", " or ".join(LAWS)),
    ):
        command.add_argument(f"--{option}", metavar=kind, default=usual, help=f"{meaning} (default: {usual})")


def add_options_of_shapes(command: argparse.ArgumentParser) -> None:
    """Which of them."""
    command.add_argument("name", nargs="*", help="these alone, such as Cone or Prony (default: all)")


def shapes(args: argparse.Namespace, _: None) -> int:
    """Print the shapes, materials, motions and pulls with their keys, units and meanings."""
    known = [name for records in nameable().values() for name in records]
    for one in args.name:
        if one not in known:
            raise WrongInput(f"{one!r} is no shape, material or motion; {offer(one, known)}")
    tables = {
        table: told
        for table, records in nameable().items()
        if (told := {name: _told(one) for name, one in records.items() if not args.name or name in args.name})
    }
    return answer(args, tables, "\n".join(_lines(tables)))


def case(args: argparse.Namespace, _: None) -> int:
    """Print a commented case file."""
    with refusals():
        found = example(args.example, args.material, args.motion, args.pull, args.shake, args.friction)
    return answer(args, {}, example_file(found).removesuffix("\n"), found)


def _told(record: type[Any]) -> dict[str, Any]:
    """First line of its docstring, and its keys with unit and meaning."""
    keys = {one.name: facts_of(one) for one in fields(record) if one.init}
    return {
        "is": (record.__doc__ or "").strip().splitlines()[0],
        "keys": {key: {"unit": its.unit, "meaning": its.meaning} for key, its in keys.items()},
    }


def _lines(tables: dict[str, dict[str, Any]]) -> Iterator[str]:
    for table, described in tables.items():
        yield f"[{table}]"
        for name, one in described.items():
            yield f"  {name:<20} {one['is']}"
            for key, what in one["keys"].items():
                unit = f"[{what['unit']}]" if what["unit"] else ""
                yield f"{'':23}{key:<10} {unit:<8} {what['meaning']}".rstrip()
