"""All shapes: at equal stiffness, what does the shape change in the friction under oscillation?

All shapes are scaled to touch over the radius a = 1 mm when they are 40 µm deep, so that they are equally stiff there,
and oscillate by 10 µm at 100 Hz on an elastic rubber. What is left of the shape is the force it carries, from half of
k_zc u_z0 (cone) to all of it (flat punch) and more (hollow punch), and how the stiffness changes around that depth. The
COF curves under a rigid pull differ by that; they all end at one v_c, Eq. (1). A spring and a mass move this end, and
the more so the steeper the stiffness changes. `shapes` is of use wherever all of them are compared: `depths.py`.
"""

from functools import cache

import numpy as np
from scipy.optimize import brentq

import mdr
from mdr.plots import COLOURS, save, style

a, d = 1e-3, 40e-6  # all touch over this radius at this depth
omega, mu_0, du_z = 2 * np.pi * 100, 0.5, 10e-6
rubber, body = mdr.Elastic(E=3e6, nu=0.5), mdr.SpringPull(k_x=5e3, m=0.04, c_x=4.0)


def scaled(make, low, high):
    """The shape make(size), its size between low and high such that it touches over a at the depth d."""
    return make(brentq(lambda size: float(make(size).profile_1d(a)) / d - 1, low, high, rtol=1e-12))


def own(h):
    """A paraboloid whose flanks rise like r⁶, as no shape with a name does."""
    return mdr.Profile(lambda r: h * ((r / a) ** 2 + (r / a) ** 6))


def sampled(h, n=20):
    """A dome known at points."""
    r = np.linspace(0, 1.4 * a, n)
    return mdr.SampledProfile(r, h * (r / a) ** 2 / (1 + 0.3 * (r / a) ** 2))


def from_force(n=17):
    """The shape behind F ~ d^1.7, between paraboloid and cone."""
    depth = np.linspace(0, 1.6 * d, n)
    return mdr.FromForce(depth, 2 * rubber.E_star * a * d / 1.7 * (depth / d) ** 1.7, rubber.E_star)


b, theta = 0.6 * a, np.arctan(2 * d / (np.pi * a))
shapes = {
    "flat punch": mdr.FlatPunch(a),
    "cone": mdr.Cone(theta),
    "paraboloid": mdr.Paraboloid(a**2 / d),
    "power law $r^4$": scaled(lambda c: mdr.PowerLaw(4, c), 1e6, 1e10),
    "sphere": scaled(mdr.Sphere, 1.001 * a, 1e3 * a),
    "ellipsoid": scaled(lambda R: mdr.Ellipsoid(R, 0.85 / a), 1e-9, 1e-2),
    "hyperboloid": scaled(lambda h: mdr.Hyperboloid(h, 0.3 * a), 1e-9, 1e-2),
    "truncated cone": scaled(lambda t: mdr.TruncatedCone(b, t), 1e-4, 1.0),
    "truncated paraboloid": scaled(lambda R: mdr.TruncatedParaboloid(b, R), 1e-4, 1e2),
    "rounded punch": scaled(lambda R: mdr.RoundedPunch(b, R), 1e-5, 1e2),
    "capped cone": scaled(lambda t: mdr.CappedCone(b, t), 1e-4, 1.0),
    "capped paraboloid": scaled(lambda R: mdr.CappedParaboloid(6 * R, R, b), 1e-4, 1e2),
    "constant pressure": scaled(lambda d_0: mdr.ConstantPressure(1.05 * a, d_0), 1e-7, 1e-2),
    "concave punch": mdr.ConcavePunch(a, a**2 / (0.4 * d)),
    "profile (own)": scaled(own, 1e-6, 1e-3),
    "sampled profile": scaled(sampled, 1e-6, 1e-3),
    "from force": from_force(),
}


def contact(shape, pull):
    """A shape at the depth d on the rubber."""
    return mdr.SlidingContact(shape, rubber, mu_0, mdr.NormalOscillation(d, du_z, omega), pull)


v_hat = np.linspace(0, 1.15, 24)  # over Eq. (1)
eq_1 = mdr.critical_velocity(contact(shapes["cone"], mdr.RigidPull()))
eq_15 = mdr.critical_velocity(contact(shapes["cone"], body))  # of all
share = {name: float(s.force(d, 1.0) / s.stiffness(d, 1.0)) / d for name, s in shapes.items()}


