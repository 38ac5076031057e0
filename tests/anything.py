"""Any record that the public API takes, drawn by a dice: of numbers at random, or of what hypothesis chooses.

Sizes range over what SI knows: lengths from nanometres to metres, frequencies from a millihertz to a gigahertz, moduli
from a pascal to a terapascal. Most contacts are drawn by their dimensionless groups, so that they slide; of some every
number is drawn for itself, and what they say is mostly why they do not.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

import mdr

WILD = 0.15  #: share of contacts whose numbers know nothing of each other


class Dice:
    """What chance decides."""

    def __init__(self, seed):
        self.rng = np.random.default_rng(seed)

    def share(self):
        """A number from 0 to 1."""
        return float(self.rng.random())

    def below(self, n):
        """A whole number from 0 to n - 1."""
        return int(self.rng.integers(n))

    def between(self, low, high):
        return low + (high - low) * self.share()

    def size(self, low, high):
        """A number of any magnitude between two."""
        return min(max(low * (high / low) ** self.share(), low), high)

    def one_of(self, some):
        return some[self.below(len(some))]

    def happens(self, chance):
        return self.below(1000) < 1000 * chance


class Chosen(Dice):
    """The same, chosen by hypothesis."""

    def __init__(self, draw):
        self.draw = draw

    def share(self):
        from hypothesis import strategies as st

        return self.draw(st.floats(0, 1))

    def below(self, n):
        from hypothesis import strategies as st

        return self.draw(st.integers(0, n - 1))


# --- functions that a Profile may hold ---


@dataclass(frozen=True)
class Power:
    """c unit [(r/unit)^n - (b/unit)^n], beginning at b."""

    c: float
    n: float
    b: float = 0.0
    unit: float = 1.0

    def __call__(self, r):
        u = np.maximum(np.abs(r), self.b) / self.unit
        return self.c * self.unit * (u**self.n - (self.b / self.unit) ** self.n)

    def in_units(self, length):
        return Power(self.c, self.n, self.b * length, self.unit * length)


@dataclass(frozen=True)
class Bowl:
    """A hyperboloid, without cancellation."""

    h: float
    c: float

    def __call__(self, r):
        u = np.asarray(r) / self.c
        return self.h * u**2 / (np.sqrt(1 + u**2) + 1)

    def in_units(self, length):
        return Bowl(self.h * length, self.c * length)


# --- shapes ---


def power_law(dice, a, s):
    """g(a) = s a."""
    n = dice.one_of([0.5, 1.0, 1.5, 2.0, 4.0, dice.size(0.1, 30.0)])
    kappa = math.exp(0.5 * math.log(math.pi) + math.lgamma(n / 2 + 1) - math.lgamma((n + 1) / 2))
    return mdr.PowerLaw(n=n, c=s * a / (kappa * a**n))


def sampled(dice, a, s):
    """Points of a power, or of a worn one, to somewhat beyond a."""
    n, n_points = dice.one_of([1.0, 2.0, 3.0, 4.0]), 6 + dice.below(40)
    end, sharp = a * dice.between(1.1, 4.0), n in (1.0, 3.0) or dice.happens(0.3)
    r = end * np.linspace(0, 1, n_points) ** dice.one_of([1.0, 1.0, 1.5])
    f = s * a * (r / a) ** n
    kinks = ()
    if n_points > 20 and dice.happens(0.3):
        b = r[n_points // 2]
        f, kinks = f + s * np.maximum(r - b, 0), (b,)
    return mdr.SampledProfile(r, f, tip="sharp" if sharp else "round", kinks=kinks)


def from_force(dice, a, s):
    """Forces of a power or of a sum of two, to somewhat beyond the depth s a."""
    powers = dice.one_of([(1.0,), (1.5,), (2.0,), (1.0, 2.0), (1.5, 2.0), (dice.between(1.0, 3.0),)])
    d = s * a * dice.between(1.1, 4.0) * np.linspace(0, 1, 8 + dice.below(30))
    E_star = dice.size(1.0, 1e12)
    F = sum(E_star * s * a * a * (d / (s * a)) ** n for n in powers)
    tip = {(1.0,): "flat", (1.5,): "round", (2.0,): "sharp"}.get(powers, "any")
    return mdr.FromForce(d, F, E_star, tip=dice.one_of(["any", tip]))


def profile(dice, a, s):
    """A function of one's own."""
    kind = dice.below(4)
    name = dice.one_of([None, "mine"])
    if kind == 0:
        return mdr.Profile(Bowl(s * a, a * dice.size(0.1, 10.0)), name=name)
    n = dice.one_of([1.0, 1.5, 2.0, 3.0, 4.0])
    if kind == 1:
        return mdr.Profile(Power(s, n, unit=a), r_max=a * dice.between(1.0, 5.0), name=name)
    if kind == 2:
        b = a * dice.between(0.1, 0.9)
        return mdr.Profile(Power(s, n, b, unit=a), kinks=(b,), name=name)
    return mdr.Profile(Power(s, n, unit=a), name=name)


