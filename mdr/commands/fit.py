"""`mdr fit`: parameters of a case from measured friction over velocity, as a table, a case file and a figure."""

from __future__ import annotations

import argparse
from functools import partial
from typing import Any

import mdr
from mdr.case.paths import facts_at
from mdr.commands.arguments import (
    add_limit,
    add_reading,
    each_once,
    path_of,
    plain_number,
    read_as,
    read_file,
    velocity,
)
from mdr.commands.output import WrongInput, answer, picked, refusals, status_of, stopped_by_signals
from mdr.commands.written import add_output, make_folder, write_found
from mdr.friction.fit import Fit
from mdr.given.case_file import Said
from mdr.tools.notation import value_in


def add_options_of_fit(command: argparse.ArgumentParser) -> None:
    """The data, what is fitted to them, and where to write."""
    columns = "measured friction: columns v_0 [mm/s], cof and, if known, error"
    command.add_argument("data", metavar="data.csv", type=path_of, help=columns)
    command.usage = "%(prog)s case.toml data.csv --free name [name ...] [options]"
    what = "parameters to fit, such as mu_0 material.tau; the case says where the search begins"
    command.add_argument("--free", metavar="name", nargs="+", required=True, help=what)
    bounds = read_as("name=low:high, such as material.tau=1e-5:1e-1", _bounds)
    between = "lowest and highest value of a parameter: material.tau=10us:0.1s"
    command.add_argument("--bounds", metavar="name=low:high", nargs="+", type=bounds, default=[], help=between)
    share = plain_number("-", "a share, such as 95% or 0.95")
    level = "level of the intervals (default: 0.95)"
    command.add_argument("--confidence", metavar="share", type=share, default=0.95, help=level)
    add_limit(command, "values")
    over = "velocity of all rows, of friction over du_x, du_y, du_z, u_z0, load or frequency: columns du_x [um], cof"
    command.add_argument("--v-0", metavar="velocity", type=velocity, help=over)
    track = plain_number("m", "a length such as 12mm")
    command.add_argument("--radius", metavar="12mm", type=track, help="of the track, where the velocity is in rpm")
    add_reading(command)
    add_output(command, "fitted.toml", "fit.png", "fit.svg")


def fit(args: argparse.Namespace, asked: Said) -> int:
    """Fit, write and print."""
    make_folder(args)
    if args.v_0 is not None and args.v_0.of:
        raise WrongInput("--v-0 is the velocity at which was measured: give it in m/s")
    of_data = {"v_0": None if args.v_0 is None else args.v_0.number, "radius": args.radius}
    data = read_file(partial(mdr.read_friction_data, **of_data), args.data, args)
    with refusals():
        knobs = {"bounds": each_once(args.bounds), "confidence": args.confidence, "held": asked.held}
        with stopped_by_signals():
            found = mdr.fit(asked.case, data, args.free, limit_s=args.limit, **knobs)
    answer(args, _told(found), str(found), found.case)
    write_found(args, found.plot, mdr.write_case(found.case), str(found))
    return status_of(found.stopped)


def _told(found: Fit) -> dict[str, Any]:
    """What JSON says: no interval of what is not determined."""
    parameters = {}
    for name, value in found.values.items():
        known = name not in found.undetermined
        ends = {"low": found.low[name] if known else None, "high": found.high[name] if known else None}
        parameters[name] = {"value": value, **ends, "unit": found.units[name] or "-", "determined": known}
    values = {
        "parameters": parameters,
        **picked(found, "confidence", "rms", "correlation", "warnings", "cof_error", "stopped"),
    }
    return {**values, **picked(found.data, "v_0", "cof"), "residuals": found.residuals}


def _bounds(text: str) -> tuple[str, tuple[float, float]]:
    name, _, ends = text.partition("=")
    low, high = (value_in(name, end, facts_at(name).unit) for end in ends.split(":"))
    return name, (low, high)
