"""Force curves: approach and retract, touch and baseline, of a known ball and cone."""

import re
import warnings
from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr import plots
from mdr.files.force_curves import touch_of

E_STAR, DEPTH, TOUCH = 1e5, 200e-9, 100e-9
BALL, CONE = mdr.Paraboloid(R=5e-6), mdr.Cone(theta=0.3)


def curve(shape, n=201, noise=0.0, baseline=0.05):
    """Readings [m] and forces [N]; noise and baseline are shares of the greatest force."""
    z = np.linspace(0, TOUCH + DEPTH, n)
    greatest = float(shape.force(DEPTH, E_STAR))
    F = np.asarray(shape.force(z - TOUCH, E_STAR))
    return z, F + greatest * (baseline + noise * np.random.default_rng(4).normal(size=n)), greatest


def written(path, z, F):
    path.write_text(
        "Ramp 7\n\nz (nm)\tF (nN)\n" + "".join(f"{1e9 * a}\t{1e9 * b}\n" for a, b in zip(z, F, strict=True))
    )
    return path


def read(path, **given):
    return mdr.FromForce.read(path, E_star=E_STAR, columns={"d": "z"}, **given)


@pytest.mark.parametrize(("shape", "power"), [(BALL, 1.5), (CONE, 2.0)])
@pytest.mark.parametrize("n", [31, 201, 4001])
def test_touch_and_baseline_of_a_known_shape_are_found(shape, power, n):
    """Without noise exactly; else to a few times the noise, and better the more points there are."""
    z, F, greatest = curve(shape, n)
    for known in (power, 0.0):
        assert_allclose(touch_of(z, F, known), (TOUCH, 0.05 * greatest), rtol=1e-6)
    z, F, greatest = curve(shape, n, noise=0.01)
    touch, baseline = touch_of(z, F, power)
    assert abs(touch - TOUCH) < 10 * 0.01 * DEPTH / n**0.25  # a ball bends off by noise at 0.01^(2/3) of the depth
    assert abs(baseline - 0.05 * greatest) < 4 * 0.01 * greatest / (n / 3) ** 0.5  # of a third of the points


@pytest.mark.parametrize("shape", [mdr.Hyperboloid(h=4e-8, c=1e-7), mdr.CappedCone(b=2e-7, theta=0.35)])
def test_the_touch_of_a_cone_with_a_round_end_is_between_those_that_are_told(tmp_path, shape):
    z, F, greatest = curve(shape, noise=0.002)
    with pytest.warns(mdr.PlausibilityWarning, match="as found") as told:
        read(written(tmp_path / "data.csv", z, F), smoothing=0.003 * greatest)
    said = re.search(r'with tip="sharp" the touch would be (\S+) m, with tip="round" (\S+) m', str(told[0].message))
    sharp, is_round = map(float, said.groups())
    assert sharp < TOUCH < is_round
    assert is_round - sharp < 0.5 * DEPTH


def test_a_ball_comes_back_within_the_noise(tmp_path):
    z, F, greatest = curve(BALL, noise=0.005)
    with pytest.warns(mdr.PlausibilityWarning, match=r"touch=1.* m and baseline=.* N are taken, as found"):
        shape = read(written(tmp_path / "data.csv", z, F), tip="round", smoothing=0.005 * greatest)
    d = np.linspace(0.2, 0.9, 8) * DEPTH
    assert_allclose(shape.force(d, E_STAR), BALL.force(d, E_STAR), atol=3 * 0.005 * greatest)
    assert_allclose(shape.contact_radius(0.5 * DEPTH), BALL.contact_radius(0.5 * DEPTH), rtol=0.03)


def test_what_a_baseline_tells_of_a_curve_is_said(tmp_path):
    """Air alone is refused; a drift and a pull are told; a sound curve is silent but for what is found."""
    drifts = "the force drifts by .* shifts"
    for noise, share in product((0.002, 0.005), (-0.2, -0.1, 0.0, 0.1, 0.2, "pull")):
        z, F, greatest = curve(BALL, noise=noise)
        forces, words = F, "pull: of an adhesive contact"
        if share == "pull":
            forces = np.where(abs(z - 0.8 * TOUCH) < 10e-9, F - 0.3 * greatest, F)
        else:
            forces, words = F + share * greatest * z / z[-1], drifts if share else ""
        with pytest.warns(mdr.PlausibilityWarning) as told:
            read(written(tmp_path / "data.csv", z, forces), tip="round", smoothing=0.05 * greatest)
        said = [str(one.message) for one in told if "taken, as found" not in str(one.message)]
        assert [bool(re.search(words, one)) for one in said] == [True] * bool(words), (noise, share)
    z, F, greatest = curve(BALL, noise=0.005)
    for seed in range(20):  # few points before the touch: noise is no pull
        z = np.linspace(0.95 * TOUCH, TOUCH + DEPTH, 1000)
        noise = 0.003 * greatest * np.random.default_rng(seed).normal(size=z.size)
        forces = np.asarray(BALL.force(z - TOUCH, E_STAR)) + noise
        with pytest.warns(mdr.PlausibilityWarning) as told:
            read(written(tmp_path / "data.csv", z, forces), tip="round", touch=TOUCH, smoothing=0.01 * greatest)
        assert not any("pull" in str(one.message) for one in told)
    z, F, greatest = curve(BALL, noise=0.005)
    air = greatest * (0.05 + 0.005 * np.random.default_rng(3).normal(size=z.size))
    with pytest.raises(ValueError, match="nothing is touched"):
        read(written(tmp_path / "data.csv", z - DEPTH, air), tip="round", smoothing=0.01 * greatest)


