"""A shape and a law of friction, those of the guide, a material and a depth motion from outside the package, each
through the whole chain.
"""

import ast
import re
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr import plots
from mdr.case import friction, motion
from mdr.case.depth_cycle import Cycle
from mdr.files.own_records import _OWN

ROOT = Path(__file__).parents[1]
OMEGA = 300.0
KNOBS = {"n_springs": 32, "steps_per_period": 64}
GUIDE = (ROOT / "EXTENDING.md").read_text(encoding="utf-8")
CODE = re.findall(r"```python\n(.*?)```", GUIDE, re.DOTALL)
PAGE = {"__name__": "page"}
for code in CODE:
    if "class" in code:
        exec(code, PAGE)
Bump = PAGE["Bump"]  # near its tip a paraboloid of R = b²/2h
StickySpot = PAGE["StickySpot"]  # larger than the contact, it is a face with a shear strength


@dataclass(frozen=True)
class OwnMaterial(mdr.Material):
    """An incompressible standard solid, by its long-time modulus, its ratio of moduli and its time."""

    E: float
    ratio: float
    time: float

    @property
    def tau(self):
        return 0.0

    @property
    def E_star(self):
        return self.E / 0.75

    @property
    def G_star(self):
        return 2 / 3 * self.E_star

    @property
    def dundurs_beta(self):
        return 0.0

    @property
    def contact_arms(self):
        return ((self.ratio * self.E_star, self.time),)


@dataclass(frozen=True)
class OwnMotion(mdr.Motion):
    """u_z = u_z0 + du_z (cos omega t + share cos 2 omega t)."""

    u_z0: float
    du_z: float
    omega: float
    share: float

    @property
    def cycle(self):
        return Cycle.series(self.u_z0, self.omega, np.array([self.du_z, self.share * self.du_z]), np.zeros(2))


KNOWN = mdr.SlidingContact(
    mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, mdr.NormalOscillation(20e-6, 4e-6, OMEGA)
)
#: a part from outside, what of the library it must agree with, and by how much
OWN = {
    "shape": ({"indenter": Bump(h=1.0, b=0.1)}, {}, 1e-3),  # u_z0/h: beyond it, the bump levels out
    "material": (
        {"material": OwnMaterial(3e6, 0.5, 1e-3)},
        {"material": mdr.StandardLinearSolid(3e6, 1.5e6, 1e-3, 0.5)},
        1e-9,
    ),
    "law": ({"friction": StickySpot(0.5, 1e4, b=1.0)}, {"friction": mdr.ShearStrength(0.5, 1e4)}, 1e-12),
    "motion": (
        {"oscillation": OwnMotion(20e-6, 4e-6, OMEGA, 0.3)},
        {"oscillation": mdr.PeriodicMotion(OMEGA, 20e-6, (4e-6, 1.2e-6))},
        1e-12,
    ),
}


@pytest.fixture(params=OWN)
def part(request, monkeypatch):
    """A case with one part from outside, the like of it from the library, and how far they may be apart."""
    monkeypatch.setattr("mdr.files.own_records._OWN", dict(_OWN))
    own, like, apart = OWN[request.param]
    for record in own.values():
        assert mdr.register(type(record)) is type(record)
    return replace(KNOWN, **own), replace(KNOWN, **like), apart


def test_it_slides_and_has_its_critical_velocity(part):
    case, like, apart = part
    assert_allclose(mdr.critical_velocity(case), mdr.critical_velocity(like), rtol=apart)
    assert_allclose(mdr.full_slip_critical_velocity(case), mdr.full_slip_critical_velocity(like), rtol=apart)
    ours, theirs = (mdr.slide(one, 0.3 * like.unit_velocity, **KNOBS) for one in (case, like))
    assert ours.settled
    assert_allclose(ours.cof, theirs.cof, rtol=apart)


def test_a_case_file_brings_it_back(part, tmp_path):
    case, _, _ = part
    path = tmp_path / "case.toml"
    path.write_text(mdr.write_case(case), encoding="utf-8")
    assert mdr.read_case(path) == case


def test_a_study_varies_it(part, tmp_path):
    case, like, apart = part
    axes = {"v_0/v_c": [0.3, 0.8], "mu_0": [0.4, 0.5]}
    ours, theirs = (mdr.sweep(one, axes, quantities=["cof", "k_zc"], **KNOBS) for one in (case, like))
    assert ours.complete
    assert_allclose(ours["cof"], theirs["cof"], rtol=apart)
    ours.to_netcdf(tmp_path / "study.nc")
    assert mdr.read_study(tmp_path / "study.nc").case == mdr.write_case(case)


def test_figures_draw_it(part, tmp_path):
    case, _, _ = part
    curve = mdr.cof_curve(case, case.unit_velocity * np.array([0.0, 0.5, 1.1]), **KNOBS)
    curve.plot().figure.savefig(tmp_path / "curve.png")
    plots.plot_profile(case.indenter, 20e-6).savefig(tmp_path / "shape.png")
    mdr.slide(case, 1e-4, n_periods=2, record=1, **KNOBS).plot().savefig(tmp_path / "run.png")


def test_what_cannot_be_registered_is_refused():
    class Cone(mdr.Indenter):
        profile_1d = None

    for wrong in (Bump(1e-4, 2e-3), mdr.Indenter, mdr.RigidPull, Cone, dict):
        with pytest.raises(TypeError, match="record must be a dataclass"):
            mdr.register(wrong)
    with pytest.raises(ValueError, match="Cone is the name of another record"):
        mdr.register(dataclass(frozen=True)(Cone))


