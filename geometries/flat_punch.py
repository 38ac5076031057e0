"""Flat punch: does a rubber foot creep when the table under it vibrates, and how much does a lossy rubber help?

A machine of 0.8 kg stands on four rubber feet of 5 mm radius and is pulled by a soft spring; the table shakes at 100 Hz
and changes the depth of each foot by 15 µm of 50 µm. At rest the friction left is its least value in the period,

    mu(0) = mu_0 [1 - (du_z/u_z0) sqrt(1 + T²)],   T = omega tau,   Eq. (7),

so loss in the rubber lowers it, down to nothing where contact is lost, Eq. (5). Pulled faster than v_c, Eq. (15), the
foot has all its friction back. A flat punch has constant stiffness: both formulas are exact for it.
"""

from dataclasses import replace

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

vibration = mdr.NormalOscillation(u_z0=50e-6, du_z=15e-6, omega=2 * np.pi * 100)
pull = mdr.SpringPull(k_x=2e3, m=0.2)  # a foot's share of the machine


def foot(T, du_z=vibration.du_z):
    """One foot of a rubber of 3 MPa whose loss tangent is T at the frequency of the table."""
    rubber = mdr.KelvinVoigt.from_loss_tangent(E=3e6, nu=0.5, tan_delta=T, omega=vibration.omega)
    return mdr.SlidingContact(mdr.FlatPunch(a=5e-3), rubber, 0.8, replace(vibration, du_z=du_z), pull)


loss_tangents = (0.0, 0.3, 1.0, 3.0)
v_c = [mdr.critical_velocity(foot(T)) for T in loss_tangents]  # Eq. (15)
lost_above = [vibration.u_z0 / np.hypot(1, T) for T in loss_tangents]  # amplitude at which Eq. (5) ends
shares = np.r_[0, np.geomspace(0.02, 0.08, 3), np.linspace(0.16, 0.94, 8), 1.15]  # of v_c; steep near 0
curves = [mdr.cof_curve(foot(T), v * shares) for T, v in zip(loss_tangents, v_c, strict=True)]
static = [curve.static_cof for curve in curves]  # Eq. (7)
beyond = 1.2 * np.array(lost_above)
at_rest_beyond = [mdr.static_cof(foot(T, du_z)) for T, du_z in zip(loss_tangents, beyond, strict=True)]


def figure():
    """COF over pulling velocity, and the static COF over amplitude, for each loss tangent."""
    import matplotlib.pyplot as plt

    with style():
        fig, (left, right) = plt.subplots(1, 2, sharey=True, figsize=(9, 4))
        for i, (T, colour) in enumerate(zip(loss_tangents, COLOURS, strict=False)):
            look = {"color": colour, "ms": 6 - i, "lw": 2.8 - 0.4 * i}  # thinner on top: two curves nearly agree
            left.plot(1e3 * curves[i].v_0, curves[i].cof, "-", label=rf"$T = {T:g}$", **look)
            left.plot(1e3 * v_c[i], 0.82, "v", color=colour)
            amplitude = [0, vibration.du_z, lost_above[i], beyond[i]]  # straight in between
            cof = [0.8, static[i], 0, at_rest_beyond[i]]
            right.plot(np.multiply(amplitude, 1e6), cof, "o-", clip_on=False, **look)
        left.set(
            title="pulled: full friction above $v_c$, Eq. (15) (triangles)", xlabel="pulling velocity $v_0$ [mm/s]"
        )
        left.set(ylabel=r"coefficient of friction $\mu$", ylim=(0, 0.86), xlim=(0, None))
        left.legend(loc="lower right", title="loss tangent")
        right.axvline(1e6 * vibration.du_z, color="0.4", ls=":")
        right.annotate("this table", (1e6 * vibration.du_z, 0.82), (4, 0), textcoords="offset points")
        right.set(title="static limit: no friction once contact is lost", xlabel=r"amplitude $\Delta u_z$ [µm]")
        right.set(xlim=(0, None))
    return fig


if __name__ == "__main__":
    print("loss tangent   v_c [mm/s]    static COF   contact lost above [µm]")
    for row in zip(loss_tangents, np.multiply(v_c, 1e3), static, np.multiply(lost_above, 1e6), strict=True):
        print("{:12.1f} {:12.3f} {:13.3f} {:25.1f}".format(*row))
    print("figure:", save(figure(), __file__))
