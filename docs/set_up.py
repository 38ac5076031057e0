"""The set-up: an indenter that vibrates in a half-space, pulled rigidly, or as a body on a spring.

`python docs/set_up.py` draws docs/set_up.svg anew, on white, so that it can be read on any background.
"""

import re
from io import StringIO
from pathlib import Path

import numpy as np

from mdr.plots import COLOURS, style

R, A = 0.75, 0.42  #: radius of the tip and of the contact, inches on paper as all that follows
SURFACE, TIP, TOP = 1.12, 1.0, 2.5  #: heights of surface and body, and where the tip is
VIBRATION, PULL, SHAKE, INK = *COLOURS[:3], "0.2"


def figure():
    """Rigid pull beside a body on a spring."""
    import matplotlib.pyplot as plt

    with style({"font.size": 13.5, "axes.titlesize": 16}):
        fig, (left, right) = plt.subplots(1, 2, figsize=(7.4, 3.35))
        for ax, title, draw in ((left, "rigid pull", rigid), (right, "body on a spring", spring)):
            contact(ax)
            draw(ax)
            ax.set(xlim=(-0.02, 3.5), ylim=(0.2, 2.95), aspect="equal")
            ax.set_title(title)
            ax.axis("off")
        left.text(TIP, 2.25, "indenter", ha="center", va="center")
        right.text(TIP, 2.25, "mass $m$", ha="center", va="center")
    return fig


def contact(ax):
    """The tip, pressed into the surface by Hertz' theory, and what shakes it."""
    x = np.r_[-1:-0.7:3j, -0.6:0.6:25j, 0.7:2.5:9j]
    r = np.maximum(abs(x) / A, 1)
    sunk = np.where(abs(x) < A, A**2 - x**2 / 2, A**2 / np.pi * ((2 - r**2) * np.arcsin(1 / r) + np.sqrt(r**2 - 1))) / R
    ax.fill_between(TIP + x, SURFACE - sunk, 0.2, color="#F6E7C8", lw=0)
    ax.plot(TIP + x, SURFACE - sunk, color=INK, lw=1.4)
    ax.plot([0, 3.5], [SURFACE] * 2, color="0.5", lw=0.8, ls=":")
    depth, wide = A**2 / R, 0.8
    x = np.linspace(-wide, wide, 21)
    tip = SURFACE - depth + x**2 / (2 * R)
    ax.fill([*TIP + x, TIP + wide, TIP - wide], [*tip, TOP, TOP], color="0.88", lw=0)
    ax.plot([TIP - wide, *TIP + x, TIP + wide, TIP - wide], [TOP, *tip, TOP, TOP], color=INK, lw=1.4)
    ax.text(TIP, SURFACE - depth - 0.06, r"friction $\mu_0$", ha="center", va="top")
    ax.text(1.75, 0.28, r"half-space: $E$, $\nu$, $\tau$", ha="center", va="bottom")
    arrow(ax, (0.08, 1.65), (0.08, 2.35), VIBRATION, "<|-|>")
    ax.text(0, 2.62, r"$u_z(t) = u_{z0} + \Delta u_z \cos\omega t$", color=VIBRATION, va="bottom")
    arrow(ax, (1.95, 1.4), (2.5, 1.4), SHAKE, "<|-|>")
    ax.text(2.58, 1.4, "shake", color=SHAKE, va="center")


def rigid(ax):
    """A stiff bar."""
    ax.fill_between([TIP + 0.8, 2.7], 2.13, 2.23, color=INK, lw=0)
    end(ax)


def spring(ax):
    """A spring and a dashpot beside it."""
    begin, y = TIP + 0.8, 2.32
    bends = np.array([0, 0, *[0.09, -0.09] * 4, 0, 0])
    ax.plot(begin + 0.9 * np.r_[0, np.linspace(0.16, 0.84, bends.size - 2), 1], y + bends, color=INK, lw=1.6)
    ax.text(begin + 0.45, y + 0.1, "$k_x$", ha="center", va="bottom")
    y = 2.04
    ax.plot([begin, begin + 0.45], [y, y], [begin + 0.45] * 2, [y - 0.07, y + 0.07], color=INK, lw=1.6)
    cup = np.array([0.28, 0.6, 0.6, 0.28]), np.array([-0.1, -0.1, 0.1, 0.1])
    ax.plot(begin + cup[0], y + cup[1], color=INK, lw=1.6)
    ax.plot([begin + 0.6, begin + 0.9], [y, y], color=INK, lw=1.6)
    ax.text(begin + 0.45, y - 0.14, "$c_x$", ha="center", va="top")
    end(ax)


def end(ax):
    """What is pulled."""
    ax.plot([2.7, 2.7], [1.93, 2.43], color=INK, lw=3)
    arrow(ax, (2.72, 2.18), (3.3, 2.18), PULL, "-|>")
    ax.text(3.05, 2.25, "$v_0$", color=PULL, ha="center", va="bottom")


def arrow(ax, begin, end, colour, kind):
    """An arrow from one place to another."""
    look = {"arrowstyle": kind, "color": colour, "lw": 2, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 14}
    ax.annotate("", end, begin, arrowprops=look)


def written():
    """The drawing as SVG, its places to a tenth of a point."""
    drawn = StringIO()
    figure().savefig(drawn, format="svg", metadata={"Date": None})
    short = re.sub(r' d="[^"]*"', lambda d: re.sub(r"\d+\.\d+", lambda n: f"{float(n[0]):.1f}", d[0]), drawn.getvalue())
    return re.sub(r"\s*\n\s*", "\n", short)


if __name__ == "__main__":
    Path(__file__).with_suffix(".svg").write_text(written(), encoding="utf-8")
