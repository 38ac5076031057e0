"""How often the intervals of a fit hold the truth: synthetic measurements with 1 % noise, three parameters.

`python tests/table_of_fits.py [n]` takes a minute for the 200 sets it draws by default.
"""

import sys

from test_fitting import START, TRUTH, measured

import mdr
from mdr.tools.progress import progress


def main(n: int) -> None:
    """Print the share of sets whose 95 % interval holds the truth, for each parameter."""
    held = dict.fromkeys(TRUTH, 0)
    for seed in progress(range(n), "fits"):
        found = mdr.fit(START, measured(0.01, seed), list(TRUTH))
        for name, true in TRUTH.items():
            held[name] += found.low[name] <= true <= found.high[name]
    print(f"{n} sets of measurements")
    for name, count in held.items():
        print(f"{name:14s} {count / n:7.1%}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 200)
