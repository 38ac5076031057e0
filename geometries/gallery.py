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
    """Two small pictures a shape: f(r) and g(x) pressed to the depth d; its COF curve among all."""
    import matplotlib.pyplot as plt

    from mdr.plots import COLOURS, style

    columns, all_curves = 6, np.array(list(curves().values()))
    within = all_curves.min(axis=0), all_curves.max(axis=0)
    with style():
        fig, axes = plt.subplots(6, columns, figsize=(15, 14.5), height_ratios=(3, 4) * 3)
        for i, (name, shape) in enumerate(shapes.items()):
            form, cof = axes[2 * (i // columns) : 2 * (i // columns) + 2, i % columns]
            x = np.linspace(0, min(1.35 * a, shape.max_radius), 300)
            for heights, colour in ((shape.profile_3d(x), COLOURS[0]), (shape.profile_1d(x), COLOURS[1])):
                wall = np.r_[heights, 3 * d] if x[-1] < 1.35 * a else heights
                r = np.r_[x, x[-1]] if x[-1] < 1.35 * a else x
                form.plot(1e3 * np.r_[-r[::-1], r], 1e6 * (np.r_[wall[::-1], wall] - d), color=colour)
            form.axhline(0, color="0.4", lw=0.8)
            form.set(title=name, xlim=(-1.35, 1.35), ylim=(-62, 45))
            cof.fill_between(v_hat, *within, color="0.9", lw=0, zorder=0)
            cof.plot(v_hat, curves()[name], color="k")
            cof.plot(full()[name] / eq_1, 1, "v", color=COLOURS[2], ms=8)
            cof.axvline(eq_15 / eq_1, color=COLOURS[2], lw=0.8, ls=":")
            off = 100 * (full()[name] / eq_15 - 1)
            title = f"$F_N = {share[name]:.2f}\\,k_{{zc}}u_{{z0}}$; $v_c$ {off + 0:+.2f} %"
            cof.set(title=title, xlim=(0, 1.3), ylim=(0.45, 1.04))
        for ax in axes[:, 0]:
            ax.set_ylabel("height [µm]" if ax in axes[::2, 0] else r"$\mu/\mu_0$")
        for ax in axes[4]:
            ax.set_xlabel("$r$, $x$ [mm]")
        for ax in axes[5]:
            ax.set_xlabel("$v_0$ over Eq. (1)")
        _legend(axes[4, -1], axes[5, -1])
    return fig


def _legend(form, cof):
    """What the lines are, in the last pair of pictures."""
    from mdr.plots import COLOURS

    form.plot([], color=COLOURS[0], label="shape $f(r)$")
    form.plot([], color=COLOURS[1], label="image $g(x)$")
    form.plot([], color="0.4", lw=0.8, label="undeformed surface")
    cof.plot([], color="k", label="rigid pull")
    cof.plot([], color="0.9", lw=8, label="all shapes")
    cof.plot([], "v", color=COLOURS[2], ms=8, label="$v_c$, mass and spring\n(%: off Eq. (15))")
    cof.plot([], color=COLOURS[2], ls=":", label="Eq. (15)")
    for ax, title in ((form, "above: pressed to 40 µm"), (cof, "below: how it slides")):
        ax.set_title(title)
        ax.axis("off")
        ax.legend(loc="center")


if __name__ == "__main__":
    print(f"Eq. (1) {1e3 * eq_1:.3f} mm/s; mass and spring, Eq. (15), {1e3 * eq_15:.3f} mm/s for every shape")
    print("shape                  F_N/(k_zc u_z0)    static mu/mu_0, at half of Eq. (1)   v_c off Eq. (15) [%]")
    for name, curve in curves().items():
        half = np.interp(0.5, v_hat, curve)
        row = share[name], curve[0], half, 100 * (full()[name] / eq_15 - 1)
        print(f"{name:22s} {row[0]:15.4f} {row[1]:17.4f} {row[2]:19.4f} {row[3]:+22.3f}")
    from mdr.plots import save

    print("figure:", save(figure(), __file__))
