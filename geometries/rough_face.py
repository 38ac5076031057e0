"""Rough face: does polishing a brake pad bring its friction back sooner, when the load on it vibrates?

A steel pad is pressed on a steel disc by 100 N, and a motor shakes the load by 20 N at 500 Hz. Load and stiffness of a
rough face are proportional, k_zc = F_N/l, with l of the order of the height of roughness (Persson 2007). So the depth
swings by l dF_z/F_z0, whatever the modulus and the area, and

    v_c = mu_0 kappa omega l dF_z/F_z0.

A rough pad yields more: its friction stays low up to a higher velocity. Polished tenfold, v_c is a tenth. Friction at
slow sliding is mu_0 times the least over the mean load for any face, and over v_0/v_c all pads have one curve.
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

omega, mu_0, load, shaken = 2 * np.pi * 500, 0.4, 100.0, 20.0
steel = mdr.ElasticPair(E_1=210e9, nu_1=0.3, E_2=210e9, nu_2=0.3)
motion = mdr.LoadOscillation(F_z0=load, dF_z=shaken, omega=omega)


def pad(l_e):
    """The pad of this e-fold length of the load."""
    return mdr.SlidingContact(mdr.RoughFace.under_load(load / 10, l_e, steel.E_star), steel, mu_0, motion)


lengths = np.geomspace(0.05e-6, 5e-6, 25)
v_c = np.array([mdr.critical_velocity(pad(l_e)) for l_e in lengths])
law = mu_0 * steel.mindlin_ratio * omega * lengths * shaken / load
finish = {"ground": 2e-6, "lapped": 0.5e-6, "polished": 0.1e-6}
pads = {name: pad(l_e) for name, l_e in finish.items()}
v_0 = 1.1 * mdr.critical_velocity(pads["ground"]) * np.linspace(0, 1, 45) ** 2
curves = {name: mdr.cof_curve(case, v_0) for name, case in pads.items()}


def figure():
    """COF over velocity of three finishes, and the critical velocity over the length of roughness."""
    import matplotlib.pyplot as plt

    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2))
        for (name, curve), colour in zip(curves.items(), COLOURS, strict=False):
            left.plot(1e3 * v_0, curve.cof / mu_0, color=colour, label=f"{name}, $l$ = {1e6 * finish[name]:g} µm")
            left.plot(1e3 * curve.v_c, 1, "v", ms=8, color=colour, clip_on=False)
            right.plot(1e6 * finish[name], 1e3 * curve.v_c, "v", ms=8, color=colour, zorder=3)
        left.set(title="polished, friction is back sooner", xlabel="pulling velocity $v_0$ [mm/s]")
        left.set(ylabel=r"coefficient of friction $\mu/\mu_0$", ylim=(0.78, 1.01), xlim=(0, None))
        left.legend(loc="lower right")
        right.loglog(1e6 * lengths, 1e3 * v_c, color="0.3", label="critical velocity")
        right.loglog(1e6 * lengths, 1e3 * law, color="0.6", ls=":", label=r"$\mu_0\kappa\omega l\,\Delta F_z/F_{z0}$")
        right.set(title="$v_c$ is proportional to the roughness", xlabel="length $l$ [µm]", ylabel="$v_c$ [mm/s]")
        right.legend(loc="upper left")
    return fig


if __name__ == "__main__":
    print("finish     l [µm]   v_c [mm/s]   static COF")
    for name, curve in curves.items():
        print(f"{name:9} {1e6 * finish[name]:7.2f} {1e3 * curve.v_c:12.4f} {curve.static_cof:12.4f}")
    print("figure:", save(figure(), __file__))
