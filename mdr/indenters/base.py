"""What every shape of indenter must answer.

f(r) is the shape of the rigid indenter, r from its axis, f(0) = 0; g(x) is its image in one
dimension (Popov & Heß 2015). Pressed to the depth d it touches a full disc of radius a, and

    d = g(a),   F_N = 2E* (d a − ∫₀^a g dx),   k_zc = dF_N/dd = 2E* a,
    p(r) = (E*/π) ∫_r^a g'(x) / √(x² − r²) dx,

where a rim that reaches d before the profile does adds E*(d − g(a)) / (π √(a² − r²)) to p.
Lengths r, x, d, a in m, E* and p in Pa, F_N in N; any other consistent units do as well.

A shape of one's own is a frozen dataclass with ``profile_3d`` or ``profile_1d``; the rest follows by
quadrature (`mdr.indenters.mapped`), to 1e-9 or better, and every closed form it adds makes it faster.
A shape of this package gives ``_f``, ``_g`` and ``_area`` instead, which are asked for distances from the axis that are
checked: arrays of any shape, finite, 0 or above, and within the shape. What it has been asked for is kept, so that a
shape must not change.
"""

from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.mapped import Mapped
from mdr.indenters.mapping.shape_check import finite_answer, held, real
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, plain, positive_array

HOOKS = {"profile_3d": "_f", "profile_1d": "_g", "profile_area": "_area"}  #: what computes each, unchecked
HELD = {"contact_radius", "force", "stiffness"}  #: what is compared with what follows from g, in a class of a user


