"""What a contact holds that is shaken across its way at a constant depth."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import peak
from mdr.case.domain import COULOMB, RIGID, Condition, holds_for
from mdr.indenters.base import Indenter
from mdr.normal.resolved import resolved
from mdr.tools.arrays import Array
from mdr.tools.checks import instance, not_negative, positive

ACROSS_ALONE = Condition(
    "shake",
    "a shake across the pull alone, at a constant depth",
    lambda case: case.moves_across and not case.way.any() and not case.cycle.harmonics.any(),
)


def held_across(indenter: Indenter, d: float, d_y: float, *, surface: bool = False) -> float:
    """Static friction [-] of a contact of constant depth that is shaken across, over mu_0.

    A spring at g can be deflected by mu_0 kappa (d - g), of which the shake takes du_y across, so that along the way
    the root of the difference of squares is left. The mean over the springs::

        integral of sqrt((d - g)² - d_y²) over that of d - g,   d_y = du_y/(mu_0 kappa)

    For a flat face sqrt(1 - (d_y/d)²). The limit v_0 -> 0 of runs; zero once the deepest spring slips, from d_y = d on
    but under a hollow face. On a material with memory a harmonic shake counts abs(E*(omega))/E* times as much.

    Springs of different directions do not obey Coulomb's law in every point of the surface. There the shake takes
    mu_0 [p(d) - p(d - d_y)] of mu_0 p (Jäger, Ciavarella), and a point that slips across in a period holds nothing::

        mean over the contact at d - d_y of sqrt(p(d)² - [p(d) - p(d - d_y)]²) over that of p(d)

    That is the static friction of a half-space without coupling whose nu is 0, and less than that of springs but for a
    flat face [vector_springs].

    Parameters
    ----------
    indenter : Indenter
        Shape of the contact.
    d : float
        Depth [m].
    d_y : float
        du_y/(mu_0 kappa) [m].
    surface : bool
        True: by Coulomb's law in every point of the surface. False: in every spring, as in runs.

    Returns
    -------
    float
        The load over mu_0 F_N [-].

    Raises
    ------
    ValueError
        For the surface under a hollow face.

    Examples
    --------
    >>> ball = mdr.Paraboloid(R=5e-3)
    >>> [round(mdr.laws.held_across(ball, 20e-6, 10e-6, surface=surface), 4) for surface in (False, True)]
    [0.69, 0.5644]
    """
    instance("indenter", indenter, Indenter)
    d, d_y = positive("d", d, "depth in m"), not_negative("d_y", d_y, "du_y/(mu_0 kappa) in m")
    if not surface:
        return _by_springs(indenter, d, d_y) / _by_springs(indenter, d, 0.0)
    if indenter.least_depth > 0:
        raise ValueError(f"the surface under a hollow face is not known, got {indenter!r}: take surface=False")
    return _on_surface(indenter, d, d - d_y) / _on_surface(indenter, d, d) if d_y < d else 0.0


@holds_for(COULOMB, RIGID, ACROSS_ALONE, of=resolved, instead="cof_curve(case, [0])")
def static_across(case: SlidingContact, surface: bool = False) -> float:
    """Static friction [-] of such a contact, by `held_across`, on any linear material and for any shake across."""
    return case.mu_0 * held_across(case.indenter, case.cycle.u_z0, extent_across(case), surface=surface)


def extent_across(case: SlidingContact) -> float:
    """d_y [m] of a case: half of what a spring that sticks is deflected by between its ends, over mu_0 kappa."""
    n_omega = case.omega * np.arange(1, case.way_across.size + 1)
    borne = case.way_across * np.asarray(case.material.dynamic_modulus(n_omega)) / case.material.E_star
    return 0.5 * (peak(borne) + peak(-borne)) / (case.mu_0 * case.material.mindlin_ratio)


def _by_springs(indenter: Indenter, d: float, d_y: float) -> float:
    """Integral of sqrt((d - g)² - d_y²) over the springs for which d - g > d_y, whose edges are found first."""
    from scipy.optimize import brentq

    a = float(indenter.contact_radius(d))

    def spare(x: float) -> float:
        return d - d_y - float(indenter.profile_1d(x))

    x = np.union1d(np.linspace(0, a, 64), [kink for kink in indenter.kinks if kink < a])
    at = np.array([spare(one) for one in x])
    edges = [brentq(spare, x[i], x[i + 1]) for i in np.flatnonzero(at[:-1] * at[1:] < 0)] if d_y else []
    x, weight = places(indenter, a, edges)
    s = np.maximum(d - indenter.profile_1d(x), 0.0)
    return float(weight @ np.sqrt(np.maximum(s * s - d_y * d_y, 0.0)))


def _on_surface(indenter: Indenter, d: float, depth: float) -> float:
    """Integral over the contact at a smaller depth of sqrt(p(depth) [2 p(d) - p(depth)]) r, p pressures over E*."""
    r, weight = places(indenter, float(indenter.contact_radius(depth)))
    most, stuck = (indenter.pressure(r, one, 1.0) for one in (d, depth))
    return float(weight @ (r * np.sqrt(stuck * np.maximum(2 * most - stuck, 0.0))))


def places(indenter: Indenter, a: float, edges: Sequence[float] = ()) -> tuple[Array, Array]:
    """Nodes and weights over the contact of radius a, between kinks and edges; crowded to both ends of each piece."""
    ends = np.unique([0.0, *(kink for kink in indenter.kinks if kink < a), *edges, a])
    u, w = np.polynomial.legendre.leggauss(64)  # the integrand ends like a root, which the map of the piece removes
    u = 0.5 * (1 + u)
    place, share = u * u * (3 - 2 * u), 3 * w * u * (1 - u)
    length = np.diff(ends)[:, None]
    return (ends[:-1, None] + length * place).ravel(), (length * share).ravel()
