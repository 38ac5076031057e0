"""Sampled profile: how good must a profilometer be to predict the friction of a worn slider?

A slider worn to a cap of 20 mm radius within 0.5 mm, of 8 mm outside, is measured at 33 points to 1.6 mm, with noise:
0.03 µm for a good interferometer, 1 µm for a cheap stylus. Splines through the points, smoothed by 1.5 standard
deviations and cut at the edge of the cap, take the place of the shape, 40 µm deep in rubber, vibrated at 80 Hz. How
much do force, v_c, Eq. (15), and static COF scatter over repeated measurements? Noise that makes the image g(x)
fall is refused: a ring would touch before the disc inside it.
"""

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

truth = mdr.CappedParaboloid(R1=20e-3, R2=8e-3, b=0.5e-3)
r = np.linspace(0, 1.6e-3, 33)
edge = float(r[10])  # of the cap, 0.5 mm
rubber, mu_0, body = mdr.Elastic(E=3e6, nu=0.5), 0.7, mdr.SpringPull(k_x=4e3, m=0.05, c_x=4.0)
u_z0, du_z = 40e-6, 8e-6
vibration = mdr.NormalOscillation(u_z0, du_z, omega=2 * np.pi * 80)
rng = np.random.default_rng(seed=11)


def measured(noise):
    """The slider as a noisy profilometer sees it; None where the noise makes it hollow."""
    heights = truth.profile_3d(r) + noise * rng.standard_normal(r.size)
    try:
        shape = mdr.SampledProfile(r, heights, kinks=(edge,), smoothing=1.5 * noise)
        shape.contact_radius(u_z0 + du_z)
        return shape
    except ValueError:  # annular contact
        return None


def predictions(indenter):
    """Force [N], v_c [m/s] and static COF of an indenter."""
    case = mdr.SlidingContact(indenter, rubber, mu_0, vibration, body)
    return float(indenter.force(u_z0, rubber.E_star)), mdr.critical_velocity(case), mdr.static_cof(case)


quantities = ("force", "$v_c$", "static COF")
noises, n_draws = (0.03e-6, 0.1e-6, 0.3e-6, 1e-6), 8
true = np.array(predictions(truth))
draws = {noise: [shape for shape in (measured(noise) for _ in range(n_draws)) if shape] for noise in noises}
errors = {noise: np.array([predictions(shape) for shape in shapes]) / true - 1 for noise, shapes in draws.items()}
scatter = {noise: np.sqrt(np.mean(error**2, axis=0)) for noise, error in errors.items()}


def figure():
    """One measurement with its spline and image, and the scatter of what follows from it."""
    import matplotlib.pyplot as plt

    shape, fine = draws[noises[-1]][0], np.linspace(0, 1e-3, 300)
    with style():
        fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2))
        points = np.array(shape.f) - np.mean(shape.f - shape.profile_3d(r))
        left.plot(1e3 * r, 1e6 * points, ".", color="0.6", label=f"measured, {1e6 * noises[-1]:g} µm of noise")
        for profile, name, colour in (("profile_3d", "f(r)", COLOURS[0]), ("profile_1d", "g(x)", COLOURS[1])):
            left.plot(1e3 * fine, 1e6 * getattr(shape, profile)(fine), color=colour, label=f"${name}$ of the spline")
            left.plot(1e3 * fine, 1e6 * getattr(truth, profile)(fine), "k:", lw=1)
        left.plot([], [], "k:", lw=1, label="the true ones")
        left.set(title="one of the measurements", xlabel="$r$, $x$ [mm]", ylabel="height [µm]")
        left.set(xlim=(0, 1), ylim=(-3, 90))
        left.legend()
        for i, (name, mark) in enumerate(zip(quantities, "os^", strict=True)):
            right.loglog(1e6 * np.array(noises), [100 * scatter[s][i] for s in noises], mark + "-", label=name)
        right.set(title="scatter of the predictions", xlabel="noise of the profilometer [µm]")
        right.set(ylabel="error, r.m.s. [%]")
        right.legend()
    return fig


if __name__ == "__main__":
    print(f"true: {true[0]:.4f} N, v_c {1e3 * true[1]:.3f} mm/s, static COF {true[2]:.4f}")
    print("noise [µm]   r.m.s. error [%] of force, v_c, static COF    refused")
    for noise, error in scatter.items():
        row = "{:10.2f} {:17.3f} {:9.3f} {:9.3f} {:17d} of {:d}"
        print(row.format(1e6 * noise, *(100 * error), n_draws - len(draws[noise]), n_draws))
    print("figure:", save(figure(), __file__))
