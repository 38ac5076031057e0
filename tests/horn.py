"""A horn on plastic at 20 kHz as the tables of a case file, and the file in which some of its values are others."""

import copy

from mdr.given.case_file import case_of

HORN = {
    "mu_0": 0.3,
    "indenter": {"shape": "Sphere", "R": 3e-3},
    "material": {"model": "KelvinVoigt", "E": 3e9, "nu": 0.4, "tan_delta": 0.03},
    "oscillation": {"frequency": 20e3, "load": 5.0, "du_z": 3e-6},
}


def written(tables, values):
    """The case of a file in which these values, by their paths, are written down."""
    tables = copy.deepcopy(tables)
    homes = {"load": ["oscillation"], "tan_delta": ["material"], "frequency": ["oscillation", "shake"]}
    for path, value in values.items():
        slot, _, key = path.partition(".")
        if path in homes:
            for home in homes[path]:
                if path in tables.get(home, {}):
                    tables[home][path] = value
        elif not key:
            tables[slot] = value
        else:
            tables[slot].pop({"omega": "frequency", "theta": "theta_deg"}.get(key), None)
            tables[slot][key] = value
    return case_of(tables).case
