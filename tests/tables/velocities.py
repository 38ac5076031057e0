"""The measured critical velocity beside its definition.

The systems of theorems.py: a third undamped, a third beside a whole multiple of the drive. Of each of them is
asked whether runs at 0.97 and 1.03 of it, and the full-slip value, contradict what it says. A contradiction is

* a settled run 3 % above a measured v_c, from either start, whose COF misses mu_0 by more than its error;
* one 3 % below that neither sticks nor misses anything, where stick is what the measurement went by;
* "no critical velocity" where a settled run above the finite full-slip value has the full COF;
* an end of stick that is not the full-slip value to 1e-4 of it, or to the bracket.
"""

import math
import time
from dataclasses import dataclass

from tables.theorems import drawn

import mdr

NEAR = 1e-4  #: of v_c, to which it is measured away from resonances
LONGEST = 120.0  #: seconds for one measurement


@dataclass(frozen=True)
class Row:
    """What became of one measurement."""

    name: str
    kind: str
    contradictions: tuple[str, ...]
    seconds: float


def row(seed: int) -> Row:
    """Measure one system, and run beside the answer."""
    try:
        system = drawn(seed)
    except ValueError:
        return Row(f"{seed}: refused", "refused", (), 0.0)
    case = mdr.resolved(system.case)
    full = mdr.full_slip_critical_velocity(case)
    begin = time.perf_counter()
    found = mdr.measure_critical_velocity(case, limit_s=LONGEST)
    seconds = time.perf_counter() - begin
    told = list(_against(case, found, full))
    return Row(f"{system.name}; full slip {full:.8g}: {found.kind}, {found.v_c}", found.kind, tuple(told), seconds)


def _against(case, found, full):
    if found.v_c is None:
        if found.kind == "none" and math.isfinite(full) and full < 1e2 * case.unit_velocity:
            run = mdr.slide(case, 1.03 * full, limit_s=LONGEST)
            if run.settled and case.mu_0 - run.cof <= run.cof_error:
                yield f"none, but the COF is full at 1.03 of {full:.8g}"
        return
    if found.v_c < 1e-3 * case.unit_velocity:
        return
    for start in ("full_slip", "rest"):
        above = mdr.slide(case, 1.03 * max(found.v_c, found.high), start=start, limit_s=LONGEST)
        if above.settled and case.mu_0 - above.cof > above.cof_error + 1e-9:
            yield f"above, from {start}: {above.mu_0 - above.cof:.2g} +- {above.cof_error:.1g} is missing"
    for start in ("full_slip", "rest"):
        below = mdr.slide(case, 0.97 * min(found.v_c, found.low), start=start, limit_s=LONGEST)
        if below.settled and below.stick_share == 0 and case.mu_0 - below.cof <= below.cof_error:
            yield f"below, from {start}: nothing sticks, and friction is full"
    width = max(NEAR * found.v_c, found.high - found.low)
    if math.isfinite(full) and abs(found.v_c - full) > width:
        yield f"{found.v_c:.8g} is not the full-slip value"
