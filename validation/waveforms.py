"""Waveforms other than the sine: one function Psi for a punch, a theorem for every contact, the steepest and the best.

Each spring of a rigid pull is extended as far as its limit and the pull allow. A mixture of two such extensions, at two
velocities, is allowed at the velocity between, so the greatest one there is no less: friction is a concave function of
v_0, and it rises. This needs no shape, waveform or kept contact, and of the material only that its creep slows down
(relaxation of positive arms). On elastic springs it outlives a body without mass: with X its place in units of mu_0
kappa, its spring k, and K_i those of the contact,

    (k + sum of K_i) X = k v t + sum of K_i times the greatest X - s_i so far,

whose least solution X is convex in v, so that the force k (v t - X) is concave. It ends where the body has mass, or a
shake turns slip back.

Symbols: w waveform of period 1, mean 0 and least value -1; A_z fall of the depth below its mean; alpha = A_z/u_z0;
beta = 2 pi v_0/(mu_0 kappa omega A_z); N harmonics; T = omega tau.
"""

from itertools import product
from typing import Any

import numpy as np

import mdr
from mdr import laws
from mdr.normal.normal_force import mean_normal_force
from mdr.tools.arrays import Array
from validation.cases import CATALOGUE, DEPTH, OMEGA, SHAPES, any_contact, contact, depth_of, loss, shaken
from validation.figures import COLOURS, circles, figure, panel
from validation.measured import RUN, power
from validation.report import Check, Checks, Claim, Equation, told

RUBBER = {T: mdr.KelvinVoigt(E=3e6, nu=0.5, tau=T / OMEGA) for T in (1.0, 10.0)} | {0.0: mdr.Elastic(E=3e6, nu=0.5)}
ARMS = mdr.Prony(E_inf=3e6, arms=((2e6, 1e-3), (6e6, 5e-3)), nu=0.5)
UNIT = 0.5 * 1.5 * OMEGA * DEPTH  #: mu_0 kappa omega u_z0 [m/s]: v_c of the sine whose least depth is zero
MOST = 6  #: N of the figure
SEED = 20


def _shift(w):
    """A waveform whose jump stands nowhere in particular."""
    return lambda x: w((x + 0.1234567) % 1)


#: waveform: Psi in closed form, Eqs. (34) to (36) of M. Popov (2020), and of a pulse of the width d
IDEAL = {
    "rising saw": (_shift(lambda x: x), lambda b: np.maximum(1 - b / 2, 0)),
    "falling saw": (_shift(lambda x: -x), lambda b: 2 / (2 + b)),
    "square": (_shift(lambda x: x < 0.5), lambda b: np.where(b <= 4, 1 - b / 8, 2 / np.maximum(b, 1))),
    "pulse of a quarter": (_shift(lambda x: x < 0.25), lambda b: np.where(b <= 16, 1 - b / 32, 8 / np.maximum(b, 1))),
}
#: the same with 16 harmonics: the motion, what its docstring says of v_c over that of the sine, and of Psi at most
SMOOTH = {
    "rising saw": (lambda **knobs: mdr.waveforms.sawtooth(**knobs), 0.40, 0.12),
    "falling saw": (lambda **knobs: mdr.waveforms.sawtooth(**knobs, falling=True), 6.3, 0.06),
    "square": (lambda **knobs: mdr.waveforms.square(**knobs), 5.6, 0.14),
    "pulse of a quarter": (lambda **knobs: mdr.waveforms.pulse(**knobs, width=0.25), 11.0, 0.23),
}

_EQUATIONS = (
    Equation(
        "Ψ",
        r"\frac{\mu}{\mu_0} = 1 - \alpha \Psi(\beta), \quad \Psi(\beta) = \langle w \rangle - \left\langle"
        r" \min_{y \ge 0} \left[ w(x - y) + \beta y \right] \right\rangle",
        "Lost by an elastic flat punch that keeps contact, after M. Popov (2020). As a mean of suprema of functions"
        " linear in β it falls and is convex, for every waveform.",
    ),
    Equation(
        "",
        r"\frac{v_c}{\mu_0 \kappa \omega u_{z0}} \le (N + 1) \sqrt{\frac{N (N + 2)}{12}}",
        "Greatest critical velocity of N harmonics whose depth is nowhere negative, for every shape; reached by"
        " <code>mdr.laws.steepest_waveform</code>.",
    ),
)


