"""Arms from what people measure: dynamic moduli, a power law, a table.

Relaxation times are spread evenly in log time; the moduli that go with them are the non-negative least squares of the
relative deviation of E(omega) (Lawson and Hanson 1974, in scipy.optimize.nnls), so that every arm is a passive one.
"""

from __future__ import annotations

from itertools import product
from os import PathLike, fsdecode
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.tools.checks import FloatArray, between, count, finite_array, positive, positive_array
from mdr.tools.csv_table import cells_of, fault
from mdr.tools.messages import short

if TYPE_CHECKING:
    from mdr.materials.prony import Prony

Pairs = tuple[tuple[float, float], ...]

USELESS = 1e-9  #: of the greatest modulus, below which one is rounding
A_DECADE = 3.0  #: arms per decade of frequency, where none were asked for
MOST_ARMS = 60
MARGINS = (3.0, 10.0, 100.0, 1000.0)  #: reach of the arms beyond the range, for the rest of a power law


def to_data(omega: ArrayLike, storage: ArrayLike, loss: ArrayLike, n_arms: int | None) -> tuple[float, Pairs]:
    """E_inf [Pa] and arms closest to measured moduli."""
    omega, modulus = _data(omega, storage, loss)
    decades = float(np.log10(omega.max() / omega.min()))
    if n_arms is None:
        n_arms = max(1, min(round(A_DECADE * decades) + 1, omega.size // 2))
    n_arms = count("n_arms", n_arms, 1)
    times = 1 / (
        np.geomspace(omega.min(), omega.max(), n_arms) if n_arms > 1 else np.array([np.sqrt(omega.min() * omega.max())])
    )
    E_inf, moduli = _moduli(omega, modulus, times)
    return E_inf, tuple((float(E), float(t)) for E, t in zip(moduli, times, strict=True) if E > 0)


def to_power_law(modulus: float, exponent: float, omega: tuple[float, float], error: float) -> tuple[float, Pairs]:
    """E_inf [Pa] and arms of a spring-pot over a range of frequencies."""
    modulus = positive("modulus", modulus, "|E| at omega[0] in Pa")
    exponent = between("exponent", exponent, 0, 1, "of the power law")
    error = positive("error", error, "relative deviation")
    low, high = _range(omega)
    dense = np.geomspace(low, high, 40 * (1 + int(np.ceil(np.log10(high / low)))))
    wanted = modulus * (1j * dense / low) ** exponent
    least = np.inf
    for n_arms, margin in product(range(2, MOST_ARMS + 1), MARGINS):
        times = np.geomspace(1 / (margin * high), min(margin, 10) / low, n_arms)
        E_inf, moduli = _moduli(dense, wanted, times)
        if E_inf == 0:
            continue  # flows in the end
        missed = float(np.max(np.abs(_response(dense, times) @ moduli + E_inf - wanted) / np.abs(wanted)))
        least = min(least, missed)
        if missed <= error:
            return E_inf, tuple((float(E), float(t)) for E, t in zip(moduli, times, strict=True) if E > 0)
    raise ValueError(
        f"error = {error:g} of the power law is not reached by {MOST_ARMS} arms, only {least:.2g}: "
        "raise error or narrow the range omega"
    )


def misfit(material: Prony, omega: ArrayLike, storage: ArrayLike, loss: ArrayLike) -> float:
    """Greatest relative deviation from measured moduli."""
    omega, modulus = _data(omega, storage, loss)
    own = np.asarray(material.dynamic_modulus(omega)) * (1 - material.nu**2)
    return float(np.max(np.abs(own - modulus) / np.abs(modulus)))


def from_table(path: str | PathLike[str], nu: float | None) -> dict[str, Any]:
    """The fields of a Prony in a file."""
    from mdr.files.case_files import read_text

    name = fsdecode(path)
    if not name.lower().endswith((".csv", ".toml")):
        raise fault(name, "a table of arms must end in .csv or .toml")
    if name.lower().endswith(".toml"):
        return _from_toml(read_text(path), name, nu)
    if nu is None:
        raise fault(name, "a CSV table has no Poisson's ratio; give nu=")
    return {**_from_csv(read_text(path), name), "nu": nu}


def _moduli(omega: FloatArray, modulus: Any, times: FloatArray) -> tuple[float, FloatArray]:
    """E_inf and arm moduli, non-negative, of least relative deviation."""
    from scipy.optimize import nnls

    weight = 1 / np.abs(modulus)
    columns = np.column_stack([np.ones(omega.size), _response(omega, times)]) * weight[:, None]
    target = modulus * weight
    found, _ = nnls(
        np.concatenate([columns.real, columns.imag]),
        np.concatenate([target.real, target.imag]),
        maxiter=100 * times.size,
    )
    found[found < USELESS * found.max()] = 0.0
    return float(found[0]), found[1:]


def _response(omega: FloatArray, times: FloatArray) -> Any:
    """E_j(omega)/E_j of every arm, shape (n_omega, n_arms)."""
    lead = 1j * np.outer(omega, times)
    return lead / (1 + lead)


def _data(omega: ArrayLike, storage: ArrayLike, loss: ArrayLike) -> tuple[FloatArray, Any]:
    omega = positive_array("omega", omega, "rad/s")
    storage, loss = positive_array("storage", storage, "Pa"), finite_array("loss", loss, "Pa")
    if np.any(loss < 0):
        raise ValueError(f"loss must not be negative, got {float(loss.min())!r} Pa: no passive body gives energy back")
    if not omega.ndim == 1 <= omega.size or not omega.shape == storage.shape == loss.shape:
        raise ValueError(
            "omega, storage and loss must be lists of one length, "
            f"got shapes {omega.shape}, {storage.shape}, {loss.shape}"
        )
    return omega, storage + 1j * loss


def _range(omega: tuple[float, float]) -> tuple[float, float]:
    ends = positive_array("omega", omega, "rad/s")
    if ends.shape != (2,) or not ends[0] < ends[1]:
        raise ValueError(f"omega must be a range (lowest, highest) in rad/s, got {omega!r}")
    return float(ends[0]), float(ends[1])


def _from_csv(text: str, name: str) -> dict[str, Any]:
    rows = [
        (number, cells_of(line, f"{name}: row {number}"))
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip()
    ]
    heads = [cell.split("[")[0].strip() for cell in rows[0][1]] if rows else []
    if not {"E_j", "tau_j"} <= set(heads):
        got = short(", ".join(heads)) or "nothing"
        raise fault(name, f"the first line must name the columns E_j and tau_j, got {got}")
    E_inf, arms = 0.0, []
    for number, row in rows[1:]:
        cells = dict(zip(heads, (cell.strip() for cell in row), strict=False))
        try:
            E_j, tau_j = float(cells["E_j"]), float(cells.get("tau_j") or "inf")
        except (KeyError, ValueError):
            raise fault(name, f"row {number} is no pair of numbers: {short(', '.join(row))}") from None
        if not 0 <= E_j < np.inf or not tau_j > 0:
            what = f"row {number} must have a finite E_j >= 0 Pa and tau_j > 0 s, got {short(', '.join(row))}"
            raise fault(name, what)
        if np.isinf(tau_j):
            E_inf += E_j
        else:
            arms.append((E_j, tau_j))
    return {"E_inf": E_inf, "arms": tuple(arms)}


def _from_toml(text: str, name: str, nu: float | None) -> dict[str, Any]:
    from mdr.files.case_files import parse_toml

    content = parse_toml(text, name)
    table = content.get("material", content)
    if not isinstance(table, dict):
        raise fault(name, f"material must be a table of keys, got {short(str(table))}")
    table = dict(table)
    model = table.pop("model", "Prony")
    known = ("E_inf", "arms", "nu", "tau")
    unknown = [key for key in table if key not in known]
    if model != "Prony" or unknown:
        other = f'model "{short(str(model))}" is not Prony'
        what = other if model != "Prony" else f"{short(unknown[0])} is no key of Prony"
        raise fault(name, f"{what}; there are {', '.join(known)}")
    if nu is not None:
        table["nu"] = nu
    missing = [key for key in ("E_inf", "arms", "nu") if key not in table]
    if missing:
        raise fault(name, f"{missing[0]} is missing")
    return table
