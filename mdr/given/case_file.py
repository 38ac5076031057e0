"""From a case file to a case: the file says which records (`mdr.files.case_files`), and here their depth is solved for.

A load that a file gives for a prescribed depth is that at which it rests, or the mean load; whether such a case can be
is known only after its depth, and then its faults are told together with those of the file.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from os import PathLike, fsdecode
from typing import Any, NamedTuple

from mdr.case.contact import SlidingContact
from mdr.case.motion import LoadOscillation
from mdr.files.case_files import HARMLESS, read_tables
from mdr.files.toml_text import CaseFileError, parse_toml, read_text, told, tried
from mdr.given.vary import contact_of, warn_of_load
from mdr.tools.warned import warn_outside


def read_case(path: str | PathLike[str]) -> SlidingContact:
    """The sliding contact that a TOML file describes, in SI.

    Parameters
    ----------
    path : str or path-like
        The case file.

    Returns
    -------
    SlidingContact
        The contact.

    Raises
    ------
    CaseFileError
        With every fault of the file, one a line.

    Examples
    --------
    >>> from pathlib import Path
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> _ = Path("case.toml").write_text(mdr.write_case(case))
    >>> mdr.read_case("case.toml") == case
    True
    """
    return _as_written(read_said(path))


class Said(NamedTuple):
    """What a case file says."""

    case: SlidingContact
    held: dict[str, Any]  #: load [N], with hold, and tan_delta [-], for fields that other tables decide about too


def read_said(path: str | PathLike[str]) -> Said:
    """The sliding contact of a TOML file, and what holds whatever else varies. Raises CaseFileError."""
    return parse_said(read_text(path), fsdecode(path))


def parse_case(text: str, source: str = "<string>") -> SlidingContact:
    """The sliding contact that a TOML text describes, in SI.

    Parameters
    ----------
    text : str
        The text of a case file.
    source : str
        What messages call the text.

    Returns
    -------
    SlidingContact
        The contact.

    Raises
    ------
    CaseFileError
        With every fault of the text, one a line.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> mdr.parse_case(mdr.write_case(case)) == case
    True
    """
    if not isinstance(text, str):
        raise TypeError(f"text must be a string of TOML, got {text!r}")
    return _as_written(parse_said(text, source))


def _as_written(said: Said) -> SlidingContact:
    """The case that a file says; with a warning where its mean load is another than its load. Of what varies a case,
    each answer is warned of, not the case that it begins with.
    """
    warn_of_load(said.held, said.case)
    return said.case


def parse_said(text: str, source: str) -> Said:
    """The same of a TOML text."""
    content = parse_toml(text, source)
    with told(f"{source}: "):
        return case_of(content)


def case_of(content: Mapping[str, Any], beside: Sequence[str] = ()) -> Said:
    """What tables already parsed say; keys `beside` them are left alone. Raises CaseFileError with every fault."""
    said, axes = read_tables(content, beside), content.get("axes")
    written = {}
    if not said.faults and "support_acceleration" in said.held and "m_z" in content["oscillation"]:
        written = {"oscillation.m_z": said.parts["oscillation"].m_z}  # it is not to be chosen
    # whether the others fit each other shows whatever friction is
    parts = {"friction": HARMLESS["friction"], **said.parts}
    case, whole = (None, []) if said.faults else tried(contact_of, parts, {**written, **said.held})
    if case is None or said.refused:
        raise CaseFileError.of([*said.faults, *said.refused, *whole])
    _ask_for_masses(case, content, axes if isinstance(axes, dict) else {})
    return Said(case, said.held)


def stand_in(content: Mapping[str, Any], beside: Sequence[str]) -> tuple[SlidingContact | None, set[str]]:
    """A case of the tables that are sound, harmless ones for the others, and the names of those others.

    To find what else is wrong in a file whose case is refused; None where its tables do not fit each other.
    """
    said = read_tables(content, beside)
    return tried(contact_of, {**HARMLESS, **said.parts}, said.held)[0], said.unsound


def _ask_for_masses(case: SlidingContact, content: Mapping[str, Any], axes: Mapping[str, Any]) -> None:
    """Warn of a body, and of a load that may ride on it, whose mass neither the tables nor the axes of a study say."""
    if "pull" in content and "m" not in content["pull"] and "pull.m" not in axes:
        warn_outside(
            "[pull] says no mass: give m in kg, or m = 0 for a body without inertia, which is what is computed"
        )
    m, motion, written = case.pull.coefficients[0], case.oscillation, content["oscillation"]
    silent = "m_z" not in written and "oscillation.m_z" not in axes
    if not (m > 0 and isinstance(motion, LoadOscillation) and silent):
        return
    if "support_acceleration" not in written:
        warn_outside(
            f"the body has the mass m = {m:.6g} kg along the pull, and [oscillation] does not say which mass the load "
            f"moves: m_z = {m:.6g} if it presses on the body itself, which may change v_c several times, or m_z = 0"
        )
    elif not math.isclose(m, motion.m_z, rel_tol=0.01):
        warn_outside(
            f"the load is taken for the weight of a mass of {motion.m_z:.6g} kg, and the body has m = {m:.6g} kg: give "
            "m_z, the mass that moves up and down"
        )
