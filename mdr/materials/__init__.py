"""Materials of the half-space: moduli, relaxation, damping. `Material` lists what a material must answer."""

from mdr.materials.base import Material
from mdr.materials.elastic import Elastic, ElasticPair
from mdr.materials.kelvin_voigt import KelvinVoigt
from mdr.materials.prony import Prony, StandardLinearSolid

__all__ = ["Elastic", "ElasticPair", "KelvinVoigt", "Material", "Prony", "StandardLinearSolid"]
