"""`mdr run` and `mdr half-space`: one velocity, by springs or in three dimensions. Friction with its errors, and what
sticks and slips over a period as a picture and a CSV file.
"""

from __future__ import annotations

import argparse
from dataclasses import asdict
from pathlib import Path
from typing import Any

import mdr
from mdr.commands.arguments import add_accuracy, add_velocity, whole_number
from mdr.commands.output import Exit, WrongInput, answer, complain, picked
from mdr.commands.velocity import v_c_text
from mdr.commands.written import add_output, made_by, make_folder, require_free, write_found, writing
from mdr.friction.cof_curve import LEAST_KNOB
from mdr.half_space.friction import Settings
from mdr.half_space.run import LEAST_CELLS, PERIODS


def add_options_of_run(command: argparse.ArgumentParser) -> None:
    """The velocity, how accurately, and where to write."""
    add_velocity(command)
    add_output(command, "run.csv", "run.png", "run.svg")
    add_accuracy(command, "bound on the error of the COF that is asked for, as a share of full friction")
    meaning = "write a moving picture of the springs over the last period to this file, which ends in .gif"
    command.add_argument("--animate", metavar="springs.gif", type=Path, help=meaning)
    size = whole_number(LEAST_KNOB)
    command.add_argument("--n-springs", metavar="n", type=size, help="springs (default: as the accuracy needs)")
    command.add_argument("--steps", metavar="n", type=size, help="time steps of a period (default: likewise)")
    command.epilog = (
        "run.csv has the forces over the last period; run.png and run.svg the springs that stick and slip: a row for"
        " each spring by its place x, a colour for each state, time in periods from the deepest instant; below, the"
        " forces."
    )


def run(args: argparse.Namespace, case: mdr.SlidingContact) -> int:
    """Run, write and print; status 1 if the run did not settle."""
    from mdr.plots.animation import animate_springs

    v_0 = _velocity(args, case, "`mdr velocity` has the limit at rest")
    if args.animate is not None:
        if args.animate.suffix != ".gif":
            raise WrongInput(f"--animate must name a file that ends in .gif, got {args.animate.name}")
        require_free([args.animate])
    knobs = {"n_springs": args.n_springs, "steps_per_period": args.steps, "accuracy": args.accuracy}
    found = mdr.slide(case, v_0, record=1, **knobs)
    v_c, spent = mdr.critical_velocity(case, -1 if v_0 < 0 else 1), found.energy_balance
    text = f"{v_c_text(case, v_c)}, mu_0 = {case.mu_0:.6g}\n{found}"
    values = picked(
        found, "v_0", "mu_0", "full_cof", "cof", "share", "cof_y", "cof_error", "settled", "kind", "why", "stick_share",
        "least_slip", "mean_F_x", "mean_F_y", "mean_F_z", "power", "n_springs", "steps_per_period", "n_periods",
    )  # fmt: skip
    balance = {**asdict(spent), "residual": spent.residual}
    status = _end(args, found, {"v_c": v_c, **values, "energy_balance": balance}, text, case)
    if args.animate is not None:
        with writing(args.animate):
            animate_springs(found, args.animate, comment=made_by(args))
    return status


def add_options_of_half_space(command: argparse.ArgumentParser) -> None:
    """The velocity, how finely, and where to write."""
    add_velocity(command)
    add_output(command, "half_space.csv", "half_space.png", "half_space.svg")
    for name, least, most, what in (
        ("--cells", LEAST_CELLS, 1000, f"cells along each side of the grid (default: {Settings.cells})"),
        ("--steps", LEAST_CELLS, 100_000, f"time steps of a period (default: {Settings.steps})"),
        ("--cycles", 1, 100_000, f"periods (default: until friction has settled, {PERIODS} at most)"),
    ):
        command.add_argument(name, metavar="n", type=whole_number(least, most), help=what)
    command.add_argument("--uncoupled", action="store_true", help="leave out normal-tangential coupling, as springs do")
    command.epilog = (
        "Takes a rigid pull and an elastic or Kelvin material, also shaken along or across the pull; some ten seconds."
        " half_space.csv has the forces over the last period; half_space.png and half_space.svg the contact from above"
        " at four instants: pressure, traction, and what sticks and slips. Times count from the least depth."
    )


def half_space(args: argparse.Namespace, case: mdr.SlidingContact) -> int:
    """Run, write and print; status 1 if the run did not settle."""
    v_0 = _velocity(args, case, "nothing shakes in the plane")
    size = {"cells": args.cells, "steps_per_period": args.steps, "n_periods": args.cycles}
    found = mdr.half_space.slide(mdr.resolved(case), v_0, **size, coupled=not args.uncoupled)
    values = picked(
        found, "v_0", "mu_0", "cof", "cof_y", "cof_error", "grid_error", "step_error", "cycle_error", "settled", "kind",
        "why", "stick_share", "mean_F_x", "mean_F_y", "mean_F_z", "coupled", "cells", "steps_per_period", "n_periods",
    )  # fmt: skip
    return _end(args, found, values, str(found), case)


def _velocity(args: argparse.Namespace, case: mdr.SlidingContact, why: str) -> float:
    """The velocity [m/s] asked for, and the folder made, before the work; why: what is said of none."""
    v_0: float = args.v_0.on(case)
    if v_0 <= 0 and not case.is_shaken:
        raise WrongInput(f"--v-0 must be above zero, got {v_0:.6g} m/s: {why}")
    make_folder(args)
    return v_0


def _end(args: argparse.Namespace, found: Any, values: dict[str, Any], text: str, case: mdr.SlidingContact) -> int:
    """Write and print; status 1 if the run did not settle."""
    answer(args, values, text, case)
    write_found(args, found.plot, found.table(), "", mdr.write_case(case))
    return Exit.DONE if found.settled else complain(f"the run did not settle\n  {found.why}")
