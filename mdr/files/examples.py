"""Starting files: a commented case for each shape, material, motion, pull and shake that a file can carry.

Every example is a small body of rubber 20 µm deep, which touches over a disc of about 1 mm.
"""

from __future__ import annotations

from dataclasses import Field, fields
from typing import Any

import numpy as np

from mdr import indenters, materials
from mdr.case.contact import SlidingContact, as_given
from mdr.case.in_plane import InPlaneMotion, InPlaneOscillation, Shake
from mdr.case.motion import (
    UNNAMED,
    ConstantDepth,
    ConstantLoad,
    LoadOscillation,
    Motion,
    NormalOscillation,
    PeriodicMotion,
)
from mdr.case.pull import RigidPull, SpringPull
from mdr.files.toml_text import toml_value
from mdr.tools.fields import facts_of
from mdr.tools.messages import offer, short

DEPTH, RADIUS, E = 20e-6, 1e-3, 3e6  # m, m, Pa
OMEGA = round(2 * np.pi * 50, 3)  # rad/s
WIDEST = 44  # characters of a line before its comment


def _points() -> tuple[tuple[float, ...], tuple[float, ...]]:
    r = [round(2e-4 * i, 7) for i in range(8)]
    return tuple(r), tuple(round(10 * x**2, 9) for x in r)


def _force() -> tuple[tuple[float, ...], tuple[float, ...]]:
    d = [round(4e-6 * i, 9) for i in range(9)]
    return tuple(d), tuple(round(float(indenters.Paraboloid(R=0.05).force(x, 4e6)), 6) for x in d)


SHAPES: dict[str, indenters.Indenter] = {
    type(one).__name__: one
    for one in (
        indenters.FlatPunch(a=RADIUS),
        indenters.Cone(theta=0.0127),
        indenters.Paraboloid(R=0.05),
        indenters.PowerLaw(n=4, c=7.5e6),
        indenters.Sphere(R=0.05),
        indenters.Ellipsoid(R=0.05, k=20.0),
        indenters.Hyperboloid(h=2e-5, c=1e-3),
        indenters.TruncatedCone(b=5e-4, theta=0.02),
        indenters.TruncatedParaboloid(b=5e-4, R=0.04),
        indenters.RoundedPunch(b=5e-4, R=0.02),
        indenters.CappedCone(b=5e-4, theta=0.015),
        indenters.CappedParaboloid(R1=0.1, R2=0.04, b=5e-4),
        indenters.ConstantPressure(a_0=2e-3, d_0=1e-4),
        indenters.ConcavePunch(a=RADIUS, R=0.2),
        indenters.SampledProfile(*_points()),
        indenters.FromForce(*_force(), E_star=4e6),
    )
}
MATERIALS: dict[str, materials.Material] = {
    type(one).__name__: one
    for one in (
        materials.Elastic(E=E, nu=0.5),
        materials.ElasticPair(E_1=E, nu_1=0.5, E_2=210e9, nu_2=0.3),
        materials.KelvinVoigt(E=E, nu=0.5, tau=1e-3),
        materials.StandardLinearSolid(E_inf=E, E_1=E, tau_1=1e-3, nu=0.5),
        materials.Prony(E_inf=E, arms=((2e6, 1e-2), (4e6, 1e-4)), nu=0.5),
    )
}
PULLS: dict[str, RigidPull | SpringPull] = {
    "SpringPull": SpringPull(k_x=2e4, m=0.1, c_x=4.0),
    "RigidPull": RigidPull(),
}
MOTIONS = ("NormalOscillation", "PeriodicMotion", "LoadOscillation", "ConstantDepth", "ConstantLoad")
SAWTOOTH = tuple(round(8e-6 / (np.pi * n), 7) for n in range(1, 4))  # m
SHAKES: dict[str, Shake] = {
    "InPlaneOscillation": InPlaneOscillation(omega=OMEGA, du_x=1e-5, phi_x=1.5707963),
    "InPlaneMotion": InPlaneMotion(omega=OMEGA, x_sin=SAWTOOTH),
}
STILL = "none"  #: the name of no shake


def example(
    shape: str = "Paraboloid",
    material: str = "KelvinVoigt",
    motion: str = "NormalOscillation",
    pull: str = "SpringPull",
    shake: str = STILL,
) -> SlidingContact:
    """The example of these records, named as in Python, in any case and with or without underscores.

    A constant depth or load is shaken in the plane, unless asked otherwise harmonically, as something has to move.
    Raises ValueError for a name that is none, with the nearest.
    """
    indenter, body = SHAPES[_named("shape", shape, SHAPES)], MATERIALS[_named("material", material, MATERIALS)]
    moved = _motion(_named("motion", motion, MOTIONS), indenter, body)
    shaken = SHAKES.get(_named("shake", shake, (*SHAKES, STILL)))
    if shaken is None and not moved.omega:
        shaken = SHAKES["InPlaneOscillation"]
    return SlidingContact(indenter, body, 0.5, moved, PULLS[_named("pull", pull, PULLS)], shaken)


