"""Friction under a recorded motion: what `slide` has, exact pieces, loads and errors."""

import numpy as np
import pytest
from elements import ARMS, BALL, ELASTIC, KELVIN, MU_0, every_material
from numpy.testing import assert_allclose
from twins.path import followed

import mdr

OMEGA = 314.0
PERIOD = 2 * np.pi / OMEGA


def odd_record(n=60, seed=3):
    """Uneven steps, pauses, jumps and loss of contact: t, u_x, u_y, u_z."""
    rng = np.random.default_rng(seed)
    t = np.cumsum(10 ** rng.uniform(-4, -2, n))
    moves = rng.random((3, n)) > 0.2
    x, y = 2e-5 * np.cumsum(moves[:2] * rng.normal(0, 0.5, (2, n)), axis=1)
    z = 2e-5 * (1 + 1.2 * np.sin(0.3 * np.cumsum(moves[2] * rng.normal(1, 1, n))))
    assert z.min() < 0 < z.max()
    return t, x, y, z


@pytest.mark.parametrize(
    ("material", "du_z", "du_y", "v_0"),
    [(ELASTIC, 28e-6, 0.0, 2.6e-3), (ELASTIC, 28e-6, 6e-6, 1e-3), (KELVIN, 6e-6, 0.0, 1e-3), (ARMS, 28e-6, 6e-6, 1e-3)],
    ids=["elastic, lost", "elastic, across, lost", "Kelvin, kept", "arms, across, lost"],
)
def test_a_harmonic_record_has_the_friction_of_a_run(material, du_z, du_y, v_0):
    """Over the last of some periods. Chords of 256 steps leave out h²/8 of the amplitude: 4e-5 of the friction."""
    shake = mdr.InPlaneOscillation(omega=OMEGA, du_y=du_y) if du_y else None
    case = mdr.SlidingContact(BALL, material, MU_0, mdr.NormalOscillation(20e-6, du_z, OMEGA), shake=shake)
    steps, n, area = 256, 8, []
    for periods in (n - 1, n):
        t = np.arange(periods * steps + 1) * PERIOD / steps
        u_y = du_y * np.cos(OMEGA * t) if du_y else None
        found = mdr.slide_record(
            BALL, material, MU_0, t, v_0 * t, u_y, u_z=20e-6 + du_z * np.cos(OMEGA * t), n_springs=128
        )
        area.append(found.mean_F_z * t[-1] * np.array([found.cof, 1]))
    F_x, F_z = area[1] - area[0]
    run = mdr.slide(case, v_0, accuracy=1e-4)
    assert run.settled
    assert_allclose(F_x / F_z, run.cof, rtol=0, atol=run.cof_error + n * found.cof_error + 4e-5 * MU_0)


@every_material
@pytest.mark.parametrize("across", [False, True], ids=["along", "across"])
def test_an_odd_record_is_that_of_an_element(material, across):
    """A record along one line goes by the scalar step, an element by the vector: they agree."""
    t, x, y, z = odd_record()
    y = y if across else None
    found = mdr.slide_record(BALL, material, MU_0, t, x, y, z, n_springs=64)
    element = mdr.ContactElement(BALL, material, MU_0, u_z_max=z.max(), n_springs=64)
    us, parts = np.column_stack([x, 0 * x if y is None else y, z]), 2 if across else 1
    state = element.at_rest(us[0])
    for k in range(1, t.size):
        for part in range(parts):
            u = us[k - 1] + (part + 1) / parts * (us[k] - us[k - 1])
            F, state = element.step(state, (t[k] - t[k - 1]) / parts, u)
        if material is ELASTIC:
            assert_allclose(F[:2], [found.F_x[k], found.F_y[k]], atol=2e-3 * found.F_z.max())  # its springs: no cut
            assert_allclose(F[2], found.F_z[k], atol=1e-4 * found.F_z.max())
    spent, scale = found.energy_balance, float(element.dissipated(state))
    assert_allclose(spent.lost, scale, rtol=1e-3)
    assert spent.plane_work + spent.normal_work == pytest.approx(spent.lost + spent.stored_change)


