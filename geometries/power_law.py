"""Power law f = c rⁿ: how does friction under oscillation depend on the shape of the tip, from cone to flat punch?

All tips are pressed 40 µm into a rubber and touch it over a radius of 1 mm; so they are equally stiff, and differ in
the force they carry, F_N/(k_zc u_z0) = n/(n + 1). The blunter the tip, the less of its force the oscillation takes
away and the higher the COF. For a small amplitude that is all the shape does: under a rigid pull

    (1 - mu/mu_0) F_N/(k_zc du_z) = psi(v_0/v_c)

is one curve for every shape, exact for the flat punch that keeps contact. How small is small?
"""

import numpy as np

import mdr
from mdr.closed_forms.paper import deficit
from mdr.plots import COLOURS, save, style

rubber, a, u_z0 = mdr.Elastic(E=5e6, nu=0.5), 1e-3, 40e-6


def tip(n):
    """The power law that touches over the radius a at the depth u_z0; n = inf is the flat punch."""
    return mdr.FlatPunch(a) if np.isinf(n) else mdr.PowerLaw(n, u_z0 / mdr.PowerLaw(n, 1.0).profile_1d(a))


def contact(n, alpha):
    """Tip n vibrated at 1 kHz with the amplitude alpha u_z0, pulled rigidly."""
    return mdr.SlidingContact(tip(n), rubber, 0.5, mdr.NormalOscillation(u_z0, alpha * u_z0, 2 * np.pi * 1e3))


def scaled(curve, case):
    """(1 - mu/mu_0) F_N/(k_zc du_z) of a curve."""
    F_N = case.indenter.force(u_z0, rubber.E_star)
    return (1 - curve.cof / case.mu_0) * F_N / (case.k_zc * case.oscillation.du_z)


exponents = (1, 2, 4, 8, np.inf)
v_hat = np.array([0.0, 0.1, 0.25, 0.4, 0.6, 0.8, 1.0])
psi = np.array([deficit(v) for v in v_hat])
amplitudes = (0.3, 0.03)
curves, collapsed = {}, {}
for n in exponents:
    for alpha in amplitudes:
        case = contact(n, alpha)
        curves[n, alpha] = mdr.cof_curve(case, v_hat * mdr.critical_velocity(case))
        collapsed[n, alpha] = scaled(curves[n, alpha], case)
departure = {key: float(np.abs(value - psi).max()) for key, value in collapsed.items()}


def figure():
    """COF curves of all tips at a large amplitude; the same scaled, at a large and a small one."""
    import matplotlib.pyplot as plt

    fine = np.linspace(0, 1, 60)
    names = {n: "flat punch" if np.isinf(n) else f"$n = {n}$" for n in exponents}
    large, small = amplitudes
    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2))
        for i, (n, colour) in enumerate(zip(exponents, COLOURS, strict=False)):
            left.plot(v_hat, curves[n, large].cof / 0.5, "o-", ms=4, color=colour, label=names[n])
            right.plot(v_hat, collapsed[n, large], "x", ms=8, mew=2, color=colour)
            right.plot(v_hat, collapsed[n, small], "o", ms=10 - 2 * i, color=colour)
        left.set(title=f"blunt tips keep more friction ($\\Delta u_z/u_{{z0}} = {large}$)")
        left.set(xlabel=r"$v_0/v_c$", ylabel=r"$\mu/\mu_0$")
        left.legend()
        right.plot(fine, [deficit(v) for v in fine], "k", zorder=0, label=r"$\psi$")
        right.plot([], [], "x", ms=8, mew=2, color="0.4", label=f"$\\Delta u_z/u_{{z0}} = {large}$")
        right.plot([], [], "o", ms=7, color="0.4", label=f"$\\Delta u_z/u_{{z0}} = {small}$")
        right.set(title="scaled: one curve for a small amplitude (dots)", xlabel=r"$v_0/v_c$")
        right.set(ylabel=r"$(1 - \mu/\mu_0)\,F_N/(k_{zc}\Delta u_z)$")
        right.legend()
    return fig


if __name__ == "__main__":
    print(f"greatest departure from psi at du_z/u_z0 = {amplitudes[0]} and {amplitudes[1]}")
    for n in exponents:
        lowered = 1 - curves[n, amplitudes[0]].cof[0] / 0.5
        far = ", ".join(f"{departure[n, alpha]:.1e}" for alpha in amplitudes)
        print(f"n = {n:3g}: {far}; static COF lowered by {100 * lowered:.1f} %")
    print("figure:", save(figure(), __file__))
