"""Ultrasonic sliding: how far does a shake along the slide lower friction of steel on steel, up to which speed?

A crowned steel pin slides on steel under a constant load, and a transducer shakes it along its way. Amplitudes of
micrometres at 20 kHz are what such transducers give, and a ball of 20 mm under 20 N stays below 1 GPa of pressure; all
numbers are orders of magnitude. If force followed the direction of sliding at once, the mean friction would be

    mu = mu_0 (2/pi) arcsin(v_0/v_c),   v_c = omega du_x,

which knows neither load nor shape. But a contact deflects by mu_0 kappa d before it slides, 0.23 µm here. This matters
in two ways. An amplitude below it, chi = du_x/(mu_0 kappa d) < 1, leaves friction at rest, the share F_N(d - du_x/(mu_0
kappa))/F_N(d). And a larger one keeps near the law up to a knee only: there the way back within a period,

    2 du_x [sqrt(1 - r²) - r arccos(r)],   r = v_0/v_c,

is what the contact deflects from one side to the other, 2 mu_0 kappa d. Faster, springs no longer slip backward.

The answer: 5 µm halve friction up to 0.7 v_c = 0.44 m/s. Smaller amplitudes or higher loads do less than the law says,
yet v_c stays as it is. Nothing is saved: the transducer gives more power than the pull is spared.
"""

import numpy as np
from scipy.optimize import brentq

import mdr
from mdr.plots import COLOURS, save, style

omega, mu_0 = 2 * np.pi * 20e3, 0.2  # rad/s, -
steel, pin = mdr.ElasticPair(E_1=210e9, nu_1=0.3, E_2=210e9, nu_2=0.3), mdr.Paraboloid(R=20e-3)
usual, loads = 20.0, (2.0, 20.0, 200.0)  # N
amplitudes = np.array([5e-6, 1e-6, 0.4e-6, 0.2e-6])  # m
speed = 0.1  # m/s


def contact(du_x, load=usual):
    """The pin under a constant load [N], shaken along its way by the amplitude du_x [m]."""
    shake = mdr.InPlaneOscillation(omega, du_x)
    return mdr.SlidingContact(pin, steel, mu_0, mdr.ConstantLoad(load), shake=shake)


def friction(du_x, v_0, load=usual):
    """Friction over mu_0 [-]."""
    return mdr.slide(contact(du_x, load), v_0).cof / mu_0


def rigid_law(r):
    """Friction over mu_0 [-] at r = v_0/v_c of a contact that does not deflect."""
    return 2 / np.pi * np.arcsin(np.minimum(r, 1))


def knee(chi):
    """Share of v_c [-] up to which every spring slips backward once a period; 0 for chi <= 1."""
    return brentq(lambda r: np.sqrt(1 - r * r) - r * np.arccos(r) - 1 / max(chi, 1), 0, 1)


def half_friction_velocity(du_x):
    """Velocity [m/s] up to which friction is mu_0/2 or less."""
    return brentq(lambda v_0: friction(du_x, v_0) - 0.5, 0, omega * du_x, xtol=1e-5 * omega * du_x)


def half_friction_amplitude(load):
    """Amplitude [m] that halves friction at the speed."""
    return brentq(lambda du_x: friction(du_x, speed, load) - 0.5, speed / omega, 10e-6, xtol=1e-9)


depth = {load: mdr.resolved(contact(amplitudes[0], load)).working_depth for load in loads}  # d [m]
deflection = {load: mu_0 * steel.mindlin_ratio * d for load, d in depth.items()}  # mu_0 kappa d [m]
chi = amplitudes / deflection[usual]
knees = np.array([knee(one) for one in chi])
v_c = np.array([mdr.critical_velocity(contact(du_x)) for du_x in amplitudes])
shares = np.r_[np.linspace(0, 1, 33), 1.2]  # of v_c
curves = [mdr.cof_curve(contact(du_x), v * shares) for du_x, v in zip(amplitudes, v_c, strict=True)]
halved_up_to = np.array([half_friction_velocity(du_x) for du_x in amplitudes])
halved_from = {load: half_friction_amplitude(load) for load in loads}
some_chi = np.array([0.1, 0.25, 0.5, 0.75, 1.0, 1.1])
held = {
    load: np.array([mdr.holding_band(contact(x * deflection[load], load)).high for x in some_chi]) for load in loads
}
shaken = speed / omega * np.r_[0.7, np.geomspace(1, 6, 17)]  # m
at_speed = {load: np.array([friction(du_x, speed, load) for du_x in shaken]) for load in loads}
run = mdr.slide(contact(amplitudes[0]), speed)


