"""What all tests share: the shapes, a contact by its dimensionless groups, and the profile of hypothesis."""

import math
import os
import sys
from dataclasses import dataclass, replace
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: processes share the cores, and threads would wait
os.environ.setdefault("MDR_COMPILE", "first")  # what is compared to the last bit is machine code

import matplotlib as mpl
import numpy as np
import pytest
from hypothesis import settings

import mdr

mpl.use("Agg")
settings.register_profile("mdr", deadline=None, derandomize=True, database=None)
settings.load_profile("mdr")

#: files begun first, so that none is alone at the end
LONGEST = (
    "guide/test_docs.py",
    "explorer/test_browser.py",
    "guide/test_geometries.py",
    "march/test_shaken_runs.py",
    "studies/test_sweep.py",
    "tools/test_jit.py",
)
assert all((Path(__file__).parent / name).exists() for name in LONGEST)

#: indenter and the exponent n of its profile g ~ x**n, as the twin in rigid_pull.py counts shapes
SHAPES = {
    "flat": (mdr.FlatPunch(a=1e-3), math.inf),
    "cone": (mdr.Cone(theta=0.02), 1),
    "paraboloid": (mdr.Paraboloid(R=5e-3), 2),
    "r4": (mdr.PowerLaw(n=4, c=2e3), 4),
}


@dataclass(frozen=True)
class Spot(mdr.Friction):
    """A law of one's own: a strength in the middle alone, within the radius b."""

    mu_0: float
    tau_0: float
    b: float

    def strong_radius(self, a):
        return np.minimum(a, self.b)

    @property
    def kinks(self):
        return (self.b,)


@pytest.fixture(autouse=True)
def no_figure_outlives_its_test():
    yield
    if pyplot := sys.modules.get("matplotlib.pyplot"):
        pyplot.close("all")


def pytest_collection_modifyitems(items):
    items.sort(key=lambda item: not item.path.as_posix().endswith(LONGEST))


def bowl(r):
    """A hyperboloid, written without cancellation; its g is (h x/c) arctan(x/c) with h = c = 1 mm."""
    return 1e-3 * (r / 1e-3) ** 2 / (np.sqrt(1 + (r / 1e-3) ** 2) + 1)


def contact(
    shape,
    depth_ratio=3.0,
    T=0.0,
    k_ratio=math.inf,
    omega_0_ratio=1.6,
    c_ratio=0.0,
    *,
    du_z=2e-6,
    omega=300.0,
    mu_0=0.4,
    nu=0.4,
    E=3e6,
):
    """A contact in SI from the groups of the twin; shape is a name or an indenter.

    k_ratio = inf is a rigid pull, omega_0_ratio = inf a body without mass.
    """
    indenter = SHAPES[shape][0] if isinstance(shape, str) else shape
    material = mdr.KelvinVoigt(E=E, nu=nu, tau=T / omega) if T else mdr.Elastic(E=E, nu=nu)
    u_z0 = depth_ratio * du_z
    pull = mdr.RigidPull()
    if math.isfinite(k_ratio):
        k_xc = float(indenter.stiffness(u_z0, material.G_star))
        k_x = k_ratio * k_xc
        pull = mdr.SpringPull(k_x=k_x, m=k_x / (omega_0_ratio * omega) ** 2, c_x=c_ratio * k_xc / omega)
    return mdr.SlidingContact(indenter, material, mu_0, mdr.NormalOscillation(u_z0, du_z, omega), pull)


def unit_of_velocity(case):
    """Eq. (1) written out: what the twin measures velocities in."""
    nu = case.material.nu
    return case.mu_0 * (2 - nu) / (2 * (1 - nu)) * case.oscillation.omega * case.oscillation.du_z


def by_groups(shape, nu, T, alpha, ratio, k, zeta=0.0, load=None):
    """A body by its groups: omega_0/omega, k_x/k_xc, damping ratio; load: dF_z/F_z0."""
    case = contact(shape, 1 / alpha, T, k, ratio, 2 * zeta * k / ratio, nu=nu)
    if load is None:
        return case
    F_z0 = float(case.indenter.force(case.oscillation.u_z0, case.material.E_star))
    return replace(case, oscillation=mdr.LoadOscillation(F_z0, load * F_z0, case.omega))
