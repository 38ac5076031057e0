"""fit(): parameters of a contact from measured friction, by least squares, with confidence intervals.

Intervals come from the curvature at the best fit and Student's t, on the scale on which a parameter is searched for
(`free_parameters`): asymmetric where that is the logarithm. A parameter whose interval is wider than its bounds, or
than three decades, is not determined by the data. Those that the data do not tell apart are named in `warnings`: a fit
may be good and say nothing about them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from mdr.case.contact import SlidingContact, as_given
from mdr.case.paths import require_apart
from mdr.closed_forms.shaken_pull import CLOSED_FORM
from mdr.friction.cof_curve import CofCurve, cof_curve
from mdr.friction.free_parameters import DECADES, NEAR_END, Parameter, path_of
from mdr.friction.friction_data import FrictionData
from mdr.friction.likelihood import Curves, LogLikelihood
from mdr.given.vary import still_held, warn_of_load
from mdr.march.result.refinement import default_springs, default_steps
from mdr.normal.resolved import at_rest, resolved
from mdr.plots.figures import Axes
from mdr.tools.arrays import EPS, Array
from mdr.tools.keywords import offering
from mdr.tools.messages import short
from mdr.tools.progress import Ended, Ticker, time_is_over, time_limit
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Printed

WORTH = 0.1  #: of the error of a measurement, which runs are to keep to
LEAST_GRID = 16  #: springs, or steps of a period, of a run that is worth anything
ROUGHLY, CLOSELY = 1e-3, 1e-5  #: share of chi squared that a step lowers it by where a search ends
STEPS_TOO_SHORT = 3  #: why least_squares ends
TOLD = 0.5  #: of the way to another point, by which derivatives may be off to be kept
ERRORS = 3.0  #: standard deviations from which on a deviation is no chance: of friction out of its range, or of the fit


@dataclass(frozen=True, eq=False, repr=False)
class Fit(Printed, ArrayRecord):
    """A contact fitted to measurements; dictionaries by the names of the parameters as given."""

    case: SlidingContact  #: with the fitted parameters
    data: FrictionData
    values: dict[str, float]  #: best values, in SI
    low: dict[str, float]  #: lower ends of the confidence intervals, within the bounds
    high: dict[str, float]  #: upper ends
    undetermined: tuple[str, ...]  #: parameters whose interval is wider than their bounds, or than three decades
    confidence: float
    residuals: Array  #: measured less fitted coefficient of friction [-], shape (n,), in the order of `data`
    correlation: Array  #: of the parameters [-], shape (k, k), in the order of `values`
    rms: float  #: root mean square of the deviations, in units of the errors given, else of the COF
    units: dict[str, str]  #: of the values, "" for pure numbers
    warnings: tuple[str, ...]  #: what the data do not tell
    cof_error: float  #: about the greatest error of the runs that were fitted [-]; 0 in closed form
    log_likelihood: LogLikelihood  #: of other values: found.log_likelihood(values), for a sampler
    stopped: str = ""  #: what ended the search before the best fit was found: values are the best so far

    @property
    def curve(self) -> CofCurve:
        """The curve of the fitted contact a little beyond the velocities measured, from rest; computed anew."""
        if self.data.over:
            raise ValueError(f"the data are over {self.data.over}: mdr.sweep({{...}}) of `case` draws friction over it")
        least, most = 1.05 * min(float(self.data.v_0.min()), 0.0), 1.05 * max(float(self.data.v_0.max()), 0.0)
        return cof_curve(self.case, np.linspace(least, most, 60))

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the data with their errors, the fitted curve, and what is left below.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw data and curve alone. None makes a new figure, with a second panel for the residuals.

        Returns
        -------
        matplotlib.axes.Axes
            Where data and curve were drawn.
        """
        from mdr.plots import plot_fit

        return plot_fit(self, ax)

    def __str__(self) -> str:
        names = list(self.values)
        pairs = [
            f"{one} and {two} {self.correlation[i, j]:+.2f}" for (i, one), (j, two) in combinations(enumerate(names), 2)
        ]
        scale = "in units of the errors" if self.data.error is not None else "of the COF"
        told = [f"correlations: {', '.join(pairs)}"] if pairs else []
        told += [f"residuals: {self.rms:.3g} root mean square, {scale}"]
        told += [f"runs: COF to about {self.cof_error:.1g}"] if self.cof_error else []
        rows = [f"{name:<16} {self._row(name)}" for name in names]
        return "\n".join([f"{self.confidence:.0%} intervals:", *rows, *told, *self.warnings])

    def _row(self, name: str) -> str:
        unit = f" {self.units[name]}" if self.units[name] else ""
        if name in self.undetermined:
            return f"not determined (best fit {self.values[name]:.4g}{unit})"
        return f"{self.values[name]:.4g} ({self.low[name]:.4g} ... {self.high[name]:.4g}){unit}"


