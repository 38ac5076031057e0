"""Maxwell arms from a measured relaxation E(t) after a step of strain, or a creep J(t) after a step of stress.

    E(t) = E_inf + sum_j E_j exp(-t/tau_j),    J(t) = J_0 + sum_k J_k (1 - exp(-t/theta_k))

Compliances are turned into arms exactly: tau_j are the zeros of J_0 + sum_k J_k tau/(tau - theta_k) (Park and Schapery
1999). The dynamic modulus needs what no relaxation shows, E(t) before the first time t_1. Where that goes on like
t^-p, with the slope p that it has at t_1, it adds i omega t_1 p/(1 - p) of E(t_1). It adds little to a creep.
"""

import numpy as np
from numpy.typing import ArrayLike

from mdr.materials import spectrum
from mdr.materials.base import Arms
from mdr.materials.prony_fit import TOLD
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, positive_array
from mdr.tools.secular import secular_zeros
from mdr.tools.warned import warn_outside

BEYOND = (2.0, 3.0)  #: wider ranges of times: an arm three times faster than the first time has left 5 % there
MANY, NEXT = 1000, 0.005  #: readings, beyond which those whose log time differs by less are taken for their mean
INSIDE = 10.0  #: times that the first one, inverted, exceeds the frequency up to which a relaxation serves


def to_relaxation(t: ArrayLike, modulus: ArrayLike, n_arms: int | None) -> tuple[float, Arms]:
    """E_inf [Pa] and arms closest to a relaxation."""
    t, modulus = data_of(t, "modulus", modulus, "Pa")
    found = _nearest(t, modulus, n_arms, is_creep=False)
    return found.constant, found.arms


def to_creep(t: ArrayLike, compliance: ArrayLike, n_arms: int | None) -> tuple[float, Arms, float]:
    """E_inf [Pa], arms and Kelvin time [s], above zero only where nothing yields at once, closest to a creep."""
    t, compliance = data_of(t, "compliance", compliance, "1/Pa")
    found = _nearest(t, compliance, n_arms, is_creep=True)
    start, J, theta = found.constant, found.shares[::-1], found.times[::-1]  # ascending times
    E_inf = 1 / (start + float(J.sum()))
    if not J.size:
        return E_inf, (), 0.0
    tau = secular_zeros(start, 0.0, J, theta)
    Kelvin = 0.0 if start > 0 else 1 / (E_inf * float(np.sum(J / theta)))
    tau = tau[tau > 0]
    slope = np.sum(J * theta * tau[:, None] / (tau[:, None] - theta) ** 2, axis=1)
    return E_inf, tuple(zip((1 / slope).tolist(), tau.tolist(), strict=True)), Kelvin


def data_of(t: ArrayLike, name: str, values: ArrayLike, unit: str) -> tuple[Array, Array]:
    """Times [s] and what was measured at them, above zero."""
    t, values = finite_array("t", t, "s"), positive_array(name, values, unit)
    if t.ndim != 1 or t.shape != values.shape:
        raise ValueError(f"t and {name} must be lists of one length, got shapes {t.shape} and {values.shape}")
    if not (np.all(t >= 0) and np.count_nonzero(np.unique(t)) > 1):
        raise ValueError("t must count from the step, and hold two times above 0 s or more")
    return t, values


def _nearest(t: Array, wanted: Array, n_arms: int | None, is_creep: bool) -> spectrum.Sum:
    """The sum closest to a test, with warnings of what it misses."""
    after = t[t > 0]
    ends = float(after.min()), float(after.max())
    if t.size > MANY:  # means over times that are next to the same
        _, cell, counts = np.unique(
            np.floor(np.log(np.maximum(t, ends[0])) / NEXT), return_inverse=True, return_counts=True
        )
        t, wanted = (np.bincount(cell, one) / counts for one in (t, wanted))
        weight = np.sqrt(counts)
    else:
        weight = np.ones(t.size)

    def term(times: Array) -> Array:
        past = t[:, None] / times
        return -np.expm1(-past) if is_creep else np.exp(-past)

    data = spectrum.Data(term, wanted, weight)
    found = spectrum.nearest(data, ends, BEYOND, n_arms)
    free = found if n_arms is None else spectrum.nearest(data, ends, BEYOND, None)
    if free.missed.max() <= TOLD:
        spectrum.warn_of_few(found, free)
        if not is_creep:
            _warn_of_the_start(found, ends[0])
    else:
        k = int(np.argmax(found.missed))
        warn_outside(
            f"the body misses the test by {found.missed[k]:.0%} at {t[k]:.4g} s, and noise alone is hardly more than "
            f"{TOLD:.0%}: no arms {'creep' if is_creep else 'relax'} so; is a unit wrong, or the end of the step later?"
        )
    return found


def _warn_of_the_start(found: spectrum.Sum, first: float) -> None:
    """Warn where what a relaxation did before the first time counts at a frequency a decade below its inverse."""
    left = found.shares * np.exp(-first / found.times)
    slope = float(np.sum(left * first / found.times) / (found.constant + left.sum()))
    missed = slope / max(INSIDE * (1 - slope), slope)
    if missed > spectrum.DIGITS:
        warn_outside(
            f"E(omega) of the body may be off by {missed:.1%} of it at {1 / (INSIDE * first):.3g} rad/s, more above: "
            f"at the first time, {first:.3g} s, the modulus still falls like t^-{slope:.2g}; measure from earlier on"
        )
