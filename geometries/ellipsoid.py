"""Ellipsoid: can the vibration of a touch screen be felt as less friction?

A fingertip, an ellipsoid of half-axes 8 mm across and 6 mm along, strokes a glass plate that vibrates at 150 Hz with
30 µm, what a strong actuator gives. Skin softens within milliseconds: a standard linear solid of 100 kPa in the long
run, 250 kPa at once. Arm and finger pull through some 500 N/m, which carry 5 g. Frictional contrasts of about 10 % are
noticed (haptic literature). Is a light touch or a firm one easier to fool, up to which speed, and does it matter that a
finger is no ball? At the same depth an ellipsoid touches less than the parabola of the same curvature, 1/(k² R).

Limit: the half-space is quasi-static while the contact is small against the shear wave, `wave_over_radius`.
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

finger = mdr.Ellipsoid(R=6e-3, k=1 / 8e-3)
parabola = mdr.Paraboloid(R=1 / (finger.k**2 * finger.R))
skin = mdr.StandardLinearSolid(E_inf=100e3, E_1=150e3, tau_1=2e-3, nu=0.5)
mu_0, du_z, omega, arm = 0.9, 30e-6, 2 * np.pi * 150, mdr.SpringPull(k_x=500, m=5e-3, c_x=1.0)


def touch(u_z0, indenter=finger):
    """The finger pressed flat by u_z0."""
    return mdr.SlidingContact(indenter, skin, mu_0, mdr.NormalOscillation(u_z0, du_z, omega), arm)


depths = np.array([0.05e-3, 0.1e-3, 0.3e-3, 0.8e-3, 1.6e-3])
loads = finger.force(depths, skin.E_star)  # mean force [N], of the long-time modulus
eq_15 = np.array([mdr.critical_velocity(touch(d)) for d in depths])
at_rest, full = np.transpose([(mdr.static_cof(c), mdr.full_slip_critical_velocity(c)) for c in map(touch, depths)])
of_parabola = mdr.static_cof(touch(depths[-1], parabola))
force_of_parabola = float(parabola.force(depths[-1], skin.E_star))
light, firm = 1, 3  # which of the depths
speeds = 1e-3 * np.array([1.0, 5.0, 12.0, 20.0])
coarse = {"n_springs": 64, "steps_per_period": 256}  # to 1e-4: enough to feel
cof = {i: [mdr.slide(touch(depths[i]), v, **coarse).cof for v in speeds] for i in (light, firm)}
noticed = 0.9 * mu_0
wave_over_radius = np.sqrt(skin.E_inf / 3 / 1000) / 150 / float(finger.contact_radius(depths[-1]))


def figure():
    """COF over the speed of a light and a firm touch, and v_c over the load."""
    import matplotlib.pyplot as plt

    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2))
        for (i, values), name, colour in zip(cof.items(), ("light", "firm"), COLOURS, strict=False):
            label = f"{name} touch, {loads[i]:.2g} N"
            left.plot(np.r_[0, 1e3 * speeds], np.r_[at_rest[i], values], "o-", color=colour, label=label)
        left.axhspan(0, noticed, color="0.93", zorder=0)
        left.annotate("noticed: 10 % less", (10, noticed), (0, -14), textcoords="offset points", ha="center")
        left.set(title="friction on the vibrating plate", xlabel="speed of the finger $v_0$ [mm/s]")
        left.set(ylabel=r"coefficient of friction $\mu$", ylim=(0, 0.95), xlim=(0, None))
        left.legend(loc="lower right")
        right.semilogx(loads, 1e3 * full, "o-", color=COLOURS[2], label="$v_c$, all harmonics of $F_N$")
        right.semilogx(loads, 1e3 * eq_15, "x", color="0.3", label="$v_c$, Eq. (15)")
        right.set(title="a firm finger is dragged along, and $v_c$ falls", ylabel="$v_c$ [mm/s]")
        right.set(xlabel="mean force of the finger [N]", ylim=(0, None))
        right.legend()
    return fig


if __name__ == "__main__":
    print("load [N]    static COF   v_c, Eq. (15) [mm/s]   all harmonics [mm/s]")
    for row in zip(loads, at_rest, 1e3 * eq_15, 1e3 * full, strict=True):
        print("{:8.3f} {:13.3f} {:22.2f} {:22.2f}".format(*row))
    print(f"the parabola in its place: {of_parabola:.3f} at rest under {force_of_parabola:.3f} N, as deep as the last")
    for i, values in cof.items():
        at = (f"{1e3 * v:g} mm/s {c:.3f}" for v, c in zip(speeds, values, strict=True))
        print(f"{loads[i]:.2g} N at", ", ".join(at))
    print(f"the shear wave is {wave_over_radius:.1f} contact radii long at least")
    print("figure:", save(figure(), __file__))
