"""`mdr run`: one velocity. Friction with its error, and what the springs do over a period as a map and a CSV file."""

from __future__ import annotations

import argparse
from dataclasses import asdict
from pathlib import Path
from typing import Any

import mdr
from mdr.commands.arguments import add_accuracy, add_velocity, whole_number
from mdr.commands.output import Exit, WrongInput, answer, complain, picked, velocity_text
from mdr.commands.velocity import equation_of
from mdr.commands.written import add_output, made_by, output_folder, require_free, write_found
from mdr.friction.cof_curve import LEAST_KNOB
from mdr.plots.animation import animate_springs


def add_options(command: argparse.ArgumentParser) -> None:
    """The velocity, how accurately, and where to write."""
    add_velocity(command)
    add_output(command, "run.csv", "run.png", "run.svg")
    add_accuracy(command, "bound on the error of the COF over mu_0 that is asked for")
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
    v_0 = args.v_0.on(case)
    if v_0 <= 0 and not case.is_shaken:
        raise WrongInput(f"--v-0 must be above zero, got {v_0:.6g} m/s: `mdr velocity` has the limit at rest")
    folder = output_folder(args)  # before the work, not after it
    if args.animate is not None:
        if args.animate.suffix != ".gif":
            raise WrongInput(f"--animate must name a file that ends in .gif, got {args.animate.name}")
        require_free([args.animate])
    knobs = {"n_springs": args.n_springs, "steps_per_period": args.steps, "accuracy": args.accuracy}
    found = mdr.slide(case, v_0, record=1, **knobs)
    if folder is not None:
        write_found(args, folder / "run", found, case)
    if args.animate is not None:
        animate_springs(found, args.animate, comment=made_by(args))
    v_c = mdr.critical_velocity(case, -1 if v_0 < 0 else 1)
    text = f"v_c = {velocity_text(v_c)} by {equation_of(case)[0]}, mu_0 = {case.mu_0:.6g}\n{found}"
    answer(args, {"v_c": v_c, **_values(found)}, text, case)
    return Exit.DONE if found.settled else complain(f"the run did not settle\n  {found.why}")


def _values(found: mdr.SlidingRun) -> dict[str, Any]:
    """The numbers of a run, without its arrays."""
    values = picked(
        found, "v_0", "mu_0", "cof", "cof_y", "cof_error", "settled", "kind", "why", "stick_share", "least_slip",
        "mean_F_x", "mean_F_y", "mean_F_z", "n_springs", "steps_per_period", "n_periods",
    )  # fmt: skip
    spent = found.energy_balance
    return values | {"energy_balance": {**asdict(spent), "residual": spent.residual}}
