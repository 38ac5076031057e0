"""The contact in C: one header of a contact element, with its numbers, and without what its material lacks."""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib.resources import files
from textwrap import indent, wrap

import numpy as np
from numpy.typing import ArrayLike

from mdr.element.contact_element import ContactElement
from mdr.spring.disc import SHORTEST
from mdr.spring.dragged import EVEN
from mdr.tools.version import __version__

WIDTH = 120  #: of a line of numbers
#: What a dashpot changes in the text, with it and without it
OF_DASHPOT = {
    "NO_DT": (", dt = 0", ""),
    "DT_RULE": (">", ">="),
    "H": ("dt", "1.0"),
    "R_OF_S": ("s + T s'", "s"),
    "G_OF_E": ("e + T p", "e"),
    "SLIP": ("n' (R + T vel) = p - (p.n) n and T vel' + vel = p.n - R'", "n' R = p - (p.n) n, vel = p.n - R'"),
    "LAW": ("x + CONTACT_T * rate", "(void)rate, x"),
    "G_VECTOR": ("contact_plus(o->e, CONTACT_T, p)", "o->e"),
    "VEL": ("contact_max(size - contact_max(R, 0.0), 0.0) / CONTACT_T", "contact_max(ahead, 0.0)"),
    "OR_OUT": (" || size > tol", ""),
    "E_AFTER": (
        "time->t < CONTACT_T ? contact_yielded(o->e, first, of->f, &slip, time)"
        " : contact_plus(contact_times(R + CONTACT_T * slip.vel, slip.n), -CONTACT_T, p)",
        "of->f",
    ),
    "DECAY": ("time.decay", "0.0"),
    "STIFF": ("(1.0 + CONTACT_T / time->t)", "1.0"),
    "WITHIN": ("", ";\n   the extension is within the compression, as is the force"),
}


def header(element: ContactElement, name: str, told: str) -> str:
    """The text of the header. name: what all names in it begin with. told: the contact, in words."""
    row, law = element._row, element._row.law
    if law.arms is not None:
        what = "an elastic or a Kelvin material can be exported, not one with Maxwell arms"
        raise ValueError(f"{what}, got {element.material}: use element.step or element.address")
    if row.limit is not None:
        raise ValueError(
            f"one coefficient of friction can be exported, not mu_s = {element.mu_s:.6g} above mu_0 = "
            f"{element.mu_0:.6g}: use element.step or element.address, or leave mu_s out"
        )
    values = {word: named(one if law.T > 0 else other, name) for word, (one, other) in OF_DASHPOT.items()}
    values |= {
        "NAME": name,
        "VERSION": __version__,
        "CASE": indent("\n".join(told.replace("*/", "* /").replace("/*", "/ *").splitlines()), " *     "),
        "HALF": f"{0.5 * element.u_z_max:.6g}",
        "N": str(row.gap.size),
        "U_Z_MAX": numbers(element.u_z_max),
        "MARK": numbers(element._mark),
        "T": numbers(law.T),
        "EVEN": numbers(EVEN),
        "SHORTEST": numbers(SHORTEST),
        "UNITS": numbers([row.length_x, row.length_x, row.length_z]),
        "FORCES": numbers([row.force_x, row.force_x, row.force_z]),
        "GAP": numbers(row.gap),
        "W": numbers(row.w),
    }
    return filled("contact.h.in", values, {"KELVIN": law.T > 0, "ELASTIC": law.T == 0}, name)


def filled(template: str, values: dict[str, str], kept: dict[str, bool], name: str) -> str:
    """A template that stands beside this file, with values for @WORD@, without lines that #if WORD does not keep; names
    in it begin with another word than "contact".
    """
    text = files("mdr.element").joinpath(template).read_text(encoding="utf-8")
    text = named("\n".join(_kept(text, kept)) + "\n", name)
    return re.sub(r"@(\w+)@", lambda found: values[found[1]], text)


def named(text: str, name: str) -> str:
    """A text whose names begin with another word than "contact"."""
    return re.sub(r"\bcontact_", f"{name}_", re.sub(r"\bCONTACT_", f"{name.upper()}_", text))


def numbers(values: ArrayLike) -> str:
    """Numbers in C to the last digit, in lines."""
    return "\n".join(wrap(", ".join(repr(float(one)) for one in np.ravel(values)), WIDTH))


def _kept(text: str, kept: dict[str, bool]) -> Iterator[str]:
    """The lines that are kept; those of #if WORD, #else and #endif for the words of `kept` go themselves."""
    holds: list[bool] = []
    for line in text.splitlines():
        word, _, rest = line.partition(" ")
        if word == "#if" and rest in kept:
            holds.append(kept[rest])
        elif word == "#else" and holds:
            holds[-1] = not holds[-1]
        elif line == "#endif" and holds:
            holds.pop()
        elif all(holds):
            yield line
