"""Truncated cone: does the critical velocity depend on how far a tip is worn?

A stone of the road, a cone of 17° that traffic polishes flat, presses into the rubber of a tread block with 2 N while
the block bounces by 30 µm at 100 Hz. Tread rubber is nearly a power law, E ~ (i omega)^0.2; the block hangs on its
carcass by a spring. Rigidly pulled, v_c would be the same for any wear, Eq. (1). On the spring v_c depends on the
dynamic stiffness K_z(omega) = 2a E*(omega), Eq. (15), and so on the contact radius, which grows with the face.
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

omega, mu_0, du_z, load, slope = 2 * np.pi * 100, 0.8, 30e-6, 2.0, np.deg2rad(17)
rubber = mdr.Prony.power_law(modulus=4e6, exponent=0.2, omega=(100, 3e3), nu=0.5, error=0.02)
block = mdr.SpringPull(k_x=3e4, m=5e-3, c_x=5.0)


def stone(b, pull=block):
    """The stone with a face of radius b, as deep as the load presses it in the long run."""
    indenter = mdr.TruncatedCone(b, slope) if b else mdr.Cone(slope)
    oscillation = mdr.NormalOscillation(mdr.static_depth(indenter, rubber, load), du_z, omega)
    return mdr.SlidingContact(indenter, rubber, mu_0, oscillation, pull)


def radius(case):
    """Contact radius at the mean depth [m]."""
    return float(case.indenter.contact_radius(case.oscillation.u_z0))


faces = np.linspace(0, 2e-3, 21)
worn = [stone(b) for b in faces]
depths, radii = np.array([(case.oscillation.u_z0, radius(case)) for case in worn]).T
eq_15 = np.array([mdr.critical_velocity(case) for case in worn])
eq_1 = mdr.critical_velocity(stone(0, mdr.RigidPull()))
marked = [0, 10, 20]  # of the faces
full, at_rest = np.array([(mdr.full_slip_critical_velocity(worn[i]), mdr.static_cof(worn[i])) for i in marked]).T
v_0 = 20e-3
runs = [mdr.slide(worn[i], v_0, n_springs=48, steps_per_period=256) for i in (marked[0], marked[-1])]


def figure():
    """The worn shapes, and v_c over the radius of the face."""
    import matplotlib.pyplot as plt

    r = np.linspace(-2.5e-3, 2.5e-3, 401)
    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2))
        for i, colour in zip(marked, COLOURS, strict=False):
            f = worn[i].indenter.profile_3d(r) - depths[i]
            left.plot(1e3 * r, 1e3 * f, color=colour, label=f"$b$ = {1e3 * faces[i]:g} mm")
            left.plot(1e3 * radii[i] * np.array([-1, 1]), [0, 0], "|", ms=10, color=colour)
        left.axhline(0, color="0.4", lw=0.8)
        left.set(title=f"pressed with {load:g} N: the face grows, the depth falls", ylim=(-0.6, 0.6))
        left.set(xlabel="$r$ [mm] (ticks: edge of contact)", ylabel="height over the surface [mm]")
        left.legend(loc="upper center", ncols=2)
        right.axhline(1e3 * eq_1, color="0.4", ls="--", label="rigid pull: Eq. (1)")
        right.plot(1e3 * faces, 1e3 * eq_15, color="0.3", label="block on its spring: Eq. (15)")
        right.scatter(1e3 * faces[marked], 1e3 * full, color=COLOURS[: len(marked)], zorder=3)
        right.plot([], [], "o", color="0.5", label="the same, all harmonics of $F_N$")
        right.set(title="wear shifts $v_c$", xlabel="radius of the face $b$ [mm]", ylabel="$v_c$ [mm/s]")
        right.set(ylim=(0, None))
        right.legend(loc="lower right")
    return fig


if __name__ == "__main__":
    print(f"rigid pull, any wear: {1e3 * eq_1:.2f} mm/s")
    print("b [mm]   depth [mm]   a [mm]   v_c, Eq. (15) [mm/s]   all harmonics [mm/s]    static COF")
    for i, v_c, rest in zip(marked, full, at_rest, strict=True):
        row = 1e3 * faces[i], 1e3 * depths[i], 1e3 * radii[i], 1e3 * eq_15[i], 1e3 * v_c, rest
        print("{:6.2f} {:12.3f} {:8.3f} {:22.2f} {:22.2f} {:13.3f}".format(*row))
    new, old = (f"{run.cof:.4f}" for run in runs)
    print(f"at {1e3 * v_0:g} mm/s the COF is {new} for the new stone, {old} for the worn one")
    print("figure:", save(figure(), __file__))
