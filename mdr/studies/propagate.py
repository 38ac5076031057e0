"""propagate(): how sure friction and critical velocity are, where inputs are known with a standard deviation.

Two answers side by side. By slopes: with the derivatives d_i of `sensitivity` and standard deviations s_i of inputs
that vary apart, the variance is the sum of (d_i s_i)², of which each input has its share. By samples: the inputs are
drawn, normal and seeded, and each draw is a case of its own. They are compared, mean and standard deviation, within
the statistical error of so many samples.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact, as_given
from mdr.case.paths import RIG, facts_at, require_apart
from mdr.friction.fit import ERRORS
from mdr.friction.free_parameters import case_of
from mdr.friction.inputs import OF_RUN, Inputs
from mdr.friction.sensitivity import LABELS, Sensitivity, sensitivity
from mdr.given.vary import still_held
from mdr.march.periodic.steady import BUDGET
from mdr.plots.figures import Axes
from mdr.studies.engine import points_of
from mdr.studies.many import Listed
from mdr.studies.quantities import CATALOGUE
from mdr.tools.arrays import EXACT, Array
from mdr.tools.checks import count, finite, positive
from mdr.tools.csv_table import Tabled, csv_text
from mdr.tools.keywords import offering
from mdr.tools.messages import most_frequent, short
from mdr.tools.notation import parted, shown, value_in
from mdr.tools.records import ArrayRecord
from mdr.tools.status import Status
from mdr.tools.summary import Summarised, Summary

LEAST, MOST = 30, 1_000_000  #: samples: so few tell a standard deviation to an eighth of it, so many fill the memory
MIDDLE = (0.025, 0.975)  #: quantiles between which 95 % of the samples lie
ASKED = tuple(CATALOGUE[name] for name in ("cof", "cof_error", "v_c"))
UNITS = {"cof": "-", "v_c": "m/s"}  #: of what is asked for


@dataclass(frozen=True, eq=False, repr=False)
class Samples(ArrayRecord):
    """A quantity of n samples."""

    values: Array  #: (n,), NaN of a sample that has none
    mean: float  #: of those that have one
    sd: float  #: their standard deviation
    low: float  #: quantile of 2.5 %
    high: float  #: quantile of 97.5 %
    error: float  #: numerical error of a value, on average
    left_out: tuple[str, ...]  #: how many have none, and why

    @property
    def known(self) -> Array:
        """The values of those that have one."""
        return np.asarray(self.values[~np.isnan(self.values)])


@dataclass(frozen=True, eq=False, repr=False)
class Propagated(Summarised, Tabled, ArrayRecord):
    """Friction and critical velocity with standard deviations; dictionaries by the path of an input, or by "cof" and
    "v_c". Of friction there is nothing where no velocity was given.
    """

    v_0: float | None  #: pulling velocity [m/s]
    inputs: Mapping[str, float]  #: their values [SI]
    spread: Mapping[str, float]  #: their standard deviations [SI]
    cof: float | None  #: coefficient of friction of the case [-]
    cof_sd: float | None  #: its standard deviation [-] by slopes; None where a slope is not there
    cof_share: Mapping[str, float]  #: of each input in the variance of `cof` by slopes [-]
    v_c: float  #: critical velocity of the case [m/s]
    v_c_sd: float | None  #: its standard deviation [m/s] by slopes; None where a slope is not there
    v_c_share: Mapping[str, float]  #: of each input in the variance of `v_c` by slopes [-]
    drawn: Array  #: inputs of the samples [SI], (n, k), in the order of `spread`
    #: of "cof" and "v_c": values (n,), NaN of a sample without; their mean, sd, low and high, between which 95 % lie;
    #: error, of the runs; left_out, how many have none, and why
    samples: Mapping[str, Samples]
    why: Mapping[str, str]  #: why slopes and samples do not agree, or there is no slope; "" where they agree

    @property
    def agrees(self) -> dict[str, bool | None]:
        """Whether slopes and samples of "cof" and "v_c" agree; None without slopes."""
        return {name: None if getattr(self, f"{name}_sd") is None else not why for name, why in self.why.items()}

    def _summary(self) -> Summary:
        rows = []
        for name, known in self.samples.items():
            value, sd, unit = getattr(self, name), getattr(self, f"{name}_sd"), UNITS[name]
            told = shown(value, unit) if sd is None else f"{shown(value, unit)} +- {shown(sd, unit, 3)}"
            rows.append((LABELS[name], told, "by slopes" if sd is not None else "of the case"))
            mean = f"{shown(known.mean, unit)} +- {shown(known.sd, unit, 3)}"
            ends = f"{shown(known.low, unit, 4)} to {shown(known.high, unit, 4)}"
            rows.append(("", mean, f"{known.known.size} samples, 95 % from {ends}"))
        for path, sd in self.spread.items():
            shares = {LABELS[name]: getattr(self, f"{name}_share").get(path) for name in self.samples}
            told = ", ".join(f"{label} {share:.1%}" for label, share in shares.items() if share is not None)
            unit = facts_at(path).unit
            rows.append((path, f"{shown(self.inputs[path], unit)} +- {shown(sd, unit, 3)}", told and f"share: {told}"))
        rows += [("warning", f"of {LABELS[name]}: {why}", "") for name, why in self.why.items() if why]
        reasons = [(one, LABELS[name]) for name, known in self.samples.items() for one in known.left_out]
        for why in dict.fromkeys(one for one, _ in reasons):
            rows.append(("left out", f"of {' and '.join(label for one, label in reasons if one == why)}, {why}", ""))
        where = "" if self.v_0 is None else f", at v_0 = {shown(self.v_0, 'm/s')}"
        return Summary(f"Propagated: values with their standard deviations{where}", rows)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the samples as a histogram, and the normal curve that the slopes make of them.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw friction alone, or v_c where there is none. None makes a new figure with a panel for each.

        Returns
        -------
        matplotlib.axes.Axes
            Where friction was drawn.
        """
        from mdr.plots.inputs import plot_propagated

        return plot_propagated(self, ax)

    def table(self) -> str:
        """A row for each sample as CSV: its inputs, friction and critical velocity, NaN where it has none.

        Returns
        -------
        str
            What `to_csv` writes.
        """
        inputs = zip(self.spread, self.drawn.T, strict=True)
        columns = {f"{path} [{facts_at(path).unit}]": values for path, values in inputs}
        return csv_text(columns | {f"{name} [{UNITS[name]}]": one.values for name, one in self.samples.items()})


