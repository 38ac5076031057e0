"""A depth that vibrates at random: friction is full at no velocity, and what is lost at a high one has a law.

What a spring lags behind full slip, over its depth, is the content D of a queue that is fed by the depth and served at
the rate c = v_0/(mu_0 kappa). No amplitude of a Gaussian process is the greatest, so D vanishes at no velocity. A
narrow band is a sine of Rayleigh amplitude; excursions of the rate above c are the tips of such sines for any spectrum
(`mdr.laws.random_loss`). A slow pull finds ever deeper troughs in its past (`mdr.laws.slow_random_loss`).

Runs (`mdr.random_cof`) are set beside the laws, and beside the queue itself in plain NumPy.

Symbols: b = c/sigma_v, sigma, sigma_v, sigma_a rms of the random depth, its rate and its acceleration, T = tau
sigma_a/sigma_v, m_k moments of the spectrum, D mean lag.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

import mdr
from mdr import laws
from mdr.tools.arrays import Array
from validation.cases import DEPTH, SHAPES, E
from validation.figures import COLOURS, figure
from validation.report import Check, Checks, Claim, Equation, told

FEWEST = 32  #: histories whose spread tells a standard error
MU_0, SHARE = 0.5, 0.03  #: local friction, and sigma/u_z0 where nothing else is said
#: f [Hz] and density, up to a factor
SPECTRA = {
    "narrow band": ((90.0, 110.0), (1.0, 1.0)),
    "upper half": ((50.0, 100.0), (1.0, 1.0)),
    "all below": ((0.0, 100.0), (1.0, 1.0)),
    "a table": ((5.0, 10.0, 20.0, 50.0, 100.0), (0.2, 1.0, 0.4, 0.1, 0.05)),
    "two bands": ((10.0, 20.0, 21.0, 79.0, 80.0, 100.0), (20.0, 20.0, 0.0, 0.0, 1.0, 1.0)),
}


class Series(NamedTuple):
    """A contact under a spectrum, at several velocities."""

    spectrum: str
    b: tuple[float, ...]
    n: int  #: realisations
    shape: str = "flat punch"
    T: float = 0.0
    share: float = SHARE  #: sigma/u_z0

    @property
    def where(self) -> str:
        """The contact in words."""
        material = f", T = {self.T:g}" if self.T else ""
        return f"{self.spectrum}, {self.shape}{material}, σ/u_z0 = {self.share:g}"

    @property
    def density(self) -> mdr.Spectrum:
        """The spectrum."""
        f, density = SPECTRA[self.spectrum]
        scale = (self.share * DEPTH / mdr.Spectrum(f, density).rms) ** 2
        return mdr.Spectrum(f, tuple(scale * one for one in density))

    @property
    def case(self) -> mdr.SlidingContact:
        """The contact."""
        tau = self.T * self.density.rms_velocity / self.density.rms_acceleration
        rubber = mdr.KelvinVoigt(E, 0.5, tau)
        steady = mdr.NormalOscillation(DEPTH, self.share * DEPTH, 1.0)
        return mdr.SlidingContact(SHAPES[self.shape], rubber, MU_0, steady)

    @property
    def v_0(self) -> Array:
        """Velocities [m/s]."""
        return np.array(self.b) * MU_0 * self.case.material.mindlin_ratio * self.density.rms_velocity


class Found(NamedTuple):
    """Runs of a series beside the law, arrays (n_v,)."""

    series: Series
    run: mdr.RandomCof
    law: Array  #: friction by the law

    @property
    def off(self) -> Array:
        """What runs lose less what the law says, in standard errors."""
        return np.asarray((self.law - self.run.cof) / self.run.standard_error)

    @property
    def ratio(self) -> Array:
        """Loss of the runs over that of the law."""
        return np.asarray((MU_0 - self.run.cof) / (MU_0 - self.law))

    @property
    def spread(self) -> Array:
        """Standard error of that ratio."""
        return np.asarray(self.run.standard_error / (MU_0 - self.law))

    @property
    def lag(self) -> Array:
        """Mean lag of a flat punch over sigma."""
        return np.asarray((1 - self.run.cof / MU_0) / self.series.share)


def follow(series: Series) -> Found:
    """Runs of a series, and the law."""
    run = mdr.random_cof(series.case, series.density, series.v_0, n_realisations=series.n, n_springs=32)
    return Found(series, run, np.array([laws.random_friction(series.case, series.density, v) for v in series.v_0]))


def _series(effort: str) -> tuple[list[Series], list[Series], list[Series]]:
    """Fast pulls, slow ones, and contacts beyond the law."""
    quick = effort == "quick"
    n, fast, slow = (64, (1.5, 2.0), (0.01, 0.03)) if quick else (256, (1.5, 2.0, 2.5), (0.003, 0.01, 0.03))
    return (
        [
            Series("narrow band", (0.1, 1.0, 2.0), n // 2),
            Series("upper half", (0.3, *fast), n),
            Series("all below", (0.3, *fast), 2 * n),
            Series("a table", (1.0, *fast[1:]), n),
            Series("two bands", (0.3, 1.0) if quick else (0.3, 1.0, 2.5), max(n // 4, FEWEST)),
            Series("upper half", fast, n // 2, "paraboloid"),
            Series("all below", fast[-1:], n, T=1.0),
            *(() if quick else (Series("narrow band", fast[:1], 64, T=1.0),)),
        ],
        [Series(one, slow, max(n // 32, 8)) for one in ("all below", "upper half", "narrow band")],
        [Series("all below", (1.0,), n, T=3.0), Series("upper half", (1.0,), 128, "paraboloid", share=0.2)],
    )


def claim(effort: str) -> Claim:
    """Under random vibration there is no critical velocity, but a law of what friction loses

    How: Draw histories, follow them, and set friction beside the laws.

    Quote: The paper has harmonic oscillations, and Eq. (1) takes their amplitude; a random one has none.

    Range: {n_spectra} Gaussian spectra: a narrow band (a fifth of its frequency), the upper half of a flat band, all of
    it, a table that falls from a peak, two bands; flat punch and paraboloid, elastic and Kelvin (T = τ σ_a/σ_v = 1, 3);
    σ/u_z0 = {SHARE:g} and 0.2; b = v_0/(μ_0 κ σ_v) from {slow[0].series.b[0]:g} to {fastest:g}. Rigid pull, contact
    kept.

    Measured: A spring lags behind full slip by the content of a queue that the depth feeds and the pull serves; the
    queue itself, in plain NumPy on the same histories, gives the friction of the runs within their numerical error. The
    law is the mean of ψ, the lag of a sine, over Rayleigh amplitudes. For a narrow band this is plain; it also is the
    limit of fast pulls of any spectrum, as excursions of the rate above v_0/(μ_0 κ) are the tips of sines of mean
    frequency σ_a/σ_v. Where it claims 3 %, b^2 > 20 s with s = m_2 m_6/m_4^2 − 1, runs are within two standard errors.
    Slower it says too little: at b = 1 by {of_table:.0%} for the table (s = {table.series.density.spread:.2f}) and
    {of_two:.0%} for two bands, at b = 0.3 by {of_wide:.0%} for a whole flat band and {of_two_slow:.0%} for two bands. A
    narrow band of a fifth of its frequency has it to {of_narrow:.1%} down to b = 0.1. A material of T = 3 in a flat
    band loses {of_relaxing:.0%} less than the law, a paraboloid of σ/u_z0 = 0.2 {of_deep:.0%}. There is no critical
    velocity: a tenth of the loss at rest is left at b = {ends[0]:.2f}, a hundredth at {ends[1]:.2f}, a thousandth at
    {ends[2]:.2f}. A slow pull finds ever deeper troughs in its past: its loss grows as √(2 log(1/b)) without end, so
    that there is no static friction until contact is lost; at b = {slow[0].series.b[0]:g} it is {slow[0].lag[0]:.2f} σ.

    Verdict: holds if b^2 > 20 (m_2 m_6/m_4^2 − 1), and the material is elastic or relaxes fast

    Sentence: No velocity brings full friction: the loss fades as e^{{−b²/2}}/b^3, b = v_0/(μ_0 κ σ_v), by one law for
    all spectra. A slower and slower pull loses more without end.
    """
    found, slow, (relaxing, deep) = ([follow(one) for one in some] for some in _series(effort))
    ends = [laws.random_end(share) for share in (0.1, 0.01, 0.001)]
    narrow, _, wide, table, two, *_ = found
    n_spectra, fastest, of_table = len(SPECTRA), found[1].series.b[-1], table.ratio[0] - 1
    of_two, of_wide, of_two_slow = two.ratio[1] - 1, wide.ratio[0] - 1, two.ratio[0] - 1
    of_narrow = narrow.ratio[0] - 1
    of_relaxing = 1 - relaxing.ratio[0]
    of_deep = 1 - deep.ratio[0]
    return Claim(
        **told(claim, locals()),
        checks=(
            *_law_checks(found),
            *_queue_checks(wide),
            *_limit_checks(),
            *_slow_checks(slow),
            *_fail_checks(found, relaxing, deep),
        ),
        figures=(_figure(found, slow),),
        equations=_EQUATIONS,
    )


_EQUATIONS = (
    Equation(
        "fast",
        r"1 - \frac{\mu}{\mu_0} = \frac{k_{z,c}}{F_N} \frac{\sigma_v^2}{\sigma_a} \int_b^\infty x^2 e^{-x^2/2}"
        r" \psi(b/x) dx \to \frac{k_{z,c}}{F_N} \frac{\sigma_v^2}{\sigma_a} \frac{9}{2\pi b^3} e^{-b^2/2}",
        "Random vibration of the depth, b = v_0/(μ_0 κ σ_v); σ_v, σ_a rms of its rate and acceleration.",
    ),
    Equation(
        "slow",
        r"F(h) = \Phi(h) e^{-\Phi(-h)/(\sqrt{2\pi} b)}",
        "Distribution of the lag over σ at b → 0, Φ the normal distribution; no narrow band.",
    ),
)


# --- checks ---


def claimed(series: Series) -> list[bool]:
    """Whether the law claims 3 %, at each velocity."""
    return [b**2 > 20 * series.density.spread for b in series.b]


def _law_checks(found: Sequence[Found]) -> Checks:
    for one in found:
        if not (held := np.array(claimed(one.series))).any():
            continue
        off, where = one.off[held], f"{one.series.where}, b ≥ {np.array(one.series.b)[held][0]:g}"
        name = f"loss less the law in standard errors, worst of {off.size}: {where}"
        yield Check(name, float(off[np.abs(off).argmax()]), 0.0, 2.0, "two standard errors")
        name = f"standard error over the loss at the slowest: {where}"
        yield Check.at_most(name, one.spread[held][0], 0.2, "it could be seen")
        numerical = float((one.run.cof_error / one.run.standard_error)[held].max())
        yield Check.at_most(f"numerical over standard error: {where}", numerical, 0.5, "histories alone are random")


def queue(series: Series, run: mdr.RandomCof, finer: int = 8) -> Array:
    """Friction of a flat punch from the content of the queue, at each velocity: Skorokhod's reflection."""
    dt, lags, depths = run.duration / run.n_t / finer, [], []
    t = dt * np.arange(2 * finer * run.n_t)
    for k in range(len(run.realisations)):
        zeta = series.density.realisation(finer * run.n_t, dt, run.seed, k)
        served = [np.tile(zeta, 2) - c * t for c in run.v_0 / (MU_0 * series.case.material.mindlin_ratio)]
        lags.append([(one - np.minimum.accumulate(one))[zeta.size :].mean() for one in served])
        depths.append(DEPTH + zeta.mean())
    return np.asarray(MU_0 * (1 - np.sum(lags, axis=0) / np.sum(depths)))


