"""One list of contacts, and what is asked of each: its independent twin, its energies, the order of the scheme, and
its mirror image. What has a closed form is asked for it in test_refinement.py.
"""

import numpy as np
import pytest
from conftest import contact
from contacts import ACROSS, ALONG, ARMS, CONTACTS, STILL
from numpy.testing import assert_allclose
from tables import turning

import mdr
from mdr.march.periodic.steady import Resolution
from mdr.march.result.slide import runs

every = pytest.mark.parametrize("name", CONTACTS)
#: the twin moves no body without mass, which test_sliding.py has beside a twin of its own
WITH_TWIN = [name for name in CONTACTS if name != "massless Kelvin"]


@pytest.mark.parametrize("name", WITH_TWIN)
def test_the_run_is_within_its_error_of_the_twin(name):
    shape, case, v_0 = CONTACTS[name]
    row = turning.row_of(name, shape, case, v_0, steps=4096 if case.pull.is_rigid else 8192, count=64)
    assert row.settled
    assert row.bound <= 1.0001e-5  # the accuracy budget of cof/mu_0 of a march with default knobs
    assert row.doubt < 1e-5
    assert row.error <= row.bound


def test_a_wrong_contact_is_seen():
    """The comparison can fail: a relaxation time wrong by one per cent is fifty budgets away."""
    case = contact("paraboloid", 3.0, 1.0)
    v_0, slower = 0.4 * case.unit_velocity, contact("paraboloid", 3.0, 1.01)
    known = turning.by_twin("paraboloid", slower, v_0, steps=4096)
    assert abs(mdr.slide(case, v_0).cof / case.mu_0 - known.along) > 50e-5


@every
def test_energy_is_conserved(name):
    """Each term from its own definition: exact under a rigid pull along a line. The path of a body within a step is
    taken for a cubic, and slip that turns within one is summed by Simpson's rule.
    """
    _, case, v_0 = CONTACTS[name]
    exact = case.pull.is_rigid and name not in ACROSS
    for steps in (64, 256):
        balance = mdr.slide(case, v_0, n_springs=64, steps_per_period=steps).energy_balance
        assert abs(balance.relative) < (1e-9 if exact else 1e-5 * (64 / steps) ** 2)
        assert balance.friction_loss > 0
        assert (balance.viscous_loss > 0) == (case.T > 0 or bool(getattr(case.material, "arms", ())))
        assert (balance.damper_loss > 0) == (not case.pull.is_rigid)
        assert (balance.shake_work != 0) == (case.shake is not None)


def errors(names, sizes, finest, velocities, knobs):
    """Of all these contacts at shares of their velocities, for each of some sizes: what the finest one changes.

    Single ones are erratic, as springs change their modes anywhere within a step.
    """
    squares = np.zeros(len(sizes))
    for name in names:
        _, case, v_0 = CONTACTS[name]
        for share in velocities:
            at = [Resolution(*knobs(size), "full_slip", lump=True, bounded=False) for size in (*sizes, finest)]
            ends = [next(runs(case, [share * v_0], one)) for one in at]
            cofs = np.array([(end.cof, end.settling.across) for end in ends])
            squares += np.sum((cofs[:-1] - cofs[-1]) ** 2, axis=1)
    return np.sqrt(squares)


def order(sizes, off):
    return -np.polynomial.polynomial.polyfit(np.log(sizes), np.log(off), 1)[1]


THREE = (0.9, 1.0, 1.1)  # shares of the velocity, which average out some of the scatter
GROUPS = {"still": (STILL, THREE), "arms": (ARMS, (1.0,)), "along": (ALONG, THREE), "across": (ACROSS, (1.0,))}


@pytest.mark.parametrize("group", GROUPS)
def test_the_scheme_is_of_third_order_in_the_step(group):
    """In the plane of second at least. A body without mass is thrown within steps: see test_sliding.py."""
    sizes, (contacts, velocities) = 64 * 2 ** np.arange(4), GROUPS[group]
    names = [name for name in contacts if name in WITH_TWIN]
    off = errors(names, sizes, 2048, velocities, lambda n: (32, n))
    assert order(sizes, off) > (1.9 if group == "across" else 2.5), off
    assert off[-1] < 3e-7


@pytest.mark.parametrize("group", ["still", "arms", "along"])
def test_it_is_of_second_order_in_the_springs(group):
    sizes, (contacts, velocities) = 32 * 2 ** np.arange(3), GROUPS[group]
    names = [name for name in contacts if name in WITH_TWIN and CONTACTS[name].shape != "flat"]
    off = errors(names, sizes, 1024, velocities, lambda n: (n, 64))
    assert order(sizes, off) > 1.9, off


@pytest.mark.parametrize("name", [*ALONG, *ACROSS])
def test_the_other_way_is_the_mirror_image(name):
    _, case, v_0 = CONTACTS[name]
    v_0, knobs = abs(v_0), {"n_springs": 48, "steps_per_period": 128, "record": 1}
    one, other = mdr.slide(case, -v_0, **knobs), mdr.slide(case.mirrored, v_0, **knobs)
    assert (one.cof, one.cof_y) == pytest.approx((-other.cof, other.cof_y), rel=1e-12, abs=1e-15)
    if name in ACROSS:
        return
    assert (one.cof, one.v_0, one.mean_F_x) == (-other.cof, -v_0, -other.mean_F_x)
    for mirrored, names in ((-1, ("u_x", "F_x", "e", "f_x")), (1, ("F_z", "s", "f_z", "u_z", "t"))):
        for record in names:
            assert_allclose(getattr(one, record), mirrored * getattr(other, record), rtol=0, atol=0)
    swapped = {mdr.State.SLIP: mdr.State.SLIP_BACK, mdr.State.SLIP_BACK: mdr.State.SLIP}
    for mode in mdr.State:
        assert np.array_equal(one.state == mode, other.state == swapped.get(mode, mode))
    assert one.energy_balance == other.energy_balance
