"""Friction under a depth that vibrates at random, from histories that are drawn and followed spring by spring.

The depth is the mean depth of a case plus a stationary Gaussian process. A history repeats itself after many times of
correlation, and before its period the contact is led through as much of the past as friction remembers. Friction is the
mean of F_x over that of F_z over all histories, and their spread gives its standard error. One set of histories serves
all velocities.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from mdr.case.contact import SlidingContact
from mdr.case.domain import GIVEN_DEPTH, NO_SHAKE, NO_STRENGTH, RIGID, holds_for
from mdr.case.spectrum import Spectrum
from mdr.element.contact_element import relaxed, springs_of
from mdr.element.kernels import follow
from mdr.normal.springs import MIN_SPRINGS
from mdr.spring.contact_modes import SLIP
from mdr.tools.arrays import EXACT, Array
from mdr.tools.checks import count, instance, positive_array
from mdr.tools.companions import Companion, bound
from mdr.tools.csv_table import Tabled, csv_text
from mdr.tools.progress import progress
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, span

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SPRINGS = 64  #: where none are asked for
SAMPLES = 32  #: of the shortest period
CORRELATIONS = 64  #: times of correlation in a history
MEMORIES = 16  #: times that the pull goes through the rms, or the slowest relaxation lasts, in it at least
LEAST_REALISATIONS = 8
SLOW_ARM = 100  #: relaxation time over that of correlation, of an arm that bears little but the deviation from a mean
RELAXED = 12  #: relaxation times after which the start is forgotten
MOST_SAMPLES = 2**24  #: of a history


@dataclass(frozen=True, eq=False, repr=False)
class RandomCof(Summarised, Tabled, ArrayRecord):
    """Outcome of random_cof(): friction over the pulling velocity, arrays of shape (n_v,)."""

    v_0: Array  #: pulling velocities [m/s]
    cof: Array  #: mean F_x over mean F_z, over all realisations [-]
    standard_error: Array  #: of cof, from the spread of the realisations [-]
    cof_error: Array  #: estimate of the numerical error of cof, of step and springs [-]
    realisations: Array  #: (n_realisations, n_v) mean F_x over mean F_z of each [-]; NaN where one never touches
    mu_0: float  #: local coefficient of friction [-]
    duration: float  #: of a realisation [s]
    n_t: int  #: samples of a realisation
    n_springs: int  #: springs at x >= 0, each for the pair +x, -x
    seed: int  #: of the realisations

    def _summary(self) -> Summary:
        return Summary(
            f"RandomCof at {self.v_0.size} velocities, {span(self.v_0, 'm/s')}",
            [
                ("COF", span(self.cof), f"of mu_0 = {self.mu_0:.6g}"),
                ("standard error", span(self.standard_error), f"of {len(self.realisations)} realisations"),
                ("error", span(self.cof_error), "numerical, of step and springs"),
                ("realisation", span(self.duration, "s"), f"{self.n_t} samples"),
            ],
        )

    def table(self) -> str:
        """Velocities, friction, standard and numerical error as CSV.

        Returns
        -------
        str
            What `to_csv` writes.
        """
        names = {"v_0": "m/s", "cof": "-", "standard_error": "-", "cof_error": "-"}
        return csv_text({f"{name} [{unit}]": getattr(self, name) for name, unit in names.items()})

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw friction with two standard errors over the velocity.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw. None makes a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            Where it was drawn.
        """
        from mdr.plots.records import plot_random_cof

        return plot_random_cof(self, ax)


