"""Tables in forms that are published or that instruments and programs write, with made-up rows: read right, or refused
with what to type.
"""

import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

G = 9.80665
HZ = 2 * np.pi
SECONDS_G = {"t": "s", "a_z": "g"}
WORDS = {"d": "z", "F": "force"}
ISOTHERMS = ((-10, 40), (20, 8), (50, 4))
LONG = "\n".join(f"{f}, {T}, {E * s}, {0.2 * E * s}" for T, E in ISOTHERMS for f, s in ((1, 1), (10, 1.2)))
SCAN = "\n".join(f"{r}, {r * r}" for r in range(8))
CURVE = "\n".join(f"{d}, {d**1.5}" for d in range(9))


def beside(rows, n):
    """The rows with n more cells."""
    return "\n".join(row + ", 1" * n for row in rows.split("\n"))


def record(path, **given):
    return mdr.read_record(path, **given)


def moduli(path, **given):
    return mdr.read_moduli(path, **given)._asdict()


def arms(path, nu=0.5, **given):
    found = mdr.Prony.read(path, nu=nu, **given)
    return {"E_inf": found.E_inf, **{f"arm {j}": arm for j, arm in enumerate(found.arms)}}


def stiff_arms(path, **given):
    return arms(path, nu=0.3, **given)


def friction(path, **given):
    return vars(mdr.read_friction_data(path, **given))


def profile(path, **given):
    return {"r": mdr.SampledProfile.read(path, **given).r}


def force(path, **given):
    found = mdr.FromForce.read(path, E_star=1e6, **given)
    return {"d": found.d, "F": found.F}