def claim(effort: str) -> Claim:
    """Whatever the waveform, friction is concave in velocity; how far N harmonics can raise v_c is known

    How: Psi against closed forms and runs, the theorem on many contacts, the steepest waveform and the best ones.

    Quote: This is illustrated in Fig. 1, which qualitatively describes the behavior of the average coefficient of
    friction, as it increases from its static value to μ_0 with increasing sliding velocity. (Section 1)

    Range: Saws, square, pulse, sine and random waveforms; four shapes and a sphere, elastic, Kelvin and with Maxwell
    arms, contact kept and lost; rigid pull, and bodies on a spring; up to 6 harmonics, depth nowhere negative.

    Measured: For a punch and any waveform M. Popov (2020, doi 10.3389/fmech.2020.00069, after Eq. (33)) states without
    proof that lost friction falls with velocity and is convex. The proof is short, and says more. Under a rigid pull
    the force of every spring is the greatest that its limit and the pull allow, and what is allowed at two velocities
    is, mixed, allowed between them. So friction rises and is concave in v_0 for every shape, periodic depth and
    material with arms, contact kept or lost, and lies above the straight line from its static value to μ_0 at v_c. On
    elastic springs a body without mass changes nothing of this; mass can break it (friction still never falls), and so
    does a shake along the slide. With N harmonics and a depth that is never negative v_c is at most (N + 1) √(N(N +
    2)/12) times that of the sine of the same period: 14 for N = 6, and {gain_6:.2f} times that of the sine of the
    greatest frequency. A Kelvin contact keeps this gain as long as it has closed again at the steepest instant, and a
    body far below the excitation all of it. At the velocity at which the sine takes nothing the best waveform of N =
    {most} takes {taken:.2f} of μ_0. The fit (37) of the sine is off by {fit:.3f} at most, at {where:.2f} v_c.

    Verdict: holds

    Sentence: Under a rigid pull friction rises and is concave in v_0 for every shape, waveform and linear material; N
    harmonics that keep contact have v_c ≤ (N + 1) √(N(N + 2)/12) μ_0 κ ω u_z0.
    """
    quick = effort == "quick"
    best = {N: laws.best_waveform(N, 2 * np.pi) for N in ((1, 3) if quick else (1, 2, 3, MOST))}
    most = max(best)
    fit, where = fit_error()
    of_a_punch = (*_form_checks(fit), *_march_checks(quick), *_convex_checks(quick), *_shape_checks())
    of_every_contact = (*_concave_checks(quick), *_named_checks())
    of_n_harmonics = (*_steepest_checks(quick), *_left_checks((MOST,) if quick else (3, MOST)))
    gain_6, taken = laws.steepest_waveform(6)[0] / 6, best[most][0]
    return Claim(
        **told(claim, locals()),
        checks=(*of_a_punch, *of_every_contact, *of_n_harmonics, *_best_checks(best)),
        figures=(_figure(best[most], most),),
        equations=_EQUATIONS,
    )


def sine(x: Array) -> Array:
    """The waveform of Eq. (3)."""
    return np.asarray(np.cos(2 * np.pi * x))


def fit_error() -> tuple[float, float]:
    """Greatest error of Eq. (37) of M. Popov (2020), and where over v_c."""
    v = np.linspace(0, 1, 126)
    off = np.abs(0.75 * (1 - v) ** 2 + 0.25 * (1 - v) ** 4 - laws.waveform_loss(sine, 2 * np.pi * v))
    return float(off.max()), float(v[off.argmax()])


def motion_of(cos: Array, sin: Array, alpha: float = 1.0) -> mdr.PeriodicMotion:
    """The depth about its mean, over the mean, at 50 Hz."""
    scale = alpha * DEPTH
    return mdr.PeriodicMotion(OMEGA, DEPTH, tuple(scale * np.asarray(cos)), tuple(scale * np.asarray(sin)))


def moved(motion: mdr.Motion, shape: str = "flat punch", T: float = 0.0, **more: Any) -> mdr.SlidingContact:
    """A shape on rubber, with its depth in motion."""
    return any_contact(SHAPES[shape], RUBBER[T], motion, **more)


def steepest(N: int, alpha: float = 1.0) -> mdr.PeriodicMotion:
    """The steepest waveform of N harmonics, at alpha = 1 of least depth zero."""
    return motion_of(*laws.steepest_waveform(N)[1:], alpha)


# --- Psi of a punch ---


