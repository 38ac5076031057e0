"""Shapes of indenters: f(r), g(x), a(d), F_N(d), k_zc(d) and p(r); `Indenter` says what one must answer."""

from mdr.indenters.base import Indenter
from mdr.indenters.cone import Cone
from mdr.indenters.flat_punch import FlatPunch
from mdr.indenters.paraboloid import Paraboloid
from mdr.indenters.power_law import PowerLaw
from mdr.indenters.profile import Profile

__all__ = ["Cone", "FlatPunch", "Indenter", "Paraboloid", "PowerLaw", "Profile"]
