"""What a contact measures itself by: stiffnesses, units of length and velocity, and what kind of contact it is."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.case.depth_cycle import peak, stick_limit
from mdr.case.in_motion import InMotion
from mdr.materials.operator import Rheology
from mdr.tools.arrays import Array


class Scales(InMotion):
    """What follows from the depth, the material and the law of friction of a contact."""

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
        """Unit of tangential length [m]: mu_0 kappa du_z + 2 tau_0 a(u_z_max)/G*, amplitude of the slip limit, plus the
        part of the shear strength. At a constant depth u_z0 stands for du_z.
        """
        return self.friction.mu_0 * self.material.mindlin_ratio * self.cycle.unit + self._strength(self.u_z_max)

    def _strength(self, depth: float) -> float:
        """2 tau_0 r_s/G* [m]: deflection of the spring in the middle that a shear strength holds; zero without one."""
        radius = float(self.friction.strong_radius(self._radius(depth)))
        return 2 * self.friction.tau_0 * radius / self.material.G_star

    def _radius(self, depth: float) -> float:
        """Contact radius [m] at a depth, or at zero if that is above the surface; zero where friction asks for none."""
        return float(self.indenter.contact_radius(max(depth, 0.0))) if self.friction.needs_area else 0.0

    @property
    def unit_velocity(self) -> float:
        """mu_0 kappa omega du_z [m/s], that of the stick limit of a pressed spring: Eq. (1), a unit of velocities. With
        a shear strength it is omega times `unit_length`.

        At a constant depth u_z0 stands for du_z; where depth and shake have two frequencies, omega is the common one.
        """
        if self.friction.needs_area:
            return self.unit_length * self.omega
        return stick_limit(self.friction.mu_0, self.cycle.unit, self.omega, self.material.mindlin_ratio)

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
        force = float(self.indenter.force(max(self.working_depth, 0.0), self.material.E_star))
        return float(self.friction.full(force, self._radius(self.working_depth)))

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
        return self.friction.mu_0 * self.material.mindlin_ratio * depth + self._strength(depth)

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
        return self._moves(*self._radii)

    @property
    def strength_moves(self) -> bool:
        """Whether there is a shear strength, and the area on which it acts changes over the period."""
        return self.friction.needs_area and self._moves(*self.friction.strong_radius(self._radii))

    @property
    def _radii(self) -> Array:
        """Least and greatest radius of contact [m]; of one that is lost, from zero on."""
        depth = self.cycle.u_z0 + self.cycle.unit * self.kept_gap
        return np.asarray(self.indenter.contact_radius(np.array([max(depth, 0.0), self.u_z_max])))

    def _moves(self, least: float, greatest: float) -> bool:
        return bool(least < greatest) or not self.keeps_contact

    @property
    def gap_tells_limit(self) -> bool:
        """Whether friction bears as much on all springs of one gap, at every instant: one may stand for them. A shear
        strength bears less the further out a spring stands.
        """
        return not self.friction.needs_area

    @property
    def always_sticks(self) -> bool:
        """Whether springs stick at any pull: those that the edge of a strength reaches, where there is no dashpot."""
        return self.strength_moves and self.T == 0


def _fastest(omega: float, way: NDArray[np.complex128]) -> float:
    return float(np.sum(omega * np.arange(1, way.size + 1) * np.abs(way)))


def _half_way(given: NDArray[np.complex128], reach: float) -> float:
    if not given.any():
        return 0.0
    return 0.5 * (peak(given) + peak(-given)) / reach if reach > 0 else np.inf
