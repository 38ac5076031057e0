"""Rows of springs in any state, the step of the library on them, and Coulomb's law in tiny steps, written apart."""

from dataclasses import dataclass, replace

import numpy as np

from mdr.spring import contact, energies, times
from mdr.spring import row as of
from mdr.spring.contact import Each, Look, Springs
from mdr.spring.energies import LEAST_SLIP, N_SUMS
from mdr.spring.law import law_of
from mdr.spring.path import Path
from mdr.tools.jit import compiled

MATERIALS = {
    "elastic": (0.0, (), ()),
    "Kelvin": (0.7, (), ()),
    "quick Kelvin": (0.02, (), ()),
    "one arm": (0.0, (2.0,), (0.3,)),
    "arm and dashpot": (0.4, (1.5,), (0.5,)),
    "three arms": (0.0, (0.5, 3.0, 1.0), (0.02, 0.4, 50.0)),
    "three arms and dashpot": (0.1, (0.5, 3.0, 1.0), (0.02, 0.4, 50.0)),
}


def for_python(function):
    """A function of the library that compiled ones alone may call."""

    @compiled(nogil=True, error_model="numpy")
    def call(*args):
        return function(*args)

    return call


# row is asked alike in all tests, with the lumped state along a line, and with each spring in the plane or beside a
# look: every other set of what is None would be compiled once more
row, press, as_they_are, nodes_of, _new_tools = map(
    for_python, (of.row, contact.press, of.as_they_are, energies.nodes_of, times.new_tools)
)


def tools_for(law, h, n=0, in_plane=False):
    """Tools of a law, for steps of length h, and rows of n springs with friction along a line or in the plane."""
    (*of_step,), (*room,) = _new_tools(float(h), law.modes, law.arms, 0j if in_plane else 0.0, n)
    return times.Tools(times.Times(*of_step), times.Room(*room))


