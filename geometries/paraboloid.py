"""Paraboloid: at which frequency does normal vibration make a rubber-tipped slider slide easily?

A tip of 2 mm radius under 1 g on a spring slides at 10 mm/s while its depth oscillates by 3 µm at 50 Hz to 20 kHz. The
critical velocity, Eq. (15) with a damper c_x at the body, has a pole at omega_0 = sqrt(k_x/m), where the body itself
is shaken along, and a zero at omega_1 = sqrt((k_x + k_xc)/m), where it yields just as the springs need; far above
both, the mass stands still and Eq. (1) is left. Friction is lowered where v_c exceeds the speed of the slider, and
comes down to the limit of slow sliding, which the loss in the rubber lowers further, where v_c exceeds it by far.

Limit: the half-space is quasi-static while the tip is small against the shear wave, `wave_over_radius`.
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, plot_spring_map, plot_traces, save, style

rubber = mdr.KelvinVoigt.from_loss_tangent(E=10e6, nu=0.5, tan_delta=0.1, omega=2 * np.pi * 1e3)
body = mdr.SpringPull(k_x=2e3, m=1e-3, c_x=0.3)
v_0 = 10e-3


def slider(f, pull=body):
    """The tip vibrated at f [Hz]."""
    vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=3e-6, omega=2 * np.pi * f)
    return mdr.SlidingContact(mdr.Paraboloid(R=2e-3), rubber, 0.7, vibration, pull)


f_0 = np.sqrt(body.k_x / body.m) / (2 * np.pi)  # pole
f_1 = np.sqrt((body.k_x + slider(f_0).k_xc) / body.m) / (2 * np.pi)  # zero
sweep = np.unique(np.concatenate([np.geomspace(50, 20e3, 240), [f_0, f_1]]))
eq_15 = np.array([mdr.critical_velocity(slider(f)) for f in sweep])
eq_1 = np.array([mdr.critical_velocity(slider(f, mdr.RigidPull())) for f in sweep])
shaken = np.array([60, 80, 110, 160, 190, f_0, 260, 300, f_1, 500, 800, 1500, 2500, 4e3, 6e3, 9e3, 13e3, 20e3])
runs = [mdr.slide(slider(f), v_0, n_springs=64, steps_per_period=256) for f in shaken]  # to 1e-4: enough to see
cof = np.array([run.cof for run in runs])
slow = np.geomspace(50, 20e3, 60)
static = np.array([mdr.static_cof(slider(f)) for f in slow])
shown = mdr.slide(slider(2e3), v_0, n_springs=384, steps_per_period=512, record=2)
wave_over_radius = np.sqrt(rubber.E / 3 / 1100) / 20e3 / float(mdr.Paraboloid(R=2e-3).contact_radius(20e-6))


def figure():
    """v_c and COF over frequency, and the springs of one run."""
    import matplotlib.pyplot as plt

    with style():
        fig, axes = plt.subplot_mosaic([["v_c", "map"], ["cof", "map"]], figsize=(10, 6))
        axes["v_c"].loglog(sweep, 1e3 * eq_15, label="mass and spring, Eq. (15)")
        axes["v_c"].loglog(sweep, 1e3 * eq_1, color="0.6", ls="--", label="rigid pull, Eq. (1)")
        axes["v_c"].axhline(1e3 * v_0, color=COLOURS[1], label="speed of the slider")
        axes["v_c"].set(title="friction is lowered where $v_c$ exceeds the speed ...", ylabel="$v_c$ [mm/s]")
        axes["cof"].semilogx(slow, static, "--", color="0.6", label="limit of slow sliding")
        axes["cof"].axhline(0.7, color="0.4", lw=0.8, label=r"full slip: $\mu_0$")
        axes["cof"].semilogx(shaken, cof, "o", color=COLOURS[1], label=f"sliding at {1e3 * v_0:g} mm/s")
        axes["cof"].set(title="... twice: near the pole, and at high frequency")
        axes["cof"].set(xlabel="frequency [Hz]", ylabel=r"coefficient of friction $\mu$")
        for ax in (axes["v_c"], axes["cof"]):
            ax.set_xlim(50, 25e3)
            ax.legend()
        plot_spring_map(shown, axes["map"])
        axes["map"].set_title("springs at 2 kHz: the edge slips first", pad=26)
    return fig


if __name__ == "__main__":
    for name, f in {"pole": f_0, "zero": f_1}.items():
        here = sweep == f
        print(f"{name} at {f:.1f} Hz: v_c = {1e3 * eq_15[here][0]:.2f} mm/s, Eq. (1) {1e3 * eq_1[here][0]:.2f} mm/s")
    print(f"COF of slow sliding: {static[0]:.4f} at 50 Hz, {static[-1]:.4f} at 20 kHz; at {1e3 * v_0:g} mm/s:")
    for f, run in zip(shaken, runs, strict=True):
        print(f"{f:8.0f} Hz: {run.cof:.4f} (error {run.cof_error:.0e})")
    print(f"at 20 kHz the shear wave is {wave_over_radius:.0f} contact radii long")
    print("figure:", save(figure(), __file__))
    print("figure:", save(plot_traces(shown), __file__, "_traces"))
