"""The sliding contact: indenter, material, friction, motion and pull in one frozen record.

A script, a TOML file and a study describe the same thing, and all of them end here. Stiffnesses belong to
the mean depth u_z0 (under an oscillating load, to the depth at which the mean load rests): k_zc = 2 E* a(u_z0),
k_xc = 2 G* a(u_z0), and gamma = tau k in both directions, Eq. (11). E* and G* are long-time moduli; what Maxwell arms
add is in the dynamic stiffness K_z(omega) = k_zc E*(omega)/E*.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.case.depth_cycle import Cycle
from mdr.case.motion import DepthMotion, LoadOscillation, Motion, NormalOscillation, PeriodicMotion
from mdr.case.pull import Pull, RigidPull, SpringPull
from mdr.indenters.base import Indenter
from mdr.materials import Elastic, ElasticPair, KelvinVoigt, Material, Prony, StandardLinearSolid
from mdr.materials.operator import Rheology
from mdr.tools.checks import positive
from mdr.tools.memoise import remembered

KINDS: dict[str, tuple[type, ...]] = {  #: of the parts; the rest of the chain knows these and no others
    "indenter": (Indenter,),
    "material": (Elastic, KelvinVoigt, ElasticPair, StandardLinearSolid, Prony),
    "oscillation": (NormalOscillation, PeriodicMotion, LoadOscillation),
    "pull": (RigidPull, SpringPull),
}


@dataclass(frozen=True)
class SlidingContact:
    """An indenter that slides on a half-space while it is shaken in the normal direction."""

    indenter: Indenter  #: shape
    material: Material  #: half-space
    mu_0: float  #: local (Amontons) coefficient of friction [-]
    oscillation: Motion  #: imposed normal motion
    pull: Pull = field(default_factory=RigidPull)  #: what pulls in the plane

    def __post_init__(self) -> None:
        for name, kinds in KINDS.items():
            value = getattr(self, name)
            if not isinstance(value, kinds):
                hint = f"; write {value.__name__}(...)" if isinstance(value, type) else ""
                names = " or ".join(kind.__name__ for kind in kinds)
                raise TypeError(f"{name} must be of kind {names}, got {value!r}{hint}")
        object.__setattr__(self, "mu_0", positive("mu_0", self.mu_0, "coefficient of friction"))
        if self.material.E_star == 0:
            raise ValueError(
                "E_inf = 0: a mean load relaxes to nothing, or sinks in without end, so that there is no periodic "
                "state whose friction could be averaged; give the material a long-time modulus, or use indent()"
            )
        if isinstance(self.oscillation, LoadOscillation):
            _rests_at(self.indenter, self.material, self.oscillation.F_z0)  # a shape that does not carry it says so
        else:
            self.indenter.contact_radius(self.u_z_max)  # a shape that does not reach so deep says so here
        if self.indenter.least_depth > 0:
            self._refuse_incomplete()

    def _refuse_incomplete(self) -> None:
        """A hollow face must press everywhere at every instant."""
        cycle, needed = self.cycle, self.indenter.least_depth
        least = cycle.u_z0 + cycle.du_z * self.kept_gap
        if least < needed:
            raise ValueError(
                f"u_z0 = {cycle.u_z0:.6g} m is too shallow for {type(self.indenter).__name__}: with this oscillation "
                f"and material its middle presses only from {needed + cycle.u_z0 - least:.6g} m on; short of that a "
                "ring would touch, which the method leaves out"
            )

    @property
    def cycle(self) -> Cycle:
        """The depth over one period; under an oscillating load it is solved for, once."""
        if isinstance(self.oscillation, DepthMotion):
            return _prescribed(self.oscillation)
        assert isinstance(self.oscillation, LoadOscillation)
        return _under_load(self.indenter, self.material, self.oscillation)

    @property
    def rheology(self) -> Rheology:
        """The operator of the material in units of the long-time modulus and of 1/omega."""
        return Rheology.of(self.material, self.oscillation.omega)

    @property
    def u_z_max(self) -> float:
        """Greatest depth [m]: u_z0 + du_z."""
        cycle = self.cycle
        return cycle.u_z0 + cycle.du_z * cycle.greatest

    @property
    def working_depth(self) -> float:
        """Depth [m] that stiffnesses belong to: the mean depth u_z0, or that at which the mean load rests."""
        if isinstance(self.oscillation, LoadOscillation):
            return _rests_at(self.indenter, self.material, self.oscillation.F_z0)
        return self.cycle.u_z0

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
        """omega tau [-] of the long-time branch, the loss tangent of a Kelvin material at the frequency omega."""
        return self.rheology.T

    @property
    def unit_velocity(self) -> float:
        """mu_0 kappa omega du_z [m/s], that of the stick limit of a pressed spring: Eq. (1), a unit of velocities."""
        return self.mu_0 * self.material.mindlin_ratio * self.oscillation.omega * self.cycle.du_z

    @property
    def kept_gap(self) -> float:
        """Gap, in du_z from the mean depth, of the shallowest spring that never leaves; -sqrt(1 + T²) in Eq. (5)."""
        return self.cycle.kept_gap(self.rheology.response)

    @property
    def keeps_contact(self) -> bool:
        """Whether the centre of the contact is never lost: Eq. (5), u_z0 > du_z sqrt(1 + T²), for a Kelvin material."""
        cycle = self.cycle
        return cycle.u_z0 > -cycle.du_z * self.kept_gap

    @property
    def is_of_the_paper(self) -> bool:
        """Whether depth is harmonic and material without arms: as in the paper, where more is in closed form."""
        harmonic = isinstance(self.oscillation, DepthMotion) and self.cycle.is_harmonic
        return harmonic and not self.material.contact_arms


@lru_cache(maxsize=256)
def _prescribed(oscillation: DepthMotion) -> Cycle:
    return oscillation.cycle


@remembered(maxsize=256)
def _rests_at(indenter: Indenter, material: Material, F_z0: float) -> float:
    from mdr.normal.load_control import static_depth

    return static_depth(indenter, material, F_z0)


@remembered(maxsize=64)
def _under_load(indenter: Indenter, material: Material, oscillation: LoadOscillation) -> Cycle:
    from mdr.normal.load_control import depth_under_load

    return depth_under_load(indenter, material, oscillation)


def require_case(case: object) -> SlidingContact:
    """The case itself; TypeError for anything that is not a SlidingContact."""
    if not isinstance(case, SlidingContact):
        raise TypeError(f"case must be a SlidingContact, got {case!r}")
    return case
