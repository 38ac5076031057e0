"""Contact in three dimensions: a rigid indenter on an elastic or Kelvin half-space, with friction as a vector.

Knows no spring, so that it can judge them. influence.py: displacements under tractions on a grid of cells; normal.py,
tangential.py: pressure and tractions of a step; steps.py: one step after the other; friction.py: the COF of a case;
run.py: the same with its errors, as users ask for it.
"""

from mdr.half_space.normal import NotConverged
from mdr.half_space.run import HalfSpaceCurve, HalfSpaceRun, curve, slide

__all__ = ["HalfSpaceCurve", "HalfSpaceRun", "NotConverged", "curve", "slide"]