@offering
def fit(
    case: SlidingContact,
    data: FrictionData,
    parameters: Iterable[str],
    *,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    confidence: float = 0.95,
    held: Mapping[str, Any] | None = None,
    limit_s: float | None = None,
) -> Fit:
    """Parameters of a contact, in SI, from measured friction, by least squares, with confidence intervals.

    Parameters
    ----------
    case : SlidingContact
        The contact. The search begins with its values.
    data : FrictionData
        Measured friction over velocity; of a contact that is shaken in the plane, either way.
    parameters : iterable of str
        What is fitted: "mu_0", "mindlin_ratio" (by Poisson's ratio), paths of fields ("material.tau", "pull.k_x",
        "indenter.R") or their last part where that is unique ("tau", "k_x", "m", "c_x"), or groups ("alpha", "T").
    bounds : dict of str to (float, float), optional
        Lowest and highest value of a parameter, in SI, by its name. None: a factor of 1000 either way of a positive
        one; else ten units of the contact either way, a phase half a turn; never beyond what the case can have.
    confidence : float
        Level of the intervals [-], between 0 and 1.
    held : mapping of str to float, optional
        "load" [N], "frequency" [Hz] or "tan_delta" [-], which hold as parameters vary, unless a parameter sets the
        same: a load by another depth for every shape and material. Beside a load "hold" says what stays: "depth", at
        which it rests, or "load", its mean. `mdr fit` holds what the case file gives.
    limit_s : float, optional
        Computing time [s] after which the search ends, looked at between runs. An interrupt (Ctrl-C) ends it too. The
        best values so far are answered, and `stopped` says why. None: until the best fit is found.

    Returns
    -------
    Fit
        The fitted case, values and intervals by name, and warnings about what the data do not tell.

    Raises
    ------
    ValueError
        For what cannot be fitted, such as more parameters than points.
    TypeError
        For data or parameters of another type.

    Notes
    -----
    A positive parameter is searched for by its logarithm. One that may change sign (a phase), begins at zero, or has
    bounds that reach zero, is searched for on a linear scale, and so is mindlin_ratio. The search finds the best fit
    nearest to where it begins: begin elsewhere where there may be several.

    Runs are as accurate as the data are worth: of so many springs and steps that at the best fit twice as many change
    the COF by less than a tenth of its error, or of the scatter about the curve, at each point; never more than the
    numbers with which `cof_curve` begins. The search ends where chi squared changes by less than 1e-5 of it, parameters
    by some hundredths of their standard deviation.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.5, oscillation=vibration)
    >>> data = mdr.FrictionData(v_0=[1e-4, 2e-4, 4e-4], cof=[0.365, 0.388, 0.4])
    >>> found = mdr.fit(case, data, ["mu_0"], bounds={"mu_0": (0.1, 1.0)})
    >>> print(f"{found.values['mu_0']:.2f}")
    0.40
    """
    case = as_given(case)
    at_rest(case)  # warns of what is unlikely
    if not isinstance(data, FrictionData):
        raise TypeError(f"data must be FrictionData, as read_friction_data gives, got {short(repr(data))}")
    if not 0 < confidence < 1:
        raise ValueError(f"confidence must lie between 0 and 1, got {confidence!r}")
    _refuse_wrong_signs(case, data)
    free = _parameters(case, parameters, bounds, held or {})
    if len(free) >= data.v_0.size:
        raise ValueError(f"{len(free)} parameters need more than {data.v_0.size} measurements")
    model = _Search(Curves(case, data, free, still_held(held or {}, [one.path for one in free])))
    stopped = ""
    with time_limit(limit_s):
        try:
            model.search()
        except Ended:
            stopped = f"the limit of {limit_s:g} s"
        except KeyboardInterrupt:
            stopped = "an interrupt"
            if model.best is None:
                raise
    if model.best is None:
        raise ValueError(f"limit_s = {limit_s:g} s is over before the first curve is done; raise it")
    size = float(np.linalg.norm(data.cof / model.error))
    idle = np.linalg.norm(model.jac, axis=0) < np.sqrt(EPS) * size  # where these have drifted to means nothing
    x = np.where(idle & (not stopped), [one.coordinate(one.start) for one in free], model.best.x)
    fitted = _with_intervals(model, x, model.jac, model.best.left, confidence, stopped)
    warn_of_load({**model.curves.held, **model.curves.values(x)}, fitted.case, "at the best fit ")
    return fitted


