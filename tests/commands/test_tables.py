"""Tables of a case file from what was measured: what Python reads, the command line writes."""

import numpy as np
import pytest
from answers import words_of

import mdr
from mdr.commands.arguments import in_options
from mdr.given.case_file import parse_case

REST = """
mu_0 = 0.4
[oscillation]
u_z0 = 4e-7
du_z = 1e-7
omega = 300.0
"""
X = np.arange(-60, 61, 4.0)  # um
D = np.arange(1, 12.0)  # um
HZ = np.geomspace(0.1, 100, 15)
MODULI = 3e6 * (1 + 0.2 * (1j * HZ / 10) / (1 + 1j * HZ / 10))
T = np.geomspace(1e-2, 10, 12)
FILES = {
    "scan.csv": ("x [um], height [nm]", X, (X - 8) ** 2 / 10),
    "up.csv": ("x [um], height [nm]", X, -10 * abs(X)),
    "press.csv": ("d [um]; F [mN]", D, 0.4 * D**1.5),
    "heights.csv": ("f [nm]", (X - 8) ** 2 / 10),
    "piezo.csv": ("Height [um]; Load [mN]", D + 0.4 * D**1.5 / 20, 0.4 * D**1.5),
    "moduli.csv": ("f [Hz], T [C], E' [Pa], E'' [Pa]", HZ, 0 * HZ + 20, MODULI.real, MODULI.imag),
    "relaxation.csv": ("t [s], E [MPa]", T, 3 + np.exp(-T)),
    "creep.csv": ("t [s], D [1/MPa]", T, 0.4 - 0.1 * np.exp(-T)),
    "arms.csv": ("E_j, tau_j", [0.3, 0.7], [1.0, np.inf]),
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, (head, *columns) in FILES.items():
        split = ";" if ";" in head else ","
        np.savetxt(name, np.column_stack(columns), header=head, comments="", delimiter=split, fmt="%.10g")


READ = {
    "indenter up.csv --tip sharp --flip --columns f=height": lambda: mdr.SampledProfile.read(
        "up.csv", tip="sharp", flip=True, columns={"f": "height"}
    ),
    "indenter scan.csv --smoothing 2nm --side left --apex 8um --kinks 20um 40um": lambda: mdr.SampledProfile.read(
        "scan.csv", smoothing=2e-9, side="left", apex=8e-6, kinks=(20e-6, 40e-6)
    ),
    "indenter press.csv --E-star 4MPa --tip round": lambda: mdr.FromForce.read("press.csv", E_star=4e6, tip="round"),
    "indenter heights.csv --pitch 4um --apex 68um": lambda: mdr.SampledProfile.read(
        "heights.csv", pitch=4e-6, apex=68e-6
    ),
    "indenter piezo.csv --E-star 4MPa --spring-constant 20kN/m": lambda: mdr.FromForce.read(
        "piezo.csv", E_star=4e6, spring_constant=2e4
    ),
    "material moduli.csv --nu 0.5 --temperature 20 --n-arms 3": lambda: mdr.Prony.fit(
        *mdr.read_moduli("moduli.csv", temperature=20), nu=0.5, n_arms=3
    ),
    "material moduli.csv --nu 0.5 --temperature 30 --wlf 17.4 51.6": lambda: mdr.Prony.fit(
        *mdr.read_moduli("moduli.csv", temperature=30, wlf=(17.4, 51.6)), nu=0.5
    ),
    "material relaxation.csv --of relaxation --nu 0.4": lambda: mdr.Prony.fit_relaxation(
        *mdr.read_relaxation("relaxation.csv"), nu=0.4
    ),
    "material creep.csv --of creep --nu 0.4": lambda: mdr.Prony.fit_creep(*mdr.read_creep("creep.csv"), nu=0.4),
    "material arms.csv --of arms --nu 0.4 --E-0 2MPa": lambda: mdr.Prony.read("arms.csv", nu=0.4, E_0=2e6),
}


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("command", READ)
def test_a_table_is_what_python_reads(command, capsys):
    words = command.split()
    table, expected = words_of(capsys, words).out, READ[command]()
    assert table.startswith("# ")
    other = '[material]\nmodel = "Elastic"\nE = 3e6\nnu = 0.5\n' if words[0] == "indenter" else ""
    other = other or '[indenter]\nshape = "Cone"\ntheta = 0.1\n'
    assert getattr(parse_case(f"{REST}\n{table}\n{other}", "case.toml"), words[0]) == expected


@pytest.mark.usefixtures("folder")
@pytest.mark.filterwarnings("always::mdr.PlausibilityWarning")
def test_what_is_told_of_a_file_names_options(capsys):
    d = np.linspace(-4, 12, 161)
    rows = np.column_stack([d, 1 + 0.4 * np.maximum(d, 0) ** 1.5])
    np.savetxt("all.csv", rows, header="d [um], F [mN]", comments="", delimiter=",")
    said = words_of(capsys, ["indenter", "all.csv", "--E-star", "4MPa"]).err
    assert "are taken, as found" in said
    assert "with --tip sharp the touch would be" in said


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("indenter press.csv --E-star 4MPa --apex 8um", "--apex is of heights: leave it out"),
        ("indenter press.csv --E-star 4MPa --flip", "--flip is of heights: leave it out"),
        ("indenter scan.csv --part retract", "--part is of forces, which need --E-star: leave it out"),
        ("indenter scan.csv --smoothing 2N", "--smoothing wants m (or cm"),
        ("indenter scan.csv --apex 9um", "give the place of the tip as --apex, or add"),
        ("material moduli.csv --nu 0.5 --temperature 50", "no moduli within 0.5 K of temperature = 50 degC"),
        ("material arms.csv --of arms --nu 0.4", "give --E-0 or --G-0 in Pa"),
        ("material creep.csv --of creep --nu 0.4 --temperature 20", "--temperature says nothing of creep"),
    ],
)
def test_what_does_not_fit_is_refused_in_options(command, words, capsys):
    assert words in words_of(capsys, command.split(), 2).err


def test_a_way_out_in_options_is_written_once():
    said = 'columns={"v_0": "Geschw", "cof": "mu"}, units={"v_0": "mm/s"}, or v_0=2e-3, flip=True'
    options = "--columns v_0=Geschw cof=mu --units v_0=mm/s, or --v-0 2e-3, --flip"
    assert in_options(said, ["v_0", "flip"]) == options