def _form_checks(fit: float) -> Checks:
    """Against closed forms, and the fit of the sine."""
    beta = np.r_[0.0, np.geomspace(0.02, 60, 40)]
    for name, (w, expected) in IDEAL.items():
        off = np.max(np.abs(laws.waveform_loss(w, beta) - expected(beta)))
        yield Check.at_most(f"Ψ less its closed form, worst: {name}", off, 1e-12, "pieces of a parabola are exact")
    why = "a fit to two digits that comes without its error"
    yield Check.between("greatest error of Eq. (37) for the sine", fit, 0.014, 0.015, why)


def _march_checks(quick: bool) -> Checks:
    """The sine and four named waveforms beside runs of a punch."""
    case = contact("flat punch", 0.8)
    v = np.linspace(0.05, 0.98, 20)
    expected = 1 - 0.8 * laws.waveform_loss(sine, 2 * np.pi * v)
    off = np.max(np.abs(_marched(case, v * case.unit_velocity, 2048) - expected))
    yield Check.at_most("COF/μ_0 of slide() less 1 − α Ψ, sine, worst of 20 velocities", off, 1e-9, "2048 steps")
    for name, (make, _, _) in list(SMOOTH.items())[: 1 if quick else None]:
        motion = make(u_z0=DEPTH, du_z=0.7 * DEPTH, omega=OMEGA, n_harmonics=16)
        case, v = moved(motion), np.array([0.05, 0.3, 1.2])
        off = np.max(np.abs(_marched(case, 0.7 * UNIT * v, 8192) - 1 + 0.7 * laws.waveform_loss(motion, 2 * np.pi * v)))
        why = "8192 steps, 512 of the sixteenth harmonic"
        yield Check.at_most(f"COF/μ_0 of slide() less 1 − α Ψ, worst of 3: {name} of 16 harmonics", off, 1e-8, why)


def _marched(case: mdr.SlidingContact, v_0: Array, steps: int) -> Array:
    """COF/mu_0 of runs with these steps."""
    knobs = {"n_springs": 32, "steps_per_period": steps, "n_periods": 3}
    return np.array([mdr.slide(case, v, **knobs).cof / case.mu_0 for v in v_0])


def _convex_checks(quick: bool) -> Checks:
    """Random waveforms: rows of straight lines, some with jumps."""
    rng, n, beta = np.random.default_rng(SEED), 100 if quick else 500, np.linspace(0, 30, 31)
    losses = np.array([laws.waveform_loss(rng.normal(size=rng.integers(3, 40)) ** 3, beta) for _ in range(n)])
    why = "rounding; Ψ is a mean of suprema of functions linear in β"
    rise, bend = np.diff(losses).max(), -np.diff(losses, 2).min()
    yield Check.at_most(f"greatest rise of Ψ between velocities, {n} random waveforms", rise, 1e-12, why)
    yield Check.at_most(f"greatest concave bend of Ψ, {n} random waveforms", bend, 1e-12, why)


def _shape_checks() -> Checks:
    """Curved shapes lose as much, to first order in the amplitude."""
    alphas, beta = np.array([0.01, 0.02, 0.04]), np.array([1.0, 4.0])
    for shape in ("cone", "paraboloid"):
        off = []
        for alpha in alphas:
            motion = mdr.waveforms.square(DEPTH, alpha * DEPTH, OMEGA, n_harmonics=5)
            case = moved(motion, shape)
            lost = 1 - mdr.cof_curve(case, alpha * UNIT * beta / (2 * np.pi)).cof / case.mu_0
            share = case.k_zc * alpha * DEPTH / mean_normal_force(case)
            off.append(np.max(np.abs(lost / share - laws.waveform_loss(motion, beta))))
        why = f"the next order is smaller by α, at most {alphas[-1]:g}"
        name = f"power of α by which lost friction over k_zc A_z/⟨F_N⟩ differs from Ψ: square of 5 harmonics, {shape}"
        yield Check(name, power(alphas, off), 1.0, alphas[-1], why)


# --- the theorem ---


def bends(case: mdr.SlidingContact, n_v: int = 16) -> tuple[float, float, float]:
    """Of COF/mu_0 over equal steps of velocity from rest to beyond v_c: least rise, greatest convex bend, error."""
    v_0 = mdr.full_slip_critical_velocity(case) * np.linspace(0, 1.05, n_v)
    curve = mdr.cof_curve(case, v_0)
    mu = curve.cof / case.mu_0
    return float(np.diff(mu).min()), float(np.diff(mu, 2).max()), float(curve.cof_error.max() / case.mu_0)


