"""Depths: for which shapes does the critical velocity depend on the depth, and how good is Eq. (15) for it?

All shapes of the gallery, equal in stiffness when they are 40 µm deep, are pulled by the same mass and spring and
vibrated by 4 µm. Eq. (15) knows shape and depth by the stiffness 2E*a(u_z0) alone. So v_c over Eq. (1), of the rigid
pull, says how each contact grows; it is one number in the row of 40 µm but for the error of Eq. (15), the change of
stiffness within a period, which the harmonics of the full-slip force hold. A hollow punch has no full contact 10 µm
deep.
"""

from dataclasses import replace

import numpy as np
from gallery import body, contact, eq_1, omega, shapes
from gallery import d as reference
from gallery import du_z as of_gallery

import mdr
from mdr.plots import save, style

depths, du_z = np.array([10e-6, 20e-6, reference, 50e-6]), 4e-6
rigid = eq_1 * du_z / of_gallery  # Eq. (1) [m/s], in proportion to the amplitude


def pressed(shape, u_z0):
    """A shape at another depth."""
    return replace(contact(shape, body), oscillation=mdr.NormalOscillation(u_z0, du_z, omega))


def velocities(shape):
    """Eq. (15) and the full-slip v_c at each depth, nan where the shape does not touch fully."""
    touching = depths - du_z >= shape.least_depth
    cases = [pressed(shape, u_z0) for u_z0 in depths[touching]]
    table = np.full((2, depths.size), np.nan)
    table[:, touching] = [[v(case) for case in cases] for v in (mdr.critical_velocity, mdr.full_slip_critical_velocity)]
    return table


found = {name: velocities(shape) for name, shape in shapes.items()}
span = {name: float(np.nanmax(v[1]) / np.nanmin(v[1])) for name, v in found.items()}  # how much v_c changes
ordered = sorted(shapes, key=lambda name: span[name])
eq_15, full = np.array([found[name] for name in ordered]).transpose(1, 0, 2)


def figure():
    """Two tables in colour: v_c over Eq. (1), and the error of Eq. (15)."""
    import matplotlib.pyplot as plt

    with style():
        fig, axes = plt.subplots(1, 2, sharey=True, figsize=(10, 7))
        off = 100 * (full / eq_15 - 1)
        reach = np.nanmax(np.abs(off))
        tables = (
            (axes[0], full / rigid, "{:.3f}", "$v_c$ over Eq. (1): by shape and depth", ("viridis", 0, 1)),
            (axes[1], off, "{:+.2f}", "$v_c$ off Eq. (15) at that depth [%]", ("RdBu_r", -2 * reach, 2 * reach)),
        )
        for ax, values, form, title, (colours, low, high) in tables:
            image = ax.imshow(values, cmap=colours, vmin=low, vmax=high, aspect="auto")
            for (i, j), value in np.ndenumerate(values):
                dark = sum(image.cmap(image.norm(value))[:3]) < 1.3 and np.isfinite(value)
                text = form.format(value + 0) if np.isfinite(value) else "ring"
                ax.text(j, i, text, ha="center", va="center", fontsize=9, color="white" if dark else "black")
            ax.set_xticks(range(depths.size), [f"{1e6 * u_z0:g}" for u_z0 in depths])
            ax.set(title=title, xlabel="depth $u_{z0}$ [µm]")
        axes[0].set_yticks(range(len(ordered)), ordered)
    return fig


if __name__ == "__main__":
    print(f"Eq. (1): {1e3 * rigid:.3f} mm/s; Eq. (15) of every shape {1e6 * reference:g} µm deep:", end=" ")
    print(f"{1e3 * eq_15[0, depths.tolist().index(reference)]:.3f} mm/s")
    at = "".join(f"{1e6 * u_z0:8g} µm" for u_z0 in depths)
    print(f"v_c over Eq. (1), and off Eq. (15) [%] {at}")
    for name, one, other in zip(ordered, full / rigid, 100 * (full / eq_15 - 1), strict=True):
        print(f"{name:38s} " + "".join(f"{value:11.4f}" for value in one))
        print(39 * " " + "".join(f"{value + 0:+11.3f}" for value in other))
    print("figure:", save(figure(), __file__))
