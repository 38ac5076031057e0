"""Friction of a contact that moves as it was recorded: any way in the plane, any depth or load.

Between samples the motion is linear, and the springs go on it by the step of the library. For depth and way along one
line on an elastic body this is exact. Otherwise the record is followed twice, with one and with two steps between
samples; and in each case once more with half of the springs. The differences estimate a bound on the error of friction.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mdr.element.contact_element import relaxed, springs_of, stick_on, stored
from mdr.element.kernels import SpringRow, follow
from mdr.indenters.base import Indenter
from mdr.materials.base import Material
from mdr.normal.load_control import static_depths
from mdr.normal.springs import MIN_SPRINGS
from mdr.tools.arrays import EXACT, Array
from mdr.tools.checks import count, finite_array, instance, instants, positive
from mdr.tools.companions import Companion, bound
from mdr.tools.csv_table import Tabled, csv_text
from mdr.tools.progress import Ticker, progress
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, number, span, with_error

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SPRINGS = 256  #: where none are asked for
STEPS_OFF = 3.0  #: times what halved steps change; of 320 odd records one was off by 1.07 times the whole bound
AT_ONCE = 2**24  #: springs times steps between two looks at the clock
LOADS = 2**12  #: loads, the same


@dataclass(frozen=True)
class RecordEnergy:
    """Energies [J] over a record: plane_work + normal_work = lost + stored_change."""

    plane_work: float  #: of the motion in the plane, F_x u_x' + F_y u_y'
    normal_work: float  #: F_z u_z'
    stored_change: float  #: elastic energy of the springs

    @property
    def lost(self) -> float:
        """Energy [J] that friction and material turn into heat."""
        return self.plane_work + self.normal_work - self.stored_change


@dataclass(frozen=True, eq=False, repr=False)
class SlideRecord(Summarised, Tabled, ArrayRecord):
    """Outcome of slide_record(), in SI. Forces are those at the samples, means those of the exact area in between."""

    cof: float  #: mean F_x over mean F_z [-]
    cof_y: float  #: mean F_y over mean F_z [-]
    cof_error: float  #: estimated bound on the numerical error of both: step and springs [-]
    mean_F_z: float  #: [N]
    energy_balance: RecordEnergy  #: of the whole record
    mu_0: float  #: local coefficient of friction [-]
    n_springs: int  #: springs at x >= 0, each for the pair +x, -x
    t: Array  #: (n_t,) instants [s]
    u_x: Array  #: (n_t,) position [m]
    u_y: Array  #: (n_t,) [m]
    u_z: Array  #: (n_t,) depth [m]
    F_x: Array  #: (n_t,) tangential force, against the motion of the indenter [N]
    F_y: Array  #: (n_t,) [N]
    F_z: Array  #: (n_t,) normal force [N]
    running_cof: Array  #: (n_t,) mean F_x over mean F_z up to each sample [-]; 0 before the first contact

    @property
    def late_cof(self) -> float:
        """Mean F_x over mean F_z of the second half of the record [-], from the samples.

        A record begins without force in the plane; where it is long beside the build-up from there, its first half
        holds all of that. NaN where nothing touches in the second.
        """
        late = self.t >= (self.t[0] + self.t[-1]) / 2
        x, z = (float(np.trapezoid(F[late], self.t[late])) for F in (self.F_x, self.F_z))
        return x / z if z > 0 else float("nan")

    @property
    def loss_cof(self) -> float:
        """Work in the plane over load and way [-], the integral of F_x dx + F_y dy over that of F_z ds.

        Of a stroke to and fro it is the coefficient of friction, where `cof`, the mean of both ways, is about zero. It
        counts what springs store too, which a way that is long beside their deflection makes small. NaN where nothing
        moves in contact.
        """
        borne = float(0.5 * (self.F_z[1:] + self.F_z[:-1]) @ np.hypot(np.diff(self.u_x), np.diff(self.u_y)))
        return self.energy_balance.plane_work / borne if borne > 0 else float("nan")

    def _summary(self) -> Summary:
        spent = self.energy_balance
        turns = np.abs(np.diff(self.u_x)).sum() > abs(self.u_x[-1] - self.u_x[0]) * (1 + EXACT)
        means = "mean F_x/mean F_z, both ways together" if turns else "mean F_x/mean F_z, with the way from rest"
        return Summary(
            f"SlideRecord of {self.t.size} samples, {number(self.t[-1] - self.t[0], 's')}",
            [
                (
                    "COF",
                    with_error(self.cof, self.cof_error),
                    f"{means}; mu_0 = {number(self.mu_0)}",
                ),
                *([("COF, loss", number(self.loss_cof), "work in the plane over load and way")] if turns else []),
                ("COF across", with_error(self.cof_y, self.cof_error), "mean F_y/mean F_z"),
                ("COF, late", number(self.late_cof), "of the second half of the record alone"),
                ("depth", span(self.u_z, "m"), ""),
                ("F_x", span(self.F_x, "N"), ""),
                ("F_y", span(self.F_y, "N"), ""),
                ("F_z", span(self.F_z, "N"), f"mean {number(self.mean_F_z, 'N')}"),
                ("energy", number(spent.lost, "J"), "lost by friction and material"),
                ("springs", str(self.n_springs), ""),
            ],
        )

    def table(self) -> str:
        """Time, position, forces and running COF as CSV.

        Returns
        -------
        str
            What `to_csv` writes.
        """
        names = {"t": "s", "u_x": "m", "u_y": "m", "u_z": "m", "F_x": "N", "F_y": "N", "F_z": "N", "running_cof": "-"}
        return csv_text({f"{name} [{unit}]": getattr(self, name) for name, unit in names.items()})

    def plot(self) -> Figure:
        """Draw position, forces and running COF over time.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
        from mdr.plots.records import plot_slide_record

        return plot_slide_record(self)