@offering
def propagate(
    case: SlidingContact,
    spread: Mapping[str, float | str],
    v_0: float | None = None,
    *,
    held: Mapping[str, Any] | None = None,
    samples: int = 1000,
    seed: int = 0,
    accuracy: float = BUDGET,
) -> Propagated:
    """Standard deviations of friction [-] and critical velocity [m/s] from those of inputs.

    Parameters
    ----------
    case : SlidingContact
        The contact, with the mean of each input.
    spread : mapping of str to float or str
        Standard deviation of each input, by its path as in `find`, or "v_0": a number in SI, a text with a unit
        ("0.1um"), or per cent of the value of the input ("5%"). Inputs vary apart, each by a normal distribution.
    v_0 : float, optional
        Pulling velocity [m/s]. None leaves friction out: v_c alone, without a run.
    held : mapping of str to float, optional
        "load" [N], "frequency" [Hz] or "tan_delta" [-] that the case was made from, as in `tolerance`: they hold while
        inputs vary, unless an input sets the same.
    samples : int
        How many cases are drawn, 30 or more. The standard deviation of n samples is known to 1/sqrt(2 n) of it.
    seed : int
        Of the draws, zero or above. The same seed gives the same samples.
    accuracy : float
        Bound on the error of `cof` over mu_0 [-] of every run, as in `slide`.

    Returns
    -------
    Propagated
        Standard deviations by slopes, the share of each input, and the samples beside them.

    Raises
    ------
    ValueError
        For what is no number of the case, a spread that is not positive, inputs that set the same, where friction of
        the case does not settle, and where hardly a sample can be.
    TypeError
        For a case that is no SlidingContact, and for a spread that is no dict.

    Notes
    -----
    Slopes know the case alone. Where friction bends over the spread, as it does where v_c lies within it, the samples
    have another mean and another standard deviation. `agrees` says whether these differ by more than three of the
    standard errors of so many samples of a normal distribution, and `why` says how. An input without a slope, as mu_s
    where friction jumps, leaves the samples alone.

    A sample that the case cannot have, such as nu = 0.51, is left out. So is one that does not settle. `left_out` of
    the samples counts them: the rest is no normal distribution any more.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.4)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> found = mdr.propagate(case, {"mu_0": "3%", "oscillation.du_z": "0.08um"}, 1e-4, samples=200)
    >>> print(f"{found.v_c_sd / found.v_c:.3f}, of mu_0 {found.v_c_share['mu_0']:.2f}")
    0.050, of mu_0 0.36
    >>> print(f"{found.cof:.3f} +- {found.cof_sd:.3f}", found.agrees["cof"])
    0.368 +- 0.010 True
    """
    case = as_given(case)
    if not isinstance(spread, Mapping) or not spread:
        raise TypeError(f'spread must be a dict such as {{"mu_0": "5%"}}, got {short(repr(spread))}')
    n, seed = count("samples", samples, LEAST), count("seed", seed, 0)
    if n > MOST:
        raise ValueError(f"samples must be at most {MOST}, got {n}: more do not fit into memory")
    kept = still_held(held or {}, ())
    of = Inputs(case_of(case, kept), None if v_0 is None else finite("v_0", v_0), kept)
    paths = of.asked(spread)
    require_apart(paths, list(spread))
    deviations = {path: _deviation(of, path, given) for path, given in zip(paths, spread.values(), strict=True)}
    kept = still_held(kept, paths)
    # what a rig is set to holds while other inputs vary, in the slopes as in the samples
    slopes = sensitivity(
        of.case, v_0, paths, held={**kept, **{path: of.value(path) for path in paths if path in RIG}}, accuracy=accuracy
    )
    draws = np.random.default_rng(seed).standard_normal((n, len(paths)))
    drawn = np.array([*slopes.inputs.values()]) + draws * [*deviations.values()]
    pulls = drawn[:, paths.index(OF_RUN)] if OF_RUN in paths else np.full(n, np.nan if v_0 is None else v_0)
    settings = tuple({**kept, **dict(zip(paths, one, strict=True))} for one in drawn.tolist())
    found = _samples(
        _Drawn(
            of.case,
            (),
            ASKED if v_0 is not None else ASKED[-1:],
            {"accuracy": accuracy},
            {},
            (),
            tuple(pulls),
            settings,
        )
    )
    cof, v_c = (_by_slopes(slopes, name, deviations) for name in UNITS)
    faster = int(np.sum(pulls > found["v_c"].values))
    why = {name: _apart(name, {"cof": cof, "v_c": v_c}[name], one, faster) for name, one in found.items()}
    return Propagated(
        v_0=of.v_0,
        inputs=slopes.inputs,
        spread=deviations,
        cof=slopes.cof,
        cof_sd=cof.sd,
        cof_share=cof.shares,
        v_c=slopes.v_c,
        v_c_sd=v_c.sd,
        v_c_share=v_c.shares,
        drawn=drawn,
        samples=found,
        why=why,
    )


