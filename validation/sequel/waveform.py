"""Statements on the waveform of a normal oscillation: Eqs. (20), (30), (33) to (37) and (39) of the later paper.

Symbols: Psi lost friction over that at rest, beta = 2 pi v_0/(mu_0 kappa omega A_z), beta_c where it ends. What follows
from them, and the steepest waveforms, have a claim of their own (validation/waveforms.py).
"""

from collections.abc import Callable

import numpy as np

from mdr import laws
from mdr.tools.arrays import Array
from validation.report import Check, Checks, Part, told

BETA = np.array([0.2, 0.7, 1.5, 3.0, 5.0])
EXACT = "both are closed forms"
#: name, waveform of the phase in [0, 1), its Psi and beta_c as stated
STATED: dict[str, tuple[Callable[[Array], Array], Callable[[Array], Array], float]] = {
    "(34), rising saw": (lambda x: x, lambda beta: np.maximum(1 - beta / 2, 0), 2.0),
    "(35), falling saw": (lambda x: -x, lambda beta: 2 / (2 + beta), np.inf),
    "(36), square": (lambda x: 1.0 * (x < 0.5), lambda beta: np.where(beta < 4, 1 - beta / 8, 2 / beta), np.inf),
}


def part(effort: str) -> Part:
    """Waveforms

    How: The closed form of any waveform beside those that are stated.

    Range: Flat punch, elastic, rigid pull, contact kept; saws, square, sine, and pulses of a width from 0.1 to 0.001 of
    the period.

    Measured: (20), (30), (33) to (36) hold, and (33) holds more widely than stated (claim waveforms). The fit (37) of
    the sine is 0.014 too high at most. (39), that a train of impulses is best, holds: the narrower the pulse, the
    nearer comes what is lost to all that is lost at rest, at any velocity, as 1 − Ψ falls with the square of the width.
    No machine makes one; the best that N harmonics can do is in the claim waveforms.

    Sentence: (20), (30), (33) to (36) and (39) hold; the fit (37) is off by 0.014 at most.
    """
    return Part(**told(part, locals()), checks=(*_stated_checks(), *_fit_checks(), *_impulse_checks()))


def _stated_checks() -> Checks:
    for name, (w, stated, end) in STATED.items():
        off = np.abs(laws.waveform_loss(w, BETA) - stated(BETA)).max()
        yield Check(f"{name}: worst |Ψ − stated|", off, 0.0, 1e-10, EXACT)
        yield Check(f"(20), β_c as the steepest rise, {name[6:]}", laws.waveform_critical(w), end, 1e-6, EXACT)
    slopes = np.diff(laws.waveform_loss(_sine, np.linspace(0, 2 * np.pi, 41)))
    yield Check("(33): Ψ of the sine at rest", laws.waveform_loss(_sine, 0.0), 1.0, 1e-10, EXACT)
    yield Check.at_most("(33): greatest rise of Ψ of the sine", slopes.max(), 0.0, "it falls")
    bend = np.diff(slopes).min()
    yield Check.at_least("(33): least bend of Ψ of the sine", bend, -1e-12, "it is convex, to rounding")


def _fit_checks() -> Checks:
    v = np.linspace(0, 1, 101)
    off = 0.75 * (1 - v) ** 2 + 0.25 * (1 - v) ** 4 - laws.waveform_loss(_sine, 2 * np.pi * v)
    yield Check("(37): greatest error of the fit", np.abs(off).max(), 0.0144, 2e-4, "a fit; found here")


def _impulse_checks() -> Checks:
    for beta in (1.0, 5.0):
        left = [1 - laws.waveform_loss(lambda x, d=d: 1.0 * (x < d), beta) for d in (0.1, 0.01, 0.001)]
        for i, width in ((1, 0.01), (2, 0.001)):
            name = f"(39): 1 − Ψ of a pulse of {width:g} of the period over that of one ten times as wide, β = {beta:g}"
            yield Check(name, left[i] / left[i - 1], 0.01, 1e-6, "like the square of the width")


def _sine(x: Array) -> Array:
    return np.asarray(np.cos(2 * np.pi * x))
