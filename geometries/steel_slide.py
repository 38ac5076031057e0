"""Steel slide: do springs have the forces that were measured on steel, vibrated along the slide at 26 kHz?

J. Luo and others (Scientific Reports 14:25847, 2024) pulled a slider of 1.1 kg, on its own weight, over a base of the
same steel, and vibrated the base along the slide by du_x = 0.35 µm. At 26 kHz the slider stands still, so the pull is
rigid. A contact that does not deflect would keep (2/pi) arcsin(v_0/(omega du_x)) of its friction: 0.06 % at 0.05 mm/s.
It kept 15 %, and 24 % at rest.

Springs keep more, as they deflect by l = mu_0 kappa d before they slide, and 0.35 µm is about that. What is unknown is
one number, l, and two choices: the shape, and the limit mu_0 F_N under vibration. The limits tried are

* constant: that at rest without vibration, 4.51 N, at all velocities;
* as slow: that without vibration at the same mean velocity.

l is fixed by one bar, at rest or at 0.05 mm/s; it is in proportion to the limit. All other bars are predicted.

The answer: with a constant limit the bar at rest and those of the slide exclude each other, whatever the shape and l:
friction of springs never falls with velocity, and here it falls from 1.07 to 0.50 N. With the limit of the same mean
velocity, and l from the bar at 0.05 mm/s, the other four of the slide are met to 0.11 N, within their error bars. The
bar at rest is then 0.3 to 0.7 N too high: at rest friction without vibration is higher than deflection explains.
"""

from pathlib import Path

import numpy as np
from scipy.optimize import brentq

import mdr

table = np.loadtxt(Path(__file__).with_name("luo_2024.csv"), delimiter=",", skiprows=5)
v_0, without, vibrated = 1e-3 * table[:, 0], table[:, 1], table[:, 2]  # m/s, N, N
du_x, omega = 0.35e-6, 2 * np.pi * 26e3  # m, rad/s
mu_0, steel = 0.4, mdr.Elastic(E=210e9, nu=0.3)  # the share that is kept knows neither, only l
shapes = {"flat punch": mdr.FlatPunch(a=1e-3), "paraboloid": mdr.Paraboloid(R=1.0), "cone": mdr.Cone(theta=1e-3)}
limits = {"constant": np.full(6, without[0]), "as slow": without}  # N
bars = {"at rest": 0, "0.05 mm/s": 1}


def kept(shape, chi, v):
    """Share of friction [-] that is left at a velocity [m/s] under vibration by chi times the deflection l."""
    depth = mdr.ConstantDepth(du_x / (chi * mu_0 * steel.mindlin_ratio))
    case = mdr.SlidingContact(shape, steel, mu_0, depth, shake=mdr.InPlaneOscillation(omega, du_x))
    return mdr.cof_curve(case, [v]).cof[0] / mu_0


def predicted(shape, limit, bar, force=None):
    """Forces [N] of all bars under these limits, and the deflection l [m] there, which the force of one bar fixes."""
    force = vibrated[bar] if force is None else force
    chi = brentq(lambda chi: limit[bar] * kept(shape, chi, v_0[bar]) - force, 0.01, 5, xtol=1e-9)
    forces = [F * kept(shape, chi * limit[bar] / F, v) for F, v in zip(limit, v_0, strict=True)]
    return np.array(forces), du_x / chi * limit / limit[bar]


found = {
    (name, limit, bar): predicted(shape, limits[limit], bars[bar])
    for name, shape in shapes.items()
    for limit in limits
    for bar in bars
}
rigid = without * 2 / np.pi * np.arcsin(v_0 / (omega * du_x))  # N


def figure():
    """Forces under vibration, measured (error 0.1 N) and by springs whose deflection the bar at 0.05 mm/s fixes."""
    import matplotlib.pyplot as plt

    from mdr.plots import COLOURS, style

    with style():
        fig, panels = plt.subplots(1, 2, sharey=True, figsize=(11, 4.4))
        x, ticks = np.arange(v_0.size), ["at rest", *(f"{1e3 * v:g}" for v in v_0[1:])]
        for ax, limit in zip(panels, ("as slow", "constant"), strict=True):
            ax.errorbar(x, vibrated, 0.1, fmt="ks", ms=5, capsize=3, label="measured")
            for name, colour in zip(shapes, COLOURS, strict=False):
                forces, _ = found[name, limit, "0.05 mm/s"]
                ax.plot(x, forces, "o-", lw=1.2, ms=4, color=colour, label=f"springs, {name}")
            ax.plot(x, rigid, ":", color="0.4", label="no deflection")
            ax.set(xticks=x, xticklabels=ticks, xlabel="velocity $v_0$ [mm/s]", ylim=(-0.05, 1.9))
            ax.set_title(
                {"as slow": "limit: of each velocity, without vibration", "constant": "limit: that at rest, for all"}[
                    limit
                ]
            )
        panels[0].set_ylabel("friction under vibration [N]")
        panels[0].legend()
    return fig


if __name__ == "__main__":
    rows = {"measured": (vibrated, np.full(6, np.nan)), "no deflection": (rigid, np.zeros(6))}
    rows |= {f"{name}, limit {limit}, by bar {bar}": one for (name, limit, bar), one in found.items()}
    print("force under vibration [N] at [mm/s]".ljust(44) + "".join(f"{1e3 * v:8.2f}" for v in v_0), "  l at 0.05 [µm]")
    for name, (forces, deflection) in rows.items():
        print(name.ljust(44) + "".join(f"{F:8.3f}" for F in forces) + f"{1e6 * deflection[1]:10.2f}")
    from mdr.plots import save

    print("figure:", save(figure(), __file__))
