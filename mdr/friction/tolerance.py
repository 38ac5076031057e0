"""tolerance(): what friction and critical velocity become as each input alone is a little smaller or larger."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from mdr.case.contact import SlidingContact, as_given
from mdr.case.paths import facts_at
from mdr.closed_forms.critical_velocity import critical_velocity
from mdr.friction.cof_curve import friction_at
from mdr.friction.free_parameters import allowed
from mdr.friction.inputs import OF_RUN, Inputs
from mdr.given.mean_load import warn_of_mean_loads
from mdr.given.vary import load_asked, still_held
from mdr.normal.normal_force import mean_normal_force
from mdr.normal.resolved import at_rest
from mdr.plots.figures import Axes
from mdr.tools.checks import between, finite
from mdr.tools.csv_table import Tabled, csv_text
from mdr.tools.keywords import offering
from mdr.tools.notation import shown
from mdr.tools.progress import progress
from mdr.tools.summary import Summarised, Summary

Pair = tuple[float, float]  #: at the smaller and at the larger value of an input


@dataclass(frozen=True)
class Tolerance(Summarised, Tabled):
    """Friction and critical velocity as each input alone varies; dictionaries by its path, what matters most first."""

    by: float  #: share by which each input is smaller and larger [-]
    v_0: float  #: pulling velocity [m/s]
    base_cof: float  #: coefficient of friction of the case itself [-]
    base_v_c: float  #: its critical velocity, Eq. (15) [m/s]
    inputs: dict[str, Pair]  #: values [SI] of each input: less and more by the share, as far as the case can have them
    cof: dict[str, Pair]  #: coefficient of friction at them [-]
    v_c: dict[str, Pair]  #: critical velocity at them [m/s]
    warnings: tuple[str, ...]  #: runs that did not settle

    def _summary(self) -> Summary:
        rows = [("COF", f"{self.base_cof:.4g}", f"v_c {shown(self.base_v_c, 'm/s', 4)}")]
        for path, (less, more) in self.cof.items():
            v_c = " ... ".join(shown(one, "m/s", 4) for one in self.v_c[path])
            rows.append((path, f"{less:.4g} ... {more:.4g}", f"v_c {v_c}"))
        title = f"Tolerance: each input {100 * self.by:.3g} % less and more, at v_0 = {shown(self.v_0, 'm/s')}"
        return Summary(title, [*rows, *(("warning", one, "") for one in self.warnings)])

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw a tornado chart: a bar for each input, from friction at its smaller to that at its larger value.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw friction alone. None makes a new figure, with a second panel for the critical velocity.

        Returns
        -------
        matplotlib.axes.Axes
            Where friction was drawn.
        """
        from mdr.plots.inputs import plot_tolerance

        return plot_tolerance(self, ax)

    def table(self) -> str:
        """A row for each input as CSV: its path and values, friction and critical velocity at them.

        Returns
        -------
        str
            What `to_csv` writes.
        """
        columns: dict[str, Any] = {"input": self.cof, "unit": [facts_at(path).unit for path in self.cof]}
        for name, pairs in (("input", self.inputs), ("cof [-]", self.cof), ("v_c [m/s]", self.v_c)):
            for end, way in enumerate(("minus", "plus")):
                columns[f"{way}: {name}"] = [pairs[path][end] for path in self.cof]
        return csv_text(columns)


@offering
def tolerance(
    case: SlidingContact,
    v_0: float,
    by: float = 0.1,
    fields: Iterable[str] | None = None,
    *,
    held: Mapping[str, Any] | None = None,
) -> Tolerance:
    """Friction [-] and critical velocity [m/s] of a contact as each of its inputs alone is smaller and larger.

    Parameters
    ----------
    case : SlidingContact
        The contact.
    v_0 : float
        Pulling velocity [m/s].
    by : float
        Share [-], between 0 and 1, by which each input is made smaller, and larger.
    fields : iterable of str, optional
        Inputs: paths as in `find`, or "v_0". None: every number of the case that is not zero, `frequency` for one
        omega, what is `held` for the field that it sets, alpha of a series; and v_0.
    held : mapping of str to float, optional
        What the case was made from: "load" [N] for its depth u_z0, "tan_delta" [-] for its tau. They hold while other
        inputs vary, and vary themselves. Beside a load "hold" says what stays: "depth", at which it rests, or "load",
        its mean. Without it a warning says where the mean differs. `mdr tolerance` takes them from the case file.

    Returns
    -------
    Tolerance
        Friction and critical velocity at both values of each input; the input that moves friction most comes first.

    Raises
    ------
    ValueError
        For what is no number of the case, and for a share that is not between 0 and 1.
    TypeError
        For a case that is no SlidingContact.

    Notes
    -----
    A value that the case cannot have, such as nu = 0.55, is moved to the nearest that it can: `inputs` has them.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> found = mdr.tolerance(case, 1e-4, by=0.1)
    >>> least, most = found.cof["oscillation.du_z"]
    >>> print(f"{found.base_cof:.3f}: {least:.3f} ... {most:.3f}")
    0.365: 0.371 ... 0.358
    """
    case = as_given(case)
    at_rest(case)  # warns of what is unlikely
    by, v_0 = between("by", by, 0.0, 1.0, "0.1, or 10%"), finite("v_0", v_0)
    of = Inputs(case, v_0, still_held(held or {}, ()))
    paths = of.asked(fields)
    warnings: list[str] = []
    loads: list[Pair] = []

    def at(path: str, value: float) -> Pair:
        """Friction and critical velocity with another value at a path."""
        one, pull = of.at(path, value), value if path == OF_RUN else v_0
        if (asked := load_asked({**of.others(path), path: value}, one)) is not None:
            loads.append((asked, mean_normal_force(one)))
        cof, _, why = friction_at(one, pull)
        if why:
            warnings.append(f"{path} = {shown(value, facts_at(path).unit)}: the run did not settle")
        return cof, critical_velocity(one)

    base_cof, base_v_c = at(OF_RUN, v_0)
    inputs = {path: _ends(of, path, by) for path in paths}
    points = {path: [at(path, end) for end in inputs[path]] for path in progress(paths, "tolerance", "inputs")}
    warn_of_mean_loads(loads, "at {n} of {of} points ")
    spread = {path: abs(less[0] - more[0]) for path, (less, more) in points.items()}
    order = sorted(paths, key=spread.__getitem__, reverse=True)
    cof, v_c = ({path: (points[path][0][i], points[path][1][i]) for path in order} for i in (0, 1))
    values = {path: inputs[path] for path in order}
    return Tolerance(by, v_0, base_cof, base_v_c, values, cof, v_c, tuple(warnings))


def _ends(of: Inputs, path: str, by: float) -> Pair:
    """The smaller and the larger value of an input, as far as the case can have them."""
    start = of.value(path)
    less, more = start * (1 - by), start * (1 + by)
    if path == OF_RUN:
        return less, more
    less, more = (allowed(of.case, path, start, end, of.others(path)) for end in (less, more))
    return less, more
