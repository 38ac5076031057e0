"""The contact as an element: pure steps, energy, invariance, the tangent, and what is refused."""

import pickle
from dataclasses import replace

import numpy as np
import pytest
from elements import BALL, DEPTH, ELASTIC, KELVIN, MATERIALS, MU_0, REACH, element, every_material, walk
from numpy.testing import assert_allclose, assert_array_equal

import mdr
from mdr.element.c_header import header
from mdr.element.kernels import N_HEAD

DT = 1e-3


def follow(contact, us, state=None, dt=DT):
    state, forces = contact.at_rest((0, 0, DEPTH / 2)) if state is None else state, []
    for u in us:
        F, state = contact.step(state, dt, u)
        forces.append(F)
    return np.array(forces), state


# --- what it answers ---


def test_full_slip_and_stick_have_their_closed_forms():
    """Stick: k_x u. Slip: mu_0 F_N, for the springs at the depth of the grid's end, where their sum is exact."""
    contact = element()
    rest = contact.at_rest((0, 0, DEPTH))
    F, _ = contact.step(rest, 0.0, (0, 50 * REACH, DEPTH))
    F_N = BALL.force(DEPTH, ELASTIC.E_star)
    assert_allclose(F, [0, MU_0 * F_N, F_N], rtol=1e-12, atol=1e-15)
    flat = element(shape=mdr.FlatPunch(a=1e-3))
    assert flat.n_state == N_HEAD + 3 + 1
    F, _ = flat.step(flat.at_rest((0, 0, DEPTH)), 0.0, (-0.3 * REACH, 0, DEPTH))
    assert_allclose(F[0], -0.3 * REACH * 2e-3 * ELASTIC.G_star, rtol=1e-12)


def test_partial_slip_is_that_of_the_closed_form():
    d, way = 0.8 * DEPTH, 0.4 * REACH
    exact = mdr.partial_slip(BALL, ELASTIC, MU_0, d, way)
    contact = element(n_springs=256)
    F, _ = contact.step(contact.at_rest((0, 0, d)), 0.0, (way, 0, d))
    assert_allclose(F[[0, 2]], [exact.F_x, exact.F_z], rtol=3e-5)  # third order in 1/n, of the jumps at two edges


@every_material
def test_a_contact_at_rest_does_not_creep(material):
    """Held at 0.999 mu_0 F_N: a state that a step leaves as it is stays. What viscous springs do at rest is over."""
    contact = element(material, shape=mdr.FlatPunch(a=1e-3))
    u = np.array([0.999 * MU_0 * ELASTIC.mindlin_ratio * DEPTH / 2, 0, DEPTH / 2])
    _, state = contact.step(contact.at_rest((0, 0, DEPTH / 2)), 1e3, u)
    F, state = contact.step(state, 1e3, u)
    assert 0.9989 < F[0] / (MU_0 * F[2]) < 0.9991
    held = state
    for _ in range(1000):
        G, held = contact.step(held, 1e-3, u)
    assert_allclose(G, F, rtol=1e-15)
    assert_allclose(held, state, rtol=1e-15, atol=1e-300 if material is ELASTIC else 1e-15)


def test_an_open_contact_forgets():
    contact = element(MATERIALS["arms"])
    _, state = follow(contact, walk(2)[1][:10])
    F, state = contact.step(state, 1.0, (0, 0, -1e-6))
    assert_array_equal(F, 0)
    assert np.abs(state[N_HEAD:-1]).max() < 1e-12  # a second is two hundred of its relaxation times
    assert contact.stored(state) < 1e-20


