"""A shape from a measured or computed force–indentation curve F(d): a = F'(d)/(2E*), g(a(d)) = d, and f from g.

k_zc = dF_N/dd = 2E*a holds for any shape, so that F(d) tells the shape (Popov & Heß 2015).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from os import PathLike, fsdecode
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapping import inversion
from mdr.indenters.mapping.force_curves import Near, Through, tip_of
from mdr.indenters.mapping.quadrature import double_exponential, in_chunks
from mdr.indenters.mapping.shape_check import told_smoothing, why_no_shape, why_not
from mdr.indenters.mapping.splines import DEGREE
from mdr.indenters.sampled_profile import MOST_JOINTS, NOISE, column, not_ascending, require_ascent, require_pairs
from mdr.tools.arrays import EPS, SAME, Array
from mdr.tools.checks import finite_array, not_negative, plain, positive_array
from mdr.tools.csv_header import Columns, Units, fault
from mdr.tools.csv_table import warn_of_size
from mdr.tools.fields import facts
from mdr.tools.warned import warn_outside

DEPTHS = tuple(round(4e-6 * i, 9) for i in range(9))  #: of the example [m]
FORCES = tuple(round(4 / 3 * 4e6 * 0.05**0.5 * d**1.5, 6) for d in DEPTHS)  #: of a paraboloid [N]


@dataclass(frozen=True, repr=False)
class FromForce(Indenter):
    """The shape whose normal force is F at the depths d, measured on a body of modulus E_star.

    Depths and forces ascend from d = 0, F = 0. F' must not fall: the contact does not shrink while it is pressed
    deeper. For noisy forces ``smoothing`` is their standard deviation; the shape is then that of the simplest curve of
    a growing contact that leaves no more of them than such noise, by chi squared: a warning says where it leaves more
    than 2 standard deviations of chance explain, and beyond 3 there is no shape. E_star belongs to the measurement; the
    shape itself has none.

    With ``tip="any"``, ln F is a quintic spline in ln d, and below the first depth F goes on as a power of d. Powers,
    as of cone, paraboloid and punch, are then exact to rounding, 1e-12. 100 even points of a sphere up to a = R/2 give
    g to 1e-6 of the greatest depth and F to 4e-4 at a thousandth of it. Where the tip is known to be "round" (F ~
    d^3/2), "sharp" (d²) or "flat" (d), the spline is that of ln F less this power, over d. The same points then give a
    and F to 1e-11, and the pressure to 2e-7.

    Examples
    --------
    >>> import mdr, numpy as np
    >>> d = np.linspace(0, 40e-6, 21)
    >>> tip = mdr.FromForce(d, 3e6 * d**2, E_star=4e6)  # as of a cone
    >>> print(f"{tip.contact_radius(20e-6):.3g} m")
    1.5e-05 m
    """

    d: tuple[float, ...] = field(metadata=facts("m", "depths, from 0", column, note="m", example=DEPTHS))
    F: tuple[float, ...] = field(metadata=facts("N", "normal forces at them", column, note="N", example=FORCES))
    E_star: float = field(
        metadata=facts("Pa", "contact modulus of the body on which F was measured", note="modulus in Pa", example=4e6)
    )
    tip: str = field(default="any", kw_only=True, metadata=facts("", "any, round, sharp or flat", tip_of))
    smoothing: float = field(default=0.0, kw_only=True, metadata=facts("N", NOISE, not_negative))

    def __post_init__(self) -> None:
        super().__post_init__()
        require_pairs("d", self.d, "F", self.F, DEGREE + 2)
        require_ascent("d", self.d)
        if self.d[0] != 0 or self.F[0] != 0:
            raise ValueError(
                f"d and F must begin with 0, got {self.d[0]:.6g} m and {self.F[0]:.6g} N: give depth and force less "
                "those of the first touch"
            )
        d, F = np.array(self.d), np.array(self.F)
        if self.smoothing >= (most := F.max()) > 0:
            raise ValueError(
                f"smoothing = {self.smoothing:.6g} N is the noise of the forces, which reach {most:.6g} N: give it in N"
            )
        wrong = "" if self.smoothing else not_ascending("F", self.F)
        if not wrong and (why := why_not(self, d, F, "N")):  # the contact must grow while it is pressed deeper
            wrong = f"F must rise more and more steeply, but {why}"
        if wrong:
            raise ValueError(f"{wrong}; {told_smoothing(self, d, F, 'N')}")
        if self._doubt:
            warn_outside(self._doubt)

    @classmethod
    def read(
        cls,
        path: str | PathLike[str],
        *,
        E_star: float,
        units: Units = None,
        columns: Columns = None,
        skip: int | None = None,
        table: int | str | None = None,
        part: str = "approach",
        touch: float | None = None,
        baseline: float | None = None,
        tip: str = "any",
        smoothing: float = 0.0,
        spring_constant: float | None = None,
    ) -> FromForce:
        r"""The shape of a measured force–indentation curve in a CSV file.

        Parameters
        ----------
        path : str or path-like
            The file. Its header names depth and force with their units: `d [um], F [mN]`. The point of first touch,
            0, 0, may be left out.
        E_star : float
            Contact modulus of the body that was pressed [Pa].
        units : dict of str, optional
            Units of columns whose header has none: {"d": "um", "F": "mN"}.
        columns : dict of str or int, optional
            What the header calls a column, {"d": "Weg", "F": "Kraft"}, or its number, from 1.
        skip : int, optional
            Lines above the header. None finds it.
        table : int or str, optional
            Which table of a file with several, from 1, or words above it.
        part : str
            "approach", to the greatest depth, or "retract", back from it; of several "approach 2". Holds and ways
            without contact are left out. Depths are sorted, or smoothed, within their noise.
        touch : float, optional
            Reading of the depth at first touch [m], from which depths count; what was measured before is left out.
            None: found where the curve begins before the touch, else the readings are depths.
        baseline : float, optional
            Force before the touch [N], which is taken off. None: found, or, where `touch` is given, the mean.
        tip : str
            "any", "round", "sharp" or "flat".
        smoothing : float
            Standard deviation of the noise of the forces [N].
        spring_constant : float, optional
            Stiffness k of a cantilever [N/m], whose piezo's height z the file has in the place of depths: d = z - F/k,
            with F less a `baseline` that is given.

        Returns
        -------
        FromForce
            The shape.

        Raises
        ------
        ValueError
            With file and line of what is wrong.

        See Also
        --------
        read_force_curve : what is taken, for `mdr.plots.plot_force_curve`.

        Warns
        -----
        PlausibilityWarning
            Of touch and baseline that were found, of lines that are left out, of a force that drifts before the touch,
            and of one that pulls, as in an adhesive contact.

        Examples
        --------
        >>> from pathlib import Path
        >>> import mdr
        >>> points = "".join(f"{d}, {0.4 * d**1.5}\n" for d in range(1, 9))
        >>> _ = Path("press.csv").write_text("d [um], F [mN]\n" + points)
        >>> mdr.FromForce.read("press.csv", E_star=4e6, tip="round").max_radius
        0.0002121...
        """
        from mdr.files.force_curves import read_force_curve
        from mdr.files.measurements import LIKELY_MODULUS

        curve = read_force_curve(
            path, units=units, columns=columns, skip=skip, table=table, part=part, touch=touch, baseline=baseline,
            tip=tip, spring_constant=spring_constant,
        )  # fmt: skip
        d, F = curve.depths, curve.forces
        try:
            shape = cls(d, F, E_star, tip=tip, smoothing=smoothing)  # type: ignore[arg-type]
        except ValueError as refusal:
            raise fault(fsdecode(path), str(refusal)) from None
        warn_of_size("E_star", shape.E_star, LIKELY_MODULUS, "Pa")
        return shape

    @property
    def kinks(self) -> tuple[float, ...]:
        """The edge of a flat face [m]."""
        return (self._least_radius,) if 0 < self._least_radius < self.max_radius * (1 - SAME) else ()

    @property
    def joints(self) -> tuple[float, ...]:
        """The contact radii at the measured depths [m], unless these are so many that what they miss is little."""
        if len(self.d) > MOST_JOINTS:
            return self.kinks
        inner = self._radius(np.array(self.d[1:-1]))
        return tuple(np.unique([*self.kinks, *inner[(inner > 0) & (inner < self.max_radius)]]).tolist())

    @property
    def max_radius(self) -> float:
        """Contact radius at the last depth [m]."""
        return float(self._radius(np.array([self.d[-1]]))[0])

    def _g(self, x: Array) -> Array:
        """The depth at which a = x."""
        return in_chunks(self._depth, x)

    def _area(self, a: Array) -> Array:
        """a d − F/(2E*) at the depth d = g(a)."""
        d = self._g(a)
        return a * d - self._force(d) / (2 * self.E_star)

    def contact_radius(self, d: ArrayLike) -> Array:
        """Radius a = F'(d)/(2E*), up to the last depth."""
        d = finite_array("d", d, "m")
        self._refuse_beyond(d)
        a = np.zeros(d.shape)
        a[d > 0] = np.minimum(self._radius(d[d > 0]), self.max_radius)  # of a punch it is the same but for a rounding
        return plain(a)

    def force(self, d: ArrayLike, E_star: ArrayLike) -> Array:
        """Normal force F_N [N] at the depth d, 0 where d <= 0: the measured one in proportion to E_star."""
        d, E_star = finite_array("d", d, "m"), positive_array("E_star", E_star, "Pa")
        self._refuse_beyond(d)
        return plain(self._in_range("F_N", E_star / self.E_star * self._force(d), d))

    def pressure_inside(self, r: Array, a: Array, d: Array) -> Array:
        """p/E* = (1/π) ∫ dδ/√(a(δ)² − r²) over the depths δ from g(r) to d."""
        return in_chunks(self._pressure, r, d)

    def _pressure(self, r: Array, d: Array) -> Array:
        rule = double_exponential()
        low = self._depth(r)
        depth = low[:, None] + (d - low)[:, None] * rule.from_low
        inner = np.maximum(r, EPS * self._radius(d))[:, None]
        a = np.maximum(self._radius(depth), inner * (1 + EPS))
        return np.asarray((d - low) / np.pi * ((1 / np.sqrt((a - inner) * (a + inner))) @ rule.weight))

    def __repr__(self) -> str:
        smoothed = f", smoothing={self.smoothing!r}" if self.smoothing else ""
        known = f"{len(self.d)} points to d = {self.d[-1]:.6g} m, E_star={self.E_star!r}, tip={self.tip!r}"
        return f"FromForce({known}{smoothed})"

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name not in ("_curve", "_least_radius")}

    @cached_property
    def _curve(self) -> Near | Through:
        d, F = np.array(self.d[1:]), np.array(self.F[1:])
        return Near(d, F, self.tip, self.smoothing) if self.smoothing else Through(d, F, self.tip)

    @property
    def _doubt(self) -> str:
        """What is to be told of what the points leave."""
        return self._curve.doubt

    @cached_property
    def _least_radius(self) -> float:
        """a at d → 0 [m]: of a flat tip that of its face, else 0."""
        return float(self._radius(np.zeros(1))[0]) if self._curve.power - 1 < SAME else 0.0

    def _force(self, d: Array) -> Array:
        F = np.zeros(np.shape(d))
        F[d > 0] = self._curve.force(d[d > 0])
        return F

    def _radius(self, d: Array) -> Array:
        """a at depths d > 0, and its limit at d = 0."""
        return self._curve.rise(np.maximum(d, np.finfo(float).tiny)) / (2 * self.E_star)

    def _depth(self, x: Array) -> Array:
        """d with a(d) = x; 0 up to the least radius."""
        d = np.zeros_like(x)
        todo = x > self._least_radius * (1 + SAME)
        end, rise = self._curve.power_to, self._curve.power - 1
        if end and rise > SAME:
            a_1 = float(self._radius(np.array([end]))[0])
            power = todo & (x <= a_1)
            with np.errstate(under="ignore"):
                d[power] = end * (x[power] / a_1) ** (1 / rise)
            todo &= ~power
        if todo.any():
            start = np.full(int(np.sum(todo)), self.d[1])
            d[todo] = inversion.invert(self._radius, x[todo], start, self.d[-1])[0]
        return d

    def _refuse_beyond(self, d: Array) -> None:
        if d.size and d.max() > self.d[-1] * (1 + 64 * EPS):
            raise ValueError(
                f"d = {d.max():.6g} m is deeper than the force is known, d = {self.d[-1]:.6g} m: "
                "press less or measure deeper"
            )

    def _why_no_shape(self) -> str:
        """What is wrong with the contact at many depths; empty for a shape."""
        d = self._curve.places
        with np.errstate(all="ignore"):
            # a(d) may fall by 1e-6 of its greatest value: the spline's doing
            return self._curve.why or why_no_shape(d, self._radius(d), self._force(d) / self.E_star, 1e-6)
