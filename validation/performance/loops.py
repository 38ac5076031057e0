"""The march under a rigid pull written in other ways, to be timed beside the library's: NumPy, C, an ODE solver.

NumPy and C take the same springs through the same steps by the same rules as mdr/march/kernels.py and end in the same
state, which `same_state` checks before any time is taken. The ODE solver knows no step of ours: it gets the law of a
Kelvin spring, e' = (clip(e + T u', -N, N) - e)/T, with N(t) from the closed form of its normal motion.
"""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from mdr import SpringArray
from mdr.case.contact import SlidingContact
from mdr.march import kernels
from mdr.march.dimensionless import ScaledContact
from mdr.normal.kelvin_edges import kept_gap, leaving_phase, touching_phase

C_FLAGS = (
    *("-O3", "-march=native", "-fassociative-math", "-fno-signed-zeros", "-fno-trapping-math", "-ffp-contract=fast"),
    *("-shared", "-fPIC"),
)


@dataclass(frozen=True, eq=False)
class Start:
    """Springs of a contact under a rigid pull, in full slip at phase 0, and the velocity they are pulled at."""

    case: SlidingContact
    n_springs: int
    steps: int
    v: float  #: over Eq. (1)

    @cached_property
    def scaled(self) -> ScaledContact:
        """Arrays of the march; every spring for itself."""
        return ScaledContact.of(self.case, SpringArray.of(self.case, self.n_springs), self.steps, lump=False)

    @cached_property
    def normal(self) -> tuple[Any, Any]:
        """Compressions (n,) at phase 0, and which springs press or are free throughout a step, (2, n_steps)."""
        normal = self.scaled.normal
        return normal.s[0], normal.spans

    @property
    def rate(self) -> float:
        """1/T, or 0 for an elastic material."""
        return 1 / self.scaled.T if self.scaled.T else 0.0

    @property
    def decay(self) -> float:
        """What is left of a free compression after a step."""
        return float(np.exp(-self.scaled.h / self.scaled.T)) if self.scaled.T else 0.0


March = Callable[[Start, int], tuple[Any, Any]]  # n_steps -> extensions (n,) at the end, sums of w e (n_steps,)


def compiled(start: Start, n_steps: int) -> tuple[Any, Any]:
    """The kernel that slide() calls."""
    scaled, s = start.scaled, start.normal[0]
    e = s[None].copy()
    nothing = np.empty((0, *e.shape))
    trace = kernels.Trace(np.empty(n_steps), np.empty(n_steps), nothing, nothing)
    rest, motion = scaled.rest_state(start.v), scaled.motion(start.v)
    kernels.march(e, s[None].copy(), rest, scaled.body, scaled.springs, motion, scaled.table, 0, trace)
    return e[0], trace.S


# --- NumPy ---


def vectorised(start: Start, n_steps: int) -> tuple[Any, Any]:
    """A plain loop over the steps, each a few lines of NumPy on all springs."""
    s = start.normal[0]
    e, S = s, np.empty(n_steps)
    for j in range(n_steps):
        e, s, more = _step(start, e, s, j % start.scaled.steps)
        S[j] = start.scaled.w @ (e + more)
    return e, S


def _step(start: Start, e: Any, s_0: Any, k: int) -> tuple[Any, Any, Any]:
    """New extensions and compressions, and what the paths to them add to the means of the extensions."""
    scaled, v, decay, rate = start.scaled, start.v, start.decay, start.rate
    z_0, z_1, zd_0, zd_1, h = scaled.z[k], scaled.z[k + 1], scaled.z_dot[k], scaled.z_dot[k + 1], scaled.h
    du, pressed = v * h, z_1 - scaled.gap
    if decay == 0:
        s = np.maximum(pressed, 0)
        way = np.minimum(s / (z_1 - z_0), 1) if z_1 > z_0 else np.minimum(s * 1e300, 1)
        travelled = way * (1 - kernels.bend_of.py_func(zd_0, zd_1) * (1 - way))
        late = float(_after_change(zd_0 - v, zd_1 - v, h, 0.0)) if zd_0 < v else 0.0
        above, trial = z_0 - scaled.gap, e + travelled * du
        over = trial - np.clip(trial, -s, s)
        left = np.where(over > 0, above - e, above + e)
        pace = left + np.abs(over)  # at which the trial leads; a sum over nodes misses a twelfth of it
        slips = np.where(left > 0, 0.5 * over * left / (pace + 1e-300) - np.sign(over) * pace / 12, 0)
        new = np.maximum(np.minimum(trial, s - travelled * late), -s)
        stays = np.where(pressed > 0, slips, _end_of_touch(e, np.maximum(above, 0), du, -np.minimum(pressed, 0)))
        touches = new * (1 / (12 * np.maximum(travelled, 1e-9)) - 0.5 * (1 - travelled)) * (travelled > 0)
        return new, s, np.where(above > 0, stays, touches)
    relaxed = s_0 * decay
    ahead = s_0 - (z_0 - scaled.gap)
    leaving = np.where(ahead <= 0, _after_change(-(zd_0 + s_0 * rate), -(zd_1 + pressed * rate), h, rate), 0)
    s = np.maximum(pressed + leaving, relaxed)
    rise = s - relaxed
    way = rise / (rise + ahead + 1e-300)
    closing_0, closing_1 = zd_0 + s_0 * rate, zd_1 + relaxed * rate
    bend = np.clip((closing_1 - closing_0) / (np.abs(closing_0 + closing_1) + 1e-300), -0.5, 0.5)
    travelled = way * (1 - bend * (1 - way))
    trial = e * (travelled + (1 - travelled) * decay) + travelled * du
    lag = s_0 - e
    D_0 = zd_0 - v + lag * rate
    sticks = D_0 > 0
    D_1 = zd_1 - v + np.where(sticks, np.maximum(s - trial, 0), lag * decay) * rate
    sign = np.where(sticks, -1.0, 1.0)
    change = _after_change(sign * D_0, sign * D_1, h, rate)
    forward = s - lag * decay
    first = np.minimum(np.where(sticks, trial, forward) - travelled * change, forward)
    new = np.maximum(first, (s_0 + e) * decay - s)
    return new, s, 0.0