def slide_record(
    indenter: Indenter,
    material: Material,
    mu_0: float,
    t: ArrayLike,
    u_x: ArrayLike,
    u_y: ArrayLike | None = None,
    u_z: ArrayLike | None = None,
    *,
    F_z: ArrayLike | None = None,
    n_springs: int | None = None,
    mu_s: float | None = None,
) -> SlideRecord:
    """Friction [-] of a contact that moves as it was recorded.

    The contact starts at rest at the first sample, relaxed and without force in the plane.

    Parameters
    ----------
    indenter : Indenter
        The shape.
    material : Material
        The half-space, with a long-time modulus.
    mu_0 : float
        Local coefficient of friction [-].
    t : array_like of float, shape (n_t,)
        Instants [s], rising, in steps of any size; at least two.
    u_x : array_like of float, shape (n_t,)
        Position of the indenter [m].
    u_y : array_like of float, shape (n_t,), optional
        Position across [m]. None: it moves along x alone.
    u_z : array_like of float, shape (n_t,), or float, optional
        Depth [m]; at zero and below nothing touches. Give either u_z or F_z.
    F_z : array_like of float, shape (n_t,), or float, optional
        Normal force [N], zero or above.
    n_springs : int, optional
        Springs at x > 0, at least 32, each for the pair at +x and -x. None takes 256.
    mu_s : float, optional
        Static coefficient [-], up to which a spring sticks; no less than mu_0, which it has in slip. None is mu_0.

    Returns
    -------
    SlideRecord
        Forces at the samples, `cof` with an estimated bound on its numerical error, `running_cof`, energies. What
        linear motion between samples misses of the true one is not in `cof_error`.

    Raises
    ------
    TypeError, ValueError
        For NaN, lists of different lengths, instants that do not rise, both or neither of u_z and F_z, a negative
        force, a shape that ends before the depth, a contact that never touches, mu_s below mu_0, and mu_s above it in
        the plane on a material with arms.

    See Also
    --------
    slide : a steady pull under a periodic vibration.

    Notes
    -----
    Elastic bodies that move along one line at given depths are followed exactly between samples, others in steps of
    second order; with arms in the plane these are cut, however long, as those of a ContactElement. A load is met at
    each step by Newton's method. With a dashpot the force jumps where a spring touches; where a load lies within such a
    jump, F_z is next to it. The force at a sample of depth is the mean of both sides.

    Examples
    --------
    >>> import numpy as np
    >>> import mdr
    >>> t = np.linspace(0, 0.1, 1001)
    >>> shaken = 20e-6 + 2e-6 * np.cos(300 * t)
    >>> found = mdr.slide_record(mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5), 0.4, t, 1e-4 * t, u_z=shaken)
    >>> print(f"{found.cof:.2f}")
    0.23
    """
    instance("indenter", indenter, Indenter)
    instance("material", material, Material)
    mu_0 = positive("mu_0", mu_0, "coefficient of friction")
    mu_s = None if mu_s is None else positive("mu_s", mu_s, "static coefficient of friction")
    n = SPRINGS if n_springs is None else count("n_springs", n_springs, 2 * MIN_SPRINGS)
    t = instants("t", t)
    if (u_z is None) == (F_z is None):
        raise ValueError("give either u_z, a record of depth, or F_z, one of force, and not both")
    x, y = _samples("u_x", u_x, t, "m"), _samples("u_y", 0.0 if u_y is None else u_y, t, "m")
    if F_z is None:
        depth, load = _samples("u_z", 0.0 if u_z is None else u_z, t, "m"), None
    else:
        load = _samples("F_z", F_z, t, "N")
        depth = _static(indenter, material, load)
    deepest, least = float(depth.max()), float(depth.min())
    if not deepest > 0:
        raise ValueError(
            f"{'u_z' if F_z is None else 'F_z'}: the indenter never touches, the greatest depth is {deepest:.6g} m"
        )
    motion = _Motion(t, x, y if np.ptp(y) > 0 else None, depth, load)
    exact = load is None and motion.y is None and not (material.tau > 0 or material.contact_arms)
    runs = [(n, 1), (n // 2, 1)] if exact else [(n, 1), (n // 2, 1), (n, 2)]
    ticker = Ticker("slide_record", sum(k * part for k, part in runs) * (t.size - 1), "springs times steps")
    stick = stick_on(material, mu_s, mu_0, motion.y is not None)
    found = [
        _followed(motion, springs_of(indenter, material, mu_0, deepest, least, k, stick), part, ticker)
        for k, part in runs
    ]
    best = found[0] if exact else found[-1]
    if load is not None and material.tau > 0:  # the error of its steps falls with their length
        F, area, u = (2 * one - two for one, two in zip(best[:3], found[0][:3], strict=True))
        best = _Followed(np.asarray(F), np.asarray(area), np.asarray(u), best.energy)
    if not best.area[:, 2].sum() > 0:
        raise ValueError("the indenter carries no force in this record: raise u_z or F_z")
    (cof, cof_y), off = best.cof, [float(np.abs(one.cof - found[0].cof).max()) for one in found[1:]]
    if material.tau > 0 and not exact:  # the errors of steps at a dashpot differ in sign: interval by interval
        off[1] = float(np.abs(found[2].area - found[0].area)[:, :2].sum(axis=0).max() / best.area[:, 2].sum())
    error = bound(Companion(off[0]), *(Companion(one, STEPS_OFF) for one in off[1:]))
    along, pressed = np.cumsum(best.area[:, 0]), np.cumsum(best.area[:, 2])
    along[0], pressed[0] = best.F[0, 0], best.F[0, 2]  # of no time: of the forces there
    return SlideRecord(
        cof=float(cof),
        cof_y=float(cof_y),
        cof_error=error + EXACT * mu_0,
        mean_F_z=float(best.area[:, 2].sum() / (t[-1] - t[0])),
        energy_balance=best.energy,
        mu_0=mu_0,
        n_springs=n,
        t=t,
        u_x=x,
        u_y=y,
        u_z=best.u_z,
        F_x=best.F[:, 0],
        F_y=best.F[:, 1],
        F_z=best.F[:, 2],
        running_cof=np.divide(along, pressed, out=np.zeros(t.size), where=pressed > 0),
    )


class _Motion(NamedTuple):
    """A record, (n_t,) each."""

    t: Array
    x: Array
    y: Array | None  #: None for motion along one line
    depth: Array  #: under a load that at which it would rest
    load: Array | None


class _Followed(NamedTuple):
    """What springs answer to it, in SI."""

    F: Array  #: (n_t, 3)
    area: Array  #: (n_t, 3) over the interval before each sample
    u_z: Array  #: (n_t,)
    energy: RecordEnergy

    @property
    def cof(self) -> Array:
        """Mean forces in the plane over that of F_z, (2,)."""
        area = self.area.sum(axis=0)
        return np.asarray(area[:2] / area[2] if area[2] > 0 else np.zeros(2))


def _followed(motion: _Motion, row: SpringRow, parts: int, ticker: Ticker) -> _Followed:
    """The record followed by a row of springs, each interval in so many parts."""
    t, n = motion.t, row.gap.size
    x = (motion.x if motion.y is None else motion.x + 1j * motion.y) / row.length_x
    depth = motion.depth / row.length_z
    load = np.empty(0) if motion.load is None else motion.load / row.force_z
    s = relaxed(row, depth[0])
    e = np.zeros(s.shape, x.dtype)
    out = np.zeros((t.size, 6))
    out[0, 2] = row.w @ s[0]
    first = _stored(row, s, e)
    chunk = max(AT_ONCE // (n * parts), 1)
    for k in range(0, t.size - 1, chunk):
        end = min(k + chunk, t.size - 1)
        follow(s, e, t, x, depth, load, parts, row, out, k, end)
        ticker.tick((end - k) * n * parts)
    if not all(np.isfinite(one).all() for one in (s, e, out, depth)):
        raise ValueError(
            "forces of this record are beyond the range of floats: make its steps in t longer, or u smaller"
        )
    units = np.array([row.force_x, row.force_x, row.force_z])
    F, area, u_z = out[:, :3] * units, out[:, 3:] * units, motion.depth if motion.load is None else depth * row.length_z
    rates = (np.diff(one) / np.diff(t) for one in (motion.x, 0 * t if motion.y is None else motion.y, u_z))
    of_x, of_y, of_z = (float(rate @ one) for rate, one in zip(rates, area[1:].T, strict=True))
    return _Followed(F, area, u_z, RecordEnergy(of_x + of_y, of_z, _stored(row, s, e) - first))


def _stored(row: SpringRow, s: Array, e: Array) -> float:
    return float(stored(row, np.concatenate([s, e.real, e.imag]).ravel()))


def _static(indenter: Indenter, material: Material, load: Array) -> Array:
    """Depths [m] at which loads would rest."""
    if not np.all(load >= 0):
        raise ValueError(f"F_z must not be negative, got {load.min():.6g} N: nothing pulls at the indenter")
    if not material.E_star > 0:
        raise ValueError("E_inf = 0: under a load such a half-space flows without end")
    depth = np.zeros(load.shape)
    if load.any():
        there, which = np.unique(load[load > 0], return_inverse=True)
        parts = progress(np.array_split(there, there.size // LOADS + 1), "depths under the loads", f"times {LOADS}")
        found = [static_depths(indenter, material.E_star, part) for part in parts]
        depth[load > 0] = np.concatenate(found)[which]
    return depth


def _samples(name: str, values: ArrayLike, t: Array, unit: str) -> Array:
    """A record of one quantity; a number is one that stays."""
    samples = finite_array(name, values, unit)
    if samples.ndim and samples.shape != t.shape:
        raise ValueError(f"{name} must have the shape {t.shape} of t, got {samples.shape}")
    return np.array(np.broadcast_to(samples, t.shape))