def test_what_is_taken_is_drawn(tmp_path):
    z, F, _ = curve(BALL, noise=0.005)
    read_as = {"columns": {"d": "z"}, "tip": "round"}
    found = mdr.read_force_curve(written(tmp_path / "data.csv", z, F), **read_as)
    assert found.depths.size == found.forces.size < found.d.size == z.size
    measured, taken, touch, baseline = plots.plot_force_curve(found).lines
    assert_allclose(measured.get_ydata(), 1e9 * F, rtol=1e-12)
    assert_allclose(touch.get_xdata(), 1e9 * found.touch)
    assert_allclose(baseline.get_ydata(), 1e9 * found.baseline)
    assert_allclose(taken.get_xdata()[[0, -1]], [1e9 * found.touch, 1e9 * z[-1]])


def test_forces_of_another_sign_or_unit_are_refused(tmp_path):
    z, F, greatest = curve(BALL, noise=0.005, baseline=0.0)
    with pytest.raises(ValueError, match="turn the sign of F"):
        read(written(tmp_path / "data.csv", z, -F), tip="round", smoothing=0.01 * greatest)
    with pytest.raises(ValueError, match=r"is the noise of the forces, which reach .* N: give it in N"):
        read(written(tmp_path / "data.csv", z, F), tip="round", smoothing=50.0)


def test_touch_and_baseline_that_are_given_are_taken(tmp_path):
    z, F, greatest = curve(BALL)
    path = written(tmp_path / "data.csv", z, F)
    for given in ({"touch": TOUCH}, {"touch": TOUCH, "baseline": 0.05 * greatest}, {"baseline": 0.05 * greatest}, {}):
        assert_allclose(
            read(path, tip="round", **given).force(DEPTH / 2, E_STAR), BALL.force(DEPTH / 2, E_STAR), rtol=1e-4
        )
    with pytest.raises(ValueError, match="F must rise more and more steeply"):
        read(path, tip="round", touch=TOUCH, baseline=0.0)  # the jump at the touch is one of a flat face


def test_approach_and_retract_are_apart(tmp_path):
    """The retract of another force, so that they cannot be taken for one another; a dwell between them."""
    z, F, greatest = curve(BALL)
    back = curve(CONE)[1] + 0.1 * greatest
    path = written(tmp_path / "data.csv", [*z, *[z[-1]] * 3, *z[::-1]], [*F, *[F[-1]] * 3, *back[::-1]])
    for part, tip, shape in [("approach", "round", BALL), ("retract", "sharp", CONE)]:
        found = read(path, part=part, tip=tip)
        assert_allclose(found.force(DEPTH / 2, E_STAR), shape.force(DEPTH / 2, E_STAR), rtol=1e-4)
    with pytest.raises(ValueError, match='no part of the curve is approach: choose part="retract" of lines 4 to 204'):
        read(written(path, z[::-1], F[::-1]))
    with pytest.raises(ValueError, match="part must be one of approach, retract"):
        read(path, part="both")


@pytest.mark.parametrize("shape", [BALL, CONE, mdr.FlatPunch(a=1e-6)])
def test_readings_that_are_depths_are_left_as_they_are(tmp_path, shape):
    d = np.linspace(0, DEPTH, 31)[1:]
    path = written(tmp_path / "data.csv", d, np.asarray(shape.force(d, E_STAR)))
    assert_allclose(read(path).d[1:], d, rtol=1e-12)


# --- curves as instruments write them ---

BODY = 4e6  # Pa; BALL on it to 2 um
WAY = np.linspace(-500.0, 2000.0, 500)  # nm
RIGHT = 1e6 * float(BALL.contact_radius(1e-6))  # um


def force_at(d):
    """Of the ball, in nN at depths in nm."""
    return 1e9 * np.asarray(BALL.force(1e-9 * np.asarray(d), BODY))


def pressed(path, d, F, noise=0.1, head="Depth (nm)\tLoad (nN)", **given):
    """Contact radius [um] at 1 um of a file of depths [nm] and forces [nN], and what was told of its lines."""
    F = F + np.random.default_rng(3).normal(0, noise, np.size(F))
    np.savetxt(path, np.column_stack([d, F]), delimiter="\t", header=head, comments="", fmt="%.5f")
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        shape = mdr.FromForce.read(path, E_star=BODY, tip="round", smoothing=2e-9, **given)
    said = [str(one.message).rpartition("data.csv: ")[2] for one in told]
    return 1e6 * shape.contact_radius(1e-6), [one for one in said if "as found" not in one]