DEPTHS, RADII = {"d": np.arange(9) * 1e-9}, {"r": np.arange(8) * 1e-6}
XYZ = {"a_x": "x", "a_y": "y", "a_z": "z"}
GS = {"t": "s", "a_x": "g", "a_y": "g", "a_z": "g"}
SHARES = {"E_inf": 1e6, "arm 0": (6e5, 0.01), "arm 1": (4e5, 1.0)}
AT_20 = {"omega": [HZ, 10 * HZ], "storage": [8e6, 9.6e6], "loss": [1.6e6, 1.92e6]}
#: reader, text, arguments, and what comes out, or the words of a refusal
FORMS = {
    # logs
    "xyz in g": (record, "time,x,y,z\n0,0.1,0.2,1\n0.01,0.2,0.1,0.9\n", {"columns": XYZ, "units": GS},
                 {"t": [0, 0.01], "a_x": [0.1 * G, 0.2 * G], "a_z": [G, 0.9 * G]}),
    "xyz with units": (record, "time [s],x [g],y [g],z [g]\n0,0.1,0.2,1\n", {"columns": XYZ}, {"a_y": [0.2 * G]}),
    "xyz, units alone": (record, "time,x,y,z\n0,0.1,0.2,1\n", {"units": GS}, {"a_x": [0.1 * G], "a_z": [G]}),
    "temperature and voltage beside": (record, "t [s],a [g],T [C],U [V]\n0,1,25,3\n", {}, {"t": [0], "a_z": [G]}),
    "a phone, named": (record, '"Time (s)","Linear Acceleration z (m/s^2)"\n0,1\n',
                       {"columns": {"a_z": "Linear Acceleration z (m/s^2)"}}, {"a_z": [1]}),
    "units in a row and given": (record, "t, a\ns, g\n0, 1\n", {"units": SECONDS_G}, {"a_z": [G]}),
    "units in a row, others given": (record, "t, a\nms, g\n0, 1\n", {"units": SECONDS_G}, ("t in ms, units= in s",)),
    "comma before the unit": (record, "Time, s;Acceleration, m/s2\n0;1\n", {}, {"t": [0], "a_z": [1]}),
    "sep of a bar": (record, '"SEP=|"\r\nt [s]|a [g]\r\n0|1\r\n', {}, {"t": [0], "a_z": [9.80665]}),
    "sep, and a word": (record, "sep=\t,\nt [s]\ta [g]\n0\tx\n", {}, ("line 3: x is no number",)),
    "preamble and units": (record, "DAQ 5\nRate 1000\n\ntime,acc\ns,g\n0,1\n", {"columns": {"a_z": "acc"}},
                           {"t": [0], "a_z": [G]}),
    "preamble, skipped": (record, "t [ms], a [g]\n5, 6\nt [s], a [g]\n0,1\n", {"skip": 2}, {"t": [0], "a_z": [G]}),
    "a voltage": (record, "t [s], a [mV]\n0, 1\n", {}, ("none of m/s2", "write a_z [m/s²]", 'columns={"a_z": ""}')),
    # moduli
    "isotherms": (moduli, f"f [Hz], T [C], E' [MPa], E'' [MPa]\n{LONG}\n", {}, ("-10, 20, 50 degC", "temperature=-10")),
    "one isotherm": (moduli, f"f [Hz], T [C], E' [MPa], E'' [MPa]\n{LONG}\n", {"temperature": 20}, AT_20),
    "isotherms in K": (moduli, "f [Hz], Temperature [K], E' [MPa], tan delta\n1, 263, 40, 0.2\n1, 293.2, 8, 0.2\n",
                       {"temperature": 20}, {"storage": [8e6]}),
    "isotherms without T": (moduli, "f [Hz], E' [MPa], E'' [MPa]\n1, 40, 8\n10, 50, 8\n1, 8, 1\n10, 9, 1\n", {},
                            ("lines 2 and 4", "several temperatures", 'columns={"T": ...}')),
    "master curve": (moduli, "f [Hz], T [C], E' [MPa], E'' [MPa]\n1, 50, 4, 1\n1e3, 20, 8, 2\n", {"columns": {"T": ""}},
                     {"storage": [4e6, 8e6]}),
    "shear": (moduli, "f [Hz], G' [MPa], G'' [MPa]\n1, 1, 0.1\n", {"nu": 0.5}, {"storage": [3e6], "loss": [3e5]}),
    "complex modulus": (moduli, "f [Hz], |E*| [MPa], tan delta\n1, 5, 0.75\n", {}, {"storage": [4e6], "loss": [3e6]}),
    "three that differ": (moduli, "f [Hz], E' [MPa], E'' [Pa], tan delta\n1, 3, 0.3, 0.1\n", {},
                          ("line 2: loss/storage is 1e-07, and tan_delta 0.1", 'columns={"tan_delta": ""}')),
    # arms
    "shares": (arms, "E_j, tau_j\n0.3, 0.01\n0.2, 1\n0.5, inf\n", {}, ("shares of the instantaneous", "E_0=")),
    "shares, E_0": (arms, "E_j, tau_j\n0.3, 0.01\n0.2, 1\n0.5, inf\n", {"E_0": 2e6}, SHARES),
    "shares without the long-time one": (arms, "g_i, tau_i\n0.3, 0.01\n0.2, 1\n", {"E_0": 2e6}, SHARES),
    "shares, G_0": (arms, "g_i, tau_i\n0.3, 0.01\n0.2, 1\n", {"G_0": 2e6 / 3}, SHARES),
    "bulk ones that differ": (stiff_arms, "g_i, k_i, tau_i\n0.3, 0, 0.01\n", {"E_0": 2e6},
                              ("k_j must equal g_j at nu = 0.3",)),
    "bulk ones, left out": (stiff_arms, "g_i, k_i, tau_i\n0.5, 0, 0.01\n", {"E_0": 2e6, "columns": {"k_j": ""}},
                            {"E_inf": 1e6, "arm 0": (1e6, 0.01)}),
    "pascals with E_0": (arms, "E_j, tau_j\n3e6, 0.01\n2e6, inf\n", {"E_0": 5e6}, ("leave E_0 out",)),
    "shear moduli": (arms, "G_i [MPa], tau_i [ms]\n1, 10\n2, inf\n", {}, {"E_inf": 6e6, "arm 0": (3e6, 0.01)}),
    "shares in a case": (arms, "E_inf = 0.5\narms = [[0.3, 0.01], [0.2, 1]]\n", {}, ('E_0 = "3 MPa"',)),
    "shares in a case, G_0": (arms, 'G_0 = "1 MPa"\narms = [[0.3, 0.01], [0.2, 1]]\n', {}, {"E_inf": 1.5e6}),
    "shares in a case, E_0": (arms, 'E_0 = "2 MPa"\narms = [[0.3, 0.01], [0.2, 1]]\n', {}, SHARES),
    # profiles, forces, friction
    "profile in the same letters": (profile, f"r [um], f [um], R [V], F [N]\n{beside(SCAN, 2)}\n", {}, RADII),
    "profile with German words": (profile, f"Weg in um;Hoehe in um\n{SCAN.replace(',', ';')}\n", {},
                                  ("no r and no f", "Weg in um", 'columns={"r"')),
    "force beside D": (force, f"d [nm], F [uN], D [V]\n{beside(CURVE, 1)}\n", {"tip": "round"}, DEPTHS),
    "force with a preamble": (force, f"Mode: single\n\nz (nm), force (nN)\n{CURVE}\n",
                              {"columns": WORDS, "tip": "round"}, DEPTHS),
    "force with a baseline": (force, "d [nm], F [nN]\n0, 5\n1, 5\n2, 5\n3, 6\n4, 8\n5, 11\n6, 15\n7, 20\n8, 26\n",
                              {"touch": 2e-9},
                              {"d": np.arange(7) * 1e-9, "F": np.array([0, 1, 3, 6, 10, 15, 21]) * 1e-9}),
    "friction with an error of the COF": (friction, "v [mm/s], COF, SD (COF)\n1, 0.3, 0.01\n", {}, {"error": [0.01]}),
    "friction with its error": (friction, "v [mm/s], mu, SD\n1, 0.3, 0.01\n", {}, {"error": [0.01]}),
    "two channels, words": (record, "Zeit (s);Beschl. Z (g);Beschl. X (g)\n0;1;0\n", {},
                            ('"a_x": "Beschl. X", "a_z": "Beschl. Z"',)),
    "friction in per cent": (friction, "v [mm/s], mu [%], V [V]\n1, 30, 2\n", {}, {"v_0": [1e-3], "cof": [0.3]}),
}  # fmt: skip


