"""`mdr record`: friction under a recorded motion, as a CSV file and a figure."""

from __future__ import annotations

import argparse
from dataclasses import asdict
from typing import Any

import mdr
from mdr.case.displacement import inner_part
from mdr.commands.arguments import add_reading, path_of, read_as, read_file, whole_number
from mdr.commands.output import WrongInput, answer, picked
from mdr.commands.written import add_output, make_folder, write_found
from mdr.normal.springs import MIN_SPRINGS
from mdr.tools.arrays import Array
from mdr.tools.checks import positive
from mdr.tools.notation import value_in


def add_options(command: argparse.ArgumentParser) -> None:
    """The motion, and where to write."""
    what = "columns t [s], u_x [um], u_y [um] if known, and u_z [um] or F_z [N]; or a_x, a_y, a_z"
    command.add_argument("motion", metavar="motion.csv", type=path_of, help=f"motion of the indenter: {what}")
    case = "the case file: shape, material and mu_0 count; - is standard input"
    command.add_argument("case", metavar="case.toml", type=path_of, help=case)
    command.usage = "%(prog)s motion.csv case.toml [options]"
    frequency = read_as("a frequency such as 5Hz", lambda text: positive("", value_in("", text, "Hz")))
    above = "integrate a_x, a_y, a_z [m/s²] above this frequency; a_z is about the mean depth of the case; one of its"
    above += " periods at either end of the record is uncertain and left out"
    command.add_argument("--high-pass", metavar="5Hz", type=frequency, help=above)
    size = whole_number(2 * MIN_SPRINGS)
    command.add_argument("--n-springs", metavar="n", type=size, help="springs (default: 256)")
    add_reading(command, of_time=True)
    add_output(command, "record.csv", "record.png", "record.svg")


def record(args: argparse.Namespace, _: None) -> int:
    """Follow the motion, write and print."""
    case = mdr.read_case(args.case)
    make_folder(args)
    recorded = read_file(mdr.read_record, args.motion, args)
    try:
        motion = with_displacements(recorded, args.high_pass, case)
        found = mdr.slide_record(case.indenter, case.material, case.mu_0, **motion, n_springs=args.n_springs)
    except ValueError as fault:
        raise WrongInput(f"{args.motion}: {fault}") from None
    write_found(args, found.plot, found.table(), "", mdr.write_case(case))
    values = picked(found, "mu_0", "cof", "cof_y", "cof_error", "mean_F_z", "n_springs")
    spent = found.energy_balance
    values["energy_balance"] = {**asdict(spent), "lost": spent.lost}
    whole, kept = (float(t[-1] - t[0]) for t in (recorded["t"], found.t))
    values["left_out"] = whole - kept
    ends = f"\nleft out: {whole - kept:.4g} of {whole:.4g} s, both ends, where the high-pass makes displacements "
    return answer(args, values, f"{found}{ends + 'uncertain' if kept < whole else ''}", case)


def with_displacements(record: dict[str, Array], high_pass: float | None, case: mdr.SlidingContact) -> dict[str, Any]:
    """The record with positions and depths [m] in the place of accelerations [m/s²], without the ends of these."""
    motion = {**record}
    for axis in "xyz":
        a, u = f"a_{axis}", f"u_{axis}"
        if a not in motion:
            continue
        if high_pass is None:
            raise ValueError(f"{a} is an acceleration: give the frequency above which it counts, --high-pass 5Hz")
        if u in motion or (axis == "z" and "F_z" in motion):
            raise ValueError(f"the header names {a} and {u if u in motion else 'F_z'}: leave one out")
        motion[u] = mdr.displacement_of(motion["t"], motion.pop(a), high_pass=high_pass)
        if axis == "z":
            motion[u] += mdr.resolved(case).working_depth
    if "u_x" not in motion:
        raise ValueError(
            "the header names no u_x, which no accelerometer shows; write t [s], u_x [um], u_z [um] or a_z [g]"
        )
    if motion.keys() == record.keys():
        return motion
    inner = inner_part(motion["t"], positive("high_pass", high_pass))
    return {name: values[inner] for name, values in motion.items()}