def _concave_checks(quick: bool) -> Checks:
    """Contacts for which it is proved, and where it ends."""
    rng = np.random.default_rng(SEED)
    for T, alpha in product((0.0, 1.0), (1.6,) if quick else (0.7, 1.6)):
        worst = []
        for shape in SHAPES:
            rows = rng.normal(size=(2, 3))
            w = mdr.PeriodicMotion(1.0, 10.0, *map(tuple, rows)).cycle
            motion = motion_of(w.cos / -w.least, w.sin / -w.least, alpha)
            worst.append(bends(any_contact(SHAPES[shape], RUBBER[T], motion)))
        yield from _bend_checks(f"{loss(T)}, A_z/u_z0 = {alpha:g}, random waveforms on four shapes", worst)
    motion = mdr.waveforms.sawtooth(DEPTH, 1.5 * DEPTH, OMEGA, n_harmonics=3, falling=True)
    case = any_contact(SHAPES["cone"], ARMS, motion)
    yield from _bend_checks("two Maxwell arms, cone, contact lost", [bends(case, 6 if quick else 11)])
    case = moved(motion, "cone", groups={"k_ratio": 1.0})
    yield from _bend_checks("body without mass, elastic cone, contact lost", [bends(case, 6 if quick else 11)])
    rise, bend, error = bends(contact("flat punch", 0.3, k_ratio=1.0, omega_0_ratio=2.2, damping_ratio=0.1), 11)
    where = "elastic punch on a body of ω_0 = 2.2 ω"
    why = "a counterexample: stick and slip swing the body, and it the springs"
    yield Check.at_least(f"greatest convex bend of COF/μ_0: {where}", bend, 100 * error, why)
    yield Check.at_least(f"least rise of COF/μ_0: {where}", rise, -2 * error, "proved by another way [uniqueness]")
    case = shaken("flat punch", 0.0, 30.0)
    curve = mdr.cof_curve(case, case.unit_velocity * 30 * np.linspace(0.2, 0.9, 8))
    why = "a counterexample: (2/π) arcsin r of a strong shake is convex; springs slip back"
    yield Check.at_least("greatest convex bend of COF/μ_0: punch shaken along the slide", np.diff(curve.cof, 2).max(),
                         0.01, why)  # fmt: skip


def _bend_checks(where: str, worst: list[tuple[float, float, float]]) -> Checks:
    """Rising, and concave, to four errors of the points."""
    rise, bend, error = np.array(worst).T
    yield Check.at_most(f"COF/μ_0, greatest fall between velocities: {where}", -rise.min(), 2 * error.max(), "errors")
    yield Check.at_most(f"COF/μ_0, greatest convex bend: {where}", bend.max(), 4 * error.max(), "errors of the points")


# --- waveforms that a drive can make ---


def _named_checks() -> Checks:
    """What sixteen harmonics in the place of a jump cost."""
    beta = np.geomspace(0.3, 100, 50)
    for name, (make, v_c, most) in SMOOTH.items():
        motion = make(u_z0=DEPTH, du_z=DEPTH, omega=OMEGA, n_harmonics=16)
        case = moved(motion)
        got, why = mdr.critical_velocity(case) / UNIT, "two digits, as the docstring has it"
        yield Check(f"v_c over that of the sine of the same A_z: {name} of 16 harmonics", got, v_c, 0.011 * v_c, why)
        off = np.max(np.abs(laws.waveform_loss(motion, beta) - IDEAL[name][1](beta)))
        yield Check(f"greatest |Ψ less that of the ideal waveform|: {name} of 16 harmonics", off, most, 0.006, why)


def _steepest_checks(quick: bool) -> Checks:
    """v_c of the steepest waveforms, and that nothing is steeper."""
    sphere = CATALOGUE["sphere"]
    shapes = [(DEPTH, shape) for shape in SHAPES.values()] + [(depth_of(sphere), sphere)]
    for N in (1, 4, MOST) if quick else range(1, MOST + 1):
        gain, cos, sin = laws.steepest_waveform(N)
        full, runs = [], []
        for d, shape in shapes:
            motion = mdr.PeriodicMotion(OMEGA, d, tuple(d * cos), tuple(d * sin))
            case = any_contact(shape, RUBBER[0.0], motion)
            full.append(mdr.full_slip_critical_velocity(case) / (UNIT * d / DEPTH))
            runs.append(mdr.measure_critical_velocity(case, accuracy=1e-8).v_c / (UNIT * d / DEPTH))
        for how, got in (("full slip", full), ("runs", runs)):
            off = np.max(np.abs(np.array(got) / gain - 1))
            name = f"critical velocity by {how} over the gain of the steepest waveform, less 1, worst of 5 shapes"
            yield Check.at_most(f"{name}: N = {N}", off, 1e-6, "the closed form is exact")
        n = 1000 if quick else 10_000
        got = np.max(_random_slopes(N, n)) / gain
        why = "Fejér and Riesz: any depth that is nowhere negative is a square, and may be drawn at random"
        yield Check.between(f"greatest slope of {n} random depths over the steepest: N = {N}", got, 0.8, 1 + 1e-12, why)