def _queue_checks(wide: Found) -> Checks:
    series = wide.series._replace(n=8)
    run = follow(series).run
    for b, one, other, error in zip(series.b, run.cof, queue(series, run), run.cof_error, strict=True):
        name = f"friction of runs less that of a queue in NumPy, b = {b:g}: {series.where}"
        yield Check(name, one - other, 0.0, error, "the numerical error that runs tell")


def excursion(b: float, spread: float) -> float:
    """Loss by lone excursions of a rate of sigma_v = sigma_a = 1 above b, over (9/(2 pi)) exp(-b²/2)/b³.

    Given an up-crossing of slope a the rate is b + a t - (b + d) t²/2 - m_6 a t³/6 + m_6 b t⁴/24, m_6 = 1 + spread, to
    this order; a is of Rayleigh's distribution, d Gaussian, of the variance `spread`.
    """
    y, w_y = np.polynomial.laguerre.laggauss(24)
    d, w_d = np.polynomial.hermite_e.hermegauss(24)
    a, k, m_6 = np.sqrt(2 * y)[:, None], b + np.sqrt(spread) * d, 1 + spread
    end = 3 * a / k
    for _ in range(20):
        lag = a / 2 - k * end / 6 - m_6 * a * end**2 / 24 + m_6 * b * end**3 / 120
        end = end - lag / (-k / 6 - m_6 * a * end / 12 + m_6 * b * end**2 / 40)
    area = end**3 * (a / 6 - k * end / 24 - m_6 * a * end**2 / 120 + m_6 * b * end**3 / 720)
    return float(w_y @ area @ w_d / w_d.sum() / 9 * b**3)


