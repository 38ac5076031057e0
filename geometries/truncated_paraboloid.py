"""Truncated paraboloid: what does running-in do to a friction test under an oscillating load?

A PTFE ball of 3 mm radius wears flat on a steel disc, as in any ball-on-disc tribometer, under a load of 10 N that a
shaker modulates by 3 N at 25 Hz. Friction at slow sliding is mu_0 times the least over the mean load, 0.7 mu_0, for
any shape: with the force given, the shape has no say. But how fast is slow? Pulled rigidly,

    v_c = mu_0 kappa omega dF_z/|K_z(omega)|,   K_z = 2 a E*(omega),

since the depth yields to the load; and a worn ball touches more.
"""

import numpy as np
from scipy.optimize import brentq

import mdr
from mdr.plots import COLOURS, save, style

omega, mu_0, ball = 2 * np.pi * 25, 0.1, 3e-3
ptfe = mdr.KelvinVoigt.from_loss_tangent(E=0.5e9, nu=0.46, tan_delta=0.1, omega=omega)
shaken = mdr.LoadOscillation(F_z0=10.0, dF_z=3.0, omega=omega)


def slider(b):
    """The ball with a flat of radius b."""
    indenter = mdr.TruncatedParaboloid(b, ball) if b else mdr.Paraboloid(ball)
    return mdr.SlidingContact(indenter, ptfe, mu_0, shaken)


flats = np.linspace(0, 1.2e-3, 25)
v_c = np.array([mdr.critical_velocity(slider(b)) for b in flats])
halved = brentq(lambda b: mdr.critical_velocity(slider(b)) - v_c[0] / 2, flats[1], flats[-1])
stages = {b: slider(b) for b in (0.0, 0.4e-3, 1.0e-3)}
full = {b: mdr.full_slip_critical_velocity(case) for b, case in stages.items()}
at_rest = {b: mdr.static_cof(case) for b, case in stages.items()}
v_0 = v_c[0] * np.array([0.06, 0.12, 0.25, 0.4, 0.6, 0.8])
coarse = {"n_springs": 64, "steps_per_period": 256}  # to 1e-4
cof = {b: np.array([mdr.slide(case, v, **coarse).cof for v in v_0 if v < full[b]]) for b, case in stages.items()}


def figure():
    """COF over velocity at three stages of wear, and v_c over the flat."""
    import matplotlib.pyplot as plt

    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2))
        for (b, values), colour in zip(cof.items(), COLOURS, strict=False):
            v = np.r_[0, v_0[: len(values)], full[b], 1.1 * v_c[0]]
            mu = np.r_[at_rest[b], values, mu_0, mu_0]
            left.plot(1e6 * v, mu / mu_0, "-", color=colour, label=f"$b$ = {1e3 * b:g} mm")
            left.plot(1e6 * v[1:-2], mu[1:-2] / mu_0, "o", ms=4, color=colour)
            left.plot(1e6 * full[b], 1, "v", ms=8, color=colour, clip_on=False)
            right.plot(1e3 * b, 1e6 * full[b], "v", ms=8, color=colour, zorder=3)
        left.set(title="all begin at the least load, and end at their $v_c$ (triangles)", ylim=(0.65, 1.02))
        left.set(xlabel="pulling velocity $v_0$ [µm/s]", ylabel=r"coefficient of friction $\mu/\mu_0$", xlim=(0, None))
        left.legend(title="flat worn on the ball", loc="lower right")
        right.plot(1e3 * flats, 1e6 * v_c, color="0.3", label="small amplitude, $1/|K_z|$")
        right.plot([], [], "v", ms=8, color="0.5", label="all harmonics, at 30 % of the load")
        right.annotate("half of the new ball's", (1e3 * halved, 1e6 * v_c[0] / 2), (8, 2), textcoords="offset points")
        right.plot(1e3 * halved, 1e6 * v_c[0] / 2, "ko", ms=4)
        right.set(title="a worn ball is stiffer, and yields less", xlabel="radius of the flat $b$ [mm]")
        right.set(ylabel="$v_c$ [µm/s]", ylim=(0, None))
        right.legend(loc="lower left")
    return fig


if __name__ == "__main__":
    print("flat [mm]    static COF   v_c, small amplitude [µm/s]   all harmonics [µm/s]")
    for b, case in stages.items():
        small = mdr.critical_velocity(case)
        print(f"{1e3 * b:9.1f} {at_rest[b]:13.4f} {1e6 * small:29.1f} {1e6 * full[b]:22.1f}")
    print(f"v_c is half of the new ball's at a flat of {1e3 * halved:.3f} mm radius")
    print("figure:", save(figure(), __file__))
