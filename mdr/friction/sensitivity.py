"""sensitivity(): derivatives of friction and of the critical velocity with respect to every input of a case."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

from mdr.case.contact import SlidingContact, as_given
from mdr.case.paths import facts_at
from mdr.closed_forms.critical_velocity import critical_velocity
from mdr.closed_forms.full_slip import static_cof
from mdr.closed_forms.shaken_pull import CLOSED_FORM
from mdr.friction.cof_curve import counted
from mdr.friction.free_parameters import case_of
from mdr.friction.inputs import OF_RUN, Inputs
from mdr.friction.shaken import holding_band, no_load_velocity
from mdr.friction.slopes import Functions, Slope, closed_form, friction, slope
from mdr.given.vary import still_held, warn_of_load
from mdr.march.periodic.steady import BUDGET, accuracy_of
from mdr.march.result.slide import LAW
from mdr.normal.resolved import at_rest, resolved
from mdr.plots.figures import Axes
from mdr.tools.allowed import refusal_of
from mdr.tools.arrays import SAME
from mdr.tools.checks import finite
from mdr.tools.csv_table import Tabled, csv_text
from mdr.tools.keywords import offering
from mdr.tools.notation import shown
from mdr.tools.progress import progress
from mdr.tools.summary import Row, Summarised, Summary, number

Dictionary = Mapping[str, float]  #: by the path of an input


@dataclass(frozen=True)
class Sensitivity(Summarised, Tabled):
    """Friction, critical velocity and what holds at rest of a case, with derivatives in SI by the path of an input.

    An input without a derivative is in none of the dictionaries but `why`.
    """

    v_0: float | None  #: pulling velocity [m/s], 0 of one too slow for a run; None where none was given
    inputs: Dictionary  #: values [SI] of the inputs
    cof: float | None  #: coefficient of friction [-] at v_0; None without one
    d_cof: Dictionary  #: its derivatives
    v_c: float  #: critical velocity [m/s]
    d_v_c: Dictionary  #: its derivatives
    static_cof: float | None  #: limit of friction as v_0 -> 0 [-]; None where no closed form has it
    d_static_cof: Dictionary  #: its derivatives
    band: float | None  #: width of the `holding_band` [-] of a shake; None without one, or without a closed form
    d_band: Dictionary  #: its derivatives
    no_load_velocity: float | None  #: [m/s] of a contact that a shake drives; None of others, or without a closed form
    d_no_load_velocity: Dictionary  #: its derivatives
    error: Mapping[str, Dictionary]  #: of each derivative, in its unit: error["cof"]["v_0"]
    why: Mapping[str, Mapping[str, str]]  #: why there is no derivative: why["cof"]["v_0"]

    def elasticity(self, of: str = "cof") -> dict[str, float]:
        """Derivatives in per cent per per cent.

        Parameters
        ----------
        of : {"cof", "v_c", "static_cof", "band", "no_load_velocity"}
            The quantity.

        Returns
        -------
        dict of str to float
            By how many per cent the quantity grows for each per cent of the input [-]; what matters most comes first.
            Empty of a quantity that is zero.

        Raises
        ------
        ValueError
            For another quantity.
        """
        if of not in QUANTITIES:
            raise ValueError(f"of must be one of {', '.join(QUANTITIES)}, got {of!r}")
        value, slopes = getattr(self, of), getattr(self, f"d_{of}")
        found = {path: slope * self.inputs[path] / value for path, slope in slopes.items() if value}
        return dict(sorted(found.items(), key=lambda one: -abs(one[1])))

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw a bar for each input: by how many per cent a quantity grows for each per cent of it.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw the first of the quantities alone: friction, without a velocity v_c. None makes a new figure,
            with a panel for each quantity.

        Returns
        -------
        matplotlib.axes.Axes
            Where the first was drawn.
        """
        from mdr.plots.inputs import plot_sensitivity

        known = {LABELS[name]: found for name in QUANTITIES if (found := self.elasticity(name))}
        return plot_sensitivity(known, ax)

    def table(self) -> str:
        """A row for each input as CSV: its path and value, and of each quantity elasticity, derivative and its error.

        Returns
        -------
        str
            What `to_csv` writes. A cell is empty where there is no derivative.
        """
        known = [name for name in QUANTITIES if getattr(self, f"d_{name}")]
        columns: dict[str, Any] = {"input": [*self.inputs], "unit": [facts_at(path).unit for path in self.inputs]}
        columns["value"] = [*self.inputs.values()]
        for name in known:
            of = {"elasticity": self.elasticity(name), "d": getattr(self, f"d_{name}"), "error": self.error[name]}
            for what, values in of.items():
                columns[f"{what} {name}"] = [values.get(path, "") for path in self.inputs]
        return csv_text(columns)

    def _summary(self) -> Summary:
        known = {name: self.elasticity(name) for name in QUANTITIES}
        values = {name: number(of, UNITS[name]) for name in QUANTITIES if (of := getattr(self, name)) is not None}
        rows: list[Row] = [("", *_pair(values))]
        for path in dict.fromkeys(path for one in known.values() for path in one):
            slopes = {name: round(one[path], 4) + 0.0 for name, one in known.items() if path in one}
            rows.append((path, *_pair({name: f"{slope:+.4f}" for name, slope in slopes.items()})))
        reasons: dict[str, str] = {}
        for name in QUANTITIES:  # one for each input: the first; the others are alike
            reasons = {path: f"of {LABELS[name]}: {why}" for path, why in self.why[name].items()} | reasons
        where = "" if self.v_0 is None else f", at v_0 = {shown(self.v_0, 'm/s')}"
        title = f"Sensitivity: per cent for each per cent of an input{where}"
        return Summary(title, [*rows, *(("no slope", one, "") for one in dict.fromkeys(reasons.values()))])