def figure():
    """Left: friction over velocity. Right: over the amplitude, at rest and at one speed, for three loads."""
    import matplotlib.pyplot as plt

    with style():
        fig, axes = plt.subplot_mosaic([["curve", "rest"], ["curve", "sliding"]], sharey=True, figsize=(8.6, 5.8))
        curve, rest, sliding = axes["curve"], axes["rest"], axes["sliding"]
        r = np.linspace(0, 1.2, 601)
        for i, (one, colour) in enumerate(zip(curves, COLOURS, strict=False)):
            label = f"{1e6 * amplitudes[i]:g} µm, $\\chi = {chi[i]:.1f}$"
            curve.plot(shares, one.cof / mu_0, color=colour, label=label)
            if chi[i] > 1:
                curve.plot(knees[i], np.interp(knees[i], shares, one.cof / mu_0), "o", color=colour)
        curve.plot(r, rigid_law(r), "k--", lw=1.2, label="no deflection")
        curve.set(title=f"{usual:g} N: near the law up to a knee (dots)", xlabel=r"$v_0/(\omega\,\Delta u_x)$")
        curve.set(ylabel=r"friction $\mu/\mu_0$", xlim=(0, 1.2), ylim=(0, 1.06))
        curve.legend(loc="lower right", title=r"amplitude $\Delta u_x$")
        x = np.linspace(0, 1.5, 301)
        for load, colour in zip(loads, COLOURS, strict=False):
            left = np.maximum(1 - x, 0) ** 1.5  # F_N goes with d^(3/2)
            rest.plot(1e6 * deflection[load] * x, left, color=colour, label=f"{load:g} N")
            rest.plot(1e6 * deflection[load] * some_chi, held[load] / mu_0, "o", ms=5, color=colour, clip_on=False)
            sliding.plot(1e6 * shaken, at_speed[load], color=colour, label=f"{load:g} N")
        rest.plot([], [], "o", ms=5, color="0.4", label="holding band")
        rest.set(title=r"at rest: some is left below $\chi = 1$", xlim=(0, 1.2))
        fine = np.geomspace(shaken[0], shaken[-1], 601)
        sliding.plot(1e6 * fine, rigid_law(speed / (omega * fine)), "k--", lw=1.2, label="no deflection")
        sliding.set(title=f"at {speed:g} m/s: a higher load asks for more", xlim=(0, 1e6 * shaken[-1]))
        for ax in (rest, sliding):
            ax.tick_params(labelleft=True)
            ax.set_xlabel(r"amplitude $\Delta u_x$ [µm]")
            ax.legend(loc="upper right")
    return fig


if __name__ == "__main__":
    print(f"{usual:g} N: the contact deflects by {1e6 * deflection[usual]:.2f} µm; without deflection 0.707 and 0")
    print("amplitude [µm]    chi   knee/v_c   v_c [m/s]   halved up to [m/s]   share of v_c   friction at rest/mu_0")
    for row in zip(1e6 * amplitudes, chi, knees, v_c, halved_up_to, halved_up_to / v_c, curves, strict=True):
        print("{:14.1f} {:6.1f} {:10.2f} {:11.3f} {:20.3f} {:14.3f}".format(*row[:-1]), end=" ")
        print(f"{row[-1].static_cof / mu_0:z23.3f}")
    for load in loads:
        print(f"{load:3g} N: friction at rest is gone from {1e6 * deflection[load]:.2f} µm on,", end=" ")
        print(f"halved at {speed:g} m/s from {1e6 * halved_from[load]:.2f} µm on")
    energy, frequency = run.energy_balance, omega / (2 * np.pi)
    print(f"{1e6 * amplitudes[0]:g} µm at {speed:g} m/s leave {run.cof / mu_0:.3f} of the friction:", end=" ")
    print(f"the pull gives {frequency * energy.pull_work:.2f} W instead of {mu_0 * usual * speed:.2f} W,", end=" ")
    print(f"the transducer {frequency * energy.shake_work:.2f} W")
    print("figure:", save(figure(), __file__))
