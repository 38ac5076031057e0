"""`python -m validation.half_space case.toml --v-0 0.001`: the COF of a case in three dimensions, with its errors."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import replace

import mdr
from mdr.half_space.friction import Settings, in_three_dimensions
from mdr.half_space.normal import NotConverged


def main(argv: Sequence[str] | None = None) -> int:
    """0 done, 1 a step did not converge, 2 wrong input."""
    args = _arguments().parse_args(argv)
    settings = Settings(args.cells, args.steps, args.cycles, coupled=not args.uncoupled)
    try:
        case = mdr.read_case(args.case)
        found = in_three_dimensions(case, args.v_0, settings)
        coarse = in_three_dimensions(case, args.v_0, replace(settings, steps=args.steps // 2))
        wide = in_three_dimensions(case, args.v_0, replace(settings, cells=(args.cells + 1) // 2))
    except NotConverged as fault:
        return _told(args, {"converged": False, "why": str(fault)}, 1)
    except ValueError as fault:
        print(f"half_space: {fault}", file=sys.stderr)
        return 2
    errors = {
        "step": abs(found.cof - coarse.cof),  # to half the steps: its own, where it is of first order
        "grid": abs(found.cof - wide.cof),  # to half the cells, in the same way
        "cycles": found.settling,
    }
    answer = {"cof": found.cof, "mean_F_x": found.mean_F_x, "mean_F_z": found.mean_F_z, "converged": True}
    return _told(args, {**answer, "errors": errors}, 0)


def _told(args: argparse.Namespace, answer: dict[str, object], status: int) -> int:
    if args.json:
        print(json.dumps({**dict.fromkeys(("cof", "mean_F_x", "mean_F_z", "errors")), **answer}, indent=1))
        return status
    for name, value in answer.items():
        for label, one in value.items() if isinstance(value, dict) else [("", value)]:
            shown = f"{one:.8g}" if isinstance(one, float) else one
            print(f"{f'{name} {label}'.strip():14} {shown}")
    return status


def _arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("python -m validation.half_space", description=__doc__)
    parser.add_argument("case", metavar="case.toml", help="a case file with a rigid pull, elastic or Kelvin")
    parser.add_argument("--v-0", type=_positive, required=True, metavar="m/s", help="pulling velocity [m/s]")
    parser.add_argument("--cells", type=_count(8), default=41, help="along each side of the grid (default: 41)")
    parser.add_argument("--steps", type=_count(8), default=100, help="of a period (default: 100)")
    parser.add_argument("--cycles", type=_count(2), default=2, help="periods, of which the last counts (default: 2)")
    parser.add_argument("--uncoupled", action="store_true", help="leave out normal-tangential coupling")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    return parser


def _positive(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"must be positive and finite, got {text}")
    return value


def _count(least: int):
    def count(text: str) -> int:
        value = int(text)
        if value < least:
            raise argparse.ArgumentTypeError(f"must be at least {least}, got {text}")
        return value

    return count


if __name__ == "__main__":
    sys.exit(main())
