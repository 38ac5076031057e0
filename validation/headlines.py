"""The numbers that head README and report: how far measured critical velocities lie from a formula, the worst of all.

Each headline names all checks, of whatever claim, that set a measured critical velocity beside its formula.
"""

import re

Places = tuple[tuple[str, str], ...]  #: claim, and how the names of its checks begin

_RIGID = (
    ("rigid_pull", r"measured v_c over Eq\. \(1\).*(contact kept|back in time)\)"),
    ("generalisation", r".*rigid pull: (worst \|v_c/Eq\. \(1\) − 1\||measured v_c over Eq\. \(1\))"),
)
_PUNCH = (
    ("spring_pull", r"ωτ = .*worst \|measured/Eq\. \(15\) − 1\|"),
    ("generalisation", r"flat punch.*worst \|v_c/Eq\. \(15\) − 1\|"),
    ("generalisation", r"measured v_c over (the closed form: flat punch|the formula: flat punch.*body)"),
)

#: of each headline; full slip is Eq. (1) or (15) where these are exact
HEADLINES: dict[str, Places] = {
    "rigid pull": _RIGID,
    "flat punch on a spring": _PUNCH,
    "full slip": (
        *_RIGID,
        *_PUNCH,
        ("rigid_pull", r"measured v_c over Eq\. \(1\)"),
        ("lost_contact", r"measured v_c over Eq\. \(1\)|with a body: measured v_c over the full-slip value"),
        ("generalisation", r".*worst \|v_c/full-slip value − 1\||.*measured v_c over the full-slip value"),
        ("resonances", r"v_c over the full-slip value"),
        ("shaken_velocity", r"v_c measured over"),
        ("maps", r"measured v_c over that of full slip"),
        ("shear_strength", r"measured v_c over full slip"),
        ("waveforms", r"v_c over that of the gain.*; by runs over full slip"),
    ),
}


def reads(headline: str, claim: str, name: str) -> bool:
    """Whether a headline reads the check of this name; ValueError for a headline that there is not."""
    if headline not in HEADLINES:
        raise ValueError(f"a headline is one of {', '.join(HEADLINES)}, got {headline!r}")
    return is_at(HEADLINES[headline], claim, name)


def is_at(places: Places, claim: str, name: str) -> bool:
    """Whether the check of this name is at one of the places."""
    return any(claim == of and re.match(begins, name) for of, begins in places)


def difference(name: str, got: float, expected: float, why: str) -> float:
    """Greatest relative difference of a measured velocity from its formula, by what a check says."""
    if told := re.search(r"greatest difference (\S+) of v_c", why):
        return float(told[1])
    is_difference = re.search(r"− 1\||, less 1\b", name)
    return abs(got if is_difference else got / expected - 1)
