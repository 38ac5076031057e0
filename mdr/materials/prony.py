"""Bodies with memory: a spring, or a Kelvin element, in parallel with Maxwell arms.

    E(t) = E_inf + sum_j E_j exp(-t/tau_j),
    E(omega) = E_inf (1 + i omega tau) + sum_j E_j i omega tau_j/(1 + i omega tau_j)

One arm makes the standard linear solid (in Zener's form), none the Kelvin body. With E_inf = 0 every spring is a fluid
in the end: a mean load relaxes to nothing, or sinks in without end. Such a Maxwell body has no periodic state under a
mean load, so that no average friction belongs to it; `mdr.indent` takes it all the same.

Symbols: E_inf, E_j Young's moduli [Pa], tau_j relaxation times of the arms, tau Kelvin time of the E_inf branch [s],
nu Poisson's ratio [-], constant in time.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from os import PathLike, fsdecode
from typing import TYPE_CHECKING, Any, ClassVar

from numpy.typing import ArrayLike

from mdr.materials import prony_fit, step_fit
from mdr.materials.base import POISSON, Arms, OneBody, poisson_ratio
from mdr.tools.checks import not_negative, positive
from mdr.tools.csv_header import Columns, Reading, Units, fault
from mdr.tools.fields import facts


def _pairs(name: str, arms: Any, note: str = "") -> Arms:
    """Arms as a tuple of pairs, each named in what is wrong with it."""
    try:
        pairs = [tuple(arm) for arm in arms]
    except TypeError:
        raise TypeError(f"{name} must be a sequence of pairs (E_j, tau_j), got {arms!r}") from None
    for j, pair in enumerate(pairs):
        if len(pair) != 2:
            raise ValueError(f"{name}[{j}] must be a pair (E_j, tau_j), got {pair!r}")
    return tuple(
        (
            not_negative(f"{name}[{j}] modulus", E_j, "E_j in Pa"),
            positive(f"{name}[{j}] relaxation time", tau_j, "tau_j in s"),
        )
        for j, (E_j, tau_j) in enumerate(pairs)
    )


@dataclass(frozen=True)
class _WithArms(OneBody):
    """A body of long-time modulus E_inf and Maxwell arms."""

    E_inf: float = field(metadata=facts("Pa", "long-time Young's modulus", not_negative, example=3e6))
    if TYPE_CHECKING:

        @property
        def arms(self) -> Arms:
            """Arms (E_j [Pa], tau_j [s]): a field or a property of the subclass."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.E_inf == 0 and not any(E_j > 0 for E_j, _ in self.arms):
            what = "E_inf = 0 and no arm has a modulus: nothing carries a load; give E_inf or an arm above zero"
            raise ValueError(what)

    @property
    def E(self) -> float:  # type: ignore[override]
        """Long-time Young's modulus E_inf [Pa]."""
        return self.E_inf

    @property
    def contact_arms(self) -> Arms:
        """The arms as (E*_j [Pa], tau_j [s]), slowest first; arms of one time are one, those of zero modulus none."""
        times = sorted({tau_j for E_j, tau_j in self.arms if E_j > 0}, reverse=True)
        sums = [(sum(E_j for E_j, tau_j in self.arms if tau_j == time), time) for time in times]
        return tuple((E / (1 - self.nu**2), time) for E, time in sums)


@dataclass(frozen=True)
class StandardLinearSolid(_WithArms):
    """A spring E_inf in parallel with one Maxwell arm: glassy modulus E_inf + E_1, relaxing with tau_1.

    E_inf = 0 is a Maxwell body, for `mdr.indent` alone.
    """

    E_1: float = field(metadata=facts("Pa", "Young's modulus of the arm", not_negative, example=3e6))
    tau_1: float = field(metadata=facts("s", "relaxation time of the arm", example=1e-3))
    nu: float = field(metadata=POISSON)

    #: Kelvin time [s] of the E_inf branch
    tau: ClassVar[float] = 0.0

    @property
    def arms(self) -> Arms:
        """The arm as (E_1 [Pa], tau_1 [s])."""
        return ((self.E_1, self.tau_1),)


