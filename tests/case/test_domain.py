"""Domains of the closed forms: which kinds of case each takes, and what a refusal says."""

import random

import pytest

import mdr
from mdr.case.domain import OutsideDomain, domain_of
from mdr.closed_forms import rigid_pull
from mdr.closed_forms.across import static_across
from mdr.closed_forms.laws.across import full_across

OMEGA = 300.0
KINDS = {
    "friction": {"Coulomb": {"mu_0": 0.4}, "strength": {"mu_0": 0.4, "tau_0": 1e4}},
    "pull": {
        "rigid": mdr.RigidPull(),
        "spring": mdr.SpringPull(k_x=2e3),
        "body": mdr.SpringPull(k_x=2e3, m=0.05, c_x=1.0),
        "overdamped": mdr.SpringPull(k_x=2e3, m=0.05, c_x=100.0),
    },
    "shake": {
        "none": None,
        "still": mdr.InPlaneOscillation(OMEGA),
        "along": mdr.InPlaneOscillation(OMEGA, du_x=1e-6),
        "twice": mdr.InPlaneOscillation(2 * OMEGA, du_x=1e-6),
        "across": mdr.InPlaneOscillation(OMEGA, du_y=1e-6),
        "both": mdr.InPlaneOscillation(OMEGA, du_x=1e-6, du_y=1e-6),
    },
    "material": {
        "elastic": mdr.Elastic(3e6, 0.4),
        "Kelvin": mdr.KelvinVoigt(3e6, 0.4, 1e-3),
        "arms": mdr.Prony(3e6, [(3e6, 1e-3)], 0.4, tau=1e-3),
        "auxetic": mdr.Elastic(3e6, -0.6),  # |beta| > 0.5
    },
    "oscillation": {
        "harmonic": mdr.NormalOscillation(20e-6, 6e-6, OMEGA),
        "lost": mdr.NormalOscillation(20e-6, 60e-6, OMEGA),
        "tapping": mdr.NormalOscillation(-1e-6, 5e-6, OMEGA),
        "wave": mdr.PeriodicMotion(OMEGA, 20e-6, cos=(2e-6, 1e-6)),
        "load": mdr.LoadOscillation(0.02, 0.004, OMEGA),
        "constant": mdr.ConstantDepth(20e-6),
    },
    "indenter": {"ball": mdr.Paraboloid(5e-3), "punch": mdr.FlatPunch(1e-3)},
}
SPECTRUM = mdr.Spectrum(f=(30.0, 50.0), density=(1e-14, 1e-14))
COULOMB, RIGID, UNSHAKEN = {"friction": "Coulomb"}, {"pull": "rigid"}, {"shake": "none still"}
SIMPLE, HARMONIC = {"material": "elastic auxetic Kelvin"}, {"oscillation": "harmonic lost tapping"}
PAPER = COULOMB | HARMONIC | SIMPLE | UNSHAKEN
COUPLED = COULOMB | RIGID | UNSHAKEN | {"oscillation": "harmonic lost", "material": "elastic Kelvin"}
ACROSS = COULOMB | RIGID | {"oscillation": "constant", "shake": "across"}
EDGE = RIGID | UNSHAKEN | {"friction": "strength", "material": "elastic auxetic", "indenter": "ball"}
KEPT = {"oscillation": "harmonic wave load"}
RANDOM = COULOMB | RIGID | {"shake": "none"}
#: of each function what it takes of each part of a case; of a part that is left out all kinds. Then its arguments.
TAKES = {
    rigid_pull.average_friction: (PAPER | RIGID, 1e-3),
    rigid_pull.near_critical: (PAPER | RIGID,),
    rigid_pull.small_velocity: (PAPER | RIGID,),
    static_across: (ACROSS,),
    full_across: (ACROSS, 0.01),
    mdr.laws.lost_across: (ACROSS, 5e-3),
    mdr.laws.excess_across: (ACROSS | {"material": "elastic auxetic"}, 5e-3),
    mdr.laws.steered_across: (COULOMB | RIGID | {"shake": "across both"}, 5e-3),
    mdr.laws.lost_under_shake: (
        COULOMB | RIGID | {"material": "elastic auxetic", "shake": "none still along across both"},
        1e-3,
    ),
    mdr.laws.radial_rub: (COULOMB,),
    mdr.laws.coupling_loss: (COUPLED,),
    mdr.laws.coupled_critical_velocity: (COUPLED,),
    mdr.laws.first_order: (PAPER,),
    mdr.laws.depth_sensitivity: (PAPER,),
    mdr.laws.least_over_depth: (PAPER | {"pull": "spring body overdamped"},),
    mdr.laws.onset: (PAPER | {"pull": "body", "indenter": "punch", "oscillation": "harmonic lost"},),
    mdr.laws.blow: (PAPER | {"pull": "body", "material": "Kelvin"},),
    mdr.laws.half_a_blow: (PAPER | {"pull": "body overdamped"},),
    mdr.laws.harmonic_share: (COULOMB, 1),
    mdr.laws.resonance_residue: (COULOMB | {"pull": "body overdamped"}, 1),
    mdr.laws.lost_at_the_edge: (EDGE | KEPT, 1.0),
    mdr.laws.velocity_of_share: (EDGE | KEPT, 0.99),
    mdr.laws.full_slip_of_half_space: (RIGID | UNSHAKEN | SIMPLE,),
    mdr.laws.random_friction: (RANDOM | SIMPLE | {"oscillation": "harmonic lost wave constant"}, SPECTRUM, 1e-3),
    mdr.random_cof: (RANDOM | {"oscillation": "harmonic lost tapping wave constant"}, SPECTRUM, 1e-3),
    mdr.holding_band: (COULOMB,),
    mdr.blocked_cof: (COULOMB,),
    mdr.no_load_velocity: (COULOMB,),
}


