"""Names of columns: what is named is taken, what nobody names is left alone, whatever the order and the case."""

import numpy as np
import pytest

from mdr.files.force_curves import FORCE
from mdr.files.measurements import MODULI
from mdr.files.profiles import PROFILE
from mdr.files.recorded_motion import MOTION
from mdr.friction.friction_data import FRICTION, VELOCITY
from mdr.tools.csv_header import Reading
from mdr.tools.csv_table import table_of

WANTED = {
    "motion": (MOTION, {"t": "t [ms]", "a_z": "a [g]"}),
    "moduli": (MODULI, {"omega": "f [Hz]", "storage": "E' [MPa]", "loss": "E'' [MPa]"}),
    "profile": (PROFILE, {"r": "r [um]", "f": "f [nm]"}),
    "force": (FORCE, {"d": "d [nm]", "F": "F [mN]"}),
    "friction": ((VELOCITY, *FRICTION), {"v_0": "v [mm/s]", "cof": "mu"}),
}


@pytest.mark.parametrize("kind", WANTED)
def test_letters_of_another_case_are_left_alone(kind):
    """Every letter, in the other case, with a unit of nothing that is wanted; in any order; ten files a kind."""
    columns, wanted = WANTED[kind]
    rng = np.random.default_rng(6)
    known = {one for column in columns for one in (column.name, *column.names)}
    known |= {head.partition(" ")[0] for head in wanted.values()}
    others = [f"{one} [V]" for one in "TUVXYZDFRWAHMStuvxyzdfrwahms" if one not in known]
    for _ in range(10):
        heads = [*wanted.values(), *others]
        order = rng.permutation(len(heads))
        text = ",".join(heads[i] for i in order) + "\n" + ",".join(str(float(i)) for i in order) + "\n"
        found = table_of(text, "data.csv", columns, Reading())
        assert set(found.values) == set(wanted)
        alone = table_of(
            ",".join(wanted.values()) + "\n" + ",".join(map(str, range(len(wanted)))), "data.csv", columns, Reading()
        )
        assert all(found.values[name] == alone.values[name] for name in wanted)


@pytest.mark.parametrize("kind", WANTED)
def test_what_is_named_is_taken_though_another_column_would_claim_it(kind):
    """All names of all columns of the kind stand in the header; each is given to a column that it is not a name of."""
    columns, wanted = WANTED[kind]
    names = [*dict.fromkeys(one for column in columns for one in (column.name, *column.names))]
    by_name = {column.name: column for column in columns}
    for shift in range(1, 11):
        own = {name: names[(7 * shift + 3 * k) % len(names)] for k, name in enumerate(wanted)}
        if len(set(own.values())) < len(own):
            continue
        left_out = {one.name: "" for one in columns if one.name not in wanted}
        text = ",".join(names) + "\n" + ",".join(str(float(i)) for i in range(len(names))) + "\n"
        units = {name: by_name[name].unit for name in wanted}
        found = table_of(text, "data.csv", columns, Reading(units, own | left_out))
        assert {name: values[0] for name, values in found.values.items()} == {
            name: float(names.index(head)) for name, head in own.items()
        }
