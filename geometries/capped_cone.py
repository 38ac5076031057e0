"""Cone with a worn cap: how much does the oscillation of a nanoindenter falsify the friction of its scratch test?

Continuous stiffness measurement lets the depth oscillate by 5 nm at 75 Hz while a Berkovich tip, a cone of 70.3° from
its axis, is drawn over a silicone rubber at 1 µm/s and pressed ever deeper. Worn tips end in a cap, 50 nm to 1 µm in
radius of curvature. The pull is stiff: v_c is that of Eq. (1) for any wear and any depth, and the scratch is slower.
What is missing of the friction is, for so small an amplitude, k_zc du_z/F_N times the deficit psi(v_0/v_c) of a flat
punch, and k_zc u_z0/F_N goes from 2 (cone) to 3/2 (paraboloid). Down to which depth is that more than 1 %?
"""

import numpy as np
from scipy.optimize import brentq

import mdr
from mdr.closed_forms.paper import deficit
from mdr.plots import COLOURS, save, style

omega, mu_0, du_z, v_0, theta = 2 * np.pi * 75, 1.0, 5e-9, 1e-6, np.deg2rad(90 - 70.3)
silicone = mdr.KelvinVoigt.from_loss_tangent(E=5e6, nu=0.5, tan_delta=0.05, omega=omega)


def tip(R):
    """The Berkovich cone with a cap of the radius of curvature R."""
    return mdr.CappedCone(R * np.tan(theta), theta) if R else mdr.Cone(theta)


def scratch(R, u_z0):
    """The tip at a depth u_z0 of its scratch."""
    return mdr.SlidingContact(tip(R), silicone, mu_0, mdr.NormalOscillation(u_z0, du_z, omega))


def missing(R, u_z0):
    """Share of the friction that the oscillation takes away."""
    return 1 - mdr.cof_curve(scratch(R, u_z0), [v_0]).cof[0] / mu_0


def small(R, u_z0):
    """The same for a small amplitude and an elastic body."""
    case = scratch(R, u_z0)
    return case.k_zc * du_z / float(case.indenter.force(u_z0, silicone.E_star)) * deficit(v_0 / v_c)


v_c = mdr.critical_velocity(scratch(0, 1e-6))
caps = (0.0, 50e-9, 200e-9, 1000e-9)
depths = np.geomspace(1.2 * du_z, 1e-6, 8)
lost = {R: np.array([missing(R, d) for d in depths]) for R in caps}
approximate = {R: np.array([small(R, d) for d in depths]) for R in caps}


def depth_of(share, R):
    """Depth at which that share is missing: near that of a small amplitude, on nearly a power law."""
    guess = np.log(brentq(lambda d: small(R, d) - share, 20e-9, 1e-6))
    return np.exp(brentq(lambda log_d: np.log(missing(R, np.exp(log_d)) / share), guess - 0.2, guess + 0.2, xtol=1e-4))


one_per_cent = {R: depth_of(0.01, R) for R in caps}


def figure():
    """The tips, and what is missing of the friction over the depth of the scratch."""
    import matplotlib.pyplot as plt

    r = np.linspace(-400e-9, 400e-9, 401)
    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2), width_ratios=(2, 3))
        for R, colour in zip(caps, COLOURS, strict=False):
            left.plot(1e9 * r, 1e9 * tip(R).profile_3d(r), color=colour, label=f"{1e9 * R:.0f} nm" if R else "sharp")
            right.loglog(1e9 * depths, 100 * lost[R], color=colour)
            right.loglog(1e9 * depths, 100 * approximate[R], ":", color=colour)
            right.plot(1e9 * one_per_cent[R], 1, "o", color=colour)
        left.set(title="Berkovich cone, new and worn", xlabel="$r$ [nm]", ylabel="$f(r)$ [nm]", ylim=(0, 220))
        left.legend(title="radius of the cap", loc="upper center")
        right.axhline(1, color="0.4", lw=0.8)
        right.plot([], [], "k-", label="exact")
        right.plot([], [], "k:", label=r"small amplitude: $(k_{zc}\Delta u_z/F_N)\,\psi$")
        right.set(title=f"friction missing at {1e6 * v_0:g} µm/s, with $v_c$ = {1e6 * v_c:.2f} µm/s")
        right.set(xlabel="depth of the scratch [nm]", ylabel="missing of the friction [%]", ylim=(0.3, 100))
        right.legend()
    return fig


if __name__ == "__main__":
    print(f"v_c = {1e6 * v_c:.3f} µm/s for every tip and depth; scratched at {1e6 * v_0:g} µm/s")
    for R, d in one_per_cent.items():
        at_100 = 100 * missing(R, 100e-9), 100 * small(R, 100e-9)
        print(
            f"cap of {1e9 * R:4.0f} nm: 100 nm deep {at_100[0]:.3f} % are missing ({at_100[1]:.3f} if small),", end=" "
        )
        print(f"1 % at {1e9 * d:.0f} nm")
    print("figure:", save(figure(), __file__))