def _pair(texts: Mapping[str, str]) -> tuple[str, str]:
    """What is said of the first quantity, and of the others."""
    first, *others = (f"{LABELS[name]} {text}" for name, text in texts.items())
    return first, ", ".join(others)


LABELS = {
    "cof": "COF",
    "v_c": "v_c",
    "static_cof": "static COF",
    "band": "band",
    "no_load_velocity": "no-load velocity",
}
UNITS = dict(zip(LABELS, ("-", "m/s", "-", "-", "m/s"), strict=True))
QUANTITIES = tuple(LABELS)


@offering
def sensitivity(
    case: SlidingContact,
    v_0: float | None = None,
    fields: Iterable[str] | None = None,
    *,
    held: Mapping[str, Any] | None = None,
    accuracy: float = BUDGET,
) -> Sensitivity:
    """Derivatives in SI of friction, critical velocity and what holds at rest with respect to each input of a case.

    Parameters
    ----------
    case : SlidingContact
        The contact.
    v_0 : float, optional
        Pulling velocity [m/s]. None leaves friction at a velocity out: closed forms alone, without a run.
    fields : iterable of str, optional
        Inputs: paths as in `find`, or "v_0". None: every number of the case that is not zero, `frequency` for one
        omega, what is `held` for the field that it sets, alpha of a series; and v_0.
    held : mapping of str to float, optional
        "load" [N], "frequency" [Hz] or "tan_delta" [-] that the case was made from, as in `tolerance`: they hold while
        other inputs vary, and are inputs themselves.
    accuracy : float
        Bound on the error of `cof` over mu_0 [-] of the run whose springs and steps are taken, as in `slide`.

    Returns
    -------
    Sensitivity
        The quantities, their derivatives with an error for each, and why an input has none.

    Raises
    ------
    ValueError
        For what is no number of the case, and where friction does not settle.
    TypeError
        For a case that is no SlidingContact.

    Notes
    -----
    A derivative is left out, and `why` says so, where the one from below is another than that from above, where one
    side cannot be, such as beyond nu = 0.5, where differences of two sizes disagree, and at v_0 = 0. It is given
    where its error is within 1e-3 of itself or of the quantity over the input. Beyond 5e-4, finer runs are asked.
    Band and no-load velocity are asked for under a rigid pull, which has them in closed form.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.4)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> found = mdr.sensitivity(case, 1e-4, fields=["mu_0", "du_z", "v_0"])
    >>> for path, value in found.elasticity("v_c").items():
    ...     print(path, f"{value:.6f}")
    mu_0 1.000000
    oscillation.du_z 1.000000
    >>> print(f"{found.d_cof['v_0']:.3f} s/m", found.error["cof"]["v_0"] < 1e-5)
    319.628 s/m True
    """
    case = as_given(case)
    at_rest(case)  # warns of what is unlikely
    kept = still_held(held or {}, ())
    case = case_of(case, kept)
    warn_of_load(kept, case)
    asked = _at_rest(case) | {"v_c": closed_form(case, critical_velocity)}
    if v_0 is not None:
        v_0, _ = counted(LAW.seen(resolved(case), "sensitivity"), finite("v_0", v_0))
        asked["cof"] = friction(case, v_0, accuracy_of(accuracy))
    of = Inputs(case, v_0, kept)
    paths = of.asked(fields)
    found: dict[str, dict[str, Slope]] = {name: {} for name in QUANTITIES}
    inputs = {path: of.value(path) for path in paths}
    for path in progress(paths, "sensitivity", "inputs"):
        at = cache(partial(of.at, path))
        for name, functions in asked.items():
            if path != OF_RUN or name == "cof":
                found[name][path] = slope(at, path, inputs[path], v_0 or 0.0, functions)
    slopes = {name: {path: one for path, one in found[name].items() if not one.why} for name in QUANTITIES}
    known: dict[str, Any] = {name: asked[name].main.value if name in asked else None for name in QUANTITIES}
    known |= {f"d_{name}": {path: one.value for path, one in of_it.items()} for name, of_it in slopes.items()}
    return Sensitivity(
        v_0=v_0,
        inputs=inputs,
        **known,
        error={name: {path: one.error for path, one in of_it.items()} for name, of_it in slopes.items()},
        why={name: {path: one.why for path, one in found[name].items() if one.why} for name in QUANTITIES},
    )


def _at_rest(case: SlidingContact) -> dict[str, Functions]:
    """What has a closed form of what a contact does that is not pulled, or pulled ever slower."""
    asked = {} if refusal_of(static_cof, case) else {"static_cof": closed_form(case, static_cof)}
    if case.is_shaken and case in CLOSED_FORM:
        if not holding_band(case).is_one_number:
            asked["band"] = closed_form(case, _width)
        if no_load_velocity(case):
            asked["no_load_velocity"] = closed_form(case, no_load_velocity, SAME)
    return asked


def _width(case: SlidingContact) -> float:
    """Of what a contact holds at rest [-]."""
    band = holding_band(case)
    return band.high - band.low
