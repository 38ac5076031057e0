"""`mdr curve`: coefficient of friction over pulling velocity, as a table, a CSV file and a figure."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mdr.case.contact import SlidingContact
from mdr.closed_forms.critical_velocity import velocity_scale
from mdr.commands.output import (
    DONE,
    FAILED,
    WrongInput,
    add_accuracy,
    complain,
    made_by,
    print_json,
    print_rows,
    require_free,
    velocity_text,
    write_figure,
)
from mdr.commands.velocity import Ends
from mdr.files.case_files import write_case
from mdr.tools.atomic_write import write_whole
from mdr.tools.provenance import commented

if TYPE_CHECKING:
    from mdr.friction.cof_curve import CofCurve

MOST_POINTS = 100_000  #: of a curve


def add_options(command: argparse.ArgumentParser) -> None:
    """Where to write, and over which velocities."""
    folder = "write curve.csv, curve.png and curve.svg here"
    command.add_argument("-o", "--output", metavar="folder", type=Path, help=folder)
    command.add_argument("--points", type=_points, default=24, help="how many velocities (default: 24)")
    add_accuracy(command, "bound on the error of the COF over mu_0 that is asked for")
    command.add_argument("--up-to", type=_multiple, default=1.3, help="highest velocity over v_c (default: 1.3)")
    command.epilog = "The curve begins at zero velocity; of a contact shaken in the plane, at --up-to the other way."


def curve(args: argparse.Namespace, case: SlidingContact) -> int:
    """Compute the curve, write and print it; status 1 if a run did not settle."""
    import numpy as np

    if args.output is not None:
        _make_folder(args.output)  # before the work, not after it
        require_free([args.output / name for name in ("curve.csv", "curve.png", "curve.svg")])
    from mdr.friction.cof_curve import cof_curve

    least = -args.up_to * velocity_scale(case.mirrored) if case.is_shaken else 0.0
    velocities = np.linspace(least, args.up_to * velocity_scale(case), args.points)
    found = cof_curve(case, velocities, accuracy=args.accuracy)
    if args.output is not None:
        _write_csv(args, case, found)
        _write_figures(args, found)
    if args.json:
        scalars: dict[str, Any] = {"v_c": found.v_c, "mu_0": found.mu_0, "static_cof": found.static_cof}
        if case.is_shaken:
            scalars |= {"v_c_back": found.v_c_back, **Ends.of(case).values}
        print_json(args, scalars | _columns(found), case)
    else:
        _print_curve(found)
        if case.is_shaken:
            print_rows(Ends.of(case).rows)
    unsettled = int(np.sum(~found.settled))
    if unsettled:
        reasons = "".join(f"\n  {why}" for why in dict.fromkeys(_loose_ends(found)))
        return complain(f"{unsettled} of {found.v_0.size} runs did not settle{reasons}", FAILED)
    return DONE


def _points(text: str) -> int:
    if not text.isascii() or not text.isdigit() or not 2 <= int(text[:9]) <= MOST_POINTS:
        raise argparse.ArgumentTypeError(f"must be a whole number from 2 to {MOST_POINTS}, got {text!r}")
    return int(text)


def _multiple(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"must be a positive multiple of v_c, got {text!r}")
    return number


def _columns(curve: CofCurve) -> dict[str, Any]:
    names = ("v_0", "cof", "cof_error", "settled", "stick_share")
    return {name: getattr(curve, name).tolist() for name in names} | {"why": list(curve.why)}


def _loose_ends(curve: CofCurve) -> list[str]:
    """Why the unsettled runs did not settle."""
    return [why for why, settled in zip(curve.why, curve.settled, strict=False) if why and not settled]


def _print_curve(curve: CofCurve) -> None:
    scaled = math.isfinite(curve.v_c) and curve.v_c > 0
    back = "" if curve.v_c_back is None else f" forward and {velocity_text(curve.v_c_back)} the other way"
    static = "static COF" if curve.v_c_back is None else "COF as v_0 -> +0"
    print(f"v_c = {velocity_text(curve.v_c)}{back}, mu_0 = {curve.mu_0:.6g}, {static} = {curve.static_cof:.6g}")
    print(f"{'v_0 [m/s]':>12} {'v_0/v_c':>8} {'COF':>10} {'COF/mu_0':>9} {'error':>8} {'stick':>6}  settled")
    columns = (curve.v_0, curve.cof, curve.cof_error, curve.stick_share, curve.settled)
    for v_0, cof, error, stick, settled in zip(*columns, strict=True):
        ratio = f"{v_0 / curve.v_c:8.4f}" if scaled else f"{'-':>8}"
        end = "yes" if settled else "no"
        print(f"{v_0:12.6g} {ratio} {cof:10.6f} {cof / curve.mu_0:9.6f} {error:8.1e} {stick:6.3f}  {end}")


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as fault:
        raise WrongInput(f"{folder}: no folder to write to: {getattr(fault, 'strerror', None) or fault}") from None


def _write_csv(args: argparse.Namespace, case: SlidingContact, curve: CofCurve) -> None:
    """curve.csv with versions, command and case at its head, each line behind a #."""
    head = commented(made_by(args), "", write_case(case))
    write_whole(args.output / "curve.csv", (head + curve.table()).encode("utf-8"))


def _write_figures(args: argparse.Namespace, curve: CofCurve) -> None:
    """curve.png and curve.svg, drawn without a display."""
    from matplotlib.figure import Figure

    from mdr import plots

    with plots.style():
        figure = Figure()
        plots.plot_curve(curve, figure.subplots())
        write_figure(args, figure, args.output, "curve")
