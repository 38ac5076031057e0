"""The contacts on which the claims are tested: four shapes on a soft rubber, shaken at 50 Hz.

All four touch over the same disc of 1 mm radius at a depth of 20 µm, so that their stiffness at the mean
depth is the same, k_zc = 8 N/mm for rubber of E = 3 MPa; only how it changes with the depth tells them apart.

Symbols: alpha = du_z/u_z0, T = omega tau, k_x, m, c_x spring, mass and damper of the pull, k_xc tangential
contact stiffness at u_z0, omega_0² = k_x/m.
"""

import math
from dataclasses import replace

import numpy as np

import mdr
from mdr.plots import COLOURS

DEPTH = 20e-6  #: mean depth u_z0 [m]
RADIUS = 1e-3  #: contact radius there [m]
OMEGA = 2 * math.pi * 50  #: angular frequency [rad/s]
E = 3e6  #: Young's modulus of the rubber [Pa]

SHAPES: dict[str, mdr.Indenter] = {
    "flat punch": mdr.FlatPunch(a=RADIUS),
    "cone": mdr.Cone(theta=math.atan(2 * DEPTH / (math.pi * RADIUS))),  # g = (pi/2) x tan(theta)
    "paraboloid": mdr.Paraboloid(R=RADIUS**2 / DEPTH),  # g = x²/R
    "r^4": mdr.PowerLaw(n=4, c=3 * DEPTH / (8 * RADIUS**4)),  # g = (8/3) c x⁴
}

SHARES = np.arange(50) / 40  # of the depth, at which the force is known
GRID = RADIUS * np.linspace(0, 1.2, 49)  # where the sampled shape is known
CATALOGUE: dict[str, mdr.Indenter] = {  # each touches over the disc of 1 mm at the depth of `depth_of`
    "sphere": mdr.Sphere(R=1.1 * RADIUS),
    "ellipsoid": mdr.Ellipsoid(R=0.5 * RADIUS, k=1 / (1.5 * RADIUS)),
    "hyperboloid": mdr.Hyperboloid(h=0.02 * RADIUS, c=0.2 * RADIUS),
    "truncated cone": mdr.TruncatedCone(b=0.5 * RADIUS, theta=0.05),
    "truncated paraboloid": mdr.TruncatedParaboloid(b=0.7 * RADIUS, R=50 * RADIUS),
    "rounded punch": mdr.RoundedPunch(b=0.6 * RADIUS, R=5 * RADIUS),
    "capped cone": mdr.CappedCone(b=0.5 * RADIUS, theta=0.05),
    "capped paraboloid": mdr.CappedParaboloid(R1=200 * RADIUS, R2=25 * RADIUS, b=0.6 * RADIUS),
    "constant pressure": mdr.ConstantPressure(a_0=RADIUS, d_0=DEPTH),
    "concave punch": mdr.ConcavePunch(a=RADIUS, R=RADIUS**2 / (0.7 * DEPTH)),
    "49 points of r^4": mdr.SampledProfile(GRID, 0.01 * RADIUS * (GRID / RADIUS) ** 4),
    "force ~ d^1.7": mdr.FromForce(DEPTH * SHARES, 2 * E * RADIUS * DEPTH / 1.7 * SHARES**1.7, E_star=E),  # a = F'/2E*
}

LOOKS = dict(zip(SHAPES, zip(COLOURS, "sv^o", strict=False), strict=False))  #: colour and marker
POWERS = dict(zip(SHAPES, (math.inf, 1.0, 2.0, 4.0), strict=True))  #: n of f ~ r^n, of which k_zc ~ d^(1/n)

BODY = {"k_ratio": 1.5, "omega_0_ratio": 1.7, "damping_ratio": 0.05}  #: groups of a body whose omega_0 is above omega
SWUNG: dict[str, float] = BODY | {"omega_0_ratio": 1.3}  #: omega_1 = 1.7 omega: 64 steps of a period resolve it
STIFFNESS, DAMPING = 1.5, 0.02  #: k_x/k_xc at u_z0 and damping ratio of `driven`


def depth_of(indenter: mdr.Indenter) -> float:
    """Depth at which a shape of the CATALOGUE touches over the disc of 1 mm."""
    if isinstance(indenter, mdr.ConcavePunch):
        return DEPTH
    return float(indenter.profile_1d(RADIUS))


