"""Elements with arms drawn at random, and steps of theirs of any length beside the times of the arms."""

from dataclasses import dataclass

import numpy as np

import mdr

DEPTH, MU_0 = 40e-6, 0.5
SHAPES = [mdr.Paraboloid(R=4e-3), mdr.Cone(theta=0.05), mdr.FlatPunch(a=1e-3), mdr.PowerLaw(c=1e5, n=3.0)]
KINDS = {"slide": 0.3, "fast": 0.2, "huge": 0.08, "rest": 0.15, "lift": 0.12, "off": 0.07, "back": 0.08}
EQUAL = np.arange(1, 401) / 400
CLOSER = np.append(np.geomspace(1e-9, 0.5, 201)[:-1], np.linspace(0.5, 1, 201))  #: at its start, where arms relax


@dataclass(frozen=True, eq=False)
class Step:
    """A step of an element."""

    kind: str
    element: mdr.ContactElement
    state: np.ndarray
    dt: float
    u: np.ndarray

    def in_parts(self, shares=(1.0,)):
        """Force and state after parts of the step that end at these shares of it, and the least heat of a part [J]."""
        state, begin, before, least = self.state, self.state[:3], 0.0, np.inf
        for share in shares:
            heat = self.element.dissipated(state)
            F, state = self.element.step(state, self.dt * (share - before), begin + (self.u - begin) * share)
            before, least = share, min(least, float(self.element.dissipated(state) - heat))
        return F, state, least

    def missed(self, F, shares):
        """Force in the plane that F misses of that in parts, over mu_0 F_z."""
        G = self.in_parts(shares)[0]
        return float(np.abs(F - G)[:2].max() / (MU_0 * G[2])) if G[2] > 0 else float(np.abs(F).max() > 0)

    def energy(self, state):
        """What energies are compared with [J]: what springs store, and the work so far, in which heat is rounded."""
        stored = self.element.stored(self.state) + self.element.stored(state)
        return float(stored + abs(state[3]) + abs(self.state[3]))


def a_material(rng):
    """One to four arms of 1 ns to 1000 s; a dashpot beside them in three of ten."""
    n = rng.integers(1, 5)
    arms = zip(2e6 * 10.0 ** rng.uniform(-1.5, 1, n), 10.0 ** rng.uniform(-9, 3, n), strict=True)
    tau = 10.0 ** rng.uniform(-9, 3) if rng.random() < 0.3 else 0.0
    return mdr.Prony(E_inf=2e6, arms=tuple(arms), nu=rng.uniform(0, 0.5), tau=tau)


def walk(rng, n=10, material=None):
    """The steps of an element, one after the other: dt over the time of one of its arms is from 1e-3 to 1e6."""
    material = a_material(rng) if material is None else material
    shape, n_springs = SHAPES[rng.integers(len(SHAPES))], int(rng.choice([16, 32]))
    element = mdr.ContactElement(shape, material, MU_0, u_z_max=DEPTH, n_springs=n_springs)
    times = [tau for _, tau in material.contact_arms] or [material.tau or 1.0]
    u = np.array([0, 0, DEPTH * rng.uniform(0.05, 1)])
    state, on_line, tiny = element.at_rest(u), rng.random() < 0.25, rng.random() < 0.1
    for _ in range(n):
        kind, dt = (
            str(rng.choice(list(KINDS), p=[*KINDS.values()])),
            float(rng.choice(times) * 10 ** rng.uniform(-3, 6)),
        )
        u = u + moved(rng, kind, on_line, u[2]) * [*2 * [MU_0 * material.mindlin_ratio * DEPTH], DEPTH]
        u[2] = min(u[2], 1e-5 * DEPTH * rng.uniform(0.2, 1)) if tiny else u[2]
        step = Step(kind, element, state, dt, u)
        yield step
        state = step.in_parts()[1]


def moved(rng, kind, on_line, depth):
    """Way over the reach of friction, and depth over the greatest, of a step."""
    size = {
        "slide": 10 ** rng.uniform(-2, 0.5),
        "fast": 10 ** rng.uniform(0, 1.3),
        "huge": 10 ** rng.uniform(1.3, 4),
        "rest": 0.0,
        "lift": rng.choice([0, 10 ** rng.uniform(-3, 0)]),
        "off": 0.3,
        "back": 10 ** rng.uniform(-2, 1),
    }[kind]
    before = depth / DEPTH
    to = {
        "rest": before,
        "lift": max(before, 0) * rng.uniform(0.02, 0.95),
        "off": -rng.uniform(0, 0.5),
        "back": rng.uniform(0.1, 1),
    }.get(kind, before if rng.random() < 0.3 else rng.uniform(0.05, 1))
    angle = np.pi * rng.integers(2) if on_line else rng.uniform(0, 2 * np.pi)
    return np.array([size * np.cos(angle), 0.0 if on_line else size * np.sin(angle), to - before])
