"""fit(): parameters of a contact from measured friction, by least squares, with confidence intervals.

Positive parameters are searched for by their logarithm, so that scales do not matter; intervals come from the curvature
at the best fit and Student's t, and are asymmetric where the logarithm is. Parameters that the data do not tell apart,
or do not tell at all, are named in `warnings`: a fit may be good and say nothing about them.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from mdr.case.contact import KINDS, SlidingContact, as_given
from mdr.case.units import facts_at
from mdr.friction.cof_curve import CofCurve, cof_curve, friction_without_bound
from mdr.friction.friction_data import FrictionData
from mdr.normal.resolved import at_rest, resolved
from mdr.normal.vary import GROUPS, case_at, fields_of
from mdr.tools.arrays import Array
from mdr.tools.messages import offer, short
from mdr.tools.progress import Ticker
from mdr.tools.summary import Printed

STEP = 1e-3  #: of a logarithm, for derivatives: well above the noise of a run, well below any curvature
VAGUE = 1.0  #: half width of an interval of a logarithm, from which on the data hardly tell the parameter
ALIKE = 0.99  #: correlation from which on two parameters are hardly told apart
N_SPRINGS, STEPS = 64, 256  #: of a model that is marched


@dataclass(frozen=True)
class Fit(Printed):
    """A contact fitted to measurements; dictionaries by the names of the parameters as given."""

    case: SlidingContact  #: with the fitted parameters
    data: FrictionData
    values: dict[str, float]  #: best values, in SI
    low: dict[str, float]  #: lower ends of the confidence intervals
    high: dict[str, float]  #: upper ends
    confidence: float
    rms: float  #: root mean square of the deviations, in units of the errors given, else of the COF
    warnings: tuple[str, ...]  #: what the data do not tell

    @property
    def curve(self) -> CofCurve:
        """The curve of the fitted contact from rest to a little beyond the highest velocity measured; computed anew."""
        v_0 = np.linspace(0, 1.05 * float(self.data.v_0.max()), 60)
        return cof_curve(self.case, v_0, n_springs=N_SPRINGS, steps_per_period=STEPS)

    def plot(self, ax: Any = None) -> Any:
        """Draw the data with their errors, and the fitted curve.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw. None makes a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            Where it was drawn.
        """
        from mdr.plots import plot_fit

        return plot_fit(self, ax)

    def __str__(self) -> str:
        rows = [
            f"{name:<16} {value:.6g} {_unit(self.case, name)}  ({self.low[name]:.4g} ... {self.high[name]:.4g})"
            for name, value in self.values.items()
        ]
        return "\n".join([f"{self.confidence:.0%} intervals:", *rows, *self.warnings])


def fit(case: SlidingContact, data: FrictionData, parameters: Iterable[str], *, confidence: float = 0.95) -> Fit:
    """Parameters of a contact, in SI, from measured friction, by least squares, with confidence intervals.

    Parameters
    ----------
    case : SlidingContact
        The contact. The search begins with its values.
    data : FrictionData
        Measured friction over velocity.
    parameters : iterable of str
        What is fitted: "mu_0", "mindlin_ratio" (by Poisson's ratio), paths of fields ("material.tau", "pull.k_x",
        "indenter.R") or their last part where that is unique ("tau", "k_x", "m", "c_x"), or groups ("alpha", "T"). All
        but mindlin_ratio must be positive in the case.
    confidence : float
        Level of the intervals [-], between 0 and 1.

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

    Examples
    --------
    >>> import mdr
    >>> tapping = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.5, oscillation=tapping)
    >>> data = mdr.FrictionData(v_0=[1e-4, 2e-4, 4e-4], cof=[0.365, 0.388, 0.4])
    >>> found = mdr.fit(case, data, ["mu_0"])
    >>> print(f"{found.values['mu_0']:.2f}")
    0.40
    """
    from scipy.optimize import least_squares

    case = as_given(case)
    if not isinstance(data, FrictionData):
        raise TypeError(f"data must be FrictionData, as read_friction_data gives, got {short(repr(data))}")
    if not 0 < confidence < 1:
        raise ValueError(f"confidence must lie between 0 and 1, got {confidence!r}")
    model = _Model.of(case, data, parameters)
    if len(model.names) >= data.v_0.size:
        raise ValueError(f"{len(model.names)} parameters need more than {data.v_0.size} measurements")
    ticker = Ticker("fit", parts="curves")

    def residuals(x: Array) -> Array:
        ticker.tick()
        return model.residuals(x)

    bounds = np.transpose([model.bounds(name) for name in model.names])
    found = least_squares(residuals, model.start, bounds=bounds, diff_step=STEP, x_scale="jac", xtol=1e-7, ftol=1e-10)
    return _with_intervals(model, found.x, found.jac, found.fun, confidence)


@dataclass(frozen=True)
class _Model:
    case: SlidingContact
    data: FrictionData
    names: tuple[str, ...]  # as given
    paths: tuple[str, ...]
    start: Array  # logarithms of the values; mindlin_ratio as it is

    @classmethod
    def of(cls, case: SlidingContact, data: FrictionData, parameters: Iterable[str]) -> _Model:
        if isinstance(parameters, str) or not isinstance(parameters, Iterable):
            raise TypeError(f'parameters must be a list of names, got {short(repr(parameters))}; write ["mu_0", ...]')
        names = tuple(parameters)
        if not names:
            raise ValueError("parameters must name at least one, such as mu_0")
        paths = tuple(_path(case, name) for name in names)
        if len(set(paths)) < len(paths):
            raise ValueError(f"parameters name one twice: {', '.join(names)}")
        start = []
        for name, path in zip(names, paths, strict=True):
            value = _value(case, path)
            if path != "mindlin_ratio" and not value > 0:
                raise ValueError(f"{name} must be positive in the case, to begin with, got {value!r}")
            start.append(value if path == "mindlin_ratio" else np.log(value))
        return cls(case, data, names, paths, np.array(start))

    def bounds(self, name: str) -> tuple[float, float]:
        """Limits of the search: three decades to either side, and what Poisson's ratio allows."""
        i = self.names.index(name)
        if self.paths[i] == "mindlin_ratio":
            return 0.76, 1.5 + 1e-12
        return self.start[i] - 7, self.start[i] + 7

    def case_of(self, x: Array) -> SlidingContact:
        settings: dict[str, Any] = {}
        for path, value in zip(self.paths, x.tolist(), strict=True):
            if path == "mindlin_ratio":
                settings["material.nu"] = min((2 * value - 2) / (2 * value - 1), 0.5)
            else:
                settings[path] = float(np.exp(value))
        return case_at(self.case, settings)

    def residuals(self, x: Array) -> Array:
        cof = friction_without_bound(self.case_of(x), self.data.v_0, N_SPRINGS, STEPS)
        return (cof - self.data.cof) / (1.0 if self.data.error is None else self.data.error)


