"""Maxwell arms from measured dynamic moduli, or from a power law.

Relaxation times are spread evenly in log time. The moduli follow by non-negative least squares of the relative
deviation of E(omega) (Lawson and Hanson 1974, `scipy.optimize.nnls`), so that every arm is passive.
"""

from itertools import product
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.materials.base import Arms, OneBody, arm
from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import between, count, finite_array, positive, positive_array
from mdr.tools.warned import warn_outside

TOLD = 0.1  #: misfit that is told: dynamic tests are good to some 5 %, and one of ten points to twice that
ONE = 0.01  #: relative difference of frequencies that are one: no passive modulus rises faster than its frequency
MOST_ARMS = 60  #: of a power law, as many as are tried before it is refused


def to_data(omega: Array, modulus: Any, n_arms: int | None) -> tuple[float, Arms, float]:
    """E_inf [Pa] and arms closest to measured moduli, and the greatest relative deviation that they leave."""
    n_arms = number_of_arms(omega, omega.size, n_arms)
    return _closest(omega, modulus, 1 / spread(omega.min(), omega.max(), n_arms))


def to_power_law(modulus: float, exponent: float, omega: tuple[float, float], error: float) -> tuple[float, Arms]:
    """E_inf [Pa] and arms of a spring-pot over a range of frequencies."""
    modulus = positive("modulus", modulus, "|E| at omega[0] in Pa")
    exponent = between("exponent", exponent, 0, 1, "of the power law")
    error = positive("error", error, "relative deviation")
    low, high = _range(omega)
    dense = np.geomspace(low, high, 40 * (1 + int(np.ceil(np.log10(high / low)))))
    wanted = modulus * (1j * dense / low) ** exponent
    least = np.inf
    # arms reach beyond the range by a margin, for the rest of a power law
    for n_arms, margin in product(range(2, MOST_ARMS + 1), (3.0, 10.0, 100.0, 1000.0)):
        times = np.geomspace(1 / (margin * high), min(margin, 10) / low, n_arms)
        E_inf, arms, missed = _closest(dense, wanted, times)
        if E_inf == 0:
            continue  # flows in the end
        least = min(least, missed)
        if missed <= error:
            return E_inf, arms
    raise ValueError(
        f"error = {error:g} of the power law is not reached by {MOST_ARMS} arms, only {least:.2g}: "
        "raise error or narrow the range omega"
    )


def arms_of(moduli: Array, times: Array) -> Arms:
    """The arms that have a modulus."""
    return tuple((E, time) for E, time in zip(moduli.tolist(), times.tolist(), strict=True) if E > 0)


def misfits(material: OneBody, omega: Array, modulus: Any) -> Array:
    """Relative deviations of a body from measured moduli."""
    own = np.asarray(material.dynamic_modulus(omega)) * (1 - material.nu**2)
    return np.asarray(np.abs(own - modulus) / np.abs(modulus))


def warn_of_misfit(material: OneBody, omega: Array, modulus: Any, n_arms: int | None) -> None:
    """Warn where a fitted body misses the data by more than they are good for, with what may help."""
    missed = misfits(material, omega, modulus)
    k, usual = int(np.argmax(missed)), usual_arms(omega)
    if missed[k] <= TOLD:
        return
    if twice(omega, modulus).size:
        way_out = "frequencies repeat with other moduli: give one temperature, mdr.read_moduli(path, temperature=20)"
    elif (n_arms or omega.size // 2) < usual and to_data(omega, modulus, usual)[2] < missed[k] / 2:
        way_out = f"n_arms={usual} may come nearer"
    else:
        way_out = "no arms have such moduli at one temperature: is a unit wrong, or a column another quantity?"
    warn_outside(
        f"the body misses the moduli by {missed[k]:.0%} at {omega[k]:.4g} rad/s ({omega[k] / (2 * np.pi):.4g} Hz); "
        f"noise alone is hardly more than {TOLD:.0%}: {way_out}"
    )


def twice(omega: Array, modulus: Any) -> Array:
    """Places, in the order of frequency, whose frequency the next one has too, with a modulus that differs by TOLD."""
    order = np.argsort(omega, kind="stable")
    omega, modulus = omega[order], np.asarray(modulus)[order]
    differ = np.abs(np.diff(modulus)) > TOLD * np.minimum(np.abs(modulus[1:]), np.abs(modulus[:-1]))
    return np.asarray(order[:-1][(np.diff(omega) <= ONE * omega[:-1]) & differ])


def usual_arms(places: Array) -> int:
    """Three a decade, of times or frequencies."""
    return round(3.0 * float(np.log10(places.max() / places.min()))) + 1


def number_of_arms(places: Array, n_data: int, n_arms: int | None) -> int:
    """As many as are asked for; None: the usual number, but no more than half the data can tell."""
    if n_arms is None:
        n_arms = max(1, min(usual_arms(places), n_data // 2))
    return count("n_arms", n_arms, 1)


def spread(first: float, last: float, n: int) -> Array:
    """So many times or frequencies, even in log time; a single one is in the middle."""
    return np.geomspace(first, last, n) if n > 1 else np.array([np.sqrt(first * last)])


def _closest(omega: Array, modulus: Any, times: Array) -> tuple[float, Arms, float]:
    """E_inf and arms of these times, non-negative, of least relative deviation, and the greatest that is left."""
    weight, of_arms = 1 / np.abs(modulus), arm(np.outer(omega, times))
    columns = np.column_stack([np.ones(omega.size), of_arms]) * weight[:, None]
    target = modulus * weight
    rows, wanted = (np.concatenate([one.real, one.imag]) for one in (columns, target))
    found = least_squares(rows, wanted)
    E_inf, moduli = float(found[0]), found[1:]
    missed = np.max(np.abs(of_arms @ moduli + E_inf - modulus) / np.abs(modulus))
    return E_inf, arms_of(moduli, times), float(missed)


def least_squares(rows: Array, wanted: Array) -> Array:
    """The non-negative numbers, (n,), of which `rows`, (m, n), come closest to what is wanted; 0 for the tiny."""
    from scipy.optimize import nnls

    found, _ = nnls(rows, wanted, maxiter=100 * rows.shape[1])
    found[found < SAME * found.max()] = 0.0
    return np.asarray(found)


def data_of(omega: ArrayLike, storage: ArrayLike, loss: ArrayLike) -> tuple[Array, Any]:
    """Frequencies [rad/s] and the complex moduli [Pa] that were measured at them."""
    omega = positive_array("omega", omega, "rad/s")
    storage, loss = positive_array("storage", storage, "Pa"), finite_array("loss", loss, "Pa")
    if np.any(loss < 0):
        raise ValueError(f"loss must not be negative, got {float(loss.min())!r} Pa: no passive body gives energy back")
    if not omega.ndim == 1 <= omega.size or not omega.shape == storage.shape == loss.shape:
        raise ValueError(
            "omega, storage and loss must be lists of one length, "
            f"got shapes {omega.shape}, {storage.shape}, {loss.shape}"
        )
    return omega, storage + 1j * loss


def _range(omega: tuple[float, float]) -> tuple[float, float]:
    ends = positive_array("omega", omega, "rad/s")
    if ends.shape != (2,) or not ends[0] < ends[1]:
        raise ValueError(f"omega must be a range (lowest, highest) in rad/s, got {omega!r}")
    return float(ends[0]), float(ends[1])
