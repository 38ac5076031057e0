"""Plausibility of a contact: what is legal but unlikely, most often because a unit is wrong.

A record refuses what cannot be. What can be but hardly ever is meant is computed, with a warning. First come sizes that
no contact has (a ball of 3 m, a depth below an atom, a modulus below that of a gel), each beside the field that the
user gave. Where these are usual, dimensionless numbers are looked at (a cone of 57 degrees, an amplitude ten times the
mean depth, shear waves shorter than the contact). Each limit is far from usual contacts.
Of a mass that a load moves, `mdr.normal.stability` says what is unlikely.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from mdr.case.contact import KINDS, SlidingContact
from mdr.indenters.base import Indenter
from mdr.materials.base import poisson_ratio_of
from mdr.tools.fields import facts_of
from mdr.tools.memoise import remembered
from mdr.tools.notation import GRAVITY

GREATEST_MU_0 = 2.0  #: rubber on glass comes near it; more is a percentage, or a force
STIFFEST = 1e4  #: stiffness of the pulling spring over that of the contact, or over m omega², which it makes negligible
ATOM = 1e-10  #: size of an atom [m]
LONGEST = 1.0  #: a length of a shape [m]; a wheel of a train comes near it
SOFTEST, STIFFEST_SOLID = 300.0, 2e12  #: moduli [Pa] of a weak gel, and above diamond
LEAST_DENSITY = 1000.0  #: of a solid [kg/m³] that is no foam; a greater one makes waves shorter
HARDEST = 0.15  #: hardness over E*, above that of diamond, ceramics, metals and glassy polymers
RUBBERY = 1e8  #: modulus [Pa] up to which a solid may bear more than its hardness, as rubber does
STRONGEST = 0.3  #: shear strength over the modulus, above that of any face
LEAST_MU_0 = 1e-3  #: a joint, and ice that melts, are above it
MOST_G = 1e6  #: acceleration over that of gravity; an ultrasonic horn reaches some 1e5
METALLIC = 1e10  #: modulus [Pa], from that of bone and wood on, of solids on which asperities do not flatten
ROUGHNESS, ASPERITY = 5e-7, 1e-5  #: of machined steel: height, and width of a contact that has many asperities [m]
ULTRASONIC = 2 * np.pi * 16e3  #: rad/s
LEAST_EFFECT = 5e-4  #: amplitude over mean depth, chi and omega tau that have next to no effect
HEAVIEST = 1e4  #: weight of the body over the mean load
MOST_DAMPED = 10.0  #: damping ratio c_x/(2 sqrt(k_x m)) of the body


def doubts_of(known: SlidingContact) -> tuple[str, ...]:
    """What is unlikely of a case of known depth, one sentence each: the number, its usual range, a likely reason."""
    return tuple(_of_sizes(known)) or (
        *(_of_shape(known) if known.indenter.is_body else ()), *_of_motion(known), *_of_material(known),
        *(_of_waves(known) if known.indenter.is_body else ()), *_of_pull(known),
        *(_of_roughness(known) if known.indenter.is_body else ()),
    )  # fmt: skip


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


def _of_sizes(known: SlidingContact) -> Iterator[str]:
    """Single numbers that no contact has, in the field that the user gave."""
    for name in KINDS:
        part = getattr(known, name)
        part = getattr(part, "load", None) or part  # a depth that was found for a load
        for key, unit, size in _sizes(part):
            if unit == "m" and name == "indenter" and part.is_body and LONGEST <= size < np.inf:
                yield f"{name}: {key} = {size:.4g} m is {LONGEST:g} m or more: is it in mm?"
            elif unit == "Pa" and name == "indenter" and not SOFTEST < size < STIFFEST_SOLID:
                yield f"{name}: {key} = {size:.4g} Pa is no modulus of a solid: is it in MPa or GPa?"
            elif unit == "m" and name != "indenter" and 0 < size < ATOM:
                yield f"{name}: {key} = {size:.4g} m is below the size of an atom, {ATOM:g} m: is it in another unit?"
            elif unit == "rad/s" and size >= 2000 and np.isclose(size, float(f"{size:.1e}"), rtol=1e-12):
                yield (
                    f"{name}: {key} = {size:.6g} rad/s is a round number, and {size / (2 * np.pi):.6g} Hz is none: was "
                    f"a frequency of {size:.6g} Hz meant, which is {key} = {2 * np.pi * size:.6g} rad/s?"
                )
    if known.oscillation.load is not None and known.contact_depth < ATOM:
        yield (
            f"the load presses the indenter {known.contact_depth:.3g} m deep, less than the size of an atom, {ATOM:g} "
            "m: is the load, the modulus or a radius in another unit?"
        )
    modulus = abs(complex(known.material.dynamic_modulus(max(frequencies(known)))))
    if not SOFTEST < modulus < STIFFEST_SOLID:
        side = (
            "softer than a gel: is a modulus in MPa or GPa" if modulus < 1e6 else "stiffer than diamond: is it in kPa"
        )
        yield f"material: its modulus at this frequency, {modulus:.4g} Pa, is {side}?"
    if known.mu_s > GREATEST_MU_0:
        name = "mu_0" if known.mu_0 > GREATEST_MU_0 else "mu_s"
        yield f"{name} = {getattr(known, name):.4g} is more than {GREATEST_MU_0:g}: is it a percentage, or a force?"
    if known.tau_0 > STRONGEST * modulus:
        yield (
            f"tau_0 = {known.tau_0:.4g} Pa is more than {STRONGEST:g} of the modulus, {modulus:.4g} Pa, which no face "
            "bears: is it in another unit?"
        )
    d = known.contact_depth
    force, a = known.indenter.force(d, known.material.E_star), known.indenter.contact_radius(d)
    cof = float(known.friction.full(force, a) / force)
    if cof < LEAST_MU_0:
        name = "with tau_0, the coefficient of friction" if known.friction.needs_area else "mu_0"
        yield f"{name} = {cof:.4g} is less than {LEAST_MU_0:g}, that of a joint: is it in another unit?"


def _sizes(part: Any) -> Iterator[tuple[str, str, float]]:
    """Name, unit and size of the numbers of a record; of a list, its greatest number."""
    for one in fields(part) if is_dataclass(part) else ():
        value = getattr(part, one.name)
        if isinstance(value, int | float) and not isinstance(value, bool):
            yield one.name, facts_of(one).unit, abs(value)
        elif isinstance(value, tuple) and value and isinstance(value[0], int | float):
            yield one.name, facts_of(one).unit, max(map(abs, value))


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
    pressure = float(known.indenter.force(d, 1.0)) / (np.pi * a**2)
    if pressure > HARDEST and known.material.E_star > RUBBERY and slope <= 1 and d <= a:
        yield (
            f"the mean pressure is {pressure:.3g} E*, {pressure * known.material.E_star:.3g} Pa, and no solid but "
            "rubber bears that: is the depth or the load too great, or a radius in the wrong unit?"
        )


def _of_motion(known: SlidingContact) -> Iterator[str]:
    is_given = known.oscillation.knows_depth and known.oscillation.load is None
    if is_given and known.working_depth > 0 and known.alpha > 5.0:
        yield (
            f"the amplitude of the depth is {known.alpha:.3g} times the mean depth (du_z = {known.cycle.du_z:.4g} m, "
            f"u_z0 = {known.cycle.u_z0:.4g} m), so that the indenter hammers, in the air most of the time; if this is "
            "not meant, du_z and u_z0 may be swapped"
        )
    if is_given and known.oscillation.omega and 0 < known.alpha < LEAST_EFFECT:
        yield (
            f"the amplitude of the depth is {known.alpha:.3g} of the mean depth (du_z = {known.cycle.du_z:.4g} m, "
            f"u_z0 = {known.cycle.u_z0:.4g} m), which has next to no effect: is one of them in another unit?"
        )
    if known.is_shaken and max(known.chi, known.eta) < LEAST_EFFECT:
        yield (
            f"the amplitude of the shake is {max(known.chi, known.eta):.3g} of that at which every spring slips at "
            "rest, which has next to no effect: is an amplitude, a depth or a load in another unit?"
        )
    for name, omega, harmonics in _moving(known):
        n = np.arange(1, harmonics.size + 1)
        g = float(np.sum(np.abs(harmonics) * (n * omega) ** 2)) / GRAVITY
        if g > MOST_G:
            yield (
                f"the acceleration of {name} is {g:.3g} g, and that of an ultrasonic horn some 1e5 g: is the frequency "
                "or an amplitude in the wrong unit?"
            )


def _moving(known: SlidingContact) -> Iterator[tuple[str, float, Any]]:
    """What moves: a name, its angular frequency [rad/s], its harmonics [m]."""
    if known.oscillation.omega and known.oscillation.knows_depth:
        yield "the depth", known.oscillation.omega, known.oscillation.cycle.unit * known.oscillation.cycle.harmonics
    if known.shake is not None and known.is_shaken:
        yield "the shake", known.shake.omega, known.shake.along
        yield "the shake across", known.shake.omega, known.shake.across


def _of_material(known: SlidingContact) -> Iterator[str]:
    T = max(frequencies(known)) * known.material.tau
    if T > 5.0 and not known.material.contact_arms:
        yield (
            f"omega tau = {T:.3g} is the loss tangent of this Kelvin body, and that of rubber is below 3: is tau "
            "in ms, or omega far beyond the measurement of tau? A material with arms (Prony) stays bounded there"
        )
    if 0 < T < LEAST_EFFECT and not known.material.contact_arms:
        yield (
            f"omega tau = {T:.3g} is the loss tangent of this Kelvin body, which has next to no effect: is tau or the "
            "frequency in another unit?"
        )


def wavelength(known: SlidingContact, density: float) -> float:
    """Length [m] of shear waves in the half-space at the highest frequency of the motion; density in kg/m³."""
    omega, material = max(frequencies(known)), known.material
    stiffening = abs(complex(material.dynamic_modulus(omega))) / material.E_star
    G = material.G_star * (2 - poisson_ratio_of(material.mindlin_ratio)) / 4 * stiffening
    return 2 * np.pi / omega * float(np.sqrt(G / density))


def _of_waves(known: SlidingContact) -> Iterator[str]:
    width, longest = 2 * edge(known.indenter, known.contact_depth)[0], wavelength(known, LEAST_DENSITY)
    if longest < width:
        yield (
            f"shear waves in the half-space are at most {longest:.3g} m long at this frequency, and the contact is "
            f"{width:.3g} m wide: springs leave waves out; is the frequency, the modulus or a length in another unit?"
        )


def _of_roughness(known: SlidingContact) -> Iterator[str]:
    """Asperities of hard faces, where the depth, or an ultrasonic amplitude at little depth, is below their height."""
    depth = known.contact_depth
    wide = edge(known.indenter, depth)[0] > ASPERITY
    if known.material.E_star < METALLIC or not wide or depth > 10 * ROUGHNESS:  # a tenth of the depth is not felt
        return
    lengths = {f"depth, {depth:.3g} m,": depth}
    given = [one for one in _moving(known) if one[0] != "the depth" or known.oscillation.load is None]
    for name, omega, harmonics in given:
        size = float(np.sum(np.abs(harmonics)))
        if omega >= ULTRASONIC and size > 0:
            lengths[f"amplitude of {name}, {size:.3g} m at {omega / (2 * np.pi):.4g} Hz,"] = size
    least = min(lengths, key=lengths.__getitem__)
    if lengths[least] < ROUGHNESS:
        yield (
            f"the {least} is below the roughness of machined steel, some {ROUGHNESS:g} m: asperities make such a "
            "contact softer than a smooth one; unless the faces are polished take a rough face, RoughFace, or "
            "FromForce of a measured force over depth"
        )


def _of_pull(known: SlidingContact) -> Iterator[str]:
    if known.pull.is_rigid:
        return
    m, c_x, k_x = known.pull.coefficients
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
    load = float(known.indenter.force(known.contact_depth, known.material.E_star))
    if m * GRAVITY > HEAVIEST * load:
        yield (
            f"the weight of the body, {m * GRAVITY:.4g} N, is {m * GRAVITY / load:.3g} times the normal load: is m in "
            "g, or a modulus or a depth in the wrong unit?"
        )
    if m > 0 and c_x > 2 * MOST_DAMPED * np.sqrt(k_x * m):
        yield (
            f"the damping ratio of the body is {c_x / (2 * np.sqrt(k_x * m)):.3g}, so that it creeps: is c_x, k_x or m "
            "in another unit?"
        )