LIFT = np.linspace(-400.0, -500.0, 50)
CREEP = 2000 + 30 * np.log1p(np.arange(100.0)) / np.log(100)
CURVES = {
    "a hold that creeps up": ([WAY, CREEP], [force_at(WAY), np.full(100, force_at(2000))], ["502 to 601"]),
    "one that drifts, then back": (
        [WAY, np.linspace(2000, 2020, 101)[1:], WAY[::-1]], None, ["502 to 600"]),
    "one that sinks, then back": ([WAY, np.linspace(2000, 1980, 100), np.linspace(1980, -500, 500)], None, []),
    "forces that relax": ([WAY, np.full(100, 2000.0)],
                          [force_at(WAY), force_at(2000) * np.linspace(0.99, 0.6, 100)], ["502 to 601"]),
    "a lift-off before": ([LIFT, WAY], None, ["2 to 50"]),
    "a lift-off before, and one after": (
        [LIFT, WAY, WAY[::-1], np.linspace(-500, -380, 60)], None, ["2 to 50", "1052 to 1111"]),
    "a way as a cosine": ([750 - 1250 * np.cos(np.linspace(0, np.pi, 500)), np.full(200, 2000.0)], None, [" to 701"]),
}  # fmt: skip


@pytest.mark.parametrize(("d", "F", "lines"), CURVES.values(), ids=CURVES)
def test_what_is_no_part_of_the_approach_is_left_out_and_told(tmp_path, d, F, lines):
    """To 1e-3: forces are known to 2 nN of some 1e4."""
    F = force_at(np.concatenate(d)) if F is None else np.concatenate(F)
    radius, said = pressed(tmp_path / "data.csv", np.concatenate(d), F)
    assert_allclose(radius, RIGHT, rtol=1e-3)
    assert len(said) == bool(lines)
    assert all(one in said[0] for one in lines)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("noise", [0.3, 3.0, 10.0])
def test_noise_of_the_depth_is_no_noise_of_the_force(tmp_path, noise, seed):
    """A reading of the depth that is noisy, and a tip that truly shakes: forces follow the second.

    The rate of a line through 500 depths over 2500 nm is known to noise sqrt(12/500)/2500, here to three times that.
    """
    shaken = WAY + np.random.default_rng(seed).normal(0, noise, WAY.size)
    for d, F in ((shaken, force_at(WAY)), (shaken, force_at(shaken)), (WAY, force_at(WAY))):
        assert_allclose(pressed(tmp_path / "data.csv", d, F)[0], RIGHT, rtol=1e-3 + 1.9e-4 * noise)
    hold = 2000 + np.random.default_rng(seed).normal(0, noise, 100)
    loop = np.concatenate([LIFT, shaken, hold, shaken[::-1]])
    F = force_at(np.concatenate([LIFT, WAY, np.full(100, 2000.0), WAY[::-1]]))
    for part in ("approach", "retract"):
        assert_allclose(pressed(tmp_path / "data.csv", loop, F, part=part)[0], RIGHT, rtol=1e-3 + 1.9e-4 * noise)


def test_of_several_loops_one_is_chosen(tmp_path):
    back = WAY[:100:-1]
    d = np.concatenate([WAY, back, WAY[101:], WAY[::-1]])
    F = force_at(d)
    said = (
        r'2 parts of the curve are approach: choose part="approach 1" of lines 2 to 501, part="approach 2" of lines 900'
    )
    for part in ("approach", "approach 3"):
        with pytest.raises(ValueError, match=said):
            pressed(tmp_path / "data.csv", d, F, part=part)
    for part in ("approach 1", "approach 2", "retract 1", "retract 2"):
        assert_allclose(pressed(tmp_path / "data.csv", d, F, part=part, touch=0.0)[0], RIGHT, rtol=1e-3)


def test_the_height_of_a_piezo_is_no_depth(tmp_path):
    """A cantilever bends by F/k: its name is asked about, and its stiffness brings the depth; a height may point up."""
    path, k, F = tmp_path / "data.csv", 20.0, 8 + force_at(WAY)  # N/m
    height = WAY + F / k
    for name in ("Height", "Piezo", "Z", "Displacement"):
        head = f"{name} (nm)\tLoad (nN)"
        with pytest.raises(ValueError, match=f"{name}.* may be d, or another quantity.*spring_constant="):
            pressed(path, height, F, head=head)
        for z, given in ((height, {}), (5000 - height, {}), (5000 - height, {"touch": 5e-6 - 8e-9 / k})):
            radius, said = pressed(path, z, F, head=head, spring_constant=k, **given)
            assert_allclose(radius, RIGHT, rtol=1e-3)
            assert any("d is turned" in one for one in said) == (z is not height)
    with pytest.raises(ValueError, match="of a depth, leave spring_constant out"):
        pressed(path, WAY, F, spring_constant=k)
    with pytest.raises(ValueError, match="spring_constant must be positive"):
        pressed(path, height, F, head="Height (nm)\tLoad (nN)", spring_constant=0.0)