def _parameters(case: SlidingContact, names: Any, bounds: Any, held: Mapping[str, Any]) -> tuple[Parameter, ...]:
    if isinstance(names, str) or not isinstance(names, Iterable):
        raise TypeError(f'parameters must be a list of names, got {short(repr(names))}; write ["mu_0", ...]')
    names, bounds = tuple(names), {} if bounds is None else bounds
    if not names:
        raise ValueError("parameters must name at least one, such as mu_0")
    if not isinstance(bounds, Mapping):
        raise TypeError(f'bounds must be a dict, {{"{names[0]}": (low, high)}}, got {short(repr(bounds))}')
    paths = [path_of(case, name) for name in names]
    require_apart(paths, names)
    kept = still_held(held, paths)
    free = tuple(
        Parameter.of(case, name, bounds.get(name, bounds.get(path)), kept)
        for name, path in zip(names, paths, strict=True)
    )
    if strange := [name for name in bounds if name not in (*names, *paths)]:
        raise ValueError(f"bounds: {short(str(strange[0]))} is not fitted; the parameters are {', '.join(names)}")
    return free


def _refuse_wrong_signs(case: SlidingContact, data: FrictionData) -> None:
    """What a contact that is not shaken in the plane cannot show."""
    if case.is_shaken:
        return
    if data.v_0[0] < 0:
        raise ValueError(
            f"v_0 must not be negative, got {float(data.v_0[0])!r} m/s: both ways are alike unless the contact is "
            "shaken in the plane; give the speed"
        )
    error = 0.0 if data.error is None else ERRORS * data.error
    if np.any(wrong := data.cof + error < 0):
        i = int(np.argmax(wrong))
        raise ValueError(
            f"cof must not be negative, got {data.cof[i]:.6g} at {data.v_0[i]:.6g} m/s: a contact that is not shaken "
            "in the plane is held back, by 0 to mu_0; turn the sign of the force, or give the errors of the data"
        )


class _Best(NamedTuple):
    """The closest curve so far."""

    x: Array  #: coordinates (k,)
    left: Array  #: fitted less measured, over the errors (n,)
    size: tuple[int, int]  #: springs and steps of its runs