# --- the law, where a case goes ---

RIGID = replace(KNOWN, friction=StickySpot(0.5, 1e4, b=1.0))
BODY = replace(RIGID, pull=mdr.SpringPull(k_x=2e4, m=0.05, c_x=4.0))
#: what is asked of a case, and of the same case with the law of the library
ASKED = {
    "static": (RIGID, mdr.static_cof),
    "curve": (RIGID, lambda case: mdr.cof_curve(case, [1e-4, 3e-4], **KNOBS).cof),
    "measured": (
        replace(RIGID, material=mdr.KelvinVoigt(3e6, 0.5, 2e-3)),
        lambda case: mdr.measure_critical_velocity(case).v_c,
    ),
    "verdict": (BODY, lambda case: mdr.verdict(case).why),
    "along": (
        replace(BODY, shake=mdr.InPlaneOscillation(OMEGA, du_x=1e-6)),
        lambda case: mdr.slide(case, 1e-4, **KNOBS).cof,
    ),
    "across": (
        replace(RIGID, shake=mdr.InPlaneOscillation(OMEGA, du_y=1e-6)),
        lambda case: mdr.slide(case, 1e-4, **KNOBS).cof,
    ),
    "load": (
        replace(BODY, oscillation=mdr.LoadOscillation(0.1, 0.02, OMEGA)),
        lambda case: mdr.slide(case, 1e-4, **KNOBS).cof,
    ),
    "half-space": (RIGID, lambda case: mdr.half_space.slide(case, 2e-4, cells=16, steps_per_period=16).cof),
    "record": (RIGID, lambda case: mdr.slide(case, 1e-4, record=1, **KNOBS).F_x),
    "found": (RIGID, lambda case: mdr.find(case, "tau_0", v_0=1e-4, cof=0.6, within=(1e3, 1e5)).values),
}


@pytest.mark.parametrize("what", ASKED)
def test_a_law_from_outside_is_asked_everywhere(what):
    case, asked = ASKED[what]
    ours, theirs = asked(case), asked(replace(case, friction=mdr.ShearStrength(0.5, 1e4)))
    if isinstance(ours, str):
        assert ours == theirs
    else:
        assert_allclose(ours, theirs, rtol=1e-9, atol=1e-12)


def test_a_law_stands_in_its_own_file():
    """How many files of mdr name a law."""
    naming = [path for path in (ROOT / "mdr").rglob("*.py") if "ShearStrength" in path.read_text(encoding="utf-8")]
    assert len(naming) <= 4  # with the closed forms that a strength has, and the words of their domain


# --- the guide ---


def test_its_examples_hold(monkeypatch):
    monkeypatch.setattr("mdr.files.own_records._OWN", dict(_OWN))
    page = {"__name__": "page"}
    for code in CODE:
        exec(code, page)


SECTIONS = {text.partition("\n")[0]: text for text in GUIDE.split("\n## ")[1:]}
LISTS = {"A shape": mdr.indenters, "A material": mdr.materials, "A law of friction": friction, "A motion": motion}


def _names_in(path):
    """The names that the code of a file has, or all words of a page."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".md":
        return set(re.findall(r"\w+", text))
    tree = list(ast.walk(ast.parse(text)))
    named = [getattr(node, name, None) for node in tree for name in ("id", "attr", "name", "value")]
    return {one for one in named if isinstance(one, str)}


def test_a_motion_of_ones_own_that_never_touches_is_refused():
    motion = OwnMotion(-20e-6, 4e-6, OMEGA, 0.3)
    with pytest.raises(ValueError, match=r"never touches: the greatest depth of OwnMotion is -1\.48e-05 m"):
        replace(KNOWN, oscillation=motion)


@pytest.mark.parametrize("section", LISTS)
def test_the_guide_names_every_file_that_a_new_part_touches(section):
    """A file of the package or of the reference that names every shape, material or motion is a list to be edited."""
    base = {"A shape": "Indenter", "A material": "Material", "A law of friction": "Friction", "A motion": "Motion"}[
        section
    ]
    functions = {"Profile"}  # holds a function, which no example can
    names = set(LISTS[section].__all__) - {base} - functions
    lists = {
        str(path.relative_to(ROOT))
        for folder in ("mdr", "docs/api")
        for path in (ROOT / folder).rglob("*.*")
        if path.suffix in (".py", ".md") and names <= _names_in(path)
    }
    named = set(re.findall(r"`((?:mdr|docs)/[\w/.]+)`", SECTIONS[section]))
    assert lists <= named


def test_the_worked_examples_are_typed(tmp_path):
    api = pytest.importorskip("mypy.api")
    page = tmp_path / "page.py"
    page.write_text("\n\n".join(CODE), encoding="utf-8")
    # options and cache of `mypy` itself: what it has read of the package need not be read again
    options = ["--strict", "--config-file", str(ROOT / "pyproject.toml"), "--cache-dir", str(ROOT / ".mypy_cache")]
    limit = sys.getrecursionlimit()
    told, failed, status = api.run([*options, str(page)])
    sys.setrecursionlimit(limit)  # which mypy raises for the whole process
    assert status == 0, told + failed
