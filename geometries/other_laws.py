"""Other laws: which errors do smoothed and forgetful laws of friction make on twenty exact paths?

Each law has the tangential stiffness of the contact at the mean depth, k = 2 G* a, and the exact normal force.

    smoothed     F = mu_0 F_N tanh(|v|/v_s) v/|v|, v_s a tenth of the mean velocity: no force at rest
    Dahl         F' = k (v - |v| F/(mu_0 F_N)): forgets the past with the way, also far below the limit
    one spring   F' = k v, cut to mu_0 F_N (Cundall and Strack 1979): slips late, and all at once
    rescaled     the same with k of the depth, and F falling with it: what held stays in proportion

The answer: on a ball none is within a tenth of mu_0 F_N on all paths. In ten cycles far below slip the Dahl law loses
three quarters of a force that in truth stays. On Kelvin bodies all others lack a dashpot.
"""

import csv
from pathlib import Path

import numpy as np

import mdr
from mdr.plots import COLOURS, save, style

FOLDER = Path(__file__).parents[1] / "docs" / "paths"
SUBSTEPS, HELD = 50, "ball_held_load"


def read(name):
    """A table of docs/paths: its columns by their names."""
    with (FOLDER / f"{name}.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def smoothed(w, dt, load, v_s):
    """Forces of the smoothed law after ways w, complex."""
    v = np.abs(w) / dt
    return load[1:] * np.tanh(v / v_s) * np.divide(w, np.abs(w), out=0 * w, where=w != 0)


def dahl(f, w, load, k):
    """Force of the Dahl law after a short way, exact under a constant load."""
    decay, way = np.exp(-k[1] * abs(w) / max(load[1], 1e-30)), abs(w) or 1.0
    return f * decay + load[1] * w / way * (1 - decay)


def one_spring(f, w, load, k):
    """Force of one spring with a slider."""
    f = f + k[1] * w
    return f * min(1.0, load[1] / max(abs(f), 1e-30))


def rescaled(f, w, load, k):
    """The same; a stiffness that falls takes the force along."""
    return one_spring(f * min(1.0, k[1] / max(k[0], 1e-30)), w, load, k)


def stepped(law, w, load, k):
    """Forces of a law with memory at all rows, each interval in substeps."""
    f, found, parts = 0j, [], np.linspace(0, 1, SUBSTEPS + 1)
    for i, way in enumerate(w):
        of = [one[i] + parts * (one[i + 1] - one[i]) for one in (load, k)]
        for j in range(SUBSTEPS):
            f = law(f, way / SUBSTEPS, of[0][j : j + 2], of[1][j : j + 2])
        found.append(f)
    return np.array(found)


def springs(case, t, u):
    """Forces of this library, 256 springs."""
    ball, size, E, nu, mu_0, tau, E_1, tau_1 = case
    shape = mdr.Paraboloid(R=size) if ball else mdr.FlatPunch(a=size)
    material = mdr.Prony(E_inf=E, arms=((E_1, tau_1),) if E_1 else (), nu=nu, tau=tau)
    element = mdr.ContactElement(shape, material, mu_0, u_z_max=u[:, 2].max())
    state, found = element.at_rest(u[0]), []
    for dt, end in zip(np.diff(t), u[1:], strict=True):
        F, state = element.step(state, dt, end)
        found.append(complex(F[0], F[1]))
    return np.array(found)


def followed(entry):
    """Tangential forces over mu_0 max F_z on a path: exact, and those of each law."""
    case = entry["indenter"] == "ball", *(float(one) for one in list(entry.values())[2:9])
    t, *u, F_x, F_y, F_z = np.array([list(row.values()) for row in read(entry["path"])], float).T
    _, size, E, nu, mu_0, *_ = case
    d, w, load = np.maximum(u[2], 0), np.diff(u[0] + 1j * u[1]), mu_0 * F_z
    G = 2 * E / ((1 + nu) * (2 - nu))  # G* = 4 G/(2 - nu)
    now = 2 * G * (np.sqrt(size * d) if case[0] else size * (d > 0))
    k = np.full(t.size, 2 * G * (np.sqrt(size * d.mean()) if case[0] else size))
    found = {"exact": (F_x + 1j * F_y)[1:], "springs": springs(case, t, np.column_stack(u))}
    found["smoothed"] = smoothed(w, np.diff(t), load, 0.1 * np.abs(w).sum() / t[-1])
    found["Dahl"] = stepped(dahl, w, load, k)
    found["one spring"] = stepped(one_spring, w, load, k)
    found["rescaled"] = stepped(rescaled, w, load, now)
    return {name: f / load.max() for name, f in found.items()}


forces = {entry["path"]: followed(entry) for entry in read("paths")}
laws = list(forces[HELD])[1:]
errors = {path: [np.abs(of[law] - of["exact"]).max() for law in laws] for path, of in forces.items()}
#: lost per cycle of the held load, over the force at first, in the last nine of ten cycles
lost = {law: 1 - (abs(f[-1]) / abs(f[17])) ** (1 / 9) for law, f in forces[HELD].items()}


def figure():
    """Worst error of each law on each path, and the path of small cycles under a held load."""
    import matplotlib.pyplot as plt

    with style():
        fig, (table, loop) = plt.subplots(1, 2, figsize=(13, 7), width_ratios=(1.15, 1))
        values = np.array(list(errors.values()))
        table.imshow(np.log10(np.maximum(values, 1e-6)), cmap="Blues", vmin=-6, vmax=0.5, aspect="auto")
        for (i, j), value in np.ndenumerate(values):
            text = f"{value:.2f}" if value > 5e-3 else f"{value:.0e}"
            table.text(j, i, text, ha="center", va="center", fontsize=9, color="white" if value > 0.02 else "black")
        table.set_yticks(range(len(errors)), list(errors), fontsize=9)
        table.set_xticks(range(len(laws)), laws)
        table.set_title(r"worst error over $\mu_0 F_z$")
        table.grid(False)
        x = 1e6 * np.array([float(row["u_x [m]"]) for row in read(HELD)])
        for law, colour in zip(("Dahl", "one spring", "smoothed", "exact"), COLOURS[1:], strict=False):
            f = np.concatenate([[0], forces[HELD][law].real])
            loop.plot(x, f, color="black" if law == "exact" else colour, label=law, lw=1.2)
        loop.set(title="held load, ten small cycles", xlabel=r"way $u_x$ [µm]", ylabel=r"$F_x/(\mu_0 F_z)$")
        loop.set_ylim(-1.1, 1.1)
        loop.legend(loc="lower left")
    return fig


if __name__ == "__main__":
    print(f"{'path':20s}", *(f"{law:>11s}" for law in laws))
    for path, worst in errors.items():
        print(f"{path:20s}", *(f"{one:11.1e}" for one in worst))
    print("lost per cycle [%]:", ", ".join(f"{law} {100 * one:z.2f}" for law, one in lost.items()))
    print("figure:", save(figure(), __file__))
