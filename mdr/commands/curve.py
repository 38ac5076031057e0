"""`mdr curve`: coefficient of friction over pulling velocity, as a table, a CSV file and a figure."""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator

import numpy as np

import mdr
from mdr.case.domain import domain_of
from mdr.closed_forms.critical_velocity import POINTS, UP_TO, velocity_scale
from mdr.commands.arguments import OF_V_C, Asked, add_accuracy, no_scale, velocity, whole_number
from mdr.commands.output import Exit, WrongInput, answer, complain, picked, text_of, values_of
from mdr.commands.velocity import ends_of, v_c_text
from mdr.commands.written import add_output, make_folder, write_found
from mdr.tools.arrays import EXACT


def add_options_of_curve(command: argparse.ArgumentParser) -> None:
    """Where to write, and over which velocities."""
    add_output(command, "curve.csv", "curve.png", "curve.svg")
    add_accuracy(command, "bound on the error of the COF that is asked for, as a share of full friction")
    points = whole_number(2)
    command.add_argument("--points", metavar="n", type=points, help=f"how many velocities (default: {POINTS})")
    which = command.add_mutually_exclusive_group()
    highest = f"highest velocity: 5e-3 [m/s], 5mm/s, 1.5v_c (default: {UP_TO:g}v_c; less with tau_0)"
    which.add_argument("--up-to", metavar="velocity", type=velocity, help=highest)
    listed = "these velocities, in m/s, with a unit or over the v_c of their way: 1e-3 2mm/s 0.5v_c"
    which.add_argument("--v-0", metavar="velocity", type=velocity, nargs="+", help=listed)
    command.epilog = "The curve begins at zero velocity; of a contact shaken in the plane, at --up-to the other way."


def curve(args: argparse.Namespace, case: mdr.SlidingContact) -> int:
    """Compute the curve, write and print it; status 1 if a run did not settle."""
    velocities = _velocities(args, case)
    make_folder(args)
    found = mdr.cof_curve(case, velocities, accuracy=args.accuracy)
    ends = ends_of(case)
    back = ["v_c_back"] if case.is_shaken else []
    values = picked(found, "v_c", "mu_0", "static_cof", *back) | values_of(ends)
    values |= picked(found, "v_0", "cof", "cof_y", "cof_error", "settled", "stick_share", "why")
    head = v_c_text(case, found.v_c, found.v_c_back)
    text = "\n".join([*_lines(found, head), *([text_of(ends)] if ends else [])])
    answer(args, values, text, case)
    write_found(args, found.plot, found.table(), "", mdr.write_case(case))
    loose = [why for why, settled in zip(found.why, found.settled, strict=True) if not settled]
    if not loose:
        return Exit.DONE
    reasons = "".join(f"\n  {why}" for why in dict.fromkeys(loose) if why)
    return complain(f"{len(loose)} of {found.v_0.size} runs did not settle{reasons}")


def _velocities(args: argparse.Namespace, case: mdr.SlidingContact) -> list[float]:
    """The velocities [m/s] asked for; says what their scale is where there is no v_c."""
    if args.v_0 is not None:
        if args.points is not None:
            raise WrongInput("--points is for --up-to; --v-0 names every velocity")
        given = [one.on(case) for one in args.v_0]
        if min(given) < 0 and not case.is_shaken:
            raise WrongInput(f"--v-0 must not be negative, got {min(given):.6g} m/s: nothing shakes in the plane")
        return given
    asked = args.up_to or Asked(UP_TO, OF_V_C)
    if asked.number <= 0:
        raise WrongInput(f"--up-to must be above zero, got {asked.number:.6g}")
    if asked.of and (wrong := no_scale(mdr.critical_velocity(case))):
        complain(f"{wrong}: velocities are multiples of {velocity_scale(case):.6g} m/s in its place")
    of = _v_c_or_scale if args.up_to else velocity_scale
    forward, back = (asked.number * (of(one) if asked.of else 1) for one in (case, case.mirrored))
    found = np.linspace(-back if case.is_shaken else 0.0, forward, args.points or POINTS)
    found[np.abs(found) < EXACT * forward] = 0.0  # the limit at rest, and not a pull of a rounding
    if case not in domain_of(mdr.static_cof):
        found = found[found != 0]
    return list(map(float, found))


def _v_c_or_scale(case: mdr.SlidingContact) -> float:
    """v_c [m/s], or what stands in its place where it is infinite or zero."""
    v_c = mdr.critical_velocity(case)
    return velocity_scale(case) if no_scale(v_c) else v_c


def _lines(curve: mdr.CofCurve, head: str) -> Iterator[str]:
    """The curve as a table, below what its head says of v_c."""
    static = "static COF" if curve.v_c_back is None else "COF as v_0 -> +0"
    known = "not known" if curve.static_cof is None else f"{curve.static_cof:.6g}"
    yield f"{head}, mu_0 = {curve.mu_0:.6g}, {static} = {known}"
    cof_y = [""] * curve.v_0.size if curve.cof_y is None else [f"{round(one, 6) + 0.0:17.6f}" for one in curve.cof_y]
    across = "" if curve.cof_y is None else "  COF across"
    over = "COF/mu_0" if curve.full_cof == curve.mu_0 else "share"
    yield f"{'v_0 [m/s]':>12} {'v_0/v_c':>8} {'COF':>10} {over:>9} {'error':>8} {'stick':>6}  settled{across}"
    columns = (curve.v_0, curve.cof, curve.cof_error, curve.stick_share, curve.settled, cof_y)
    for v_0, cof, error, stick, settled, aside in zip(*columns, strict=True):
        v_c = curve.v_c_back if v_0 < 0 and curve.v_c_back is not None else curve.v_c  # of the way it is pulled
        ratio = f"{v_0 / v_c:8.4f}" if math.isfinite(v_c) and v_c > 0 else f"{'-':>8}"
        end = ("yes" if settled else "no ") + aside
        yield f"{v_0:12.6g} {ratio} {cof:10.6f} {cof / curve.full_cof:9.6f} {error:8.1e} {stick:6.3f}  {end}".rstrip()
