"""The command line: `mdr velocity`, `mdr curve`, `mdr measure`, `mdr verdict` of a case file, `mdr sweep` of a study.

Installed as `mdr`, also `python -m mdr`. Exit status: 0 done; 1 a run failed, did not settle or found nothing;
2 wrong input; 130 interrupted. Results go to standard output (with --json one JSON object: what is undefined is null,
an infinite value the string "inf"), everything else to standard error.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import shlex
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import mdr
from mdr.case_files import CaseFileError, read_case, write_case
from mdr.contact import SlidingContact
from mdr.theory import critical_velocity, formula_of

if TYPE_CHECKING:
    from mdr.friction import CofCurve
    from mdr.studies import Study
    from mdr.studies.study_files import StudyFile

DONE, FAILED, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130
MOST_POINTS = 100_000  #: of a curve
_FAILURES = (ValueError, ArithmeticError, RuntimeError, OSError, MemoryError)


class WrongInput(Exception):
    """What the user gave cannot be used."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    given = list(sys.argv[1:] if argv is None else argv)
    args = parser().parse_args(given)
    args.command = shlex.join(["mdr", *given])
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # a letter the terminal lacks must not cost the result
            stream.reconfigure(errors="backslashreplace")
    try:
        return _run(args)
    except KeyboardInterrupt:
        return _complain("interrupted before it was done", INTERRUPTED)
    except BrokenPipeError:  # the reader, such as head, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return DONE


def _run(args: argparse.Namespace) -> int:
    """Read the file, do the work, and turn what goes wrong into a sentence and a status."""
    work: Callable[[argparse.Namespace, Any], int] = args.work
    try:
        case = args.read(args.case) if args.read else None
    except CaseFileError as fault:
        return _complain(str(fault), WRONG_INPUT)
    try:
        status = work(args, case)
        sys.stdout.flush()  # a full disk shows here
        return status
    except WrongInput as fault:
        return _complain(str(fault), WRONG_INPUT)
    except BrokenPipeError:
        raise
    except _FAILURES as fault:
        where = f"{args.case}: " if args.read else ""
        return _complain(f"{where}{str(fault) or type(fault).__name__}", FAILED)


def parser() -> argparse.ArgumentParser:
    """The commands and their options."""
    top = argparse.ArgumentParser(
        prog="mdr", allow_abbrev=False,
        description="Sliding friction of a viscoelastic contact under normal oscillation, from a case file (TOML, SI).",
        epilog="exit status: 0 done, 1 a run failed or did not settle, 2 wrong input, 130 interrupted",
    )  # fmt: skip
    top.add_argument("--version", action="version", version=f"mdr {mdr.__version__}")
    commands = top.add_subparsers(required=True, metavar="command")
    _command(commands, "velocity", _velocity, "critical velocity and static friction in closed form, without a run")
    curve = _command(commands, "curve", _curve, "coefficient of friction over pulling velocity, by simulation")
    folder = "write curve.csv, curve.png and curve.svg here"
    curve.add_argument("-o", "--output", metavar="folder", type=Path, help=folder)
    curve.add_argument("--points", type=_points, default=24, help="how many velocities, from 0 on (default: 24)")
    curve.add_argument("--up-to", type=_multiple, default=1.3, help="highest velocity over v_c (default: 1.3)")
    _command(commands, "measure", _measure, "critical velocity from simulation alone")
    _command(commands, "verdict", _verdict, "whether the closed-form critical velocity holds, and by how much not")
    _command(commands, "shapes", _shapes, "the shapes, materials and motions that a file can name, and their keys", "")
    start = _command(commands, "case", _case, "a commented case file to begin with, on standard output", "")
    start.add_argument("--example", default="Paraboloid", metavar="shape", help="its shape (default: Paraboloid)")
    start.add_argument("--material", default="KelvinVoigt", metavar="model", help="its material (default: KelvinVoigt)")
    motions = "NormalOscillation, PeriodicMotion or LoadOscillation"
    start.add_argument("--motion", default="NormalOscillation", metavar="name", help=f"{motions} (default: the first)")
    start.add_argument(
        "--pull", default="SpringPull", metavar="name", help="SpringPull or RigidPull (default: SpringPull)"
    )
    sweep = _command(
        commands, "sweep", _sweep, "a grid of cases, from a study file; the same call goes on after any end", "study"
    )
    sweep.set_defaults(read=_read_study_file)
    sweep.add_argument("--store", metavar="folder", type=Path, help="keep finished chunks here, and go on from them")
    sweep.add_argument("-o", "--output", metavar="file", type=Path, help="write the whole study here, .nc or .csv")
    sweep.add_argument("--chunk-seconds", type=float, default=5.0, metavar="s", help="work in a chunk [s] (default: 5)")
    sweep.add_argument("--shard", metavar="k/n", help="compute every n-th chunk, from the k-th on; needs --store")
    return top


