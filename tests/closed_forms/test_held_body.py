"""What a body holds at rest that is shaken: beside a body on one spring in tiny steps, slow runs, and laws by hand."""

import cmath
import math
from dataclasses import replace

import numpy as np
import pytest

import mdr
from mdr.closed_forms.held_body import held_forward
from mdr.friction.shaken import band_of_pull

MU_0, DEPTH, OMEGA = 0.4, 20e-6, 300.0
RUBBER, PUNCH = mdr.Elastic(E=3e6, nu=0.5), mdr.FlatPunch(a=1e-3)
KELVIN = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3)
ARMS = mdr.StandardLinearSolid(E_inf=3e6, E_1=3e6, tau_1=3e-3, nu=0.5)


def contact(shape=PUNCH, material=RUBBER, alpha=0.0):
    motion = mdr.NormalOscillation(DEPTH, alpha * DEPTH, OMEGA) if alpha else mdr.ConstantDepth(DEPTH)
    return mdr.SlidingContact(shape, material, MU_0, motion, shake=mdr.InPlaneOscillation(OMEGA, du_x=1e-9))


def shaken(case, k, ratio, zeta, chi, phases=(0.0,), at="pull", across=0.0):
    """The case on a body: stiffness over that of the contact, natural frequency, damping ratio; force passed on by each
    harmonic over full friction, each half of the one before.
    """
    k_x = k * case.k_xc
    m = k_x / (ratio * OMEGA) ** 2
    c_x = 2 * zeta * math.sqrt(k_x * m)
    n = np.arange(1, len(phases) + 1)
    unit = chi * MU_0 * case.indenter.force(DEPTH, RUBBER.E_star) / abs(k_x + 1j * OMEGA * c_x)
    x = unit * 0.5 ** (n - 1) * np.exp(1j * np.array(phases))
    y = (across * unit,) if across else ()
    shake = mdr.InPlaneMotion(OMEGA, tuple(x.real), tuple(-x.imag), y, at=at)
    side = {"k_y": k_x, "c_y": c_x} if across else {}
    return replace(case, pull=mdr.SpringPull(k_x, m, c_x, **side), shake=shake)


# --- just below it stands, just above it goes: one vector spring and a body, in tiny steps ---