def _with_intervals(model: _Model, x: Array, jac: Array, left: Array, confidence: float) -> Fit:
    """The fit with intervals and warnings, from the Jacobian (n, k) and the residuals (n,) at the best values."""
    from scipy.stats import t

    free = left.size - x.size
    variance = float(left @ left) / free if model.data.error is None else 1.0
    _, lengths, right = np.linalg.svd(jac, full_matrices=False)
    kept = np.maximum(lengths, 1e-9 * lengths[0] + 1e-300)
    covariance = variance * (right.T / kept**2) @ right
    sigma = np.sqrt(np.diag(covariance))
    half = float(t.ppf(0.5 + confidence / 2, free)) * sigma
    names, values, low, high = model.names, {}, {}, {}
    for i, (name, path) in enumerate(zip(names, model.paths, strict=True)):
        ends = np.array([x[i], x[i] - half[i], x[i] + half[i]])
        values[name], low[name], high[name] = (
            ends if path == "mindlin_ratio" else np.exp(np.clip(ends, -700, 700))
        ).tolist()
    warnings = [f"{names[i]}: the data hardly tell it" for i in np.flatnonzero(half > VAGUE)]
    correlation = covariance / np.outer(sigma, sigma)
    warnings += [
        f"{names[i]} and {names[j]}: the data hardly tell them apart (correlation {correlation[i, j]:.3f})"
        for i in range(len(names))
        for j in range(i)
        if abs(correlation[i, j]) > ALIKE
    ]
    warnings += [
        f"{name}: the best fit is at the end of what is searched"
        for i, name in enumerate(names)
        if min(abs(x[i] - end) for end in model.bounds(name)) < 1e-6
    ]
    rms = float(np.sqrt(np.mean(left**2)))
    return Fit(model.case_of(x), model.data, values, low, high, confidence, rms, tuple(warnings))


def _path(case: SlidingContact, name: Any) -> str:
    """The path of a parameter in the case."""
    if not isinstance(name, str):
        raise TypeError(f"parameters must be names, got {short(repr(name))}")
    known = [f"{slot}.{field}" for slot in KINDS for field in fields_of(getattr(case, slot))]
    numbers = [path for path in known if isinstance(_value(case, path), int | float)]
    if name in ("mu_0", "mindlin_ratio", *GROUPS, *numbers):
        return name
    ends = [path for path in numbers if path.partition(".")[2] == name]
    if len(ends) == 1:
        return ends[0]
    short_names = [path.partition(".")[2] for path in numbers]
    meant = (
        f"is {' or '.join(ends)}"
        if ends
        else f"is no parameter of this case; {offer(name, ['mu_0', 'mindlin_ratio', *short_names])}"
    )
    raise ValueError(f"{short(name)} {meant}")


def _value(case: SlidingContact, path: str) -> Any:
    if path in ("mu_0", "T"):
        return getattr(case, path)
    if path in ("alpha", "chi"):
        return getattr(resolved(case), path)
    if path == "mindlin_ratio":
        return case.material.mindlin_ratio
    if path == "k_x/k_xc":
        return getattr(case.pull, "k_x", 0.0) / at_rest(case).k_xc
    if path == "omega_0/omega":
        omega_0 = case.pull.omega_0
        return omega_0 / case.omega if omega_0 < np.inf else 0.0
    slot, _, field = path.partition(".")
    return getattr(getattr(case, slot), field)


def _unit(case: SlidingContact, name: str) -> str:
    return "-" if name == "mindlin_ratio" else facts_at(_path(case, name)).unit