#: by a radius a and a slope s of the size that the contact is to have
SHAPES = {
    "FlatPunch": lambda dice, a, s: mdr.FlatPunch(a=a),
    "Cone": lambda dice, a, s: mdr.Cone(theta=math.atan(s)),
    "Paraboloid": lambda dice, a, s: mdr.Paraboloid(R=a / s),
    "PowerLaw": power_law,
    "Sphere": lambda dice, a, s: mdr.Sphere(R=a * dice.size(1.0001, 1e6)),
    "Ellipsoid": lambda dice, a, s: mdr.Ellipsoid(R=s * a, k=1 / (a * dice.size(1.0001, 1e3))),
    "Hyperboloid": lambda dice, a, s: mdr.Hyperboloid(h=s * a, c=a * dice.size(1e-3, 1e3)),
    "TruncatedCone": lambda dice, a, s: mdr.TruncatedCone(b=a * dice.size(1e-3, 2.0), theta=math.atan(s)),
    "TruncatedParaboloid": lambda dice, a, s: mdr.TruncatedParaboloid(b=a * dice.size(1e-3, 2.0), R=a / s),
    "RoundedPunch": lambda dice, a, s: mdr.RoundedPunch(b=a * dice.size(1e-3, 2.0), R=a / s),
    "CappedCone": lambda dice, a, s: mdr.CappedCone(b=a * dice.size(1e-3, 2.0), theta=math.atan(s)),
    "CappedParaboloid": lambda dice, a, s: mdr.CappedParaboloid(
        R1=a / s * dice.size(1.0, 1e3), R2=a / s, b=a * dice.size(1e-3, 2.0)
    ),
    "ConstantPressure": lambda dice, a, s: mdr.ConstantPressure(a_0=a * dice.size(1.0, 1e3), d_0=s * a),
    "ConcavePunch": lambda dice, a, s: mdr.ConcavePunch(a=a, R=a / s),
    "SampledProfile": sampled,
    "FromForce": from_force,
    "Profile": profile,
}


def indenter(dice):
    """A shape, a radius of contact on it and the depth that belongs to it."""
    kind = dice.one_of(list(SHAPES))
    a, s = dice.size(1e-9, 1.0), dice.size(1e-8, 1.0)
    shape = SHAPES[kind](dice, a, s)
    if kind == "ConcavePunch":
        return shape, a, shape.least_depth * (1 + dice.size(1e-6, 1e3))
    if kind == "FromForce":
        d = s * a
        return shape, float(shape.contact_radius(d)), d
    d = float(shape.profile_1d(min(a, shape.max_radius)))
    return shape, a, d if d > 0 else s * a


# --- the other parts ---


def poisson_ratio(dice):
    return dice.one_of([0.5, 0.5, 0.3, 0.0, -0.99, dice.between(-0.999, 0.5)])


def arms(dice, E, omega):
    """Maxwell arms; some of one time, of no modulus, or far too fast."""
    some = []
    for _ in range(dice.below(5)):
        E_j = 0.0 if dice.happens(0.05) else E * dice.size(1e-4, 1e4)
        tau_j = some[-1][1] if some and dice.happens(0.1) else dice.size(1e-6, 1e6) / omega
        some.append((E_j, tau_j))
    return tuple(some)


