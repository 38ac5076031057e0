"""The answer to the question of the report, in four sentences whose numbers are those of the checks of this run."""

import re
from collections.abc import Sequence

from validation.headlines import HEADLINES, Places, difference, is_at
from validation.report import Check, Claim
from validation.words import counted, number, percent, span


def answers(claims: Sequence[Claim]) -> list[str]:
    """Yes, nearly, no, and what to use instead; empty where none of it was asked.

    A sentence says so where this run has no checks for it, or one that did not hold.
    """
    sentences, asked = [], False
    for name, checks, sentence in (
        ("Rigid pull and flat punch", {"rigid": _RIGID, "punch": _PUNCH}, _exact),
        ("Curved shape on a spring", {"power": _POWER, "error": _ERROR}, _curved),
        ("Resonance with a harmonic", {"reduction": _REDUCTION}, _resonance),
        ("Full slip", {"full_slip": _FULL_SLIP, "far": _FAR}, _instead),
    ):
        found = {key: _found(claims, where) for key, where in checks.items()}
        missed = len({check for some in found.values() for check in some if not check.held})
        if not all(found.values()):
            sentences.append(f"<b>{name}</b>: not asked in this run.")
            continue
        asked = True
        lost = f"<b>{name}</b>: not confirmed, {counted(missed, 'check')} did not hold."
        sentences.append(lost if missed else sentence(**found))
    return sentences if asked else []


_RIGID, _PUNCH, _FULL_SLIP = (HEADLINES[one] for one in ("rigid pull", "flat punch on a spring", "full slip"))
_POWER = (("generalisation", r"\w.*, stiff spring: power of α in the deviation"),)
_ERROR = (("generalisation", r"curved shapes: largest \|v_c/Eq\. \(15\) − 1\| measured"),)
_REDUCTION = (("resonances", r"\(1 − COF/μ_0\) F_0/\|F_n\| at (\d+) v_c: .*ω_0 = [2-9]ω"),)
_FAR = (("generalisation", r"worst \|v_c/full-slip value − 1\|"),)  # large amplitude, contact lost


def _found(claims: Sequence[Claim], places: Places) -> list[Check]:
    """Checks with a number at these places."""
    return [c for claim in claims for c in claim.checks if c.got is not None and is_at(places, claim.name, c.name)]


def _off(checks: Sequence[Check]) -> str:
    """To what the velocities agree, over all checks; and whether all that there is is one measurement."""
    most = max(difference(c.name, c.got or 0.0, c.expected, c.why) for c in checks)
    return number(most) + (" on one measurement" if [c.name[-5:] for c in checks] == [" of 1"] else "")


def _exact(rigid: Sequence[Check], punch: Sequence[Check]) -> str:
    return (
        "<b>Yes, exactly, for a rigid pull and for a flat punch that keeps contact.</b> Critical velocities measured"
        f" from runs agree with Eq. (1), which Eq. (15) is for a rigid pull, to {_off(rigid)}, unless the contact is"
        f" open at the moment of fastest approach; those of the punch on a spring agree with Eq. (15) to {_off(punch)},"
        " except for an undamped body at a resonance (3)."
    )


def _curved(power: Sequence[Check], error: Sequence[Check]) -> str:
    largest = max(error, key=lambda check: check.got or 0.0)
    where = re.findall(r"\(([^()]*)\)$", largest.why)
    return (
        "<b>For a curved shape on a spring only in the limit of small amplitude.</b> With a damper the error is of"
        f" first order in α = Δu_z/u_z0 (power found: {span([check.got or 0.0 for check in power])}); the largest one"
        f" measured over its amplitudes is {percent(largest.got or 0.0, 3)}{f' ({where[0]})' if where else ''}."
    )


def _resonance(reduction: Sequence[Check]) -> str:
    speeds = {check: int(re.findall(r"at (\d+) v_c", check.name)[0]) for check in reduction}
    top = max(speeds.values())
    over = span([check.got or 0.0 for check, speed in speeds.items() if speed == top])
    return (
        "<b>No, where the natural frequency of the body is a whole multiple of that of the oscillation,</b> ω_0 ="
        " <i>n</i>ω with <i>n</i> ≥ 2, and the normal force has this harmonic, F_n. Without a damper there is no"
        f" critical velocity: at {top} times Eq. (15) friction is still reduced by {over} times |F_n|/F_0."
    )


def _instead(full_slip: Sequence[Check], far: Sequence[Check]) -> str:
    return (
        "<b>Use the full-slip condition instead,</b> v_c = max (μ_0 κ <i>u̇</i><sub>z</sub> − <i>ẏ</i>) over the"
        " instants of contact, <i>y</i> the motion of the body under all harmonics of the normal force. It meets the"
        f" measured velocities to {_off(full_slip)}; at large amplitude and with contact lost, to {_off(far)}. Only an"
        " undamped body at a resonance departs from it."
    )