@every_material
def test_the_error_bounds_what_a_finer_run_changes(material):
    """The same path, of more samples and springs."""
    path = odd_record()
    coarse = mdr.slide_record(BALL, material, MU_0, *path, n_springs=32)
    at = np.linspace(0, path[0].size - 1, 8 * (path[0].size - 1) + 1)
    fine = mdr.slide_record(
        BALL, material, MU_0, *(np.interp(at, np.arange(path[0].size), one) for one in path), n_springs=512
    )
    assert abs(coarse.cof - fine.cof) <= coarse.cof_error
    assert abs(coarse.cof_y - fine.cof_y) <= coarse.cof_error
    assert fine.cof_error < 0.1 * coarse.cof_error
    assert coarse.cof_error < 2e-3 * MU_0


@pytest.mark.parametrize("seed", range(3, 13))
@pytest.mark.parametrize(
    ("material", "law"),
    [(ELASTIC, {}), (KELVIN, {"T": 1e-3}), (ARMS, {"rho": [2 / 3, 1.0], "theta": [1e-3, 5e-3]})],
    ids=["elastic", "Kelvin", "arms"],
)
def test_ten_odd_records_are_those_of_explicit_steps(material, law, seed):
    """Of first order, extrapolated from two; cells, and what an extrapolation misses, are some 1e-4 of mu_0. Those of
    odd seeds go along a line, which is the scalar step.
    """
    t, x, y, z = odd_record(seed=seed)
    found = mdr.slide_record(BALL, material, MU_0, t, x, None if seed % 2 else y, z)
    y = 0 * y if seed % 2 else y
    gap, off = ((np.arange(120) + 0.5) / 120) ** 2 * z.max(), []
    for parts in (40, 80):
        _, area = followed(gap, t, np.column_stack([x, y, z]), MU_0 * material.mindlin_ratio, parts, **law)
        off.append(MU_0 * area[:, :2].sum(axis=0) / area[:, 2].sum() - [found.cof, found.cof_y])
    coarse, fine = off
    assert np.abs(2 * fine - coarse).max() <= found.cof_error + 0.1 * np.abs(fine - coarse).max() + 2e-4 * MU_0


@pytest.mark.parametrize(
    ("material", "law", "seed"),
    [(ELASTIC, {}, 3), (ELASTIC, {}, 4), (KELVIN, {"T": 1e-3}, 3)],
    ids=["elastic", "elastic, in the plane", "Kelvin"],
)
def test_records_of_a_punch_whose_friction_falls_are_those_of_explicit_steps(material, law, seed):
    """Of first order: what they change where the parts are doubled is what is left."""
    t, x, y, z = odd_record(seed=seed)
    found = mdr.slide_record(mdr.FlatPunch(a=1e-3), material, MU_0, t, x, None if seed % 2 else y, z, mu_s=1.5 * MU_0)
    u, off = np.column_stack([x, 0 * x if seed % 2 else y, z]), []
    for parts in (80, 160):
        _, area = followed(np.zeros(1), t, u, MU_0 * material.mindlin_ratio, parts, **law, stick=1.5)
        off.append(MU_0 * area[:, :2].sum(axis=0) / area[:, 2].sum() - [found.cof, found.cof_y])
    coarse, fine = off
    assert np.abs(fine).max() <= found.cof_error + 2 * np.abs(fine - coarse).max() + 5e-5 * MU_0
    assert np.abs(fine - coarse).max() < 1e-3 * MU_0


def test_arms_in_the_plane_are_refused_where_friction_falls():
    t, x, y, z = odd_record()
    with pytest.raises(ValueError, match="not one with Maxwell arms, got Prony: ask slide_record along x"):
        mdr.slide_record(BALL, ARMS, MU_0, t, x, y, z, mu_s=1.5 * MU_0)


