"""How fast the compiled march is against the same physics written as a plain vectorised NumPy loop.

Both march the same springs through the same steps with the same rules (trial step, bounds, change of mode and first
touch within the step), every spring computed, and end in the same state, which is checked before any time is taken.
Quoted are ratios of times measured in turn, in one run; absolute times are the machine's.

    python -m validation.performance
"""

from __future__ import annotations

import sys
import time
from typing import Any

import numpy as np

from mdr import SpringArray, kernels, slide
from mdr.contact import SlidingContact
from mdr.scaled import ScaledContact
from validation.cases import contact

N_SPRINGS, STEPS = 1000, 1024


def after_change(D_0: Any, D_1: Any, h: float, rate: float) -> Any:
    """What a new mode adds after a change within the step, see mdr/kernels.py."""
    lead = np.maximum(D_1, 0)
    rest = h * lead / (lead + np.maximum(-D_0, 0) + 1e-300)
    return 0.5 * lead * rest / (1 + 0.5 * rate * rest)


def numpy_step(e: Any, s_0: Any, scaled: ScaledContact, k: int, v: float, decay: float, rate: float) -> tuple[Any, Any]:
    """One step of all springs under a rigid pull in vectorised NumPy: new extensions and compressions."""
    z_0, z_1, zd_0, zd_1, h = scaled.z[k], scaled.z[k + 1], scaled.z_dot[k], scaled.z_dot[k + 1], scaled.h
    du, pressed = v * h, z_1 - scaled.gap
    if decay == 0:
        s = np.maximum(pressed, 0)
        way = np.minimum(s / (z_1 - z_0), 1) if z_1 > z_0 else np.minimum(s * 1e300, 1)
        travelled = way * (1 - kernels.bend_of.py_func(zd_0, zd_1) * (1 - way))
        late = float(after_change(zd_0 - v, zd_1 - v, h, 0.0)) if zd_0 < v else 0.0
        return np.maximum(np.minimum(e + travelled * du, s - travelled * late), -s), s
    relaxed = s_0 * decay
    ahead = s_0 - (z_0 - scaled.gap)
    leaving = np.where(ahead <= 0, after_change(-(zd_0 + s_0 * rate), -(zd_1 + pressed * rate), h, rate), 0)
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
    change = after_change(sign * D_0, sign * D_1, h, rate)
    forward = s - lag * decay
    first = np.minimum(np.where(sticks, trial, forward) - travelled * change, forward)
    return np.maximum(first, (s_0 + e) * decay - s), s


def numpy_march(scaled: ScaledContact, e: Any, s: Any, v: float, n_steps: int) -> tuple[Any, float]:
    """The plain loop: extensions at the end and the sum of w e over all steps."""
    decay = float(np.exp(-scaled.h / scaled.T)) if scaled.T else 0.0
    rate = 1 / scaled.T if scaled.T else 0.0
    total = 0.0
    for j in range(n_steps):
        e, s = numpy_step(e, s, scaled, j % scaled.steps, v, decay, rate)
        total += float(scaled.w @ e)
    return e, total


def compiled_march(scaled: ScaledContact, e: Any, s: Any, v: float, n_steps: int) -> tuple[Any, float]:
    """The same through the kernel that slide() calls."""
    e, s, S = e[None].copy(), s[None].copy(), np.empty(n_steps)
    nothing = np.empty((0, *e.shape))
    kernels.march(
        e,
        s,
        np.zeros(5),
        scaled.body,
        scaled.gap,
        scaled.w,
        scaled.z,
        scaled.z_dot,
        v,
        scaled.table,
        -np.inf,
        n_steps,
        0,
        np.empty(n_steps),
        S,
        nothing,
        nothing,
    )
    return e[0], float(S.sum())


def ratio(case: SlidingContact, v_hat: float = 0.4, repeats: int = 7) -> dict[str, float]:
    """Spring-steps per second of slide(), of its kernel and of the NumPy loop; medians of runs taken in turn."""
    scaled = ScaledContact.of(case, SpringArray.of(case, N_SPRINGS), STEPS, lump=False)
    s = np.zeros((1, scaled.gap.size))
    kernels.settle_normal(s, scaled.gap, scaled.w, scaled.z, scaled.z_dot, scaled.table)
    s = s[0]
    short, n_periods = STEPS, 40
    one, two = (march(scaled, s, s, v_hat, short) for march in (numpy_march, compiled_march))
    if not np.allclose(one[0], two[0], rtol=1e-9, atol=1e-9):
        raise RuntimeError("the NumPy loop and the compiled march do not end in the same state")
    v_0 = v_hat * scaled.speed
    timed: dict[str, list[float]] = {"numpy": [], "kernel": [], "slide": []}
    for _ in range(repeats):
        timed["numpy"].append(N_SPRINGS * short / _seconds(numpy_march, scaled, s, s, v_hat, short))
        timed["kernel"].append(
            N_SPRINGS * short * n_periods / _seconds(compiled_march, scaled, s, s, v_hat, short * n_periods)
        )
        run = {"n_springs": N_SPRINGS, "steps_per_period": STEPS, "n_periods": n_periods, "lump": False}
        timed["slide"].append(N_SPRINGS * short * n_periods / _seconds(slide, case, v_0, **run))
    medians = {name: float(np.median(values)) for name, values in timed.items()}
    paired = np.array(timed["slide"]) / np.array(timed["numpy"])
    return {
        **medians,
        "slide/numpy": float(np.median(paired)),
        "least": float(paired.min()),
        "most": float(paired.max()),
    }


def _seconds(function: Any, *args: Any, **kwargs: Any) -> float:
    start = time.perf_counter()
    function(*args, **kwargs)
    return time.perf_counter() - start


def main() -> int:
    """Print the table."""
    print(f"{N_SPRINGS} springs, {STEPS} steps per period, rigid pull, every spring computed")
    print(f"{'case':28s} {'slide / NumPy loop':>20s} {'(least ... most)':>18s} {'kernel / NumPy loop':>20s}")
    for label, case in (
        ("paraboloid, elastic", contact("paraboloid", 0.5)),
        ("paraboloid, Kelvin T = 1", contact("paraboloid", 0.5, 1.0)),
    ):
        slide(case, 1e-4, n_springs=N_SPRINGS, steps_per_period=STEPS, n_periods=1, lump=False)  # compile
        found = ratio(case)
        print(
            f"{label:28s} {found['slide/numpy']:20.1f} {found['least']:9.1f} ... {found['most']:.1f} "
            f"{found['kernel'] / found['numpy']:17.1f}"
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