@pytest.mark.parametrize("shape", [BALL, mdr.FlatPunch(a=1e-3)], ids=["ball", "punch"])
def test_what_is_lifted_straight_up_has_no_force_in_the_plane(shape):
    """At once or in many steps; with a dashpot and arms the limit of friction comes to zero while nothing pulls."""
    contact = element(mdr.Prony(E_inf=2e6, arms=((1e6, 2e-3),), nu=0.3, tau=5e-4), shape)
    n = contact._row.gap.size
    rest = contact.at_rest((0, 0, DEPTH))
    lifts = [(dt, (part,)) for dt in (1e-5, 1e-3, 1e-2) for part in (0.99, 0.6, 0.1)]
    for dt, parts in [*lifts, (1e-4, np.linspace(0.9, 0.2, 30))]:
        state = rest
        for part in parts:
            F, state = contact.step(state, dt, (0, 0, part * DEPTH))
            assert_array_equal(F[:2], 0)
            assert_array_equal(state[N_HEAD + 2 * n : -1], 0)
        assert np.all(np.isfinite(state))


def some_materials(rng):
    """Materials of all kinds, times over six decades."""
    tau, arms = 10.0 ** rng.uniform(-6, 0), [(10.0 ** rng.uniform(4, 8), 10.0 ** rng.uniform(-6, 1)) for _ in range(3)]
    return [
        ELASTIC,
        mdr.KelvinVoigt(E=3e6, nu=0.3, tau=tau),
        mdr.StandardLinearSolid(E_inf=3e6, E_1=arms[0][0], tau_1=tau, nu=0.3),
        mdr.Prony(E_inf=3e6, arms=arms, nu=0.3),
        mdr.Prony(E_inf=3e6, arms=arms, nu=0.3, tau=tau),
    ]


def some_way(rng, u):
    """Where a host may go next: nowhere, up or down, away, back to the start, on, or over any distance."""
    over = rng.normal(size=2) * [1, rng.integers(2)] * REACH * 10.0 ** rng.uniform(-3, 1.5)
    ways = [u, [*u[:2], rng.uniform(-1, 1) * DEPTH], [*u[:2], -DEPTH], [0, 0, DEPTH], [*(u[:2] + over), u[2]], -u]
    return np.minimum(ways[rng.integers(len(ways))], [np.inf, np.inf, DEPTH])


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("kind", range(5), ids=["elastic", "Kelvin", "SLS", "arms", "arms and dashpot"])
def test_no_step_answers_nan(kind):
    """Random steps over six decades of time; every state is taken for the next step, so that it is possible too."""
    rng = np.random.default_rng(7)
    for shape in (BALL, mdr.FlatPunch(a=1e-3), mdr.Cone(theta=0.05)) * 4:
        contact = element(some_materials(rng)[kind], shape, n_springs=16)
        state = contact.at_rest((0, 0, rng.choice([0.5, 0, -1]) * DEPTH))
        for _ in range(15):
            dt, tangent = 10.0 ** rng.uniform(-6, 0), bool(rng.integers(2))
            answer = contact.step(state, dt, some_way(rng, state[:3]), tangent=tangent)
            state = answer[1]
            assert all(np.all(np.isfinite(one)) for one in (*answer, contact.dissipated(state)))


# --- friction that falls ---


@pytest.mark.parametrize("material", [ELASTIC, KELVIN], ids=["elastic", "Kelvin"])
def test_ten_thousand_random_steps_of_friction_that_falls_lose_energy(material):
    """No NaN, and no step gives back heat but for rounding."""
    rng = np.random.default_rng(11)
    for shape, n in ((BALL, 2000), (mdr.FlatPunch(a=1e-3), 3000)):
        contact = mdr.ContactElement(shape, material, MU_0, u_z_max=DEPTH, n_springs=16, mu_s=1.6 * MU_0)
        state, lost = contact.at_rest((0, 0, DEPTH / 2)), 0.0
        for _ in range(n):
            F, state = contact.step(state, 10.0 ** rng.uniform(-6, 0), some_way(rng, state[:3]))
            now = float(contact.dissipated(state))
            assert np.all(np.isfinite(F))
            assert now >= lost - 1e-15 * (now + float(contact.stored(state)))
            lost = now
        assert lost > 0


