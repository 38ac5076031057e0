"""What a contact does at rest, or unloaded, that is shaken in the plane: which loads it holds, how fast it runs.

Friction of a contact that is pulled ever slower forward tends to one end of a band, pulled ever slower the other way to
the other end. A mean force between them is held for ever: springs that never slip keep what they were stretched by. A
force beyond makes the contact creep. Where every spring slips in every period the two ends meet: the force at rest is
one number, of either sign, and a contact without load drives by itself.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.domain import COULOMB, holds_for
from mdr.case.pull import RigidPull
from mdr.closed_forms.held_body import held_forward
from mdr.closed_forms.shaken_pull import CLOSED_FORM
from mdr.friction.cof_curve import cof_curve, friction_at
from mdr.march.periodic.steady import BUDGET, LEAST_ACCURATE, MOST_ACCURATE
from mdr.march.result.slide import slide
from mdr.normal.resolved import resolved
from mdr.tools.arrays import EXACT, SAME, beyond
from mdr.tools.checks import finite
from mdr.tools.memoise import remembered

at_rest = holds_for(COULOMB, of=resolved, instead="cof_curve, at v_0 = 0 too")


@dataclass(frozen=True)
class HoldingBand:
    """The mean F_x over mean F_z [-] that a contact holds: between low and high it neither creeps nor drives."""

    low: float  #: limit of the friction pulled ever slower the other way, v_0 -> -0 [-]
    high: float  #: the same pulled forward, v_0 -> +0 [-]
    error: float  #: bound on the numerical error of either, estimated from slow runs where no closed form tells [-]

    @property
    def is_one_number(self) -> bool:
        """Whether the two ends are the same within their error: at rest nothing is held but this one force."""
        return self.high - self.low <= 2 * self.error + SAME

    def contains(self, load: float) -> bool:
        """Whether a load is held for ever.

        Parameters
        ----------
        load : float
            Mean tangential force over mean normal force [-].

        Returns
        -------
        bool
            True between the two ends.
        """
        return self.low - self.error <= finite("load", load) <= self.high + self.error


@at_rest
def holding_band(case: SlidingContact) -> HoldingBand:
    """Loads [-], mean F_x over mean F_z, that a contact holds at rest, neither creeping nor driving.

    A shaken tool is held rigidly, whatever the pull. Where the pulling point is shaken it is the body that is held, by
    its spring: what the contact bears while it sticks is what spring and damper pass on.

    Parameters
    ----------
    case : SlidingContact
        The contact.

    Returns
    -------
    HoldingBand
        `low` and `high` [-]. Without a shake in the plane, minus and plus the static coefficient of friction.

    Raises
    ------
    TypeError
        For what is no SlidingContact.
    ValueError
        Where a run that would tell does not settle.

    See Also
    --------
    blocked_cof : where the band is one number.
    no_load_velocity : how fast it runs where it holds nothing.

    Examples
    --------
    >>> import mdr
    >>> punch, rubber = mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.5)
    >>> depth, shake = mdr.ConstantDepth(u_z0=20e-6), mdr.InPlaneOscillation(omega=300.0, du_x=5e-6)
    >>> case = mdr.SlidingContact(punch, rubber, mu_0=0.4, oscillation=depth, shake=shake)
    >>> band = mdr.holding_band(case)
    >>> print(f"{band.low:.4f} to {band.high:.4f}")  # springs slip at 12e-6 m, of which the shake takes 5e-6
    -0.2333 to 0.2333
    """
    return band_of_pull(case if case.is_shaken_at_pull else replace(case, pull=RigidPull()))


def holder_of(case: SlidingContact) -> str:
    """What holds the contact in `holding_band`, in words."""
    return "its own pull, whose far end is shaken" if case.is_shaken_at_pull else "a rigid pull that stands still"


@remembered(maxsize=16)  # a command asks for it more than once
@at_rest
def band_of_pull(case: SlidingContact) -> HoldingBand:
    """Both limits of friction at rest of a case of known depth, under its own pull; ValueError as in `holding_band`."""
    accuracy = LEAST_ACCURATE if case.moves_across else BUDGET  # where two slow runs tell the limit, no more is known
    forward = cof_curve(case, [0.0], accuracy=accuracy)
    back = forward if case.is_alike_both_ways else cof_curve(case.mirrored, [0.0], accuracy=accuracy)
    if not (forward.settled.all() and back.settled.all()):
        why = (forward.why[0] or back.why[0]).partition(": raise")[0]
        more = "more periods may tell, mdr.slide(case, 0.0, n_periods=...)"
        raise ValueError(f"friction at rest is not known, as its run does not settle: {why}; {more}")
    error = float(max(forward.cof_error[0], back.cof_error[0]))
    low, high = 0.0 - float(back.cof[0]), float(forward.cof[0])
    return HoldingBand(low=min(low, high), high=max(low, high), error=error)


@at_rest
def blocked_cof(case: SlidingContact) -> float:
    """Mean F_x over mean F_z [-] of a contact whose pull does not move, where it is one number.

    Parameters
    ----------
    case : SlidingContact
        The contact, with its pull.

    Returns
    -------
    float
        Negative where the contact pushes forward: the blocked force of a drive, over the load.

    Raises
    ------
    TypeError
        For what is no SlidingContact.
    ValueError
        Where the contact holds a band of forces, which is named.

    Examples
    --------
    >>> import mdr
    >>> depth = mdr.NormalOscillation(u_z0=20e-6, du_z=15e-6, omega=300.0)
    >>> shake = mdr.InPlaneOscillation(omega=300.0, du_x=60e-6, phi_x=0.5 * 3.141592653589793)
    >>> case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(3e6, 0.5), 0.4, depth, shake=shake)
    >>> print(f"{mdr.blocked_cof(case):.3f}")
    -0.221
    """
    band = band_of_pull(case)
    if not band.is_one_number:
        raise ValueError(
            f"the contact holds any mean F_x over mean F_z between {band.low:.6g} and {band.high:.6g}: the force at "
            "rest is no single number, and depends on how it came to rest"
        )
    return float(beyond(EXACT * case.mu_0, 0.5 * (band.low + band.high)))


@at_rest
def no_load_velocity(case: SlidingContact) -> float:
    """Velocity [m/s] at which a shaken contact runs that nothing holds back: where the mean F_x is zero.

    Parameters
    ----------
    case : SlidingContact
        The contact.

    Returns
    -------
    float
        Of either sign; 0 where the contact holds zero load.

    Raises
    ------
    TypeError
        For what is no SlidingContact.
    ValueError
        Where a run that would tell does not settle.

    Examples
    --------
    >>> import mdr
    >>> depth = mdr.NormalOscillation(u_z0=20e-6, du_z=15e-6, omega=300.0)
    >>> shake = mdr.InPlaneOscillation(omega=300.0, du_x=60e-6, phi_x=0.5 * 3.141592653589793)
    >>> case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(3e6, 0.5), 0.4, depth, shake=shake)
    >>> print(f"{mdr.no_load_velocity(case):.3g} m/s")
    0.00966 m/s
    """
    return _free(case)


@remembered(maxsize=16)
def _free(case: SlidingContact) -> float:
    if case.is_alike_both_ways:
        return 0.0  # as the friction of a pull the other way is its mirror image
    ends = [held_forward(one) for one in (case, case.mirrored)]
    if all(end is not None and end.cof > end.error for end in ends):
        return 0.0
    if not np.isfinite(case.pace):
        raise ValueError("the pulling point is shaken at the undamped natural frequency of the body: add c_x")
    # where the velocity of a contact that drives is looked for first
    low = 1e-3 * case.pace
    side = next((way for way, one in ((1, case), (-1, case.mirrored)) if _cof(one, low) < 0), 0)
    if side == 0:  # zero load lies between the two: is it held?
        band = band_of_pull(case)
        if band.contains(0.0):
            return 0.0
        side, low = (1 if band.high < 0 else -1), 0.0
    ahead, high = case if side == 1 else case.mirrored, case.pace
    while _cof(ahead, high) <= 0:  # in full slip, if not before, it is held back
        low, high = high, 2 * high
    from scipy.optimize import brentq

    close = SAME if ahead in CLOSED_FORM else BUDGET / 10  # a run knows its friction to no more than BUDGET
    return side * float(brentq(lambda v_0: _cof(ahead, v_0), low, high, xtol=close * case.pace, rtol=close))


def _cof(case: SlidingContact, v_0: float) -> float:
    """Friction at one velocity, that of a settled run."""
    if case in CLOSED_FORM:
        return friction_at(case, v_0, MOST_ACCURATE)[0]
    run = slide(case, v_0)
    if not run.settled:
        raise ValueError(f"friction at {v_0:.6g} m/s is not known, as its run does not settle: {run.why}")
    return run.cof
