"""Plausibility of a contact: what is legal but unlikely, told in dimensionless numbers, so that it needs no units.

A record refuses what cannot be. What can be but hardly ever is meant (a cone of 57 degrees, an amplitude ten times the
mean depth, a contact a million times softer than the spring that pulls it) is computed, with a warning: most often a
unit is wrong. Each limit is far from usual contacts and near what the theory of small slopes still carries.
Of a mass that a load moves, `mdr.normal.stability` says what is unlikely.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.indenters.base import Indenter
from mdr.tools.memoise import remembered

GREATEST_MU_0 = 2.0  #: rubber on glass comes near it; more is a percentage, or a force
STIFFEST = 1e4  #: stiffness of the pulling spring over that of the contact, or over m omega², which it makes negligible


def doubts_of(known: SlidingContact) -> tuple[str, ...]:
    """What is unlikely of a case of known depth, one sentence each: the number, its usual range, a likely reason."""
    return (*_of_shape(known), *_of_motion(known), *_of_material(known), *_of_pull(known))


def frequencies(known: SlidingContact) -> list[float]:
    """Angular frequencies [rad/s] of the oscillation and of the shake, of those that move."""
    shaken = [known.shake.omega] if known.shake is not None and known.is_shaken else []
    return [one for one in [known.oscillation.omega, *shaken] if one > 0]


@remembered(maxsize=256)
def edge(indenter: Indenter, d: float) -> tuple[float, float]:
    """Radius a [m] of the contact at the depth d [m], and the slope |f'(a)| [-] of the shape there, from within."""
    a = float(indenter.contact_radius(d))
    h = 1e-4 * a
    f = np.asarray(indenter.profile_3d(a - h * np.arange(3)))
    return a, abs(float(1.5 * f[0] - 2 * f[1] + 0.5 * f[2])) / h  # second order, from one side


def _of_shape(known: SlidingContact) -> Iterator[str]:
    d = known.contact_depth
    a, slope = edge(known.indenter, d)
    if slope > 1:
        yield (
            f"the surface of {type(known.indenter).__name__} has slope {slope:.3g} at the edge of the contact "
            f"(radius {a:.4g} m at depth {d:.4g} m), and the theory is that of small slopes, well below 1: "
            "is an angle given in degrees, the depth too great, or the modulus too small?"
        )
    elif d > a:  # of a face without slope
        yield (
            f"the depth {d:.4g} m is {d / a:.3g} times the radius of the contact, {a:.4g} m, and the theory is that of "
            "small strains, well below 1: is the depth too great, or the modulus too small for the load?"
        )


def _of_motion(known: SlidingContact) -> Iterator[str]:
    is_given = known.oscillation.knows_depth and known.oscillation.load is None
    if is_given and known.working_depth > 0 and known.alpha > 5.0:
        yield (
            f"the amplitude of the depth is {known.alpha:.3g} times the mean depth (du_z = {known.cycle.du_z:.4g} m, "
            f"u_z0 = {known.cycle.u_z0:.4g} m), so that the contact is open most of the time: are the two swapped?"
        )
    if known.mu_0 > GREATEST_MU_0:
        yield f"mu_0 = {known.mu_0:.4g} is more than {GREATEST_MU_0:g}: is it a percentage, or a force?"


def _of_material(known: SlidingContact) -> Iterator[str]:
    T = max(frequencies(known)) * known.material.tau
    if T > 5.0 and not known.material.contact_arms:
        yield (
            f"omega tau = {T:.3g} is the loss tangent of this Kelvin body, and that of rubber is below 3: is tau "
            "in ms, or omega far beyond the measurement of tau? A material with arms (Prony) stays bounded there"
        )


def _of_pull(known: SlidingContact) -> Iterator[str]:
    if known.pull.is_rigid:
        return
    m, _, k_x = known.pull.coefficients
    ratio = k_x / (known.k_xc or known.indenter.stiffness(known.contact_depth, known.material.G_star))
    if ratio > STIFFEST:
        yield (
            f"the spring of the pull is {ratio:.3g} times as stiff as the contact, which is as good as a rigid pull: "
            "is the modulus in MPa, or k_x in a wrong unit?"
        )
    if ratio < 1e-6:  # metals, or a tip on its cantilever, are at 1e-4 to 1e-5
        yield (
            f"the contact is {1 / ratio:.3g} times as stiff as the spring of the pull: is k_x in N/mm, or the modulus "
            "in a wrong unit?"
        )
    light = known.pull.omega_0 / max(frequencies(known))
    if m > 0 and light**2 > STIFFEST:
        yield (
            f"the natural frequency of the body is {light:.3g} times that of the vibration, so that its mass, "
            f"{m:.4g} kg, has no effect: is it in the right unit?"
        )
