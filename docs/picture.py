"""The pictures of the first page: friction of a shaken contact, and what its springs do meanwhile, at rest and moving.

`python docs/picture.py` draws docs/picture.png and docs/animation.gif anew.
"""

from pathlib import Path

import numpy as np

import mdr
from mdr.plots import COLOURS, plot_spring_map, style

CASE = mdr.SlidingContact(
    indenter=mdr.Paraboloid(R=5e-3),
    material=mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3),
    mu_0=0.5,
    oscillation=mdr.NormalOscillation(u_z0=20e-6, du_z=14e-6, omega=2 * np.pi * 50),
)
SHARE = 0.4  #: of the critical velocity: where the springs are shown
BLUE, RED, INK = COLOURS[0], COLOURS[1], "0.25"


V_C = mdr.critical_velocity(CASE)


def shown():
    """The run that both show."""
    return mdr.slide(CASE, SHARE * V_C, n_springs=256, steps_per_period=960, record=1)


def animate(path, run):
    """Let the springs move."""
    lost = f"{100 * (1 - run.cof / CASE.mu_0):.0f} % less friction"
    return run.animate(path, title=f"pulled at {SHARE:g} of the critical velocity: {lost}")


def figure(run):
    """Friction over pulling velocity, beside a map of the springs over one period."""
    import matplotlib.pyplot as plt

    with style():
        drawn, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.9))
        draw_curve(left, run.cof / CASE.mu_0)
        draw_springs(right, run)
    return drawn


def draw_curve(ax, shown):
    """Draw friction over velocity, and the point of the run that is shown beside it."""
    share = 1.4 * np.linspace(0, 1, 80) ** 2  # dense at rest, where the curve is steep
    friction = mdr.cof_curve(CASE, v_0=share * V_C).cof / CASE.mu_0
    ax.fill_between(share, friction, 1, color=BLUE, alpha=0.12, lw=0)
    ax.plot(share, friction, color=BLUE, lw=2.2)
    ax.plot([1, 1], [0, 1], color=INK, lw=1, ls=":")
    ax.plot(SHARE, shown, "o", color=RED, ms=9)
    ax.text(SHARE + 0.05, shown - 0.03, "shown at right", color=RED, va="top")
    ax.text(0.03, 0.97, "taken away\nby vibration", color=BLUE, va="top")
    ax.text(0.97, 0.22, "critical velocity:\nfull friction\nfrom here on", color=INK, ha="right")
    ax.set(xlim=(0, 1.4), ylim=(0, 1.06), title="How much friction is left")
    ax.set(xlabel="pulling velocity / critical velocity", ylabel="friction / friction without vibration")


def draw_springs(ax, run):
    """Draw what each spring does over one period, and say it in words on the colours."""
    plot_spring_map(run, ax).get_legend().remove()
    ax.text(0.46, 320, "not in contact", color=INK, ha="center")
    ax.text(0.34, 90, "slips", color=INK, ha="center")
    ax.text(0.78, 90, "sticks", color="white", ha="center")
    ax.set(title="What each spring of the contact does")
    ax.set(xlabel="time / period of the vibration", ylabel="distance from the centre [µm]")


if __name__ == "__main__":
    run = shown()
    figure(run).savefig(Path(__file__).with_name("picture.png"), dpi=150)
    animate(Path(__file__).with_name("animation.gif"), run)