def test_a_spring_sticks_up_to_the_static_limit_and_its_mode_is_part_of_the_state():
    """Both forces on one way are the same, and a state that is taken back goes on as it did."""
    contact = mdr.ContactElement(mdr.FlatPunch(a=1e-3), ELASTIC, MU_0, u_z_max=DEPTH, mu_s=1.5 * MU_0)
    state, pulled = contact.at_rest((0, 0, DEPTH)), []
    for x in (1.4, 1.6, 1.6, 1.7, 2.0, 2.2):  # over the way to slip: let go, a rest, stick again, and again let go
        F, state = contact.step(state, 0.0, (x * REACH, 0, DEPTH))
        pulled.append(F[0] / (MU_0 * F[2]))
    assert_allclose(pulled, [1.4, 1.0, 1.0, 1.1, 1.4, 1.0], rtol=1e-12)
    slips, sticks = state.copy(), state.copy()
    sticks[contact.state_names.index("mode[0]")] = mdr.State.STICK
    F = [contact.step(one, 0.0, (2.3 * REACH, 0, DEPTH))[0][0] for one in (slips, sticks)]
    assert_allclose(F[1], 1.1 * F[0], rtol=1e-12)


def test_the_tangent_where_friction_falls_is_that_of_the_force():
    """In steps in which some springs are let go, along the way that goes on: next to where others are."""
    contact = mdr.ContactElement(BALL, ELASTIC, MU_0, u_z_max=DEPTH, n_springs=16, mu_s=1.5 * MU_0)
    state, d, soft = contact.at_rest((0, 0, DEPTH)), 1e-7 * REACH, []
    for x in REACH * np.arange(0.07, 2.0, 0.14):
        F, new, K = contact.step(state, 0.0, (x, 0, DEPTH), tangent=True)
        ahead, _ = contact.step(state, 0.0, (x + d, 0, DEPTH))
        assert_allclose(K[:, 0], (ahead - F) / d, rtol=0, atol=1e-5 * contact._row.force_x / contact._row.length_x)
        state, soft = new, [*soft, K[0, 0]]
    assert soft[0] > 0
    assert abs(soft[-1]) < 1e-6 * soft[0]


def test_other_numbers_of_friction_that_falls_are_refused():
    with pytest.raises(ValueError, match=r"mu_s = 0\.4 must not be below mu_0 = 0\.5: raise mu_s"):
        mdr.ContactElement(BALL, ELASTIC, MU_0, u_z_max=DEPTH, mu_s=0.4)
    with pytest.raises(ValueError, match=r"not one with Maxwell arms, got Prony: ask slide_record along x"):
        mdr.ContactElement(BALL, MATERIALS["arms"], MU_0, u_z_max=DEPTH, mu_s=0.6)
    with pytest.raises(ValueError, match=r"one coefficient of friction can be exported"):
        header(mdr.ContactElement(BALL, ELASTIC, MU_0, u_z_max=DEPTH, mu_s=0.6), "ball", "")
    plain = mdr.ContactElement(BALL, ELASTIC, MU_0, u_z_max=DEPTH, mu_s=MU_0)
    assert plain.state_names == element(n_springs=256).state_names


# --- a state ---


@every_material
def test_copies_pickles_and_rolled_back_states_continue_bit_for_bit(material):
    contact, (_, us) = element(material), walk(2)
    _, half = follow(contact, us[:20])
    kept = half.copy()
    forces, end = follow(contact, us[20:], half)
    follow(contact, us[:20], half)  # rejected
    assert_array_equal(half, kept)
    contact, half = pickle.loads(pickle.dumps((contact, half)))
    again, same = follow(contact, us[20:], half)
    assert_array_equal(again, forces)
    assert_array_equal(same, end)


