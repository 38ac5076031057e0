"""The closed forms of the catalogue, with the slope of each written from its f(r); other shapes by their example."""

import math

import numpy as np

import mdr
from mdr.files.examples import SHAPES as EXAMPLES

B, R, THETA = 1e-3, 5e-3, 0.05
T = math.tan(THETA)
A_0, D_0 = 3e-3, 2e-4
NODES, WEIGHTS = np.polynomial.legendre.leggauss(200)
SINE, MEAN = np.sin(np.pi / 4 * (NODES + 1)) ** 2, WEIGHTS / 2


def beyond(a, b, t):
    """a cos t - b without cancellation, for t up to arccos(b/a)."""
    phi = math.atan2(math.sqrt((a - b) * (a + b)), b)
    return 2 * a * np.sin((phi + t) / 2) * np.sin((phi - t) / 2)


def round_slope(r):
    """That of a ball."""
    return r / np.sqrt((R - r) * (R + r))


def elliptic_slope(u):
    """(2/pi) (K - E)/u as a mean of positive terms; K and E of modulus u."""
    return u * np.sum(MEAN * SINE / np.sqrt(1 - u[:, None] ** 2 * SINE), axis=1)


#: f' at r = a cos t, outside the kink where there is one, and inside it
SLOPES = {
    mdr.Cone(THETA): (lambda a, t: T + 0 * t, None),
    mdr.Paraboloid(R): (lambda a, t: a * np.cos(t) / R, None),
    mdr.PowerLaw(1.5, 2.0): (lambda a, t: 3 * np.sqrt(a * np.cos(t)), None),
    mdr.PowerLaw(4, 1e6): (lambda a, t: 4e6 * (a * np.cos(t)) ** 3, None),
    mdr.Sphere(R): (lambda a, t: round_slope(a * np.cos(t)), None),
    mdr.Ellipsoid(2 * R, 1 / R): (lambda a, t: 2 * round_slope(a * np.cos(t)), None),
    mdr.Hyperboloid(1e-3, 2e-3): (lambda a, t: a * np.cos(t) / 4e-3 / np.hypot(1, a * np.cos(t) / 2e-3), None),
    mdr.ConstantPressure(A_0, D_0): (lambda a, t: D_0 / A_0 * elliptic_slope(a * np.cos(t) / A_0), None),
    mdr.TruncatedCone(B, THETA): (lambda a, t: T + 0 * t, lambda a, t: 0 * t),
    mdr.TruncatedParaboloid(B, R): (lambda a, t: a * np.cos(t) / R, lambda a, t: 0 * t),
    mdr.RoundedPunch(B, R): (lambda a, t: beyond(a, B, t) / R, lambda a, t: 0 * t),
    mdr.CappedCone(B, THETA): (lambda a, t: T + 0 * t, lambda a, t: a * np.cos(t) / B * T),
    mdr.CappedParaboloid(8e-3, R, B): (lambda a, t: a * np.cos(t) / R, lambda a, t: a * np.cos(t) / 8e-3),
}


def end(shape):
    """Greatest radius asked for: near the end of a shape its formulas hold, but their argument has no digits left."""
    return min(0.9 * shape.max_radius, 1e3)


KINKED = [shape for shape in SLOPES if shape.kinks]
WORN = [shape for shape in KINKED if shape.profile_1d(B) == 0]  # with a flat face
FACES = [mdr.FlatPunch(2e-3), mdr.ConcavePunch(2e-3, 1.0)]
MEASURED = (mdr.FromForce, mdr.SampledProfile)
#: what this file does not know
NEW = [one for one in EXAMPLES.values() if not isinstance(one, (*map(type, (*SLOPES, *FACES)), *MEASURED))]
CURVED = [*SLOPES, *(shape for shape in NEW if not shape.least_depth and shape.profile_1d(end(shape) / 2) > 0)]
SHAPES = [*FACES, *SLOPES, *NEW]
ANY = [*SHAPES, *(one for one in EXAMPLES.values() if isinstance(one, MEASURED))]


def name(shape):
    return repr(shape)[:30]


def depths(shape, low=1e-12, high=1e3, n=40):
    """Depths at which the shape has a full disc, over many decades; a new one, whose forms may cancel, over some."""
    low = max(low, 1e-7) if shape in NEW else low
    highest = min(high, float(shape.profile_1d(end(shape)))) if shape in CURVED else high
    return np.geomspace(max(low, 2 * shape.least_depth), highest, n)