def drawn(law, n, seed):
    """Cases of random kinds, more of those that a law takes than of others, each with the names of its kinds."""
    rng, (taken, *_), found = random.Random(seed), TAKES[law], []
    while len(found) < n:
        mostly = {part: taken.get(part, "").split() or list(kinds) for part, kinds in KINDS.items()}
        kind = {part: rng.choice(mostly[part] if rng.random() < 0.8 else list(KINDS[part])) for part in KINDS}
        if kind["oscillation"] != "constant" or kind["shake"] not in ("none", "still"):  # else nothing oscillates
            parts = {part: KINDS[part][one] for part, one in kind.items() if part != "friction"}
            found.append((kind, mdr.SlidingContact(**parts, **KINDS["friction"][kind["friction"]])))
    return found


@pytest.mark.parametrize("law", TAKES, ids=lambda law: law.__name__)
def test_a_law_takes_the_kinds_of_its_domain_and_no_other(law):
    taken, *given = TAKES[law]
    sides = set()
    for kind, case in drawn(law, 240, seed=1):
        inside = all(kind[part] in kinds.split() for part, kinds in taken.items())
        assert (case in domain_of(law)) is inside, kind
        sides.add(inside)
        if not inside:
            with pytest.raises(OutsideDomain, match=rf"^{law.__name__} takes .*, got \S+ = .*: ask "):
                law(case, *given)
    assert sides == {False, True}


def test_a_refusal_is_a_value_error_and_of_a_part_of_the_wrong_kind():
    assert issubclass(OutsideDomain, ValueError)
    assert issubclass(OutsideDomain, TypeError)


def test_a_refusal_names_quantity_value_and_way_out():
    case = mdr.SlidingContact(
        mdr.Paraboloid(5e-3), mdr.Elastic(3e6, 0.4), 0.2, mdr.NormalOscillation(20e-6, 5e-6, 300.0), tau_0=1e4
    )
    with pytest.raises(OutsideDomain) as refusal:
        mdr.holding_band(case=case)
    said = "holding_band takes Coulomb's friction, got friction = ShearStrength(mu_0=0.2, tau_0=10000.0): ask "
    assert str(refusal.value).startswith(said)
    with pytest.raises(TypeError, match="case must be a SlidingContact, got 3"):
        mdr.laws.radial_rub(3)
