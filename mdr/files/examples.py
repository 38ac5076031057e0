"""Starting files: a commented case for each shape, material, motion, pull and shake that a file can carry.

Every example is a small body of rubber some 20 µm deep, which touches over a disc of about 1 mm.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from functools import partial
from types import ModuleType
from typing import Any

import numpy as np

from mdr import indenters, materials
from mdr.case import friction as laws
from mdr.case import in_plane, waveforms
from mdr.case import motion as motions
from mdr.case.contact import SlidingContact, as_given
from mdr.case.pull import RigidPull, SpringPull
from mdr.files.case_files import write_case
from mdr.files.toml_text import toml_value
from mdr.tools.fields import example_of, facts_of, has_example
from mdr.tools.messages import offer, short

TITLES = {
    "indenter": "the shape that is pressed in; its fields follow",
    "material": "the half-space",
    "friction": "how much of it bears before it slips",
    "pull": "what drags it; a rigid pull without this table",
    "shake": "shake in the plane, besides the pull",
}


def _examples(module: ModuleType) -> dict[str, Any]:
    """The examples of the records of a module, by name, of those that have one."""
    known: dict[str, Any] = {name: getattr(module, name) for name in module.__all__}
    return {name: example_of(one) for name, one in known.items() if has_example(one)}


SHAPES: dict[str, indenters.Indenter] = _examples(indenters)
MATERIALS: dict[str, materials.Material] = _examples(materials)
#: of eight harmonics, by mean depth [m], fall below it [m] and angular frequency [rad/s]
WAVEFORMS: dict[str, Callable[[float, float, float], motions.PeriodicMotion]] = {
    "Sawtooth": partial(waveforms.sawtooth, n_harmonics=8),
    "FallingSawtooth": partial(waveforms.sawtooth, n_harmonics=8, falling=True),
    "Square": partial(waveforms.square, n_harmonics=8),
    "Pulse": partial(waveforms.pulse, n_harmonics=8, width=0.25),
}
_SINE: motions.NormalOscillation = example_of(motions.NormalOscillation)
MOTIONS: dict[str, motions.Motion] = _examples(motions) | {
    name: make(_SINE.u_z0, _SINE.du_z, _SINE.omega) for name, make in WAVEFORMS.items()
}
PULLS: dict[str, RigidPull | SpringPull] = {"SpringPull": example_of(SpringPull), "RigidPull": RigidPull()}
LAWS: dict[str, laws.Friction] = _examples(laws)
SHAKES: dict[str, in_plane.Shake] = _examples(in_plane)
STILL = "none"  #: the name of no shake
#: what each part can be
PARTS: dict[str, dict[str, Any]] = {
    "indenter": SHAPES,
    "material": MATERIALS,
    "friction": LAWS,
    "oscillation": MOTIONS,
    "pull": PULLS,
    "shake": {STILL: None, **SHAKES},
}


def example(
    shape: str = "Paraboloid",
    material: str = "KelvinVoigt",
    motion: str = "NormalOscillation",
    pull: str = "SpringPull",
    shake: str = STILL,
    friction: str = "Coulomb",
) -> SlidingContact:
    """The example of these records, named as in Python, in any case and with or without underscores.

    A constant depth or load is shaken in the plane, unless asked otherwise harmonically, as something has to move.
    Raises ValueError for a name that is none, with the nearest.
    """
    indenter, body = _named("shape", shape, SHAPES), _named("material", material, MATERIALS)
    moved, shaken = _named("motion", motion, MOTIONS), _named("shake", shake, PARTS["shake"])
    if shaken is None and not moved.omega:
        shaken = SHAKES["InPlaneOscillation"]
    drag, law = _named("pull", pull, PULLS), _named("friction", friction, LAWS)
    return SlidingContact(indenter, body, oscillation=moved, pull=drag, shake=shaken, friction=law)


def example_file(case: SlidingContact) -> str:
    """The TOML text of a case, each key with its unit and meaning."""
    case = as_given(case)
    blocks = write_case(case).rstrip("\n").split("\n\n")
    if isinstance(case.pull, RigidPull):
        blocks.insert(4, "# no [pull]: a rigid pull; give k_x [N/m], m [kg] and c_x [N s/m] for a body on a spring")
    return "\n\n".join(_commented(case, block) for block in blocks) + "\n"


def _commented(case: SlidingContact, block: str) -> str:
    """The lines of one table, or of what stands above the tables, each with a comment."""
    title, lines = block.partition("\n")[0].strip("[]"), block.split("\n")
    record: Any = getattr(case, title, case.friction)
    known = {one.name: one for one in fields(record)}
    for i, line in enumerate(lines):
        key, comment = line.partition(" = ")[0], ""
        if line == f"[{title}]":
            comment = TITLES.get(title) or (type(record).__doc__ or "").partition("\n")[0].rstrip(".")
        elif key in known:
            line = f"{key} = {_written(getattr(record, key))}"
            unit, meaning, *_ = facts_of(known[key])
            comment = f"[{unit}] {meaning}" if unit else meaning
        lines[i] = f"{line:<43} # {comment}" if comment else line
    return "\n".join(lines)


def _written(value: Any) -> str:
    """A value as one writes it: 3e6, not 3000000.0."""
    if isinstance(value, tuple):
        return "[" + ", ".join(_written(one) for one in value) + "]"
    if not isinstance(value, float):
        return toml_value(value)
    if value == 0 or 1e-3 <= abs(value) < 1e5:
        return np.format_float_positional(value, trim="-")
    return np.format_float_scientific(value, trim="-", exp_digits=1).replace("e+", "e")


def _named(kind: str, name: str, known: dict[str, Any]) -> Any:
    """What has this name."""
    if not isinstance(name, str):
        raise TypeError(f"{kind} must be a name, got {short(repr(name))}")
    plain: dict[str, str] = {one.casefold(): one for one in known}
    if (found := plain.get(name.replace("_", "").replace("-", "").casefold())) is None:
        raise ValueError(f"{short(name)} is no {kind} of an example; {offer(name, list(known))}")
    return known[found]
