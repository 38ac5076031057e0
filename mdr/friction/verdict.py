"""The verdict: how good Eq. (15) is, beside the full-slip value and the measured one, and why they differ.

A contact that is shaken in the plane has one for each way of the pull, and a sentence on what it does at rest. Another
sentence, if asked for, has what the springs leave out, from one run in three dimensions.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mdr import half_space
from mdr.case.contact import SlidingContact
from mdr.case.domain import ELASTIC, HARMONIC, KEPT, RIGID, UNSHAKEN, Condition, Domain, OutsideDomain, domain_of
from mdr.closed_forms.across import static_across
from mdr.closed_forms.coupling import LOSS, coupling_loss, radial_rub
from mdr.closed_forms.critical_velocity import NEARLY, critical_velocity, formula_of
from mdr.closed_forms.full_slip import static_cof
from mdr.closed_forms.full_slip_body import full_slip_critical_velocity
from mdr.closed_forms.laws.across import full_across, stiffened_by_coupling
from mdr.closed_forms.laws.falling import falling_friction
from mdr.closed_forms.laws.strength import full_slip_of_half_space, velocity_of_share
from mdr.friction.measured_velocity import (
    ACROSS,
    AT_THE_EDGE,
    HIGHEST,
    LEAST_V_C,
    MeasuredVelocity,
    measure_critical_velocity,
)
from mdr.friction.shaken import band_of_pull, no_load_velocity
from mdr.indenters import FlatPunch
from mdr.march.periodic.steady import BUDGET
from mdr.march.result.slide import slide
from mdr.normal.normal_force import full_cof
from mdr.normal.resolved import resolved
from mdr.tools.arrays import SAME
from mdr.tools.checks import between
from mdr.tools.keywords import offering
from mdr.tools.progress import time_limit
from mdr.tools.summary import Printed, with_error

PUNCH = Condition("indenter", "a flat punch", lambda case: isinstance(case.indenter, FlatPunch))
#: where falling_friction is that of a case, as all its springs are alike
JUMPS = Domain((RIGID, ELASTIC, UNSHAKEN, HARMONIC, KEPT, PUNCH), instead="slide")
SAMPLES = 200  #: velocities up to v_c at which it is asked for
STRONG = 0.02  #: of what springs leave out (beta, lambda, static friction over mu_0), from which it is said


@dataclass(frozen=True)
class Verdict(Printed):
    """How good Eq. (15) is for a contact; print it for the sentence. Velocities in m/s.

    `dataclasses.replace(found, within=0.003)` judges by another tolerance, without a run.
    """

    eq_15: float  #: Eq. (15) at the mean depth; Eq. (1) for a rigid pull
    full_slip: float  #: the same condition with all harmonics of the normal force
    measured: float | None  #: from runs alone
    deviation: float | None  #: measured/eq_15 - 1; beside a vanishing Eq. (15), over 1e-4 of Eq. (1)
    holds: bool | None  #: strictly: Eq. (15) lies in the bracket of the measurement; None if that cannot be judged
    why: str  #: in the words of the physics
    measurement: MeasuredVelocity  #: bracket and kind
    formula: str = "Eq. (15)"  #: the closed form judged
    within: float = 0.01  #: largest deviation, up or down, that is called good [-]
    least: float = 0.0  #: 1e-4 of Eq. (1) [m/s]: a velocity below it is not told from zero
    other_way: Verdict | None = None  #: that of the pull the other way, where something shakes in the plane
    at_rest: str = ""  #: what the contact does there without a pull, in a sentence
    three_dimensions: str = ""  #: how far springs are off at one velocity, in a sentence; empty if it was not asked for

    def __post_init__(self) -> None:
        _tolerance(self.within)
        if self.other_way is not None and self.other_way.within != self.within:
            object.__setattr__(self, "other_way", replace(self.other_way, within=self.within))

    @property
    def good(self) -> bool | None:
        """True if ``|deviation| <= within``; None without a measured v_c or a finite formula."""
        return None if self.deviation is None else abs(self.deviation) <= self.within

    @property
    def same_both_ways(self) -> bool:
        """Whether all that is said of the pull forward is said of that the other way too."""
        return self.other_way is not None and self._sentence == self.other_way._sentence

    def __str__(self) -> str:
        sentence = self._sentence
        if self.same_both_ways:
            sentence = f"Both ways: {sentence}. {self.at_rest}."
        elif self.other_way is not None:
            sentence = f"Forward: {sentence}. The other way: {self.other_way}. {self.at_rest}."
        if self.three_dimensions:
            sentence = f"{sentence.removesuffix('.')}. {self.three_dimensions}"
        return sentence

    @property
    def _sentence(self) -> str:
        """That on one way."""
        found = self.measurement
        if self.measured is None:
            said = self._unmeasured()
        else:
            said = (
                f"{self._use(self.measured)}. Measured in runs, v_c = {self.measured:.6g} m/s (between {found.low:.8g} "
                f"and {found.high:.8g}), against {self.eq_15:.6g} m/s: the formula lies "
                f"{'inside' if self.holds else 'outside'} the measured interval"
            )
        return f"{self.formula[:1].upper()}{self.formula[1:]} {said}. {self.why[:1].upper()}{self.why[1:]}"

    def _use(self, measured: float) -> str:
        """How good the formula is, and what to use in its place."""
        instead = f"use {measured:.4g} m/s"
        if not np.isfinite(self.eq_15):
            return f"is infinite here; {instead}"
        if min(self.eq_15, measured) <= self.least and (self.holds or self.good):
            return "is almost zero here, and so is the measured v_c"
        if self.eq_15 <= self.least:
            return f"is almost zero here; {instead}"
        if measured <= self.least:
            return f"is too high here, where v_c is almost zero; {instead}"
        off = _off(self.eq_15 / measured)
        if self.good:
            return f"is good to {100 * self.within:.4g} % here ({off})"
        if self.holds:  # a wide bracket, or a tolerance narrower than it
            return f"is {off} here, inside the measured interval"
        return f"is {off} here; {instead}"

    def _unmeasured(self) -> str:
        """What can be said where runs found no critical velocity: without a resonance, nothing about v_c."""
        if np.isfinite(self.full_slip):
            full = f"no settled run confirmed the full-slip value {self.full_slip:.6g} m/s"
            return f"cannot be judged: {full}, against {self.eq_15:.6g} m/s by the formula"
        if self.holds is None:
            return f"cannot be judged: no critical velocity was found, against {self.eq_15:.6g} m/s"
        if self.holds:
            return "holds: no critical velocity, as it says"
        return f"fails: no critical velocity, against {self.eq_15:.6g} m/s"


@offering
def verdict(
    case: SlidingContact,
    *,
    within: float = Verdict.within,
    limit_s: float | None = None,
    accuracy: float = BUDGET,
    three_dimensions: bool = False,
) -> Verdict:
    """How good Eq. (15) is for this contact: its v_c [m/s] beside the full-slip value and the one measured from runs.

    Parameters
    ----------
    case : SlidingContact
        The contact. For a rigid pull Eq. (15) is Eq. (1).
    within : float
        Largest relative deviation [-] of the measured v_c from Eq. (15) at which the formula is called good, between 0
        and 1. It changes no run.
    limit_s : float, optional
        Seconds of computing after which the measurement ends unsettled. None sets no limit.
    accuracy : float
        Of the measurement, as in `measure_critical_velocity`.
    three_dimensions : bool
        Also run the half-space once, with coupling, and say how far the springs are off there: at half of the full-slip
        critical velocity, or of the greatest velocity across the pull where it is shaken across. Takes a rigid pull and
        an elastic or Kelvin material, and some ten seconds.

    Returns
    -------
    Verdict
        Print it for the sentence. Of a contact that is shaken in the plane it is the verdict on the pull forward, with
        that on the other way beside it, and what the contact does at rest. `good` judges by the tolerance `within`.
        `holds` judges by the bracket of the measurement, some 4e-5 of v_c wide, so that small deviations count.

    Raises
    ------
    TypeError
        For what is no case or no number.
    ValueError
        For `within` not between 0 and 1, and for a case that three dimensions refuse.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> punch, rubber = mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(punch, rubber, mu_0=0.4, oscillation=vibration)
    >>> found = mdr.verdict(case)
    >>> found.good, found.holds, found.formula
    (True, True, 'Eq. (1)')
    """
    case, within = resolved(case), _tolerance(within)  # before the runs, not after them
    with time_limit(limit_s):
        space = _in_three_dimensions(case, accuracy) if three_dimensions else ""
        forward = replace(_judged(case, within, limit_s, accuracy), three_dimensions=space)
        if not case.is_shaken:
            return forward
        back, rest = _judged(case.mirrored, within, limit_s, accuracy), _at_rest(case)
    return replace(forward, other_way=back, at_rest=rest)


def _in_three_dimensions(case: SlidingContact, accuracy: float) -> str:
    """How far springs are off, in a sentence. Raises ValueError for what the half-space cannot judge."""
    full = full_slip_critical_velocity(case)
    v_0 = (case.fastest_across or (full if 0 < full < np.inf else case.pace)) / 2
    try:
        found, springs = half_space.slide(case, v_0), slide(case, v_0, accuracy=accuracy)
    except half_space.NotConverged as why:
        return f"In three dimensions nothing is known at {v_0:.4g} m/s: {why}"
    off, error = springs.cof - found.cof, springs.cof_error + found.cof_error
    said = (
        f"In three dimensions the COF at {v_0:.4g} m/s is {with_error(found.cof, found.cof_error)}, with coupling, and "
        f"{with_error(springs.cof, springs.cof_error)} by springs"
    )
    if abs(off) <= error:
        slower = "; slower slides differ" if _held_too_much(case) > STRONG * case.mu_0 else ""
        return f"{said}: no difference beyond these errors{slower}"
    sense = "high" if off > 0 else "low"
    return f"{said}: springs are too {sense} there by {abs(off) / full_cof(case):.1g} of full friction"


def _at_rest(case: SlidingContact) -> str:
    """What a shaken contact does whose pull stands still, and where nothing holds it."""
    try:
        band, free = band_of_pull(case), no_load_velocity(case)
    except ValueError as unknown:
        return f"At rest: {unknown}"
    if band.contains(0.0) and not band.is_one_number:
        held = f"up to {band.high:.3g} of the load pulled forward and {-band.low:.3g} the other way"
        return f"At rest it holds {held}, of mu_0 = {case.mu_0:.6g}"
    push = abs(band.low + band.high) / 2
    if band.is_one_number and push <= 2 * band.error + SAME:
        return "At rest it holds nothing, as every spring slips in every period, and drives nothing"
    held = f"held, it pushes with {push:.3g} of the load"
    if not band.is_one_number:
        held = f"held, it pushes with {abs(band.low):.3g} to {abs(band.high):.3g} of the load, by how it came to rest"
    way = "forward" if band.low + band.high < 0 else "backward"
    return f"At rest it drives itself {way}: {held}, and free it runs at {abs(free):.4g} m/s"


def _judged(case: SlidingContact, within: float, limit_s: float | None, accuracy: float) -> Verdict:
    """The verdict on the pull forward."""
    eq_15, full = critical_velocity(case), _full_slip(case)
    found, least = measure_critical_velocity(case, limit_s=limit_s, accuracy=accuracy), LEAST_V_C * case.pace
    deviation: float | None = None
    holds: bool | None
    if case.moves_across or case.always_sticks:  # both closed forms say so too
        why = "; ".join([across(case), *_left_out(case)]) if case.moves_across else _at_the_edge(case)
        return Verdict(eq_15, full, None, None, True, why, found, formula_of(case), within, least)
    if found.v_c is None:
        holds = None if found.kind == "unsettled" else _holds_without_velocity(case, eq_15, full)
    elif not np.isfinite(eq_15):
        holds = False
    else:
        scale = max(eq_15, least)
        deviation = (found.v_c - eq_15) / scale
        holds = found.contains(eq_15) or max(eq_15, found.v_c) < scale
    reasons = list(_reasons(case, eq_15, full, found))
    if holds and found.v_c is not None:
        reasons = ["all springs stop sticking at the velocity that the formula gives for one spring"]
    elif found.v_c is None or not reasons:
        reasons.append(found.why)
    if case.strength_moves:
        reasons.append(_depends_on(case))
    if case.friction.stick > 1:
        reasons.append(_overshoot(case))
    why = "; ".join([*reasons, *_left_out(case)])
    return Verdict(eq_15, full, found.v_c, deviation, holds, why, found, formula_of(case), within, least)


def _full_slip(case: SlidingContact) -> float:
    """The velocity of full slip; NaN where it is not known."""
    try:
        return full_slip_critical_velocity(case)
    except ValueError:
        return float("nan")


def _depends_on(case: SlidingContact) -> str:
    """What v_c of a curved viscous face with a shear strength depends on, and that of a half-space."""
    said = "with a shear strength v_c depends on the relaxation time, and on the depth as the shape has it"
    try:
        return f"{said}; a half-space slips all over from {full_slip_of_half_space(case):.3g} m/s on"
    except OutsideDomain:
        return said


def _overshoot(case: SlidingContact) -> str:
    """How far friction that falls is above that of sliding."""
    said = "just below it friction is above that of sliding, as springs stick up to mu_s before they slip at mu_k"
    if case not in JUMPS:
        return said
    v = np.append(np.arange(1, SAMPLES) / SAMPLES, 1 - SAME)
    shares = [falling_friction(one, case.alpha, case.friction.stick).share for one in v]
    most = int(np.argmax(shares))
    last = most == v.size - 1
    greatest = "the most at any velocity" if last else f"and by {shares[most] - 1:.3g} at {v[most]:.2g} v_c, the most"
    return f"{said}: by {shares[-1] - 1:.3g} of it, {greatest}; at v_c it falls by a jump"


def _at_the_edge(case: SlidingContact) -> str:
    """What takes the place of a critical velocity on a curved face with a shear strength."""
    if case not in domain_of(velocity_of_share):
        return AT_THE_EDGE
    springs, half_space = (velocity_of_share(case, 1 - NEARLY, half_space=one) for one in (False, True))
    lost = f"it is at most {100 * NEARLY:g} % from {springs:.3g} m/s on, where friction is back in practice"
    faster = f"on a half-space it falls exponentially, and is as little from {half_space:.3g} m/s on"
    return f"{AT_THE_EDGE}; what is lost falls like v_0^-3: {lost}; {faster}"


def across(case: SlidingContact) -> str:
    """What takes the place of a critical velocity where a contact is shaken across its way."""
    said = ACROSS
    if case in domain_of(static_across):
        rest, full, too_much = static_cof(case), full_across(case, NEARLY), _held_too_much(case)
        said += (
            f"; at rest it holds {rest:.4g} of the load, and springs stick for part of the period"
            if rest
            else "; at rest it holds nothing, as every spring slips in every period"
        )
        if too_much > STRONG * case.mu_0:
            said += (
                f"; that is too much: by Coulomb's law in every point of the surface it holds {rest - too_much:.4g} of "
                "the load, and slow slides have less friction too (mdr.laws.excess_across)"
            )
        where = f"from about {full:.3g} m/s on" if full else "at any velocity"
        said += f"; friction is within {100 * NEARLY:g} % of mu_0 {where}" if np.isfinite(full) else ""
    return f"{said}; the greatest velocity across is {case.fastest_across:.3g} m/s"


def _held_too_much(case: SlidingContact) -> float:
    """By how much [-] springs hold more at rest than Coulomb's law in every point allows; 0 where it is not known."""
    if case not in domain_of(static_across) or case.indenter.least_depth > 0:
        return 0.0
    return static_across(case) - static_across(case, surface=True)