def test_a_harmonic_record_of_friction_that_falls_has_that_of_a_run():
    """Chords of the record let springs go at other instants, by h²/8 of the amplitude."""
    law = mdr.StaticKinetic(1.5 * MU_0, MU_0)
    motion = mdr.NormalOscillation(20e-6, 8e-6, OMEGA)
    case = mdr.SlidingContact(BALL, ELASTIC, friction=law, oscillation=motion)
    run, steps, area = mdr.slide(case, 1e-3, n_springs=32, n_periods=12), 256, []
    for periods in (11, 12):
        t = np.arange(periods * steps + 1) * PERIOD / steps
        u_z = 20e-6 + 8e-6 * np.cos(OMEGA * t)
        found = mdr.slide_record(BALL, ELASTIC, MU_0, t, 1e-3 * t, u_z=u_z, n_springs=32, mu_s=law.mu_s)
        area.append(found.mean_F_z * t[-1] * np.array([found.cof, 1]))
    F_x, F_z = area[1] - area[0]
    assert_allclose(F_x / F_z, run.cof, rtol=0, atol=1e-3)


def test_along_a_line_is_along_any_line():
    t, x, _, z = odd_record()
    one, two = mdr.slide_record(BALL, ELASTIC, MU_0, t, x, 0.3, z), mdr.slide_record(BALL, ELASTIC, MU_0, t, 0, x, z)
    assert_allclose(two.F_y, one.F_x, atol=1e-11 * one.F_z.max())
    assert_allclose([one.cof_y, two.cof, two.cof_y], [0, 0, one.cof], atol=1e-9)
    assert one.running_cof[-1] == pytest.approx(one.cof)
    assert (one.running_cof <= MU_0 * (1 + 1e-9)).all()


@pytest.mark.parametrize(("material", "met"), [(ELASTIC, 1e-12), (KELVIN, 2e-2), (ARMS, 1e-12)])
def test_a_load_finds_the_depth_that_carries_it(material, met):
    """A load that rises, holds and falls to zero. With a dashpot a spring that touches makes a jump of its share."""
    t = np.linspace(0, 0.05, 201)
    F = 0.05 * np.clip(np.minimum(0.2 + 40 * t, 60 * (0.045 - t)), 0, 1)
    found = mdr.slide_record(BALL, material, MU_0, t, 2e-6 * np.sin(300 * t), F_z=F, n_springs=64)
    assert_allclose(found.F_z[1:], F[1:], rtol=0, atol=met * F.max())
    if material is ELASTIC:
        at = mdr.static_depth(BALL, material, F.max())
        assert_allclose(found.u_z.max(), at, rtol=1e-4)
    else:
        rest = mdr.static_depth(BALL, material, F.max())
        assert 0.5 * rest < found.u_z.max() <= rest * (1 + 1e-3)


def test_depth_and_load_are_each_others_inverse():
    t = np.linspace(0, 0.1, 801)
    z, x = 2e-5 + 1e-5 * np.sin(100 * t), 3e-5 * np.sin(60 * t)
    for material in (ELASTIC, ARMS):
        one = mdr.slide_record(BALL, material, MU_0, t, x, u_z=z, n_springs=64)
        two = mdr.slide_record(BALL, material, MU_0, t, x, F_z=one.F_z, n_springs=64)
        start = 80 if material is ARMS else 0  # of a load the arms are at rest first
        assert_allclose(two.u_z[start:], z[start:], rtol=1e-4 if material is ELASTIC else 2e-2)
        assert_allclose(two.F_x[start:], one.F_x[start:], atol=2e-2 * MU_0 * one.F_z.max())


def test_the_second_half_of_a_slide_from_rest_has_no_build_up_in_it():
    """A ball slips all over from mu_0 kappa d on."""
    t = np.linspace(0, 1, 401)
    reach = MU_0 * ELASTIC.mindlin_ratio * 2e-5
    found = mdr.slide_record(BALL, ELASTIC, MU_0, t, 2.1 * reach * t, u_z=2e-5)
    assert found.cof < 0.9 * MU_0
    assert_allclose(found.late_cof, MU_0, rtol=1e-12)
    lifted = mdr.slide_record(BALL, ELASTIC, MU_0, t, reach * t, u_z=np.where(t < 0.4, 2e-5, -1e-5))
    assert np.isnan(lifted.late_cof)


