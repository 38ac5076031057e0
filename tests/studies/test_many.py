"""A list of contacts, each at its own velocity: the numbers of its curves, and a word for each that has none."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import mdr
from mdr.files.examples import example

BODY, RIGID = example(), example(pull="RigidPull")
ACROSS = replace(example(pull="RigidPull", material="Elastic"), shake=mdr.InPlaneOscillation(omega=314.159, du_y=1e-6))
LISTED = [BODY, replace(BODY, mu_0=0.2), RIGID, ACROSS]
V_0 = np.array([1e-4, 2e-4, 1.5e-4, 1e-4])


def test_each_has_the_numbers_of_its_own_curve():
    found = mdr.slide_many(LISTED, V_0, accuracy=1e-3)
    curves = [mdr.cof_curve(case, [v], accuracy=1e-3) for case, v in zip(LISTED, V_0, strict=True)]
    for name in ("cof", "cof_error", "stick_share"):
        assert_array_equal(getattr(found, name), [getattr(one, name)[0] for one in curves])
    assert_array_equal(found.cof_y[:3], 0.0)
    assert found.cof_y[3] == curves[3].cof_y[0]
    assert found.settled.all()
    assert found.table().splitlines()[0] == "v_0 [m/s],cof [-],cof_y [-],cof_error [-],stick_share [-],status,why"


def test_one_stands_for_all():
    of_one_case = mdr.slide_many(RIGID, V_0)
    assert_array_equal(of_one_case.cof, mdr.slide_many([RIGID] * 4, V_0).cof)
    assert_array_equal(mdr.slide_many([RIGID, RIGID], 2e-4).cof, of_one_case.cof[[1, 1]])


def test_one_that_has_no_answer_leaves_the_others_theirs():
    found = mdr.slide_many(RIGID, [1e-4, -1e-4, 0.0])
    assert_array_equal(found.status, [mdr.studies.Status.DONE, mdr.studies.Status.FAILED, mdr.studies.Status.DONE])
    assert_array_equal(np.isfinite(found.cof), [True, False, True])
    assert "must not be negative" in found.why[1]
    assert "settled    2 of 3" in str(found)
    assert found.cof[2] == mdr.static_cof(RIGID)


@pytest.mark.parametrize(
    ("cases", "v_0", "error", "words"),
    [
        (3, 1e-4, TypeError, "SlidingContact records, got 3"),
        ([RIGID, "a"], 1e-4, TypeError, "SlidingContact records, got 'a'"),
        ([], 1e-4, ValueError, "got 0 and 1"),
        ([RIGID] * 2, [1e-4] * 3, ValueError, "got 2 and 3"),
        (RIGID, [np.nan], ValueError, "must be finite"),
        (RIGID, [[1e-4]], ValueError, "must be a list"),
    ],
)
def test_what_is_no_list_is_refused(cases, v_0, error, words):
    with pytest.raises(error, match=words):
        mdr.slide_many(cases, v_0)
