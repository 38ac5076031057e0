"""Any record that constructs gives finite, bounded answers, or refuses in the words of the library.

A question takes a contact and a dice. A wrong answer is an AssertionError, and any error or warning that is no refusal
comes through.
"""

import contextlib
import copy
import math
import pickle
import re
import traceback
import warnings
from pathlib import Path

import numpy as np
import pytest
import random_records

import mdr
from mdr.case.domain import domain_of
from mdr.case.pull import SpringPull
from mdr.closed_forms.rigid_pull import average_friction
from mdr.files.examples import MATERIALS, SHAPES
from mdr.normal.resolved import at_rest

LIBRARY = {str(path): path.read_text("utf-8").splitlines() for path in Path(mdr.__file__).parent.rglob("*.py")}
ROUNDING = 1e-9  #: of mu_0, or of an answer
LONGEST = 400  #: characters of a refusal


class Refused(Exception):
    """The library will not answer, and says why."""


def asked(call, *args, **knobs):
    """The answer, or Refused; a warning is an error, and so is whatever else is raised."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", mdr.PlausibilityWarning)
        warnings.filterwarnings("ignore", "Profile is mapped")  # an answer too: how good its digits are
        try:
            return call(*args, **knobs)
        except ValueError as refusal:
            require_own_words(refusal)
            raise Refused(str(refusal)) from refusal


def require_own_words(refusal):
    """A refusal is raised by a line of the library that says so, and its words fit on a line."""
    last = traceback.extract_tb(refusal.__traceback__)[-1]
    where = f"{refusal!r} at {last.filename}:{last.lineno}"
    assert last.filename in LIBRARY, f"not the library's own words: {where}"
    assert "raise" in LIBRARY[last.filename][last.lineno - 1], f"not the library's own words: {where}"
    message = str(refusal)
    assert message.strip(), "a refusal without words"
    assert len(message) <= LONGEST or isinstance(refusal, mdr.CaseFileError), f"{len(message)} characters: {message}"
    assert not re.search(r"\bnan\b", message.lower()), message


def finite(*answers):
    for one in answers:
        assert np.all(np.isfinite(one)), f"not finite: {one!r}"


# --- questions, the quick ones first ---


def identity(case, dice):
    """Records compare, hash, print and pickle; a file brings an equal case back."""
    for part in (case.material, case.oscillation, case.pull):
        assert eval(repr(part), vars(mdr)) == part == copy.deepcopy(part)
    again = pickle.loads(pickle.dumps(case))
    if isinstance(case.indenter, mdr.Profile):
        try:
            mdr.write_case(case)
        except mdr.CaseFileError:
            return
        raise AssertionError("a Profile was written to a file")
    assert again == case
    assert hash(again) == hash(case)
    text = mdr.write_case(case)
    assert mdr.parse_case(text) == case


def numbers(case, dice):
    """What the record itself knows, once its depth is known."""
    case = mdr.resolved(case)
    knows = ("k_zc", "k_xc", "gamma_zc", "gamma_xc", "T", "unit_velocity", "u_z_max", "kept_gap", "working_depth")
    for name in knows:
        finite(getattr(case, name))
    assert case.u_z_max > 0
    assert case.unit_velocity > 0
    assert case.k_zc >= 0
    omega = case.oscillation.omega
    finite(case.dynamic_stiffness([omega, 2 * omega]))
    one, two = (case.material.dynamic_modulus(n * omega) for n in (1, 2))
    assert one.real > 0
    assert one.imag >= 0
    assert two.real >= one.real * (1 - ROUNDING)


def shape(case, dice):
    """a, F_N, k_zc and g rise with depth; p is finite and presses."""
    one, deepest, E_star = case.indenter, case.u_z_max, case.material.E_star
    d = np.unique(np.maximum(deepest * np.geomspace(1e-6, 1, 9), one.least_depth))
    a, F = one.contact_radius(d), one.force(d, E_star)
    k = one.stiffness(d, E_star)
    finite(a, F, k)
    assert np.all(np.diff(a) >= -ROUNDING * a[-1])
    assert np.all(np.diff(F) >= -ROUNDING * F[-1])
    assert np.all(F >= 0)
    assert F[-1] > 0
    np.testing.assert_allclose(k, 2 * E_star * a, rtol=1e-12)
    x = a[-1] * np.linspace(0, 1, 9)
    g, f = one.profile_1d(x), one.profile_3d(x)
    p = one.pressure(x, deepest, E_star)
    finite(g, f, p)
    assert np.all(p >= 0), p
    if not one.least_depth:
        assert np.all(np.diff(g) >= -ROUNDING * g[-1])
        # a radius is a float: at the rim of a wide flat face the next one is deeper by more than rounding
        beyond = float(one.profile_1d(min(np.nextafter(a[-1], np.inf), one.max_radius)))
        assert np.all(g <= max(deepest, beyond) * (1 + ROUNDING))
        assert np.all(f >= -ROUNDING * deepest)


def velocities(case, dice):
    """Critical velocities are numbers, infinite only on an undamped resonance, or where a light body jolts."""
    eq_15 = mdr.critical_velocity(case)
    assert eq_15 >= 0
    assert not math.isinf(eq_15) or on_resonance(case)
    full = mdr.full_slip_critical_velocity(case)
    assert full >= 0
    assert not math.isinf(full) or on_resonance(case) or jolts(case)


def on_resonance(case):
    """An undamped body whose natural frequency is that of a harmonic, or a mass that the load moves on the contact."""
    pull, omega = case.pull, case.oscillation.omega
    if isinstance(pull, SpringPull) and pull.m > 0 and pull.c_x == 0:
        ratio = pull.omega_0 / omega
        if round(ratio) >= 1 and abs(ratio / round(ratio) - 1) < 1e-11:
            return True
    m_z = getattr(case.oscillation, "m_z", 0.0)
    rest = at_rest(case)
    return m_z > 0 and abs(rest.dynamic_stiffness(omega) - m_z * omega**2) <= 1e-12 * rest.k_zc


def jolts(case):
    """Neither mass nor damper, and dashpots that touch."""
    pull, keeps = case.pull, mdr.resolved(case).keeps_contact
    return isinstance(pull, SpringPull) and pull.m == pull.c_x == 0 and case.T > 0 and not keeps


def static(case, dice):
    """The static limit lies between nothing and mu_0."""
    cof = mdr.static_cof(case)
    assert 0 <= cof <= case.mu_0 * (1 + ROUNDING), cof / case.mu_0


def curve(case, dice):
    """Under a rigid pull, in closed form: between the static limit and mu_0, and never falling with velocity."""
    if case not in domain_of(average_friction):
        return
    v = case.unit_velocity * np.array([0, 1e-9, 1e-6, 1e-3, 0.1, 0.5, 0.9, 0.999, 1.0, 1.1, 1e3])
    found = mdr.cof_curve(case, v)
    finite(found.cof, found.cof_error, found.stick_share, found.v_c)
    slack = found.cof_error.max() + ROUNDING * case.mu_0
    assert np.all(found.cof >= found.static_cof - slack), found.cof / case.mu_0
    assert np.all(found.cof <= case.mu_0 + slack), found.cof / case.mu_0
    assert np.all(np.diff(found.cof) >= -slack), found.cof / case.mu_0
    assert np.all((found.stick_share >= -ROUNDING) & (found.stick_share <= 1 + ROUNDING)), found.stick_share


def held(case, dice):
    """Pulled at rest: friction between nothing and mu_0 F_z, a loop that loses energy, fields that press."""
    d = mdr.resolved(case).u_z_max
    U = case.mu_0 * case.material.mindlin_ratio * d * dice.size(1e-6, 10.0)
    found = mdr.partial_slip(case.indenter, case.material, case.mu_0, d, [0.0, U / 2, U])
    most = case.mu_0 * found.F_z * (1 + ROUNDING)
    finite(found.F_x, found.F_z, found.stick_radius)
    assert np.all((found.F_x >= -ROUNDING * most) & (found.F_x <= most))
    assert np.all(np.diff(found.F_x) >= -ROUNDING * most)
    assert np.all(np.diff(found.stick_radius) <= ROUNDING * found.stick_radius[0])
    loop = mdr.tangential_loop(case.indenter, case.material, case.mu_0, d, U, n=9)
    finite(loop.u_x, loop.F_x, loop.loss)
    assert np.all(np.abs(loop.F_x) <= most)
    assert loop.loss >= -ROUNDING * most * U
    if dice.happens(0.2):
        fields = mdr.surface_fields(found, i=-1)
        finite(fields.pressure, fields.traction, fields.u_z, fields.u_x)
        assert np.all(fields.pressure >= 0)
        slack = ROUNDING * fields.pressure.max()
        assert np.all(np.abs(fields.traction) <= case.mu_0 * (fields.pressure + slack))


def pressed(case, dice):
    """Normal contact alone, under any history of depth or of force."""
    n, t = 2 + dice.below(8), dice.size(1e-3, 1e3) / case.oscillation.omega
    instants = t * np.cumsum([dice.share() for _ in range(n)])
    heights, d = np.array([dice.between(-0.3, 1) for _ in range(n)]), mdr.resolved(case).u_z_max
    if dice.happens(0.5):
        found = mdr.indent(case.indenter, case.material, instants, d * heights)
    else:
        F_z = float(case.indenter.force(d, case.material.E_star)) * np.maximum(heights, 0)
        found = mdr.indent(case.indenter, case.material, instants, F_z=F_z)
    finite(found.u_z, found.F_z, found.contact_radius)
    assert np.all(found.F_z >= 0)
    assert np.all(found.contact_radius >= 0)


# --- runs ---


def velocity(case, dice):
    """A pulling velocity of any size, most of them about the critical one."""
    unit = mdr.resolved(case).unit_velocity
    return unit * dice.one_of([dice.size(1e-6, 1e6), dice.size(0.01, 3.0), dice.size(0.01, 3.0), 1.0])


def coarse_run(case, dice):
    """A run of few springs and steps until it settles."""
    n, steps = dice.one_of([32, 48, 64]), dice.one_of([64, 96, 128])
    # of companions with half the steps, which bound the error, each harmonic must have some, or they agree by chance
    steps *= len(getattr(case.oscillation, "cos", "x"))
    start = "rest" if dice.happens(0.2) else "full_slip"
    knobs = {"n_springs": n, "steps_per_period": steps, "start": start, "lump": not dice.happens(0.2)}
    run = mdr.slide(case, velocity(case, dice), record=1, **knobs)
    judge(case, run)


def short_run(case, dice):
    """A run of a few periods from any start, whether it settles or not."""
    run = mdr.slide(
        case,
        velocity(case, dice),
        n_springs=16 + dice.below(50),
        steps_per_period=16 + dice.below(100),
        n_periods=1 + dice.below(12),
        start=dice.one_of(["rest", "full_slip"]),
        record=1,
    )
    judge(case, run)


def judge(case, run):
    """Within the bounds of physics, and frank where it did not settle."""
    mu_0, balance = case.mu_0, run.energy_balance
    finite(run.cof, run.cof_error, run.stick_share, run.least_slip, run.mean_F_x, run.mean_F_z)
    energies = [value for name, value in vars(balance).items()]
    finite(*energies)
    assert run.mean_F_z > 0
    assert run.cof_error > 0
    assert 0 <= run.stick_share <= 1 + ROUNDING, run.stick_share
    assert balance.friction_loss >= -ROUNDING * max(map(abs, energies))
    assert balance.viscous_loss >= -ROUNDING * max(map(abs, energies))
    assert balance.damper_loss >= 0
    recorded(case, run)
    if not run.settled:
        assert run.why, "unsettled without a reason"
        return
    slack = run.cof_error + ROUNDING * mu_0
    assert -slack <= run.cof <= mu_0 + slack, f"cof/mu_0 = {run.cof / mu_0}, error/mu_0 = {run.cof_error / mu_0}"


def recorded(case, run):
    """Springs within the cone of friction, in modes that there are."""
    finite(run.t, run.u_x, run.u_z, run.F_x, run.F_z, run.x, run.width, run.e, run.s, run.f_x, run.f_z)
    assert set(np.unique(run.state)) <= set(mdr.State)
    most = np.abs(run.f_z).max()
    assert np.all(run.f_z >= -ROUNDING * most)
    assert np.all(np.abs(run.f_x) <= case.mu_0 * (run.f_z + ROUNDING * most))
    assert np.all((run.f_z == 0) | (run.state != mdr.State.FREE))
    for whole, each in ((run.F_x, run.f_x), (run.F_z, run.f_z)):
        np.testing.assert_allclose(each.sum(axis=1), whole, rtol=0, atol=ROUNDING * np.abs(run.F_z).max())


def other_units(case, dice):
    """Lengths, times and forces in other units leave friction alone.

    The units are powers of two, so that all numbers keep their digits and only a power or a logarithm rounds
    differently. A run that is chaotic may not settle, and is not compared.
    """
    length, time, force = (2.0 ** (dice.below(41) - 20) for _ in range(3))
    other = random_records.case_in_units(case, length, time, force)
    v_0, knobs = velocity(case, dice), {"n_springs": 32, "steps_per_period": 64}
    ours, theirs = (mdr.slide(one, v, **knobs) for one, v in ((case, v_0), (other, v_0 * length / time)))
    slack = ROUNDING
    if isinstance(case.oscillation, mdr.LoadOscillation) and (case.oscillation.m_z or case.rheology.remembers):
        slack = 1e-3  # this depth is sought until 1e-4 of the load is missing, or less
    assert abs(mdr.static_cof(case) - mdr.static_cof(other)) <= slack * case.mu_0
    if not (ours.settled and theirs.settled):
        return
    assert abs(ours.cof - theirs.cof) <= slack * case.mu_0 + min(ours.cof_error, theirs.cof_error)
    np.testing.assert_allclose(theirs.mean_F_z, ours.mean_F_z * force, rtol=slack)


QUICK = (identity, numbers, shape, velocities, static, curve, held)
RUNS = (pressed, coarse_run, short_run, other_units)


@pytest.mark.parametrize(
    ("question", "n"),
    [*((one, 16) for one in QUICK), *((one, 14) for one in RUNS)],
    ids=lambda one: getattr(one, "__name__", str(one)),
)
def test_any_record_answers_or_says_why_not(question, n):
    for seed in range(n):
        dice = random_records.Dice([RUNS.index(question) if question in RUNS else len(RUNS), seed])
        with contextlib.suppress(Refused):
            case = asked(random_records.contact, dice)
            asked(question, case, dice)


def test_what_is_drawn_is_of_every_kind():
    """The dice reach every shape, material, motion and pull, and most contacts slide; each prints as a few lines."""
    kinds, slide = set(), 0
    for seed in range(130):
        with contextlib.suppress(Refused):
            case = asked(random_records.contact, random_records.Dice(seed))
            assert 6 <= len(str(case).splitlines()) <= 8
            own = {type(part).__name__ for part in (case.indenter, case.material, case.oscillation, case.pull)}
            if seed < 20 or own - kinds:  # as the depth under a load is sought for long
                asked(mdr.resolved, case)
                slide += seed < 20
                kinds |= own
    assert slide > 0.6 * 20
    assert kinds >= {*SHAPES, *MATERIALS, "Profile", "NormalOscillation", "PeriodicMotion", "LoadOscillation"}
    assert kinds >= {"RigidPull", "SpringPull"}
