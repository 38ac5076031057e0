"""Implicit host: how does an integrator take a contact with memory, and why must it not reject steps?

A slider on a ball of rubber is pressed by a load that vibrates, pulled up to 0.6 of mu_0 F_N, and held there; it moves
along x and z. The host is the generalised alpha method (Chung and Hulbert 1993, in the form of Arnold and Brüls 2007),
of second order, which asks for forces at the ends of steps alone:

    M a_1 + F(x_1) = P_1,   x_1 = c + g a_1;   Newton's method: (M + g K) da = P_1 - F - M a_1,   K = dF/du.

Every trial begins from the state of the last accepted step. An adaptive solver calls its right side at stages out of
order, and again after steps that it rejects without a word: a contact that is advanced by each call has slid on ways
that never were.

The answer: 50 steps in a period of the free vibration are good to 0.5 %, the error falls with dt², and two iterations
do. The held slider comes to rest and does not creep. RK45, fed a state, is wrong by 2 % of the way and 5 % of the loss
at best, whatever its tolerance.
"""

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

import mdr
from mdr.plots import COLOURS, save, style

mu_0, m, load = 0.5, 1e-3, 0.03  # -, kg, N
element = mdr.ContactElement(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), mu_0, u_z_max=60e-6, n_springs=64)
depth = float(mdr.static_depth(element.indenter, element.material, load))
stiffness = 2 * element.material.E_star * float(element.indenter.contact_radius(depth))  # k_zc [N/m]
period, ramp, end = 2 * np.pi * np.sqrt(m / stiffness), 0.02, 0.06  # s
rho = 0.8  # spectral radius at infinite frequency
alpha_m, alpha_f = (2 * rho - 1) / (rho + 1), rho / (rho + 1)
gamma, beta = 0.5 + alpha_f - alpha_m, 0.25 * (1 + alpha_f - alpha_m) ** 2


class Run(NamedTuple):
    """How the slider moved."""

    t: np.ndarray  #: (n,) [s]
    x: np.ndarray  #: (n, 2) along the pull, and depth [m]
    lost: float  #: by friction [J]
    newton: list | None = None  #: residuals [N] of one step, with K and with the tangent at rest
    unbalanced: float = 0.0  #: work supplied, less kinetic energy and what the contact took [J]
    calls: int = 0  #: of the right side


def pull(t):
    """Forces P along x and z [N]; the vibration of the load ends with the ramp."""
    s = np.clip(t / ramp, 0, 1)
    smooth = s * s * (3 - 2 * s)
    return np.array([0.6 * mu_0 * load * smooth, load * (1 + 0.3 * np.sin(np.pi * s) ** 2 * np.sin(1000 * t))])


def begin():
    """Position [m], and the contact at rest there."""
    x = np.array([0.0, depth])
    return x, element.at_rest((x[0], 0.0, x[1]))


def solved(state, c, g, P, a, K_held=None):
    """Acceleration, new state, and residuals [N] of Newton's method, or of one with a tangent that is held."""
    residuals = []
    while True:
        x = c + g * a
        F, new, K = element.step(state, 0.0, (x[0], 0.0, x[1]), tangent=True)
        residuals.append(np.abs(P - F[::2] - m * a).max())
        if residuals[-1] < 1e-13 * load or len(residuals) == 40:
            return a, new, residuals
        a = a + np.linalg.solve(m * np.eye(2) + g * (K[::2, ::2] if K_held is None else K_held), P - F[::2] - m * a)


def host(dt, look_at=0.0, until=end):
    """The run of fixed steps; Newton's method is kept of the first step after `look_at`."""
    x, state = begin()
    v, a, a_hat, P, supplied, looked = np.zeros(2), np.zeros(2), np.zeros(2), pull(0.0), 0.0, None
    K_0 = element.step(state, 0.0, (x[0], 0.0, x[1]), tangent=True)[2][::2, ::2]
    g, found = dt * dt * beta * (1 - alpha_f) / (1 - alpha_m), [x]
    for i in range(round(until / dt)):
        known = (alpha_f * a - alpha_m * a_hat) / (1 - alpha_m)
        c, t = x + dt * v + dt * dt * ((0.5 - beta) * a_hat + beta * known), (i + 1) * dt
        P_0, P = P, pull(t)
        if looked is None and t > look_at:
            looked = [solved(state, c, g, P, a, K)[2] for K in (None, K_0)]
        a, state, _ = solved(state, c, g, P, a)
        a_0, a_hat = a_hat, known + (1 - alpha_f) / (1 - alpha_m) * a
        v, x_0, x = v + dt * ((1 - gamma) * a_0 + gamma * a_hat), x, c + g * a
        supplied += 0.5 * (P_0 + P) @ (x - x_0)
        found.append(x)
    off = supplied - 0.5 * m * v @ v - (state[3] - begin()[1][3])
    times = np.arange(len(found)) * dt
    return Run(times, np.array(found), float(element.dissipated(state)), newton=looked, unbalanced=off)


