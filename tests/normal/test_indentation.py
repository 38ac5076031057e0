"""Normal contact alone: closed forms of Lee and Radok, Ting's equations solved by quadrature, limits, invariances."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr.normal.indentation import indent

E_1, TAU = 9e6, 1e-2
MATERIALS = {
    "elastic": mdr.Elastic(E=3e6, nu=0.3),
    "pair": mdr.ElasticPair(E_1=3e6, nu_1=0.3, E_2=5e6, nu_2=0.4),
    "Kelvin": mdr.KelvinVoigt(E=3e6, nu=0.5, tau=TAU),
    "standard": mdr.StandardLinearSolid(E_inf=1e6, E_1=E_1, tau_1=TAU, nu=0.5),
    "Maxwell": mdr.StandardLinearSolid(E_inf=0, E_1=E_1, tau_1=TAU, nu=0.5),
    "arms": mdr.Prony(E_inf=1e6, arms=((5e6, 1e-4), (3e6, 1e-2), (2e6, 1.0)), nu=0.4),
    "arms and dashpot": mdr.Prony(E_inf=1e6, arms=((5e6, 1e-4), (3e6, 1e-2)), nu=0.4, tau=1e-3),
}
SHAPES = {"flat": mdr.FlatPunch(a=1e-3), "cone": mdr.Cone(theta=0.05), "paraboloid": mdr.Paraboloid(R=5e-3)}
DEPTH = 2e-5


def depth_of(shape, V):
    """The depth at which F_N/E* = V, from Boussinesq, Sneddon and Hertz."""
    return {
        "flat": V / 2e-3,
        "cone": np.sqrt(np.pi * math.tan(0.05) * V / 2),
        "paraboloid": (0.75 * V / math.sqrt(5e-3)) ** (2 / 3),
    }[shape]


# --- closed forms ---


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("material", MATERIALS)
def test_creep_under_a_step_of_load_is_that_of_lee_and_radok(shape, material):
    body, F = MATERIALS[material], 0.1
    t = np.concatenate([[0.0], np.geomspace(1e-8, 1e4, 61)])
    run = indent(SHAPES[shape], body, t, F_z=np.full(t.size, F))
    expected = depth_of(shape, F * body.creep_compliance(t))
    assert_allclose(run.u_z, expected, rtol=1e-12)  # both are sums of exponentials


@pytest.mark.parametrize("tau", [0.0, 1e-3])
def test_creep_over_many_decades_ends_on_the_long_time_modulus(tau):
    body = mdr.Prony(3e6, [(1e5, float(time)) for time in np.logspace(-9, 9, 30)], 0.5, tau)
    ball, t = mdr.Paraboloid(5e-3), np.concatenate([[0.0], np.geomspace(1e-10, 1e14, 200)])
    F_z = float(ball.force(2e-5, body.E_star))
    crept = mdr.indent(ball, body, t, F_z=np.full(t.size, F_z)).u_z
    assert_allclose(crept, 2e-5 * (body.E_star * body.creep_compliance(t)) ** (2 / 3), rtol=1e-9)
    assert_allclose(crept[-1], 2e-5, rtol=1e-9)
    # pressed, held and let go: the surface relaxes through every decade, and is met again where it stands
    held = mdr.indent(ball, body, [0.0, 1e-3, 1e3, 1e3, 1e6, 1e6], [0.0, 2e-5, 2e-5, -1e-5, -1e-5, 2e-5]).F_z
    assert np.all(held[[1, 2, 5]] > 0)
    assert held[3] == held[4] == 0


@pytest.mark.parametrize("shape", SHAPES)
def test_the_springs_carry_the_load_that_lee_and_radok_creep_under(shape):
    """The depth comes from a closed form, the force from springs each with its own arm and its own first touch."""
    body, F = MATERIALS["standard"], 0.1
    t = np.concatenate([[0.0], np.geomspace(1e-6, 10, 4001)])
    run = indent(SHAPES[shape], body, t, depth_of(shape, F * body.creep_compliance(t)))
    # at an edge that creeps loads fall off within 3 % of the depth, over six springs, from E_1 = 9 E_inf: (3 %/6)² 9/12
    assert_allclose(run.F_z, F, rtol=5e-5)
    assert np.median(np.abs(run.F_z / F - 1)) < 2e-6


def test_an_elastic_contact_has_no_memory():
    t = np.linspace(0, 1, 301)
    u_z = DEPTH * np.sin(7 * t) * np.cos(23 * t)
    for shape in SHAPES.values():
        run = indent(shape, MATERIALS["elastic"], t, u_z)
        F_N = shape.force(u_z, MATERIALS["elastic"].E_star)
        assert_allclose(run.F_z, F_N, atol=1e-12 * F_N.max())
        assert_allclose(run.contact_radius, shape.contact_radius(u_z), atol=1e-12 * run.contact_radius.max())
        back = indent(shape, MATERIALS["elastic"], t, F_z=F_N)
        assert_allclose(back.u_z[F_N > 0], u_z[F_N > 0], atol=1e-9 * DEPTH)  # the force is met to 1e-12 of its peak


# --- Ting ---


@pytest.mark.parametrize("material", ["Kelvin", "standard", "arms", "arms and dashpot"])
def test_after_any_tapping_contact_is_a_disc_and_force_settles_with_the_samples(material):
    """Loss and late return many times over; a spring that misses its return would leave a ring, or a wrong force."""
    forces = []
    for n_t in (501, 4001):
        t = np.linspace(0, 0.1, n_t)
        u_z = DEPTH * (0.5 + np.sin(np.pi * t / 0.01) * np.sin(np.pi * t / 0.037))
        run = indent(SHAPES["paraboloid"], MATERIALS[material], t, u_z, n_springs=256, record=True)
        pressed = run.q_z > 0
        assert np.all(pressed[:, :-1] >= pressed[:, 1:])
        forces.append(run.F_z[:: (n_t - 1) // 500])
    # straight pieces of 1/50 of the stroke miss (pi/50)²/12 of the glassy force; a dashpot feels their kinks, most of
    # all where contact begins or ends between two samples, and at both ends of the history, which have one side
    off = 5e-3 if MATERIALS[material].tau else 1e-3
    assert_allclose(forces[0][1:-1], forces[1][1:-1], atol=off * forces[1].max())


def by_tiny_steps(body, t, u_z, n=2000):
    """Force [N] of the flat punch, one spring, by backward differences."""
    E_j, tau_j = np.array(body.contact_arms).T
    s, x, before, forces = 0.0, np.zeros(E_j.size), 0.0, []
    for dt, after in zip(np.diff(t, prepend=t[0]), u_z, strict=True):
        for u in np.linspace(before, after, n + 1)[1:] if dt else [after]:
            kept = 1 / (1 + dt / n / tau_j)
            q, stiffness = body.E_star * s + (E_j * kept) @ x, body.E_star + E_j @ kept
            ds = (max(q + stiffness * (u - s), 0) - q) / stiffness
            s, x = s + ds, (x + ds) * kept
        before = after
        forces.append(2e-3 * (body.E_star * s + E_j @ x))
    return np.array(forces)


@pytest.mark.parametrize("E_inf", [0.0, 1e2, 1e6])
def test_jumps_of_bodies_far_stiffer_at_first_than_in_the_end_are_those_of_tiny_steps(E_inf):
    body = mdr.Prony(E_inf=E_inf, arms=((5e6, 1e-4), (3e8, 1e-2), (2e6, 1.0)), nu=0.4)
    rng = np.random.default_rng(1)
    t = np.cumsum(np.where(rng.random(30) < 0.4, 0, rng.uniform(1e-3, 2e-2, 30)))
    u_z = DEPTH * rng.uniform(-0.5, 1, 30)
    F_z = by_tiny_steps(body, t, u_z)
    assert np.count_nonzero(F_z > 1e-9 * F_z.max()) > 5
    # of a fast arm, backward differences miss dt/tau_j: 1e-5/1e-4 of what little is left of it
    assert_allclose(indent(SHAPES["flat"], body, t, u_z).F_z, F_z, atol=1e-3 * F_z.max())


# --- limits and invariances ---


def test_under_no_force_the_indenter_lies_on_the_surface():
    body, t = MATERIALS["standard"], np.array([0, 0.01, 0.01, 0.02, 0.2, 2.0])
    for shape in SHAPES.values():
        run = indent(shape, body, t, F_z=[0.1, 0.1, 0, 0, 0, 0], record=True)
        assert np.all(run.contact_radius[2:] == 0)
        assert np.all(run.q_z[2:] == 0)
        g = shape.profile_1d(run.x)
        # the depth is extrapolated in the step of time, which the springs on record are not
        assert_allclose(run.u_z[2:], np.min(run.s[2:] + g, axis=1), atol=1e-4 * run.u_z[2])
        assert np.all(np.diff(run.u_z[2:]) < 0)
        assert run.u_z[-1] < 1e-7 * run.u_z[1]
    # the elastic part springs back at once, the flat punch by F/(2 a E_0); the steps of time before leave 2e-6
    flat = indent(SHAPES["flat"], body, t, F_z=[0.1, 0.1, 0, 0, 0, 0])
    assert flat.u_z[1] - flat.u_z[2] == pytest.approx(0.1 / 2e-3 / body.instantaneous_modulus, rel=1e-5)


def test_a_dashpot_takes_no_jump():
    body, t = MATERIALS["Kelvin"], [0, 0.01, 0.01, 0.02]
    run = indent(SHAPES["paraboloid"], body, t, F_z=[0.1, 0.1, 0.2, 0.2])
    assert run.u_z[0] == 0
    assert run.u_z[1] == run.u_z[2] < run.u_z[3]
    jump = indent(SHAPES["flat"], body, [0, 0, 1], [0, DEPTH, DEPTH])
    assert_allclose(jump.F_z, [0, *2 * [2e-3 * body.E_star * DEPTH]], rtol=1e-12)  # its impulse is left out


def test_a_depth_history_may_never_touch_or_be_one_sample():
    run = indent(SHAPES["cone"], MATERIALS["arms"], [0, 1], [-1e-6, 0])
    assert not run.F_z.any()
    assert not run.contact_radius.any()
    assert not indent(SHAPES["cone"], MATERIALS["arms"], [0, 1], F_z=[0, 0]).u_z.any()
    assert indent(SHAPES["flat"], MATERIALS["elastic"], [0], [DEPTH]).F_z[0] > 0


# --- refusals ---


def test_a_shape_that_ends_before_the_depth_under_a_force_says_so():
    lens = mdr.Profile(lambda r: r**2 / 1e-2, r_max=1e-3)
    with pytest.raises(ValueError, match="F_z = 100 N is more than Profile"):
        indent(lens, MATERIALS["elastic"], [0, 1], F_z=[0, 100.0])
    assert indent(lens, MATERIALS["elastic"], [0, 1], F_z=[0, 0.1]).u_z[1] > 0


@pytest.mark.filterwarnings("error")
def test_a_force_asks_nothing_far_beyond_the_depth_that_it_brings_about():
    """A bowl whose map is no longer exact where it is a thousand times as wide as its bend."""

    def bowl(r):
        u = np.asarray(r) / 2.4e-9
        return 6.6e-13 * u**2 / (np.sqrt(1 + u**2) + 1)

    F_z = float(mdr.Hyperboloid(h=3.3e-13, c=2.4e-9).force(1e-12, 2e6))
    got, expected = (
        indent(one, mdr.Elastic(1e6, 0.5), [0.0, 1.0], F_z=[0.0, F_z])
        for one in (mdr.Profile(bowl), mdr.Hyperboloid(h=6.6e-13, c=2.4e-9))
    )
    assert_allclose(got.u_z, expected.u_z, rtol=1e-6)
