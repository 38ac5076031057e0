"""The sliding contact: indenter, material, friction, motion and pull in one frozen record.

A script, a TOML file and a study describe the same thing, and all of them end here. Stiffnesses belong to
the mean depth u_z0: k_zc = 2 E* a(u_z0), k_xc = 2 G* a(u_z0), and gamma = tau k in both directions, Eq. (11).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from mdr.checks import positive
from mdr.indenters.base import Indenter
from mdr.materials import Elastic, ElasticPair, KelvinVoigt, Material
from mdr.motion import NormalOscillation
from mdr.pull import Pull, RigidPull, SpringPull
from mdr.unilateral import kept_gap

_KINDS: dict[str, tuple[type, ...]] = {  # the rest of the chain knows these and no others
    "indenter": (Indenter,),
    "material": (Elastic, KelvinVoigt, ElasticPair),
    "oscillation": (NormalOscillation,),
    "pull": (RigidPull, SpringPull),
}


@dataclass(frozen=True)
class SlidingContact:
    """An indenter that slides on a half-space while it is shaken in the normal direction."""

    indenter: Indenter  #: shape
    material: Material  #: half-space
    mu_0: float  #: local (Amontons) coefficient of friction [-]
    oscillation: NormalOscillation  #: imposed normal motion
    pull: Pull = field(default_factory=RigidPull)  #: what pulls in the plane

    def __post_init__(self) -> None:
        for name, kinds in _KINDS.items():
            value = getattr(self, name)
            if not isinstance(value, kinds):
                hint = f"; write {value.__name__}(...)" if isinstance(value, type) else ""
                names = " or ".join(kind.__name__ for kind in kinds)
                raise TypeError(f"{name} must be of kind {names}, got {value!r}{hint}")
        object.__setattr__(self, "mu_0", positive("mu_0", self.mu_0, "coefficient of friction"))
        self.indenter.contact_radius(self.u_z_max)  # a shape that does not reach so deep says so here

    @property
    def u_z_max(self) -> float:
        """Greatest depth u_z0 + du_z [m]."""
        return self.oscillation.u_z0 + self.oscillation.du_z

    @property
    def k_zc(self) -> float:
        """Normal contact stiffness 2 E* a(u_z0) [N/m]; zero for tapping with u_z0 <= 0."""
        return float(self.indenter.stiffness(self.oscillation.u_z0, self.material.E_star))

    @property
    def k_xc(self) -> float:
        """Tangential contact stiffness 2 G* a(u_z0) [N/m]."""
        return self.k_zc / self.material.mindlin_ratio

    @property
    def gamma_zc(self) -> float:
        """Normal contact damping tau k_zc [N s/m]."""
        return self.material.tau * self.k_zc

    @property
    def gamma_xc(self) -> float:
        """Tangential contact damping tau k_xc [N s/m], Eq. (11)."""
        return self.material.tau * self.k_xc

    @property
    def alpha(self) -> float:
        """Relative amplitude du_z/u_z0 [-]; infinite at u_z0 = 0 and negative for tapping from above the surface."""
        u_z0 = self.oscillation.u_z0
        return self.oscillation.du_z / u_z0 if u_z0 else np.inf

    @property
    def T(self) -> float:
        """omega tau [-], the loss tangent at the frequency of the oscillation."""
        return self.oscillation.omega * self.material.tau

    @property
    def unit_velocity(self) -> float:
        """mu_0 kappa omega du_z [m/s], that of the stick limit of a pressed spring: Eq. (1), a unit of velocities."""
        return self.mu_0 * self.material.mindlin_ratio * self.oscillation.omega * self.oscillation.du_z

    @property
    def keeps_contact(self) -> bool:
        """Whether the centre of the contact is never lost, Eq. (5): u_z0 > du_z sqrt(1 + T²)."""
        return self.oscillation.u_z0 > -self.oscillation.du_z * kept_gap(self.T)


def require_case(case: object) -> SlidingContact:
    """The case itself; TypeError for anything that is not a SlidingContact."""
    if not isinstance(case, SlidingContact):
        raise TypeError(f"case must be a SlidingContact, got {case!r}")
    return case
