"""Constant pressure: does a seal that presses evenly slide like a punch or like a ball?

A lip seal of a rubber of 6 MPa is shaped so that it presses with 0.1 MPa all over its face of 4 mm radius when fully
pressed, at the deepest point of the vibration of a pump: 50 Hz with a third and a fifth harmonic. A flat punch and a
ball that touch over the same radius and carry the same force are as stiff, so that Eq. (15) is the same for all three,
and the static COF too as long as the amplitude is small. What tells them apart is how the stiffness changes with
the depth: not at all for the punch, as sqrt(d) for the ball, and ever less for the seal until its whole face touches.
Which of them keeps closest to Eq. (15)?
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

omega, mu_0, a, d_0 = 2 * np.pi * 50, 0.6, 4e-3, 100e-6
rubber = mdr.KelvinVoigt(E=6e6, nu=0.5, tau=2e-4)
seal = mdr.ConstantPressure(a, d_0)
shaft = mdr.SpringPull(k_x=4e4, m=0.8, c_x=40.0)
series = np.array([1.0, 0.0, -0.25, 0.0, 0.1])  # cosines of the vibration, in its first
amplitudes = d_0 * np.array([0.02, 0.1, 0.2, 0.3])


def contacts(du_z, pull=shaft):
    """Seal, punch and ball of one radius and force at their mean depths, under the same vibration."""
    cos = tuple(du_z * series)
    u_z0 = d_0 - sum(cos)  # fully pressed at t = 0
    force, radius = float(seal.force(u_z0, rubber.E_star)), float(seal.contact_radius(u_z0))
    others = {  # their depths by F_N = 2 E* a d and (4/3) E* a d
        "punch": (mdr.FlatPunch(radius), force / (2 * rubber.E_star * radius)),
        "ball": (mdr.Paraboloid(4 * radius**3 * rubber.E_star / (3 * force)), 3 * force / (4 * rubber.E_star * radius)),
    }
    return {
        name: mdr.SlidingContact(shape, rubber, mu_0, mdr.PeriodicMotion(omega, depth, cos), pull)
        for name, (shape, depth) in {"seal": (seal, u_z0), **others}.items()
    }


names = tuple(contacts(amplitudes[0]))
eq_15 = np.array([[mdr.critical_velocity(contacts(du_z)[name]) for name in names] for du_z in amplitudes])
of_period = [
    [(mdr.full_slip_critical_velocity(case), mdr.static_cof(case)) for case in contacts(du_z).values()]
    for du_z in amplitudes
]
full, at_rest = np.moveaxis(of_period, -1, 0)  # (n_amplitudes, 3) each
eq_1 = mdr.critical_velocity(contacts(amplitudes[-1], mdr.RigidPull())["seal"])


def figure():
    """Pressures at the mean depth, the error of Eq. (15), and the static COF."""
    import matplotlib.pyplot as plt

    r = np.linspace(0, 0.999 * a, 300)
    with style():
        fig, axes = plt.subplot_mosaic([["pressure", "off"], ["pressure", "static"]], figsize=(8.6, 5.8))
        left, middle, right = axes["pressure"], axes["off"], axes["static"]
        cases = contacts(amplitudes[1])
        for i, (name, colour) in enumerate(zip(names, COLOURS, strict=False)):
            p = cases[name].indenter.pressure(r, cases[name].oscillation.u_z0, rubber.E_star)
            left.plot(1e3 * r, 1e-6 * p, color=colour, label=name)
            middle.plot(1e6 * amplitudes, 100 * (full[:, i] / eq_15[:, i] - 1), "o-", color=colour, label=name)
            right.plot(1e6 * amplitudes, at_rest[:, i], "o-", color=colour, label=name)
        fully = seal.pressure(r, d_0, rubber.E_star)
        left.plot(1e3 * r, 1e-6 * fully, ":", color=COLOURS[0], label="seal, fully pressed")
        left.set(title=f"mean pressures at {1e6 * amplitudes[1]:g} µm", xlabel="$r$ [mm]", ylabel="$p$ [MPa]")
        left.set(ylim=(0, 0.25))
        middle.axhline(0, color="0.4", lw=0.8)
        middle.set(title="how far $v_c$ is off Eq. (15)", ylabel="off Eq. (15) [%]")
        right.set(title="static limit of friction", ylabel=r"coefficient of friction $\mu$")
        for ax in (middle, right):
            ax.set_xlabel("amplitude of the first harmonic [µm]")
        for ax in (left, middle, right):
            ax.legend()
    return fig


if __name__ == "__main__":
    print(f"rigid pull at {1e6 * amplitudes[-1]:g} µm: {1e3 * eq_1:.3f} mm/s for all three")
    print("amplitude [µm]   Eq. (15) [mm/s]   off it [%]: " + ", ".join(names) + "    static COF: " + ", ".join(names))
    for du_z, v, off, rest in zip(amplitudes, eq_15, 100 * (full / eq_15 - 1), at_rest, strict=True):
        row = "{:14.0f} {:17.3f} {:+17.3f} {:+7.3f} {:+7.3f} {:16.4f} {:7.4f} {:7.4f}"
        print(row.format(1e6 * du_z, 1e3 * v[0], *off, *rest))
    print("figure:", save(figure(), __file__))
