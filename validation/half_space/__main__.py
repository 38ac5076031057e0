"""`python -m validation.half_space case.toml --v-0 0.001`: the COF of a case in three dimensions, with its errors."""

import argparse
import json
import sys
from collections.abc import Sequence

import mdr
from mdr.half_space import NotConverged

NAMES = ("cof", "cof_y", "mean_F_x", "mean_F_y", "mean_F_z")  #: of what is found


def main(argv: Sequence[str] | None = None) -> int:
    """0 done, 1 a step did not converge, 2 wrong input."""
    args = _arguments().parse_args(argv)
    try:
        size = {"cells": args.cells, "steps_per_period": args.steps, "n_periods": args.cycles}
        found = mdr.half_space.slide(mdr.read_case(args.case), args.v_0, **size, coupled=not args.uncoupled)
    except NotConverged as fault:
        return _told(args, {"converged": False, "why": str(fault)}, 1)
    except ValueError as fault:
        print(f"half_space: {fault}", file=sys.stderr)
        return 2
    errors = {"step": found.step_error, "grid": found.grid_error, "cycles": found.cycle_error}
    answer = {**{name: getattr(found, name) for name in NAMES}, "converged": True}
    return _told(args, {**answer, "errors": errors}, 0)


def _told(args: argparse.Namespace, answer: dict[str, object], status: int) -> int:
    if args.json:
        print(json.dumps({**dict.fromkeys((*NAMES, "errors")), **answer}, indent=1))
        return status
    for name, value in answer.items():
        for label, one in value.items() if isinstance(value, dict) else [("", value)]:
            shown = f"{one:.8g}" if isinstance(one, float) else one
            print(f"{f'{name} {label}'.strip():14} {shown}")
    return status


def _arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("python -m validation.half_space", description=__doc__)
    parser.add_argument("case", metavar="case.toml", help="a case file with a rigid pull, elastic or Kelvin")
    parser.add_argument("--v-0", type=float, required=True, metavar="m/s", help="pulling velocity [m/s]")
    parser.add_argument("--cells", type=int, default=41, help="along each side of the grid (default: 41)")
    parser.add_argument("--steps", type=int, default=100, help="of a period (default: 100)")
    parser.add_argument("--cycles", type=int, default=2, help="periods, of which the last counts (default: 2)")
    parser.add_argument("--uncoupled", action="store_true", help="leave out normal-tangential coupling")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    return parser


if __name__ == "__main__":
    sys.exit(main())
