"""The closed form of a shaken pull against a march written from the law of a spring, its limits and invariances."""

import math
from itertools import pairwise

import numpy as np
import pytest
from conftest import SHAPES, contact, unit_of_velocity
from numpy.testing import assert_allclose
from twins import rigid_pull as reference
from twins import turning as twin
from twins.tiny_steps import period

import mdr
from mdr.closed_forms import rigid_pull, shaken_pull, shaken_spring
from mdr.closed_forms.full_slip import static_cof
from mdr.closed_forms.shaken_pull import ShakenPull, average_friction

UNIT, ERROR = 2e-6, 1e-9
NONE, COS = np.zeros(0, complex), np.ones(1, complex)
TWO = np.array([0.7 * np.exp(1j), 0.3 * np.exp(2j)])  # of z with two harmonics
DIRECTIONS = (0, np.pi / 2, np.pi, 0.7)  # phase of x against z


def pull_of(shape, depth_ratio, Z, X, T=0.0):
    indenter = SHAPES[shape][0] if isinstance(shape, str) else shape
    return ShakenPull(indenter, depth_ratio * UNIT, UNIT, np.asarray(Z, complex), np.asarray(X, complex), T)


def shaken(amplitude, phase=0.0):
    return np.array([amplitude * np.exp(1j * phase)])


def both_ways(pull, v):
    """Friction, error and share of stick at velocities of either sign: that of the mirrored pull the other way."""
    v = np.atleast_1d(v)
    there, back = (average_friction(one, np.abs(v)) for one in (pull, pull.mirrored))
    friction, error, sticks = np.where(v < 0, back, there)
    return np.where(v < 0, -friction, friction), error, sticks


def cof(pull, v):
    return both_ways(pull, v)[0]


def band(pull):
    """Friction in the limits v -> -0 and v -> +0."""
    return -average_friction(pull.mirrored, [0.0])[0][0], average_friction(pull, [0.0])[0][0]


# --- the twin: small steps through many periods -------------------------------


def over_a_period(harmonics, steps):
    n, phase = np.arange(1, len(harmonics) + 1), 2 * np.pi * np.arange(steps + 1) / steps
    return (np.asarray(harmonics)[:, None] * np.exp(1j * n[:, None] * phase)).real.sum(axis=0)


def springs_of(pull, n_panels):
    """Gaps and weights of an array, cut at kinks and where springs begin to leave; a punch is one spring."""
    if isinstance(pull.shape, mdr.FlatPunch):
        return -np.ones(1) * pull.u_z0 / pull.unit, np.ones(1)
    z = over_a_period(pull.Z, 1000)
    depths = [z.max()] if pull.shape.least_depth > 0 else [z.min(), z.max()]
    edges = [float(pull.shape.contact_radius(max(pull.u_z0 + pull.unit * c, 0))) for c in depths]
    breaks = np.unique([0.0, *edges, *(x for x in pull.shape.kinks if x < edges[-1])])
    fine = [np.linspace(a, b, n_panels + 1) for a, b in pairwise(breaks)]
    x, w = reference.gauss_panels(np.unique(np.concatenate(fine)), 6)
    return (np.asarray(pull.shape.profile_1d(x)) - pull.u_z0) / pull.unit, w


RIGID = twin.Body(np.zeros(2), np.zeros(2), np.full(2, math.inf))


