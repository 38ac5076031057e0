"""The sliding contact: indenter, material, friction, motion and pull in one frozen record.

A script, a TOML file and a study describe the same thing, and all of them end here. Stiffnesses belong to
the mean depth u_z0 (under an oscillating load, to the depth at which the mean load rests): k_zc = 2 E* a(u_z0),
k_xc = 2 G* a(u_z0), and gamma = tau k in both directions, Eq. (11). E* and G* are long-time moduli; what Maxwell arms
add is in the dynamic stiffness K_z(omega) = k_zc E*(omega)/E*.

Every property is computed from the fields. Under a LoadOscillation the depth is none of them, and what depends on it is
asked of `mdr.resolved(case)`.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields, is_dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.case.depth_cycle import Cycle, peak, stick_limit
from mdr.case.in_plane import Shake, sign_of, whole_ratio
from mdr.case.motion import Motion
from mdr.case.pull import Pull, RigidPull
from mdr.indenters.base import Indenter
from mdr.materials.base import Material, answers, refuse_other_materials
from mdr.materials.operator import Rheology
from mdr.tools.checks import instance, not_negative, positive
from mdr.tools.fields import Record, check_fields, facts, facts_of
from mdr.tools.messages import short
from mdr.tools.summary import Row, Summarised, Summary, number

#: abstract base class of each part
KINDS: dict[str, type[Any]] = {
    "indenter": Indenter,
    "material": Material,
    "oscillation": Motion,
    "pull": Pull,
    "shake": Shake,
}
OPTIONAL = ("shake",)  #: parts that may be None
OF_FACE = ("mu_0", "tau_0")  #: numbers of the contact as a whole


@dataclass(frozen=True)
class SlidingContact(Record, Summarised):
    """An indenter that slides on a half-space while it is shaken, in the normal direction or in the plane.

    Examples
    --------
    >>> import mdr
    >>> case = mdr.SlidingContact(
    ...     indenter=mdr.Paraboloid(R=5e-3),
    ...     material=mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3),
    ...     mu_0=0.5,
    ...     oscillation=mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=314.0),
    ...     pull=mdr.SpringPull(k_x=2e4, m=0.1, c_x=4.0),
    ... )
    >>> print(f"k_zc = {case.k_zc:.0f} N/m, alpha = {case.alpha:.2g}")
    k_zc = 2530 N/m, alpha = 0.1
    """

    indenter: Indenter = field(metadata=facts("", "shape", rule=None))
    material: Material = field(metadata=facts("", "half-space", rule=None))
    mu_0: float = field(
        metadata=facts(
            "-",
            "local coefficient of friction",
            not_negative,
            label=r"local friction $\mu_0$",
            note="coefficient of friction",
        )
    )
    oscillation: Motion = field(metadata=facts("", "normal motion", rule=None))
    pull: Pull = field(default_factory=RigidPull, metadata=facts("", "what pulls in the plane", rule=None))
    shake: Shake | None = field(default=None, metadata=facts("", "shake in the plane, besides the pull", rule=None))
    tau_0: float = field(
        default=0.0,
        metadata=facts("Pa", "shear strength of the face, beside mu_0", not_negative, label=r"shear strength $\tau_0$"),
    )

    def __post_init__(self) -> None:
        for name, kind in KINDS.items():
            if name not in OPTIONAL or getattr(self, name) is not None:
                instance(name, getattr(self, name), kind)
        self._refuse_what_springs_do_not_know()
        check_fields(self)
        if not self.tau_0:
            positive("mu_0", self.mu_0, "coefficient of friction; it may be 0 where tau_0 is above")
        elif not self.indenter.is_body:
            raise ValueError(
                f"tau_0 = {self.tau_0:.6g} Pa acts on an area of contact, which {type(self.indenter).__name__} does "
                "not know: set tau_0 = 0"
            )
        if self.material.E_star == 0:
            raise ValueError(
                "E_inf = 0: a mean load relaxes to nothing, or sinks in without end, so that there is no periodic "
                "state whose friction could be averaged; give the material a long-time modulus, or use indent()"
            )
        if not self.oscillation.omega and (self.shake is None or self.shake.is_still):
            raise ValueError(
                f"nothing oscillates: {self.oscillation!r} is constant, and shake = {self.shake!r}; friction is then "
                "what it is without vibration; give a shake with an amplitude, or an oscillation"
            )
        _ = self.repeats  # refuses frequencies in no ratio
        guided = np.isinf(self.pull.across[2]) and not self.pull.is_rigid
        if self.shake is not None and self.shake.at == "pull" and self.moves_across and guided:
            raise ValueError(
                "the pulling point is shaken across, and the body is guided there, so that nothing moves: give the "
                'pull a stiffness k_y, or shake at = "tool"'
            )
        object.__setattr__(self, "oscillation", self.oscillation.on(self.indenter, self.material))
        if self.oscillation.knows_depth:
            if not self.u_z_max > 0:
                motion = type(self.oscillation).__name__
                raise ValueError(
                    f"the indenter never touches: the greatest depth of {motion} is {self.u_z_max:.6g} m; raise its "
                    "mean depth or its amplitude"
                )
            self.indenter.contact_radius(self.u_z_max)  # a shape that does not reach so deep says so here
            if self.indenter.least_depth > 0:
                self._refuse_incomplete()

    def _summary(self) -> Summary:
        parts = [(name, getattr(self, name)) for name in KINDS]
        rows = [_told(name, part) for name, part in parts if part is not None]
        rows.insert(2, ("mu_0", number(self.mu_0), "local coefficient of friction"))
        if self.tau_0:
            rows.insert(3, ("tau_0", number(self.tau_0, "Pa"), "shear strength of the face, beside mu_0"))
        if not self.oscillation.knows_depth:
            return Summary("SlidingContact", [*rows, ("contact", "under a load", "mdr.resolved(case) finds its depth")])
        a = float(self.indenter.contact_radius(max(self.working_depth, 0.0)))
        stiff = f"k_zc = {number(self.k_zc, 'N/m')}, k_xc = {number(self.k_xc, 'N/m')}, at the mean depth"
        return Summary("SlidingContact", [*rows, ("contact", f"a = {number(a, 'm')}", stiff)])

    def _refuse_what_springs_do_not_know(self) -> None:
        """Parts of a user's own may answer what no march computes with."""
        answers("oscillation", self.oscillation, "omega", "its angular frequency [rad/s]")
        m, c_x, k_x = self.pull.coefficients
        if not (0 <= m < np.inf and 0 <= c_x < np.inf and k_x > 0) or (np.isinf(k_x) and (m > 0 or c_x > 0)):
            raise ValueError(
                f"pull = {self.pull!r} answers coefficients m = {m!r} kg, c_x = {c_x!r} N s/m, k_x = {k_x!r} N/m: mass "
                "and damping must be finite and not negative, stiffness above 0; infinite for a rigid pull, whose mass "
                "and damping are 0"
            )
        refuse_other_materials(self.material, self.omega)

    def _refuse_incomplete(self) -> None:
        """A hollow face must press everywhere at every instant."""
        cycle, needed = self.cycle, self.indenter.least_depth
        least = cycle.u_z0 + cycle.unit * self.kept_gap
        if least < needed:
            raise ValueError(
                f"u_z0 = {cycle.u_z0:.6g} m is too shallow for {type(self.indenter).__name__}: with this oscillation "
                f"and material its middle presses only from {needed + cycle.u_z0 - least:.6g} m on; short of that a "
                "ring would touch, which the method leaves out"
            )

    @property
    def repeats(self) -> tuple[int, int]:
        """Periods of the oscillation, and of the shake, in the period of the case; 0 of what does not move."""
        if self.shake is None or self.shake.is_still:
            return 1, 0
        return whole_ratio(self.oscillation.omega, self.shake.omega) if self.oscillation.omega else (0, 1)

    @property
    def omega(self) -> float:
        """Angular frequency [rad/s] of the period after which oscillation and shake both repeat."""
        if self.shake is None:
            return self.oscillation.omega
        n_z, n_x = self.repeats
        return self.oscillation.omega / n_z if n_z else self.shake.omega / n_x

    @property
    def period(self) -> float:
        """2 pi/omega [s]."""
        return 2 * np.pi / self.omega

    @property
    def is_shaken(self) -> bool:
        """Whether it moves in the plane besides the pull."""
        return self.shake is not None and not self.shake.is_still

    @property
    def cycle(self) -> Cycle:
        """The depth over one period."""
        return self.oscillation.cycle.repeated(max(self.repeats[0], 1), self.omega)

    @property
    def shake_harmonics(self) -> NDArray[np.complex128]:
        """X_n [m], shape (N,), of the shake x(t) = Re of sum X_n exp(i n omega t), n = 1 ... N; empty without one."""
        return self._harmonics(across=False)

    @property
    def harmonics_across(self) -> NDArray[np.complex128]:
        """Y_n [m], shape (N,), of the shake across the pull likewise; empty where nothing moves across."""
        return self._harmonics(across=True)

    def _harmonics(self, across: bool) -> NDArray[np.complex128]:
        if self.shake is None or self.shake.is_still or (across and not self.shake.across.any()):
            return np.zeros(0, dtype=complex)
        n_x, given = self.repeats[1], self.shake.across if across else self.shake.along
        out = np.zeros(n_x * given.size, dtype=complex)
        out[n_x - 1 :: n_x] = given
        return out

    @property
    def moves_across(self) -> bool:
        """Whether it is shaken across the pull, so that friction turns."""
        return self.harmonics_across.size > 0

    @property
    def is_alike_both_ways(self) -> bool:
        """Whether a pull the other way is its mirror image: nothing shakes along the pull."""
        return not self.shake_harmonics.any()

    @property
    def way(self) -> NDArray[np.complex128]:
        """X_n [m] of the way that the shake takes the indenter, without friction; infinite on an undamped resonance.

        Of a shaken pulling point it is what spring, damper and mass pass on: (k_x + i n omega c_x) H(n omega) X_n.
        """
        return self._passed_on(self.shake_harmonics, across=False)

    @property
    def way_across(self) -> NDArray[np.complex128]:
        """Y_n [m] likewise, across the pull, where k_y and c_y pass on."""
        return self._passed_on(self.harmonics_across, across=True)

    def _passed_on(self, given: NDArray[np.complex128], across: bool) -> NDArray[np.complex128]:
        if not given.size or not self.is_shaken_at_pull:
            return given
        _, c, k = self.pull.across if across else self.pull.coefficients
        n_omega = self.omega * np.arange(1, given.size + 1)
        H, out = np.asarray(self.pull.receptance(n_omega, across=across)), np.zeros_like(given)
        passed = (given != 0) & np.isfinite(H)
        out[passed] = (k + 1j * n_omega[passed] * c) * H[passed] * given[passed]
        out[(given != 0) & ~np.isfinite(H)] = np.inf
        return out

    def borne(self, k_xc: float, *, across: bool = False) -> NDArray[np.complex128]:
        """Harmonics of the force that the contact bears while it sticks, and the body with it.

        Parameters
        ----------
        k_xc : float
            Tangential stiffness of the contact [N/m] at long times.
        across : bool
            Across the pull.

        Returns
        -------
        ndarray
            F_n [N], shape (N,), of n = 1 ... N: K P_n/(K + Z), with K the dynamic stiffness of the contact, Z that of
            mass, spring and damper, and P_n what these pass on to a contact that does not yield. Infinite where an
            undamped body resonates on its contact.
        """
        given = self.harmonics_across if across else self.shake_harmonics
        _, c, k = self.pull.across if across else self.pull.coefficients
        n_omega = self.omega * np.arange(1, given.size + 1)
        K = k_xc * np.asarray(self.material.dynamic_modulus(n_omega)) / self.material.E_star
        if np.isinf(k):
            return np.asarray(K * given)
        Z = self.pull.dynamic_stiffness(n_omega, across=across)
        passed = (k + 1j * n_omega * c if self.is_shaken_at_pull else Z) * given
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(passed == 0, 0.0, np.where(K + Z == 0, np.inf, K * passed / (K + Z)))

    @property
    def is_shaken_at_pull(self) -> bool:
        """Whether the shake reaches the body through a spring."""
        return self.shake is not None and self.shake.at == "pull" and not self.pull.is_rigid

    @property
    def mirrored(self) -> SlidingContact:
        """The contact seen from the other side: what it does forward, this one does backward."""
        return self if self.shake is None else replace(self, shake=self.shake.mirrored)

    def pulled(self, direction: int) -> SlidingContact:
        """The contact whose pull forward is the pull of this one in a direction.

        Parameters
        ----------
        direction : int
            1 for the pull forward, -1 for the pull the other way.

        Returns
        -------
        SlidingContact
            This one, or its mirror image.

        Raises
        ------
        ValueError
            For any other direction.
        """
        return self if sign_of(direction) == 1 else self.mirrored

    @property
    def rheology(self) -> Rheology:
        """The operator of the material in units of the long-time modulus and of 1/omega, for periodic motions."""
        return Rheology.periodic(self.material, self.omega)

    @property
    def u_z_max(self) -> float:
        """Greatest depth [m]: u_z0 + du_z of a harmonic oscillation."""
        cycle = self.cycle
        return cycle.u_z0 + cycle.unit * cycle.greatest

    @property
    def working_depth(self) -> float:
        """Depth [m] that stiffnesses belong to: the mean depth u_z0, or that at which the mean load rests."""
        return self.oscillation.working_depth

    @property
    def contact_depth(self) -> float:
        """Depth [m] at which there is a contact: the working depth, or the greatest of tapping with u_z0 <= 0."""
        return self.working_depth if self.working_depth > 0 else self.u_z_max

    @property
    def k_zc(self) -> float:
        """Normal contact stiffness 2 E* a(u_z0) [N/m]; zero for tapping with u_z0 <= 0."""
        return float(self.indenter.stiffness(self.working_depth, self.material.E_star))

    @property
    def k_xc(self) -> float:
        """Tangential contact stiffness 2 G* a(u_z0) [N/m]."""
        return self.k_zc / self.material.mindlin_ratio

    @property
    def gamma_zc(self) -> float:
        """Normal contact damping tau k_zc [N s/m] of the long-time branch."""
        return self.material.tau * self.k_zc

    @property
    def gamma_xc(self) -> float:
        """Tangential contact damping tau k_xc [N s/m], Eq. (11)."""
        return self.material.tau * self.k_xc

    def dynamic_stiffness(self, omega: ArrayLike) -> NDArray[np.complex128]:
        """Complex normal stiffness of the contact K_z(omega) = 2 a(u_z0) E*(omega) [N/m].

        Parameters
        ----------
        omega : array_like of float
            Angular frequency [rad/s].

        Returns
        -------
        ndarray
            K_z [N/m] in the shape of omega.
        """
        return np.asarray(self.k_zc / self.material.E_star * np.asarray(self.material.dynamic_modulus(omega)))

    @property
    def alpha(self) -> float:
        """Relative amplitude du_z/u_z0 [-]; infinite at u_z0 = 0 and negative for tapping from above the surface."""
        cycle = self.cycle
        return cycle.du_z / cycle.u_z0 if cycle.u_z0 else np.inf

    @property
    def T(self) -> float:
        """omega tau [-] of the long-time branch, the loss tangent of a Kelvin material at the frequency omega, which is
        the common one where depth and shake have two.
        """
        return self.rheology.T

    @property
    def unit_length(self) -> float:
        """mu_0 kappa du_z + 2 tau_0 a(u_z_max)/G* [m]: change of the deflection at which pressed springs slip, and the
        part of it that a shear strength holds; a unit of tangential lengths. At a constant depth u_z0 stands for du_z.
        """
        return self.mu_0 * self.material.mindlin_ratio * self.cycle.unit + self._strength(self.u_z_max)

    def _strength(self, depth: float) -> float:
        """2 tau_0 a/G* [m]: deflection of the spring in the middle that a shear strength holds; zero without one.

        a is the contact radius at the depth, or at zero if that is above the surface.
        """
        a = float(self.indenter.contact_radius(max(depth, 0.0))) if self.tau_0 else 0.0
        return 2 * self.tau_0 * a / self.material.G_star

    @property
    def unit_velocity(self) -> float:
        """mu_0 kappa omega du_z [m/s], that of the stick limit of a pressed spring: Eq. (1), a unit of velocities. With
        a shear strength it is omega times `unit_length`.

        At a constant depth u_z0 stands for du_z; where depth and shake have two frequencies, omega is the common one.
        """
        if self.tau_0:
            return self.unit_length * self.omega
        return stick_limit(self.mu_0, self.cycle.unit, self.omega, self.material.mindlin_ratio)

    @property
    def chi(self) -> float:
        """Amplitude of the shake over that at which every spring slips at rest [-]; infinite for u_z0 <= 0.

        du_x/(mu_0 kappa u_z0), half the way of the tool over the deflection at which the middle spring slips. Of a
        shaken pulling point half the way of the force that the contact bears while it sticks, over full friction.
        """
        return self._over_slip(across=False)

    @property
    def eta(self) -> float:
        """The same across the pull [-]; du_y/(mu_0 kappa u_z0) of the tool."""
        return self._over_slip(across=True)

    def _over_slip(self, across: bool) -> float:
        depth = self.working_depth
        if not self.is_shaken_at_pull:
            return _half_way(self._harmonics(across), self.reach(depth))
        return _half_way(self.borne(self.k_xc, across=across), self.full_friction)

    @property
    def full_friction(self) -> float:
        """Friction [N] of a slide without vibration at the mean depth; zero for tapping with u_z0 <= 0."""
        depth = max(self.working_depth, 0.0)
        strength = self.tau_0 * np.pi * float(self.indenter.contact_radius(depth)) ** 2 if self.tau_0 else 0.0
        return self.mu_0 * float(self.indenter.force(depth, self.material.E_star)) + strength

    def reach(self, depth: float) -> float:
        """Deflection [m] at which the spring in the middle slips.

        Parameters
        ----------
        depth : float
            Depth u_z [m] of a contact at rest.

        Returns
        -------
        float
            mu_0 kappa u_z [m], and with a shear strength 2 tau_0 a/G* more.
        """
        return self.mu_0 * self.material.mindlin_ratio * depth + self._strength(depth)

    @property
    def fastest_across(self) -> float:
        """Sum of the velocities [m/s] of the harmonics across the pull: of one harmonic the greatest velocity."""
        return _fastest(self.omega, self.way_across)

    @property
    def pace(self) -> float:
        """Sum of the velocities [m/s] that oscillation and shake bring about: a scale, no less than any of them."""
        if not self.is_shaken:
            return self.unit_velocity
        fastest = _fastest(self.omega, self.way) + self.fastest_across
        n_C = np.arange(1, self.cycle.cos.size + 1) * np.abs(self.cycle.harmonics)
        return self.unit_velocity * float(np.sum(n_C)) + fastest

    @property
    def kept_gap(self) -> float:
        """Gap, in du_z from the mean depth, of the shallowest spring that never leaves; -sqrt(1 + T²) in Eq. (5)."""
        return self.cycle.kept_gap(self.rheology.response)

    @property
    def keeps_contact(self) -> bool:
        """Whether the centre of the contact is never lost: Eq. (5), u_z0 > du_z sqrt(1 + T²), for a Kelvin material."""
        cycle = self.cycle
        return cycle.u_z0 > -cycle.unit * self.kept_gap

    @property
    def edge_moves(self) -> bool:
        """Whether the radius of contact changes over the period, or contact is lost."""
        depth = self.cycle.u_z0 + self.cycle.unit * self.kept_gap
        least, greatest = self.indenter.contact_radius(np.array([max(depth, 0.0), self.u_z_max]))
        return bool(least < greatest) or not self.keeps_contact

    @property
    def gap_tells_limit(self) -> bool:
        """Whether friction bears as much on all springs of one gap, at every instant: one may stand for them. A shear
        strength bears less the further out a spring stands.
        """
        return not self.tau_0

    @property
    def always_sticks(self) -> bool:
        """Whether springs stick at any pull: those that the edge of contact reaches, of a face with a shear strength
        and no dashpot.
        """
        return self.tau_0 > 0 and self.T == 0 and self.edge_moves

    @property
    def is_of_the_paper(self) -> bool:
        """Whether depth is harmonic and material without arms: as in the paper, the normal force in closed form."""
        prescribed = self.oscillation.knows_depth and self.oscillation.load is None
        return prescribed and self.cycle.is_harmonic and not self.material.contact_arms


