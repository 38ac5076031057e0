"""Rough face: load and stiffness are proportional, as the image g(x) = l_e ln(x/a_0) for x > a_0 has it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.tools.arrays import EPS, Array
from mdr.tools.checks import between, finite_array, plain, positive
from mdr.tools.fields import facts

START = 1e-3  #: of a load, that the patch of first touch bears at a depth of 7 l_e


@dataclass(frozen=True)
class RoughFace(Indenter):
    """A rough face by its mean: F_N = F_0 (exp(d/l_e) − 1), k_zc = (F_N + F_0)/l_e, with F_0 = 2E* l_e a_0.

    Of a random rough face load and stiffness are proportional over decades (Persson, Phys. Rev. Lett. 99:125502, 2007);
    l_e is of the order of the height of its roughness. Depth counts from a first touch by a patch of radius a_0, which
    no load far above F_0 feels. The body of revolution bears the forces of the face alone: its radius and its pressure
    are not those of the asperities, and so it takes no shear strength.
    """

    l_e: float = field(metadata=facts("m", "depth over which the load grows e-fold", example=5e-6))
    a_0: float = field(metadata=facts("m", "radius of the patch of first touch", example=2e-5))

    @classmethod
    def under_load(cls, F: float, l_e: float, E_star: float) -> RoughFace:
        """The face of this l_e whose patch of first touch bears next to nothing of a load.

        Parameters
        ----------
        F : float
            The least load that matters [N].
        l_e : float
            Depth over which the load grows e-fold [m].
        E_star : float
            Contact modulus E* of the half-space [Pa].

        Returns
        -------
        RoughFace
            With F_0 a thousandth of F, so that load and stiffness are proportional to 0.1 % from F on.

        Raises
        ------
        ValueError
            For a number that is not positive.

        Examples
        --------
        >>> import mdr
        >>> face = mdr.RoughFace.under_load(10.0, 0.5e-6, 4e6)
        >>> d = mdr.static_depth(face, mdr.Elastic(E=3e6, nu=0.5), 10.0)
        >>> print(f"{10.0 / face.stiffness(d, 4e6) * 1e6:.4f} um")
        0.4995 um
        """
        F, l_e, E_star = positive("F", F, "N"), positive("l_e", l_e, "m"), positive("E_star", E_star, "Pa")
        return cls(l_e, START * F / (2 * E_star * l_e))

    @classmethod
    def from_forces(cls, apart: float, F_1: float, F_2: float, E_star: float) -> RoughFace:
        """The face that bears two forces at depths so far apart.

        Parameters
        ----------
        apart : float
            Depth of the second less that of the first [m].
        F_1, F_2 : float
            The forces [N], the second one greater.
        E_star : float
            Contact modulus E* of the half-space [Pa].

        Returns
        -------
        RoughFace
            With l_e = apart/ln((F_2 + F_0)/(F_1 + F_0)), F_0 a thousandth of F_1.

        Raises
        ------
        ValueError
            For forces that do not rise.

        Examples
        --------
        >>> import mdr
        >>> print(f"{mdr.RoughFace.from_forces(1e-6, 1.0, 7.39, 4e6).l_e * 1e6:.3f} um")
        0.500 um
        """
        F_1, apart = positive("F_1", F_1, "N"), positive("apart", apart, "m")
        F_2 = between("F_2", F_2, F_1, np.inf, "N: more than F_1, as it lies deeper")
        return cls.under_load(F_1, apart / float(np.log((F_2 + START * F_1) / (F_1 + START * F_1))), E_star)

    is_body: ClassVar[bool] = False

    @property
    def kinks(self) -> tuple[float, ...]:
        """The edge of the patch of first touch [m]."""
        return (self.a_0,)

    def _g(self, x: Array) -> Array:
        return self.l_e * np.log(np.maximum(x / self.a_0, 1.0))

    def _area(self, a: Array) -> Array:
        more = np.maximum(a / self.a_0, 1.0) - 1.0
        return self.l_e * self.a_0 * ((1.0 + more) * np.log1p(more) - more)

    def contact_radius(self, d: ArrayLike) -> Array:
        """Radius a = a_0 exp(d/l_e), 0 where d <= 0."""
        d = finite_array("d", d, "m")
        with np.errstate(over="ignore"):
            return plain(np.where(d > 0, self.a_0 * np.exp(d / self.l_e), 0.0))

    def pressure_inside(self, r: Array, a: Array, d: Array) -> Array:
        """p/E* = (l_e/πr) [arccos(r/a) − arccos(r/max(r, a_0))]."""
        r = np.maximum(r, np.sqrt(EPS) * self.a_0)
        return np.asarray(self.l_e / (np.pi * r) * (np.arccos(r / a) - np.arccos(r / np.maximum(r, self.a_0))))
