"""The catalogue of indenters; every shape answers the same questions, see base.py."""

from mdr.indenters.base import Indenter
from mdr.indenters.cone import Cone
from mdr.indenters.flat_punch import FlatPunch
from mdr.indenters.paraboloid import Paraboloid
from mdr.indenters.power_law import PowerLaw
from mdr.indenters.profile import Profile

__all__ = ["Cone", "FlatPunch", "Indenter", "Paraboloid", "PowerLaw", "Profile"]
