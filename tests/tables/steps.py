"""Random steps of elements with arms beside the same in 400 parts: `python tests/tables steps [n] [seed]`.

Arms of 1 ns to 1000 s, steps of 1e-3 to 1e6 of their times; rest, lift, return, one and two directions. Holds if the
force misses that of 400 equal parts, and of 400 that are short at first, by less than 1e-3 of mu_0 F_z, no heat is
below zero, and nothing is NaN. Where it misses most, 1600 parts are asked too. `any`: of elements of every material;
`nan`: of these one step alone, which must be finite.
"""

import time

import numpy as np
from random_steps import CLOSER, EQUAL, KINDS, a_material, walk

import mdr

ALLOWED, OF_ROUNDING = 1e-3, 1e-14  #: of mu_0 F_z; of what energies are compared with


def main(n=3000, seed=25, of=""):
    rng, start, rows, worst = np.random.default_rng(seed), time.perf_counter(), [], None
    while len(rows) < n:
        for step in walk(rng, min(10, n - len(rows)), any_material(rng) if of else None):
            before = time.perf_counter()
            F, state, heat = step.in_parts()
            cost = time.perf_counter() - before
            finite = bool(np.isfinite(F).all() and np.isfinite(state).all())
            miss = 0.0 if of == "nan" else max(step.missed(F, EQUAL), step.missed(F, CLOSER))
            rows.append((step.kind, miss, heat / max(step.energy(state), 1e-300), cost, finite))
            if worst is None or miss > worst[0]:
                worst = miss, step, F
    misses, heats, costs, finite = (np.array([row[k] for row in rows]) for k in range(1, 5))
    print(f"{n} steps, seed {seed}, {time.perf_counter() - start:.0f} s")
    for kind in KINDS:
        those = misses[[row[0] == kind for row in rows]]
        print(f"  {kind:6} {those.size:5} worst {those.max(initial=0):.1e} of mu_0 F_z")
    print(f"worst {misses.max():.2e}, 99 % {np.quantile(misses, 0.99):.1e} of mu_0 F_z", end="")
    print("" if of == "nan" else f"; against 1600 parts {worst[1].missed(worst[2], np.arange(1, 1601) / 1600):.2e}")
    print(f"least heat {heats.min():.1e} of the energies; {(~finite).sum()} not finite")
    print(f"a step in us: median {1e6 * np.median(costs):.0f}, 99 % {1e6 * np.quantile(costs, 0.99):.0f}")
    return int(misses.max() > ALLOWED or heats.min() < -OF_ROUNDING or not finite.all())


def any_material(rng):
    """Of any family."""
    tau, nu = 10.0 ** rng.uniform(-9, 3), rng.uniform(0, 0.5)
    return [
        lambda: mdr.Elastic(E=2e6, nu=nu),
        lambda: mdr.KelvinVoigt(E=2e6, nu=nu, tau=tau),
        lambda: mdr.StandardLinearSolid(E_inf=2e6, E_1=2e6 * 10 ** rng.uniform(-2, 2), tau_1=tau, nu=nu),
        lambda: a_material(rng),
    ][rng.integers(4)]()
