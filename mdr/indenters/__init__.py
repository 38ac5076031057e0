"""Shapes of indenters: f(r), g(x), a(d), F_N(d), k_zc(d) and p(r). `Indenter` lists what a shape must answer."""

from mdr.indenters.base import Indenter
from mdr.indenters.capped_cone import CappedCone
from mdr.indenters.capped_paraboloid import CappedParaboloid
from mdr.indenters.concave_punch import ConcavePunch
from mdr.indenters.cone import Cone
from mdr.indenters.constant_pressure import ConstantPressure
from mdr.indenters.ellipsoid import Ellipsoid
from mdr.indenters.flat_punch import FlatPunch
from mdr.indenters.from_force import FromForce
from mdr.indenters.hyperboloid import Hyperboloid
from mdr.indenters.paraboloid import Paraboloid
from mdr.indenters.power_law import PowerLaw
from mdr.indenters.profile import Profile
from mdr.indenters.rough_face import RoughFace
from mdr.indenters.rounded_punch import RoundedPunch
from mdr.indenters.sampled_profile import SampledProfile
from mdr.indenters.sphere import Sphere
from mdr.indenters.truncated_cone import TruncatedCone
from mdr.indenters.truncated_paraboloid import TruncatedParaboloid

__all__ = [
    "CappedCone", "CappedParaboloid", "ConcavePunch", "Cone", "ConstantPressure", "Ellipsoid", "FlatPunch", "FromForce",
    "Hyperboloid", "Indenter", "Paraboloid", "PowerLaw", "Profile", "RoughFace", "RoundedPunch", "SampledProfile",
    "Sphere", "TruncatedCone", "TruncatedParaboloid",
]  # fmt: skip