@every_material
def test_a_batch_is_single_calls(material):
    contact, us = element(material), np.stack([walk(seed)[1] for seed in (2, 3, 6)], axis=1)
    states = contact.at_rest(np.tile([0, 0, DEPTH / 2], (3, 1)))
    singles = list(states)
    for u in us:
        F, states, K = contact.step(states, DT, u, tangent=True)
        for b in range(3):
            f, singles[b], k = contact.step(singles[b], DT, u[b], tangent=True)
            assert_array_equal(f, F[b])
            assert_array_equal(k, K[b])
        assert_array_equal(singles, states)
    assert_allclose(contact.dissipated(states), [contact.dissipated(one) for one in singles], rtol=1e-12)


def test_names_of_a_state():
    contact = element(MATERIALS["arms"])
    names = contact.state_names
    assert len(set(names)) == len(names) == contact.n_state == N_HEAD + 9 * 48 + 1
    assert (names[:5], names[-2:]) == (("u_x", "u_y", "u_z", "work", "s[0]"), ("e_y_2[47]", "element"))


# --- energy and invariance ---


def test_the_loop_of_force_and_way_is_what_is_lost():
    """Of steady loops in one direction at one depth, by the trapezoidal rule."""
    contact, n = element(), 4000
    way = REACH * np.sin(np.linspace(0, 2 * np.pi, n + 1))
    us = np.column_stack([way, 0 * way, 0 * way + 0.7 * DEPTH])
    _, state = follow(contact, us)
    F, end = follow(contact, us, state)
    loop = np.sum(0.5 * (F[1:, 0] + F[:-1, 0]) * np.diff(way))
    assert_allclose(contact.dissipated(end) - contact.dissipated(state), loop, rtol=1e-6)
    assert_allclose(contact.stored(end), contact.stored(state), rtol=1e-12)


# --- the tangent ---

TANGENTS = {
    "stick": ("elastic", [(0.02, 0.01, 0.5)], 1e-7),
    "slip along": ("elastic", [(2, 0, 0.5), (3, 0, 0.5)], 1e-7),
    "slip turned": ("elastic", [(2, 0, 0.5), (2.3, 0.4, 0.5)], 1e-7),
    "sinks while it slips": ("elastic", [(2, 0, 0.5), (3, 0.2, 0.8)], 1e-7),
    "Kelvin, stick": ("Kelvin", [(0.05, 0.02, 0.5), (0.06, 0.01, 0.501)], 1e-7),
    "Kelvin, slip": ("Kelvin", [(2, 0, 0.5), (2.3, 0.4, 0.52)], 1e-7),
    "arms": ("arms", [(2, 0, 0.5), (2.3, 0.4, 0.52)], 1e-7),
}


@pytest.mark.parametrize(("material", "way", "tol"), TANGENTS.values(), ids=TANGENTS.keys())
def test_the_tangent_is_that_of_the_force(material, way, tol):
    """Against central differences of steps 30 times as large, extrapolated; over the stiffness of the contact."""
    contact, scale = element(MATERIALS[material]), np.array([REACH, REACH, DEPTH])
    *before, u = np.array(way) * scale
    _, state = follow(contact, before)
    _, _, K = contact.step(state, DT, u, tangent=True)
    known = np.empty((3, 3))
    for j in range(3):
        slopes = []
        for d in (6e-4, 3e-4):
            d = d * scale * (np.arange(3) == j)
            slopes.append((contact.step(state, DT, u + d)[0] - contact.step(state, DT, u - d)[0]) / (2 * d[j]))
        known[:, j] = (4 * slopes[1] - slopes[0]) / 3
    assert_allclose(K, known, rtol=0, atol=tol * np.abs(K).max())