def _tolerance(within: float) -> float:
    return between("within", within, 0, 1, "a share of v_c: 0.01 for 1 %")


def _off(ratio: float) -> str:
    """How far the formula is from the measured value, by their ratio: in per cent, or as a factor from 2 on."""
    which, by_factor = "high" if ratio > 1 else "low", not 0.5 < ratio < 2
    size = max(ratio, 1 / ratio) if by_factor else 100 * abs(ratio - 1)
    digits = f"{float(f'{size:.2g}'):g}"
    return f"too {which} by a factor of {digits}" if by_factor else f"{digits} % too {which}"


def _holds_without_velocity(case: SlidingContact, eq_15: float, full: float) -> bool | None:
    """Whether the formula holds where runs found no velocity: friction stays reduced for ever on a resonance alone."""
    resonance = not np.isfinite(full) and np.isfinite(case.pull.omega_0)
    if not resonance or HIGHEST * case.pace < eq_15 < np.inf:  # beyond that no run has looked
        return None
    return bool(np.isinf(eq_15))


def _reasons(case: SlidingContact, eq_15: float, full: float, found: MeasuredVelocity) -> Iterator[str]:
    if not np.isfinite(eq_15):
        yield "the body is driven at its undamped natural frequency, where the formula has its pole"
    if not np.isfinite(full) and np.isfinite(eq_15):
        yield (
            "a harmonic of the normal force drives the body at its undamped natural frequency"
            if np.isfinite(case.pull.omega_0)
            else "the body, which has no inertia, gets an infinite velocity for an instant when a dashpot touches again"
        )
    if not case.keeps_contact:
        yield "contact is lost in part of the period, Eq. (5)"
    if case.pull.is_rigid and case.oscillation.load is None:
        if full < eq_15 * (1 - SAME):
            yield "the contact is still open at the instant of fastest approach, on which Eq. (1) rests"
    elif np.isfinite(eq_15) and found.contains(full):
        what = "normal force" if case.oscillation.load is None else "depth"
        yield (
            f"at this amplitude the contact stiffness changes within the period and the {what} has harmonics; "
            "with them the full-slip condition gives the measured value"
        )


