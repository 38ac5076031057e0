"""Every COF of slide() with default knobs beside the independent twin: `python tests/table_of_accuracy.py`.

Takes minutes, as the twin is slow. One line a family: the worst error, the worst share of its own bound cof_error that
an error takes, and how much larger than the error the bound is in the median. The tests assert the same on fewer cases
(test_accuracy.py); the cases themselves are made here, from the dimensionless groups of theory.md.
"""

from __future__ import annotations

import itertools
import math
import sys
import time
from dataclasses import dataclass

import numpy as np
import reference

import mdr

SHAPES = reference.SHAPES
ALPHAS = (0.03, 0.4, 0.9, 1.7)
V_HATS = (0.05, 0.37, 0.81, 0.97)
TS = (0.3, 1.0, 3.0)
#: k_x/k_xc, omega_0/omega, damping ratio: soft and above, stiff and near, heavy and below resonance
BODIES = ((0.7, 1.6, 0.07), (3.0, 1.1, 0.1), (0.3, 0.6, 0.05))

# units of the contact: an ordinary rubber hemisphere
E, NU, MU_0, A_0, DU_Z, OMEGA = 3e6, 0.4, 0.5, 1e-3, 2e-6, 300.0


def shape_of(n, a_0, depth):
    """Indenter of power n with contact radius a_0 at the given depth (of its own unit for depth <= 0)."""
    if math.isinf(n):
        return mdr.FlatPunch(a=a_0)
    if n == 1:
        return mdr.Cone(theta=math.atan(2 * depth / (math.pi * a_0)))
    if n == 2:
        return mdr.Paraboloid(R=a_0**2 / depth)
    return mdr.PowerLaw(n=n, c=depth / (mdr.PowerLaw(n=n, c=1.0).stretch * a_0**n))


def contact(n, alpha, T=0.0, body=None, *, mu_0=MU_0, young=E, nu=NU, a_0=A_0, du_z=DU_Z, omega=OMEGA, indenter=None):
    """The contact with the given groups: shape n, alpha = du_z/u_z0, T = omega tau, body = (k_x/k_xc, omega_0/omega, zeta).

    omega_0/omega = inf is a body without mass; zeta is then c_x omega/(2 k_x). Alpha and body refer to the mean depth,
    and so does a_0.
    """
    depth = du_z / alpha
    material = mdr.KelvinVoigt(E=young, nu=nu, tau=T / omega) if T else mdr.Elastic(E=young, nu=nu)
    pull = mdr.RigidPull()
    if body is not None:
        k_ratio, omega_0_ratio, zeta = body
        k_xc = 2 * material.G_star * a_0
        c_ratio = 2 * zeta * k_ratio / (omega_0_ratio if math.isfinite(omega_0_ratio) else 1.0)
        mass = k_ratio * k_xc / (omega_0_ratio * omega) ** 2
        pull = mdr.SpringPull(k_x=k_ratio * k_xc, m=mass, c_x=c_ratio * k_xc / omega)
    shape = indenter or shape_of(n, a_0, depth)
    return mdr.SlidingContact(shape, material, mu_0, mdr.NormalOscillation(depth, du_z, omega), pull)


def unit_of_speed(case):
    """mu_0 kappa omega du_z [m/s]."""
    return case.mu_0 * case.material.mindlin_ratio * case.oscillation.omega * case.oscillation.du_z


@dataclass(frozen=True)
class Row:
    """One COF beside the twin, both over mu_0."""

    groups: tuple
    cof: float
    bound: float
    truth: float
    doubt: float  #: of the twin

    @property
    def error(self):
        """What is certain of the error, once the doubt of the twin is taken off."""
        return max(abs(self.cof - self.truth) - self.doubt, 0.0)

    @property
    def whole_error(self):
        return abs(self.cof - self.truth)


def compare(groups, truth, doubt, case, v_hat):
    run = mdr.slide(case, v_hat * unit_of_speed(case))
    if not run.settled:
        raise RuntimeError(f"{groups}: {run.why}")
    return Row(groups, run.cof / case.mu_0, run.cof_error / case.mu_0, truth, doubt)


# --- families -----------------------------------------------------------------------------------------------


def rigid_elastic(shapes=tuple(SHAPES), alphas=ALPHAS, v_hats=V_HATS):
    for shape, alpha, v_hat in itertools.product(shapes, alphas, v_hats):
        n = SHAPES[shape]
        truth = reference.rigid_elastic_cof(n, 1 / alpha, v_hat)  # converged to 1e-12, test_reference.py
        yield compare((shape, alpha, v_hat), truth, 0.0, contact(n, alpha), v_hat)


def rigid_kelvin(shapes=tuple(SHAPES), alphas=ALPHAS, v_hats=V_HATS, Ts=TS):
    for shape, alpha, T, v_hat in itertools.product(shapes, alphas, Ts, v_hats):
        n = SHAPES[shape]
        truth = reference.rigid_kelvin_cof(n, 1 / alpha, v_hat, T)  # converged to 1e-11
        yield compare((shape, alpha, T, v_hat), truth, 0.0, contact(n, alpha, T), v_hat)


def spring_pull(shapes=tuple(SHAPES), alphas=(0.3, 1.2), Ts=(0.0, *TS), bodies=BODIES, shares=(0.2, 0.5, 0.8, 0.97), **knobs):
    """Shares are of v_c; knobs are those of the twin."""
    for shape, alpha, T, body in itertools.product(shapes, alphas, Ts, bodies):
        n = SHAPES[shape]
        k, omega_0, zeta = body
        c = reference.damping_for(zeta, k, omega_0)
        v_hats = reference.full_slip_critical_velocity(n, 1 / alpha, T, k, omega_0, c) * np.array(shares)
        truths, doubts = reference.spring_pull_cof(n, 1 / alpha, v_hats, T, k, omega_0, c, **knobs)
        for share, v_hat, truth, doubt in zip(shares, v_hats, truths, doubts, strict=True):
            yield compare((shape, alpha, T, body, share), truth, doubt, contact(n, alpha, T, body), v_hat)


# --- the table ----------------------------------------------------------------------------------------------


def summary(rows):
    """Worst error, worst error over bound, median of bound over error, worst doubt of the twin."""
    error, bound = (np.array([getattr(row, name) for row in rows]) for name in ("whole_error", "bound"))
    certain = np.array([row.error for row in rows])
    return certain.max(), (certain / bound).max(), np.median(bound / np.maximum(error, 1e-16)), max(row.doubt for row in rows)


def main(names):
    families = {"rigid_elastic": rigid_elastic, "rigid_kelvin": rigid_kelvin, "spring_pull": spring_pull}
    print("| family | cases | worst error | worst error/bound | median bound/error | doubt of twin | s |")
    print("| --- | --- | --- | --- | --- | --- | --- |", flush=True)
    for name in names or families:
        start = time.perf_counter()
        rows = list(families[name]())
        worst, share, median, doubt = summary(rows)
        took = time.perf_counter() - start
        print(f"| {name} | {len(rows)} | {worst:.2g} | {share:.2g} | {median:.3g} | {doubt:.2g} | {took:.0f} |", flush=True)
        for row in sorted(rows, key=lambda row: -row.error / row.bound)[:5]:
            print(f"    {row.groups}: error {row.whole_error:.2e} (twin {row.doubt:.1e}), bound {row.bound:.2e}", file=sys.stderr)
        for row in sorted(rows, key=lambda row: -row.error)[:5]:
            print(f"    worst: {row.groups}: error {row.whole_error:.2e}, bound {row.bound:.2e}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