def _deviation(of: Inputs, path: str, given: Any) -> float:
    """The standard deviation [SI] of an input; per cent are of its value."""
    name, unit, value = f"spread of {path}", facts_at(path).unit, of.value(path)
    if isinstance(given, str):
        is_share = parted(given)[1] == "%"
        given = value_in(name, given, "-") * abs(value) if is_share else value_in(name, given, unit)
    known = shown(value, unit)
    return positive(name, given, f"a standard deviation, or per cent of the value, {known}; leave out what is exact")


@dataclass(frozen=True)
class _Drawn(Listed):
    """Work of the draws: a case for each, of what is set in it."""

    settings: tuple[Mapping[str, Any], ...] = ()

    @property
    def moves(self) -> bool:
        """Whether friction is asked for."""
        return any(one.per_velocity for one in self.quantities)

    def case_of(self, unit: int) -> SlidingContact:
        """The contact of a draw."""
        return case_of(self.case, {path: one for path, one in self.settings[unit].items() if path != OF_RUN})


def _samples(work: _Drawn) -> dict[str, Samples]:
    """What is asked for of each draw; of what has not settled there is no friction."""
    points = points_of(work, "propagate")
    *of_cof, v_c = points.values
    found = {"v_c": _statistics("v_c", v_c, points.why, EXACT * np.abs(v_c))}
    if of_cof:
        cof, errors = np.where(points.status == Status.DONE, of_cof, np.nan)
        found = {"cof": _statistics("COF", cof, points.why, errors)} | found
    return found