def widest_cell(case: mdr.SlidingContact, springs: mdr.SpringArray) -> float:
    """Greatest dk dg/8 [N] of the springs that come and go, dg the rise of g over half of a cell: error of a force."""
    half, profile = springs.width / 4, case.indenter.profile_1d
    rise = np.asarray(profile(springs.x + half)) - np.asarray(profile(springs.x - half))
    return float(np.max((springs.dk_z * rise / 8)[np.arange(springs.x.size) >= springs.n_core]))


def shape_label(shape: str) -> str:
    """The name of a shape as matplotlib sets it."""
    return shape.replace("r^4", "$r^4$").replace("d^1.7", "$d^{1.7}$")


def loss(T: float) -> str:
    """The material in words."""
    return "elastic" if T == 0 else f"ωτ = {T:g}"


def loss_label(T: float) -> str:
    """The material as matplotlib sets it."""
    return loss(T).replace("ωτ", r"$\omega\tau$")


def contact(
    shape: str,
    alpha: float,
    T: float = 0.0,
    *,
    u_z0: float = DEPTH,
    mu_0: float = 0.5,
    nu: float = 0.5,
    **groups: float,
) -> mdr.SlidingContact:
    """One of the SHAPES on an elastic (T = 0) or Kelvin rubber, pulled rigidly, or through a spring of these groups.

    k_ratio: k_x/k_xc at u_z0. omega_0_ratio: omega_0/omega; 0 is a body without mass. damping_ratio:
    c_x/(2 sqrt(k_x m)). u_z0 [m]: mean depth.
    """
    material = mdr.KelvinVoigt(E=E, nu=nu, tau=T / OMEGA) if T else mdr.Elastic(E=E, nu=nu)
    return any_contact(SHAPES[shape], material, mdr.NormalOscillation(u_z0, alpha * u_z0, OMEGA), groups, u_z0, mu_0)


def any_contact(
    indenter: mdr.Indenter,
    material: mdr.Material,
    motion: mdr.Motion,
    groups=None,
    u_z0: float = DEPTH,
    mu_0: float = 0.5,
) -> mdr.SlidingContact:
    """Any indenter on any material in any motion, pulled rigidly or by a body of these groups at the depth u_z0."""
    pull = body(indenter, material, u_z0, **groups) if groups else mdr.RigidPull()
    return mdr.SlidingContact(indenter, material, mu_0, motion, pull)


def shaken(
    shape: str,
    alpha: float,
    chi: float = 0.0,
    phi: float = 0.0,
    T: float = 0.0,
    *,
    eta: float = 0.0,
    phi_y: float = 0.0,
    at: str = "tool",
    u_z0: float = DEPTH,
    **more: float,
) -> mdr.SlidingContact:
    """As `contact`, and shaken: alpha = 0 is a constant depth.

    chi, eta: amplitudes along and across the way over mu_0 kappa u_z0. phi, phi_y: their phases. at: "tool" or "pull".
    """
    case = contact(shape, alpha or 0.1, T, u_z0=u_z0, **more)
    oscillation = case.oscillation if alpha else mdr.ConstantDepth(u_z0)
    du_x, du_y = (share * case.mu_0 * case.material.mindlin_ratio * u_z0 for share in (chi, eta))
    return replace(case, oscillation=oscillation, shake=mdr.InPlaneOscillation(OMEGA, du_x, phi, du_y, phi_y, at))


def reach(case: mdr.SlidingContact, u_z0: float = DEPTH) -> float:
    """mu_0 kappa u_z0 [m]: how far the deepest spring can be deflected."""
    return case.mu_0 * case.material.mindlin_ratio * u_z0


def driven(shape: str, alpha: float, T: float, ratio: float, damping_ratio: float = DAMPING) -> mdr.SlidingContact:
    """A contact under a spring, a light damper and a mass of omega_0 = ratio * omega."""
    return contact(shape, alpha, T, k_ratio=STIFFNESS, omega_0_ratio=ratio, damping_ratio=damping_ratio)


def body(
    indenter: mdr.Indenter,
    material: mdr.Material,
    u_z0: float,
    k_ratio: float,
    omega_0_ratio: float = 0.0,
    damping_ratio: float = 0.0,
) -> mdr.SpringPull:
    """The pull of these groups on a contact at the depth u_z0 [m], by its long-time stiffness k_xc."""
    k_x = k_ratio * float(indenter.stiffness(u_z0, material.G_star))
    m = k_x / (omega_0_ratio * OMEGA) ** 2 if omega_0_ratio else 0.0
    if damping_ratio and not m:
        raise ValueError("damping_ratio refers to a mass; give omega_0_ratio > 0 too")
    return mdr.SpringPull(k_x=k_x, m=m, c_x=2 * damping_ratio * math.sqrt(k_x * m))