def _random_slopes(N: int, n: int) -> Array:
    """Steepest slope over the mean of depths abs(h)², near the best one and far from it, (n,)."""
    rng = np.random.default_rng(SEED + N)
    k = np.arange(N + 1) - N / 2
    best = 1 / np.sqrt(N + 1) - 1j * k / np.linalg.norm(k)
    far = rng.choice([0.03, 0.3, 3.0], size=(n, 1))
    h = best + far * (rng.normal(size=(n, N + 1, 2)) @ [1, 1j])
    h /= np.linalg.norm(h, axis=1)[:, None]
    phase = 2 * np.pi * np.arange(256) / 256
    wave = np.exp(1j * np.outer(np.arange(N + 1), phase))
    values, rates = h @ wave, (h * 1j * np.arange(N + 1)) @ wave
    return np.max(2 * (values.conj() * rates).real, axis=1)


def _left_checks(orders: tuple[int, ...]) -> Checks:
    """What is left of the gain on a Kelvin contact and under a body."""
    for T, N in product((1.0, 10.0), orders):
        case = moved(steepest(N), "paraboloid", T)
        gain, full = laws.steepest_waveform(N)[0], mdr.full_slip_critical_velocity(case) / UNIT
        name = f"v_c over that of the gain, paraboloid that is lost, ωτ = {T:g}: N = {N}"
        if T == 1:
            yield Check(name, full / gain, 1.0, 1e-8, "it has closed again when the depth grows fastest")
        else:
            yield Check.between(name, full / gain, 0.97, 1 - 1e-4, "a slow surface comes back late")
        got = mdr.measure_critical_velocity(case).v_c / UNIT / full
        yield Check(f"{name}; by runs over full slip", got, 1.0, 1e-4, "as a measurement promises")
    for ratio, N in product((0.3, 1.7), orders):
        kept = [_with_body(ratio, one) for one in (N, 1)]
        linear = [mdr.critical_velocity(case) for case in kept]
        name = f"what a body of ω_0 = {ratio:g} ω leaves of the gain"
        got = linear[0] / linear[1] / laws.steepest_waveform(N)[0]
        low, high = (1.0, 1.1) if ratio < 1 else (0.3, 0.6)
        yield Check.between(f"{name}, punch that keeps contact: N = {N}", got, low, high, _WHY_BODY[ratio < 1])
        got = mdr.measure_critical_velocity(kept[0]).v_c / linear[0]
        yield Check(f"{name}, v_c by runs over the formula: N = {N}", got, 1.0, 1e-4, "as a measurement promises")


_WHY_BODY = {
    True: "harmonics above its frequency do not move a body; the sine does, and its v_c is lower for it",
    False: "near ω_0 its fundamental is raised by the body, which harmonics above are not",
}


def _with_body(ratio: float, N: int) -> mdr.SlidingContact:
    """A punch that keeps contact in the steepest waveform, under a body of this natural frequency over omega."""
    return moved(steepest(N, 0.9), groups={"k_ratio": 1.5, "omega_0_ratio": ratio, "damping_ratio": 0.05})


def _best_checks(best: dict[int, tuple[float, Array, Array]]) -> Checks:
    """Where the sine takes nothing, beta = 2 pi."""
    rng = np.random.default_rng(SEED)
    for N, (found, cos, sin) in best.items():
        case = moved(motion_of(cos, sin))
        run = mdr.slide(case, UNIT)
        name = f"the best waveform of N = {N} at the v_c of the sine"
        yield Check(f"{name}: 1 − COF/μ_0 of slide()", 1 - run.cof / case.mu_0, found, 1e-5, RUN)
        zeros = rng.uniform(0, 2 * np.pi, (100, N))
        phase = 2 * np.pi * np.arange(512) / 512
        waves = [np.prod(1 - np.cos(phase[:, None] - row), axis=1) for row in zeros]
        others = [laws.waveform_loss(w, 2 * np.pi) for w in (*waves, steepest(N), lambda x, N=N: sine(N * x))]
        why = "of 100 random depths that touch zero N times, the steepest, and the sine of N ω; 512 straight lines"
        yield Check.at_most(f"{name}: Ψ of others at most", max(others), found + 1e-4, why)


