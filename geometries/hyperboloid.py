"""Hyperboloid: can friction under oscillation tell how blunt a scanning tip has become?

A diamond tip, a hyperboloid that ends in a flank of 30° with a radius of curvature R = c²/h from 10 nm when new to
10 µm when spent, slides on an elastomer under 2 µN, while its depth oscillates by 40 nm at 200 Hz. Pulled rigidly all
tips have the same v_c, Eq. (1), whatever their wear. The static COF differs: a blunt tip rests higher, so that the same
amplitude is more of its depth, but loses less of its force for it, as F_N goes with depth from d² (cone) to
d^1.5 (paraboloid).
"""

import warnings

import numpy as np

import mdr
from mdr.plots import save, style

omega, mu_0, du_z, load = 2 * np.pi * 200, 0.5, 40e-9, 2e-6
elastomer = mdr.KelvinVoigt.from_loss_tangent(E=10e6, nu=0.5, tan_delta=0.1, omega=omega)
flank = np.tan(np.deg2rad(30))


def tip(R):
    """The hyperboloid of tip radius R between the flanks."""
    return mdr.Hyperboloid(h=R * flank**2, c=R * flank)


def contact(indenter):
    """The indenter at the depth to which the load presses it."""
    oscillation = mdr.NormalOscillation(mdr.static_depth(indenter, elastomer, load), du_z, omega)
    return mdr.SlidingContact(indenter, elastomer, mu_0, oscillation)


radii = np.geomspace(10e-9, 10e-6, 25)
worn = [contact(tip(R)) for R in radii]
depths = np.array([case.oscillation.u_z0 for case in worn])
at_rest = np.array([mdr.static_cof(case) for case in worn])
of_cone = mdr.static_cof(contact(mdr.Cone(np.deg2rad(30))))
with warnings.catch_warnings():
    warnings.simplefilter("ignore", mdr.PlausibilityWarning)  # the parabola of the sharpest tips is far too steep
    of_ball = np.array([mdr.static_cof(contact(mdr.Paraboloid(R))) for R in radii])
v_c = mdr.critical_velocity(worn[0])
stages = {R: contact(tip(R)) for R in (10e-9, 0.3e-6, 1e-6, 10e-6)}
velocities = v_c * np.linspace(0, 1.1, 34)
curves = {R: mdr.cof_curve(case, velocities) for R, case in stages.items()}
told = float(np.interp(-0.95 * of_cone, -at_rest, radii))  # radius at which the static COF has fallen by 5 %


def figure():
    """COF over velocity at four stages of wear, and static COF over the tip radius."""
    import matplotlib.pyplot as plt

    with style():
        fig, (left, right) = plt.subplots(1, 2, sharey=True, figsize=(9.5, 4.2))
        for R, curve in curves.items():
            label = f"{1e9 * R:.0f} nm" if R < 1e-6 else f"{1e6 * R:.0f} µm"
            left.plot(1e6 * velocities, curve.cof / mu_0, label=label)
            right.plot(1e6 * R, curve.static_cof / mu_0, "o", ms=8, zorder=3)
        left.axvline(1e6 * v_c, color="0.4", ls=":")
        left.annotate("$v_c$", (1e6 * v_c, 0.42), (-4, 0), textcoords="offset points", ha="right")
        left.set(title="one $v_c$ for every tip, Eq. (1)", xlabel="pulling velocity $v_0$ [µm/s]")
        left.set(ylabel=r"coefficient of friction $\mu/\mu_0$", ylim=(0.4, 1.02), xlim=(0, None))
        left.legend(title="tip radius")
        right.semilogx(1e6 * radii, at_rest / mu_0, color="0.3", label="hyperboloid")
        right.axhline(of_cone / mu_0, color="0.5", ls="--", label="cone")
        right.semilogx(1e6 * radii, of_ball / mu_0, color="0.5", ls=":", label="paraboloid")
        right.set(title="the static COF tells the radius", xlabel="tip radius [µm]")
        right.legend(loc="lower left")
    return fig


if __name__ == "__main__":
    print(f"v_c = {1e6 * v_c:.2f} µm/s for every tip; under {1e6 * load:g} µN:")
    for R, case in stages.items():
        half = np.interp(v_c / 2, velocities, curves[R].cof)
        rest = curves[R].static_cof
        deep = 1e9 * case.oscillation.u_z0
        print(f"R = {1e9 * R:6.0f} nm: {deep:.0f} nm deep, static COF {rest:.4f}, {half:.4f} at v_c/2")
    print(f"5 % less static COF than the cone's {of_cone:.4f}: R = {1e9 * told:.0f} nm")
    print("figure:", save(figure(), __file__))
