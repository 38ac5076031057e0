"""The curves of a contact beside measured friction, and how likely these are: what a fit and a sampler ask."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.case.contact import SlidingContact
from mdr.friction.cof_curve import friction_without_bound
from mdr.friction.free_parameters import Parameter, case_of, path_of
from mdr.friction.friction_data import FrictionData
from mdr.tools.arrays import Array
from mdr.tools.checks import row
from mdr.tools.records import ArrayRecord

STEP = 1e-3  #: of a difference, on the scale of the search: well above the noise of a run, well below any curvature


@dataclass(frozen=True)
class Curves:
    """Curves of a contact with other values of what is free, at coordinates x (k,); size: springs and steps."""

    case: SlidingContact
    data: FrictionData
    free: tuple[Parameter, ...]
    held: Mapping[str, Any]

    def __post_init__(self) -> None:
        self._over()

    def values(self, x: Array) -> dict[str, float]:
        """{path: value}."""
        return {one.path: one.value(at) for one, at in zip(self.free, x.tolist(), strict=True)}

    def case_at(self, x: Array) -> SlidingContact:
        """The contact."""
        return case_of(self.case, {**self.held, **self.values(x)})

    def missed(self, x: Array, size: tuple[int, int]) -> Array:
        """Its friction less that measured [-], (n,)."""
        data = self.data
        if data.values is None:
            return friction_without_bound(self.case_at(x), data.v_0, *size) - data.cof
        given, over = {**self.held, **self.values(x)}, self._over()
        cases = [case_of(self.case, {**given, over: value}) for value in data.values.tolist()]
        points = zip(cases, data.v_0.tolist(), strict=True)
        cof = [friction_without_bound(case, np.array([v_0]), *size) for case, v_0 in points]
        return np.concatenate(cof) - data.cof

    def differences(self, x: Array, of: Callable[[Array], Array]) -> Array:
        """Derivatives (n, k) of such a column, by a step into the range."""
        columns = []
        for i, one in enumerate(self.free):
            low, high = one.ends
            step = min(STEP, (high - low) / 4) * (1 if x[i] + STEP < high else -1)
            columns.append((of(x + step * (np.arange(x.size) == i)) - of(x)) / step)
        return np.transpose(columns)

    def _over(self) -> str:
        """The path of what the data are over; empty of the velocity."""
        try:
            return "" if self.data.values is None else path_of(self.case, self.data.over)
        except ValueError:
            part = "shake" if self.data.over in ("du_x", "du_y") else "oscillation"
            raise ValueError(
                f"the data are over {self.data.over}, which this case lacks: give it a {part} that has it"
            ) from None


@dataclass(frozen=True, eq=False, repr=False)
class LogLikelihood(ArrayRecord):
    """Logarithm of the likelihood of values of the parameters: `found.log_likelihood(values)` of a `Fit`.

    The data have independent, normal errors: those given, else the scatter about the best fit. Values are in SI, (k,),
    in the order of `found.values`. Runs are those of the fit. A prior is yours to add: as it stands it is flat in the
    values, within the bounds of the fit.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.5, oscillation=vibration)
    >>> data = mdr.FrictionData(v_0=[1e-4, 2e-4, 4e-4], cof=[0.365, 0.388, 0.4], error=[0.004] * 3)
    >>> found = mdr.fit(case, data, ["mu_0"], bounds={"mu_0": (0.1, 1.0)})
    >>> best, low = (found.log_likelihood([one["mu_0"]]) for one in (found.values, found.low))
    >>> print(f"{best - low:.1f}", found.log_likelihood([1.2]))
    9.0 -inf
    >>> value, gradient = found.log_likelihood.with_gradient([0.4])
    >>> print(gradient.shape)
    (1,)
    """

    curves: Curves
    size: tuple[int, int]  #: springs and steps of the runs
    sd: Array  #: standard deviations of the data [-], (n,)

    def __call__(self, values: ArrayLike) -> float:
        """The logarithm of the likelihood [-]; minus infinity outside the bounds, and where the case cannot be."""
        return self._found(values, with_gradient=False)[0]

    def with_gradient(self, values: ArrayLike) -> tuple[float, Array]:
        """The same, and its derivatives with respect to the values (k,) [1/SI], zero where it is infinite.

        They are differences of runs, one for each value, good to about a thousandth of the steepest.
        """
        return self._found(values, with_gradient=True)

    def _found(self, values: ArrayLike, with_gradient: bool) -> tuple[float, Array]:
        given, free = row("values", values), self.curves.free
        if given.size != len(free):
            raise ValueError(f"values must be {len(free)}, {', '.join(one.name for one in free)}, got {given.size}")
        if not np.all(self.sd > 0):
            raise ValueError(
                "the data have no error, and the best fit meets them: a likelihood needs errors of the data"
            )
        nothing = -np.inf, np.zeros(len(free))
        if any(not one.low <= value <= one.high for one, value in zip(free, given.tolist(), strict=True)):
            return nothing
        x = np.array([one.coordinate(value) for one, value in zip(free, given.tolist(), strict=True)])
        try:
            left = self._left(x)
            jac = self.curves.differences(x, self._left) if with_gradient else np.zeros((left.size, x.size))
        except ValueError:  # no case is there
            return nothing
        scale = np.array([one.unit or value for one, value in zip(free, given.tolist(), strict=True)])
        constant = np.sum(np.log(self.sd)) + left.size / 2 * np.log(2 * np.pi)
        return float(-(left @ left) / 2 - constant), -(left @ jac) / scale

    def _left(self, x: Array) -> Array:
        return np.asarray(self.curves.missed(x, self.size) / self.sd)
