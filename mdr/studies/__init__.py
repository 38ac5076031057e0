"""Studies: grids of cases, computed in parallel, resumed after any end, and read back with named axes and units.

From `axes` (what varies) and `quantities` (what is computed) follows the `work` and its order; `points` computes it,
`engine` deals it out in chunks, `store` keeps these, `study` is what comes out, and `formats` and
`unpack` write and read its file.
"""

from mdr.studies.quantities import CATALOGUE, Quantity
from mdr.studies.store import StudyError, read_study
from mdr.studies.study import Study
from mdr.studies.sweep import sweep
from mdr.tools.status import Status

__all__ = ["CATALOGUE", "Quantity", "Status", "Study", "StudyError", "read_study", "sweep"]
