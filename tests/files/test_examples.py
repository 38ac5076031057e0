"""Starting files: each is read back as the case it was written from, and is a case one can begin with."""

import itertools
import re

import pytest

import mdr
from mdr.files.case_files import nameable
from mdr.files.examples import MATERIALS, MOTIONS, PULLS, SHAKES, SHAPES, STILL, WAVEFORMS, example, example_file
from mdr.files.own_records import own_records


def test_there_is_an_example_of_every_record_that_a_file_can_name():
    own = own_records(object)  # what pages and scripts have registered
    known = {table: set(names) - set(own) for table, names in nameable().items()}
    assert set(SHAPES) == known["indenter"]
    assert set(MATERIALS) == known["material"]
    assert set(MOTIONS) - set(WAVEFORMS) == known["oscillation"]
    assert set(SHAKES) == known["shake"]


def test_every_example_reads_back():
    cycles = (itertools.cycle(each) for each in (MOTIONS, PULLS, (*SHAKES, STILL)))
    others = zip(*cycles, strict=False)  # tables are read one by one
    for pair in itertools.product(SHAPES, MATERIALS):
        names = (*pair, *next(others))
        case = example(*names)
        assert mdr.parse_case(example_file(case)) == case, names


@pytest.mark.parametrize("shape", SHAPES)
def test_every_shape_is_a_contact_of_a_millimetre_with_a_critical_velocity(shape):
    case = example(shape)
    a = float(case.indenter.contact_radius(20e-6))
    assert 0.9e-3 < a < 1.3e-3
    assert 0 < mdr.critical_velocity(case) < 0.01


def test_every_key_has_its_unit_or_meaning():
    for names in zip(itertools.cycle(MATERIALS), SHAPES, itertools.cycle(MOTIONS), strict=False):
        material, shape, motion = names
        for line in example_file(example(shape, material, motion)).splitlines():
            if "=" in line and not line.startswith(("shape", "model", "motion", "#")):
                assert "#" in line, line


def test_numbers_are_written_as_one_writes_them():
    text = example_file(example())
    assert "E = 3e6 " in text
    assert "u_z0 = 2e-5 " in text
    assert not re.search(r"\d{10}", text)


def test_names_are_taken_as_one_types_them():
    assert example("flat_punch") == example("FLATPUNCH") == example("flat-punch") == example("FlatPunch")


def test_a_name_that_is_none_is_refused_with_the_nearest():
    with pytest.raises(ValueError, match="coen is no shape of an example; did you mean Cone"):
        example("coen")
    with pytest.raises(ValueError, match="no material of an example; there are Elastic"):
        example(material="granite")
    with pytest.raises(TypeError, match="shape must be a name, got 3"):
        example(3)
