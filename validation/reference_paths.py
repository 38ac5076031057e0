"""Twenty paths of a contact with the exact forces, for the authors of other contact models.

`python -m validation.reference_paths -o docs/paths` writes a table of each path, and paths.csv that lists them. The
answers come from validation/reference_springs.py, and for one arm from closed forms here; nothing of `mdr` is used.
"""

import argparse
import pathlib
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from validation.reference_springs import Contact, dragged, tangential, with_dashpot

BALL, PUNCH = Contact("ball", 5e-3, 3e6, 0.5, 0.5), Contact("punch", 1e-3, 200e9, 0.3, 0.2)
DEPTH = {"ball": 20e-6, "punch": 1e-6}  #: [m], the unit of depths below
STEPS = "explicit steps of each spring"


class Path(NamedTuple):
    """A path and the exact answer."""

    name: str
    contact: Contact
    asks: str
    checked: str  #: by what the tests check the answer, beside its own convergence
    t: np.ndarray  #: (rows,) [s]
    u: np.ndarray  #: (rows, 3) [m]
    F: np.ndarray  #: (rows, 3) [N]

    @property
    def scale(self) -> float:
        """mu_0 times the greatest F_z [N]."""
        return float(self.contact.mu_0 * self.F[:, 2].max())


def unit(contact: Contact) -> float:
    """Way [m] at which the contact slips as a whole, mu_0 kappa times the unit of depth."""
    return contact.mu_0 * contact.kappa * DEPTH[contact.shape]


def through(corners: Sequence[Sequence[float]], parts: int) -> np.ndarray:
    """Rows at even distances between corners."""
    at = np.linspace(0, len(corners) - 1, parts * (len(corners) - 1) + 1)
    return np.column_stack([np.interp(at, np.arange(len(corners)), one) for one in np.array(corners, float).T])


def elastic(name: str, contact: Contact, asks: str, rows: np.ndarray, checked: str = STEPS) -> Path:
    """A path of an elastic contact; rows (n, 3) are ways over the unit of way and depths over the unit of depth."""
    u = rows * [unit(contact), unit(contact), DEPTH[contact.shape]]
    f = tangential(contact, u, dragged(contact, u))
    F = np.column_stack([f.real, f.imag, contact.load(u[:, 2])])
    return Path(name, contact, asks, checked, np.arange(len(u)) * 1e-3, u, F)


def along(ways: Sequence[float], depth: float = 1.0) -> list[tuple[float, float, float]]:
    """Corners along x at one depth."""
    return [(x, 0.0, depth) for x in ways]


def carried(share: float) -> float:
    """Depth of the ball, over the unit, under this share of the load at the unit."""
    return share ** (2 / 3)