@dataclass(frozen=True, eq=False)
class Row:
    """Springs of a material (T, rho, theta), a parabola of the top, and how long it takes."""

    material: tuple
    path: Path
    h: float
    gap: np.ndarray
    s: np.ndarray  # (1 + J, n)
    e: np.ndarray
    w: np.ndarray

    @property
    def law(self):
        return law_of(*self.material)

    @property
    def roots(self):
        """Moduli of the spring and its arms, (1 + J,)."""
        return np.concatenate([[1.0], self.material[1]])

    @classmethod
    def draw(cls, rng, material, h=0.2, n=60):
        """In contact or flight, about to touch or to leave; stuck, in slip either way, just behind it."""
        T, rho, _ = material
        moduli = np.concatenate([[1.0], rho])
        path = Path(*rng.uniform(-1, 1, 5) * [1, 1.5, 3, 1.5, 3])
        near = path.z_0 + rng.uniform(-1, 1, n) * h
        gap = np.where(rng.random(n) < 0.6, near, rng.uniform(-2, 1, n))
        s, e = (rng.uniform(-1, 1, (moduli.size, n)) for _ in range(2))
        pressed = path.z_0 - gap
        lifted = pressed + rng.uniform(0.001, 1, n) * h
        if T:
            s[0] = np.where(rng.random(n) < 0.7, np.maximum(pressed, 0), np.maximum(lifted, 0))
            s[0] = np.maximum(s[0], pressed)
            e[0] = s[0] * rng.choice([1, -1, 0.3], n)
        else:  # without dashpot, force follows from the state: within the cone, and none in flight
            arms = moduli[1:] @ s[1:]
            s[1:] *= np.where(pressed + arms < 0, np.maximum(pressed, 0) / np.maximum(-arms, 1e-300), 1.0)
            force = np.maximum(pressed, 0) + moduli[1:] @ s[1:]
            touches = (pressed > 0) & (force > 1e-9)
            s = np.where(touches, np.vstack([pressed, s[1:]]), s - (moduli @ s) / moduli.sum())
            off = ~touches & (s[0] < pressed)
            s[:, off] = 0.0
            gap = np.where(off, path.z_0 + 0.1 * h, gap)
            share = np.where(touches, force * rng.choice([1, -1, 1 - h**2, 0.3], n), 0.0)
            e += (share - moduli @ e) / moduli.sum()
        return cls(material, path, h, gap, s, e, rng.uniform(0.5, 1, n) / n)

    @classmethod
    def beside(cls, rows):
        """All springs of some rows in one, for by_tiny_steps alone: each has the parabola of its row."""
        n = [one.gap.size for one in rows]
        path = Path(*(np.repeat(of_rows, n) for of_rows in zip(*(one.path for one in rows), strict=True)))
        springs = (np.concatenate([getattr(one, name) for one in rows], axis=-1) for name in ("gap", "s", "e", "w"))
        return cls(rows[0].material, path, rows[0].h, *springs)

    def mirrored(self):
        """The same with the pull the other way round."""
        return replace(self, path=self.path._replace(x_1=-self.path.x_1, x_2=-self.path.x_2), e=-self.e)

    def at(self, t):
        """Depth and way of the top."""
        p = self.path
        return p.z_0 + t * (p.z_1 + t * p.z_2), t * (p.x_1 + t * p.x_2)

    def from_then(self, t):
        """Its parabola, seen from a time in it."""
        p = self.path
        return Path(self.at(t)[0], p.z_1 + 2 * t * p.z_2, p.z_2, p.x_1 + 2 * t * p.x_2, p.x_2)

    def stepped(self, parts=1, look=None):
        """e, s, and of each spring area and moment of the tangential force, how long it stuck, and area and moment of
        the normal force, all at the end.
        """
        e, s, sums, h = self.e.copy(), self.s.copy(), np.zeros((5, self.gap.size)), self.h / parts
        tools, lumped, each = tools_for(self.law, h, 1), np.empty((s.shape[0], 1)), look and Each(*np.empty((3, 1)))
        for part in range(parts):
            path, last = self.from_then(part * h), self.from_then((part + 1) * h)
            for i in range(self.gap.size):
                one, two = np.ascontiguousarray(e[:, i : i + 1]), np.ascontiguousarray(s[:, i : i + 1])
                spring, rates = Springs(self.gap[i : i + 1], np.ones(1)), (last.z_1, last.x_1)
                of = row(two, one, spring, None, path, *rates, *self.law, tools, lumped, each, look and look[i])
                moments = of.moment + part * h * of.area, of.normal_moment + part * h * of.normal_area
                sums[:, i] += of.area, moments[0], of.stuck, of.normal_area, moments[1]
                e[:, i], s[:, i] = one[:, 0], two[:, 0]
        return e, s, *sums

    def looked_at(self):
        """The same with a close look at each spring."""
        looks = [self.look_at(1) for _ in self.gap]
        return self.stepped(look=looks), looks

    def look_at(self, n):
        """Room for a look at n springs."""
        look = Look(nodes_of(self.h, *self.law[1:]), np.zeros(N_SUMS), np.zeros(4), *np.zeros((3, n)))
        look.sums[LEAST_SLIP] = np.inf
        return look

    def at_once(self, rates=None, each=False):
        """All springs in one call: e, s, the answer, the lumped state, and, if asked for, what each spring does, for
        which all are followed from event to event. rates: other ones at the end than those of the parabolas.
        """
        e, s, end, n = self.e.copy(), self.s.copy(), self.from_then(self.h), self.gap.size
        tools, lumped = tools_for(self.law, self.h, n), np.full((s.shape[0], 1), np.nan)
        seen, look = (Each(*np.empty((3, n))), self.look_at(n)) if each else (None, None)
        rates = rates or (end.z_1, end.x_1)
        of = row(s, e, Springs(self.gap, self.w), None, self.path, *rates, *self.law, tools, lumped, seen, look)
        return e, s, of, lumped, seen

    def pressed(self):
        """Compressions, sums of area and moment, and for how long each has pressed, without friction."""
        s, each = self.s.copy(), Each(*np.empty((3, self.gap.size)))
        rate, tools = self.from_then(self.h).z_1, tools_for(self.law, self.h)
        of = press(s, Springs(self.gap, self.w), self.path, rate, *self.law, tools, each)
        return s, of.normal_area, of.normal_moment, each.pressed_for

    def by_tiny_steps(self, n, limit=1.0, turned=1.0, touch=0.0, dashpot=1.0):
        """e, s, area and moment of the force of each spring, and area of the normal force.

        In each of n steps of d the law is solved with backward differences. It is a + b dx, as arms fall to
        x_j/(1 + d/theta_j). So N = max(a + b ds, 0) with the way ds to the indenter, and F is the trial that sticks,
        clipped to N. Faults: the limit of friction times `limit`, slip in the wrong direction, a touch at a wrong
        depth, another dashpot along the pull.
        """
        T, rho, theta = self.material[0], np.array(self.material[1]), np.array(self.material[2])
        d, s, e = self.h / n, self.s.copy(), self.e.copy()
        fall = 1 / (1 + d / theta)
        stiff = 1 + rho @ fall
        area, moment, normal = np.zeros((3, self.gap.size))
        for k in range(n):
            (_, x_0), (z_1, x_1) = self.at(k * d), self.at((k + 1) * d)
            a, b = s[0] + (rho * fall) @ s[1:], stiff + T / d
            N = np.maximum(a + b * (z_1 - touch - self.gap - s[0]), 0)
            ds = (N - a) / b
            a, b = e[0] + (rho * fall) @ e[1:], stiff + dashpot * T / d
            trial = a + b * (x_1 - x_0)
            F = np.clip(trial, -limit * N, limit * N)
            F = np.where(np.abs(trial) > np.abs(F), turned * F, F)
            de = (F - a) / b
            for x, dx in ((s, ds), (e, de)):
                x[0] += dx
                x[1:] = (x[1:] + dx) * fall[:, None]
            area += d * F
            moment += d * (k + 0.5) * d * F
            normal += d * N
        return e, s, area, moment, normal
