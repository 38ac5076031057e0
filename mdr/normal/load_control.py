"""The depth that an oscillating load brings about: m_z u_z'' = F_z0 + dF_z cos(omega t) - F_N, periodic.

F_N follows from the history of depth by the contact law, viscoelastic and unilateral (followed_force.py); friction has
no part in it. Without mass an elastic contact is at each instant at the depth that carries the load, and this is solved
exactly. A very small amplitude is taken from the linear law below: of the difference of two solved depths too much is
rounding. Else the depth is sought as a Fourier series. What is missing of the balance of forces, harmonic by harmonic
divided by the dynamic stiffness of the contact at its mean depth less m_z (n omega)², is the correction, and Anderson's
method (1965) combines the last of them. Where contact is lost, F_N jumps as dashpots touch, between two instants; its
harmonics are then taken from the compression of all springs, which has no jumps, times the dynamic modulus: that holds
in flight too, where a spring relaxes without force.

A small amplitude arrives in one step: there

    du_z = dF_z/(K_z(omega) - m_z omega²),    K_z(omega) = 2 a E*(omega),

which is where the critical velocity of a load-controlled contact comes from. The mean depth is that of the long-time
modulus, however slow the material: the search is for the periodic state, not for the way to it. With mass and great
amplitude, or near its resonance on the contact, several periodic motions may exist, some unstable; found is one,
whose stability stability.py tells.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from mdr.case.depth_cycle import Cycle
from mdr.case.motion import LoadOscillation
from mdr.indenters.base import Indenter
from mdr.materials.base import Material
from mdr.materials.operator import Rheology
from mdr.normal.followed_force import N_STEPS, normal_cycle
from mdr.tools.arrays import EPS, SAME, Array
from mdr.tools.checks import instance, positive
from mdr.tools.memoise import remembered

N_HARMONICS = N_STEPS // 8  #: of the depth, an eighth of the instants at which the force is known
#: amplitude of a force over its mean, up to which its linear law misses less than a difference of forces does
LINEAR = float(np.sqrt(EPS))


def static_depth(indenter: Indenter, material: Material, F_z: float) -> float:
    """Depth [m] at which a constant load rests in the end.

    Parameters
    ----------
    indenter : Indenter
        The shape.
    material : Material
        The half-space; its long-time modulus counts.
    F_z : float
        Load [N].

    Returns
    -------
    float
        Depth [m]; `static_load` is its inverse.

    Raises
    ------
    TypeError
        For what is no shape or no material.
    ValueError
        If the load is not above zero, or more than the whole shape carries.

    Examples
    --------
    >>> import mdr
    >>> ball, rubber = mdr.Sphere(R=5e-3), mdr.Elastic(E=3e6, nu=0.5)
    >>> print(f"{mdr.static_depth(ball, rubber, 1.0):.3g} m")
    0.000192 m
    """
    instance("indenter", indenter, Indenter)
    instance("material", material, Material)
    return float(static_depths(indenter, material.E_star, np.array([positive("F_z", F_z, "load in N")]))[0])


def static_load(indenter: Indenter, material: Material, u_z0: float) -> float:
    """Load [N] that holds a contact at a constant depth in the end.

    Parameters
    ----------
    indenter : Indenter
        The shape.
    material : Material
        The half-space; its long-time modulus counts.
    u_z0 : float
        Depth [m].

    Returns
    -------
    float
        Load [N]; `static_depth` is its inverse.

    Raises
    ------
    TypeError
        For what is no shape or no material.
    ValueError
        If the depth is not above zero, or deeper than the shape reaches.

    Examples
    --------
    >>> import mdr
    >>> ball, rubber = mdr.Sphere(R=5e-3), mdr.Elastic(E=3e6, nu=0.5)
    >>> print(f"{mdr.static_load(ball, rubber, 192e-6):.2g} N")
    1 N
    """
    instance("indenter", indenter, Indenter)
    instance("material", material, Material)
    return float(indenter.force(positive("u_z0", u_z0, "depth in m"), material.E_star))


def static_depths(shape: Indenter, E_star: float, F_z: Array) -> Array:
    """Depths [m] at which loads (n,) > 0 rest on an elastic half-space.

    Newton's method from above, on a force whose slope 2E*a never falls with depth.
    """
    d = np.full(F_z.shape, _depth_beyond(shape, E_star, float(np.max(F_z))))
    left = np.inf
    for _ in range(200):
        step = (np.asarray(shape.force(d, E_star)) - F_z) / np.asarray(shape.stiffness(d, E_star))
        d = np.maximum(d - step, 1e-3 * d)
        last, left = left, float(np.max(np.abs(step) / d))
        if left <= 4e-16 or last <= left < np.sqrt(EPS):  # a shape may have a rounding of its own
            break
    return d


def _depth_beyond(shape: Indenter, E_star: float, F_z: float) -> float:
    """A depth [m] that carries the load [N] or more, of the same size as the one that carries it."""
    reach = float(shape.profile_1d(shape.max_radius)) if np.isfinite(shape.max_radius) else np.inf
    d = max(min(shape.depth_about(F_z / E_star), reach if reach > 0 else np.inf), shape.least_depth)
    while float(shape.force(d, E_star)) < F_z:
        d = _deeper(shape, d, F_z)
    return d


def _deeper(shape: Indenter, d: float, F_z: float) -> float:
    """A greater depth, of what the shape has."""
    for factor in (4.0, 1.5, 1.05, 1.001):
        try:
            shape.contact_radius(factor * d)
        except ValueError:
            continue
        return factor * d
    raise ValueError(
        f"F_z = {F_z:.6g} N is more than {shape!r} carries on this material: lower it, use a larger shape, or is a "
        "modulus in MPa?"
    )


@remembered(maxsize=64)
def depth_under_load(shape: Indenter, material: Material, motion: LoadOscillation) -> Cycle:
    """The cycle of depth under an oscillating load.

    Raises ValueError where no periodic depth is found: beside a resonance of the mass on the contact, or where it
    bounces in another rhythm.
    """
    elastic = motion.m_z == 0 and not Rheology.periodic(material, motion.omega).remembers
    if elastic and motion.dF_z > LINEAR * motion.F_z0:
        return _quasi_static(shape, material, motion)
    return _balanced(shape, material, motion)


def _quasi_static(shape: Indenter, material: Material, motion: LoadOscillation) -> Cycle:
    """Elastic, without mass: F(u_z) = F_z(t), as many harmonics as its smoothness asks for."""
    n = 64
    while True:
        load = motion.F_z0 + motion.dF_z * np.cos(2 * np.pi * np.arange(n) / n)
        half = static_depths(shape, material.E_star, load[: n // 2 + 1])  # even in time
        depth = np.concatenate([half, half[-2:0:-1]])
        spectrum = np.fft.rfft(depth).real / n
        tail = np.abs(spectrum[-n // 8 :]).max()
        if tail <= 1e-14 * abs(spectrum[0]) or n >= 4096:
            break
        n *= 2
    return _cycle_of(spectrum.astype(complex), motion.omega)


def _balanced(shape: Indenter, material: Material, motion: LoadOscillation) -> Cycle:
    rheology, E_star, omega = Rheology.periodic(material, motion.omega), material.E_star, motion.omega
    d_0 = static_depth(shape, material, motion.F_z0)
    k_zc = float(shape.stiffness(d_0, E_star))
    n = np.arange(N_HARMONICS + 1)
    impedance = k_zc * rheology.response(n) - motion.m_z * (n * omega) ** 2
    if np.abs(impedance[1]) < 1e-6 * k_zc:
        raise ValueError(
            "omega is the natural frequency of m_z on the contact, undamped: there the depth swings without bound; "
            "move omega or m_z, or give the material a damping"
        )
    weight = np.where(np.abs(impedance) < 0.1 * k_zc, 0.1 * k_zc * np.exp(1j * np.angle(impedance)), impedance)
    load = np.zeros(N_HARMONICS + 1, dtype=complex)
    load[:2] = motion.F_z0, motion.dF_z / 2
    start = np.zeros(N_HARMONICS + 1, dtype=complex)
    start[:2] = d_0, motion.dF_z / 2 / impedance[1]
    if motion.dF_z <= LINEAR * motion.F_z0:
        return _cycle_of(start, omega)

    def missing(u: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """Force balance that is missing, harmonics 0 ... N of exp(i n phase)."""
        cycle = _cycle_of(u, omega)
        if cycle.u_z0 + cycle.unit * cycle.greatest <= 0:
            return load
        known = normal_cycle(shape, rheology, cycle)
        if known.in_contact.all():
            F_n = np.fft.rfft(known.F_N)[: N_HARMONICS + 1]
        else:  # F_N jumps
            F_n = rheology.response(n) * np.fft.rfft(known.compression)[: N_HARMONICS + 1]
        F_n = E_star * F_n / known.F_N.size
        return np.asarray(load - F_n + motion.m_z * (n * omega) ** 2 * u)

    u, off = _anderson(missing, weight, start, motion.F_z0)
    # with this error of the balance of forces a search that gets no further may end
    if not off <= 1e-4:
        raise ValueError(
            "no depth of the period of the load was found: the mass m_z bounces in another rhythm, or is near its "
            "resonance on the contact; lower dF_z, move omega, or prescribe the depth with PeriodicMotion"
        )
    return replace(_cycle_of(u, omega), missing=off)


def _cycle_of(u: NDArray[np.complex128], omega: float) -> Cycle:
    used = np.flatnonzero(np.abs(u[1:]) > 1e-15 * np.abs(u[1:]).max()).max() + 1
    return Cycle.series(float(u[0].real), omega, 2 * u[1 : used + 1].real, -2 * u[1 : used + 1].imag)


def _anderson(
    missing: Callable[[NDArray[np.complex128]], NDArray[np.complex128]],
    weight: NDArray[np.complex128],
    u: NDArray[np.complex128],
    F_z0: float,
) -> tuple[NDArray[np.complex128], float]:
    """Where least is missing, by corrections missing/weight of which the last are combined; and how much, over F_z0.

    No time limit ends it (tools/iterate.py), as what it finds is kept for other calls.
    """
    tried: list[NDArray[np.complex128]] = []
    moves: list[NDArray[np.complex128]] = []
    best, least, known, since = u, np.inf, np.inf, 0
    while least > SAME and since <= 40:  # iterations without half the error
        rest = missing(u)
        off = float(np.abs(rest).max()) / F_z0
        if off < least:
            best, least = u, off
        since += 1
        if least < 0.5 * known:
            known, since = least, 0
        if off > 1e3 * least or not np.isfinite(off):
            tried, moves, u = [], [], best
            continue
        tried, moves = [*tried, u][-10:], [*moves, rest / weight][-10:]  # of so many iterations the next is made
        if len(moves) == 1:
            u = u + 0.5 * moves[-1]
            continue
        steps = np.diff(np.array(moves), axis=0)
        from mdr.tools.anderson import shares

        share = shares(_real(steps), _real(moves[-1]), 1e-8)
        u = tried[-1] + moves[-1] - share @ (np.diff(np.array(tried), axis=0) + steps)
    return best, least


def _real(u: NDArray[np.complex128]) -> Array:
    return np.concatenate([u.real, u.imag], axis=-1)
