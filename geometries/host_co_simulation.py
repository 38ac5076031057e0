"""Co-simulation: which step may a host take that moves a body on a spring, while the contact is a unit of its own?

A ball of 10 g on a spring is kicked along a half-space and comes to rest by friction. The host knows the body, a unit
that `mdr export -o contact.fmu` made knows the contact, and they meet at the ends of steps h alone,

    m u_x'' = -k u_x - F_x,   F_x at the end of the last step.

A force that comes late by about h takes the damping k_c h from the body, with the stiffness k_c of the contact in
stick. So steps must be short beside 1/omega, omega² = (k + k_c)/m. A host that can take a step back need not know that:
where F_x changes by more than a share of mu_0 F_z, it sets the unit to the kept state and halves the step.

The answer: the error of the motion is some 0.7 omega h of its way, one percent at omega h = 0.015; from omega h = 0.3
on it is another motion. Steps that are taken back know no omega, and take half as many calls more for one error.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import fmpy  # of the extra mdr-friction[export]
import numpy as np
from fmpy.fmi2 import FMU2Slave

import mdr
from mdr.element.fmu import fmu, sources  # needs a C compiler
from mdr.plots import save, style

m, k, mu_0, depth, kick, end = 0.01, 400.0, 0.5, 40e-6, 0.04, 0.1  # kg, N/m, -, m, m/s, s
ball, rubber = mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5)
contact = mdr.ContactElement(ball, rubber, mu_0, u_z_max=depth, n_springs=64)
k_c, limit = 2 * rubber.G_star * ball.contact_radius(depth), mu_0 * ball.force(depth, rubber.E_star)  # N/m in stick, N
omega, way = np.sqrt((k + k_c) / m), kick * np.sqrt(m / k)  # rad/s, and m without friction


def motion(h, share=np.inf):
    """Instants and ways of the ball, and calls of the unit; steps of h at most, of less than this share of mu_0 F_z."""
    unit.reset()
    unit.setupExperiment()
    unit.enterInitializationMode()
    unit.setReal([0, 1, 2], [0.0, 0.0, depth])
    unit.exitInitializationMode()
    t, x, v, F, dt, calls, path = 0.0, 0.0, kick, 0.0, h, 0, [(0.0, 0.0)]
    kept, free = unit.getFMUState(), np.sqrt(k / m)
    while t < end:
        cos, sin, off = np.cos(free * dt), np.sin(free * dt), x + F / k  # exact for a force that stays
        x_1, v_1, calls = off * cos + v / free * sin - F / k, v * cos - off * free * sin, calls + 1
        unit.setReal([0], [x_1])
        unit.doStep(t, dt)
        (F_1,) = unit.getReal([3])
        if abs(F_1 - F) > share * limit:
            unit.setFMUState(kept)
            dt /= 2
            continue
        t, x, v, F, dt = t + dt, x_1, v_1, F_1, min(1.5 * dt, h)
        unit.freeFMUState(kept)
        kept = unit.getFMUState()
        path.append((t, x))
    unit.freeFMUState(kept)
    return *np.array(path).T, calls


with TemporaryDirectory() as folder:
    Path(folder, "contact.fmu").write_bytes(fmu(sources(contact, "contact", "a ball on rubber"), "contact"))
    fmpy.extract(f"{folder}/contact.fmu", folder)
    guid = fmpy.read_model_description(f"{folder}/contact.fmu").guid
    unit = FMU2Slave(guid=guid, unzipDirectory=folder, modelIdentifier="contact", instanceName="ball")
    unit.instantiate()
    steps, shares = np.geomspace(0.01, 3, 9), np.geomspace(0.01, 0.3, 4)  # omega h, and of mu_0 F_z
    true_t, true_x, _ = motion(0.001 / omega)
    fixed, rolled = [motion(h / omega) for h in steps], [motion(3 / omega, share) for share in shares]
    unit.freeInstance()
error, of_rolled = (
    [np.abs(x - np.interp(t, true_t, true_x)).max() / true_x.max() for t, x, _ in some] for some in (fixed, rolled)
)


def figure():
    """Left: the motion. Right: its error over the calls of the unit."""
    import matplotlib.pyplot as plt

    with style():
        fig, (moved, off) = plt.subplots(1, 2, figsize=(11, 4.4))
        moved.plot(1e3 * true_t, 1e6 * true_x, "k", label="short steps")
        for i in (5, 8):
            moved.plot(1e3 * fixed[i][0], 1e6 * fixed[i][1], ".-", label=rf"$\omega h = {steps[i]:.2g}$")
        moved.set(xlabel="time [ms]", ylabel="way of the ball [µm]", title="long steps move another ball")
        off.loglog([calls for *_, calls in fixed], error, "o-", label="equal steps")
        off.loglog([calls for *_, calls in rolled], of_rolled, "s-", label="steps taken back")
        off.set(xlabel="calls of the unit", ylabel="error of the motion", title=r"more calls, without knowing $\omega$")
        moved.legend()
        off.legend()
    return fig


if __name__ == "__main__":
    print(f"k_c = {k_c:.0f} N/m, 1/omega = {1e3 / omega:.2f} ms, way {1e6 * true_x.max():.0f} of {1e6 * way:.0f} µm")
    for name, values, runs, errors in (("omega h", steps, fixed, error), ("share", shares, rolled, of_rolled)):
        for value, (*_, calls), off in zip(values, runs, errors, strict=True):
            print(f"{name} = {value:<7.3g} {calls:6} calls, error {100 * off:.3g} %")
    print("figure:", save(figure(), __file__))