def _fastest(omega: float, way: NDArray[np.complex128]) -> float:
    return float(np.sum(omega * np.arange(1, way.size + 1) * np.abs(way)))


def _half_way(given: NDArray[np.complex128], reach: float) -> float:
    if not given.any():
        return 0.0
    return 0.5 * (peak(given) + peak(-given)) / reach if reach > 0 else np.inf


def _told(name: str, part: Any) -> Row:
    """A part of a case in a row: its kind, and its numbers with their units."""
    part = getattr(part, "load", None) or part  # of a depth that was solved for, what it was solved from
    if not is_dataclass(part):
        return name, type(part).__name__, short(repr(part))
    given = [(one, getattr(part, one.name)) for one in fields(part) if one.init]
    values = [_written(one.name, value, facts_of(one).unit) for one, value in given if value not in (None, ())]
    return name, type(part).__name__, ", ".join(values)


def _written(name: str, value: Any, unit: str) -> str:
    """A field and its value; a list by its length, an angular frequency in hertz too."""
    if callable(value):
        return f"{name} = {getattr(value, '__name__', type(value).__name__)}"
    if isinstance(value, tuple):
        return f"{name} of {len(value)}"
    if isinstance(value, bool) or not isinstance(value, int | float):
        return f"{name} = {short(repr(value), 40)}"
    hertz = f" ({value / (2 * np.pi):.6g} Hz)" if unit == "rad/s" else ""
    return f"{name} = {number(value, unit)}{hertz}"


def require_case(case: object) -> SlidingContact:
    """The case itself; TypeError for anything that is not a SlidingContact."""
    if not isinstance(case, SlidingContact):
        raise TypeError(f"case must be a SlidingContact, got {case!r}")
    return case


def as_given(case: object) -> SlidingContact:
    """The case with the motion that imposes its depth: of a resolved case, its load."""
    case = require_case(case)
    return case if case.oscillation.load is None else replace(case, oscillation=case.oscillation.load)