@every_material
def test_a_spring_that_touches_soon_is_not_in_the_tangent(material):
    """Approach that ends nearer before a touch than a host can tell: dF_z/du_z is that of the springs in contact."""
    contact = element(material)
    gap, rest = contact._row.gap, contact.at_rest((0, 0, DEPTH / 2))
    after = np.sort(gap)[np.searchsorted(np.sort(gap), 0.6)]
    for near in (3e-6, 1e-7, 1e-8):
        u = np.array([0.3 * REACH, 0.1 * REACH, (after - near) * DEPTH])
        K = contact.step(rest, DT, u, tangent=True)[2]
        known = np.empty((3, 3))
        for j, unit in enumerate((REACH, REACH, -DEPTH)):  # in the plane nothing touches; up on the side of the springs
            known[:, j] = one_sided(contact, rest, u, j, 1e-6 * unit)
        assert_allclose(K, known, rtol=0, atol=1e-6 * np.abs(K).max())


def one_sided(contact, state, u, j, d):
    """dF/du_j by a difference of second order over d and 2 d."""
    F, near, far = (contact.step(state, DT, u + k * d * (np.arange(3) == j))[0] for k in range(3))
    return (4 * near - far - 3 * F) / (2 * d)


def test_a_still_step_is_as_stiff_as_steps_beside_it():
    """Where the springs are at the rim, with an arm: stick, or slip, and nothing in between or beyond."""
    contact = element(mdr.Prony(E_inf=2e6, arms=((1e6, 2e-3),), nu=0.3, tau=5e-4), mdr.Cone(theta=0.05))
    rng = np.random.default_rng(5)
    for _ in range(30):
        state = contact.at_rest((0, 0, DEPTH / 2))
        for _ in range(4):
            u = np.array([*rng.normal(size=2) * 2 * REACH, rng.uniform(0.1, 0.95) * DEPTH])
            _, state = contact.step(state, DT, u)
        F, _, K = contact.step(state, DT, u, tangent=True)
        for j in range(2):
            d = np.copysign(REACH * (np.arange(3) == j), F[j] if F[j] else 1.0)
            beside = [
                (contact.step(state, DT, u + way * d)[0][j] - F[j]) / (way * d[j]) for way in (1e-8, 1e-6, 1e-4, -1e-4)
            ]
            assert min(beside) - 1e-3 * K[2, 2] <= K[j, j] <= max(beside) + 1e-3 * K[2, 2]


# --- what is refused ---

GOOD = (0.0, 0.0, 1e-6)
HOSTILE = {
    "NaN": ({"u": (0.0, np.nan, 0.0)}, "finite"),
    "two numbers": ({"u": (0.0, 0.0)}, "shape"),
    "words": ({"u": ("a", "b", "c")}, "real numbers"),
    "too deep": ({"u": (0.0, 0.0, 41e-6)}, "u_z_max"),
    "a batch for one": ({"u": np.zeros((2, 3))}, "shape"),
    "far away": ({"u": (1.7e308, 0.0, 1e-6)}, "range of floats"),
    "dt < 0": ({"dt": -1e-3}, "negative"),
    "dt NaN": ({"dt": np.nan}, "finite"),
    "tangent 1": ({"tangent": 1}, "True or False"),
    "state NaN": ({"state": "nan"}, "finite"),
    "state of other springs": ({"state": "other"}, "of this element"),
    "state of another shape": ({"state": "shape"}, "of this element"),
    "state of another material": ({"state": "material"}, "of this element"),
    "state of another friction": ({"state": "mu_0"}, "of this element"),
    "state of zeros": ({"state": "zeros"}, "of this element"),
    "state that pulls": ({"state": "pulls"}, "possible"),
    "state beyond u_z_max": ({"state": "deep"}, "possible"),
    "state within the indenter": ({"state": "within"}, "possible"),
    "state at another depth": ({"state": "lifted"}, "possible"),
    "state beyond friction": ({"state": "stretched"}, "possible"),
    "state of a cube": ({"state": "cube"}, "of this element"),
}