@dataclass(frozen=True)
class Prony(_WithArms):
    """A Kelvin element (E_inf, tau) in parallel with any number of Maxwell arms (E_j, tau_j).

    E_inf = 0 is a generalised Maxwell body, for `mdr.indent` alone.
    """

    arms: Arms = field(metadata=facts("Pa, s", "arms (E_j, tau_j)", _pairs, example=((2e6, 1e-2), (4e6, 1e-4))))
    nu: float = field(metadata=POISSON)
    tau: float = field(
        default=0.0, metadata=facts("s", "Kelvin time of the E_inf branch", not_negative, note="Kelvin time in s")
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.E_inf == 0 and self.tau > 0:
            what = "tau must be 0 where E_inf = 0: it is the time of that branch; name the dashpot as an arm"
            raise ValueError(what)

    @classmethod
    def from_shear(cls, *, G_inf: float, arms: Any, nu: float) -> Prony:
        """The body of shear moduli: E = 2 (1 + nu) G.

        Parameters
        ----------
        G_inf : float
            Long-time shear modulus [Pa].
        arms : sequence of pairs of float
            Arms (G_j [Pa], tau_j [s]).
        nu : float
            Poisson's ratio [-].

        Returns
        -------
        Prony
            The body.

        Examples
        --------
        >>> import mdr
        >>> mdr.Prony.from_shear(G_inf=1e6, arms=[(2e6, 0.01)], nu=0.5)
        Prony(E_inf=3000000.0, arms=((6000000.0, 0.01),), nu=0.5, tau=0.0)
        """
        stretch = 2 * (1 + poisson_ratio("nu", nu))
        G_inf = not_negative("G_inf", G_inf, "long-time shear modulus in Pa")
        return cls(stretch * G_inf, tuple((stretch * G_j, tau_j) for G_j, tau_j in _pairs("arms", arms)), nu)

    @classmethod
    def fit(
        cls, omega: ArrayLike, storage: ArrayLike, loss: ArrayLike, *, nu: float, n_arms: int | None = None
    ) -> Prony:
        """The body whose Young's modulus E(omega) [Pa] comes closest to measured storage and loss moduli.

        Parameters
        ----------
        omega : array_like of float, shape (n,)
            Angular frequencies [rad/s].
        storage : array_like of float, shape (n,)
            Storage modulus E' [Pa].
        loss : array_like of float, shape (n,)
            Loss modulus E'' [Pa].
        nu : float
            Poisson's ratio [-].
        n_arms : int, optional
            Relaxation times, spread evenly in log time over the measured range; those of no use are dropped. None:
            those that come closest, as many as the data tell.

        Returns
        -------
        Prony
            The body. `misfit` says how close it is. It says nothing about frequencies outside the measured range.

        Raises
        ------
        ValueError
            For data that are negative, infinite or NaN.

        Warns
        -----
        PlausibilityWarning
            Where the body misses the moduli by more than 10 %: noise of a dynamic test is below, several temperatures
            or a wrong unit are above. And where `n_arms` arms miss them by more than 1 % on average, and more of them
            would not.

        Notes
        -----
        Non-negative least squares of the relative deviation (Lawson and Hanson 1974), of times that are free: exact
        moduli of 2 to 200 arms over 3 to 7 decades are met to 1e-3 or better, most to 1e-5.

        Examples
        --------
        >>> import mdr
        >>> body = mdr.Prony.fit([1, 10, 100], storage=[1e6, 1.5e6, 2e6], loss=[2e5, 3e5, 2e5], nu=0.5)
        >>> [round(tau_j, 2) for _, tau_j in body.arms]
        [0.37, 0.03]
        """
        data = prony_fit.data_of(omega, storage, loss)
        found = prony_fit.to_data(*data, n_arms)
        prony_fit.warn_of_misfit(found, *data, n_arms)
        return cls(found.constant, found.arms, nu)

    @classmethod
    def fit_relaxation(cls, t: ArrayLike, modulus: ArrayLike, *, nu: float, n_arms: int | None = None) -> Prony:
        """The body whose modulus E(t) [Pa] after a step of strain comes closest to a measured one.

        Parameters
        ----------
        t : array_like of float, shape (n,)
            Times since the step [s], best from its end on.
        modulus : array_like of float, shape (n,)
            Stress over strain, E(t) [Pa].
        nu : float
            Poisson's ratio [-].
        n_arms : int, optional
            Relaxation times, as in `fit`.

        Returns
        -------
        Prony
            The body. It says nothing about times outside the measured range t_1 to t_n, and about frequencies outside
            10/t_n to 0.1/t_1, in rad/s. Between, E(omega) is known to three times the noise and 1 %.

        Raises
        ------
        ValueError
            For data that are not positive, or infinite.

        Warns
        -----
        PlausibilityWarning
            Where the body misses the modulus by more than 10 %, where `n_arms` arms do by more than 1 % on average and
            more of them would not, and where E(omega) lacks more than 1 % by what happened before the first time.

        Examples
        --------
        >>> import mdr, numpy as np
        >>> t = np.geomspace(0.01, 100, 30)
        >>> body = mdr.Prony.fit_relaxation(t, 1e6 + 2e6 * np.exp(-t), nu=0.5)
        >>> print(f"{body.E_inf:.3g} Pa")
        1e+06 Pa
        """
        return cls(*step_fit.to_relaxation(t, modulus, n_arms), nu=nu)

    @classmethod
    def fit_creep(cls, t: ArrayLike, compliance: ArrayLike, *, nu: float, n_arms: int | None = None) -> Prony:
        """The body whose tensile compliance D(t) [1/Pa] after a step of stress comes closest to a measured one.

        Parameters
        ----------
        t : array_like of float, shape (n,)
            Times since the step [s], best from its end on.
        compliance : array_like of float, shape (n,)
            Strain over stress, D(t) [1/Pa]; of a shear compliance J it is J/(2 (1 + nu)).
        nu : float
            Poisson's ratio [-].
        n_arms : int, optional
            Retardation times, as relaxation times in `fit`.

        Returns
        -------
        Prony
            The body. It says nothing about times outside the measured range t_1 to t_n, and about frequencies outside
            10/t_n to 0.1/t_1, in rad/s. Between, E(omega) is known to three times the noise and 1 %.

        Raises
        ------
        ValueError
            For data that are not positive, or infinite.

        Warns
        -----
        PlausibilityWarning
            Where the body misses the compliance by more than 10 %, and where `n_arms` arms do by more than 1 % on
            average and more of them would not.

        Examples
        --------
        >>> import mdr, numpy as np
        >>> t = np.geomspace(0.01, 100, 30)
        >>> body = mdr.Prony.fit_creep(t, 1e-6 * (1 - 0.5 * np.exp(-t)), nu=0.5)
        >>> print(f"{body.E_inf:.3g} Pa")
        1e+06 Pa
        """
        E_inf, arms, tau = step_fit.to_creep(t, compliance, n_arms)
        return cls(E_inf, arms, nu, tau)

    @classmethod
    def power_law(
        cls, *, modulus: float, exponent: float, omega: tuple[float, float], nu: float, error: float = 1e-3
    ) -> Prony:
        """A fractional material as a sum of arms: Young's modulus E(omega) = modulus (i omega tau_0)^exponent [Pa].

        Parameters
        ----------
        modulus : float
            Absolute value of E [Pa] at omega[0] = 1/tau_0.
        exponent : float
            Between 0 (elastic) and 1 (viscous) [-].
        omega : tuple of float
            Lowest and highest angular frequency [rad/s]. Beyond this range the body is stiffer, or less lossy, than a
            power law.
        nu : float
            Poisson's ratio [-].
        error : float
            Largest relative deviation of E(omega) in the range [-]. As many arms are taken as it needs.

        Returns
        -------
        Prony
            The body.

        Raises
        ------
        ValueError
            Where 60 arms do not reach the error.

        Examples
        --------
        >>> import mdr
        >>> body = mdr.Prony.power_law(modulus=1e6, exponent=0.2, omega=(1, 1e3), nu=0.5, error=0.01)
        >>> len(body.arms)
        6
        """
        return cls(*prony_fit.to_power_law(modulus, exponent, omega, error), nu=nu)

    @classmethod
    def read(
        cls,
        path: str | PathLike[str],
        *,
        nu: float | None = None,
        E_0: float | None = None,
        G_0: float | None = None,
        units: Units = None,
        columns: Columns = None,
        skip: int | None = None,
        table: int | str | None = None,
    ) -> Prony:
        r"""The body of a table of arms (E_j [Pa], tau_j [s]) in a file, .csv or .toml.

        Parameters
        ----------
        path : str or path-like
            CSV: columns E_j and tau_j under a header that names them and their units (without units, Pa and s); the row
            with tau_j = inf, or an empty one, is E_inf. G_j are shear moduli, g_j shares of the instantaneous modulus;
            in the place of tau_j a column beta_j has decay constants, 1/tau_j.
            TOML: a [material] table with E_inf, arms = [[E_j, tau_j], ...], nu and, if wanted, tau, as in a case file.
        nu : float, optional
            Poisson's ratio [-]. A CSV file needs it; it takes the place of the one in a TOML file.
        E_0 : float, optional
            Instantaneous Young's modulus [Pa] of relative moduli, g_j = E_j/E_0, as finite-element programs write
            them. What their sum lacks of 1 is that of E_inf.
        G_0 : float, optional
            The same in shear [Pa]: E_0 = 2 (1 + nu) G_0.
        units : dict of str, optional
            Units of columns of a CSV file whose header has none: {"E_j": "MPa"}.
        columns : dict of str or int, optional
            What the header calls a column, {"E_j": "modulus"}, or its number, from 1.
        skip : int, optional
            Lines above the header. None finds it.
        table : int or str, optional
            Which table of a file with several, from 1, or words above it.

        Returns
        -------
        Prony
            The body.

        Raises
        ------
        ValueError
            With the line or key that is wrong; for moduli between 0 and 1 whose sum is 1, without E_0 or G_0.

        Examples
        --------
        >>> from pathlib import Path
        >>> import mdr
        >>> _ = Path("arms.csv").write_text("g_i, tau_i\n0.3, 0.01\n0.2, 1\n")
        >>> mdr.Prony.read("arms.csv", nu=0.5, E_0=2e6)
        Prony(E_inf=1000000.0, arms=((600000.0, 0.01), (400000.0, 1.0)), nu=0.5, tau=0.0)
        """
        from mdr.files.arm_tables import from_table

        if nu is not None:
            nu = poisson_ratio("nu", nu)
        fields = from_table(cls, path, nu, E_0, G_0, Reading(units, columns, skip, table))
        try:
            return cls(**fields)
        except (TypeError, ValueError) as refusal:
            raise fault(fsdecode(path), str(refusal)) from None

    def misfit(self, omega: ArrayLike, storage: ArrayLike, loss: ArrayLike) -> float:
        """Greatest relative deviation [-] of E(omega) from measured moduli.

        Parameters
        ----------
        omega : array_like of float, shape (n,)
            Angular frequencies [rad/s].
        storage : array_like of float, shape (n,)
            Storage modulus E' [Pa].
        loss : array_like of float, shape (n,)
            Loss modulus E'' [Pa].

        Returns
        -------
        float
            ``max |E(omega) - E' - i E''| / |E' + i E''|`` [-].
        """
        return float(prony_fit.misfits(self, *prony_fit.data_of(omega, storage, loss)).max())