def example_file(case: SlidingContact) -> str:
    """The TOML text of a case, each key with its unit and meaning."""
    case = as_given(case)
    tables: list[tuple[str, str, str, Any]] = [
        ("indenter", "shape", "the shape that is pressed in; its fields follow", case.indenter),
        ("material", "model", "the half-space", case.material),
        ("oscillation", _choice(case.oscillation), _of_motion(case.oscillation), case.oscillation),
        ("pull", "", "what drags it; a rigid pull without this table", case.pull),
        ("shake", "", "motion in the plane besides the pull", case.shake),
    ]
    lines = [_line(one, case) for one in fields(case) if one.name == "mu_0"]
    for name, choice, meaning, record in tables:
        if isinstance(record, RigidPull):
            lines += ["", "# no [pull]: a rigid pull; give k_x [N/m], m [kg] and c_x [N s/m] for a body on a spring"]
            continue
        if record is None:
            continue
        lines += ["", f"{f'[{name}]':<{WIDEST}}# {meaning}"]
        if choice:
            lines.append(f'{choice} = "{type(record).__name__}"')
        lines += [_line(one, record) for one in fields(record) if one.init and getattr(record, one.name) is not None]
    return "\n".join(lines) + "\n"


def _motion(name: str, indenter: indenters.Indenter, material: materials.Material) -> Motion:
    if name == "NormalOscillation":
        return NormalOscillation(u_z0=DEPTH, du_z=2e-6, omega=OMEGA)
    if name == "PeriodicMotion":
        return PeriodicMotion(omega=OMEGA, u_z0=DEPTH, cos=(2e-6, 5e-7), sin=(0.0, 3e-7))
    if name == "ConstantDepth":
        return ConstantDepth(u_z0=DEPTH)
    load = float(f"{float(indenter.force(DEPTH, material.E_star)):.2g}")
    if name == "ConstantLoad":
        return ConstantLoad(F_z0=load)
    return LoadOscillation(F_z0=load, dF_z=float(f"{load / 10:.2g}"), omega=OMEGA)


def _choice(motion: Motion) -> str:
    """The key that names a motion, which those that a file need not name do without."""
    return "" if type(motion) in UNNAMED else "motion"


def _of_motion(motion: Motion) -> str:
    """What the motion is, in a line."""
    if isinstance(motion, LoadOscillation):
        return "load F_z0 + dF_z cos(omega t); the depth follows"
    if isinstance(motion, PeriodicMotion):
        return "depth u_z0 + sum over n of cos[n-1] cos(n omega t) + sin[n-1] sin(n omega t)"
    if isinstance(motion, NormalOscillation):
        return "depth u_z0 + du_z cos(omega t)"
    if isinstance(motion, ConstantDepth | ConstantLoad):
        return "what does not change"
    return (type(motion).__doc__ or "a motion").splitlines()[0]


def _line(field: Field[Any], record: Any) -> str:
    """A key with its value, unit and meaning."""
    unit, meaning, *_ = facts_of(field)
    comment = f"# {f'[{unit}] ' if unit else ''}{meaning}" if unit or meaning else ""
    return f"{f'{field.name} = {_written(getattr(record, field.name))}':<{WIDEST}}{comment}".rstrip()


def _written(value: Any) -> str:
    """A value as one writes it: 3e6, not 3000000.0."""
    if isinstance(value, tuple):
        return "[" + ", ".join(_written(one) for one in value) + "]"
    short_one = f"{value:.9g}".replace("e+0", "e").replace("e-0", "e-") if isinstance(value, float) else ""
    if value and isinstance(value, float) and not 1e-3 <= abs(value) < 1e5:
        digits, power = f"{value:.9e}".split("e")
        short_one = f"{digits.rstrip('0').rstrip('.')}e{int(power)}"
    return short_one if short_one and float(short_one) == value else toml_value(value)


def _named(kind: str, name: str, known: Any) -> str:
    """The name as Python writes it."""
    if not isinstance(name, str):
        raise TypeError(f"{kind} must be a name, got {short(repr(name))}")
    plain: dict[str, str] = {one.casefold(): one for one in known}
    if (found := plain.get(name.replace("_", "").replace("-", "").casefold())) is None:
        raise ValueError(f"{short(name)} is no {kind} of an example; {offer(name, list(known))}")
    return found


__all__ = ["MATERIALS", "MOTIONS", "PULLS", "SHAKES", "SHAPES", "STILL", "example", "example_file"]
