"""Maxwell arms from measured dynamic moduli, or from a power law.

Relaxation times are spread evenly in log time. The moduli follow by non-negative least squares of the relative
deviation of E(omega) (Lawson and Hanson 1974, `scipy.optimize.nnls`), so that every arm is passive.
"""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.materials.base import OneBody, arm
from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import between, count, finite_array, positive, positive_array
from mdr.tools.warned import warn_outside

Pairs = tuple[tuple[float, float], ...]

TOLD = 0.1  #: misfit that is told: dynamic tests are good to some 5 %, and one of ten points to twice that
ONE = 0.01  #: relative difference of frequencies that are one: no passive modulus rises faster than its frequency
MOST_ARMS = 60  #: of a power law, as many as are tried before it is refused


def to_data(omega: ArrayLike, storage: ArrayLike, loss: ArrayLike, n_arms: int | None) -> tuple[float, Pairs]:
    """E_inf [Pa] and arms closest to measured moduli."""
    omega, modulus = _data(omega, storage, loss)
    if n_arms is None:
        n_arms = max(1, min(usual_arms(omega), omega.size // 2))
    n_arms = count("n_arms", n_arms, 1)
    times = _times(omega, n_arms)
    E_inf, moduli = _moduli(omega, modulus, times)
    return E_inf, arms_of(moduli, times)


def _times(omega: Array, n_arms: int) -> Array:
    """Relaxation times [s] of so many arms, spread over the frequencies."""
    low, high = omega.min(), omega.max()
    return np.asarray(1 / (np.geomspace(low, high, n_arms) if n_arms > 1 else np.array([np.sqrt(low * high)])))


def to_power_law(modulus: float, exponent: float, omega: tuple[float, float], error: float) -> tuple[float, Pairs]:
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
        E_inf, moduli = _moduli(dense, wanted, times)
        if E_inf == 0:
            continue  # flows in the end
        missed = float(np.max(np.abs(arm(np.outer(dense, times)) @ moduli + E_inf - wanted) / np.abs(wanted)))
        least = min(least, missed)
        if missed <= error:
            return E_inf, arms_of(moduli, times)
    raise ValueError(
        f"error = {error:g} of the power law is not reached by {MOST_ARMS} arms, only {least:.2g}: "
        "raise error or narrow the range omega"
    )


def arms_of(moduli: Array, times: Array) -> Pairs:
    """The arms that have a modulus."""
    return tuple((E, time) for E, time in zip(moduli.tolist(), times.tolist(), strict=True) if E > 0)


def misfit(material: OneBody, omega: ArrayLike, storage: ArrayLike, loss: ArrayLike) -> float:
    """Greatest relative deviation from measured moduli."""
    return float(_misfits(material, *_data(omega, storage, loss)).max())


def warn_of_misfit(
    material: OneBody, omega: ArrayLike, storage: ArrayLike, loss: ArrayLike, n_arms: int | None
) -> None:
    """Warn where a fitted body misses the data by more than they are good for, with what may help."""
    omega, modulus = _data(omega, storage, loss)
    missed = _misfits(material, omega, modulus)
    k, usual = int(np.argmax(missed)), usual_arms(omega)
    if missed[k] <= TOLD:
        return
    if twice(omega, modulus).size:
        way_out = "frequencies repeat with other moduli: give one temperature, mdr.read_moduli(path, temperature=20)"
    elif (n_arms or omega.size // 2) < usual and _misfit_with(usual, omega, modulus) < missed[k] / 2:
        way_out = f"n_arms={usual} may come nearer"
    else:
        way_out = "no arms have such moduli at one temperature: is a unit wrong, or a column another quantity?"
    warn_outside(
        f"the body misses the moduli by {missed[k]:.0%} at {omega[k]:.4g} rad/s ({omega[k] / (2 * np.pi):.4g} Hz); "
        f"noise alone is hardly more than {TOLD:.0%}: {way_out}"
    )


def _misfit_with(n_arms: int, omega: Array, modulus: Any) -> float:
    """Greatest relative deviation of so many arms."""
    times = _times(omega, n_arms)
    E_inf, moduli = _moduli(omega, modulus, times)
    return float(np.max(np.abs(E_inf + arm(np.outer(omega, times)) @ moduli - modulus) / np.abs(modulus)))


def twice(omega: Array, modulus: Any) -> Array:
    """Places, in the order of frequency, whose frequency the next one has too, with a modulus that differs by TOLD."""
    order = np.argsort(omega, kind="stable")
    omega, modulus = omega[order], np.asarray(modulus)[order]
    differ = np.abs(np.diff(modulus)) > TOLD * np.minimum(np.abs(modulus[1:]), np.abs(modulus[:-1]))
    return np.asarray(order[:-1][(np.diff(omega) <= ONE * omega[:-1]) & differ])


def _misfits(material: OneBody, omega: Array, modulus: Any) -> Array:
    own = np.asarray(material.dynamic_modulus(omega)) * (1 - material.nu**2)
    return np.asarray(np.abs(own - modulus) / np.abs(modulus))


def usual_arms(omega: Array) -> int:
    """Three a decade."""
    return round(3.0 * float(np.log10(omega.max() / omega.min()))) + 1


def _moduli(omega: Array, modulus: Any, times: Array) -> tuple[float, Array]:
    """E_inf and arm moduli, non-negative, of least relative deviation."""
    weight = 1 / np.abs(modulus)
    columns = np.column_stack([np.ones(omega.size), arm(np.outer(omega, times))]) * weight[:, None]
    target = modulus * weight
    rows, wanted = (np.concatenate([one.real, one.imag]) for one in (columns, target))
    found = least_squares(rows, wanted)
    return float(found[0]), found[1:]


def least_squares(rows: Array, wanted: Array) -> Array:
    """The non-negative numbers, (n,), of which `rows`, (m, n), come closest to what is wanted; 0 for the tiny."""
    from scipy.optimize import nnls

    found, _ = nnls(rows, wanted, maxiter=100 * rows.shape[1])
    found[found < SAME * found.max()] = 0.0
    return np.asarray(found)


def _data(omega: ArrayLike, storage: ArrayLike, loss: ArrayLike) -> tuple[Array, Any]:
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
