"""Rounded punch: how does the critical velocity depend on the mean load, when the load is what oscillates?

A fretting rig presses a titanium pad, a flat of 1 mm radius whose edge is rounded with 3 mm, on titanium and shakes the
load by 300 N at 20 Hz. Where the load is given, the depth yields by dF_z/k_zc, and pulled rigidly

    v_c = mu_0 kappa omega dF_z/(2 E* a).

For a sharp punch a is the pad's, and v_c knows no mean load. A rounded one touches more under more load, from the flat
punch to the paraboloid, a ~ F_z0^(1/3). From which load on does the edge matter? For a small amplitude the shape has no
other say: k_zc du_z is dF_z, so that mu/mu_0 = 1 - (dF_z/F_z0) psi(v_0/v_c). Is 300 N of 500 N small?
"""

import numpy as np
from scipy.optimize import brentq

import mdr
from mdr.closed_forms.paper import deficit
from mdr.plots import COLOURS, save, style

omega, mu_0, dF_z, least = 2 * np.pi * 20, 0.6, 300.0, 500.0
titanium = mdr.ElasticPair(E_1=115e9, nu_1=0.32, E_2=115e9, nu_2=0.32)
shapes = {
    "sharp punch": mdr.FlatPunch(a=1e-3),
    "rounded punch": mdr.RoundedPunch(b=1e-3, R=3e-3),
    "paraboloid": mdr.Paraboloid(R=3e-3),
}


def pad(shape, F_z0):
    """A shape under the mean load F_z0."""
    return mdr.SlidingContact(shapes[shape], titanium, mu_0, mdr.LoadOscillation(F_z0, dF_z, omega))


loads = np.geomspace(400, 6e3, 10)
v_c = {shape: np.array([mdr.critical_velocity(pad(shape, F)) for F in loads]) for shape in shapes}
flat = v_c["sharp punch"][0]
matters = brentq(lambda F: mdr.critical_velocity(pad("rounded punch", F)) / flat - 0.9, loads[0], loads[-1])
full = {shape: mdr.full_slip_critical_velocity(pad(shape, least)) for shape in shapes}
shares = np.array([0.05, 0.15, 0.3, 0.5, 0.75])  # of v_c
coarse = {"n_springs": 64, "steps_per_period": 256}  # to 1e-4
cof = {shape: [mdr.slide(pad(shape, least), v * full[shape], **coarse).cof for v in shares] for shape in shapes}
psi = 1 - dF_z / least * np.array([deficit(v) for v in shares])
departure = {shape: float(np.abs(np.array(values) / mu_0 - psi).max()) for shape, values in cof.items()}


def figure():
    """v_c over the mean load of the three pads, and their friction under the least of the loads."""
    import matplotlib.pyplot as plt

    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2))
        for i, ((shape, values), mark, colour) in enumerate(zip(v_c.items(), "s^o", COLOURS, strict=False)):
            left.plot(1e-3 * loads, 1e6 * values, color=colour, label=shape)
            left.plot(1e-3 * least, 1e6 * full[shape], mark, color=colour)
            mu = np.r_[1 - dF_z / least, np.array(cof[shape]) / mu_0]
            right.plot(np.r_[0, shares], mu, mark, ms=11 - 3 * i, color=colour, label=shape)
        left.plot([], [], "o", color="0.5", label="at 300 N of 500 N, all harmonics")
        left.plot(1e-3 * matters, 0.9e6 * flat, "k.")
        left.annotate("10 % less", (1e-3 * matters, 0.9e6 * flat), (0, -14), textcoords="offset points", ha="center")
        left.set(title="a rounded edge lowers $v_c$ under load", ylim=(0, None), ylabel="$v_c$ [µm/s]")
        left.set(xlabel="mean load $F_{z0}$ [kN]", xlim=(0, None))
        left.legend()
        fine = np.linspace(0, 1, 60)
        line = [1 - dF_z / least * deficit(v) for v in fine]
        right.plot(fine, line, "k", lw=1, zorder=0, label=r"$1 - (\Delta F_z/F_{z0})\,\psi$")
        right.set(title="over $v_0/v_c$ the shape hardly matters (500 N)", xlabel="$v_0/v_c$")
        right.set(ylabel=r"$\mu/\mu_0$", ylim=(0.35, 1.03))
        right.legend(loc="lower right")
    return fig


if __name__ == "__main__":
    print(f"kappa = {titanium.mindlin_ratio:.4f}; sharp punch {1e6 * flat:.2f} µm/s at any load; rounded: 10 % less")
    print(f"from {1e-3 * matters:.2f} kN on; at {1e-3 * loads[-1]:g} kN {1e6 * v_c['rounded punch'][-1]:.2f} µm/s")
    for shape, values in cof.items():
        small, mu = 1e6 * mdr.critical_velocity(pad(shape, least)), ", ".join(f"{value / mu_0:.4f}" for value in values)
        print(f"{shape}, 300 N of 500 N: v_c {1e6 * full[shape]:.2f} µm/s ({small:.2f} if small)")
        print(f"   mu/mu_0 {mu} at {shares} of v_c: within {departure[shape]:.1e} of psi")
    print("figure:", save(figure(), __file__))
