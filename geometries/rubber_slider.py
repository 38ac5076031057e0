"""Rubber slider: which frequency and amplitude bring its friction on steel below half, and up to which speed?

A designer can choose how a rubber foot is vibrated, not the foot. So here the foot, its rubber and the sliding mass are
fixed, and frequency, amplitude and speed make the grid of a study; everything is asked of its table afterwards, as
friction never falls when a contact slides faster. Run as a script it fills a store, and goes on where it was stopped:

    python geometries/rubber_slider.py --store slider     # 21 000 runs, some minutes on two cores

The rubber is a standard linear solid: soft below 160 Hz, twice as stiff far above. The answer: half needs an amplitude
of a third of the depth at low frequencies and of less than a fifth at high ones, where the contact is stiffer against
the oscillation than against the load. It lasts up to 0.28 of the critical velocity: above 300 Hz for any amplitude from
half the depth on, so that more of it helps only as it raises v_c; at low frequencies only for the greatest. So the
speed grows with the velocity amplitude of the shaker, but for a step back just above the resonance of the mass on its
spring, at 80 Hz.
"""

import argparse

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

depth, mu_0 = 100e-6, 0.8  # m, -
rubber = mdr.StandardLinearSolid(E_inf=3e6, E_1=3e6, tau_1=1e-3, nu=0.5)
foot = mdr.SlidingContact(
    indenter=mdr.Paraboloid(R=10e-3),
    material=rubber,
    mu_0=mu_0,
    oscillation=mdr.NormalOscillation(u_z0=depth, du_z=0.5 * depth, omega=2 * np.pi * 100),
    pull=mdr.SpringPull(k_x=5e4, m=0.2, c_x=20.0),  # 80 Hz on its spring, a tenth of critical damping
)


def study(n_frequencies, n_amplitudes, n_speeds, store=None):
    """COF over frequency (30 Hz to 3 kHz), amplitude (5 to 95 % of the depth) and speed (0, and 1 mm/s to 1 m/s)."""
    axes = {
        "oscillation.omega": 2 * np.pi * np.geomspace(30, 3000, n_frequencies),
        "oscillation.du_z": depth * np.linspace(0.05, 0.95, n_amplitudes),
        "v_0": np.r_[0, np.geomspace(1e-3, 1, n_speeds - 1)],
    }
    knobs = {"n_springs": 64, "steps_per_period": 256}  # for 2e-4 of the friction
    return mdr.sweep(foot, axes, store, quantities=("cof", "cof_error", "v_c"), **knobs)


def fastest_half(table):
    """Greatest speed [m/s] with half the friction or less, (n_frequencies, n_amplitudes); 0: none, nan: beyond."""
    speed, cof = table.axes["v_0"], table["cof"] / mu_0
    out = np.zeros(cof.shape[:2])
    for where in np.ndindex(out.shape):
        low = np.flatnonzero(cof[where] <= 0.5)
        if low.size == speed.size:
            out[where] = np.nan
        elif low.size:
            k = low[-1]
            share = (0.5 - cof[where][k]) / (cof[where][k + 1] - cof[where][k])
            out[where] = speed[k] + share * (speed[k + 1] - speed[k])
    return out


def least_amplitude(table):
    """Least amplitude [m] that halves the static COF, (n_frequencies,), between those of the table."""
    amplitude, at_rest = table.axes["oscillation.du_z"], table["cof"][:, :, 0] / mu_0
    return np.array([np.interp(0.5, row[::-1], amplitude[::-1]) for row in at_rest])


coarse = study(3, 5, 9)
fastest = fastest_half(coarse)
needed = least_amplitude(coarse)
share_of_v_c = fastest / coarse["v_c"][:, :, 0]


def figure(table=coarse):
    """The greatest speed with half the friction over frequency and amplitude, and what share of v_c it is."""
    import matplotlib.pyplot as plt
    from matplotlib.colors import LogNorm, Normalize

    frequency, amplitude = table.axes["oscillation.omega"] / (2 * np.pi), 1e6 * table.axes["oscillation.du_z"]
    speed = fastest_half(table)
    share = speed / table["v_c"][:, :, 0]
    shown = (
        (1e3 * np.maximum(speed, 3e-4), (1, 3, 10, 30, 100, 300), "half the friction up to [mm/s]", LogNorm(1, 1e3)),
        (share, np.arange(0.05, 0.3, 0.05), "the same over the critical velocity", Normalize(0, 0.35)),
    )
    with style():
        fig, axes = plt.subplots(1, 2, sharey=True, figsize=(9.5, 4.4))
        for ax, (values, levels, title, norm) in zip(axes, shown, strict=True):
            look = {"levels": levels, "norm": norm, "extend": "max"}
            areas = ax.contourf(frequency, amplitude, values.T, cmap="viridis", alpha=0.8, **look)
            lines = ax.contour(frequency, amplitude, values.T, levels=levels, colors="k", linewidths=0.7)
            fig.colorbar(areas, ax=ax, format="%g", pad=0.02).add_lines(lines)
            ax.fill_between(frequency, amplitude[0], 1e6 * least_amplitude(table), color="white", zorder=2)
            ax.plot(frequency, 1e6 * least_amplitude(table), color=COLOURS[1], linewidth=2.2, label="static COF halved")
            ax.set(title=title, xscale="log", xlabel="frequency [Hz]")
        axes[0].set_ylabel(r"amplitude $\Delta u_z$ [µm]")
        axes[0].legend(loc="lower left")
    return fig


def in_gallery(store=None):
    """The same of a finer study, of 3 900 runs: contours of the coarse one have corners."""
    return figure(study(13, 12, 25, store))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="A rubber foot on steel: half the friction, up to which speed?")
    parser.add_argument("--store", default="rubber_slider", help="folder that keeps the 21 000 runs")
    table = study(21, 20, 50, parser.parse_args().store)
    print(table)
    print(f"greatest error of the COF: {np.nanmax(table['cof_error']):.1e}")
    print("frequency [Hz]  least amplitude [µm] for static mu_0/2  speed [mm/s] with half, at 50 and 95 % of the depth")
    speed, amplitude = 1e3 * fastest_half(table), table.axes["oscillation.du_z"]
    at = [int(np.argmin(np.abs(amplitude - x * depth))) for x in (0.5, 0.95)]
    for omega, least, row in zip(table.axes["oscillation.omega"], least_amplitude(table), speed, strict=True):
        print(f"{omega / (2 * np.pi):12.0f} {1e6 * least:24.1f} {row[at[0]]:35.2f} {row[at[1]]:10.2f}")
    print("figure:", save(figure(table), __file__))
