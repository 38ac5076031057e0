"""Sphere: down to which depth is a parabola a good approximation of a colloidal probe?

A silica ball of 5 µm radius on the cantilever of an atomic force microscope slides on silicone rubber (PDMS) while its
depth oscillates by 20 nm at 1 kHz, far below the resonances of the cantilever: the pull is a spring without mass. A
ball touches less than its parabola does, a = a_p [1 - d/(6R) + ...] at the same depth, and

    v_c = mu_0 kappa omega du_z (1 + k_xc/k_x),   Eq. (15) with m = 0,

takes over the relative error in k_xc = 2 G* a, but only in its second term. Force and static COF take it over
too. Which of them is the first to be off by 1 %, and does a stiffer cantilever help?
"""

import warnings

import numpy as np
from scipy.optimize import brentq

import mdr
from mdr.plots import COLOURS, save, style

warnings.simplefilter("ignore", mdr.PlausibilityWarning)  # the ball is pressed far beyond small slopes, on purpose
ball, parabola = mdr.Sphere(R=5e-6), mdr.Paraboloid(R=5e-6)
pdms, mu_0, du_z, omega = mdr.Elastic(E=2e6, nu=0.5), 0.5, 20e-9, 2 * np.pi * 1e3
cantilever = mdr.SpringPull(k_x=20)


def contact(u_z0, indenter=ball, pull=cantilever):
    """The probe pressed to the depth u_z0."""
    return mdr.SlidingContact(indenter, pdms, mu_0, mdr.NormalOscillation(u_z0, du_z, omega), pull)


def force(case):
    """Mean normal force [N]."""
    return float(case.indenter.force(case.oscillation.u_z0, pdms.E_star))


def off(quantity, u_z0, pull=cantilever):
    """Error of the parabola in a quantity of the contact, at the depth u_z0."""
    return quantity(contact(u_z0, parabola, pull)) / quantity(contact(u_z0, ball, pull)) - 1


def left_at(quantity, pull=cantilever, error=0.01):
    """Depth [m] at which the parabola is off by that error; nan where it is not, down to the radius of the ball."""
    if abs(off(quantity, ball.R, pull)) < error:
        return np.nan
    return brentq(lambda d: abs(off(quantity, d, pull)) - error, 2 * du_z, ball.R)


depths = np.geomspace(40e-9, 4e-6, 25)
quantities = {"force $F_N$": force, "$v_c$, Eq. (15)": mdr.critical_velocity, "static COF": mdr.static_cof}
errors = {name: np.array([off(quantity, d) for d in depths]) for name, quantity in quantities.items()}
springs = np.array([2.0, 5.0, 20.0, 50.0, 200.0])  # N/m, from a soft lever to a stiff one
limits = np.array([left_at(mdr.critical_velocity, mdr.SpringPull(k_x=k)) for k in springs])
force_limit, probed = left_at(force), 1e-6
velocities = np.array([mdr.critical_velocity(contact(d)) for d in depths])
eq_1 = mdr.critical_velocity(contact(probed, pull=mdr.RigidPull()))
full = mdr.full_slip_critical_velocity(contact(probed))
v_0 = full * np.array([0.25, 0.5, 0.75])
runs = {
    shape: [mdr.slide(contact(probed, shape), v, n_springs=64, steps_per_period=256) for v in v_0]
    for shape in (ball, parabola)
}


def figure():
    """v_c over depth, and the error of the parabola in force, v_c and friction."""
    import matplotlib.pyplot as plt

    flat = [mdr.critical_velocity(contact(d, parabola)) for d in depths]
    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2))
        left.semilogx(1e6 * depths, 1e6 * velocities, label="ball")
        left.semilogx(1e6 * depths, 1e6 * np.array(flat), "--", color="0.4", label="parabola")
        left.axhline(1e6 * eq_1, color="0.6", ls=":", label="rigid pull, any shape: Eq. (1)")
        left.set(title=f"a soft lever, {cantilever.k_x:g} N/m, lets $v_c$ know the depth", ylim=(0, None))
        left.set(xlabel="depth $u_{z0}$ [µm]", ylabel="$v_c$ [µm/s]")
        left.legend()
        for (name, values), colour in zip(errors.items(), COLOURS, strict=False):
            right.loglog(1e6 * depths, 100 * np.abs(values), color=colour, label=name)
        right.axhline(1, color="0.4", lw=0.8)
        right.plot(1e6 * force_limit, 1, "o", color=COLOURS[0])
        right.plot(1e6 * left_at(mdr.critical_velocity), 1, "o", color=COLOURS[1])
        right.set(title="what the parabola misses: the force goes first", xlabel="depth $u_{z0}$ [µm]")
        right.set(ylabel="error of the parabola [%]", ylim=(1e-3, 30))
        right.legend()
    return fig


if __name__ == "__main__":
    print(f"the parabola's force is off by 1 % from {1e9 * force_limit:.0f} nm; its v_c, by the spring of the lever:")
    for k, d in zip(springs, limits, strict=True):
        print(f"{k:6.0f} N/m: " + (f"from {1e9 * d:.0f} nm" if np.isfinite(d) else "not within the radius of the ball"))
    print(f"{1e6 * probed:g} µm deep: v_c = {1e6 * full:.2f} µm/s, Eq. (1) {1e6 * eq_1:.2f} µm/s; at a quarter of it,")
    pairs = zip(runs[ball], runs[parabola], strict=True)
    print("a half, three quarters: COF", ", ".join(f"{one.cof:.5f} (parabola {two.cof:.5f})" for one, two in pairs))
    print("figure:", save(figure(), __file__))
