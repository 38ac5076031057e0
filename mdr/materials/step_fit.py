"""Maxwell arms from a measured relaxation E(t) after a step of strain, or a creep J(t) after a step of stress.

    E(t) = E_inf + sum_j E_j exp(-t/tau_j),    J(t) = J_0 + sum_k J_k (1 - exp(-t/theta_k))

Times are spread evenly in log time over the record; moduli and compliances follow by non-negative least squares of the
relative deviation. Compliances are turned into arms exactly: tau_j are the zeros of J_0 + sum_k J_k tau/(tau - theta_k)
(Park and Schapery 1999).
"""

import numpy as np
from numpy.typing import ArrayLike

from mdr.materials.base import Arms, OneBody
from mdr.materials.prony_fit import TOLD, arms_of, least_squares, number_of_arms, spread
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, positive_array
from mdr.tools.secular import secular_zeros
from mdr.tools.warned import warn_outside


def to_relaxation(t: ArrayLike, modulus: ArrayLike, n_arms: int | None) -> tuple[float, Arms]:
    """E_inf [Pa] and arms closest to a relaxation."""
    t, modulus = data_of(t, "modulus", modulus, "Pa")
    times = _times(t, n_arms)
    rows = np.column_stack([np.ones(t.size), np.exp(-t[:, None] / times)])
    found = least_squares(rows / modulus[:, None], np.ones(t.size))
    return float(found[0]), arms_of(found[1:], times)


def to_creep(t: ArrayLike, compliance: ArrayLike, n_arms: int | None) -> tuple[float, Arms, float]:
    """E_inf [Pa], arms and Kelvin time [s], above zero only where nothing yields at once, closest to a creep."""
    t, compliance = data_of(t, "compliance", compliance, "1/Pa")
    times = _times(t, n_arms)
    rows = np.column_stack([np.ones(t.size), -np.expm1(-t[:, None] / times)])
    found = least_squares(rows / compliance[:, None], np.ones(t.size))
    kept = np.flatnonzero(found[1:])[::-1]  # ascending times
    start, J, theta = float(found[0]), found[1:][kept], times[kept]
    E_inf = 1 / (start + float(J.sum()))
    if not J.size:
        return E_inf, (), 0.0
    tau = secular_zeros(start, 0.0, J, theta)
    Kelvin = 0.0 if start > 0 else 1 / (E_inf * float(np.sum(J / theta)))
    tau = tau[tau > 0]
    slope = np.sum(J * theta * tau[:, None] / (tau[:, None] - theta) ** 2, axis=1)
    return E_inf, arms_of(1 / slope, tau), Kelvin


def data_of(t: ArrayLike, name: str, values: ArrayLike, unit: str) -> tuple[Array, Array]:
    """Times [s] and what was measured at them, above zero."""
    t, values = finite_array("t", t, "s"), positive_array(name, values, unit)
    if t.ndim != 1 or t.shape != values.shape:
        raise ValueError(f"t and {name} must be lists of one length, got shapes {t.shape} and {values.shape}")
    if not (np.all(t >= 0) and np.count_nonzero(np.unique(t)) > 1):
        raise ValueError("t must count from the step, and hold two times above 0 s or more")
    return t, values


def warn_of_misfit(body: OneBody, t: ArrayLike, wanted: ArrayLike, is_creep: bool) -> None:
    """Warn where a body misses what was measured by more than tests are good for."""
    t, share = np.asarray(t, dtype=float), 1 - body.nu**2
    own = body.creep_compliance(t) / share if is_creep else body.relaxation_modulus(t) * share
    off = np.abs(own / np.asarray(wanted) - 1)
    if (k := int(np.argmax(off))) >= 0 and off[k] > TOLD:
        warn_outside(
            f"the body misses the test by {off[k]:.0%} at {t[k]:.4g} s, and noise alone is hardly more than "
            f"{TOLD:.0%}: no arms {'creep' if is_creep else 'relax'} so; is a unit wrong, or the end of the step later?"
        )


def _times(t: Array, n_arms: int | None) -> Array:
    """Times of arms, slowest first, over the times behind the step."""
    after = t[t > 0]
    return spread(after.max(), after.min(), number_of_arms(after, t.size, n_arms))
