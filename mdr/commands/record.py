"""`mdr record`: friction under a recorded motion, as a CSV file and a figure."""

from __future__ import annotations

import argparse
from dataclasses import asdict
from typing import Any

import mdr
from mdr.commands.arguments import path_of, whole_number
from mdr.commands.output import WrongInput, answer, picked
from mdr.commands.written import add_output, output_folder, write_figure, write_text
from mdr.files.measurements import read_motion
from mdr.files.toml_text import StandardInput
from mdr.normal.springs import MIN_SPRINGS


def add_options(command: argparse.ArgumentParser) -> None:
    """The motion, and where to write."""
    columns = "motion of the indenter: columns t [s], u_x [um], u_y [um] if known, and u_z [um] or F_z [N]"
    command.add_argument("motion", metavar="motion.csv", type=path_of, help=columns)
    case = "the case file: shape, material and mu_0 count; - is standard input"
    command.add_argument("case", metavar="case.toml", type=path_of, help=case)
    command.usage = "%(prog)s motion.csv case.toml [options]"
    size = whole_number(2 * MIN_SPRINGS)
    command.add_argument("--n-springs", metavar="n", type=size, help="springs (default: 256)")
    add_output(command, "record.csv", "record.png", "record.svg")


def record(args: argparse.Namespace, _: None) -> int:
    """Follow the motion, write and print."""
    if isinstance(args.motion, StandardInput) and isinstance(args.case, StandardInput):
        raise WrongInput("- stands for the motion and for the case: standard input can be read once, give a file")
    case, folder = mdr.read_case(args.case), output_folder(args)
    try:
        motion: dict[str, Any] = read_motion(args.motion)
        found = mdr.slide_record(case.indenter, case.material, case.mu_0, **motion, n_springs=args.n_springs)
    except ValueError as fault:
        raise WrongInput(f"{args.motion}: {str(fault).removeprefix(f'{args.motion}: ')}") from None
    if folder is not None:
        write_text(args, folder / "record.csv", found.table(), "", mdr.write_case(case))
        write_figure(args, folder / "record", found.plot)
    values = picked(found, "mu_0", "cof", "cof_y", "cof_error", "mean_F_z", "n_springs")
    spent = found.energy_balance
    values["energy_balance"] = {**asdict(spent), "lost": spent.lost}
    return answer(args, values, str(found), case)
