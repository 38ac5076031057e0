"""The verdict: Eq. (15), the full-slip value and the measured one side by side, and why they differ."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mdr.contact import SlidingContact, require_case
from mdr.coupling import FARTHEST, coupling_loss, radial_rub, unlike
from mdr.full_slip_body import full_slip_critical_velocity
from mdr.measurement import HIGHEST, LEAST, MeasuredVelocity, measure_critical_velocity
from mdr.motion import DepthMotion, LoadOscillation
from mdr.pull import RigidPull, SpringPull
from mdr.theory import critical_velocity, formula_of

SAME = 1e-8  #: of Eq. (1): full-slip values closer to it are called equal
STRONG = 0.02  #: Dundurs' beta, or lambda of mdr.coupling where its effect was computed, from which it is said


@dataclass(frozen=True)
class Verdict:
    """Does Eq. (15) hold for this contact? Velocities in m/s; print it for the sentence.

    eq_15 at the mean depth, full_slip with all harmonics of the force, measured from runs (None: no critical velocity);
    deviation = measured/eq_15 - 1; holds: whether Eq. (15) lies within the bracket of the measurement (None: it is
    beyond reach); why in words; measurement: bracket, kind and number of runs.
    """

    eq_15: float  #: Eq. (15) at the mean depth; Eq. (1) for a rigid pull
    full_slip: float  #: the same condition with all harmonics of the normal force
    measured: float | None  #: from runs alone
    deviation: float | None  #: measured/eq_15 - 1; beside a vanishing Eq. (15), over 1e-4 of Eq. (1)
    holds: bool | None  #: whether Eq. (15) lies in the bracket of the measurement; None if v_c is beyond its reach
    why: str  #: in the words of the physics
    measurement: MeasuredVelocity  #: bracket and kind
    formula: str = "Eq. (15)"  #: the closed form judged

    def __str__(self) -> str:
        words = {True: "holds", False: "fails", None: "cannot be judged"}
        head = f"{self.formula} {words[self.holds]}"
        measured = "no critical velocity" if self.measured is None else f"measured v_c = {self.measured:.6g} m/s"
        off = "" if self.deviation is None else f" ({100 * self.deviation:+.3g} %)"
        why = self.why[:1].upper() + self.why[1:]
        if self.measured is not None:
            measured += f" (between {self.measurement.low:.8g} and {self.measurement.high:.8g})"
        return f"{head}: {measured}, against {self.eq_15:.6g} m/s{off}. {why}"


def verdict(case: SlidingContact) -> Verdict:
    """Measure v_c of a case and set it beside Eq. (15) (Eq. (1) for a rigid pull) and the full-slip value.

    The formula holds if it lies within the bracket of the measurement, some 4e-5 of v_c wide: small deviations count.
    """
    eq_15, full = critical_velocity(require_case(case)), full_slip_critical_velocity(case)
    found = measure_critical_velocity(case)
    deviation: float | None = None
    holds: bool | None
    if found.v_c is None:
        # no stick-free run up to HIGHEST: that agrees with a pole, and says nothing about a velocity beyond
        holds = True if not np.isfinite(eq_15) else (None if eq_15 > HIGHEST * case.unit_velocity else False)
    elif not np.isfinite(eq_15):
        holds = False
    else:
        scale = max(eq_15, LEAST * case.unit_velocity)
        deviation = (found.v_c - eq_15) / scale
        holds = found.contains(eq_15) or max(eq_15, found.v_c) < scale
    reasons = list(_reasons(case, eq_15, full, found))
    if holds and found.kind == "end of stick":
        reasons = ["the springs that stick to the last all slip from the velocity of one element on"]
    elif holds and found.v_c is not None:
        reasons = [found.why]
    if found.v_c is None or not reasons:
        reasons.append(found.why)
    formula = formula_of(case)
    why = "; ".join([*reasons, *_left_out(case)])
    return Verdict(eq_15, full, found.v_c, deviation, holds, why, found, formula)


def _reasons(case: SlidingContact, eq_15: float, full: float, found: MeasuredVelocity) -> Iterator[str]:
    if not np.isfinite(eq_15):
        yield "the body is driven at its undamped natural frequency, where the formula has its pole"
    if not np.isfinite(full) and np.isfinite(eq_15):
        yield (
            "a harmonic of the normal force drives the body at its undamped natural frequency"
            if isinstance(case.pull, SpringPull) and case.pull.m > 0
            else "dashpots that touch again throw the body, which has no inertia, at unbounded velocity for an instant"
        )
    if not case.keeps_contact:
        yield "contact is lost in part of the period, Eq. (5)"
    if isinstance(case.pull, RigidPull) and isinstance(case.oscillation, DepthMotion):
        if full < eq_15 * (1 - SAME):
            yield "the contact is still open at the instant of fastest approach, on which Eq. (1) rests"
    elif np.isfinite(eq_15) and found.contains(full):
        what = "depth" if isinstance(case.oscillation, LoadOscillation) else "normal force"
        yield (
            f"at this amplitude the contact stiffness changes within the period and the {what} has harmonics; "
            "with them the full-slip condition gives the measured value"
        )
    if found.kind == "hysteresis":
        yield found.why


def _left_out(case: SlidingContact) -> Iterator[str]:
    """What the springs leave out where it matters."""
    beta, rub = case.material.dundurs_beta, radial_rub(case)
    left_out = f"the springs leave out normal-tangential coupling (Dundurs' beta = {beta:.2f}): in three dimensions"
    if unlike(case):
        if abs(beta) > STRONG:
            yield f"{left_out} friction is lower than here, and part of the contact may still stick above this velocity"
    elif rub > STRONG:
        most = "" if rub <= FARTHEST else " (more than half as much again under a flat face)"
        yield (
            f"{left_out} friction is lower than here by up to about {coupling_loss(case):.1g} of mu_0{most}, and part "
            f"of the contact sticks up to about {1 + rub:.2f} times the full-slip velocity"
        )
