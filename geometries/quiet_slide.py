"""Quiet slide: which vibration halves the friction of a pad up to 5 mm/s, what does it cost, and how sure is that?

A pad of PEEK with a round face bears 10 N on steel; a spindle moves the stage. Piezos can vibrate the pad up and down
by at most 2 µm, at most at 20 kHz, with 3 W. Friction is to be at most half of mu_0 at all speeds up to 5 mm/s.

The answer: yes. The vibration with the most room takes all that the piezos can do. The one that spares power needs the
whole amplitude too, but less than half of the frequency, and a fifth of the power: power goes with the square of the
frequency, and v_c with the first power. But then friction is at its limit, and numbers are known to some per cent. Half
of all pads made like this would miss the target. For nearly all of them to meet it, design for less friction: the last
columns say what that costs.
"""

from dataclasses import replace

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
