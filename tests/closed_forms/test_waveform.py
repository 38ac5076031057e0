"""What a waveform takes from a punch: closed forms, an independent twin, limits; and the best waveforms."""

import numpy as np
import pytest

import mdr
from mdr import laws
from mdr.closed_forms.paper import deficit

BETA = np.r_[0.0, np.geomspace(0.01, 40, 40)]


def sine(x):
    return np.sin(2 * np.pi * x)


def series(n_harmonics, rng):
    """A random waveform, as a callable."""
    n = np.arange(1, n_harmonics + 1)
    C = rng.normal(size=(n_harmonics, 2)) @ [1, 1j]
    return lambda x: np.real(np.exp(2j * np.pi * np.multiply.outer(x, n)) @ C)


def twin(w, beta, n):
    """From the definition: every y of one period at every instant."""
    values = w(np.arange(n) / n)
    values = (values - values.mean()) / (values.mean() - values.min())
    past = [np.roll(values, k) + beta * k / n for k in range(n)]
    return -np.mean(np.min(past, axis=0))


@pytest.mark.parametrize("shift", [0.0, 0.123456, 0.5, 1 / 3])
@pytest.mark.parametrize(
    ("w", "expected"),
    [
        (lambda x: x, lambda b: np.maximum(1 - b / 2, 0)),
        (lambda x: -x, lambda b: 2 / (2 + b)),
        (lambda x: x < 0.5, lambda b: np.where(b <= 4, 1 - b / 8, 2 / np.maximum(b, 1))),
        (lambda x: x < 0.2, lambda b: np.where(b <= 25, 1 - b / 50, 12.5 / np.maximum(b, 1))),
    ],
    ids=["rising saw", "falling saw", "square", "pulse of a fifth"],
)
def test_saws_and_pulses_have_closed_forms(w, expected, shift):
    """Eqs. (34) to (36) of M. Popov (2020), and 1 - beta d²/2 up to 1/d² of a pulse of the width d."""
    found = laws.waveform_loss(lambda x: w((x + shift) % 1), BETA)
    np.testing.assert_allclose(found, expected(BETA), rtol=0, atol=1e-12)


def test_the_sine_is_that_of_the_rigid_pull():
    inside = np.linspace(0.02, 0.98, 20)
    expected = [deficit(v) for v in inside]
    np.testing.assert_allclose(laws.waveform_loss(sine, 2 * np.pi * inside), expected, rtol=0, atol=4e-11)
    np.testing.assert_allclose(laws.waveform_loss(sine, [2 * np.pi, 9.0]), 0, atol=4e-11)
    np.testing.assert_allclose(laws.waveform_loss(sine, [0.3, 1, 3]), [0.87380, 0.64207, 0.22145], atol=5e-6)


def test_any_waveform_is_its_definition():
    rng = np.random.default_rng(3)
    for n_harmonics in (1, 2, 5):
        w, n = series(n_harmonics, rng), 1024
        for beta in (0.3, 2.0, 15.0):
            # equidistant instants miss a minimum by its curvature over 8 n²
            assert laws.waveform_loss(w, beta) == pytest.approx(
                twin(w, beta, n), abs=(2 * np.pi * n_harmonics / n) ** 2
            )


def test_scale_offset_and_shift_drop_out_and_a_frequency_is_a_velocity():
    w = series(3, np.random.default_rng(5))
    known = laws.waveform_loss(w, BETA)
    np.testing.assert_allclose(laws.waveform_loss(lambda x: 7e-6 + 1e-7 * w((x + 0.3) % 1), BETA), known, atol=8e-11)
    np.testing.assert_allclose(laws.waveform_loss(lambda x: w(3 * x % 1), 3 * BETA), known, atol=8e-11)
    tiny = laws.waveform_loss(lambda x: 1 + 1e-8 * w(x), BETA)
    np.testing.assert_allclose(tiny, known, atol=1e-6)  # 1e-16 of rounding over 1e-8
    motion = mdr.PeriodicMotion.of(20e-6 + 1e-6 * w(np.arange(64) / 64), 300.0)
    np.testing.assert_allclose(laws.waveform_loss(motion, BETA), known, atol=8e-11)


def test_the_steepest_slope_ends_the_loss():
    for w in (sine, series(4, np.random.default_rng(7)), lambda x: x, lambda x: np.abs(x - 0.3127)):
        end = laws.waveform_critical(w)
        assert laws.waveform_loss(w, end) == pytest.approx(0, abs=4e-11)
        assert laws.waveform_loss(w, 0.98 * end) > 1e-9
    assert laws.waveform_critical(sine) == pytest.approx(2 * np.pi, rel=1e-7)
    assert laws.waveform_critical(lambda x: x) == pytest.approx(2, rel=1e-9)
    assert laws.waveform_critical(lambda x: x < 0.4) == np.inf
    assert laws.waveform_critical(lambda x: (x > 0.31) & (x < 0.4)) == np.inf


def test_a_punch_loses_alpha_psi_beside_its_curve():
    motion = mdr.waveforms.sawtooth(20e-6, 14e-6, 300.0, n_harmonics=6, falling=True)
    case = mdr.SlidingContact(mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.3), 0.4, motion)
    scale = case.mu_0 * case.material.mindlin_ratio * 300.0 * 14e-6
    v_0 = scale * np.array([0.05, 0.5, 1.5])
    expected = 1 - 0.7 * laws.waveform_loss(motion, 2 * np.pi * v_0 / scale)
    np.testing.assert_allclose(mdr.cof_curve(case, v_0).cof / case.mu_0, expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("N", [1, 2, 3, 6, 20])
def test_the_steepest_waveform_is_an_eigenvector(N):
    gain, cos, sin = laws.steepest_waveform(N)
    k = np.arange(N + 1)
    assert gain == pytest.approx(np.linalg.eigvalsh(1j * (k[None] - k[:, None]))[-1], rel=1e-12)
    assert np.arange(1, N + 1) @ sin == pytest.approx(gain, rel=1e-12)
    motion = mdr.PeriodicMotion(1.0, 1.0, tuple(cos), tuple(sin))
    assert motion.cycle.unit * motion.cycle.least == pytest.approx(-1, abs=1e-12)  # it just touches zero
    assert laws.waveform_critical(motion) == pytest.approx(2 * np.pi * gain, rel=1e-7)


def test_one_harmonic_is_the_sine():
    loss, cos, sin = laws.best_waveform(1, 1.0)
    assert loss == pytest.approx(deficit(1 / (2 * np.pi)), abs=4e-11)
    np.testing.assert_allclose(np.hypot(cos, sin), 1, rtol=1e-12)
