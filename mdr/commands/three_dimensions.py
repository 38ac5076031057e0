"""`mdr half-space`: one velocity in three dimensions. Friction with its errors, and the contact from above."""

from __future__ import annotations

import argparse

import mdr
from mdr.commands.arguments import add_velocity, whole_number
from mdr.commands.output import Exit, WrongInput, answer, complain, picked
from mdr.commands.written import add_output, output_folder, write_found
from mdr.half_space.friction import Settings
from mdr.half_space.run import LEAST, PERIODS


def add_options(command: argparse.ArgumentParser) -> None:
    """The velocity, how finely, and where to write."""
    add_velocity(command)
    add_output(command, "half_space.csv", "half_space.png", "half_space.svg")
    for name, least, most, what in (
        ("--cells", LEAST, 1000, f"cells along each side of the grid (default: {Settings.cells})"),
        ("--steps", LEAST, 100_000, f"time steps of a period (default: {Settings.steps})"),
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
    v_0 = args.v_0.on(case)
    if v_0 <= 0 and not case.is_shaken:
        raise WrongInput(f"--v-0 must be above zero, got {v_0:.6g} m/s: nothing shakes in the plane")
    folder = output_folder(args)  # before the work, not after it
    size = {"cells": args.cells, "steps_per_period": args.steps, "n_periods": args.cycles}
    found = mdr.half_space.slide(mdr.resolved(case), v_0, **size, coupled=not args.uncoupled)
    if folder is not None:
        write_found(args, folder / "half_space", found, case)
    values = picked(
        found, "v_0", "mu_0", "cof", "cof_y", "cof_error", "grid_error", "step_error", "cycle_error", "settled", "kind",
        "why", "stick_share", "mean_F_x", "mean_F_y", "mean_F_z", "coupled", "cells", "steps_per_period", "n_periods",
    )  # fmt: skip
    answer(args, values, str(found), case)
    return Exit.DONE if found.settled else complain(f"the run did not settle\n  {found.why}")