@pytest.mark.parametrize("across", [False, True])
def test_a_stroke_to_and_fro_has_the_friction_of_its_loss(across):
    """The mean of both ways is next to nothing; work over load and way is mu_0, but for each turn of the springs."""
    ball, mu_0, F_z, stroke = mdr.Paraboloid(R=5e-3), 0.5, 0.05, 2e-3
    t = np.linspace(0, 2, 401)
    way = stroke * np.sin(2 * np.pi * t)
    u = (0.6 * way, 0.8 * way) if across else (way, None)
    run = mdr.slide_record(ball, ELASTIC, mu_0, t, *u, F_z=F_z)
    turned = 4 * 2 * mu_0 * ELASTIC.mindlin_ratio * mdr.static_depth(ball, ELASTIC, F_z) / (8 * stroke)
    assert abs(run.cof) < 0.02
    assert mu_0 * (1 - 2 * turned) < run.loss_cof < mu_0
    path = np.hypot(np.diff(run.u_x), np.diff(run.u_y)).sum()
    assert run.loss_cof == pytest.approx(run.energy_balance.plane_work / (F_z * path), rel=1e-6)
    assert "both ways together" in str(run)
    assert "COF, loss" in str(run)
    one_way = mdr.slide_record(ball, ELASTIC, mu_0, t, 1e-3 * t, F_z=F_z)
    assert one_way.loss_cof == pytest.approx(one_way.cof, rel=1e-9)
    assert "loss" not in str(one_way)
    assert np.isnan(mdr.slide_record(ball, ELASTIC, mu_0, t, 0 * t, F_z=F_z).loss_cof)


def test_a_million_steps_tell_how_far_they_are(monkeypatch, capsys):
    monkeypatch.setattr("mdr.tools.progress.PATIENCE", 0.0)
    monkeypatch.setattr("mdr.element.record.AT_ONCE", 32 * 100)
    t = np.arange(1000.0)
    mdr.slide_record(BALL, ELASTIC, MU_0, t, 1e-6 * np.sin(t), u_z=1e-5, n_springs=32)
    assert "slide_record: " in capsys.readouterr().err


@pytest.mark.parametrize("shape", [mdr.Paraboloid(R=5e-3), mdr.FlatPunch(a=1e-3)], ids=["ball", "punch"])
def test_a_record_that_begins_with_a_lift_or_in_the_air_has_numbers_alone(shape):
    """Lifted straight up, moved across later: a dashpot with arms; and nothing touches at the first samples."""
    material, d = mdr.Prony(E_inf=2e6, arms=((1e6, 2e-3),), nu=0.3, tau=5e-4), 1e-5
    for dt in (1e-4, 1e-2):
        for z in ((1, 0.4, 1, 1), (-1, -0.5, 1, 1)):
            way, u_z = ([0, 0, d, 2 * d], [0, 0, d / 2, 0]), d * np.array(z)
            found = mdr.slide_record(shape, material, 0.5, dt * np.arange(4), *way, u_z=u_z, n_springs=32)
            numbers = found.cof, found.cof_y, found.cof_error, found.energy_balance.lost
            assert np.all(np.isfinite([*numbers, *found.running_cof, *found.F_y]))
            assert found.running_cof[0] == 0


def test_a_load_in_steps_that_are_short_for_a_dashpot_has_a_depth():
    """A dashpot a thousand times stiffer than the spring: a depth, good to its last bit, misses the load by more."""
    rng = np.random.default_rng(1)
    for _ in range(10):
        t = np.cumsum(10.0 ** rng.uniform(-6, -2, 20))
        found = mdr.slide_record(
            BALL, mdr.KelvinVoigt(E=3e6, nu=0.3, tau=3e-2), 0.5, t, 1e-3 * t, F_z=rng.uniform(0.01, 0.1, 20)
        )
        assert np.all(np.isfinite([*found.u_z, *found.F_z, found.cof]))
