"""`mdr shapes` and `mdr case`: what a file can name, and a file to begin with."""

from __future__ import annotations

import argparse
from typing import Any

from mdr.case import in_plane, motion
from mdr.case.in_plane import Shake
from mdr.case.motion import Motion
from mdr.commands.output import DONE, WrongInput, print_json


def add_options(command: argparse.ArgumentParser) -> None:
    """The parts of the example."""
    command.add_argument("--example", default="Paraboloid", metavar="shape", help="its shape (default: Paraboloid)")
    command.add_argument(
        "--material", default="KelvinVoigt", metavar="model", help="its material (default: KelvinVoigt)"
    )
    motions = ", ".join(name for name in motion.__all__ if name != Motion.__name__)
    command.add_argument(
        "--motion", default="NormalOscillation", metavar="name", help=f"{motions} (default: NormalOscillation)"
    )
    command.add_argument(
        "--pull", default="SpringPull", metavar="name", help="SpringPull or RigidPull (default: SpringPull)"
    )
    shakes = ", ".join(name for name in in_plane.__all__ if name != Shake.__name__)
    command.add_argument("--shake", default="none", metavar="name", help=f"{shakes} (default: none)")


def shapes(args: argparse.Namespace, _: None) -> int:
    """Print the shapes, materials, motions and pulls with their keys, units and meanings."""
    tables = _tables()
    if args.json:
        return print_json(args, tables)
    for table, described in tables.items():
        print(f"[{table}]")
        for name, one in described.items():
            print(f"  {name:<20} {one['is']}")
            for key, what in one["keys"].items():
                unit = f"[{what['unit']}]" if what["unit"] else ""
                print(f"{'':23}{key:<10} {unit:<8} {what['meaning']}".rstrip())
    return DONE


def case(args: argparse.Namespace, _: None) -> int:
    """Print a commented case file."""
    from mdr.files.examples import example, example_file

    try:
        found = example(args.example, args.material, args.motion, args.pull, args.shake)
    except ValueError as fault:
        raise WrongInput(str(fault)) from None
    if args.json:
        return print_json(args, {}, found)
    print(example_file(found), end="")
    return DONE


def _tables() -> dict[str, dict[str, Any]]:
    """{table of a file: {name: {"is": first line of its docstring, "keys": {key: {"unit", "meaning"}}}}}."""
    from dataclasses import fields

    from mdr.files.case_files import nameable
    from mdr.tools.fields import facts_of

    def told(record: type[Any]) -> dict[str, Any]:
        keys = {one.name: facts_of(one) for one in fields(record) if one.init}
        return {
            "is": (record.__doc__ or "").strip().splitlines()[0],
            "keys": {key: {"unit": its.unit, "meaning": its.meaning} for key, its in keys.items()},
        }

    return {table: {name: told(one) for name, one in records.items()} for table, records in nameable().items()}