@cache
def curves():
    """mu/mu_0 of each shape under a rigid pull, over v_hat."""
    v_0 = v_hat * eq_1
    return {name: mdr.cof_curve(contact(s, mdr.RigidPull()), v_0).cof / mu_0 for name, s in shapes.items()}


@cache
def full():
    """v_c [m/s] of each shape under mass and spring, with all harmonics of F_N."""
    return {name: mdr.full_slip_critical_velocity(contact(s, body)) for name, s in shapes.items()}


def figure():
    """Each shape f(r) and its image g(x), pressed to the depth d; the COF curves of all, and how far v_c is off."""
    import matplotlib as mpl
    import matplotlib.pyplot as plt

    columns = 6
    with style():
        fig = plt.figure(figsize=(8.6, 8.6))
        above, below = fig.subfigures(2, 1, height_ratios=(5, 4))
        forms = above.subplots(-(-(len(shapes) + 1) // columns), columns).flat
        for ax, (name, shape) in zip(forms, shapes.items(), strict=False):
            _form(ax, shape)
            ax.set_title(name.replace(" ", "\n", 1), fontsize=10)
        for name, colour in (("shape $f(r)$", COLOURS[0]), ("image $g(x)$", COLOURS[1]), ("surface", "0.4")):
            forms[-1].plot([], color=colour, label=name)
        forms[-1].set_title("all 40 µm deep", fontsize=10)
        forms[-1].axis("off")
        forms[-1].legend(loc="center", handlelength=1.0)
        curve_of_all, bars = below.subplots(1, 2)
        shade = mpl.colormaps["viridis_r"](mpl.colors.Normalize(0.45, 1.2)(list(share.values())))
        for curve, colour in zip(curves().values(), shade, strict=True):
            curve_of_all.plot(v_hat, curve, color=colour, lw=1.2)
        for name, x, y in (("cone", 0.18, 0.62), ("concave punch", -0.03, 0.965)):
            curve_of_all.text(x, y, name, color=shade[list(shapes).index(name)])
        curve_of_all.set(title="rigid pull (dark: carries more)", xlabel="$v_0$ over Eq. (1)", ylabel=r"$\mu/\mu_0$")
        order = sorted(shapes, key=share.get)
        off = [100 * (full()[name] / eq_15 - 1) for name in order]
        bars.barh(order, off, color=shade[[list(shapes).index(name) for name in order]])
        bars.axvline(0, color="0.4", lw=0.8)
        bars.set(title="mass and spring", xlabel="$v_c$ off Eq. (15) [%]")
        bars.tick_params(axis="y", labelsize=9.5, length=0)
    return fig


def _form(ax, shape):
    """Shape and image at the depth d, without axes."""
    x = np.linspace(0, min(1.35 * a, shape.max_radius), 300)
    ends = x[-1] < 1.35 * a
    r = np.r_[x, x[-1]] if ends else x
    for heights, colour in ((shape.profile_3d(x), COLOURS[0]), (shape.profile_1d(x), COLOURS[1])):
        z = 1e6 * (np.r_[heights, 3 * d] if ends else heights) - 1e6 * d
        ax.plot(1e3 * np.r_[-r[::-1], r], np.r_[z[::-1], z], color=colour)
        if colour == COLOURS[0]:
            ax.fill_between(1e3 * np.r_[-r[::-1], r], np.r_[z[::-1], z], 60, color="0.92", lw=0)
    ax.axhline(0, color="0.4", lw=0.8)
    ax.set(xlim=(-1.35, 1.35), ylim=(-62, 45))
    ax.axis("off")


if __name__ == "__main__":
    print(f"Eq. (1) {1e3 * eq_1:.3f} mm/s; mass and spring, Eq. (15), {1e3 * eq_15:.3f} mm/s for every shape")
    print("shape                  F_N/(k_zc u_z0)    static mu/mu_0, at half of Eq. (1)   v_c off Eq. (15) [%]")
    for name, curve in curves().items():
        half = np.interp(0.5, v_hat, curve)
        row = share[name], curve[0], half, 100 * (full()[name] / eq_15 - 1)
        print(f"{name:22s} {row[0]:15.4f} {row[1]:17.4f} {row[2]:19.4f} {row[3]:+22.3f}")
    print("figure:", save(figure(), __file__))
