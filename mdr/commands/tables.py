"""`mdr indenter`, `mdr material` and `mdr motion`: what was measured, from a CSV file, as a table of a case file."""

from __future__ import annotations

import argparse
import math
from functools import partial
from typing import Any

import mdr
from mdr.commands.arguments import add_reading, path_of, plain_number, read_file, whole_number
from mdr.commands.output import WrongInput, answer, refusals
from mdr.files.case_files import write_table
from mdr.tools.notation import value_in

#: options of heights and of forces: the unit in either, "" of a word, None where it says nothing; and the meaning
OPTIONS: dict[str, tuple[str | None, str | None, str]] = {
    "smoothing": ("m", "N", "standard deviation of the noise of the heights, 14nm, or of the forces, 2uN"),
    "tip": ("", "", "of heights round or sharp, of forces any, round, sharp or flat"),
    "pitch": ("m", None, "step from height to height of one column, in the place of r: 2um"),
    "apex": ("m", None, "place of the tip in the scan (default: 0)"),
    "side": ("", None, "of the tip: both, left or right"),
    "kinks": ("m", None, "radii of edges"),
    "flip": ("", None, "the tip was measured pointing up"),
    "part": (None, "", "approach or retract; of several 'approach 2'"),
    "touch": (None, "m", "reading of the depth at first touch (default: found)"),
    "baseline": (None, "N", "force before the touch (default: found)"),
    "spring_constant": (None, "N/m", "stiffness of the cantilever, where heights of its piezo are given: 2N/m"),
}
SOURCES: dict[str, tuple[Any, Any]] = {
    "moduli": (mdr.read_moduli, mdr.Prony.fit),
    "relaxation": (mdr.read_relaxation, mdr.Prony.fit_relaxation),
    "creep": (mdr.read_creep, mdr.Prony.fit_creep),
}


def add_options_of_indenter(command: argparse.ArgumentParser) -> None:
    """The file, and what it does not say."""
    what = "heights along a line, columns r [um], f [nm]; with --E-star normal force over depth, d [um], F [mN]"
    command.add_argument("measured", metavar="scan.csv", type=path_of, help=what)
    command.usage = "%(prog)s scan.csv [options] > table.toml"
    modulus = plain_number("Pa", "a modulus such as 4MPa")
    pressed = "contact modulus of the body that was pressed: 4MPa"
    command.add_argument("--E-star", metavar="modulus", type=modulus, help=pressed)
    for name, (*_, meaning) in OPTIONS.items():
        flag: dict[str, Any] = {"action": "store_true", "default": None}
        how = flag if name == "flip" else {"nargs": "+" if name == "kinks" else None, "metavar": name}
        command.add_argument(f"--{name.replace('_', '-')}", help=meaning, **how)
    add_reading(command)
    command.epilog = "The table [indenter] goes into a case file."


def indenter(args: argparse.Namespace, _: None) -> int:
    """Print the table [indenter] of measured heights or forces."""
    is_force = args.E_star is not None
    given: dict[str, Any] = {"E_star": args.E_star} if is_force else {}
    for name, (of_heights, of_forces, _meaning) in OPTIONS.items():
        value, unit = getattr(args, name), of_forces if is_force else of_heights
        if value is not None and unit is None:
            option, of = name.replace("_", "-"), "heights" if is_force else "forces, which need --E-star"
            raise WrongInput(f"--{option} is of {of}: leave it out")
        if value is not None:
            given[name] = _value(name, value, unit) if unit else value
    read = mdr.FromForce.read if is_force else mdr.SampledProfile.read
    with refusals():
        found = read_file(partial(read, **given), args.measured, args)
    values = {"shape": type(found).__name__, "max_radius": found.max_radius}
    return _table(args, "indenter", found, values, f"known up to a radius of {found.max_radius:.6g} m")


def _value(name: str, text: str | list[str], unit: str) -> Any:
    try:
        return value_in(name, text, unit) if isinstance(text, str) else [value_in(name, one, unit) for one in text]
    except ValueError as wrong:
        raise WrongInput(f"--{wrong}") from None


def add_options_of_material(command: argparse.ArgumentParser) -> None:
    """The file, what it holds, and what it does not say."""
    what = "dynamic moduli over frequency, columns f [Hz], E' [MPa], E'' [MPa]; or what --of names"
    command.add_argument("measured", metavar="moduli.csv", type=path_of, help=what)
    command.usage = "%(prog)s moduli.csv --nu 0.5 [options] > table.toml"
    ratio = plain_number("-", "Poisson's ratio such as 0.5")
    command.add_argument("--nu", metavar="ratio", type=ratio, required=True, help="Poisson's ratio")
    command.add_argument("--of", choices=[*SOURCES, "arms"], default="moduli", help="what the file holds")
    arms = "Maxwell arms of the fit (default: two a decade of moduli, three of a step)"
    command.add_argument("--n-arms", metavar="n", type=whole_number(1), help=arms)
    degrees = plain_number("", "a temperature in degC such as 20")
    command.add_argument("--temperature", metavar="degC", type=degrees, help="of moduli at several, those at this one")
    of_shift = plain_number("", "a number such as 17.4")
    shift = "constants C1 and C2 [K] of Williams, Landel and Ferry about --temperature, to which all rows are shifted"
    command.add_argument("--wlf", metavar=("C1", "C2"), nargs=2, type=of_shift, help=shift)
    modulus = plain_number("Pa", "a modulus such as 4MPa")
    command.add_argument("--E-0", metavar="modulus", type=modulus, help="of arms that are shares: instantaneous E")
    command.add_argument("--G-0", metavar="modulus", type=modulus, help="the same in shear")
    add_reading(command)
    command.epilog = "The table [material] goes into a case file."