def _limit_checks() -> Checks:
    for b in (15.0, 30.0):
        left = laws.random_loss(b) / (9 / (2 * np.pi) * np.exp(-(b**2) / 2) / b**3)
        for spread in (0.0, 0.19, 0.67):
            more = b**2 * (excursion(b, spread) / left - 1)
            name = f"what lone excursions lose more than the law, over its share 1/b^2, b = {b:g}, s = {spread:g}"
            yield Check(name, more, 0.6 * spread, 40 / b**2, "of fourth order in 1/b")
        name = f"the law over (9/2π) e^{{−b²/2}}/b^3, less 1, times b^2, b = {b:g}"
        yield Check(name, b**2 * (left - 1), -5.4, 60 / b**2, "of fourth order in 1/b")


def _slow_checks(slow: Sequence[Found]) -> Checks:
    for one in slow:
        said = np.array([laws.slow_random_loss(b) for b in one.series.b])
        off = one.lag / said - 1
        name = f"lag over the slow law, less 1, worst of b = 0.003 to 0.03: {one.series.where}"
        if one.series.spectrum == "narrow band":
            yield Check.at_most(name, off.max(), -0.08, "its troughs come in groups")
        else:
            error = float((one.run.standard_error / MU_0 / one.series.share / said).max())
            yield Check(name, off[np.abs(off).argmax()], 0.0, 0.03 + 2 * error, "claimed 3 %, and two standard errors")