def creep(case, cof, periods=120):
    """Way of the body under a mean force, over the deflection at which its spring slips, in the latter third: a punch
    that keeps contact on an elastic body, in units of the contact's stiffness and of that deflection.
    """
    K, reach, alpha = case.k_xc, case.reach(DEPTH), case.alpha
    (m, c, k), shake = (one / K for one in case.pull.coefficients), case.shake
    fast = math.sqrt((1 + k) / m) / OMEGA
    steps = int(max(400, 12 * fast))
    h = 2 * math.pi / OMEGA / steps
    n_omega = OMEGA * np.arange(1, len(shake.along) + 1)
    passed = [(k + 1j * n_omega * c) * one / reach for one in (shake.along, shake.across)]
    phase = np.outer(2 * np.pi * np.arange(1, steps + 1) / steps, np.arange(1, n_omega.size + 1))
    forces = [(np.exp(1j * phase) @ one).real for one in passed]
    force, limit = (forces[0] + 1j * forces[1]).tolist(), (1 + alpha * np.cos(phase[:, 0])).tolist()
    u, rate, e, places, mean, kept = 0j, 0j, 0j, [], 0j, cof / MU_0
    guided = case.pull.k_y is None
    for _ in range(periods):
        total = 0j
        for p, most in zip(force, limit, strict=True):
            pull = kept + k * mean.real + p - k * u - e  # the mean force that the contact bears is the one asked about
            rate = (rate * (m / h - c / 2) + pull) / (m / h + c / 2)
            if guided:
                rate = complex(rate.real)
            u, e, total = u + h * rate, e + h * rate, total + u
            if abs(e) > most:
                e = cmath.rect(most, cmath.phase(e))
        mean = total / steps
        places.append(mean.real)
    return places[-1] - places[2 * periods // 3]


def drawn(seed):
    """A body: off and near resonance, one harmonic and two, with a normal oscillation beside, shaken across too."""
    rng = np.random.default_rng(seed)
    ratio = rng.uniform(0.97, 1.03) if seed % 3 == 0 else 10 ** rng.uniform(-0.4, 0.6)
    across = 0.8 if seed in (4, 8) else 0.0  # a quarter of a period apart, else it finds its place across slowly
    phases = (np.pi / 2,) if across else tuple(rng.uniform(0, 2 * np.pi, 1 + seed % 2))
    case = contact(alpha=(0.0, 0.0, 0.1, 0.3)[seed % 4])
    return shaken(case, 10 ** rng.uniform(-2.2, -0.8), ratio, rng.uniform(0.1, 0.5), rng.uniform(0.3, 0.5), phases,
                  across=across)  # fmt: skip


@pytest.mark.parametrize("seed", range(10))
def test_below_the_end_of_the_band_a_body_stands_and_above_it_creeps(seed):
    case = drawn(seed)
    high = held_forward(case).cof
    assert abs(creep(case, high - 0.01 * MU_0)) < 1e-9  # of a body that stands, rounding
    assert creep(case, high + 0.01 * MU_0) > 1e-2


# --- shapes, materials: slow runs, whose friction falls to it like the root of the velocity ---


@pytest.mark.parametrize(
    ("shape", "material", "alpha", "at", "k"),
    [
        (mdr.Paraboloid(R=5e-3), RUBBER, 0.0, "pull", 1e-3),
        (mdr.Paraboloid(R=5e-3), RUBBER, 0.2, "pull", 1e-3),  # the edge moves
        (mdr.Cone(theta=0.02), RUBBER, 0.2, "pull", 1e-3),
        (mdr.Cone(theta=0.02), RUBBER, 0.2, "pull", 1e-2),
        (mdr.Paraboloid(R=5e-3), KELVIN, 0.0, "pull", 1e-3),
        (PUNCH, KELVIN, 0.2, "pull", 1e-2),
        (PUNCH, ARMS, 0.2, "pull", 1e-2),
        (mdr.Paraboloid(R=5e-3), ARMS, 0.0, "pull", 1e-3),
        (PUNCH, RUBBER, 0.2, "tool", 1e-2),  # a light body that gives way to its tool
    ],
)
def test_slow_pulls_come_to_the_end_of_the_band(shape, material, alpha, at, k):
    case = shaken(contact(shape, material, alpha), k, 0.6, 0.4, 0.4 if at == "pull" else 0.2, (0.7,), at=at)
    known, slow = held_forward(case), 1e-5 * case.pace
    faster, slower = (mdr.slide(case, v, accuracy=1e-4) for v in (4 * slow, slow))
    assert faster.settled
    assert slower.settled
    least, most = 2 * slower.cof - faster.cof, slower.cof
    error = slower.cof_error + 2e-4 * MU_0  # of dashpots, on which springs slip one after the other
    assert least - error - known.error < known.cof < most + error + known.error
    band = band_of_pull(case)  # where the forces do not tell enough, runs do
    assert least - error - band.error < band.high < most + error + band.error
    assert band.error < 2e-3 * MU_0


STEEL, SOFT = mdr.Elastic(E=210e9, nu=0.3), mdr.Elastic(E=30e6, nu=0.5)


@pytest.mark.parametrize(
    ("R", "material", "load", "close"),
    [
        (5e-3, STEEL, mdr.LoadOscillation(6.0, 1.0, 2 * math.pi * 90), 1e-3),
        (20e-3, SOFT, mdr.LoadOscillation(6.0, 1.0, 2 * math.pi * 90), 0.03),
        (20e-3, SOFT, mdr.ConstantLoad(6.0), 0.01),
    ],
)
@pytest.mark.filterwarnings("ignore::mdr.PlausibilityWarning")
def test_the_bound_of_a_ball_does_not_count_harmonics_that_are_not_there(R, material, load, close):
    """Depths under a load have as many harmonics as are solved for, and hardly a force in them."""
    pull, shake = mdr.SpringPull(15e3, 0.1, 5.0), mdr.InPlaneOscillation(2 * math.pi * 90, du_x=20e-6, at="pull")
    case = mdr.resolved(mdr.SlidingContact(mdr.Paraboloid(R=R), material, 0.3, load, pull, shake))
    known, band = held_forward(case), band_of_pull(case)
    faster, slower = (mdr.slide(case, v * case.pace, accuracy=1e-4) for v in (1e-4, 3e-5))
    assert faster.settled
    assert slower.settled
    least, most = slower.cof - 2 * (faster.cof - slower.cof) - slower.cof_error, slower.cof + slower.cof_error
    for cof, error in ((known.cof, known.error), (band.high, band.error)):
        assert error < close * case.mu_0
        assert least - error < cof < most + error


def test_the_usual_valve_holds_what_its_spring_leaves_of_friction():
    """A stiff contact bears |k + i omega c| du_x; and so much of full friction is chi, whose end is 1."""
    steel, omega, k_x, c_x, du_x = mdr.Elastic(E=115e9, nu=0.3), 2 * np.pi * 120, 20e3, 5.0, 20e-6
    shake = mdr.InPlaneOscillation(omega, du_x=du_x, at="pull")
    pull = mdr.SpringPull(k_x, 0.03, c_x)
    case = mdr.resolved(mdr.SlidingContact(PUNCH, steel, 0.15, mdr.ConstantLoad(5.0), pull, shake))
    passed, stiff = abs(k_x + 1j * omega * c_x) * du_x, 1e-4  # k_x, and m omega², over the stiffness of the contact
    assert case.chi == pytest.approx(passed / 0.75, rel=stiff)
    assert held_forward(case).cof == pytest.approx((0.75 - passed) / 5, rel=stiff)
    loose = replace(case, shake=replace(shake, du_x=1.001 * 20e-6 / case.chi))
    assert loose.chi > 1
    assert held_forward(loose) is None
    assert mdr.holding_band(loose).high < 0.01 * 0.15
    assert mdr.slide(case, 0.0, start="rest").cof == pytest.approx(0.0, abs=held_forward(case).cof)


def test_what_is_held_beside_a_shake_across_is_the_rest_of_the_circle():
    case = shaken(contact(), 1e-2, 0.6, 0.4, 1e-6, across=500e3)
    assert 0.5 < case.eta < 0.52
    assert held_forward(case).cof == pytest.approx(MU_0 * math.sqrt(1 - case.eta**2), rel=1e-5)


def test_a_sawtooth_is_held_one_way_more_than_the_other():
    case = shaken(contact(), 1e-2, 0.6, 0.4, 0.5, (0.0, 0.0))
    forward, back = held_forward(case), held_forward(case.mirrored)
    force = case.borne(case.k_xc)
    time = np.exp(1j * np.outer(np.linspace(0, 2 * np.pi, 20001), [1, 2]))
    over = (time @ force).real / mdr.static_load(PUNCH, RUBBER, DEPTH)
    assert forward.cof == pytest.approx(MU_0 - over.max(), abs=1e-7)  # its own instants
    assert back.cof == pytest.approx(MU_0 + over.min(), abs=1e-7)
    band = mdr.holding_band(case)
    assert (band.low, band.high) == (-back.cof, forward.cof)


def test_an_undamped_body_at_its_resonance_is_held_by_its_contact():
    """Free it would swing without end; stuck it passes on what its spring does."""
    case = shaken(contact(), 1e-2, 1.0, 0.0, 0.5)
    assert case.pace > 1e9
    assert mdr.holding_band(case).high == pytest.approx(0.5 * MU_0, rel=1e-9)  # K bears P, as Z = 0
    assert mdr.no_load_velocity(case) == 0.0
    on_contact = replace(case, pull=replace(case.pull, m=(case.k_xc + case.pull.k_x) / OMEGA**2))
    assert held_forward(on_contact) is None


@pytest.mark.parametrize("pull", [mdr.RigidPull(), mdr.SpringPull(1e3, 0.01, 1.0)], ids=["rigid", "body"])
def test_a_shaken_tool_has_the_band_of_a_rigid_hold_and_its_own_beside(pull):
    case = replace(contact(), pull=pull, shake=mdr.InPlaneOscillation(OMEGA, du_x=0.3 * contact().reach(DEPTH)))
    assert case.chi == pytest.approx(0.3)
    assert mdr.holding_band(case).high == pytest.approx(0.7 * MU_0)
    own = band_of_pull(case).high
    assert own == pytest.approx(0.7 * MU_0) if pull.is_rigid else own > 0.75 * MU_0


def test_what_has_no_such_band_is_asked_of_others():
    assert held_forward(contact()) is None  # a rigid pull
    body = shaken(contact(), 1e-2, 0.6, 0.4, 0.4)
    assert held_forward(replace(body, shake=None, oscillation=mdr.NormalOscillation(DEPTH, 1e-6, OMEGA))) is None
    assert held_forward(replace(body, tau_0=1e3)) is None
    assert held_forward(replace(body, oscillation=mdr.NormalOscillation(DEPTH, 2 * DEPTH, OMEGA))) is None
