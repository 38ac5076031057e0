"""Quiet slide: which vibration halves the friction of a pad up to 5 mm/s, what does it cost, and how sure is that?

A pad of PEEK with a round face bears 10 N on steel; a spindle moves the stage. Piezos can vibrate the pad up and down
by at most 2 µm, at most at 20 kHz, with 3 W. Friction is to be at most half of mu_0 at all speeds up to 5 mm/s.

The answer: yes. The vibration with the most room takes all that the piezos can do, and 28 mW. The one that spares power
takes the whole amplitude too, at less than half of the frequency, and a fifth of the power, which goes with its square.
But then friction is at its limit, and of pads whose numbers scatter by some per cent half miss the target: to spare
power, ask for less friction than is needed, as much as the scatter says.
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

load, up_to, mu_0 = 10.0, 5e-3, 0.3  # N, m/s
face = mdr.Paraboloid(R=50e-3)
peek = mdr.KelvinVoigt(E=3.6e9, nu=0.4, tau=0.03 / (2 * np.pi * 20e3))  # a loss tangent of 3 % at 20 kHz
depth = mdr.static_depth(face, peek, load)
vibration = mdr.NormalOscillation(u_z0=depth, du_z=1e-6, omega=2 * np.pi * 10e3)
case = mdr.SlidingContact(face, peek, mu_0, vibration)
free = {"du_z": ("0.1um", "2um"), "frequency": ("100Hz", "20kHz")}
target = mdr.Target(cof_at_most=mu_0 / 2, up_to=up_to, power_at_most=3.0)
roomy = mdr.design(case, target, free, held={"load": load})
sparing = mdr.design(case, target, free, least="power", held={"load": load})
front = mdr.front(case, up_to, free, n=6, held={"load": load})

#: standard deviations: friction and modulus from a data sheet, load and amplitude as they are set
spread = {"mu_0": "5%", "E": "10%", "load": "5%", "du_z": "5%"}


def sure(found):
    """What becomes of a design among pads that differ."""
    return mdr.propagate(found.case, spread, up_to, held={"load": load}, samples=400)


known = {"most room": sure(roomy), "least power": sure(sparing)}


def met(found):
    """Share of the pads that meet the target."""
    return np.mean(found.samples["cof"].values <= target.cof_at_most)


def figure():
    """The least power over friction, and friction of 400 pads of two designs; dashed is the target."""
    import matplotlib.pyplot as plt

    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.8))
        left.plot(front.cof / mu_0, 1e3 * front.power, "o-", color="0.4", label="least power")
        for (name, found), design, colour in zip(known.items(), (roomy, sparing), COLOURS, strict=False):
            cof = design.reached["cof_at_most"]
            left.plot(cof / mu_0, 1e3 * design.power, "D", ms=8, color=colour, label=f"design, {name}")
            values = found.samples["cof"].values / mu_0
            label = f"{name}: {met(found):.0%} meet the target"
            right.hist(values, np.linspace(0.25, 0.7, 28), color=colour, alpha=0.6, label=label)
        for ax, top in ((left, 1.0), (right, 0.8)):
            ax.axvline(target.cof_at_most / mu_0, ymax=top, color="black", ls="--", lw=1.2)
            ax.set_xlabel(r"friction up to 5 mm/s, over $\mu_0$")
        left.set(title="half the friction takes 6 mW", ylabel="power of the drive [mW]", yscale="log")
        left.legend(loc="upper right")
        right.set(title="pads whose numbers scatter", ylabel="pads of 400", ylim=(0, 85))
        right.legend(loc="upper left", fontsize=9)
    return fig


if __name__ == "__main__":
    print(f"wanted: friction of at most {target.cof_at_most:g} up to {1e3 * up_to:g} mm/s, at most 3 W")
    for (name, found), design in zip(known.items(), (roomy, sparing), strict=True):
        du_z, frequency = design.values["oscillation.du_z"], design.values["frequency"]
        print(f"{name:12} {1e6 * du_z:.3g} µm at {1e-3 * frequency:.3g} kHz, {1e3 * design.power:.3g} mW:", end=" ")
        print(f"friction {design.reached['cof_at_most']:.3f} +- {found.cof_sd:.3f}", end=", ")
        print(f"of which most is that of {max(found.cof_share, key=found.cof_share.get)};", end=" ")
        print(f"{met(found):.0%} of the pads meet the target")
    print("figure:", save(figure(), __file__))