def _command(
    commands: Any, name: str, work: Callable[..., int], summary: str, kind: str = "case"
) -> argparse.ArgumentParser:
    """One command that reads a file of a kind, "case" or "study", or none."""
    command: argparse.ArgumentParser = commands.add_parser(name, help=summary, description=summary, allow_abbrev=False)
    if kind:
        example = "docs/study.toml" if kind == "study" else "docs/example.toml"
        command.add_argument("case", metavar=f"{kind}.toml", help=f"the {kind} file; {example} is one")
    command.add_argument("--json", action="store_true", help="print one JSON object instead of text")
    command.set_defaults(work=work, read=read_case if kind else None)
    return command


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


# --- velocity ---


def _velocity(args: argparse.Namespace, case: SlidingContact) -> int:
    from mdr.full_slip import static_cof
    from mdr.full_slip_body import full_slip_critical_velocity

    v_c, full_slip, static = critical_velocity(case), full_slip_critical_velocity(case), static_cof(case)
    (equation, how), kappa = _equation(case), case.material.mindlin_ratio
    loss = float(case.material.loss_tangent(case.oscillation.omega))
    if args.json:
        return _print_json(args, case, {
            "equation": equation, "v_c": v_c, "full_slip": full_slip, "static_cof": static, "mu_0": case.mu_0,
            "alpha": case.alpha, "T": case.T, "loss_tangent": loss, "mindlin_ratio": kappa,
            "keeps_contact": case.keeps_contact,
        })  # fmt: skip
    _print_rows([
        (equation, _velocity_text(v_c), f"critical velocity, {how}"),
        ("full slip", _velocity_text(full_slip), "critical velocity, any amplitude, all harmonics of the force"),
        ("static COF", f"{static:.6g}", f"friction as v_0 -> 0; mu_0 = {case.mu_0:.6g}"),
        ("alpha", f"{case.alpha:.6g}", "half the swing of the depth over its mean, du_z/u_z0"),
        ("loss", f"{loss:.6g}", "loss tangent of the material at omega; omega tau of a Kelvin body"),
        ("kappa", f"{kappa:.6g}", "E*/G*, Mindlin ratio"),
        ("contact", "kept" if case.keeps_contact else "lost in part of the period", "at its centre, Eq. (5)"),
    ])  # fmt: skip
    return DONE


def _equation(case: SlidingContact) -> tuple[str, str]:
    """Number and circumstances of the closed form."""
    number, closing, rest = formula_of(case).partition(")")
    return number + closing, rest.strip() or "contact stiffness at the mean depth"


def _velocity_text(v: float | None) -> str:
    if v is None:
        return "none"
    return "infinite, an undamped resonance" if math.isinf(v) else f"{v:.6g} m/s"


# --- curve ---


def _curve(args: argparse.Namespace, case: SlidingContact) -> int:
    import numpy as np

    if args.output is not None:
        _make_folder(args.output)  # before the work, not after it
    from mdr.friction import cof_curve

    curve = cof_curve(case, velocity_scale(case) * np.linspace(0, args.up_to, args.points))
    if args.output is not None:
        _write_csv(args, case, curve)
        _write_figures(args.output, curve)
    if args.json:
        scalars = {"v_c": curve.v_c, "mu_0": curve.mu_0, "static_cof": curve.static_cof}
        _print_json(args, case, scalars | _columns(curve))
    else:
        _print_curve(curve)
    unsettled = int(np.sum(~curve.settled))
    if unsettled:
        reasons = "".join(f"\n  {why}" for why in dict.fromkeys(_loose_ends(curve)))
        return _complain(f"{unsettled} of {curve.v_0.size} runs did not settle{reasons}", FAILED)
    return DONE


