"""Elasticities: by how many per cent does friction change for one per cent of amplitude, or of velocity?

The elasticity of the COF in the amplitude is d ln COF/d ln du_z at a given velocity. A study has the derivatives as
quantities, "d cof/d oscillation.du_z" and "d cof/d v_0", here of a ball on rubber under a rigid pull.

The answer: the amplitude matters most where contact is just kept and the pull is slow: one per cent more takes off more
than two of friction. Once the ball is lifted off in each period it takes off one at most, as the mean load grows with
the amplitude. Velocity then matters instead, and adds one: friction has become a damper. Near v_c neither matters.
"""

import numpy as np

import mdr
from mdr.plots import save, style

vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=4e-6, omega=2 * np.pi * 100)
case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, vibration)
alpha = np.array([0.1, 0.25, 0.4, 0.55, 0.7, 0.8, 0.9, 0.97, 1.05, 1.15, 1.3, 1.5, 1.7])
speed = np.array([0.05, 0.1, 0.17, 0.26, 0.36, 0.48, 0.6, 0.72, 0.84, 0.95, 1.05])
inputs = {"amplitude": "d cof/d oscillation.du_z", "velocity": "d cof/d v_0"}
study = mdr.sweep(case, {"alpha": alpha, "v_0/v_c": speed}, quantities=("cof", "v_c", *inputs.values()))
values = {"amplitude": alpha[:, None] * vibration.u_z0, "velocity": study["v_c"] * speed}
elasticity = {name: study[path] * values[name] / study["cof"] for name, path in inputs.items()}


def figure():
    """Per cent of friction for each per cent of amplitude, and of velocity; contact is lost above the dashed line."""
    import matplotlib.pyplot as plt

    with style():
        fig, axes = plt.subplots(1, 2, figsize=(9.2, 3.8), sharey=True)
        bounds = {"amplitude": [-4, -2, -1.5, -1, -0.7, -0.5, -0.3, -0.2, -0.1, 0], "velocity": np.arange(0, 1.01, 0.1)}
        colours = {"amplitude": ("Blues_r", -3.5, 0), "velocity": ("Oranges", 0, 1.6)}
        for ax, (name, found) in zip(axes, elasticity.items(), strict=True):
            cmap, low, high = colours[name]
            ax.contourf(speed, alpha, found, bounds[name], cmap=cmap, vmin=low, vmax=high)
            lines = ax.contour(speed, alpha, found, bounds[name][1:-1], colors="black", linewidths=0.8)
            lines.set_linestyle("-")
            ax.clabel(lines, fmt="%g", fontsize=9)
            ax.axhline(1, color="black", ls="--", lw=1.2)
            ax.set(title=f"for one per cent of {name}", xlabel="velocity $v_0/v_c$")
        axes[0].set_ylabel(r"amplitude $\Delta u_z/u_{z0}$")
    return fig


if __name__ == "__main__":
    slow, deep = elasticity["amplitude"][:, 0], int(np.argmin(elasticity["amplitude"][:, 0]))
    print(f"at {speed[0]:g} v_c one per cent of amplitude is worth most at du_z/u_z0 = {alpha[deep]:.2f}:", end=" ")
    print(f"{slow[deep]:+.2f} % of friction, and {elasticity['velocity'][deep, 0]:+.2f} % for one of velocity")
    print(f"at {alpha[-1]:g}: {slow[-1]:+.2f} and {elasticity['velocity'][-1, 0]:+.2f} %")
    print("figure:", save(figure(), __file__))