def _fail_checks(found: Sequence[Found], relaxing: Found, deep: Found) -> Checks:
    narrow, _, wide, table, two, *_ = found
    name = f"loss over the law, b = 0.1: {narrow.series.where}"
    yield Check(name, narrow.ratio[0], 1.0, 0.03 + 2 * narrow.spread[0], "claimed 3 %, and two standard errors")
    for b, got, error in zip(table.series.b[1:], table.ratio[1:], table.spread[1:], strict=True):
        name = f"loss over the law and its error, 1 + 0.6 s/b^2, b = {b:g}: {table.series.where}"
        yield Check(name, got / (1 + 0.6 * table.series.density.spread / b**2), 1.0, 2 * error, "two standard errors")
    slow = [(one, "slow, so deeper troughs than those of a sine") for one in (wide, table, two)]
    for one, why in (*slow, (relaxing, "the surface remembers"), (deep, "of first order in σ/u_z0")):
        where = f"b = {one.series.b[0]:g}: {one.series.where}"
        name = f"the law fails, |loss less the law| in standard errors, {where}"
        yield Check.at_least(name, abs(one.off[0]), 3.0, why)


# --- figure ---


@figure("random", 1, 2, size=(10.4, 4.4))
def _figure(fig, axes, found: Sequence[Found], slow: Sequence[Found]):
    """Left: loss falls over velocity as the laws do, on a logarithmic scale; right: it grows as the pull gets
    slower

    What springs lag behind full slip under random vibration. Left: fast pulls of five spectra on the law of sines with
    Rayleigh amplitudes, two standard errors. Right: slow ones; the loss grows without end, but later for a narrow band.
    """
    fast, at_rest = axes
    b = np.linspace(0.1, 2.7, 27)
    for T, line in ((0.0, "-"), (1.0, "--")):
        fast.plot(b, [laws.random_loss(x, T) for x in b], "k" + line, lw=1, label=f"law, T = {T:g}")
    for one, colour in zip((*found[:5], found[6]), COLOURS, strict=False):
        said = np.array([laws.random_loss(x, one.series.T) for x in one.series.b])
        label = one.series.spectrum + (", T = 1" if one.series.T else "")
        look = {"fmt": "o", "color": colour, "mfc": "w", "ms": 4.5, "capsize": 2}
        fast.errorbar(one.series.b, one.ratio * said, 2 * one.spread * said, label=label, **look)
    fast.set(yscale="log", xlabel=r"$b = v_0/(\mu_0\kappa\sigma_v)$", ylabel=r"mean lag over $\sigma_v^2/\sigma_a$")
    fast.legend(fontsize=8)
    b = np.geomspace(0.002, 0.5, 25)
    at_rest.plot(b, [laws.slow_random_loss(x) for x in b], "k-", lw=1, label="slow law")
    at_rest.plot(b, [laws.random_loss(x) for x in b], "k:", lw=1, label="sines of a narrow band")
    for one, place in zip(slow, (2, 1, 0), strict=True):
        every = [*zip(one.series.b, one.lag, strict=True), (found[place].series.b[0], found[place].lag[0])]
        at_rest.plot(*zip(*every, strict=True), "o", color=COLOURS[place], mfc="w", ms=4.5, label=one.series.spectrum)
    at_rest.set(xscale="log", xlabel=r"$b$", ylabel=r"mean lag over $\sigma$")
    at_rest.legend(fontsize=8)