class _Search:
    """The search for the best fit: what is left of the data at coordinates x (k,), its derivatives, the best so far."""

    def __init__(self, curves: Curves) -> None:
        self.curves, self.data, self.free = curves, curves.data, curves.free
        self.error = 1.0 if self.data.error is None else self.data.error
        self.best: _Best | None = None
        self.jac = np.zeros((self.data.v_0.size, len(self.free)))  #: derivatives (n, k)
        self.cof_error, self.size = 0.0, (0, 0)
        self.refused: ValueError | None = None  #: why there was no case where the last step first led to
        self.trial: ValueError | None = None  #: the same of the next step
        self._known: dict[tuple[Any, ...], Array] = {}  #: what is left, by size and coordinates
        self._last: tuple[Array, Array] | None = None  #: coordinates of `jac`, and what is left there
        self._ticker = Ticker("fit", parts="curves")

    def search(self) -> None:
        """The best fit, by runs as coarse as the data allow."""
        x = np.array([one.first for one in self.free])
        first = resolved(self.curves.case)
        most = default_springs(first), default_steps(first)
        shares = (1,) if first in CLOSED_FORM else (4, 2, 1)
        sizes = list(dict.fromkeys((max(most[0] // k, LEAST_GRID), max(most[1] // k, LEAST_GRID)) for k in shares))
        for size, finer in zip(sizes, [*sizes[1:], None], strict=True):
            self.size = size  # the same of all curves, or they would jump
            try:
                x = self._descended(x, ROUGHLY)
            except ValueError:
                if finer is None:
                    raise
                continue  # a brief contact that so few steps do not see
            if finer is None or self._is_fine_enough(x, finer):
                break
        self._last = None  # derivatives anew
        self._descended(x, CLOSELY)

    def _descended(self, x: Array, enough: float) -> Array:
        """Where steps lower chi squared by less than a share that is enough."""
        from scipy.optimize import least_squares

        ends = np.transpose([one.ends for one in self.free])
        self.left(x)
        found = least_squares(self._or_no_case, x, self.slopes, tuple(ends), x_scale="jac", xtol=1e-7, ftol=enough)
        if found.status == STEPS_TOO_SHORT and (refusal := self.trial or self.refused):
            raise refusal
        return np.asarray(found.x)

    def _or_no_case(self, x: Array) -> Array:
        """What is left; infinite where no case is, for which a step is shortened."""
        try:
            return self.left(x)
        except ValueError as refusal:
            self.trial = refusal
            return np.full(self.data.v_0.size, np.inf)

    def slopes(self, x: Array) -> Array:
        """Derivatives (n, k): those of the point before, to which the way from there is added (Broyden, Mathematics of
        Computation 19 (1965) 577), where they told most of that way; else by differences.
        """
        left, self.refused, self.trial = self._left(x, self.size), self.trial, None
        if self._last is not None and (step := x - self._last[0]).any():
            moved = left - self._last[1]
            missed = moved - self.jac @ step
            self.jac = self.jac + np.outer(missed, step) / (step @ step)
            if missed @ missed > TOLD**2 * (moved @ moved):
                self._last = None
        if self._last is None:
            self.jac = self.curves.differences(x, lambda at: self._left(at, self.size))
        self._last = x.copy(), left
        return self.jac

    def _is_fine_enough(self, x: Array, finer: tuple[int, int]) -> bool:
        """Whether finer runs are the same but for what the data are not worth."""
        left = self._left(x, self.size)
        off = np.abs(self._left(x, finer) - left) * self.error
        self.cof_error = float(off.max())
        scatter = np.sqrt(left @ left / (left.size - x.size)) if self.data.error is None else self.error
        if np.all(off <= WORTH * scatter):
            return True
        self.cof_error /= 3  # of the finer runs, at second order
        return False

    def left(self, x: Array) -> Array:
        """Fitted less measured, over the errors (n,)."""
        left, best = self._left(x, self.size), self.best
        if best is None or best.size != self.size or left @ left < best.left @ best.left:
            self.best = _Best(x.copy(), left, self.size)
            values = ", ".join(f"{one.name} = {one.told(at)}" for one, at in zip(self.free, x.tolist(), strict=True))
            self._ticker.what = f"fit, {values} so far, {float(np.sqrt(np.mean(left**2))):.3g} left on average"
        return left

    def _left(self, x: Array, size: tuple[int, int]) -> Array:
        key = (size, *x.tolist())
        if key not in self._known:
            if time_is_over():
                raise Ended
            self._ticker.tick()
            try:
                self._known[key] = self.curves.missed(x, size) / self.error
            except ValueError as refusal:
                where = ", ".join(f"{path} = {value:.6g}" for path, value in self.curves.values(x).items())
                raise ValueError(f"the search came to {where}: {refusal}; keep it away by bounds") from None
        return self._known[key]


def _with_intervals(model: _Search, x: Array, jac: Array, left: Array, confidence: float, stopped: str) -> Fit:
    """The fit with intervals and warnings, from the Jacobian (n, k) and the residuals (n,) at the best values."""
    from scipy.stats import t

    spare = left.size - x.size
    variance = float(left @ left) / spare if model.data.error is None else 1.0
    _, lengths, right = np.linalg.svd(jac, full_matrices=False)
    kept = np.maximum(lengths, 1e-9 * lengths[0] + 1e-300)
    covariance = variance * (right.T / kept**2) @ right
    sigma = np.sqrt(np.diag(covariance))
    half = float(t.ppf(0.5 + confidence / 2, spare)) * sigma
    correlation = covariance / np.outer(sigma, sigma) if variance else np.eye(x.size)
    free = model.free
    names = [one.name for one in free]
    case = model.curves.case_at(x)
    return Fit(
        case=case,
        data=model.data,
        values={one.name: one.value(x[i]) for i, one in enumerate(free)},
        low={one.name: one.value(x[i] - half[i]) for i, one in enumerate(free)},
        high={one.name: one.value(x[i] + half[i]) for i, one in enumerate(free)},
        undetermined=tuple(names[i] for i, one in enumerate(free) if not 2 * half[i] <= one.widest),
        confidence=confidence,
        residuals=-left * model.error,
        correlation=correlation,
        rms=float(np.sqrt(np.mean(left**2))),
        units={one.name: one.symbol for one in free},
        warnings=(
            *_ended(stopped),
            *_vague(free, x, half),
            *_alike(names, correlation),
            *_beyond(case, model),
            *_missed(left, model),
        ),
        cof_error=model.cof_error,
        log_likelihood=LogLikelihood(
            model.curves, model.size, np.broadcast_to(model.error * variance**0.5, left.shape)
        ),
        stopped=stopped,
    )


def _ended(stopped: str) -> list[str]:
    """That the search was stopped."""
    return (
        [f"stopped by {stopped}: the best values so far, not those of the best fit, and rough intervals"]
        if stopped
        else []
    )


def _vague(free: tuple[Parameter, ...], x: Array, half: Array) -> list[str]:
    """Parameters that the data determine badly, or not at all."""
    told = []
    for one, at, wide in zip(free, x, half, strict=True):
        if not 2 * wide <= one.widest:
            limit = "its bounds" if one.unit or one.widest < np.log(10) * DECADES else f"{DECADES:.0f} decades"
            told.append(f"{one.name}: not determined by these data; its interval is wider than {limit}")
        # known to no more than a factor of e: poorly determined
        elif not one.unit and wide > 1.0:
            told.append(f"{one.name}: poorly determined; its interval spans a factor of {np.exp(2 * wide):.2g}")
        low, high = one.ends
        if min(at - low, high - at) < NEAR_END * (high - low):
            told.append(f"{one.name}: the best fit is at the end of what is searched, {one.low:.4g} to {one.high:.4g}")
    return told


def _alike(names: list[str], correlation: Array) -> list[str]:
    return [
        f"{one} and {two}: the data hardly tell them apart (correlation {correlation[i, j]:.3f})"
        for (j, two), (i, one) in combinations(enumerate(names), 2)
        if abs(correlation[i, j]) > 0.99  # hardly told apart
    ]


def _beyond(case: SlidingContact, model: _Search) -> list[str]:
    """Friction above the local coefficient, which no contact shows."""
    free = {one.path for one in model.free}
    above = model.data.cof - case.mu_0 - (0.0 if model.data.error is None else ERRORS * model.data.error)
    if not case.friction.is_coulomb or free & set(case.friction.numbers) or case.is_shaken or not above.max() > 0:
        return []
    return [f"cof: measured up to {model.data.cof.max():.4g}, above mu_0 = {case.mu_0:.4g}; fit mu_0 too"]


def _missed(left: Array, model: _Search) -> list[str]:
    """Whether the deviations (n,), in units of the errors, are larger than these explain: chi squared."""
    from scipy.stats import chi2

    if model.data.error is None or chi2.sf(float(left @ left), left.size - len(model.free)) > chi2.sf(ERRORS**2, 1):
        return []
    return ["the curve misses the data by more than their errors explain: free another parameter, or doubt the errors"]
