"""The solved periodic state of a body beside 20 000 awaited periods: `python tests/table_of_periods.py`.

A hundred random systems with damping ratios from 0 to 0.1, a third of them below 0.01; takes some minutes. Prints in
how many of them both agree within the spreads they state, and for the lightly damped ones which share of the periods
that awaiting needs for a spread as small the solver takes, its measurement of stability included.
"""

import sys
from dataclasses import dataclass

import numpy as np
from conftest import SHAPES, contact

import mdr
from mdr.march.dimensionless import ScaledContact
from mdr.march.orbit_search import search_from_full_slip
from mdr.march.steady_state import TOLERANCE, Settling, assess
from mdr.march.stepper import Stepper
from mdr.tools.progress import progress

AWAITED = 20_000
SPRINGS, STEPS = 48, 256  # of both, so that they have one periodic state


@dataclass(frozen=True)
class Row:
    """One system both ways."""

    name: str
    damping: float
    solved: Settling | None
    awaited: Settling
    periods: int  #: that the solver marched
    waiting: int | None  #: that awaiting takes to a spread as small; None if it does not get there

    @property
    def excess(self) -> float:
        """Difference of the COFs over mu_0, less what the spreads allow."""
        allowed = self.solved.spread + self.awaited.spread
        return abs(self.solved.mean - self.awaited.mean) - allowed - 1e-12

    @property
    def share(self) -> float:
        """Periods of the solver over those of awaiting, at least over all of them."""
        return self.periods / (self.waiting or AWAITED)


def drawn(n: int) -> list[tuple[str, float, mdr.SlidingContact, float]]:
    """Random bodies, below and above their v_c."""
    rng, out = np.random.default_rng(20_000), []
    for i in range(n):
        shape = tuple(SHAPES)[int(rng.integers(4))]
        alpha, T = 0.05 * 30 ** rng.uniform(), (0.0, 0.1 * 30 ** rng.uniform())[int(rng.integers(2))]
        k_ratio, ratio, v_hat = 0.3 * 10 ** rng.uniform(), 0.4 * 6 ** rng.uniform(), rng.uniform(0.1, 1.1)
        damping = 0.01 * rng.uniform() if i % 3 == 0 else 0.1 * rng.uniform()
        case = contact(shape, 1 / alpha, T, k_ratio, ratio, 2 * damping * k_ratio / ratio)
        name = f"{shape}, alpha = {alpha:.3g}, T = {T:.3g}, k = {k_ratio:.2g}, omega_0 = {ratio:.3g}, v = {v_hat:.2g}"
        out.append((f"{name}, zeta = {damping:.2g}", damping, case, v_hat * mdr.full_slip_critical_velocity(case)))
    return out


def row(name: str, damping: float, case: mdr.SlidingContact, v_0: float) -> Row:
    """Solve for the periodic state, and await it."""
    scaled = ScaledContact.of(case, mdr.SpringArray.of(case, SPRINGS), STEPS, lump=False)
    quick, slow = (Stepper(scaled, v_0 / scaled.speed) for _ in range(2))
    orbit = search_from_full_slip(quick)
    solved, marched = orbit and orbit.settling, quick.n_periods
    cofs = slow.advance(slow.full_slip(), AWAITED)[1].cof
    awaited = assess(cofs, TOLERANCE)
    waiting = None
    if solved is not None:
        lengths = np.unique(np.geomspace(8, AWAITED, 120).astype(int))
        small = [int(n) for n in lengths if assess(cofs[:n], TOLERANCE).spread <= max(solved.spread, 1e-12)]
        waiting = small[0] if small else None
    return Row(name, damping, solved, awaited, marched, waiting)


def main(n: int) -> int:
    """Print the table; 0 if all agree and the solver takes at most a fifth of the periods."""
    rows = [row(*one) for one in progress(drawn(n), "table_of_periods")]
    solved = [r for r in rows if r.solved is not None]
    light = [r for r in solved if r.damping < 0.01]
    apart = [r for r in solved if r.excess > 0]
    share = float(np.median([r.share for r in light]))
    worst = max(abs(r.solved.mean - r.awaited.mean) for r in solved)
    print(f"{n} systems, {len(solved)} solved, {len(solved) - len(apart)} agree; worst difference {worst:.1e} mu_0")
    never = sum(r.waiting is None for r in light)
    print(f"damping ratio below 0.01: {len(light)} systems, median share of the periods {share:.3g}")
    print(f"of them {never} where {AWAITED} periods do not reach the spread of the solver")
    for r in [*apart, *(r for r in rows if r.solved is None)]:
        print(f"  {r.name}: {r.solved} {r.awaited}")
    return 0 if not apart and share <= 0.2 else 1


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 100))
