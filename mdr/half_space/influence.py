"""The elastic half-space as a matrix: displacement of the surface under tractions that are constant on square cells.

The nine influence coefficients of Boussinesq and Cerruti, integrated over a rectangle in closed form (Love 1929 for
the normal one; Pohrt and Li, Physical Mesomechanics 17 (2014) 334, for all), evaluated at the centres of the cells,
and products with them by FFT on a padded grid (Stanley and Kato 1997), exact for a contact that is not periodic.

z points into the half-space, x along the pull. Tractions (3, n, n) act on the half-space: q_x, q_y along the surface,
p = q_z > 0 presses. Displacements (3, n, n) are those of its surface. The matrix is symmetric (Betti).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property

import numpy as np
import scipy  # loads scipy.fft where it is first used, so that importing this is light
from numpy.typing import NDArray

from mdr.tools.arrays import Array


class Axis(IntEnum):
    """A direction, and the place of its component in tractions and displacements."""

    X = 0
    Y = 1
    Z = 2


X, Y, Z = Axis


@dataclass(frozen=True, eq=False)
class HalfSpace:
    """n x n square cells of side h of the surface, of two half-spaces or of one under a rigid body.

    All that counts of their materials are the contact moduli E* and G* and Dundurs' beta: for one body of shear
    modulus G and Poisson's ratio nu, (1 - nu)/G = 2/E*, nu/G = 4/G* - 4/E* and (1 - 2 nu)/G = 4 beta/E*; two add.
    beta = 0 leaves out what tangential tractions do to u_z and pressure to u_x and u_y.
    """

    n: int
    h: float
    E_star: float
    G_star: float
    beta: float = 0.0

    @property
    def places(self) -> Array:
        """Centres of the cells along either axis (n,), zero in the middle."""
        return np.asarray((np.arange(self.n) - (self.n - 1) / 2) * self.h, dtype=np.float64)

    @cached_property
    def radii(self) -> Array:
        """Distance of the centres of the cells from the middle (n, n)."""
        return np.asarray(np.hypot(self.places[:, None], self.places[None, :]))

    @cached_property
    def size(self) -> int:
        """Of the padded grid."""
        return int(scipy.fft.next_fast_len(2 * self.n - 1, real=True))

    @cached_property
    def spectra(self) -> dict[tuple[Axis, Axis], NDArray[np.complex128] | Array]:
        """Transforms of the coefficients that are not zero: (i, j) for u_i under q_j.

        Real where i and j are both in the plane or both across it, as coefficients are then even along both axes, or
        odd along both.
        """
        kernels = {(i, j): self.coefficients(i, j) for i in Axis for j in Axis}
        found = {pair: scipy.fft.rfft2(self._wrapped(kernel)) for pair, kernel in kernels.items() if np.any(kernel)}
        return {(i, j): one.real.copy() if (i == Z) == (j == Z) else one for (i, j), one in found.items()}

    def coefficients(self, i: Axis, j: Axis) -> Array:
        """u_i under unit q_j on the cell in the middle, (2n - 1, 2n - 1) centres of cells, x along the first axis."""
        places = np.arange(-self.n + 1, self.n, dtype=float) * self.h
        x, y = places[:, None], places[None, :]
        plain, directed = 1 / (np.pi * self.E_star), 2 / np.pi * (1 / self.G_star - 1 / self.E_star)
        if i == j == Z:
            return plain * _over_cell(_one_over_r, x, y, self.h)
        if i == j:
            along = (x, y) if i == X else (y, x)
            return plain * _over_cell(_one_over_r, x, y, self.h) + directed * _over_cell(_x2_over_r3, *along, self.h)
        if {i, j} == {X, Y}:
            return directed * _over_cell(_xy_over_r3, x, y, self.h)
        along = (x, y) if X in (i, j) else (y, x)
        toward = self.beta * plain * _over_cell(_x_over_r2, *along, self.h)
        return toward if i == Z else -toward

    def displacement(
        self, tractions: Array, of: Sequence[Axis] = (X, Y, Z), under: Sequence[Axis] = (X, Y, Z)
    ) -> Array:
        """The components `of` of the displacement, (len(of), n, n), under the components `under` of the tractions."""
        pairs = [(a, b) for a, i in enumerate(of) for b, j in enumerate(under) if (i, j) in self.spectra]
        if not pairs:
            return np.zeros((len(of), self.n, self.n))
        # axis by axis, so that rows that hold zeros alone before, or are not asked for after, are left out
        loads = scipy.fft.fft(scipy.fft.rfft(tractions, self.size, axis=-1), self.size, axis=-2, overwrite_x=True)
        answers = np.zeros((len(of), *loads.shape[1:]), complex)
        for a, b in pairs:
            answers[a] += self.spectra[of[a], under[b]] * loads[b]
        rows = scipy.fft.ifft(answers, axis=-2, overwrite_x=True)[:, : self.n]
        shifts: Array = scipy.fft.irfft(rows, self.size, axis=-1)
        return shifts[:, :, : self.n]

    def _wrapped(self, kernel: Array) -> Array:
        """The coefficients around the corner of the padded grid, as a circular convolution takes them."""
        wide = np.zeros((self.size, self.size))
        wide[: 2 * self.n - 1, : 2 * self.n - 1] = kernel
        return np.roll(wide, (1 - self.n, 1 - self.n), axis=(0, 1))


# --- integrals over a cell ---


def _over_cell(antiderivative: Callable[[Array, Array], Array], x: Array, y: Array, h: float) -> Array:
    """The integral over a square cell of side h about the origin, seen from (x, y)."""
    left, right, below, above = x - h / 2, x + h / 2, y - h / 2, y + h / 2
    whole = antiderivative(right, above) - antiderivative(left, above)
    return whole - antiderivative(right, below) + antiderivative(left, below)


def _one_over_r(x: Array, y: Array) -> Array:
    r = np.hypot(x, y)
    return x * _log(y, r, x) + y * _log(x, r, y)


def _x2_over_r3(x: Array, y: Array) -> Array:
    return y * _log(x, np.hypot(x, y), y)


def _xy_over_r3(x: Array, y: Array) -> Array:
    return -np.hypot(x, y)


def _x_over_r2(x: Array, y: Array) -> Array:
    return y * np.log(np.hypot(x, y)) + x * np.arctan(y / x)


def _log(a: Array, r: Array, b: Array) -> Array:
    """log(a + r) with r = hypot(a, b), without cancellation for a < 0."""
    return np.where(a >= 0, np.log(a + r), 2 * np.log(np.abs(b)) - np.log(r - a))
