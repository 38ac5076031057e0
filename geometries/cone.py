"""Cone: in which sense is the critical velocity "independent of the indentation depth"?

A blunt cone slides on a soft gel at fixed amplitude, pressed ever deeper. Its stiffness k_xc = 2 G* a grows in
proportion to the depth, and Eq. (15), here without loss in the gel but with a damper c_x at the body,

    v_c = mu_0 kappa omega du_z |1 - k_xc/(m omega² - k_x - i omega c_x)|,

knows the depth through k_xc only. Under a rigid pull it drops out altogether, Eq. (1), and for a flat punch k_xc does
not change; for a cone under mass and spring v_c falls to a quarter at the depth where k_xc = m omega² - k_x, and rises
again. Around that depth Eq. (15) is also least accurate: where the first harmonic of the normal force moves the body
just as the springs need, the others weigh most.
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, plot_spring_map, save, style

omega, gel, mu_0, du_z = 2 * np.pi * 60, mdr.Elastic(E=1e6, nu=0.5), 0.6, 4e-6
cone = mdr.Cone(theta=0.05)
body = mdr.SpringPull(k_x=300, m=0.01, c_x=0.8)


def contact(u_z0, indenter=cone, pull=body):
    """The indenter pressed to the depth u_z0."""
    return mdr.SlidingContact(indenter, gel, mu_0, mdr.NormalOscillation(u_z0, du_z, omega), pull)


punch = mdr.FlatPunch(a=float(cone.contact_radius(30e-6)))  # as stiff as the cone 30 µm deep
depths = np.linspace(6e-6, 100e-6, 95)
eq_1 = mdr.critical_velocity(contact(30e-6, pull=mdr.RigidPull()))
eq_15 = np.array([mdr.critical_velocity(contact(d)) for d in depths])
full = np.array([mdr.full_slip_critical_velocity(contact(d)) for d in depths])
of_punch = np.array([mdr.critical_velocity(contact(d, punch)) for d in depths])
balanced = (body.m * omega**2 - body.k_x) / contact(1e-6).k_xc * 1e-6  # depth at which k_xc = m omega² - k_x
shallow, deep = 16e-6, 56e-6
verdicts = {d: mdr.verdict(contact(d)) for d in (shallow, deep)}
run = mdr.slide(contact(shallow), 0.4 * verdicts[shallow].eq_15, record=2)


def figure():
    """v_c over depth, the error of Eq. (15), and the springs of the shallow contact below v_c."""
    import matplotlib.pyplot as plt

    at, measured = 1e6 * np.array(list(verdicts)), np.array([v.measured for v in verdicts.values()])
    with style():
        fig, axes = plt.subplot_mosaic([["v_c", "map"], ["off", "map"]], figsize=(10, 6), height_ratios=(2, 1))
        top, off, springs = axes["v_c"], axes["off"], axes["map"]
        top.axhline(1e3 * eq_1, color="0.4", ls="--", label="rigid pull, any shape: Eq. (1)")
        top.plot(1e6 * depths, 1e3 * of_punch, color="0.6", label="mass and spring, flat punch: Eq. (15)")
        top.plot(1e6 * depths, 1e3 * eq_15, label="mass and spring, cone: Eq. (15)")
        top.plot(at, 1e3 * measured, "ko", label="the same, measured in runs")
        top.set(title="Eq. (15) knows the depth through $k_{xc}$ alone", ylim=(0, 2.2), ylabel="$v_c$ [mm/s]")
        top.legend(loc="upper left")
        off.axhline(0, color="0.4", lw=0.8)
        off.plot(1e6 * depths, 100 * (full / eq_15 - 1), color=COLOURS[1], label="all harmonics of $F_N$")
        off.plot(at, [100 * v.deviation for v in verdicts.values()], "ko", label="measured")
        off.set(xlabel="depth $u_{z0}$ [µm]", ylabel="off Eq. (15) [%]")
        off.legend(loc="upper left")
        for ax in (top, off):
            ax.set_xlim(0, 100)
        plot_spring_map(run, springs)
        springs.set_title(f"springs {1e6 * shallow:.0f} µm deep at $0.4\\,v_c$: the edge slips first", pad=26)
    return fig


if __name__ == "__main__":
    print(f"any depth: rigid pull, Eq. (1), {1e3 * eq_1:.3f} mm/s; flat punch, Eq. (15), {1e3 * of_punch[0]:.3f} mm/s")
    print(f"cone, Eq. (15): {1e3 * eq_15.min():.3f} to {1e3 * eq_15.max():.3f} mm/s, least {1e6 * balanced:.1f} µm in")
    for depth, verdict in verdicts.items():
        print(f"{1e6 * depth:.0f} µm deep: {verdict}")
    print("figure:", save(figure(), __file__))
