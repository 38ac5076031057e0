"""From a force curve: is an indentation test enough to predict the friction of a tip that nobody has seen?

A worn stylus was pressed 60 µm into a gel of known modulus; depth and force, with noise of 0.1 % of the greatest, are
all there is. Since dF_N/dd = 2E*a for any shape, the curve holds the image g(x), and with it the springs on any other
body: here a lossy rubber a hundred times as stiff, on which the stylus slides at 120 Hz. The usual way would be to fit
a ball to the curve. Both are set beside the tip itself, a hyperboloid, which this script knows and the methods do not.
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

gel, stylus = mdr.Elastic(E=30e3, nu=0.5), mdr.Hyperboloid(h=40e-6, c=150e-6)
omega, mu_0 = 2 * np.pi * 120, 0.8
rubber = mdr.KelvinVoigt.from_loss_tangent(E=3e6, nu=0.5, tan_delta=0.2, omega=omega)
arm = mdr.SpringPull(k_x=500, m=6e-3, c_x=1.0)
rng = np.random.default_rng(seed=5)
depths = np.r_[0, np.linspace(4e-6, 60e-6, 57)]  # shallower ones drown in the noise


def indented(relative):
    """A noisy force curve on the gel [N]."""
    force = stylus.force(depths, gel.E_star)
    return np.where(depths > 0, force + relative * force[-1] * rng.standard_normal(depths.size), 0)


def from_curve(force, relative):
    """The shape behind a force curve, whose noise is known."""
    return mdr.FromForce(depths, force, gel.E_star, tip="round", smoothing=relative * force[-1])


def fitted_ball(force):
    """The ball whose F = (4/3) E* sqrt(R) d^1.5 comes closest to a force curve."""
    root = np.sum(force * depths**1.5) / np.sum(depths**3) / (4 / 3 * gel.E_star)
    return mdr.Paraboloid(float(root**2))


def predictions(indenter, u_z0=40e-6, du_z=10e-6):
    """Force [N], v_c [m/s] with all harmonics, and static COF, on the rubber."""
    case = mdr.SlidingContact(indenter, rubber, mu_0, mdr.NormalOscillation(u_z0, du_z, omega), arm)
    force = float(indenter.force(u_z0, rubber.E_star))
    return force, mdr.full_slip_critical_velocity(case), mdr.static_cof(case)


noise = 1e-3
curve = indented(noise)
shapes = {"the tip": stylus, "from the curve": from_curve(curve, noise), "fitted ball": fitted_ball(curve)}
predicted = {name: np.array(predictions(shape)) for name, shape in shapes.items()}
repeated = np.array([predictions(from_curve(indented(noise), noise)) for _ in range(4)])
scatter = np.sqrt(np.mean((repeated / predicted["the tip"] - 1) ** 2, axis=0))


def figure():
    """The force curve, and the images g(x) that each method reads from it."""
    import matplotlib.pyplot as plt

    looks = (("0.2", "-", 4.5), (COLOURS[1], "-", 1.8), (COLOURS[0], "--", 1.8))
    fine = np.linspace(0, 56e-6, 300)
    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2))
        left.plot(1e6 * depths, 1e3 * curve, ".", color="0.5", label="measured on the gel")
        for (name, shape), (colour, ls, lw) in zip(shapes.items(), looks, strict=True):
            left.plot(1e6 * fine, 1e3 * shape.force(fine, gel.E_star), color=colour, ls=ls, lw=lw * 0.7, label=name)
            a = shape.contact_radius(fine)
            alpha = 0.35 if name == "the tip" else 1
            right.plot(1e6 * a, 1e6 * fine, color=colour, ls=ls, lw=lw, alpha=alpha, label=name)
        left.set(title="all that is known: force over depth", xlabel="depth [µm]", ylabel="$F_N$ [mN]")
        right.set(title="what follows: the image $g(x)$", xlabel="$x$ [µm]", ylabel="$g$ [µm]")
        for ax in (left, right):
            ax.set(xlim=(0, None), ylim=(0, None))
            ax.legend()
    return fig


if __name__ == "__main__":
    print("on the rubber    force [N]   v_c [mm/s]    static COF")
    for name, (force, v_c, rest) in predicted.items():
        print(f"{name:15s} {force:10.5f} {1e3 * v_c:12.4f} {rest:13.4f}")
    off = ", ".join(f"{100 * value:.2f} %" for value in scatter)
    print(f"r.m.s. error of four other measurements in force, v_c, COF: {off}")
    print("figure:", save(figure(), __file__))