# --- figure ---


@figure("steepest", 1, 3, size=(13.2, 4.2))
def _figure(fig, axes, best: tuple[float, Array, Array], N: int):
    """Three panels: the steepest depths of one to six harmonics over a period; what they gain in v_c; friction over
    velocity of sine, steepest and best waveform.

    What to drive with when the depth must nowhere be negative. Left: the steepest depth that N harmonics can make,
    steepest at 0 ({series}). Middle: its critical velocity over that of the sine, closed form (lines) and runs
    (circles), for every shape; more harmonics help even if it is the greatest frequency Nω that limits a drive. Right:
    friction of a flat punch with {N} harmonics, and the least there is at a velocity (circles); at the one at which the
    sine takes nothing the best waveform takes {best:.2f} of μ_0.
    """
    shapes, gains, curves = axes
    x = np.linspace(-0.5, 0.5, 601)
    for n, colour in zip(range(1, MOST + 1), [*COLOURS, "0.4", "k"], strict=False):
        motion = steepest(n)
        shapes.plot(x, motion.u_z(x * motion.period) / DEPTH, color=colour, lw=1.6, label=f"{n}")
    title, legend = "steepest depth of $N$ harmonics", {"title": "$N$"}
    panel(shapes, "time over period", "$u_z/u_{z0}$", title, legend=legend, xlim=(-0.5, 0.5))
    n = np.arange(1, 13)
    gain = np.array([laws.steepest_waveform(k)[0] for k in n])
    gains.plot(n, gain, color=COLOURS[0], label="the same period")
    gains.plot(n, gain / n, color=COLOURS[1], label=r"the same greatest frequency $N\omega$")
    ran = np.array([_measured_gain(k) for k in n[:MOST]])
    circles(gains, n[:MOST], ran, COLOURS[0])
    circles(gains, n[:MOST], ran / n[:MOST], COLOURS[1])
    panel(gains, "harmonics $N$", title="$v_c$ over that of the sine of", log="y", legend="best", xlim=(0.5, 12.5))
    v = laws.steepest_waveform(N)[0] * 1.05 * np.linspace(0, 1, 90) ** 2
    for label, w, look in (
        (r"sine of $\omega$", sine, {"color": COLOURS[0]}),
        (rf"sine of ${N}\omega$", lambda x: sine(N * x), {"color": COLOURS[1]}),
        (f"steepest, $N={N}$", steepest(N), {"color": COLOURS[2]}),
        ("best at the dotted velocity", motion_of(*best[1:]), {"color": "k", "ls": "--"}),
    ):
        curves.plot(v, 1 - laws.waveform_loss(w, 2 * np.pi * v), label=label, **look)
    at = v[-1] * np.array([0.04, 0.15, 0.3, 0.6])
    most = [1 - laws.best_waveform(N, 2 * np.pi * one)[0] for one in at]
    circles(curves, at, most, "k", label="best at each velocity")
    curves.axvline(1.0, color="0.5", lw=1, ls=":")
    x, title = r"$v_0/(\mu_0\kappa\omega u_{z0})$", f"flat punch, {N} harmonics"
    panel(curves, x, r"$\mu/\mu_0$", title, legend="lower right", xlim=(0, v[-1]), ylim=(0, 1.02))
    return {"series": _series(3), "N": N, "best": best[0]}


def _measured_gain(N: int) -> float:
    """v_c of the steepest waveform by runs, over that of the sine."""
    found = mdr.measure_critical_velocity(moved(steepest(N), "paraboloid"))
    return float(np.nan if found.v_c is None else found.v_c / UNIT)


def _series(N: int) -> str:
    """The depth in words."""
    _, cos, sin = laws.steepest_waveform(N)
    terms = [f"{c:+.3f} cos {n}ωt {s:+.3f} sin {n}ωt" for n, (c, s) in enumerate(zip(cos, sin, strict=True), start=1)]
    return f"N = {N}: 1 {' '.join(terms)}"