def ball_paths() -> list[Path]:
    """Of an elastic ball."""
    turn = np.exp(2j * np.pi * np.arange(49) / 24)
    eight = np.arange(97) * 2 * np.pi / 48
    taps = np.arange(161) * 2 * np.pi / 32
    shaken = [(0.5, 0.0, 1.0), *((0.5 + 0.02 * k, 0.25 * (-1) ** k, 1.0) for k in range(21))]
    low, high = carried(0.6), carried(1.5)
    given = [
        ("pull", "partial slip before full slip", through(along([0, 1.5]), 30), "Cattaneo 1938; Mindlin 1949"),
        ("reversal", "hysteresis loop", through(along([0, 0.7, -0.7, 0.7]), 20), "Mindlin and Deresiewicz 1953"),
        ("memory", "loops inside loops", through(along([0, 0.8, -0.4, 0.4, -0.1, 0.2, -0.4, 0.9, 1.2]), 8), STEPS),
        ("load_raised", "load raised at fixed way and pulled on",
         through([(0, 0, 1), (0.6, 0, 1), (0.6, 0, high), (1.6, 0, high)], 12), "Mindlin and Deresiewicz 1953"),
        ("load_lowered", "load lowered at fixed way and pulled on and reversed",
         through([(0, 0, 1), (0.6, 0, 1), (0.6, 0, low), (1, 0, low), (0, 0, low), (0, 0, 1), (0.3, 0, 1)], 10), STEPS),
        ("load_cycles", "load up and down at fixed way: what is lost is lost once",
         through([(0, 0, 1), (0.5, 0, 1), *5 * [(0.5, 0, carried(1.3)), (0.5, 0, carried(0.7))], (0.5, 0, 1)], 6),
         STEPS),
        ("held_load", "small cycles of the way under a held load: no creep",
         through(along([0, 0.4, *10 * [0.3, 0.4]]), 6), STEPS),
        ("oblique", "pressed and pulled at once: no slip at a flat angle",
         through([(0, 0, 0), (0.8, 0, 1), (1.4, 0, 1)], 20), "Mindlin and Deresiewicz 1953"),
        ("oblique_steep", "pressed and pulled at once: full slip at a steep angle",
         through([(0, 0, 0), (1.2, 0, 1), (0.6, 0, 0.3)], 20), STEPS),
        ("lift_off", "lifted and moved in the air and back",
         through([(0, 0, 1), (0.6, 0, 1), (0.6, 0, -0.2), (2, 0, -0.2), (2, 0, 1), (2.5, 0, 0.8)], 10), STEPS),
        ("tapping", "taps that lose the contact during a slow slide",
         np.column_stack([0.02 * np.arange(161), np.zeros(161), 1 + 1.2 * np.sin(taps)]), STEPS),
        ("turn", "pulled along x and then along y", through([(0, 0, 1), (1.2, 0, 1), (1.2, 1.2, 1)], 30), STEPS),
        ("circle", "two rounds on a circle",
         np.column_stack([0.6 * (turn.real - 1), 0.6 * turn.imag, np.ones(49)]), STEPS),
        ("eight", "a figure of eight with a load that changes and is lost",
         np.column_stack([np.sin(eight), 0.7 * np.sin(2 * eight), 0.8 - 0.9 * np.sin(1.5 * eight)]), STEPS),
        ("shaken_across", "a slow pull shaken across", through(shaken, 6), STEPS),
    ]  # fmt: skip
    return [elastic(f"ball_{name}", BALL, asks, rows, checked) for name, asks, rows, checked in given]


def punch_paths() -> list[Path]:
    """Of an elastic punch: it slips as a whole."""
    legs = through([(0, 0, 1), (1.5, 0, 1), (0.9, 0, 1), (0.9, 2, 1), (-1, 1, 1)], 10)
    round_ = 1.2 * np.exp(2j * np.pi * np.arange(49) / 24)
    load = np.interp(np.arange(49), [0, 12, 24, 30, 36, 48], [1, 1.6, 0.4, -0.3, 0.8, 1.2])
    circle = np.column_stack([round_.real - 1.2, round_.imag, load])
    return [
        elastic("punch_legs", PUNCH, "full slip and a reversal and a leg across", legs, "tractrix"),
        elastic("punch_circle", PUNCH, "a circle under a load that changes and is lost", circle),
    ]


def kelvin_paths() -> list[Path]:
    """Of Kelvin bodies that are pulled and held and pulled back, at the depth at which they rested."""
    found, rows = [], through(along([0, 0.5, 0.5, 1.4, 1.4, -0.2]), 12)
    t = through([(one,) for one in (0, 0.04, 0.08, 0.1, 0.14, 0.18)], 12)[:, 0]
    for name, elastic_one, asks in (
        ("punch_kelvin", PUNCH, "a force that falls at once where the way is held and creep in slip"),
        ("ball_kelvin", BALL, "the same with partial slip"),
    ):
        contact = elastic_one._replace(tau=0.02)
        u = rows * [unit(contact), unit(contact), DEPTH[contact.shape]]
        F_x = tangential(contact, u, with_dashpot(contact, t, u)).real
        F = np.column_stack([F_x, 0 * t, contact.load(u[:, 2])])
        found.append(Path(name, contact, asks, STEPS, t, u, F))
    return found


