"""Steel slide: do springs have the forces that were measured on steel, vibrated along the slide at 26 kHz?

J. Luo and others (Scientific Reports 14:25847, 2024) pulled a slider of 1.1 kg, on its own weight, over a base of the
same steel, and vibrated the base along the slide by du_x = 0.35 µm. By its mass alone the slider moves by less than a
nanometre at 26 kHz, so the pull is rigid. A contact that does not deflect would keep (2/pi) arcsin(v_0/(omega du_x)) of
its friction: 0.06 % at 0.05 mm/s. It kept 15 %, and 24 % at rest.

Springs keep more, as they deflect by l = mu_0 kappa d before they slide, about as far as the base moves. One number is
not known, l; it goes with the limit mu_0 F_N. One bar fixes it, and all others are predicted. Two choices are left:

* the face: a flat punch, a paraboloid, or a rough face, whose load grows exponentially with depth (Greenwood and
  Williamson 1966), e-fold over l/(mu_0 kappa);
* the limit under vibration: *constant*, that at rest without vibration, or *as slow*, that without vibration at the
  same mean velocity. Or both: *falling*, springs at rest stick up to the first, and slip at the second.

The answer: a constant limit cannot be. Friction of springs never falls with velocity, and here it falls from 1.07 N at
rest to 0.50 N. With the limit of the same velocity, and l from the bar at rest, a rough face has the five bars of the
slide to 0.06 N; a paraboloid is up to 0.3 N too low, a punch 0.5 N. Where friction falls it is the punch that has them,
to 0.06 N, and the rough face is up to 0.4 N too high: the table alone does not tell face and law apart.
"""

from pathlib import Path

import numpy as np
from scipy.optimize import brentq

import mdr
from mdr.plots import COLOURS, save, style

table = np.loadtxt(Path(__file__).with_name("luo_2024.csv"), delimiter=",", skiprows=5)
v_0, without, vibrated = 1e-3 * table[:, 0], table[:, 1], table[:, 2]  # m/s, N, N
du_x, omega = 0.35e-6, 2 * np.pi * 26e3  # m, rad/s
mu_0, steel = 0.4, mdr.Elastic(E=210e9, nu=0.3)  # the share that is kept knows neither, only l
FOLDS = 7  # e-folds of the load from the first touch on: what it was before, a thousandth, does not matter
faces = {  # of a radius below a mm at the depth d
    "flat punch": lambda d: mdr.FlatPunch(a=1e-3),
    "paraboloid": lambda d: mdr.Paraboloid(R=1e-7 / d),
    "rough face": lambda d: mdr.RoughFace(l_e=d / FOLDS, a_0=1e-3 * np.exp(-FOLDS)),
}
limits = {"as slow": without, "constant": np.full(6, without[0])}  # N
bars = {"at rest": 0, "0.05 mm/s": 1}


def kept(face, chi, v, stick=1.0):
    """Share of friction [-] that is left at a velocity [m/s] under vibration by chi times l; stick: mu_s/mu_k."""
    d = du_x / (chi * mu_0 * steel.mindlin_ratio)
    shake = mdr.InPlaneOscillation(omega, du_x)
    case = mdr.SlidingContact(faces[face](d), steel, mu_0, mdr.ConstantDepth(d), shake=shake, mu_s=stick * mu_0)
    if stick > 1:  # springs are let go once in so many periods that only a mean repeats: to 0.005 N over these
        return mdr.slide(case, v, n_springs=48, steps_per_period=32, n_periods=3000).cof / mu_0
    return mdr.cof_curve(case, [v]).cof[0] / mu_0


def predicted(face, limit, bar, force):
    """Forces [N] of all bars under these limits, and their deflections l [m], which the force of one bar fixes."""
    chi = brentq(lambda chi: limit[bar] * kept(face, chi, v_0[bar]) - force, 0.01, 5, xtol=1e-9)
    forces = [F * kept(face, chi * limit[bar] / F, v) for F, v in zip(limit, v_0, strict=True)]
    return np.array(forces), du_x / chi * limit / limit[bar]


found = {
    (face, limit, bar): predicted(face, limits[limit], bars[bar], vibrated[bars[bar]])
    for face in faces
    for limit in limits
    for bar in bars
}
for face in faces:  # what is held at rest, and with it l, is that of the limit there alone
    _, deflections = found[face, "as slow", "at rest"]
    bar_by_bar = zip(without, du_x / deflections, v_0, strict=True)
    forces = np.array([F * kept(face, chi, v, without[0] / F) for F, chi, v in bar_by_bar])
    found[face, "falling", "at rest"] = forces, deflections
rigid = without * 2 / np.pi * np.arcsin(v_0 / (omega * du_x))  # N


def figure():
    """Forces under vibration, measured and by springs, fixed by the bar at rest (lines) or at 0.05 mm/s (dotted)."""
    import matplotlib.pyplot as plt

    with style():
        fig, panels = plt.subplots(1, 3, sharey=True, figsize=(13, 4.4))
        x, ticks = np.arange(v_0.size), ["at rest", *(f"{1e3 * v:g}" for v in v_0[1:])]
        titles = {
            "as slow": "limit: of each velocity, without vibration",
            "falling": "limit: falls from that at rest to that of slip",
            "constant": "limit: that at rest, for all",
        }
        for ax, (limit, title) in zip(panels, titles.items(), strict=True):
            ax.plot(x, vibrated, "ks", ms=7, label="measured")
            for face, colour in zip(faces, COLOURS, strict=False):
                for bar, line in (("0.05 mm/s", "o:"), ("at rest", "o-")):
                    if (face, limit, bar) in found:
                        label = f"springs, {face}" if bar == "at rest" else None
                        ax.plot(x, found[face, limit, bar][0], line, lw=1.2, ms=4, color=colour, label=label)
            ax.plot(x, rigid, "--", color="0.5", label="no deflection")
            ax.set(xticks=x, xticklabels=ticks, xlabel="velocity $v_0$ [mm/s]", ylim=(-0.05, 1.9), title=title)
        panels[0].set_ylabel("friction under vibration [N]")
        panels[0].legend()
    return fig


if __name__ == "__main__":
    rows = {"measured": (vibrated, np.full(6, np.nan)), "no deflection": (rigid, np.zeros(6))}
    rows |= {f"{face}, limit {limit}, by bar {bar}": one for (face, limit, bar), one in found.items()}
    print("force under vibration [N] at [mm/s]".ljust(44) + "".join(f"{1e3 * v:8.2f}" for v in v_0), "  l at 0.05 [µm]")
    for name, (forces, deflection) in rows.items():
        print(name.ljust(44) + "".join(f"{F:8.3f}" for F in forces) + f"{1e6 * deflection[1]:10.2f}")
    print("figure:", save(figure(), __file__))