@pytest.mark.parametrize(("read", "text", "given", "expected"), FORMS.values(), ids=FORMS.keys())
def test_a_published_form_is_read_right_or_says_what_to_type(tmp_path, read, text, given, expected):
    path = tmp_path / ("arms.toml" if " = " in text.partition("\n")[0] else "data.csv")
    path.write_text(text, encoding="utf-8")
    if isinstance(expected, dict):
        found = read(path, **given)
        for name, values in expected.items():
            assert_allclose(found[name], values, rtol=1e-12)
        assert "u_z" not in found or "u_z" in expected
        return
    with pytest.raises(ValueError, match=path.name) as refused:
        read(path, **given)
    assert [words for words in expected if words not in str(refused.value)] == []
    assert not str(refused.value).rstrip().endswith((":", ";", ","))


SIZES = {
    "moduli in MPa": (
        moduli,
        "f [Hz], E' [Pa], E'' [Pa]\n1, 3, 1\n",
        "storage, read in Pa, is at most 3 Pa, below 200 Pa",
    ),
    "moduli in Pa": (moduli, "f [Hz], E' [MPa], tan delta\n1, 3e7, 1\n", "above 2000 GPa"),
    "an angle in degrees": (moduli, "f [Hz], E' [MPa], tan delta\n1, 3, 12\n", "tan_delta is at most 12, above 5"),
    "arms in MPa": (arms, "E_j, tau_j\n3, 1\n2, inf\n", "the sum of the moduli is at most 5 Pa"),
    "shares in per cent": (arms, "E_j, tau_j\n30, 1\n70, inf\n", "at most 100 Pa, below 200 Pa"),
    "degrees under K": (moduli, "f [Hz], T [K], E' [MPa], tan delta\n1, 20, 3, 0.1\n", "T, read in K, is at most 20 K"),
    "g for m/s²": (record, "t [ms], a [m/s²]\n0, 0.99\n1, 1.01\n", "is it in g and not m/s²?"),
    "m/s² for g": (record, "t [ms], a [g]\n0, 9.7\n1, 9.9\n", "is it in m/s² and not g?"),
    "a count of samples": (
        record,
        "t [s], a [g]\n0, 1\n1, -2\n2, 3\n",
        "is the time in ms, or the number of the sample?",
    ),
    "millimetres for metres": (record, "t [s], u_z [m]\n0, 1\n1, 2\n", "u_z, read in m, is at most 2 m, above 10 mm"),
    "a scan in metres": (profile, f"r [m], f [m]\n{SCAN}\n", "r, read in m, is at most 7 m, above 1 m"),
    "friction in per cent": (friction, "v [m/s], mu\n1, 30\n", "is it in per cent"),
    "an error by another name": (friction, "v [mm/s], mu, Streuung\n1, 0.3, 0.01\n", 'columns={"error": "Streuung"}'),
    "velocities in mm/s": (friction, "v [m/s], mu\n500, 0.3\n", "v_0, read in m/s, is at most 500 m/s"),
}


def test_numbers_of_runs_and_words_are_no_errors(tmp_path):
    path = tmp_path / "data.csv"
    path.write_text("Run, v [mm/s], mu, n, remark\n1, 1, 0.3, 10, dry\n2, 2, 0.4, 12, dry\n", encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert mdr.read_friction_data(path).error is None


@pytest.mark.parametrize(("read", "text", "words"), SIZES.values(), ids=SIZES.keys())
def test_a_size_that_is_hardly_meant_is_warned_of(tmp_path, read, text, words):
    (tmp_path / "data.csv").write_text(text, encoding="utf-8")
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        read(tmp_path / "data.csv")
    assert any(words in str(one.message) for one in told)
    assert all(issubclass(one.category, mdr.PlausibilityWarning) for one in told)
