"""Ball with a worn cap: at which relaxation time does a vibrating floor lower the friction of a slider most?

A slider of 0.2 kg stands on three rubber buttons, balls of 5 mm worn to a cap of 40 mm. A spring pulls it, while the
floor vibrates at 50 Hz. The rubber is a standard linear solid: 1 MPa in the long run, 4 MPa at once, with a
relaxation time tau_1 that temperature moves by decades. As tau_1 grows, its stiffness K_z(omega) = 2a E*(omega) runs
along a semicircle from the soft to the hard one, with the most loss at the top; and Eq. (15) is a distance to it,

    v_c = mu_0 omega du_z |kappa A - K_z|/|A|,    A = m omega² - k_x - i omega c_x.

So the least v_c belongs to an end, rubber that is fast or slow, if kappa A lies below the circle between its ends, as
a damper c_x makes it; and the greatest to a rubber in between: where the line from kappa A through the middle leaves.
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

omega, mu_0, v_0 = 2 * np.pi * 50, 0.7, 1.2e-3
button = mdr.CappedParaboloid(R1=40e-3, R2=5e-3, b=0.6e-3)
vibration = mdr.NormalOscillation(u_z0=60e-6, du_z=8e-6, omega=omega)
body = mdr.SpringPull(k_x=3e3, m=0.2 / 3, c_x=5.0)  # a button's share


def slider(tau_1, pull=body):
    """A button of the rubber whose relaxation time is tau_1."""
    return mdr.SlidingContact(button, mdr.StandardLinearSolid(1e6, 3e6, tau_1, nu=0.5), mu_0, vibration, pull)


times = np.geomspace(1e-2, 1e2, 49) / omega
v_c = np.array([mdr.critical_velocity(slider(tau_1)) for tau_1 in times])
K_z = 2 * button.contact_radius(60e-6) * np.array([slider(tau_1).material.dynamic_modulus(omega) for tau_1 in times])
kappa_A = -slider(1.0).material.mindlin_ratio / body.receptance(omega)
eq_1 = mdr.critical_velocity(slider(1.0, mdr.RigidPull()))
best = times[np.argmax(v_c)]
some = np.array([0.01, 0.2, 1.0, 4.0, 100]) / omega
at_rest, full = np.array([(mdr.static_cof(c), mdr.full_slip_critical_velocity(c)) for c in map(slider, some)]).T
cof = np.array([mdr.slide(slider(tau_1), v_0, n_springs=64, steps_per_period=256).cof for tau_1 in some])


def figure():
    """Semicircle of the dynamic stiffness K_z (Cole-Cole plot); v_c over relaxation time; static COF and COF at v_0."""
    import matplotlib.pyplot as plt

    with style():
        fig, axes = plt.subplot_mosaic([["circle", "v_c"], ["circle", "cof"]], figsize=(8.6, 5.8))
        circle, left, right = axes["circle"], axes["v_c"], axes["cof"]
        circle.plot(1e-3 * K_z.real, 1e-3 * K_z.imag, color=COLOURS[0], label="$K_z$, from fast to slow rubber")
        circle.plot(1e-3 * kappa_A.real, 1e-3 * kappa_A.imag, "k^", label=r"$\kappa A$ of the slider")
        far = K_z[np.argmax(v_c)]
        line = 1e-3 * np.array([kappa_A, far])
        circle.plot(line.real, line.imag, ":", color="0.4", label="greatest distance")
        circle.set(title="$v_c$ is a distance in this plane", aspect="equal", ylim=(-2.8, 6.5), xlim=(1, 9))
        circle.set(xlabel=r"$\mathrm{Re}$ [kN/m]", ylabel=r"$\mathrm{Im}$ [kN/m]")
        circle.legend(loc="upper left")
        left.axhline(1e3 * eq_1, color="0.4", ls="--", label="rigid pull: Eq. (1)")
        left.semilogx(omega * times, 1e3 * v_c, label="Eq. (15)")
        left.semilogx(omega * some, 1e3 * full, "o", color=COLOURS[0], label="all harmonics of $F_N$")
        left.axhline(1e3 * v_0, color=COLOURS[1], lw=1, label=f"$v_0$ of the slider, {1e3 * v_0:g} mm/s")
        left.set(title="greatest for a rubber in between", ylabel="$v_c$ [mm/s]", ylim=(0, None))
        right.axhline(mu_0, color="0.4", lw=0.8, label=r"full slip: $\mu_0$")
        right.semilogx(omega * some, cof, "o-", color=COLOURS[1], label=f"at {1e3 * v_0:g} mm/s")
        right.semilogx(omega * some, at_rest, "s--", color="0.5", label="static")
        right.set(title="friction: lowered most near there", ylabel=r"coefficient of friction $\mu$", ylim=(0, None))
        for ax in (left, right):
            ax.set_xlabel(r"$\omega\tau_1$")
            ax.legend(loc="lower left")
    return fig


if __name__ == "__main__":
    print(f"rigid pull: {1e3 * eq_1:.3f} mm/s; Eq. (15) from {1e3 * v_c.min():.3f} to {1e3 * v_c.max():.3f} mm/s,")
    print(f"the greatest at omega tau_1 = {omega * best:.2f}")
    print(f"omega tau_1   v_c, Eq. (15) [mm/s]   all harmonics [mm/s]    static COF   at {1e3 * v_0:g} mm/s")
    for tau_1, v, rest, mu in zip(some, full, at_rest, cof, strict=True):
        row = omega * tau_1, 1e3 * mdr.critical_velocity(slider(tau_1)), 1e3 * v, rest, mu
        print("{:11.3f} {:22.3f} {:22.3f} {:13.4f} {:13.4f}".format(*row))
    print("figure:", save(figure(), __file__))