def velocity_scale(case: SlidingContact) -> float:
    """Velocity [m/s] that a curve is scaled by: v_c in closed form, or Eq. (1) where that is infinite or zero."""
    v_c = critical_velocity(case)
    if math.isfinite(v_c) and v_c > 0:
        return v_c
    return case.unit_velocity


def _columns(curve: CofCurve) -> dict[str, Any]:
    names = ("v_0", "cof", "cof_error", "settled", "stick_share")
    return {name: getattr(curve, name).tolist() for name in names} | {"why": list(curve.why)}


def _loose_ends(curve: CofCurve) -> list[str]:
    """Why the unsettled runs did not settle."""
    return [why for why, settled in zip(curve.why, curve.settled, strict=False) if why and not settled]


def _print_curve(curve: CofCurve) -> None:
    scaled = math.isfinite(curve.v_c) and curve.v_c > 0
    print(f"v_c = {_velocity_text(curve.v_c)}, mu_0 = {curve.mu_0:.6g}, static COF = {curve.static_cof:.6g}")
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
    """curve.csv with version, command and case at its head, each line behind a #."""
    target = args.output / "curve.csv"
    partial = target.with_suffix(".csv.part")
    curve.to_csv(partial)
    head = [f"mdr {mdr.__version__}", *args.command.splitlines(), "", *write_case(case).splitlines()]
    lines = "".join(f"# {line}".rstrip() + "\n" for line in head)
    partial.write_text(lines + partial.read_text(encoding="utf-8"), encoding="utf-8")
    partial.replace(target)  # a file that is there is whole


def _write_figures(folder: Path, curve: CofCurve) -> None:
    """curve.png and curve.svg, drawn without a display."""
    from matplotlib.figure import Figure

    from mdr import plots

    with plots.style():
        figure = Figure()
        plots.plot_curve(curve, figure.subplots())
        figure.savefig(folder / "curve.png", dpi=150)
        figure.savefig(folder / "curve.svg", metadata={"Date": None})


# --- measure and verdict ---


def _measure(args: argparse.Namespace, case: SlidingContact) -> int:
    from mdr.measurement import measure_critical_velocity

    found = measure_critical_velocity(case)
    values = {name: getattr(found, name) for name in ("v_c", "low", "high", "kind", "why")}
    if args.json:
        _print_json(args, case, values)
    else:
        _print_rows([("v_c", _velocity_text(found.v_c), found.kind), *_bracket(found), ("", found.why, "")])
    return DONE if found.v_c is not None else FAILED


def _bracket(found: Any) -> list[tuple[str, str, str]]:
    if found.low is None or found.high is None:
        return []
    return [("bracket", f"{found.low:.9g} to {found.high:.9g} m/s", "reduced below, full above")]


def _verdict(args: argparse.Namespace, case: SlidingContact) -> int:
    from mdr.judgement import verdict

    found, (equation, how) = verdict(case), _equation(case)
    names = ("eq_15", "full_slip", "measured", "deviation", "holds", "why")
    if args.json:
        _print_json(args, case, {name: getattr(found, name) for name in names} | {"sentence": str(found)})
    else:
        print(found)
        off = "none" if found.deviation is None else f"{found.deviation:+.3e}"
        _print_rows([
            (equation, _velocity_text(found.eq_15), how),
            ("full slip", _velocity_text(found.full_slip), "any amplitude, all harmonics of the force"),
            ("measured", _velocity_text(found.measured), "from simulation alone"),
            ("deviation", off, f"measured over {equation}, less 1"),
            ("holds", {True: "yes", False: "no", None: "cannot be judged"}[found.holds], ""),
        ])  # fmt: skip
    return DONE if found.holds or found.measured is not None else FAILED  # no v_c on a resonance is an answer


# --- shapes and case ---


def _shapes(args: argparse.Namespace, _: None) -> int:
    from mdr.case_files import nameable
    from mdr.field_names import UNITS_AND_MEANINGS

    tables: dict[str, dict[str, Any]] = {}
    for table, records in nameable().items():
        tables[table] = {}
        for name, (record, keys) in records.items():
            told = {key: UNITS_AND_MEANINGS.get(f"{table}.{key}", ("", "")) for key in keys}
            tables[table][name] = {
                "is": (record.__doc__ or "").strip().splitlines()[0],
                "keys": {key: {"unit": unit, "meaning": meaning} for key, (unit, meaning) in told.items()},
            }
    if args.json:
        print(json.dumps({"version": mdr.__version__, "command": args.command, **tables}, indent=1, ensure_ascii=False))
        return DONE
    for table, described in tables.items():
        print(f"[{table}]")
        for name, one in described.items():
            print(f"  {name:<20} {one['is']}")
            for key, what in one["keys"].items():
                unit = f"[{what['unit']}]" if what["unit"] else ""
                print(f"{'':23}{key:<10} {unit:<8} {what['meaning']}".rstrip())
    return DONE