def material(dice, omega, flows=False):
    """A half-space; with flows=True one whose long-time modulus may be zero."""
    E, nu = dice.size(1.0, 1e12), poisson_ratio(dice)
    tau = 0.0 if dice.happens(0.1) else dice.size(1e-6, 1e6 if dice.happens(0.3) else 10.0) / omega
    E_inf = 0.0 if flows and dice.happens(0.5) else E
    E_1 = E * dice.size(1e-6, 1e4) if E_inf == 0 or not dice.happens(0.05) else 0.0
    kind = dice.below(5)
    if kind == 0:
        return mdr.Elastic(E=E, nu=nu)
    if kind == 1:
        return mdr.ElasticPair(E_1=E, nu_1=nu, E_2=dice.size(1.0, 1e12), nu_2=poisson_ratio(dice))
    if kind == 2:
        return mdr.KelvinVoigt(E=E, nu=nu, tau=tau)
    if kind == 3:
        return mdr.StandardLinearSolid(E_inf=E_inf, E_1=E_1, tau_1=dice.size(1e-6, 1e6) / omega, nu=nu)
    some = arms(dice, E, omega)
    if E_inf == 0:
        return mdr.Prony(E_inf=0.0, arms=(*some, (E, dice.size(1e-6, 1e6) / omega)), nu=nu)
    return mdr.Prony(E_inf=E_inf, arms=some, nu=nu, tau=tau if dice.happens(0.3) else 0.0)


def depths(dice, d):
    """Mean depth and amplitude: at rest at d, pressed to d at most, or tapping."""
    how = dice.below(4)
    if how == 0:
        alpha = dice.size(1e-9, 1.0)
        return d, alpha * d
    if how == 1:
        alpha = dice.size(1e-3, 1e3)
        return d / (1 + alpha), alpha * d / (1 + alpha)
    if how == 2:
        return 0.0, d
    touch = dice.size(1e-9, 1.0)  # share of the amplitude by which it dips in
    return -(1 - touch) / touch * d, d / touch


def oscillation(dice, shape, d, body, omega):
    """A normal motion of about the depth d."""
    kind = dice.below(10)
    u_z0, du_z = depths(dice, d)
    if kind <= 5:
        return mdr.NormalOscillation(u_z0=u_z0, du_z=du_z, omega=omega)
    if kind <= 8:
        n = 1 + dice.below(6)
        cos, sin = (tuple(du_z / n * dice.between(-1, 1) for _ in range(n)) for _ in range(2))
        return mdr.PeriodicMotion(omega=omega, u_z0=u_z0, cos=cos, sin=sin if dice.happens(0.5) else ())
    F_z0 = float(shape.force(d, body.E_star))
    m_z = 0.0
    if dice.happens(0.3):
        m_z = float(shape.stiffness(d, body.E_star)) / omega**2 * dice.size(1e-3, 1e3)
    dF_z = F_z0 * (dice.size(1e-6, 0.9999) if not m_z or dice.happens(0.5) else dice.size(1e-3, 10.0))
    return mdr.LoadOscillation(F_z0=F_z0, dF_z=dF_z, omega=omega, m_z=m_z)


def pull(dice, k_xc, omega):
    """What drags it: rigid, or a spring with or without mass and damper, on and off resonances."""
    if dice.happens(0.35):
        return mdr.RigidPull()
    k_x = k_xc * dice.size(1e-6, 1e6)
    ratio = dice.one_of([0.0, dice.size(1e-3, 1e3), dice.between(0.5, 3.0), 1.0, 2.0, 0.5])
    m = k_x / (ratio * omega) ** 2 if ratio else 0.0
    c_x = dice.one_of([0.0, k_x / omega * dice.size(1e-6, 1e3), 2 * math.sqrt(k_x * m) * dice.size(1e-4, 10.0)])
    return mdr.SpringPull(k_x=k_x, m=m, c_x=c_x)


def contact(dice):
    """A contact that slides, or the library's word why it cannot."""
    if dice.happens(WILD):
        return wild_contact(dice)
    omega = 2 * math.pi * dice.size(1e-3, 1e9)
    shape, a, d = indenter(dice)
    body = material(dice, omega, flows=dice.happens(0.02))
    moved = oscillation(dice, shape, d, body, omega) if body.E_star else mdr.NormalOscillation(d, d, omega)
    dragged = pull(dice, 2 * (body.G_star or 1.0) * a, omega)
    return mdr.SlidingContact(shape, body, dice.size(1e-6, 1e2), moved, dragged)