def _end_of_touch(e: Any, s: Any, du: float, opened: Any) -> Any:
    """What elastic springs that let go within the step add, see mdr/march/kernels.py."""
    share = s / (s + opened + 1e-300)
    ahead, behind = (np.maximum(s + way * share * du, 1e-300) for way in (1, -1))
    slips = share * np.minimum(np.minimum((s - e) / ahead, (s + e) / behind), 1)
    met = e + du * slips
    return 0.5 * (e * (slips - 1) + met * share) + np.where(s > 0, np.copysign((s + opened) / 12, met), 0)


def _after_change(D_0: Any, D_1: Any, h: float, rate: float) -> Any:
    """What a new mode adds after a change within the step, see mdr/march/kernels.py."""
    lead = np.maximum(D_1, 0)
    rest = h * lead / (lead + np.maximum(-D_0, 0) + 1e-300)
    return 0.5 * lead * rest / (1 + 0.5 * rate * rest)


# --- C ---


def built_in_c() -> March | None:
    """The march of march.c, built now; None where there is no C compiler."""
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        return None
    source = Path(__file__).with_name("march.c")
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "march.so"
        subprocess.run([compiler, *C_FLAGS, str(source), "-o", str(library), "-lm"], check=True)
        code = ctypes.CDLL(str(library))  # stays loaded after its file is gone
    array, number, count = np.ctypeslib.ndpointer(float), ctypes.c_double, ctypes.c_long
    counts = np.ctypeslib.ndpointer(np.int64)
    tail = [count, count, count, array]
    code.elastic_march.argtypes = [*[array] * 5, counts, number, number, *tail]
    code.kelvin_march.argtypes = [*[array] * 8, counts, *[number] * 4, *tail]
    code.elastic_march.restype = code.kelvin_march.restype = None

    def march(start: Start, n_steps: int) -> tuple[Any, Any]:
        if n_steps % 2:
            raise ValueError(f"n_steps must be even, got {n_steps}")
        scaled, (s, spans) = start.scaled, start.normal
        e, S = s.copy(), np.empty(n_steps)
        arrays = scaled.gap, scaled.w, scaled.z, scaled.z_dot, spans
        sizes = e.size, scaled.steps, n_steps, S
        if scaled.T:
            state = e, np.empty_like(e), s.copy(), np.empty_like(e)
            code.kelvin_march(*state, *arrays, start.v, scaled.h, start.rate, start.decay, *sizes)
        else:
            code.elastic_march(e, *arrays, start.v, scaled.h, *sizes)
        return e, S

    return march


def same_state(one: tuple[Any, Any], two: tuple[Any, Any]) -> bool:
    """Whether two marches went the same way, to rounding."""
    return all(np.allclose(a, b, rtol=1e-9, atol=1e-9) for a, b in zip(one, two, strict=True))


# --- an ODE solver ---


def cof_by_solve_ivp(case: SlidingContact, v: float, n_springs: int, rtol: float) -> float:
    """COF over mu_0 of a Kelvin contact by scipy's RK45, from full slip, the mean over the last of four periods."""
    from scipy.integrate import solve_ivp

    springs, T = SpringArray.of(case, n_springs), case.T
    gap, w = springs.gap / case.cycle.du_z, springs.width / springs.width.sum()
    kept = gap <= kept_gap(T)
    off = np.where(kept, 2 * np.pi, leaving_phase(gap, T))
    on = np.array([0.0 if keeps else touching_phase(c, T) for keeps, c in zip(kept, gap, strict=True)])

    def normal_force(t: float) -> Any:
        phase = t % (2 * np.pi)
        return np.where((phase < off) | (phase >= on), np.maximum(np.cos(t) - gap - T * np.sin(t), 0), 0)

    def rates(t: float, x: Any) -> Any:
        N, e = normal_force(t), x[:-2]
        force = np.clip(e + T * v, -N, N)
        return np.concatenate([(force - e) / T, [w @ force, w @ N]])

    start = np.concatenate([np.maximum(1 - gap, 0), [0.0, 0.0]])
    first = solve_ivp(rates, (0, 6 * np.pi), start, rtol=rtol, atol=rtol, max_step=0.5).y[:, -1]
    first[-2:] = 0
    last = solve_ivp(rates, (6 * np.pi, 8 * np.pi), first, rtol=rtol, atol=rtol, max_step=0.5).y[:, -1]
    return float(last[-2] / last[-1])