def material(args: argparse.Namespace, _: None) -> int:
    """Print the table [material] of measured moduli, relaxation or creep, or of a table of arms."""
    taken = {"moduli": ("n_arms", "temperature", "wlf"), "arms": ("E_0", "G_0")}.get(args.of, ("n_arms",))
    for name in ("n_arms", "temperature", "wlf", "E_0", "G_0"):
        if getattr(args, name) is not None and name not in taken:
            raise WrongInput(f"--{name.replace('_', '-')} says nothing of {args.of}: leave it out")
    missed: float | None = None
    with refusals():
        if args.of == "arms":
            found = read_file(partial(mdr.Prony.read, nu=args.nu, E_0=args.E_0, G_0=args.G_0), args.measured, args)
        else:
            reader, fit = SOURCES[args.of]
            at = {"temperature": args.temperature, "wlf": args.wlf} if args.of == "moduli" else {}
            data = read_file(partial(_sheared, reader, args.nu, **at), args.measured, args)
            found = fit(*data, nu=args.nu, n_arms=args.n_arms)
            missed = found.misfit(*data) if args.of == "moduli" else None
    said = "" if missed is None else f", {100 * missed:.2g} % off the data at most"
    return _table(args, "material", found, {"misfit": missed}, f"{len(found.arms)} arms{said}")


def add_options_of_motion(command: argparse.ArgumentParser) -> None:
    """The record, the depth that it does not tell, and its frequency."""
    record = "what a sensor recorded over three periods or more: columns t [s] and a_z [g], v_z [mm/s] or u_z [um]"
    command.add_argument("measured", metavar="shaker.csv", type=path_of, help=record)
    command.usage = "%(prog)s shaker.csv --u-z0 depth [options] > table.toml"
    depth = plain_number("m", "a depth such as 20um")
    command.add_argument("--u-z0", metavar="depth", type=depth, required=True, help="mean depth: 20um")
    known = plain_number("Hz", "a frequency such as 80Hz")
    command.add_argument("--frequency", metavar="80Hz", type=known, help="fundamental (default: it is found)")
    add_reading(command, of_time=True)
    command.epilog = 'The table [oscillation] goes into a case file, where load = "5 N" may stand in the place of u_z0.'
    command.epilog += " Positive a_z, v_z and u_z point into the half-space."


def motion(args: argparse.Namespace, _: None) -> int:
    """Print the table [oscillation] of the recorded motion."""
    made = mdr.PeriodicMotion
    with refusals():
        record = read_file(mdr.read_record, args.measured, args)
        of = {"a_z": made.from_acceleration, "v_z": made.from_velocity, "u_z": made.from_displacement}
        names = [name for name in of if name in record]
        if len(names) != 1:
            what = f"both {' and '.join(names)}: leave one out" if names else f"none of {', '.join(of)}"
            raise WrongInput(f"{args.measured}: the header names {what}, which tell the motion into the half-space")
        (name,) = names
        found = of[name](record["t"], record[name], u_z0=args.u_z0, frequency=args.frequency)
    told = (found.u_z, found.u_z_dot, found.u_z_ddot)["uva".index(name[0])](record["t"])
    rest = float((record[name] - told).std() / record[name].std())
    values = {"omega": found.omega, "du_z": found.cycle.du_z, "u_z0": args.u_z0, "cos": found.cos, "sin": found.sin}
    head = f"{found.omega / (2 * math.pi):.6g} Hz, {len(found.cos)} harmonics, amplitude {found.cycle.du_z:.6g} m; "
    return _table(
        args, "oscillation", found, {**values, "left_out": rest}, f"{head}{rest:.2g} of {name} (rms) left out"
    )


def _table(args: argparse.Namespace, name: str, record: Any, values: dict[str, Any], said: str) -> int:
    """Print a table below what there is to say of it."""
    table = write_table(name, record)
    return answer(args, {**values, "table": table}, f"# {said}\n{table}")


def _sheared(reader: Any, nu: float, path: str, **given: Any) -> Any:
    """What a reader makes of a file; Poisson's ratio, which the material has anyway, goes to it of shear alone."""
    try:
        return reader(path, **given)
    except ValueError as refusal:
        if "give nu=" not in str(refusal):
            raise
    return reader(path, nu=nu, **given)
