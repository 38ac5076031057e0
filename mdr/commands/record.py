"""`mdr record`: friction under a recorded motion, as a CSV file and a figure."""

from __future__ import annotations

import argparse
from dataclasses import asdict, replace
from functools import partial
from typing import Any

import mdr
from mdr.case.displacement import inner_part
from mdr.case.domain import NO_STRENGTH, Domain
from mdr.commands.arguments import add_reading, path_of, plain_number, read_file, velocity, whole_number
from mdr.commands.output import Exit, WrongInput, answer, picked
from mdr.commands.written import add_output, make_folder, write_found
from mdr.normal.springs import MIN_SPRINGS
from mdr.tools.arrays import Array
from mdr.tools.checks import positive


def add_options_of_record(command: argparse.ArgumentParser) -> None:
    """The motion, and where to write."""
    what = "columns t [s], u_x [um], u_y [um] if known, and u_z [um] or F_z [N]; or a_x, v_x and so on"
    command.add_argument("motion", metavar="motion.csv", type=path_of, help=f"motion of the indenter: {what}")
    case = "the case file: shape, material, mu_0 and mean depth count, and no [pull]; - is standard input"
    command.add_argument("case", metavar="case.toml", type=path_of, help=case)
    command.usage = "%(prog)s motion.csv case.toml [options]"
    frequency = plain_number("Hz", "a frequency such as 5Hz", partial(positive, ""))
    above = (
        "integrate a_x, v_x and so on above this frequency; a_z, v_z are about the mean depth of the case; one of its"
    )
    above += " periods at either end of the record is uncertain and left out"
    command.add_argument("--high-pass", metavar="5Hz", type=frequency, help=above)
    pulled = "velocity of a steady pull along x: 10mm/s, 0.5v_c; added to what a_x tells, in the place of u_x"
    command.add_argument("--v-0", metavar="velocity", type=velocity, help=pulled)
    size = whole_number(2 * MIN_SPRINGS)
    command.add_argument("--n-springs", metavar="n", type=size, help="springs (default: 256)")
    add_reading(command, of_time=True)
    add_output(command, "record.csv", "record.png", "record.svg")


def record(args: argparse.Namespace, _: None) -> int:
    """Follow the motion, write and print."""
    case = mdr.read_case(args.case)
    Domain((NO_STRENGTH,), "mdr run or mdr curve").seen(case, "slide_record")
    make_folder(args)
    recorded = read_file(mdr.read_record, args.motion, args)
    try:
        rigid = replace(case, pull=mdr.RigidPull())  # the record is the way of the indenter itself
        motion = with_displacements(recorded, args.high_pass, case, args.v_0 and args.v_0.on(rigid))
        mu_s = case.friction.stick * case.mu_0
        found = mdr.slide_record(case.indenter, case.material, case.mu_0, **motion, n_springs=args.n_springs, mu_s=mu_s)
    except ValueError as fault:
        raise WrongInput(f"{args.motion}: {fault}") from None
    values = picked(found, "mu_0", "cof", "cof_y", "cof_error", "late_cof", "loss_cof", "mean_F_z", "n_springs")
    spent = found.energy_balance
    values["energy_balance"] = {**asdict(spent), "lost": spent.lost}
    whole, kept = (float(t[-1] - t[0]) for t in (recorded["t"], found.t))
    values["left_out"] = whole - kept
    pull = "" if case.pull.is_rigid else "\nwithout [pull]: a record is the way of the indenter itself, held rigidly"
    ends = f"\nleft out: {whole - kept:.4g} of {whole:.4g} s, both ends, where the high-pass makes displacements "
    answer(args, values, f"{found}{pull}{ends + 'uncertain' if kept < whole else ''}", case)
    write_found(args, found.plot, found.table(), "", mdr.write_case(case))
    return Exit.DONE


def with_displacements(
    record: dict[str, Array], high_pass: float | None, case: mdr.SlidingContact, v_0: float | None
) -> dict[str, Any]:
    """The record with positions and depths [m] in the place of accelerations and velocities, without the ends of
    these, and with the way of a steady pull at v_0 [m/s].
    """
    motion = {**record}
    if v_0 is not None and "u_x" in motion:
        raise ValueError("the header names u_x, which is the whole way along the pull: leave --v-0 out")
    for name in [one for one in record if one[0] in "av"]:
        axis = name[-1]
        u = f"u_{axis}"
        if high_pass is None:
            what = "an acceleration" if name[0] == "a" else "a velocity"
            raise ValueError(f"{name} is {what}: give the frequency above which it counts, --high-pass 5Hz")
        others = (u, "F_z") if axis == "z" else (u,)
        if other := next((one for one in (*others, f"v_{axis}") if one in record and one != name), None):
            raise ValueError(f"the header names {name} and {other}: leave one out")
        order = 2 if name[0] == "a" else 1
        motion[u] = mdr.displacement_of(motion["t"], motion.pop(name), high_pass=high_pass, order=order)
        if axis == "z":
            motion[u] += mdr.resolved(case).working_depth
    if not motion.keys() & {"u_z", "F_z"}:
        raise ValueError(
            "the header names no depth: one of a_z [m/s2], v_z [mm/s], u_z [um] or F_z [N] tells how it is pressed"
        )
    if v_0 is not None:
        motion["u_x"] = motion.get("u_x", 0.0) + v_0 * (motion["t"] - motion["t"][0])
    if "u_x" not in motion:
        raise ValueError(
            "the header names no u_x, which no accelerometer shows; give the velocity of the pull, --v-0 10mm/s, or "
            "write t [s], u_x [um], u_z [um] or a_z [g]"
        )
    if not any(name[0] in "av" for name in record):
        return motion
    inner = inner_part(motion["t"], positive("high_pass", high_pass))
    return {name: values[inner] for name, values in motion.items()}
