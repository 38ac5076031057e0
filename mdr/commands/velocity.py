"""`mdr velocity`: critical velocity and friction at rest in closed form; of a shaken contact both ways and unloaded."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

import mdr
from mdr.case.domain import domain_of
from mdr.case.doubts import edge, frequencies
from mdr.closed_forms.critical_velocity import NEARLY, formula_of
from mdr.closed_forms.laws.across import full_across
from mdr.commands.output import Told, answer, text_of, values_of, velocity_text
from mdr.normal.normal_force import full_cof, mean_normal_force
from mdr.tools.summary import number

if TYPE_CHECKING:
    from mdr.friction.shaken import HoldingBand

FULL = "friction is full at no velocity"  #: where a critical velocity is infinite
HARMONICS = "all harmonics of the force"  #: that a velocity of full slip counts


def velocity(args: argparse.Namespace, case: mdr.SlidingContact) -> int:
    """Print Eq. (15) and what stands beside it."""
    known, kappa, loss = mdr.resolved(case), case.material.mindlin_ratio, float(case.material.loss_tangent(case.omega))
    contact = "kept" if known.keeps_contact else "lost in part of the period"
    amplitude = "amplitude of the depth over the mean depth, du_z/u_z0"
    shake, across = "amplitude of the shake over the deflection at which springs slip", "the same across the pull"
    if known.is_shaken_at_pull:
        shake = f"force that shakes the stuck contact, over full friction of {number(known.full_friction, 'N')}"
    elif not known.pull.is_rigid:
        shake += ", of a tool that is held rigidly"
    tangent = "loss tangent of the material at omega; omega tau of a Kelvin body"
    groups = [("chi", known.chi, shake), *([("eta", known.eta, across)] if case.moves_across else [])]
    told = [
        *_velocities(case),
        told_number("alpha", known.alpha, "alpha", "-", amplitude),
        *(told_number(name, value, name, "-", meaning) for name, value, meaning in groups if case.is_shaken),
        Told("T", case.T),
        *([] if case.is_shaken else [told_number("loss_tangent", loss, "loss", "-", tangent)]),
        Told("mindlin_ratio", kappa, "kappa", "" if case.is_shaken else number(kappa), "E*/G*, Mindlin ratio"),
        Told("keeps_contact", known.keeps_contact, "contact", contact, "at its centre, Eq. (5)"),
        *_size(known),
    ]
    return answer(args, values_of(told), text_of(told), case)


def _velocities(case: mdr.SlidingContact) -> list[Told]:
    """The critical velocities and friction at rest; of a contact shaken in the plane, for each way of the pull."""
    equation, how = equation_of(case)
    by = f" by {equation} {how}" if case.is_shaken else f", {how}"
    forward = ("forward" if case.is_shaken else equation, f"critical velocity{by}")
    full = f"critical velocity{' forward' if case.is_shaken else ''}, any amplitude, {HARMONICS}"
    told = [Told("equation", equation)]
    if case.moves_across:
        return [*told, *_across(case), Told("mu_0", case.mu_0), *ends_of(case)]
    for key, solve, name, meaning in (
        ("v_c", mdr.critical_velocity, *forward),
        ("full_slip", mdr.full_slip_critical_velocity, "full slip", full),
    ):
        if solve is mdr.full_slip_critical_velocity and case not in domain_of(solve):
            continue
        told.append(told_velocity(key, solve(case), name, meaning))
        if case.is_shaken:
            told.append(told_velocity(f"{key}_back", solve(case, -1), "other way", "the same, pulled the other way"))
    if not (case.is_shaken or case.pull.is_rigid):
        rigid = replace(case, pull=mdr.RigidPull())
        meaning = f"the same contact pulled rigidly, {formula_of(rigid)}"
        told.append(told_velocity("v_c_rigid", mdr.critical_velocity(rigid), "rigid", meaning))
    if not case.is_shaken:
        known = mdr.resolved(case)
        full = f"; in full slip {full_cof(known):.6g}" if case.friction.needs_area else ""
        rest = f"friction as v_0 -> 0; mu_0 = {case.mu_0:.6g}{full}"
        if case in domain_of(mdr.static_cof):
            told.append(told_number("static_cof", mdr.static_cof(case), "static COF", "-", rest))
        if known in domain_of(mdr.laws.velocity_of_share):
            back, most = mdr.laws.velocity_of_share(known, 1 - NEARLY), f"{100 - 100 * NEARLY:g} %"
            half_space = mdr.laws.velocity_of_share(known, 1 - NEARLY, half_space=True)
            meaning = f"velocity from which at least {most} of full friction is back; {half_space:.3g} on a half-space"
            told.append(told_number("nearly_full", back, most, "m/s", meaning))
    return [*told, Told("mu_0", case.mu_0), *ends_of(case)]


def _across(case: mdr.SlidingContact) -> list[Told]:
    """What a contact has that is shaken across: no critical velocity, and where friction is nearly full."""
    known = mdr.resolved(case)
    told = [
        told_velocity("v_c", math.inf, "v_c", "critical velocity either way, shaken across the pull"),
        *(Told(key, math.inf) for key in ("v_c_back", "full_slip", "full_slip_back")),
        told_number("fastest_across", case.fastest_across, "across", "m/s", "greatest velocity of the shake across"),
    ]
    if known in domain_of(full_across):
        full, most = full_across(known, NEARLY), f"{100 - 100 * NEARLY:g} %"
        meaning = f"velocity from which friction is at least {most} of mu_0 (mdr.laws.lost_across)"
        if math.isfinite(full):
            told.append(told_number("nearly_full", full, most, "m/s", meaning))
    return told


def told_velocity(key: str, v: float | None, name: str, meaning: str) -> Told:
    """A critical velocity [m/s]."""
    return Told(key, v, name, velocity_text(v), f"{meaning}; {FULL}" if v == math.inf else meaning)


def v_c_text(case: mdr.SlidingContact, v_c: float, back: float | None = None) -> str:
    """The critical velocity, and that of the pull the other way where there is one, for the head of a text."""
    told = velocity_text(v_c)
    if back is not None:
        told += " either way" if back == v_c else f" forward and {velocity_text(back)} the other way"
    return f"v_c = {told} by {equation_of(case)[0]}{f': {FULL}' if v_c == math.inf else ''}"


def told_number(key: str, value: float, name: str, unit: str, meaning: str) -> Told:
    """A number of six digits, with its unit."""
    return Told(key, value, name, number(value, unit), meaning)


def _size(known: mdr.SlidingContact) -> list[Told]:
    """The numbers by which a mistake in a case file shows: how large, how steep, how loaded, how stiff."""
    d = known.contact_depth
    a, slope = edge(known.indenter, d)
    deepest = float(known.indenter.contact_radius(known.u_z_max))
    pressures = known.indenter.pressure(deepest * np.linspace(0.01, 0.99, 99), known.u_z_max, known.material.E_star)
    k_zc = float(known.indenter.stiffness(d, known.material.E_star))
    ratios = [known.pull.omega_0 / one for one in frequencies(known)]
    ratio = None if known.pull.is_rigid else min(ratios, key=lambda one: abs(math.log(one)))
    body = "rigid" if ratio is None else "no mass" if math.isinf(ratio) else f"{ratio:.6g}"
    m_z = getattr(known.oscillation.load, "m_z", 0.0)
    bounce = math.sqrt(k_zc / m_z) / known.oscillation.omega if m_z > 0 else None
    at_full_depth = "greatest at full depth, of r = 0.01 a to 0.99 a"
    natural = "natural frequency of the body over that of the vibration, omega_0/omega"
    bounces = "natural frequency of m_z on the contact over that of the load"
    return [
        told_number("contact_radius", a, "radius", "m", f"of the contact at the depth of {d:.4g} m"),
        told_number("edge_slope", slope, "slope", "-", "of the shape at the edge of the contact; well below 1"),
        told_number("mean_load", mean_normal_force(known), "load", "N", "mean normal force over a period"),
        told_number("peak_pressure", float(pressures.max()), "pressure", "Pa", at_full_depth),
        told_number("k_zc", k_zc, "k_zc", "N/m", "normal stiffness of the contact"),
        told_number("k_xc", k_zc / known.material.mindlin_ratio, "k_xc", "N/m", "tangential stiffness of the contact"),
        Told("omega_0_over_omega", ratio, "body", body, natural),
        Told("omega_z_over_omega", bounce, "m_z", "" if bounce is None else f"{bounce:.6g}", bounces),
        Told("at_depth", d),
    ]


def ends_of(case: mdr.SlidingContact) -> list[Told]:
    """The ends of the characteristic of a contact shaken in the plane, in words what is not known; none of others."""
    if not case.is_shaken:
        return []
    if case not in domain_of(mdr.holding_band):
        return [Told("holding_band", None, "band", "not known", "at rest: it is known for Coulomb's friction alone")]
    from mdr.friction.shaken import holder_of

    standing = f"mean F_x over mean F_z at rest, under {holder_of(case)}"
    band, span, standing = _asked(lambda: mdr.holding_band(case), _span, standing)
    blocked, force, own = _asked(lambda: _at_rest(case), _span, "the same under its own pull, standing still")
    unloaded = "velocity at which it runs by itself, where no force holds it"
    free, velocity, alone = _asked(lambda: mdr.no_load_velocity(case), velocity_text, unloaded)
    held, known = (None if isinstance(one, float | str) else one for one in (blocked, band))
    row = () if case.is_shaken_at_pull else ("blocked", force, own)  # there it is the band
    return [
        Told("holding_band", known and [known.low, known.high], "band", span, standing),
        Told("holding_band_error", known and known.error),
        Told("blocked_cof", None if held else blocked, *row),
        *([Told("blocked_band", [held.low, held.high])] if held else []),
        Told("no_load_velocity", free, "no load", velocity, alone),
    ]


def _asked(ask: Callable[[], Any], write: Callable[[Any], str], meaning: str) -> tuple[Any, str, str]:
    """What is asked, as text, and its meaning; for what is not known, the reason instead of value and meaning."""
    try:
        found = ask()
    except ValueError as unknown:
        return str(unknown), "not known", str(unknown)
    return found, write(found), meaning


def _at_rest(case: mdr.SlidingContact) -> float | HoldingBand:
    """Friction where its own pull stands still."""
    from mdr.friction.shaken import band_of_pull

    held = band_of_pull(mdr.resolved(case))
    return mdr.blocked_cof(case) if held.is_one_number else held


def _span(held: HoldingBand | float) -> str:
    """A band of forces, or one force; with its error where six digits show it."""
    if isinstance(held, float):
        return f"{held:.6g}"
    error = f" ± {held.error:.2g}" if held.error > 1e-6 * max(-held.low, held.high) > 0 else ""
    return f"{held.high:.6g}{error} (one value)" if held.is_one_number else f"{held.low:.6g} to {held.high:.6g}{error}"


def equation_of(case: mdr.SlidingContact) -> tuple[str, str]:
    """Number and circumstances of the closed form."""
    number, closing, rest = formula_of(case).partition(")")
    usual = "" if case.is_shaken else "any amplitude" if "tau_0" in number else "contact stiffness at the mean depth"
    return number + closing, rest.strip() or usual