def _case(args: argparse.Namespace, _: None) -> int:
    from mdr.examples import example, example_file

    try:
        case = example(args.example, args.material, args.motion, args.pull)
    except ValueError as fault:
        raise WrongInput(str(fault)) from None
    if args.json:
        return _print_json(args, case, {})
    print(example_file(case), end="")
    return DONE


# --- sweep ---


def _read_study_file(path: str) -> StudyFile:
    from mdr.studies.study_files import read_study_file

    return read_study_file(path)


def _sweep(args: argparse.Namespace, asked: StudyFile) -> int:
    _require_a_place(args)
    try:
        knobs = {"chunk_seconds": args.chunk_seconds, "shard": args.shard}
        study = mdr.sweep(**vars(asked), store=args.store, **knobs)
    except ValueError as fault:  # of shard and chunks; the file has been read
        raise WrongInput(str(fault)) from None
    if args.output is not None and study.complete:
        (study.to_csv if args.output.suffix == ".csv" else study.to_netcdf)(args.output)
    if args.json:
        _print_json(args, asked.case, _of_study(study))
    else:
        print(study)
    return _end_of_sweep(args, study)


def _require_a_place(args: argparse.Namespace) -> None:
    """Refuse, before the work, what would lose its outcome."""
    if args.output is None:
        if args.store is None and not args.json:
            raise WrongInput("the study would be lost: give -o file.nc or file.csv, --store folder, or --json")
        return
    if args.output.suffix not in (".nc", ".csv"):
        raise WrongInput(f"{args.output}: a study is written as .nc or .csv")
    if args.output.is_dir() or not os.access(args.output.parent, os.W_OK):
        raise WrongInput(f"{args.output}: no file can be written there")


def _of_study(study: Study) -> dict[str, Any]:
    from mdr.studies import Status

    return {
        "identity": study.identity,
        "complete": study.complete,
        "counts": {status.name.lower(): study.count(status) for status in Status},
        "axes": {axis.path: [axis[i] if axis.is_numeric else axis.labels[i] for i in range(len(axis))]
                 for axis in study.frame.grid},
        "units": study.units,
        "values": {name: study[name].tolist() for name in study.quantities},
        "status": study.status.tolist(),
        "why": study.why.tolist(),
    }  # fmt: skip


def _end_of_sweep(args: argparse.Namespace, study: Study) -> int:
    from mdr.studies import Status

    failed, unsettled = study.count(Status.FAILED), study.count(Status.UNSETTLED)
    if failed or unsettled:
        return _complain(f"{failed} of {study.status.size} points failed, {unsettled} did not settle", FAILED)
    if study.complete:
        return DONE
    missing = f"{study.count(Status.MISSING)} of {study.status.size} points are left to the other shards"
    left_out = f"; {args.output} is not written" if args.output else ""
    return _complain(missing + left_out, DONE)  # this shard has done its own


# --- printing ---


def _print_rows(rows: Sequence[tuple[str, str, str]]) -> None:
    """Name, value and meaning, in columns."""
    wide = max((len(value) for name, value, _ in rows if name), default=0)
    for name, value, meaning in rows:
        print(f"{name:<11}{value:<{wide}}  {meaning}".rstrip())


def _print_json(args: argparse.Namespace, case: SlidingContact, values: dict[str, Any]) -> int:
    head = {"version": mdr.__version__, "command": args.command, "case": write_case(case)}
    print(json.dumps(_plain({**head, **values}), indent=1, allow_nan=False))
    return DONE


def _plain(value: Any) -> Any:
    """What JSON can say: null for what is undefined, "inf" for infinity, numbers of Python for those of NumPy."""
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    value = value.item() if hasattr(value, "item") else value
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else str(value)
    return value


def _complain(message: str, status: int) -> int:
    for line in message.splitlines() or [""]:
        print(line if line.startswith(" ") else f"mdr: {line}", file=sys.stderr)
    return status


if __name__ == "__main__":
    sys.exit(main())