def rejecting(rtol):
    """The run of solve_ivp with a contact that each call of its right side advances."""
    x, state = begin()

    def rate(t, y):
        nonlocal state
        F, state = element.step(state, 0.0, (y[0], 0.0, y[1]))
        return np.concatenate([y[2:], (pull(t) - F[::2]) / m])

    found = solve_ivp(rate, (0, end), [*x, 0.0, 0.0], rtol=rtol, atol=rtol * depth)
    return Run(found.t, found.y[:2].T, float(element.dissipated(state)), calls=found.nfev)


per_period, tolerances = np.array([12, 25, 50, 100, 200]), (1e-3, 1e-5, 1e-7)
fine = host(period / 1600)
runs = {n: host(period / n, look_at=0.6 * ramp) for n in per_period}
held = host(period / 50, until=0.42)  # so long that the vibration has died away
adaptive = {rtol: rejecting(rtol) for rtol in tolerances}
way = np.ptp(fine.x[:, 0])


def missed(run):
    """Greatest error of the way, over the way."""
    return np.abs(run.x[:, 0] - np.interp(run.t, fine.t, fine.x[:, 0])).max() / way


errors = np.array([missed(run) for run in runs.values()])
unbalanced = np.array([abs(run.unbalanced) for run in runs.values()]) / fine.lost
wrong = {rtol: (missed(run), run.lost / fine.lost - 1) for rtol, run in adaptive.items()}
last = [held.x[(held.t > low) & (held.t <= low + 0.04), 0].mean() for low in (0.34, 0.38)]
creep = (last[1] - last[0]) / way


def figure():
    """The way of the slider, the error over the step, and Newton's method in one step."""
    import matplotlib.pyplot as plt

    with style():
        fig, (ways, order, newton) = plt.subplots(1, 3, figsize=(13, 4.4))
        ways.plot(1e3 * fine.t, 1e6 * fine.x[:, 0], color="black", label="fixed steps")
        for rtol, colour in zip(tolerances[:2], COLOURS[1:], strict=False):
            run = adaptive[rtol]
            ways.plot(1e3 * run.t, 1e6 * run.x[:, 0], color=colour, lw=1.2, label=f"RK45, rtol = {rtol:g}")
        ways.set(title="pulled to 0.6 of the limit", xlabel="time [ms]", ylabel="way [µm]")
        ways.legend(loc="lower right")
        order.loglog(per_period, errors, "o-", label="way")
        order.loglog(per_period, unbalanced, "s-", label="energy, over the loss")
        order.loglog(per_period, errors[0] * (per_period[0] / per_period) ** 2.0, "k--", lw=1.2, label="second order")
        order.set(title="error of fixed steps", xlabel="steps in a period", ylabel="relative error")
        order.set_xticks(per_period, per_period)
        order.minorticks_off()
        order.legend(loc="upper right")
        for residuals, label in zip(runs[12].newton, ("tangent $K$", "tangent at rest"), strict=True):
            newton.semilogy(residuals, "o-", label=label)
        newton.set(title="Newton's method, 12 steps in a period", xlabel="iteration", ylabel="residual [N]")
        newton.legend(loc="upper right")
    return fig


if __name__ == "__main__":
    print(f"free vibration {1e3 * period:.2f} ms; loss by friction {1e9 * fine.lost:.3f} nJ")
    print("steps in a period   error of the way   of the energy   iterations with K, with that at rest")
    for n, way_off, energy_off, run in zip(per_period, errors, unbalanced, runs.values(), strict=True):
        iterations = [len(one) - 1 for one in run.newton]
        print(f"{n:17d} {way_off:18.1e} {energy_off:15.1e} {iterations[0]:19d} {iterations[1]:16d}")
    print(f"held for 0.4 s: it moves by {creep:.0e} of its way in the last 40 ms")
    for rtol, run in adaptive.items():
        print(f"RK45, rtol = {rtol:g}: {run.calls} calls for {run.t.size - 1} steps,", end=" ")
        print(f"way off by {wrong[rtol][0]:.3f}, loss by {wrong[rtol][1]:+.2f}")
    print("figure:", save(figure(), __file__))
