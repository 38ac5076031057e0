"""`mdr design` and `mdr front`: numbers of a case in ranges, with which friction, v_c and power are within limits."""

from __future__ import annotations

import argparse

import mdr
from mdr.case.paths import RIG
from mdr.commands.arguments import OF_MU_0, add_limit, each_once, quantity, read_as, velocity, whole_number
from mdr.commands.output import answer, picked, refusals, status_of, stopped_by_signals
from mdr.commands.written import add_output, make_folder, write_found, write_text
from mdr.files.case_files import written
from mdr.given.case_file import Said
from mdr.given.vary import still_held

#: options, the limits that they are, what they read, and what they say
LIMITS = {
    "--cof": ("cof_at_most", quantity("a COF", "-", OF_MU_0), "friction", "friction at most: 0.25, 0.5mu_0"),
    "--cof-at-least": ("cof_at_least", quantity("a COF", "-", OF_MU_0), "friction", "friction at least"),
    "--up-to": ("up_to", velocity, "velocity", "velocity up to which friction and power hold: 5mm/s"),
    "--v-c": ("v_c_at_least", velocity, "velocity", "critical velocity at least"),
    "--no-load": ("no_load_velocity_at_least", velocity, "velocity", "velocity without load at least, shaken along"),
    "--power": ("power_at_most", quantity("a power", "W"), "power", "power of the drives at most: 3W, 20mW"),
}


def _range(text: str) -> tuple[str, tuple[str, str]]:
    """A path and the two ends of its range."""
    path, equals, given = text.partition("=")
    low, colon, high = given.partition(":")
    if not (path and equals and colon and low and high):
        raise ValueError
    return path, (low, high)


def _add_free(command: argparse.ArgumentParser) -> None:
    """The numbers that may change, and the end of the search."""
    known = "numbers that may change, each with its range, such as du_z=0.1um:2um frequency=100Hz:20kHz"
    read = read_as("path=low:high, such as du_z=0.1um:2um", _range)
    command.add_argument(
        "--free", metavar="path=low:high", action="extend", nargs="+", required=True, type=read, help=known
    )
    add_limit(command, "designs")


def add_options_of_design(command: argparse.ArgumentParser) -> None:
    """The limits, the ranges, and where to write."""
    for option, (name, read, metavar, meaning) in LIMITS.items():
        command.add_argument(option, dest=name, metavar=metavar, type=read, help=meaning)
    command.usage = "%(prog)s case.toml --free path=low:high [...] [--cof friction --up-to velocity] [options]"
    command.add_argument(
        "--least-power", action="store_true", help="the least power that meets the target, not the most room"
    )
    _add_free(command)
    add_output(command, "design.toml", "design.txt")


def design(args: argparse.Namespace, asked: Said) -> int:
    """Search, print, and write the case that was found; status 1 where the target is not met."""
    make_folder(args)
    with refusals():
        limits = {name: given.on(asked.case) for name, *_ in LIMITS.values() if (given := getattr(args, name))}
        least = "power" if args.least_power else None
        target = mdr.Target(**limits)
        with stopped_by_signals():
            found = mdr.design(
                asked.case, target, each_once(args.free), least=least, held=asked.held, limit_s=args.limit
            )
    names = ("met", "values", "ranges", "reached", "room", "active", "power", "why", "stopped")
    answer(args, {"target": limits, **picked(found, *names)}, str(found), found.case)
    if args.output is not None:
        set_to = {path: value for path, value in found.values.items() if path in RIG}
        kept = {**still_held(asked.held, found.values), **set_to}
        write_text(args, args.output / "design.toml", written(found.case, kept))
        write_text(args, args.output / "design.txt", f"{found}\n")
    return status_of(found.stopped, found.met)


def add_options_of_front(command: argparse.ArgumentParser) -> None:
    """The velocity, the ranges, how many designs, and where to write."""
    command.add_argument(
        "--up-to", metavar="velocity", required=True, type=velocity, help="velocity up to which friction holds: 5mm/s"
    )
    command.usage = "%(prog)s case.toml --up-to velocity --free path=low:high [...] [options]"
    command.add_argument("-n", metavar="n", type=whole_number(2), default=8, help="how many designs (default: 8)")
    _add_free(command)
    add_output(command, "front.csv", "front.png", "front.svg")


def front(args: argparse.Namespace, asked: Said) -> int:
    """Search, print and draw; status 1 where it was stopped."""
    make_folder(args)
    with refusals():
        up_to = args.up_to.on(asked.case)
        with stopped_by_signals():
            found = mdr.front(asked.case, up_to, each_once(args.free), args.n, held=asked.held, limit_s=args.limit)
    designs = [picked(one, "values", "met", "why") for one in found.designs]
    answer(
        args, {**picked(found, "up_to", "cof", "power", "why", "stopped"), "designs": designs}, str(found), asked.case
    )
    write_found(args, found.plot, found.table(), str(found))
    return status_of(found.stopped)
