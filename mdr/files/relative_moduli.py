"""Relative moduli: shares g_j = E_j/E_0 of the instantaneous modulus E_0, as finite-element programs write arms.

They are known by their form: all lie between 0 and 1, and their sum with the long-time share is 1; a list without that
share leaves 1 less the sum to it. No half-space of 1 Pa is meant, so that a file of this form is refused unless E_0
or G_0 says what they are shares of. Poisson's ratio is constant, and shares of a shear modulus are those of Young's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mdr.files.toml_text import CaseFileError
from mdr.materials.base import poisson_ratio
from mdr.tools.checks import positive
from mdr.tools.fields import fields_of
from mdr.tools.notation import numbers_in

KEYS = ("E_0", "G_0")  #: of what they are shares
ROUNDED = 0.01  #: by which a sum of rounded shares may miss 1
WAY_OUT = "moduli between 0 and 1 whose sum is 1 or less look like shares of the instantaneous modulus: give "


def are_relative(E_inf: float | None, moduli: Sequence[float]) -> bool:
    """Whether they have the form of shares; None for a long-time share that is left out."""
    every = [*moduli, *([] if E_inf is None else [E_inf])]
    total = sum(every)
    if not moduli or not all(0 <= one <= 1 for one in every) or not total > 0:
        return False
    return total <= 1 + ROUNDED and (E_inf is None or total >= 1 - ROUNDED)


def instantaneous_of(E_0: Any, G_0: Any, nu: Any) -> float | None:
    """Young's instantaneous modulus [Pa] from this or from that of shear, E_0 = 2 (1 + nu) G_0; None from neither."""
    if E_0 is not None and G_0 is not None:
        raise ValueError("E_0 and G_0 say the same: give one of them")
    if G_0 is not None:
        return 2 * (1 + poisson_ratio("nu", nu)) * positive("G_0", G_0, "instantaneous shear modulus in Pa")
    return None if E_0 is None else positive("E_0", E_0, "instantaneous modulus in Pa")


def in_pascals(E_0: float, E_inf: float | None, moduli: Sequence[float]) -> tuple[float, list[float]]:
    """Long-time modulus and moduli of arms [Pa] from shares. Raises ValueError for what has not their form."""
    if not are_relative(E_inf, moduli):
        total, row = sum(moduli) + (E_inf or 0.0), "" if E_inf is None else ", with the long-time one"
        raise ValueError(
            f"E_0 is for shares between 0 and 1 whose sum is 1{row}, got the sum {total:.6g}; correct them, or "
            "leave E_0 out, if they are moduli in Pa"
        )
    rest = max(1 - sum(moduli), 0.0) if E_inf is None else E_inf
    return E_0 * rest, [E_0 * one for one in moduli]


def material_of(record: type[Any], table: Mapping[str, Any]) -> Mapping[str, Any]:
    """A table [material] in pascals: of shares by its key E_0 or G_0. Raises CaseFileError for shares without them."""
    shares = _shares(record, table)
    if shares is None:
        return table
    E_inf, moduli = shares
    try:
        E_0, G_0 = (numbers_in(name, table.get(name), "Pa") for name in KEYS)
        E_0 = instantaneous_of(E_0, G_0, None if G_0 is None else numbers_in("nu", table.get("nu"), "-"))
        if E_0 is None and are_relative(E_inf, moduli):
            unit = f'"{E_inf if E_inf is not None else 0.0!r} Pa"'
            raise ValueError(f'{WAY_OUT}E_0 = "3 MPa", or G_0, beside them, or, if they are pascals, E_inf = {unit}')
        if E_0 is None:
            return table
        rest, scaled = in_pascals(E_0, E_inf, moduli)
    except (TypeError, ValueError) as refusal:
        raise CaseFileError(str(refusal)) from None
    said: dict[str, Any] = {key: value for key, value in table.items() if key not in KEYS} | {"E_inf": rest}
    if "arms" in table:
        return said | {"arms": [[E, arm[1]] for E, arm in zip(scaled, table["arms"], strict=True)]}
    return said | {"E_1": scaled[0]}


def told(values: Mapping[str, Any], record: type[Any]) -> dict[str, Any]:
    """The fields of a material as a file says them: with a unit where they would be taken for shares."""
    shares = _shares(record, values)
    if shares is None or not are_relative(*shares):
        return dict(values)
    return {**values, "E_inf": f"{values['E_inf']!r} Pa"}


def _shares(record: type[Any], table: Mapping[str, Any]) -> tuple[float | None, list[float]] | None:
    """E_inf, None where it is left out, and the moduli of the arms; None unless all are numbers without a unit."""
    arms = {"arms", "E_1"}.intersection(fields_of(record))
    if "E_inf" not in fields_of(record) or not arms:
        return None
    try:
        moduli = [E_j for E_j, _ in table["arms"]] if "arms" in arms else [table["E_1"]]
    except (KeyError, TypeError, ValueError):
        return None
    E_inf = table.get("E_inf")
    plain = all(type(one) in (int, float) for one in [*moduli, 0 if E_inf is None else E_inf])
    return (E_inf, moduli) if plain else None