def relaxing() -> Path:
    """A punch on a standard linear solid: pressed, held, pulled to slip, held.

    The arm of the compression is s_1' = s' - s_1/theta, that of the extension e likewise. A spring sticks while L[e] =
    e + rho e_1 is below L[s]. In slip d = s - e has no force: it relaxes with theta (1 + rho), and d_1 = -d/rho. As d
    is positive, what is then held sticks.
    """
    contact = PUNCH._replace(E_1=PUNCH.E, tau_1=0.05)
    theta, rho, way = contact.tau_1, contact.E_1 / contact.E, unit(contact)
    stiffness = 2 * contact.E_star * contact.size
    pressed, begins, ends = 0.02, 0.06, 0.1
    v = 1.6 * way / (ends - begins)
    corners = [(one,) for one in (0, pressed, begins, ends)]
    t = np.concatenate([through(corners, 10)[:, 0], np.linspace(ends, 0.3, 33)[1:]])

    def arm(t: np.ndarray) -> np.ndarray:
        """Of what has grown with the rate 1 for the time t."""
        return -theta * np.expm1(-np.maximum(t, 0) / theta)

    def of_compression(t: np.ndarray) -> np.ndarray:
        return way / pressed * arm(np.minimum(t, pressed)) * np.exp(-np.maximum(t - pressed, 0) / theta)

    def limit(t: np.ndarray) -> np.ndarray:
        return way * np.minimum(t / pressed, 1) + rho * of_compression(t)

    def stuck(t: np.ndarray) -> np.ndarray:
        return v * (np.maximum(t - begins, 0) + rho * arm(t - begins))

    slips = brentq(lambda t: stuck(t) - limit(t), begins, ends, xtol=1e-17, rtol=1e-15)
    d = (way - v * (slips - begins)) * np.exp((slips - ends) / (theta * (1 + rho)))
    held = way - d + (rho * of_compression(ends) + d) * np.exp((ends - t) / theta)
    F_x = stiffness / contact.kappa * np.where(t <= ends, np.minimum(stuck(t), limit(t)), held)
    F_z = stiffness * DEPTH["punch"] / way * limit(t)
    u = np.column_stack([v * np.clip(t - begins, 0, ends - begins), 0 * t, DEPTH["punch"] * np.minimum(t / pressed, 1)])
    asks = "relaxation of load and force at a held position"
    return Path("punch_relaxing", contact, asks, STEPS, t, u, np.column_stack([F_x, 0 * t, F_z]))


def paths() -> list[Path]:
    """All twenty."""
    return [*ball_paths(), *punch_paths(), *kelvin_paths(), relaxing()]


HEADER = "t [s],u_x [m],u_y [m],u_z [m],F_x [N],F_y [N],F_z [N]"
LISTED = "path,indenter,R or a [m],E [Pa],nu [-],mu_0 [-],tau [s],E_1 [Pa],tau_1 [s],mu_0 max F_z [N],asks,checked by"


def table(path: Path) -> str:
    """A path as CSV."""
    rows = np.column_stack([path.t, path.u, path.F])
    return "\n".join([HEADER, *(",".join(f"{one:.13g}" for one in row) for row in rows)]) + "\n"


def listed(found: Sequence[Path]) -> str:
    """The table of all paths as CSV."""
    lines = [
        ",".join([one.name, one.contact.shape, *(f"{value:g}" for value in one.contact[1:]), f"{one.scale:.13g}"])
        + f",{one.asks},{one.checked}"
        for one in found
    ]
    return "\n".join([LISTED, *lines]) + "\n"


def main(argv: Sequence[str] | None = None) -> None:
    """Write all tables."""
    parser = argparse.ArgumentParser("python -m validation.reference_paths", description=__doc__.partition("\n\n")[0])
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="folder")
    folder, found = parser.parse_args(argv).output, paths()
    folder.mkdir(parents=True, exist_ok=True)
    for one in found:
        (folder / f"{one.name}.csv").write_text(table(one), encoding="utf-8")
    (folder / "paths.csv").write_text(listed(found), encoding="utf-8")
    print(f"{len(found)} paths in {folder}")


if __name__ == "__main__":
    main()
