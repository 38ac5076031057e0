"""Profile of one's own: how many facets must a turned tip have before it slides like a ball?

A ball of 20 mm is cut on a lathe as a chain of conical facets over a radius of 1.4 mm. Such a shape has no name here,
but any f(r) will do, with the radii of its corners as `kinks`; the image g(x), and all springs, follow by quadrature.
The corners press with infinite pressure, and the stiffness 2E*a grows unevenly. How fast do force, friction and the
velocity v_c of a body on a spring approach the ball's? The last two feel whether the edge of contact lies on a facet or
near a corner.
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

R, reach, mu_0, omega = 20e-3, 1.4e-3, 0.5, 2 * np.pi * 200
rubber, body = mdr.Elastic(E=4e6, nu=0.5), mdr.SpringPull(k_x=4e3, m=8e-3, c_x=3.0)
ball, vibration = mdr.Paraboloid(R), mdr.NormalOscillation(u_z0=50e-6, du_z=10e-6, omega=omega)


def turned(n):
    """The chain of n facets through points of the ball."""
    corners = reach * np.arange(n + 1) / n
    heights = corners**2 / (2 * R)
    return mdr.Profile(lambda r: np.interp(r, corners, heights), kinks=tuple(corners[1:-1]), r_max=reach)


def contact(indenter, pull=body):
    """An indenter on the rubber."""
    return mdr.SlidingContact(indenter, rubber, mu_0, vibration, pull)


shapes = {n: turned(n) for n in (1, 2, 4)}
v_hat = np.linspace(0, 1.1, 12)
v_0 = v_hat * mdr.critical_velocity(contact(ball, mdr.RigidPull()))
of_ball = mdr.cof_curve(contact(ball, mdr.RigidPull()), v_0).cof
cof = {n: mdr.cof_curve(contact(shape, mdr.RigidPull()), v_0).cof for n, shape in shapes.items()}
full_of_ball = mdr.full_slip_critical_velocity(contact(ball))


def force(indenter):
    """Force at the mean depth [N]."""
    return float(indenter.force(vibration.u_z0, rubber.E_star))


errors = {  # of force, COF and v_c
    n: (
        abs(force(shape) / force(ball) - 1),
        float(np.abs(cof[n] - of_ball).max()) / mu_0,
        abs(mdr.full_slip_critical_velocity(contact(shape)) / full_of_ball - 1),
    )
    for n, shape in shapes.items()
}


def figure():
    """The coarsest tip with its image, its pressure, and how the errors fall with the number of facets."""
    import matplotlib.pyplot as plt

    x, r = np.linspace(0, reach, 281), np.linspace(0, 1.1e-3, 221)[1:]
    with style():
        fig, axes = plt.subplot_mosaic([["tip", "errors"], ["pressure", "errors"]], figsize=(8.6, 5.8))
        left, middle, right = axes["tip"], axes["pressure"], axes["errors"]
        for shape, ls in ((shapes[2], "-"), (ball, ":")):
            left.plot(1e3 * x, 1e6 * shape.profile_3d(x), color=COLOURS[0], ls=ls)
            left.plot(1e3 * x, 1e6 * shape.profile_1d(x), color=COLOURS[1], ls=ls)
        left.annotate("$g(x)$", (1.2, 72), (-42, 2), textcoords="offset points")
        left.annotate("$f(r)$", (1.2, 36), (4, -14), textcoords="offset points")
        left.set(title="2 facets; dotted: the ball", xlabel="$r$, $x$ [mm]", ylabel="height [µm]")
        for n, colour in ((2, COLOURS[0]), (4, COLOURS[2])):
            p = shapes[n].pressure(r, vibration.u_z0, rubber.E_star)
            middle.plot(1e3 * r, 1e-3 * p, color=colour, lw=1.2, label=f"{n} facets")
        middle.plot(1e3 * r, 1e-3 * ball.pressure(r, vibration.u_z0, rubber.E_star), "k:", label="ball")
        middle.set(title="corners press hard ...", xlabel="$r$ [mm]", ylabel="$p$ [kPa]", ylim=(0, 350))
        middle.legend()
        n = np.array(list(errors))
        names = ("force", r"$\mu/\mu_0$, at worst", "$v_c$ of the body")
        for values, mark, name in zip(np.transpose(list(errors.values())), "os^", names, strict=True):
            right.loglog(n, 100 * values, mark + "-", label=name)
        right.loglog(n, 100 * errors[1][0] * (n[0] / n) ** 2, "k:", label="$1/n^2$")
        right.set(title="... the force falls like $1/n^2$", xlabel="facets", ylabel="off the ball [%]")
        right.set_xticks(n, [str(k) for k in n])
        right.minorticks_off()
        right.legend()
    return fig


if __name__ == "__main__":
    print("facets   off the ball [%]: force, mu/mu_0 at worst, v_c of the body")
    for n, off in errors.items():
        print("{:6d} {:24.4f} {:10.4f} {:10.4f}".format(n, *(100 * value for value in off)))
    print("figure:", save(figure(), __file__))
