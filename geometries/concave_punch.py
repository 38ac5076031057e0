"""Concave punch: at which normal amplitude does a hollow foot lose contact in the middle?

The foot of a gripper, a rubber cup of 15 mm radius whose hollow is pressed flat, holds sheets on a vibrating conveyor.
In complete contact it is a flat punch in all but its force, F_N = 2E*(a d + a h/3) with h = a²/R: constant stiffness,
Eq. (15) exact, and as v_0 -> 0

    mu(0) = mu_0 [1 - du_z sqrt(1 + T²)/(u_z0 + h/3)].

But the pressure in the middle goes with d - h + tau d': it is gone, and air gets in, once du_z sqrt(1 + T²) exceeds
u_z0 - h. So a foot that seals keeps at least the share (4h/3)/(u_z0 + h/3) of its friction. Beyond that only a ring
would touch, which the method leaves out.
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

omega, mu_0, T, u_z0 = 2 * np.pi * 60, 0.9, 0.3, 0.4e-3
cup = mdr.ConcavePunch(a=15e-3, R=0.9)
rubber = mdr.KelvinVoigt.from_loss_tangent(E=2e6, nu=0.5, tan_delta=T, omega=omega)
arm = mdr.SpringPull(k_x=5e4, m=0.6, c_x=30.0)
h = cup.least_depth  # complete contact from here on
limit = (u_z0 - h) / np.hypot(1, T)  # amplitude at which the middle lets go
punch_depth = float(cup.force(u_z0, 1.0)) / (2 * cup.a)  # of a flat punch under the same force


def foot(du_z, indenter=cup, depth=u_z0):
    """A foot pressed to a mean depth and vibrated by du_z."""
    return mdr.SlidingContact(indenter, rubber, mu_0, mdr.NormalOscillation(depth, du_z, omega), arm)


amplitudes = limit * np.linspace(0.1, 1, 10)
at_rest = np.array([mdr.static_cof(foot(du_z)) for du_z in amplitudes])
v_c = np.array([mdr.critical_velocity(foot(du_z)) for du_z in amplitudes])
full = np.array([mdr.full_slip_critical_velocity(foot(du_z)) for du_z in amplitudes[[0, -1]]])
shares = np.array([0, 0.05, 0.15, 0.3, 0.5, 0.7, 0.9, 1.1])  # of v_c
curves = {share: mdr.cof_curve(foot(share * limit), shares * share * v_c[-1]) for share in (0.5, 1.0)}
of_punch = mdr.cof_curve(foot(limit, mdr.FlatPunch(cup.a), punch_depth), shares * v_c[-1])


def figure():
    """Pressure under the foot between its extremes, and its friction up to the limit."""
    import matplotlib.pyplot as plt

    r = np.linspace(0, 0.999 * cup.a, 300)
    depths = {"deepest": u_z0 + limit, "mean": u_z0, "least": h}
    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2))
        for (name, d), colour in zip(depths.items(), COLOURS, strict=False):
            label = f"{1e3 * d:.2f} mm, {name}"
            left.plot(1e3 * r, 1e-3 * cup.pressure(r, d, rubber.E_star), color=colour, label=label)
        left.set(title="elastic pressure: gone in the middle at $d = a^2/R$", xlabel="$r$ [mm]", ylabel="$p$ [kPa]")
        left.set(ylim=(0, 120))
        left.legend(title="depth")
        for (share, curve), colour in zip(curves.items(), COLOURS, strict=False):
            label = f"hollow foot, {1e6 * share * limit:.0f} µm"
            right.plot(1e3 * curve.v_0, curve.cof, "o-", ms=8, color=colour, label=label)
        right.plot(1e3 * of_punch.v_0, of_punch.cof, ".", color="k", label="flat punch of the same force")
        least = mu_0 * (4 * h / 3) / (u_z0 + h / 3)
        right.axhline(least, color="0.4", ls=":", label="the least a sealed foot has")
        right.set(title="friction up to the limit of complete contact", xlabel="pulling velocity $v_0$ [mm/s]")
        right.set(ylabel=r"coefficient of friction $\mu$", ylim=(0, None), xlim=(0, None))
        right.legend()
    return fig


if __name__ == "__main__":
    print(f"complete contact from {1e6 * h:.0f} µm on: {1e6 * u_z0:g} µm deep up to du_z = {1e6 * limit:.1f} µm")
    print("amplitude [µm]    static COF   v_c [mm/s]")
    for row in zip(1e6 * amplitudes, at_rest, 1e3 * v_c, strict=True):
        print("{:14.1f} {:13.4f} {:12.3f}".format(*row))
    print(f"Eq. (15) is off by {np.abs(full / v_c[[0, -1]] - 1).max():.0e} at most;", end=" ")
    print(f"a flat punch under the same force by {np.abs(of_punch.cof - curves[1.0].cof).max():.0e} in the COF")
    print("figure:", save(figure(), __file__))