@holds_for(
    NO_STRENGTH, RIGID, NO_SHAKE, GIVEN_DEPTH, instead="slide_record, or ContactElement, for a history of your own"
)
def random_cof(
    case: SlidingContact,
    spectrum: Spectrum,
    v_0: ArrayLike,
    *,
    n_realisations: int = 64,
    seed: int = 0,
    n_springs: int | None = None,
) -> RandomCof:
    """Friction [-] of a contact whose depth vibrates at random, with its standard error.

    Parameters
    ----------
    case : SlidingContact
        The contact, under a rigid pull. Its mean depth is kept; its oscillation gives way to the spectrum.
    spectrum : Spectrum
        Power density of the depth.
    v_0 : array_like of float, shape () or (n_v,)
        Pulling velocities [m/s], above zero.
    n_realisations : int
        Independent histories, at least 8, of 64 times of correlation each.
    seed : int
        The same seed gives the same histories, for every velocity and contact.
    n_springs : int, optional
        Springs at x > 0, at least 32, each for the pair at +x and -x. None takes 64.

    Returns
    -------
    RandomCof
        `cof` with its `standard_error`, and `cof_error` of step and springs.

    Raises
    ------
    TypeError, ValueError
        For a contact with a body, under a load or shaken in the plane, for one that never touches, velocities that are
        not positive, and a pull so slow that a history would have too many samples.

    See Also
    --------
    mdr.laws.random_friction : a fast pull, in closed form.
    slide_record : friction under a history of your own.

    Notes
    -----
    Between samples, 32 of the shortest period, the depth is linear. This error is of second order; every second sample
    tells it, and it is taken off. `cof_error` is what was taken off, and what half of the springs change in the first
    eight histories that touch. As the histories are the same for all velocities, statistical errors of neighbours have
    one sign.

    Examples
    --------
    >>> import mdr
    >>> steady = mdr.NormalOscillation(u_z0=20e-6, du_z=1e-6, omega=600.0)  # its mean depth alone matters
    >>> case = mdr.SlidingContact(mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, steady)
    >>> rough = mdr.Spectrum.band(rms=4e-6, f_low=50.0, f_high=150.0)
    >>> found = mdr.random_cof(case, rough, [5e-4, 2e-3], n_realisations=8)
    >>> print(found.cof.round(2))
    [0.43 0.49]
    """
    instance("spectrum", spectrum, Spectrum)
    velocities = np.array(positive_array("v_0", v_0, "m/s"), ndmin=1)
    if velocities.ndim != 1 or not velocities.size:
        raise ValueError(f"v_0 must be a list of velocities, got an array of shape {velocities.shape}")
    n, seed = count("n_realisations", n_realisations, LEAST_REALISATIONS), count("seed", seed, 0)
    springs = SPRINGS if n_springs is None else count("n_springs", n_springs, 2 * MIN_SPRINGS)
    n_t, dt = _samples(case, spectrum, float(velocities.min()))
    found, coarse = np.empty((2, n, velocities.size, 2))
    few: dict[int, Array] = {}  # of those that touch, with half of the springs
    for k in progress(range(n), "random_cof", "realisations"):
        u_z = case.cycle.u_z0 + spectrum.realisation(n_t, dt, seed, k)
        found[k] = _impulses(case, u_z, dt, velocities, springs)
        coarse[k] = _impulses(case, u_z[::2], 2 * dt, velocities, springs)
        if found[k, 0, 1] > 0 and len(few) < LEAST_REALISATIONS:
            few[k] = _impulses(case, u_z, dt, velocities, springs // 2)
    if not found[..., 1].any():
        raise ValueError("the indenter never touches in these histories: raise the mean depth or the rms")
    by_step = (found - coarse) / 3
    by_springs = _cof(found[list(few)]) - _cof(np.array([*few.values()]))
    found += by_step
    cof, along, normal = _cof(found), found[..., 0], found[..., 1]
    off, rounding = np.abs([_cof(found - by_step) - cof, by_springs]), Companion(0.0, least=EXACT * case.mu_0)
    return RandomCof(
        v_0=velocities,
        cof=cof,
        standard_error=np.std(along - cof * normal, axis=0, ddof=1) / (np.sqrt(n) * normal.mean(axis=0)),
        cof_error=np.array([bound(rounding, *map(Companion, at)) for at in off.T.tolist()]),
        realisations=_cof(found[:, None], axis=1),
        mu_0=case.mu_0,
        duration=n_t * dt,
        n_t=n_t,
        n_springs=springs,
        seed=seed,
    )


def _cof(impulses: Array, axis: int = 0) -> Array:
    """Mean of F_x over that of F_z; NaN where nothing touches."""
    total = impulses.sum(axis=axis)
    with np.errstate(invalid="ignore"):
        return np.asarray(total[..., 0] / total[..., 1])


def _samples(case: SlidingContact, spectrum: Spectrum, slowest: float) -> tuple[int, float]:
    """Samples of a history, an even number, and the time between them [s], of few digits, so that all steps are equal.

    Long enough for the slowest pull, close enough for the shortest period.
    """
    dt = float(np.float32(1 / (SAMPLES * spectrum.f[-1])))
    pull, relaxation = _per_rate(case) * spectrum.rms / slowest, _relaxation(case)
    memory = max(pull, relaxation)
    n_t = 2 * np.ceil(max(CORRELATIONS * spectrum.correlation_time, MEMORIES * memory) / (2 * dt))
    if n_t > MOST_SAMPLES and relaxation > pull:
        raise ValueError(
            f"a relaxation time of {relaxation:.6g} s is longer than histories of {MOST_SAMPLES} samples are: lower it "
            f"to {SLOW_ARM * spectrum.correlation_time:.3g} s, {SLOW_ARM} times that of correlation: it relaxes about "
            "a mean"
        )
    if n_t > MOST_SAMPLES:
        raise ValueError(
            f"a history would have {n_t:.2g} samples, {SAMPLES} of the period 1/f of {spectrum.f[-1]:.6g} Hz, at most "
            f"{MOST_SAMPLES}: raise v_0 = {slowest:.6g} m/s, or end the spectrum earlier"
        )
    return int(n_t), dt


def _per_rate(case: SlidingContact) -> float:
    """mu_0 kappa [-]: a pull of v_0 takes up a depth as fast as v_0/(mu_0 kappa)."""
    return case.mu_0 * case.material.mindlin_ratio


def _relaxation(case: SlidingContact) -> float:
    """Longest relaxation time [s]."""
    return max(case.material.tau, *(tau for _, tau in case.material.contact_arms), 0.0)


def _impulses(case: SlidingContact, u_z: Array, dt: float, velocities: Array, n_springs: int) -> Array:
    """Impulses of F_x and F_z [N s] over the period of a depth (n_t,) at each velocity, (n_v, 2).

    Each begins in full slip, and is led through as much of the past as friction remembers.
    """
    found = np.zeros((velocities.size, 2))
    least, deepest = float(u_z.min()), float(u_z.max())
    if deepest <= 0:
        return found
    stick = case.friction.stick
    row = springs_of(case.indenter, case.material, case.mu_0, deepest, least, n_springs, stick)
    past = _per_rate(case) * (stick * deepest - least) / velocities + RELAXED * _relaxation(case)
    depth, rates = u_z / row.length_z, velocities / row.length_x
    for k, lead in enumerate(np.ceil(past / dt).astype(int)):
        at = np.arange(-lead, depth.size + 1)
        t, z = dt * at, depth[at % depth.size]
        s, out = relaxed(row, z[0]), np.zeros((t.size, 6))
        if row.limit is not None:
            row.limit.was[:] = SLIP
        follow(s, s.copy(), t, rates[k] * t, z, np.empty(0), 1, row, out, 0, t.size - 1)
        found[k] = out[lead + 1 :, [3, 5]].sum(axis=0) * np.array([row.force_x, row.force_z])
    return found