@pytest.mark.parametrize(("change", "words"), HOSTILE.values(), ids=HOSTILE.keys())
def test_hostile_steps_are_refused(change, words):
    contact = element()
    rest = contact.at_rest(GOOD)
    states = {
        "nan": np.where(np.arange(rest.size) == 9, np.nan, rest),
        "other": element(n_springs=64).at_rest(GOOD),
        "cube": rest[None, None],
        "shape": element(shape=mdr.Paraboloid(R=5.001e-3)).at_rest(GOOD),
        "material": element(mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-9)).at_rest(GOOD),
        "mu_0": replace(contact, mu_0=MU_0 * (1 + 1e-6)).at_rest(GOOD),
        "zeros": np.zeros(rest.size),
        "pulls": np.where(np.arange(rest.size) == N_HEAD + 40, -1e-6, rest),
        "deep": np.where(np.arange(rest.size) == N_HEAD, 1.001, rest),
        "within": np.where(np.arange(rest.size) == 2, 2 * GOOD[2], rest),
        "lifted": np.where(np.arange(rest.size) == 2, 0.5 * GOOD[2], rest),
        "stretched": np.where(np.arange(rest.size) == N_HEAD + 48, rest[N_HEAD] + 1e-6, rest),
    }
    given = {"state": rest, "dt": DT, "u": GOOD} | change
    if isinstance(given["state"], str):
        given["state"] = states[given["state"]]
    with pytest.raises((ValueError, TypeError), match=words):
        contact.step(**given)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"material": mdr.Prony(E_inf=0.0, arms=((1e6, 1e-3),), nu=0.5)}, "E_inf = 0"),
        ({"indenter": mdr.ConcavePunch(a=1e-3, R=0.1)}, "ring"),
        ({"indenter": mdr.Profile(lambda r: r**2, r_max=1e-4)}, "deeper"),
    ],
)
def test_hostile_elements_are_refused(change, words):
    with pytest.raises((ValueError, TypeError), match=words):
        replace(element(), **change)


def test_a_viscous_step_needs_time():
    contact = element(MATERIALS["Kelvin"])
    with pytest.raises(ValueError, match="dt must be positive"):
        contact.step(contact.at_rest(GOOD), 0.0, GOOD)
    with pytest.raises(ValueError, match="u_z_max"):
        contact.at_rest((0, 0, 1.0))


def test_the_tangent_of_stick_and_of_slip_in_closed_form():
    flat, a = element(shape=mdr.FlatPunch(a=1e-3)), 1e-3
    rest, k_x, k_z = flat.at_rest((0, 0, DEPTH / 2)), 2 * a * ELASTIC.G_star, 2 * a * ELASTIC.E_star
    for x, known in ((0.1, np.diag([k_x, k_x, k_z])), (2.0, [[0, 0, MU_0 * k_z], [0, np.nan, 0], [0, 0, k_z]])):
        K = flat.step(rest, 0.0, (x * REACH, 0, DEPTH / 2), tangent=True)[2]
        known = np.array(known)
        known[np.isnan(known)] = K[1, 1]
        assert_allclose(K, known, rtol=0, atol=1e-8 * k_z)
        assert 0 < K[1, 1] <= k_x * (1 + 1e-8)  # a slip that turns stiffens against it


def test_where_springs_switch_the_tangent_looks_ahead():
    """At rest in full slip: on the way of the slip nothing resists."""
    flat = element(shape=mdr.FlatPunch(a=1e-3))
    _, state = flat.step(flat.at_rest((0, 0, DEPTH / 2)), 0.0, (2 * REACH, 0, DEPTH / 2))
    _, back = flat.step(state, 0.0, (-2 * REACH, 0, DEPTH / 2))
    for slipped, x in ((state, 2), (back, -2)):
        K = flat.step(slipped, 0.0, (x * REACH, 0, DEPTH / 2), tangent=True)[2]
        assert abs(K[0, 0]) < 1e-8 * K[2, 2]