def _statistics(what: str, values: Array, why: NDArray[np.object_], errors: Array) -> Samples:
    """Mean, standard deviation and quantiles of the samples that have a value; infinite ones have quantiles alone."""
    is_known = ~np.isnan(values)
    known, left_out = values[is_known], tuple(most_frequent(why[~is_known].tolist()))
    if known.size < LEAST:
        raise ValueError(
            f"spread: {known.size} of {values.size} samples have a {what}, and {LEAST} tell a standard deviation: "
            f"{'; '.join(left_out)}; give a smaller spread"
        )
    is_finite = bool(np.isfinite(known).all())
    mean, sd = (float(np.mean(known)), float(np.std(known, ddof=1))) if is_finite else (np.inf, np.inf)
    low, high = np.quantile(known, MIDDLE, method="inverted_cdf").tolist()
    return Samples(values, mean, sd, low, high, float(np.nanmean(errors)), left_out)


class _BySlopes(NamedTuple):
    """What derivatives make of the standard deviations of inputs."""

    value: float  #: of the case
    sd: float | None = None  #: None where a slope is not there
    shares: Mapping[str, float] = {}
    error: float = 0.0  #: of the standard deviation
    why: str = ""  #: why there is no slope


def _by_slopes(slopes: Sensitivity, name: str, deviations: Mapping[str, float]) -> _BySlopes:
    """The standard deviation of a quantity; an input that it does not know has no part in it."""
    value, d, errors = getattr(slopes, name), getattr(slopes, f"d_{name}"), slopes.error[name]
    if value is None or slopes.why[name]:
        return _BySlopes(value, why=f"the samples stand alone, without a slope: {[*slopes.why[name].values(), ''][0]}")
    parts = {path: slope * deviations[path] for path, slope in d.items()}
    total = float(np.linalg.norm([*parts.values()]))
    shares = {path: (part / total) ** 2 if total else 0.0 for path, part in parts.items()}
    return _BySlopes(value, total, shares, sum(errors[path] * deviations[path] for path in d))


def _apart(name: str, by: _BySlopes, found: Samples, faster: int) -> str:
    """Where the samples are not those of a normal distribution by slopes, beyond chance and the errors of both, and
    why; "" where they may be.
    """
    if by.sd is None:
        return by.why
    n, unit = found.known.size, UNITS[name]
    told = [
        f"{what} of the samples {shown(one, unit, 6)}, {whose} {shown(other, unit, 6)}"
        for what, one, whose, other, chance, error in (
            ("mean", found.mean, "of the case", by.value, by.sd / np.sqrt(n), found.error),
            ("standard deviation", found.sd, "by slopes", by.sd, by.sd / np.sqrt(2 * n), found.error + by.error),
        )
        if not abs(one - other) <= ERRORS * chance + error
    ]
    if not told:
        return ""
    why = "it bends over the spread"
    if name == "cof" and 0 < faster < found.values.size:
        why = f"v_c lies within the spread, and {faster} of {found.values.size} samples are pulled faster"
    return f"{'; '.join(told)}: {why}; trust the samples"
