"""Maxwell arms from measured dynamic moduli, or from a power law, so that every arm is passive (`spectrum`)."""

from itertools import product
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.materials import spectrum
from mdr.materials.base import Arms, OneBody, arm
from mdr.tools.arrays import Array
from mdr.tools.checks import between, finite_array, positive, positive_array
from mdr.tools.warned import warn_outside

TOLD = 0.1  #: misfit that is told: dynamic tests are good to some 5 %, and one of ten points to twice that
ONE = 0.01  #: relative difference of frequencies that are one: no passive modulus rises faster than its frequency
MOST_ARMS = 60  #: of a power law, as many as are tried before it is refused
BEYOND = (2.0, 3.0, 5.0, 10.0)  #: wider ranges of times: an arm ten times slower than 1/omega has a tenth of it as loss


def to_data(omega: Array, modulus: Any, n_arms: int | None) -> spectrum.Sum:
    """The long-time modulus E_inf [Pa], and the arms, closest to measured moduli."""
    ends = float(1 / omega.max()), float(1 / omega.min())
    return spectrum.nearest(_over(omega, modulus), ends, BEYOND, n_arms)


def _over(omega: Array, modulus: Any) -> spectrum.Data:
    """Moduli over frequency, which arms are to come close to."""
    return spectrum.Data(lambda times: arm(np.outer(omega, times)), modulus, np.ones(omega.size))


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
        found = spectrum.of_times(_over(dense, wanted), times)
        if found.constant == 0:
            continue  # flows in the end
        missed = float(found.missed.max())
        least = min(least, missed)
        if missed <= error:
            return found.constant, found.arms
    raise ValueError(
        f"error = {error:g} of the power law is not reached by {MOST_ARMS} arms, only {least:.2g}: "
        "raise error or narrow the range omega"
    )


def misfits(material: OneBody, omega: Array, modulus: Any) -> Array:
    """Relative deviations of a body from measured moduli."""
    own = np.asarray(material.dynamic_modulus(omega)) * (1 - material.nu**2)
    return np.asarray(np.abs(own - modulus) / np.abs(modulus))


def warn_of_misfit(found: spectrum.Sum, omega: Array, modulus: Any, n_arms: int | None) -> None:
    """Warn where arms miss the data by more than they are good for, with what may help."""
    free = found if n_arms is None else to_data(omega, modulus, None)
    if free.missed.max() <= TOLD:
        return spectrum.warn_of_few(found, free)
    k = int(np.argmax(found.missed))
    way_out = "no arms have such moduli at one temperature: is a unit wrong, or a column another quantity?"
    if twice(omega, modulus).size:
        way_out = "frequencies repeat with other moduli: give one temperature, mdr.read_moduli(path, temperature=20)"
    warn_outside(
        f"the body misses the moduli by {found.missed[k]:.0%} at {omega[k]:.4g} rad/s "
        f"({omega[k] / (2 * np.pi):.4g} Hz); noise alone is hardly more than {TOLD:.0%}: {way_out}"
    )


def twice(omega: Array, modulus: Any) -> Array:
    """Places, in the order of frequency, whose frequency the next one has too, with a modulus that differs by TOLD."""
    order = np.argsort(omega, kind="stable")
    omega, modulus = omega[order], np.asarray(modulus)[order]
    differ = np.abs(np.diff(modulus)) > TOLD * np.minimum(np.abs(modulus[1:]), np.abs(modulus[:-1]))
    return np.asarray(order[:-1][(np.diff(omega) <= ONE * omega[:-1]) & differ])


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
