"""Studies: grids of cases, computed in parallel, resumed after any end, and read back with named axes and units.

From `axes` (what varies) and `quantities` (what is computed) follow the `work` and its order, the `layout`; `points`
computes it, `cut` and `run` deal it out in chunks, `store` keeps these, and `study` is what comes out.
"""

from mdr.studies.points import Status
from mdr.studies.quantities import CATALOGUE, Quantity
from mdr.studies.read import read_study
from mdr.studies.store import StudyError
from mdr.studies.study import Study
from mdr.studies.sweep import sweep

__all__ = ["CATALOGUE", "Quantity", "Status", "Study", "StudyError", "read_study", "sweep"]