def wild_contact(dice):
    """A contact whose numbers know nothing of each other."""
    omega = 2 * math.pi * dice.size(1e-3, 1e9)
    shape = SHAPES[dice.one_of(list(SHAPES))](dice, dice.size(1e-9, 1.0), dice.size(1e-9, 1e3))
    body = material(dice, 2 * math.pi * dice.size(1e-3, 1e9))
    u_z0, du_z = dice.size(1e-9, 1.0) * dice.one_of([-1, 1, 1, 1]), dice.size(1e-9, 1.0)
    moved = dice.one_of(
        [
            lambda: mdr.NormalOscillation(u_z0, du_z, omega),
            lambda: mdr.PeriodicMotion(omega, u_z0, (0.0, du_z), (du_z,)),
            lambda: mdr.LoadOscillation(dice.size(1e-9, 1e6), dice.size(1e-9, 1e6), omega, dice.size(1e-12, 1e3)),
        ]
    )()
    dragged = dice.one_of(
        [
            mdr.RigidPull,
            lambda: mdr.SpringPull(dice.size(1e-6, 1e9)),
            lambda: mdr.SpringPull(dice.size(1e-6, 1e9), dice.size(1e-15, 1e6), dice.size(1e-9, 1e6)),
        ]
    )()
    return mdr.SlidingContact(shape, body, dice.size(1e-3, 1e1), moved, dragged)


# --- the same in other units ---


def in_units(case, length, time, force):
    """The case written in units so many times smaller: every length times `length`, and so on."""
    modulus, stiffness = force / length**2, force / length
    one = case.material
    if isinstance(one, mdr.ElasticPair):
        one = replace(one, E_1=one.E_1 * modulus, E_2=one.E_2 * modulus)
    elif isinstance(one, mdr.StandardLinearSolid):
        one = replace(one, E_inf=one.E_inf * modulus, E_1=one.E_1 * modulus, tau_1=one.tau_1 * time)
    elif isinstance(one, mdr.Prony):
        some = tuple((E_j * modulus, tau_j * time) for E_j, tau_j in one.arms)
        one = replace(one, E_inf=one.E_inf * modulus, arms=some, tau=one.tau * time)
    elif isinstance(one, mdr.KelvinVoigt):
        one = replace(one, E=one.E * modulus, tau=one.tau * time)
    else:
        one = replace(one, E=one.E * modulus)
    motion = case.oscillation
    if isinstance(motion, mdr.LoadOscillation):
        mass = force * time**2 / length
        motion = mdr.LoadOscillation(motion.F_z0 * force, motion.dF_z * force, motion.omega / time, motion.m_z * mass)
    elif isinstance(motion, mdr.PeriodicMotion):
        cos, sin = (tuple(value * length for value in values) for values in (motion.cos, motion.sin))
        motion = mdr.PeriodicMotion(motion.omega / time, motion.u_z0 * length, cos, sin)
    else:
        motion = mdr.NormalOscillation(motion.u_z0 * length, motion.du_z * length, motion.omega / time)
    dragged = case.pull
    if isinstance(dragged, mdr.SpringPull):
        mass = force * time**2 / length
        dragged = mdr.SpringPull(dragged.k_x * stiffness, dragged.m * mass, dragged.c_x * stiffness * time)
    shape = shape_in_units(case.indenter, length, force)
    return mdr.SlidingContact(shape, one, case.mu_0, motion, dragged)


def shape_in_units(shape, length, force):
    if isinstance(shape, mdr.PowerLaw):
        return mdr.PowerLaw(shape.n, shape.c * length ** (1 - shape.n))
    if isinstance(shape, mdr.Cone):
        return shape
    if isinstance(shape, mdr.Ellipsoid):
        return mdr.Ellipsoid(shape.R * length, shape.k / length)
    if isinstance(shape, mdr.SampledProfile):
        scaled = [tuple(value * length for value in values) for values in (shape.r, shape.f, shape.kinks)]
        return mdr.SampledProfile(scaled[0], scaled[1], tip=shape.tip, kinks=scaled[2])
    if isinstance(shape, mdr.FromForce):
        d, F = tuple(value * length for value in shape.d), tuple(value * force for value in shape.F)
        return mdr.FromForce(d, F, shape.E_star * force / length**2, tip=shape.tip)
    if isinstance(shape, mdr.Profile):
        f = shape.f.in_units(length)
        kinks, end = tuple(b * length for b in shape.kinks), shape.r_max
        return mdr.Profile(f, kinks=kinks, r_max=end and end * length, name=shape.name)
    numbers = {name: value if name == "theta" else value * length for name, value in vars(shape).items()}
    return replace(shape, **numbers)
