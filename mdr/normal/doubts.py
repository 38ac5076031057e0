"""Plausibility of a contact: what is legal but unlikely, told in dimensionless numbers, so that it needs no units.

A record refuses what cannot be. What can be but hardly ever is meant (a cone of 57 degrees, an amplitude ten times the
mean depth, a contact a million times softer than the spring that pulls it) is computed, with a warning: most often a
unit is wrong. Each limit below is far from usual contacts and near what the theory of small slopes still carries.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import FrameType

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.motion import LoadOscillation
from mdr.indenters.base import Indenter
from mdr.indenters.mapping.quadrature import double_exponential
from mdr.normal.stability import floquet_multiplier
from mdr.tools.arrays import SAME
from mdr.tools.memoise import remembered
from mdr.tools.notation import GRAVITY
from mdr.tools.warned import is_ours, warn_outside

WRAPPERS = ("mdr.tools.memoise", "mdr.tools.keywords")  #: modules of decorators
GREATEST_ALPHA = 5.0  #: du_z/u_z0
GREATEST_MU_0 = 2.0  #: rubber on glass comes near it; more is a percentage, or a force
GREATEST_T = 5.0  #: omega tau of a Kelvin body; loss tangents of rubber are below 3
STIFFEST = 1e4  #: stiffness of the pulling spring over that of the contact, or over m omega², which it makes negligible
SOFTEST = 1e-6  #: its stiffness over that of the contact; metals, or a tip on its cantilever, are at 1e-4 to 1e-5
HEAVIEST = 10.0  #: weight of a mass that the load moves over the mean load; springs may carry some of it
SOFTENED = 0.03  #: change of stiffness with amplitude over the dynamic stiffness less m_z omega², of a small amplitude
UNSTABLE = 1.001  #: Floquet multiplier; without damping it is 1 of a stable depth


def warn_at_the_door(known: SlidingContact) -> None:
    """Warn of what is unlikely of a case of known depth, where code outside the package asked for it.

    Called by what a public function calls first; warned of is the line that called the public function. What the
    package asks itself, such as each point of a study, is not looked at.
    """
    public = _past_wrappers(sys._getframe(2))
    outside = _past_wrappers(public.f_back) if public is not None and is_ours(public) else public
    if outside is None or is_ours(outside):
        return
    for doubt in doubts_of(known):
        warn_outside(doubt)


def doubts_of(known: SlidingContact) -> tuple[str, ...]:
    """What is unlikely of a case of known depth, one sentence each: the number, its usual range, a likely reason."""
    return (*_of_shape(known), *_of_motion(known), *_of_load(known), *_of_material(known), *_of_pull(known))


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
    if is_given and known.working_depth > 0 and known.alpha > GREATEST_ALPHA:
        yield (
            f"the amplitude of the depth is {known.alpha:.3g} times the mean depth (du_z = {known.cycle.du_z:.4g} m, "
            f"u_z0 = {known.cycle.u_z0:.4g} m), so that the contact is open most of the time: are the two swapped?"
        )
    if known.mu_0 > GREATEST_MU_0:
        yield f"mu_0 = {known.mu_0:.4g} is more than {GREATEST_MU_0:g}: is it a percentage, or a force?"


def _of_load(known: SlidingContact) -> Iterator[str]:
    """Of a mass that an oscillating load moves."""
    load = known.oscillation.load
    if not isinstance(load, LoadOscillation) or load.m_z == 0:
        return
    m_z = load.m_z
    if load.dF_z > load.F_z0:
        yield (
            f"the amplitude of the load, dF_z = {load.dF_z:.4g} N, is above its mean, F_z0 = {load.F_z0:.4g} N: are "
            "the two swapped?"
        )
    if known.oscillation.knows_depth:
        grows = floquet_multiplier(known.indenter, known.material, load, known.oscillation.cycle)
        if grows > UNSTABLE:
            yield (
                f"the periodic depth that was found under the load is unstable: a deviation grows {grows:.3g} times in "
                "a period (its Floquet multiplier), so that m_z will move in another way, in another rhythm or in "
                "none; lower dF_z, move omega, or damp it"
            )
        elif not known.keeps_contact:
            yield (
                "the mass under the load leaves the surface in every period: the periodic motion that was found is "
                f"stable (Floquet multiplier {grows:.3g}), but a bouncing mass may move in several ways"
            )
    softened = _softened(known, load)
    if softened > SOFTENED:
        what = "would open the contact, or leave the shape"
        if softened < np.inf:
            what = f"changes the stiffness of the contact by {softened:.2g} of what m_z omega² leaves of it"
        yield (
            "dF_z is too great for critical_velocity(case), or omega too near the natural frequency of m_z on the "
            f"contact: the amplitude of depth that a small load would have {what}, and the closed form is off by "
            "about as much; full_slip_critical_velocity(case) takes the depth that the load brings about"
        )
    if m_z * GRAVITY > HEAVIEST * load.F_z0:
        yield (
            f"the weight of m_z, {m_z * GRAVITY:.4g} N, is {m_z * GRAVITY / load.F_z0:.3g} times the mean load: is it "
            "in grams, or is the load given without the weight?"
        )


def _softened(known: SlidingContact, load: LoadOscillation) -> float:
    """How much the stiffness of the contact differs at the amplitude of depth of a small load, over K_z - m_z omega².

    Its stiffness at an amplitude is the first harmonic of an elastic force over it, at the mean depth that carries the
    mean load (describing function). Infinite where that amplitude would open the contact, or is beyond the shape.
    """
    shape, E_star, d = known.indenter, known.material.E_star, known.working_depth
    k_z, K_z = known.k_zc, complex(known.dynamic_stiffness(load.omega))
    left = abs(K_z - load.m_z * load.omega**2)
    if load.dF_z >= d * left:
        return np.inf
    rule, mean, step = double_exponential(), d, np.inf
    swing = load.dF_z / left * np.cos(np.pi * rule.from_low)
    try:
        while step > SAME * mean:  # Newton's method, from above on: the mean force is convex in the mean depth
            u_z = np.maximum(mean + swing, 0)
            F_z = np.asarray(shape.force(u_z, E_star))
            step = float((rule.weight @ F_z - load.F_z0) / (rule.weight @ np.asarray(shape.stiffness(u_z, E_star))))
            mean -= step
    except ValueError:
        return np.inf
    weight = rule.weight * swing
    return float(abs(weight @ F_z / (weight @ swing) / k_z - 1) * abs(K_z) / left)


def _of_material(known: SlidingContact) -> Iterator[str]:
    T = max(frequencies(known)) * known.material.tau
    if T > GREATEST_T and not known.material.contact_arms:
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
    if ratio < SOFTEST:
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


def _past_wrappers(frame: FrameType | None) -> FrameType | None:
    """The frame, or the first before it that is no wrapper."""
    while frame is not None and frame.f_globals.get("__name__") in WRAPPERS:
        frame = frame.f_back
    return frame
