"""Piezo drive: what pushes a slider harder, faster and at less cost, a sawtooth under constant load or an ellipse?

A ceramic foot on a steel guide carries a slider and is moved by piezos; all numbers are orders of magnitude of small
stages and motors. The slider is heavy and runs at a constant v_0: its pull is rigid. For the sawtooth 200 g is heavy,
and 1 g is not: such a slider follows the foot.

Sawtooth, 5 kHz: the load is constant, and the foot goes back slowly, for a share 1 - beta of the period, and forward
quickly, by the stroke S. Friction is mu_0 F_N whatever the speed, so that a foot that slips all the time pushes with
mu_0 F_N (1 - 2 beta): the shares of time spent slipping back and forward, and not the speeds, make a thrust that is not
zero at rest. A sine has none. The thrust lasts up to S f/(1 - beta), the speed of the slow stroke. A contact that
deflects by mu_0 kappa d to either side first takes 2 mu_0 kappa d from both strokes: it pushes less, and a stroke not
much shorter than that moves nothing. The quick stroke slips and is all loss, so that the efficiency stays below
(1 - 2 beta)/(2 - 2 beta): a sawtooth never gives half.

Ellipse, 40 kHz: the foot oscillates up and down too, a quarter of a period apart. Load, not time, favours the way back.
A foot that taps is loaded only while it goes back at nearly omega du_x, and need not slip much. So the answer: tapping
on an ellipse gives all of mu_0 F_N at rest and three quarters of its power, the sawtooth less than a third; an ellipse
that keeps contact gives a tenth. The normal drive of an elastic contact gets back all that it gives: the motion in the
plane pays for everything.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

import mdr
from mdr.plots import COLOURS, save, style

mu_0, pair = 0.2, mdr.ElasticPair(E_1=380e9, nu_1=0.22, E_2=210e9, nu_2=0.3)  # alumina on steel
foot, load = mdr.Paraboloid(R=3e-3), 3.0  # m, N
frequency, beta, n_harmonics = 5e3, 0.1, 24  # Hz; share of the quick stroke; harmonics that the amplifier passes
strokes = (3e-6, 1e-6)  # S [m]
ultrasonic, du_x = 2 * np.pi * 40e3, 1e-6  # rad/s, m
heights = (1.2e-6, 0.6e-6, 0.2e-6)  # du_z [m]: the foot taps, and keeps contact with the last


def sawtooth(S, beta=beta):
    """A foot that goes back by the stroke S [m] slowly and forward quickly, its corners rounded (Lanczos factors)."""
    n = np.arange(1, n_harmonics + 1)
    series = S * np.sin(np.pi * n * (1 - beta)) / (np.pi**2 * n**2 * beta * (1 - beta))
    shake = mdr.InPlaneMotion(2 * np.pi * frequency, x_sin=tuple(-series * np.sinc(n / (n_harmonics + 1))))
    return mdr.SlidingContact(foot, pair, mu_0, mdr.ConstantLoad(load), shake=shake)


def ellipse(du_z):
    """A foot that moves on an ellipse, back while it is deep, under the same mean load."""
    turn = 2 * np.pi * np.arange(1024) / 1024

    def excess(u_z0):
        return np.mean(foot.force(np.maximum(u_z0 + du_z * np.cos(turn), 0), pair.E_star)) - load

    depth = mdr.NormalOscillation(brentq(excess, -0.9 * du_z, 2e-6, xtol=1e-15), du_z, ultrasonic)
    shake = mdr.InPlaneOscillation(ultrasonic, du_x, phi_x=np.pi / 2)
    return mdr.SlidingContact(foot, pair, mu_0, depth, shake=shake)


class Characteristic(NamedTuple):
    """Thrust and efficiency of a drive over the velocity of the slider, arrays of shape (n_v,)."""

    v_0: np.ndarray  #: from the blocked slider to the one without load [m/s]
    thrust: np.ndarray  #: minus the mean F_x, over mu_0 times the mean load [-]
    efficiency: np.ndarray  #: power out over power of the drives [-]

    @property
    def no_load(self):
        """Velocity without load [m/s]."""
        return self.v_0[-1]


def characteristic(case):
    """One run for each velocity. The slider gives pull_work < 0 while it is pushed against a force."""
    v_0 = mdr.no_load_velocity(case) * np.sin(np.linspace(0, np.pi / 2, 15))  # closer at the end
    runs = [mdr.slide(case, v, accuracy=1e-4) for v in v_0]
    energies = [run.energy_balance for run in runs]
    efficiency = [-e.pull_work / (e.normal_work + e.shake_work) for e in energies]
    return Characteristic(v_0, np.array([-run.cof / mu_0 for run in runs]), np.array(efficiency))


def undeflected(case):
    """The same of a foot whose force turns with the direction of sliding at once, from the motion alone."""
    X = case.shake.along
    n, turn = np.arange(1, X.size + 1), 2 * np.pi * (np.arange(8192) + 0.5) / 8192
    x_dot = (1j * n * case.omega * X * np.exp(1j * np.outer(turn, n))).sum(axis=1).real
    v_0 = np.linspace(0, -x_dot.min(), 400, endpoint=False)
    side = np.sign(v_0[:, None] + x_dot)  # of F_x
    thrust, power = -side.mean(axis=1), (side * x_dot).mean(axis=1)
    pushes = thrust > 0
    return Characteristic(v_0[pushes], thrust[pushes], (thrust * v_0 / power)[pushes])


sawtooths = [characteristic(sawtooth(S)) for S in strokes]
ellipses = [characteristic(ellipse(du_z)) for du_z in heights]
stiff = undeflected(sawtooth(strokes[0]))
deflection = mu_0 * pair.mindlin_ratio * mdr.resolved(sawtooth(strokes[0])).working_depth  # mu_0 kappa d [m]
least_stroke = brentq(lambda S: mdr.holding_band(sawtooth(S)).high, deflection, 3 * deflection, xtol=1e-9)
even = mdr.holding_band(sawtooth(strokes[1], beta=0.5))
masses = (0.2, 0.02, 0.001)  # kg, of sliders on a soft spring with half of critical damping
pulls = [mdr.RigidPull(), *(mdr.SpringPull(k_x=1e4, m=m, c_x=np.sqrt(1e4 * m)) for m in masses)]
half_speed = sawtooths[1].no_load / 2
of_mass = [-mdr.slide(replace(sawtooth(strokes[1]), pull=pull), half_speed).cof / mu_0 for pull in pulls]


def figure():
    """Thrust of sawtooth and ellipse over the velocity, and the efficiency of both."""
    import matplotlib.pyplot as plt

    rows = (("S", strokes, sawtooths, "s--", "sawtooth"), (r"\Delta u_z", heights, ellipses, "o-", "ellipse"))
    with style():
        fig, axes = plt.subplot_mosaic([["sawtooth", "efficiency"], ["ellipse", "efficiency"]], figsize=(8.6, 5.8))
        axes = [axes[name] for name in ("sawtooth", "ellipse", "efficiency")]
        for row, ax in zip(rows, axes, strict=False):
            symbol, sizes, drives, look, name = row
            for i, (size, drive) in enumerate(zip(sizes, drives, strict=True)):
                unit = size * frequency if name == "sawtooth" else ultrasonic * du_x
                colour = COLOURS[i + (3 if name == "sawtooth" else 0)]
                label = f"${symbol} = {1e6 * size:g}$ µm"
                ax.plot(drive.v_0 / unit, drive.thrust, look, ms=4, color=colour, label=label)
                share = drive.v_0 / drive.no_load
                axes[2].plot(share, drive.efficiency, look, ms=4, color=colour, label=f"{name}, {label}")
            ax.set(ylabel=r"thrust over $\mu_0 F_N$", xlim=(0, 1.2 if name == "sawtooth" else 1), ylim=(0, 1.05))
        unit = strokes[0] * frequency
        axes[0].plot(np.r_[stiff.v_0, stiff.no_load] / unit, np.r_[stiff.thrust, 0], "k:", label="no deflection")
        axes[0].set(title="sawtooth: deflection costs thrust and speed", xlabel="velocity $v_0/(S f)$")
        axes[1].set(title="ellipse: tapping gains thrust and speed", xlabel=r"velocity $v_0/(\omega\,\Delta u_x)$")
        axes[2].plot(stiff.v_0 / stiff.no_load, stiff.efficiency, "k:", label="sawtooth, no deflection")
        axes[2].set(title="only a tapping foot gives more than half", xlabel="velocity over that without load")
        axes[2].set(ylabel="efficiency", xlim=(0, 1), ylim=(0, 1.05))
        axes[0].legend(loc="upper right")
        axes[1].legend(loc="upper right")
        axes[2].legend(loc="upper left", fontsize=9)
    return fig


if __name__ == "__main__":
    print(f"{load:g} N, mu_0 F_N = {mu_0 * load:g} N; the contact deflects by {1e6 * deflection:.2f} µm to either side")
    print("drive                     blocked force [N]   without load [mm/s]   best efficiency")
    names = [f"sawtooth, stroke {1e6 * S:g} µm" for S in strokes] + [f"ellipse, height {1e6 * h:g} µm" for h in heights]
    for name, drive in zip(names, sawtooths + ellipses, strict=True):
        force, best = mu_0 * load * drive.thrust[0], drive.efficiency.max()
        print(f"{name:25} {force:17.3f} {1e3 * drive.no_load:21.2f} {best:17.3f}")
    print(f"a sawtooth of less than {1e6 * least_stroke:.2f} µm moves nothing", end="; ")
    print(f"equal strokes hold {mu_0 * load * even.high:z.3f} N")
    print(
        f"without deflection: {mu_0 * load * stiff.thrust[0]:.3f} N, efficiency {stiff.efficiency.max():.3f};", end=" "
    )
    print(f"sharp corners {mu_0 * load * (1 - 2 * beta):.3f} N, {(1 - 2 * beta) / (2 - 2 * beta):.3f}")
    print(f"thrust of a {1e6 * strokes[1]:g} µm sawtooth at {1e3 * half_speed:.1f} mm/s: rigid pull", end=" ")
    for name, thrust in zip(["", *(f"; slider of {1e3 * m:g} g " for m in masses)], of_mass, strict=True):
        print(f"{name}{mu_0 * load * thrust:.3f} N", end="")
    print()
    print("figure:", save(figure(), __file__))