def _left_out(case: SlidingContact) -> Iterator[str]:
    """The part of the sentence about normal-tangential coupling, where it matters."""
    beta = case.material.dundurs_beta
    springs = f"all this is of springs, which leave out normal-tangential coupling (Dundurs' beta = {beta:.2f})"
    if case not in domain_of(radial_rub):
        if abs(beta) > STRONG:
            yield springs
        return
    rub, left_out = radial_rub(case), f"{springs}; with it, in three dimensions,"
    if case in domain_of(static_across):
        stiffer = stiffened_by_coupling(case.material)
        if stiffer > STRONG:
            yield f"{left_out} it acts like a contact stiffer along its surface by {100 * stiffer:.2g} %"
    elif case.is_shaken:
        if abs(beta) > STRONG and case.oscillation.omega:
            yield f"{left_out} friction is lower than here, by how much under a shake was not computed"
    elif case not in domain_of(coupling_loss):
        if abs(beta) > STRONG:
            yield f"{left_out} friction is lower than here, and part of the contact may still stick above this velocity"
    elif rub > STRONG:
        most = "" if rub <= LOSS.flat else " (more than half as much again under a flat face)"
        yield (
            f"{left_out} friction is lower than here by up to about {coupling_loss(case):.1g} of mu_0{most}, and part "
            f"of the contact sticks up to about {1 + rub:.2f} times the full-slip velocity"
        )