def marched(cases, steps, periods, n_panels=12):
    """Mean friction over mu_0 times mean force by the twin's steps, of dashpots without their error of first order."""
    for pull, v in cases:
        row, law, found = twin.Row(*springs_of(pull, n_panels)), twin.Law(pull.T, np.zeros(0), np.zeros(0)), []
        for n in (steps // 2, steps):
            motion = twin.motion_of(pull.Z, pull.X, [], v, n)
            state = twin.at_rest(row, law, motion, RIGID)
            f_x, _, p = [period(row, law, motion, RIGID, state) for _ in range(periods)][-1]
            found.append(f_x / p)
        yield 2 * found[1] - found[0] if pull.T else found[1]


def assert_agree(cases, known, atol):
    found, known = np.array([[row[0] for row in both_ways(pull, v)] for pull, v in cases]), np.array(list(known))
    assert np.all(found[:, 1] < ERROR)
    assert_allclose(found[:, 0], known, rtol=0, atol=atol)
    assert np.mean(np.abs(known) < 0.97) > 0.6  # most of them stick for a while


def some_motion(rng, Z):
    """x and a velocity up to that above which all slips, and beyond it."""
    X = shaken(10 ** rng.uniform(-0.5, 1), rng.choice(DIRECTIONS))
    if rng.random() < 0.3:
        X = np.r_[X, 0.4 * np.exp(1j * rng.uniform(0, 6))]
    greatest = (
        np.max(np.diff(over_a_period(np.pad(Z, (0, 2 - len(Z))) - np.pad(X, (0, 2 - len(X))), 1000))) * 1000 / 6.28
    )
    return X, rng.choice([-1, 1]) * rng.choice([rng.uniform(0, 0.2), rng.uniform(0.2, 1.1)]) * greatest


def some_springs(n, T):
    rng = np.random.default_rng(3)
    for i in range(n):
        Z = (NONE, COS, COS, TWO)[i % 4]
        depth_ratio = rng.uniform(0.1, 3) if len(Z) == 0 or rng.random() < 0.5 else rng.uniform(-0.5, 1)
        X, v = some_motion(rng, Z)
        yield pull_of("flat", depth_ratio, Z, X, rng.choice(T)), v


def test_a_period_tells_what_more_extension_makes_of_it():
    """Newton's method rests on the one derivative, and its last step on the other."""
    for pull, v in some_springs(24, (0.05, 0.3, 0.8)):
        given, gap = (pull if v > 0 else pull.mirrored)._harmonics, -pull.u_z0 / pull.unit
        cuts, points = shaken_spring._cuts(given, abs(v))
        law = given, abs(v), gap
        n, _, _ = shaken_spring._follow(*law, cuts, points)
        top = cuts[0, 1] - gap
        low, at, high = (shaken_spring._period(*law, points, n, top * (0.3 + off)) for off in (-1e-6, 0.0, 1e-6))
        rate = (np.array(high[:2]) - low[:2]) / (2e-6 * top)
        assert_allclose([1 - at[3], at[4]], rate, rtol=0, atol=1e-5)


@pytest.mark.parametrize("T", [0.0, 0.3])
@pytest.mark.parametrize("depth", [2.5, 40.0])
def test_the_band_is_the_limit_of_slow_pulls_wherever_the_search_begins(depth, T):
    """Kept Kelvin springs at rest have many periodic states, and only one of them is this limit."""
    for shape in ("paraboloid", mdr.ConcavePunch(a=1e-3, R=1.0)):
        pull = pull_of(shape, depth, COS, shaken(0.5, 1.5), T)
        low, high = band(pull)
        slow = cof(pull, [-1e-9, 1e-9, 0.1])
        assert_allclose([low, high], slow[:2], rtol=0, atol=1e-5)
        assert_allclose(cof(pull, [0.3, 0.1, 0.0])[2], high, rtol=0, atol=1e-9)


def test_kelvin_springs_against_a_solver_of_differential_equations():
    cases = list(some_springs(12, (0.05, 0.3, 0.8)))
    means = (twin.spring(-one.u_z0 / one.unit, one.Z, one.X, one.T, v) for one, v in cases)
    assert_agree(cases, (e / s for e, s in means), 1e-10)


@pytest.mark.parametrize(("T", "steps", "periods"), [(0.0, 1200, 2), (0.5, 3000, 4)])
def test_arrays_against_the_twin(T, steps, periods):
    rng, cases = np.random.default_rng(4), []
    for shape in ("cone", "paraboloid", "r4", mdr.TruncatedCone(b=2e-5, theta=0.02)):
        for Z, depth_ratio in ((NONE, 1.0), (COS, 2.5), (COS, 0.5), (TWO, 0.3)):
            X, v = some_motion(rng, Z)
            cases.append((pull_of(shape, depth_ratio, Z, X, T), v))
    assert_agree(cases, marched(cases, steps, periods, n_panels=50), 4e-5)  # a kink within a panel of the twin


def test_a_hollow_face_against_the_twin():
    shape = mdr.ConcavePunch(a=1e-3, R=1.0)  # in complete contact from 1e-6 m on
    cases = [(pull_of(shape, 2.0, COS, shaken(amplitude, 0.7)), v) for amplitude, v in ((1.0, 0.3), (4.0, -0.7))]
    assert_agree(cases, marched(cases, 2000, 2), 3e-6)


# --- known cases ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("T", [0.0, 0.4, 3.0])
@pytest.mark.parametrize(("shape", "depth_ratio"), [("flat", 3.0), ("paraboloid", 1.2), ("cone", 0.4), ("r4", -0.5)])
def test_without_shaking_it_is_the_rigid_pull(shape, depth_ratio, T):
    case = contact(shape, depth_ratio, T)
    v = np.array([1e-9, 1e-3, 0.04, 0.3, 0.8, 0.99, 1.3])
    known = rigid_pull.average_friction(case, v * unit_of_velocity(case))
    found, error, sticks = average_friction(pull_of(shape, depth_ratio, COS, NONE, T), v)
    assert np.all(np.abs(found - known.cof / case.mu_0) < error + known.cof_error / case.mu_0)
    assert np.all(error < ERROR)
    assert_allclose(sticks, known.stick_share, rtol=0, atol=1e-7)  # its instants are not squared
    limit = static_cof(case) / case.mu_0
    assert_allclose(band(pull_of(shape, depth_ratio, COS, NONE, T)), [-limit, limit], rtol=0, atol=1e-8)


@pytest.mark.parametrize("T", [0.0, 0.5])
@pytest.mark.parametrize(("shape", "Z"), [("paraboloid", COS), ("cone", TWO)])
def test_all_slips_above_the_greatest_closing_speed(shape, Z, T):
    X = shaken(2.0, 0.7)
    closing = over_a_period(Z, 100_000) - over_a_period(np.pad(X, (0, len(Z) - 1)), 100_000)
    v_c = np.diff(closing).max() * 100_000 / (2 * np.pi)
    found, _, sticks = average_friction(pull_of(shape, 4.0, Z, X, T), v_c * np.array([1.0001, 5.0, 0.97]))
    assert_allclose(found[:2], 1, rtol=0, atol=1e-15)
    assert np.all(sticks[:2] < 1e-12)  # a touch takes a moment, by rounding
    assert found[2] < 1 - 1e-6
    assert sticks[2] > 0.03


@pytest.mark.parametrize("T", [0.0, 0.5])
def test_the_stated_error_holds(T, monkeypatch):
    pulls = [pull_of(shape, 0.9, COS, shaken(1.2, 0.7), T) for shape in ("cone", "paraboloid")]
    v = np.geomspace(1e-3, 1, 12)
    found = [average_friction(pull, v) for pull in pulls]
    monkeypatch.setattr(shaken_pull, "TOLERANCE", 1e-13)
    for pull, (value, error, _) in zip(pulls, found, strict=True):
        assert np.all(np.abs(cof(pull, v) - value) < error)


def test_it_never_touches():
    with pytest.raises(ValueError, match="the indenter never touches"):
        average_friction(pull_of("cone", -1.5, COS, NONE), np.ones(1))
    assert math.isfinite(band(pull_of("cone", -0.999, COS, NONE))[1])


@pytest.mark.parametrize("phase", [0.5, 1.5, 2.5])
def test_a_long_way_beside_a_contact_of_an_instant_is_in_the_error(phase):
    """All slips; but a way 1e12 times the depth has integrals whose digits are lost where they are subtracted."""
    pull = pull_of("paraboloid", 5.6e-11 - 1, COS, shaken(20.0, phase))
    found, error, _ = average_friction(pull, [50.0])
    assert abs(found - 1) <= error
    kept = average_friction(pull_of("paraboloid", 0.5, COS, shaken(20.0, phase)), [50.0])
    assert abs(kept[0] - 1) < 1e-13
    assert kept[1] < ERROR