class Indenter(Mapped):
    """A rigid axisymmetric shape; give it ``profile_3d`` or ``profile_1d``."""

    is_body: ClassVar[bool] = True  #: False where only its forces mean something, not its radius and pressure

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        for public, hook in HOOKS.items():
            if public in vars(cls) and hook not in vars(cls):
                setattr(cls, hook, real(public, vars(cls)[public]))
        if not cls.__module__.startswith(__package__ + "."):  # the tests hold those to it
            for name in HELD & vars(cls).keys():
                setattr(cls, name, held(vars(cls)[name], getattr(Indenter, name)))
        if "contact_radius" in vars(cls):
            cls.contact_radius = finite_answer(cls.contact_radius)  # type: ignore[method-assign]
        cls._gives_g = cls._g is not Indenter._g
        if not cls._gives_g and cls._f is Indenter._f:
            raise TypeError(f"{cls.__name__} is no shape yet: give it profile_3d(r) or profile_1d(x)")

    def __init__(self) -> None:
        if type(self) is Indenter:
            raise TypeError("Indenter is no shape itself: use Cone(...), Profile(f) or a class of your own")

    @finite_answer
    def profile_3d(self, r: ArrayLike) -> Array:
        """Height f(r) of the shape above its tip [m].

        Parameters
        ----------
        r : array_like of float
            Distance from the axis [m].

        Returns
        -------
        float or ndarray
            f [m] in the shape of r.

        Raises
        ------
        ValueError
            Beyond the end of the shape (`max_radius`).
        """
        return plain(self._f(self._within(finite_array("r", r, "m"))))

    @finite_answer
    def profile_1d(self, x: ArrayLike) -> Array:
        """Height g(x) of the one-dimensional image of the shape [m], even in x.

        Parameters
        ----------
        x : array_like of float
            Position [m].

        Returns
        -------
        float or ndarray
            g [m] in the shape of x.

        Raises
        ------
        ValueError
            Beyond the end of the shape (`max_radius`).

        Notes
        -----
        The mapping of the Method of Dimensionality Reduction (Popov and Heß 2015) ::

            g(x) = |x| ∫₀^|x| f'(r)/√(x² − r²) dr

        Examples
        --------
        >>> import mdr
        >>> mdr.Paraboloid(R=5e-3).profile_1d([1e-4, 2e-4])
        array([2.e-06, 8.e-06])
        """
        x = self._within(finite_array("x", x, "m"))
        if not self._gives_g and x.any():
            self._mapped(float(x.max()))
        return plain(self._g(x))

    def contact_radius(self, d: ArrayLike) -> Array:
        """Radius a of the contact [m]: g(a) = d, and 0 where d <= 0.

        Parameters
        ----------
        d : array_like of float
            Depth [m].

        Returns
        -------
        float or ndarray
            a [m] in the shape of d.

        Raises
        ------
        ValueError
            Deeper than the shape reaches, and where the contact would be a ring.
        """
        d = finite_array("d", d, "m")
        self._refuse_beyond(d)
        a = np.zeros(d.shape)
        if (pressed := d > 0).any():
            a[pressed] = self._search(d[pressed])
            self._refuse_annular(float(a.max()))
        return plain(a)

    @finite_answer
    def profile_area(self, a: ArrayLike) -> Array:
        """Area between the one-dimensional image and its tangent at the tip, ∫₀^a g dx [m²].

        Parameters
        ----------
        a : array_like of float
            Contact radius [m].

        Returns
        -------
        float or ndarray
            The area [m²] in the shape of a.
        """
        return plain(self._area(self._within(finite_array("a", a, "m"))))

    def force(self, d: ArrayLike, E_star: ArrayLike) -> Array:
        """Normal force F_N [N] of an elastic contact, 0 where d <= 0.

        Parameters
        ----------
        d : array_like of float
            Depth [m].
        E_star : array_like of float
            Contact modulus E* [Pa].

        Returns
        -------
        float or ndarray
            F_N = 2 E* (d a − ∫₀^a g dx) [N]. In this form it is stationary in a, so that the rounding of a does not
            show.

        Raises
        ------
        ValueError
            Deeper than the shape reaches.

        Examples
        --------
        >>> import mdr
        >>> print(f"{mdr.Paraboloid(R=5e-3).force(20e-6, E_star=4e6):.4f} N")
        0.0337 N
        """
        d, E_star = finite_array("d", d, "m"), positive_array("E_star", E_star, "Pa")
        with np.errstate(over="ignore", invalid="ignore"):
            a = self.contact_radius(d)
            F_N = 2 * E_star * (np.maximum(d, 0) * a - self.profile_area(a))
        return plain(np.maximum(self._in_range("F_N", F_N, d), 0))

    def stiffness(self, d: ArrayLike, E_star: ArrayLike) -> Array:
        """Normal stiffness k_zc = dF_N/dd = 2 E* a of the contact [N/m], 0 where d <= 0.

        Parameters
        ----------
        d : array_like of float
            Depth [m].
        E_star : array_like of float
            Contact modulus E* [Pa].

        Returns
        -------
        float or ndarray
            k_zc [N/m].
        """
        with np.errstate(over="ignore"):
            k_zc = 2 * positive_array("E_star", E_star, "Pa") * self.contact_radius(d)
        return plain(self._in_range("k_zc", k_zc, d))

    @finite_answer
    def pressure(self, r: ArrayLike, d: ArrayLike, E_star: ArrayLike) -> Array:
        """Pressure p [Pa] of an elastic contact, 0 for r >= a.

        Parameters
        ----------
        r : array_like of float
            Distance from the axis [m].
        d : array_like of float
            Depth [m].
        E_star : array_like of float
            Contact modulus E* [Pa].

        Returns
        -------
        float or ndarray
            p [Pa]. It is infinite at a sharp tip, at a kink that points down, and at the rim of a punch. The answer at
            tip and kink is the pressure one rounding away (the infinity is logarithmic); at the rim, r = a, it is 0.
        """
        r, d = np.abs(finite_array("r", r, "m")), finite_array("d", d, "m")
        a = self.contact_radius(d)
        r, d, a, E_star = np.broadcast_arrays(r, d, a, positive_array("E_star", E_star, "Pa"))
        p, inside = np.zeros(r.shape), r < a
        p[inside] = E_star[inside] * self.pressure_inside(r[inside], a[inside], d[inside])
        return plain(p)
