"""mdr: sliding friction of axisymmetric contacts under vibration, spring by spring.

The names below stand in the order of the chain: from an indenter and a material, through springs, motion and pull, to
a sliding contact; from there to closed forms, runs, curves and the verdict on the closed-form critical velocity.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from mdr.indenters import *
from mdr.materials import *
from mdr.case.displacement import displacement_of
from mdr.case.friction import *
from mdr.case.motion import *
from mdr.case.in_plane import *
from mdr.case.pull import RigidPull, SpringPull
from mdr.case.spectrum import Spectrum
from mdr.case.contact import SlidingContact
from mdr.tools.keywords import NoSuch
from mdr.tools.warned import PlausibilityWarning

from mdr.files.case_files import write_case
from mdr.files.toml_text import CaseFileError
from mdr.files.force_curves import read_force_curve
from mdr.files.measurements import read_moduli
from mdr.files.recorded_motion import read_record
from mdr.files.step_tests import read_creep, read_relaxation
from mdr.files.own_records import register
from mdr.spring.contact_modes import State
from mdr.friction.friction_data import FrictionData, read_friction_data

from mdr import indenters, materials
from mdr.case import waveforms
from mdr.case import friction as _friction
from mdr.case import in_plane as _in_plane
from mdr.case import motion as _motion

from mdr.tools.version import __version__ as __version__

if TYPE_CHECKING:
    from mdr import half_space
    from mdr.normal.load_control import static_depth, static_load
    from mdr.normal.resolved import plausibility, resolved
    from mdr.normal.springs import SpringArray
    from mdr.normal.indentation import indent
    from mdr.normal.partial_slip import partial_slip, tangential_loop
    from mdr.given.rig import rig
    from mdr.given.case_file import parse_case, read_case
    from mdr.closed_forms import laws
    from mdr.closed_forms.critical_velocity import critical_velocity
    from mdr.closed_forms.full_slip import static_cof
    from mdr.closed_forms.full_slip_body import full_slip_critical_velocity
    from mdr.march.result.run import SlidingRun
    from mdr.march.result.slide import slide
    from mdr.march.result.slowest import least_velocity
    from mdr.element.contact_element import ContactElement
    from mdr.element.record import SlideRecord, slide_record
    from mdr.element.random_cof import RandomCof, random_cof
    from mdr.friction.surface_fields import surface_fields
    from mdr.friction.cof_curve import CofCurve, cof_curve
    from mdr.friction.shaken import blocked_cof, holding_band, no_load_velocity
    from mdr.friction.measured_velocity import measure_critical_velocity
    from mdr.friction.verdict import verdict
    from mdr.friction.fit import fit
    from mdr.friction.design import design
    from mdr.friction.find import find
    from mdr.friction.front import front
    from mdr.friction.sensitivity import sensitivity
    from mdr.friction.target import Target
    from mdr.friction.tolerance import tolerance
    from mdr.studies import Quantity, Study, read_study
    from mdr.studies.many import ManyCofs, slide_many
    from mdr.studies.propagate import propagate
    from mdr.studies.sweep import sweep

#: modules of the names above that bring numba, which takes half a second to import: they wait until one is asked for
_LATER = {
    "mdr.normal.load_control": ("static_depth", "static_load"),
    "mdr.normal.resolved": ("plausibility", "resolved"),
    "mdr.normal.springs": ("SpringArray",),
    "mdr.normal.indentation": ("indent",),
    "mdr.normal.partial_slip": ("partial_slip", "tangential_loop"),
    "mdr.given.rig": ("rig",),
    "mdr.given.case_file": ("parse_case", "read_case"),
    "mdr.closed_forms.laws": ("laws",),
    "mdr.closed_forms.critical_velocity": ("critical_velocity",),
    "mdr.closed_forms.full_slip": ("static_cof",),
    "mdr.closed_forms.full_slip_body": ("full_slip_critical_velocity",),
    "mdr.march.result.run": ("SlidingRun",),
    "mdr.march.result.slide": ("slide",),
    "mdr.march.result.slowest": ("least_velocity",),
    "mdr.element.contact_element": ("ContactElement",),
    "mdr.element.record": ("SlideRecord", "slide_record"),
    "mdr.element.random_cof": ("RandomCof", "random_cof"),
    "mdr.half_space": ("half_space",),
    "mdr.friction.surface_fields": ("surface_fields",),
    "mdr.friction.cof_curve": ("CofCurve", "cof_curve"),
    "mdr.friction.shaken": ("blocked_cof", "holding_band", "no_load_velocity"),
    "mdr.friction.measured_velocity": ("measure_critical_velocity",),
    "mdr.friction.verdict": ("verdict",),
    "mdr.friction.fit": ("fit",),
    "mdr.friction.design": ("design",),
    "mdr.friction.find": ("find",),
    "mdr.friction.front": ("front",),
    "mdr.friction.sensitivity": ("sensitivity",),
    "mdr.friction.target": ("Target",),
    "mdr.friction.tolerance": ("tolerance",),
    "mdr.studies": ("studies", "Quantity", "Study", "read_study"),
    "mdr.studies.sweep": ("sweep",),
    "mdr.studies.many": ("ManyCofs", "slide_many"),
    "mdr.studies.propagate": ("propagate",),
}

__all__ = [
    "CaseFileError", "CofCurve", "ContactElement", "FrictionData", "ManyCofs", "PlausibilityWarning", "Quantity",
    "RandomCof", "RigidPull", "SlideRecord", "SlidingContact", "SlidingRun", "Spectrum", "SpringArray", "SpringPull",
    "State", "Study", "Target", "blocked_cof", "cof_curve", "critical_velocity", "design", "displacement_of", "find",
    "fit", "front", "full_slip_critical_velocity", "half_space", "holding_band", "indent", "laws", "least_velocity",
    "measure_critical_velocity", "no_load_velocity", "parse_case", "partial_slip", "plausibility", "propagate",
    "random_cof", "read_case", "read_creep", "read_force_curve", "read_friction_data", "read_moduli", "read_record",
    "read_relaxation", "read_study", "register", "resolved", "rig", "sensitivity", "slide", "slide_many",
    "slide_record", "static_cof", "static_depth", "static_load", "surface_fields", "sweep", "tangential_loop",
    "tolerance", "verdict", "waveforms", "write_case",
]  # fmt: skip
__all__ += indenters.__all__  # shapes, materials, laws of friction and motions are listed where they stand
__all__ += materials.__all__
__all__ += _friction.__all__
__all__ += _motion.__all__
__all__ += _in_plane.__all__


if not TYPE_CHECKING:  # what is not there, a checker of types says

    def __getattr__(name: str) -> Any:
        for home, names in _LATER.items():
            if name in names:
                module = import_module(home)
                globals()[name] = found = getattr(module, name, module)  # or the module itself
                return found
        raise NoSuch(f"module {__name__!r}", name, __dir__)


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
