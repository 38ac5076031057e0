"""Files as instruments, loggers, spreadsheets and people write them, with made-up rows: read right at first try or as a
refusal says, refused in words, or read with a warning.
"""

import warnings
from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

G = 9.80665
HZ = 2 * np.pi
PHONE = '"Time (s)","Linear Acceleration x (m/s^2)","Linear Acceleration y (m/s^2)","Linear Acceleration z (m/s^2)"'
ACCELERATED = {"t": [0, 0.01], "a_x": [0.1, 0.2], "a_y": [0.3, 0.4], "a_z": [0.5, 0.6]}
DEPTHS = np.arange(8) * 1e-8
FORCES = 2e-6 * (DEPTHS / 1e-8) ** 1.5
RADII = np.arange(7) * 1e-5
HEIGHTS = 3e-8 * np.arange(7) ** 2
MODULI = {"omega": [HZ, 10 * HZ], "storage": [3e6, 4e6], "loss": [3e5, 8e5]}
AT_20 = {"omega": [HZ, 10 * HZ], "storage": [8e6, 9.6e6], "loss": [1.6e6, 1.92e6]}
RELAXED = {"t": [0.1, 1, 10], "modulus": [3e6, 2e6, 1.5e6]}
CREPT = {"t": [0.1, 1, 10], "compliance": [1e-6, 1.5e-6, 2e-6]}
ARMS = {"E_inf": 1e6, "arms": [(6e5, 0.01), (4e5, 1.0)]}
FRICTION = {"v_0": [5e-4, 1e-3], "cof": [0.31, 0.35]}


def rows(*columns, by=",", mark="."):
    """Rows of columns in the separator and the decimal mark of a file."""
    return "".join(
        by.join(f"{one:.17g}".replace(".", mark) for one in row) + "\n" for row in zip(*columns, strict=True)
    )


record, friction, profile = mdr.read_record, mdr.read_friction_data, mdr.SampledProfile.read
moduli, relaxation, creep = mdr.read_moduli, mdr.read_relaxation, mdr.read_creep
arms, force = partial(mdr.Prony.read, nu=0.5), partial(mdr.FromForce.read, E_star=1e6)
SHAPE, PRESS = {"r": RADII, "f": HEIGHTS}, {"d": DEPTHS, "F": FORCES}
AXES = {"a_x": "g", "a_y": "g", "a_z": "g"}
XYZ = {"a_x": "x", "a_y": "y", "a_z": "z"}
SCAN = rows(1e6 * RADII, 1e9 * HEIGHTS)  # um, nm
CURVE = rows(1e9 * DEPTHS, 1e6 * FORCES)  # nm, uN
ISOTHERMS = "f [Hz], T [C], E' [MPa], E'' [MPa]\n" + rows(
    [1, 10] * 3, [-10, -10, 20, 20, 50, 50], [40, 48, 8, 9.6, 4, 4.8], [8, 9.6, 1.6, 1.92, 0.8, 0.96]
)
#: where the form is met, or what it is: reader, text, what is given with the name of the file, what comes out
READ = {
    "phone app, commas": (record, PHONE + "\n0,0.1,0.3,0.5\n0.01,0.2,0.4,0.6\n", {}, ACCELERATED),
    "phone app, tabs and decimal commas": (
        record, PHONE.replace(",", "\t") + "\n0\t0,1\t0,3\t0,5\n0,01\t0,2\t0,4\t0,6\n", {}, ACCELERATED),
    "logger, four lines above": (
        record, "DAQ Express 5.1\nDevice: 9234\nRate,1000\n\nTime (s),Acceleration (g)\n0,1\n0.001,-2\n", {},
        {"t": [0, 1e-3], "a_z": [G, -2 * G]}),
    "analyser, units in a row": (record, "Time,Acc Z\nsec,m/s/s\n0,1\n0.5,2\n", {}, {"t": [0, 0.5], "a_z": [1, 2]}),
    "German spreadsheet": (
        record, "sep=;\nZeit [s];Beschleunigung [m/s²]\n0,000;0,12\n0,001;-1,5\n".encode("cp1252"), {},
        {"t": [0, 1e-3], "a_z": [0.12, -1.5]}),
    "spreadsheet, Unicode text": (
        record, "Time [ms]\tDisplacement [µm]\tDrive [V]\n0\t1\t5\n1\t2\t5\n".encode("utf-16"),
        {"columns": {"u_z": "Displacement"}},
        {"t": [0, 1e-3], "u_z": [1e-6, 2e-6]}),
    "shaker, units after a comma in quotes": (
        record, '"Time, ms";"Acceleration, ms-2"\n0;1\n1;2\n', {}, {"t": [0, 1e-3], "a_z": [1, 2]}),
    "shaker, times rounded to ms": (
        record, "t [s],a [g]\n" + rows(np.round(np.arange(400) / 1600, 3), np.ones(400)), {}, {"a_z": np.full(400, G)}),
    "vibrometer, a footer": (
        record, "Vibrometer export\nTime [s];Displacement [microns]\n0;1\n0.5;2\nEnd of data\n",
        {"columns": {"u_z": "Displacement"}},
        {"t": [0, 0.5], "u_z": [1e-6, 2e-6]}),
    "logger, letters for axes": (
        record, "time [s],x [g],y [g],z [g]\n0,0.1,0.2,1\n", {}, {"a_x": [0.1 * G], "a_y": [0.2 * G], "a_z": [G]}),
    "dynamic test, tabs and a row of units": (
        moduli, "Instrument\tDMA\nOperator\tA. N.\n\n"
        "Frequency\tTemperature\tStorage modulus\tLoss modulus\tTan(delta)\n"
        "Hz\t°C\tMPa\tMPa\t\n1\t20.1\t3\t0.3\t0.1\n10\t20.0\t4\t0.8\t0.2\n", {}, MODULI),
    "thermal analysis, slashes": (
        moduli, "#EXPORTTYPE:DATA ALL\n#DECIMAL:COMMA\n##Temp./°C;Frequency/Hz;E'/MPa;tan d\n"
        "20,0;1,0;3,0;0,1\n20,0;10,0;4,0;0,2\n", {}, MODULI),
    "rheometer, units in square brackets below": (
        moduli, "Interval data:\tMeas. Pts.\tAngular Frequency\tStorage Modulus\tLoss Modulus\tDamping Factor\tTorque\n"
        "\t\t[rad/s]\t[Pa]\t[Pa]\t[1]\t[mN·m]\n"
        f"\t1\t{HZ!r}\t1E+6\t1E+5\t0.1\t2\n\t2\t{10 * HZ!r}\t{4e6 / 3!r}\t{8e5 / 3!r}\t0.2\t2\n", {"nu": 0.5}, MODULI),
    "finite elements, g_i": (arms, "g_i, k_i, tau_i\n0.3, 0.3, 0.01\n0.2, 0.2, 1\n", {"E_0": 2e6}, ARMS),
    "finite elements, words": (
        arms, "Index\tRelative Moduli\tRelaxation Time (s)\n1\t0.3\t0.01\n2\t0.2\t1\n", {"E_0": 2e6}, ARMS),
    "arms, decimal commas": (arms, "E_j [MPa];tau_j [s]\n0,6;0,01\n0,4;1\n1,0;inf\n", {}, ARMS),
    "arms, blanks": (
        arms, "Shear modulus (kPa)  Relaxation time (ms)\n200  10\n133.33333333333334  1000\n"
        "333.3333333333333  inf\n", {}, ARMS),
    "stylus, ångström": (
        profile, "Stylus scan\nScan Length, 60 um\nScan Date, 1/2/2024\nLateral (µm),Total Profile (Å)\n"
        + rows(1e6 * RADII, 1e10 * HEIGHTS), {}, SHAPE),
    "surface software, units below": (
        profile, "X\tZ\nmm\tµm\n" + rows(1e3 * RADII, 1e6 * HEIGHTS, by="\t"), {}, SHAPE),
    "confocal, decimal commas": (
        profile, "Distance [µm];Height [µm]\n" + rows(1e6 * RADII, 1e6 * HEIGHTS, by=";", mark=","), {}, SHAPE),
    "microscope, key and value above": (
        profile, "Model,X1000\nXY calibration,0.1,um\nSamples,7\n\nNo.,Position (microns),Height (nm)\n"
        + rows(np.arange(1, 8), 1e6 * RADII, 1e9 * HEIGHTS), {}, SHAPE),
    "NumPy, blanks below commas": (
        profile, "# r [um], f [nm]\n" + rows(1e6 * RADII, 1e9 * HEIGHTS, by=" "), {}, SHAPE),
    "indenter, a count above": (
        force, "Number of Points = 8\n\nDepth (nm)\tLoad (µN)\tTime (s)\n"
        + rows(1e9 * DEPTHS, 1e6 * FORCES, np.arange(8), by="\t"), {}, PRESS),
    "testing machine, all in quotes": (
        force, '"Time","Extension","Load"\n"(sec)","(mm)","(mN)"\n'
        + rows(np.arange(8), 1e3 * DEPTHS, 1e3 * FORCES, by='","').replace("\n", '"\n"').rstrip('"').join(['"', ""]),
        {"columns": {"d": "Extension"}}, PRESS),
    "depth and force in other words": (
        force, "Weg [nm];Kraft [µN]\n" + rows(1e9 * DEPTHS, 1e6 * FORCES, by=";", mark=","),
        {"columns": {"d": "Weg"}}, PRESS),
    "tribometer, decimal commas": (
        friction, "Probe 7\nDatum;1.2.2024\nv (mm/s);COF\n0,5;0,31\n1,0;0,35\n", {}, FRICTION),
    "tribometer, words": (
        friction, "Speed [mm/s], Coefficient of friction [-], Std dev\n0.5, 0.31, 0.01\n1, 0.35, 0.01\n", {}, FRICTION),
    "two blanks between columns": (
        friction, "Sliding speed (mm/s)  Friction coefficient\n0.5  0.31\n1.0  0.35\n", {}, FRICTION),
    "mm/sec": (friction, "Sliding velocity [mm/sec]\tµ\n0.5\t0.31\n1.0\t0.35\n", {}, FRICTION),
    # records
    "xyz in g": (record, "time,x,y,z\n0,0.1,0.2,1\n0.01,0.2,0.1,0.9\n", {"columns": XYZ, "units": {"t": "s", **AXES}},
                 {"t": [0, 0.01], "a_x": [0.1 * G, 0.2 * G], "a_z": [G, 0.9 * G]}),
    "xyz with units": (record, "time [s],x [g],y [g],z [g]\n0,0.1,0.2,1\n", {"columns": XYZ}, {"a_y": [0.2 * G]}),
    "xyz, units alone": (
        record, "time,x,y,z\n0,0.1,0.2,1\n", {"units": {"t": "s", **AXES}}, {"a_x": [0.1 * G], "a_z": [G]}),
    "a motion": (record, "t [s], x [mm], depth [um]\n0, 1, 2\n1, 2, 3\n", {},
                 {"t": [0, 1], "u_x": [1e-3, 2e-3], "u_z": [2e-6, 3e-6]}),
    "temperature and voltage beside": (record, "t [s],a [g],T [C],U [V]\n0,1,25,3\n", {}, {"t": [0], "a_z": [G]}),
    "a phone, named": (record, '"Time (s)","Linear Acceleration z (m/s^2)"\n0,1\n',
                       {"columns": {"a_z": "Linear Acceleration z (m/s^2)"}}, {"a_z": [1]}),
    "units in a row and given": (record, "t, a\ns, g\n0, 1\n", {"units": {"t": "s", "a_z": "g"}}, {"a_z": [G]}),
    "sep of a bar": (record, '"SEP=|"\r\nt [s]|a [g]\r\n0|1\r\n', {}, {"t": [0], "a_z": [G]}),
    "preamble, skipped": (record, "t [ms], a [g]\n5, 6\nt [s], a [g]\n0,1\n", {"skip": 2}, {"t": [0], "a_z": [G]}),
    # moduli, and what follows a step
    "moduli in falling order": (
        moduli, "frequency (Hz), tensile storage modulus (kPa), tan δ\n10, 4000, 0.2\n1, 3000, 0.1\n", {}, MODULI),
    "moduli over rad/s": (
        moduli, f"omega [rad/s], E′ [N/mm²], tan(delta) [-]\n{HZ!r}, 3, 0.1\n{10 * HZ!r}, 4, 0.2\n", {}, MODULI),
    "shear moduli": (
        moduli, f"f [kHz], G' [MPa], G'' [MPa]\n0.001, 1, 0.1\n0.01, {4 / 3!r}, {0.8 / 3!r}\n", {"nu": 0.5}, MODULI),
    "shear modulus and tan delta": (
        moduli, f"f [Hz], G' [MPa], tan delta\n1, 1, 0.1\n10, {4 / 3!r}, 0.2\n", {"nu": 0.5}, MODULI),
    "complex modulus": (moduli, "f [Hz], |E*| [MPa], tan delta\n1, 5, 0.75\n", {}, {"storage": [4e6], "loss": [3e6]}),
    "one isotherm": (moduli, ISOTHERMS, {"temperature": 20}, AT_20),
    "isotherms in K": (moduli, "f [Hz], Temperature [K], E' [MPa], tan delta\n1, 263, 40, 0.2\n1, 293.2, 8, 0.2\n",
                       {"temperature": 20}, {"storage": [8e6]}),
    "master curve": (moduli, "f [Hz], T [C], E' [MPa], E'' [MPa]\n1, 50, 4, 1\n1e3, 20, 8, 2\n", {"columns": {"T": ""}},
                     {"storage": [4e6, 8e6]}),
    "relaxation": (relaxation, "t [s], E [MPa]\n0.1, 3\n1, 2\n10, 1.5\n", {}, RELAXED),
    "relaxation, units below": (
        relaxation, "Probe 3\nTime;E(t)\nms;kPa\n100,0;3000,0\n1000,0;2000,0\n10000,0;1500,0\n", {}, RELAXED),
    "relaxation in shear": (
        relaxation, f"Step time (s)\tG(t) (Pa)\tTorque (mN·m)\n0.1\t1e6\t1\n1\t{2e6 / 3!r}\t1\n10\t5e5\t1\n",
        {"nu": 0.5}, RELAXED),
    "creep": (creep, "t [s], D [1/MPa]\n0.1, 1\n1, 1.5\n10, 2\n", {}, CREPT),
    "creep in shear": (creep, "time, J\ns, MPa^-1\n0.1, 3\n1, 4.5\n10, 6\n", {"nu": 0.5}, CREPT),
    # arms
    "shares, E_0": (arms, "E_j, tau_j\n0.3, 0.01\n0.2, 1\n0.5, inf\n", {"E_0": 2e6}, ARMS),
    "shares, G_0": (arms, "g_i, tau_i\n0.3, 0.01\n0.2, 1\n", {"G_0": 2e6 / 3}, ARMS),
    "bulk ones, left out": (arms, "g_i, k_i, tau_i\n0.5, 0, 0.01\n", {"nu": 0.3, "E_0": 2e6, "columns": {"k_j": ""}},
                            {"E_inf": 1e6, "arms": [(1e6, 0.01)]}),
    "arms of shear": (arms, "G_i [MPa], tau_i [ms]\n1, 10\n2, inf\n", {}, {"E_inf": 6e6, "arms": [(3e6, 0.01)]}),
    "shares in a case, G_0": (arms, 'G_0 = "1 MPa"\narms = [[0.3, 0.01], [0.2, 1]]\n', {}, {"E_inf": 1.5e6}),
    "shares in a case, E_0": (arms, 'E_0 = "2 MPa"\narms = [[0.3, 0.01], [0.2, 1]]\n', {}, ARMS),
    # profiles, forces, friction
    "profile in the same letters": (
        profile, "r [um], f [nm], R [V], F [N]\n" + SCAN.replace("\n", ",1,1\n"), {}, SHAPE),
    "profile in words": (profile, f"Radius (µm), Height (nm)\n{SCAN}", {}, SHAPE),
    "profile, slashes": (profile, f"x / um, z / nm\n{SCAN}", {}, SHAPE),
    "profile, slashes alone": (profile, f"x/um,z/nm\n{SCAN}", {}, SHAPE),
    "profile of numpy.savetxt": (profile, f"# r [um], f [nm]\n{SCAN}", {}, SHAPE),
    "profile, units given": (profile, f"r, f\n{SCAN}", {"units": {"r": "um", "f": "nm"}}, SHAPE),
    "profile, columns given": (
        profile, f"Weg [um], Hoehe [nm]\n{SCAN}", {"columns": {"r": "Weg", "f": "Hoehe"}}, SHAPE),
    "force beside D": (
        force, "d [nm], F [uN], D [V]\n" + CURVE.replace("\n", ",1\n"), {"tip": "round"}, PRESS),
    "force with a baseline": (force, "d [nm], F [nN]\n0, 5\n1, 5\n2, 5\n3, 6\n4, 8\n5, 11\n6, 15\n7, 20\n8, 26\n",
                              {"touch": 2e-9},
                              {"d": np.arange(7) * 1e-9, "F": np.array([0, 1, 3, 6, 10, 15, 21]) * 1e-9}),
    "friction with an error of the COF": (friction, "v [mm/s], COF, SD (COF)\n1, 0.3, 0.01\n", {}, {"error": [0.01]}),
    "friction with its error": (friction, "v [mm/s], mu, SD\n1, 0.3, 0.01\n", {}, {"error": [0.01]}),
    "friction in per cent": (friction, "v [mm/s], mu [%], V [V]\n1, 30, 2\n", {}, {"v_0": [1e-3], "cof": [0.3]}),
}  # fmt: skip
#: the same for forms that say too little; the words are those of the refusal without what is given
WITH_A_WORD = {
    "phone app without units": (
        record, "time,gFx,gFy,gFz,TgF\n0,0.1,0.2,1,1.02\n0.01,0.2,0.1,1,1.02\n",
        {"columns": {"a_x": "gFx", "a_y": "gFy", "a_z": "gFz"}, "units": {"t": "s", **AXES}},
        {"a_x": [0.1 * G, 0.2 * G], "a_z": [G, G]}, "columns={"),
    "logger of nanoseconds": (
        record, "time,seconds_elapsed,z,y,x\n1700000000000000000,0,1,0.2,0.1\n1700000000010000000,0.01,1,0.1,0.2\n",
        {"columns": {"t": "seconds_elapsed"}, "units": {"t": "s", **AXES}},
        {"t": [0, 0.01], "a_x": [0.1 * G, 0.2 * G]}, "units={"),
    "LabVIEW text": (
        record, "LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\n"
        "Decimal_Separator\t,\n***End_of_Header***\t\n\t\nChannels\t1\nSamples\t2\nX_Dimension\tTime\n"
        "Delta_X\t0,001\n***End_of_Header***\t\nX_Value\tUntitled\tComment\n"
        "0,000\t0,1\t\n0,001\t-0,25\t\n",
        {"columns": {"t": "X_Value", "a_z": "Untitled"}, "units": {"t": "s", "a_z": "g"}},
        {"t": [0, 1e-3], "a_z": [0.1 * G, -0.25 * G]}, 'columns={"t": ..., "a_z": ...}'),
    "numbers alone": (
        record, "0.012 -0.98 0.05\n0.015 -0.97 0.06\n",
        {"columns": {"a_x": 1, "a_y": 2, "a_z": 3}, "units": AXES, "rate": 100.0},
        {"t": [0, 0.01], "a_x": [0.012 * G, 0.015 * G], "a_z": [0.05 * G, 0.06 * G]}, "columns={"),
    "number of the sample": (
        record, "Sample,Accel (g)\n1,0.1\n2,0.2\n3,0.3\n", {"rate": 1e3},
        {"t": [0, 1e-3, 2e-3], "a_z": [0.1 * G, 0.2 * G, 0.3 * G]}, "rate="),
    "finite elements, keyword": (
        arms, "*MATERIAL, NAME=RUBBER\n*VISCOELASTIC, TIME=PRONY\n0.3, 0.3, 0.01\n0.2, 0.2, 1.\n",
        {"columns": {"g_j": 1, "k_j": 2, "tau_j": 3}, "E_0": 2e6}, ARMS, "columns={"),
    "moduli in other words": (
        moduli, "Frequenz [Hz];Speichermodul [MPa];Verlustmodul [MPa]\n1,0;3,0;0,3\n10,0;4,0;0,8\n",
        {"columns": {"storage": "Speichermodul", "loss": "Verlustmodul"}}, MODULI,
        'columns={"storage": ..., "loss": ...}'),
    "surface data without a word": (
        profile, rows(1e3 * RADII, 1e6 * HEIGHTS, by="\t"),
        {"columns": {"r": 1, "f": 2}, "units": {"r": "mm", "f": "um"}}, SHAPE, 'columns={"r": ..., "f": ...}'),
    "force microscope, units in names": (
        force, "\\*File list\nRamp size: 80 nm\nCalc_Ramp_Ex_nm\tCalc_Ramp_Rt_nm\tDefl_pN_Ex\tDefl_pN_Rt\n"
        + rows(1e9 * DEPTHS, 1e9 * DEPTHS, 1e12 * FORCES, 1e12 * FORCES, by="\t"),
        {"columns": {"d": "Calc_Ramp_Ex_nm", "F": "Defl_pN_Ex"}, "units": {"d": "nm", "F": "pN"}}, PRESS, "columns={"),
    "friction without units": (
        friction, "velocity,mu\n0.5,0.31\n1.0,0.35\n", {"units": {"v_0": "mm/s"}}, FRICTION, 'units={"v_0": '),
}  # fmt: skip


#: reader, text, what is given with the name of the file, and words of the refusal
REFUSED = [
    # numbers
    (friction, "v [m/s];mu\n1.5;0,1\n", {}, "0,1 and 1.5 stand in one file: write one decimal mark"),
    (friction, "v [m/s], mu\n0,5, 0,31\n", {}, "line 2: has 4 cells, the header 2; if a comma is the decimal mark,"),
    (friction, "v [um/s];mu\n1,234;0.1\n", {},
     "write 1234 without a thousands separator or, if the comma is the decimal"),
    (friction, "v [um/s];mu\n1,234;2,345\n", {},
     "write 1234 without a thousands separator or, if the comma is the decimal"),
    (friction, "v [m/s], mu\n0.5 mm/s, 0.1\n", {}, "write 0.5 and the unit in the header (column v_0)"),
    (friction, "v [m/s], mu\n1, \n", {}, "line 2: the cell is empty, leave the line out (column cof)"),
    (friction, "v [m/s], mu\n1, high\n", {}, "line 2: high is no number"),
    # an open quote ends its line
    (friction, 'v [m/s], mu\n1, "0.3\n2, 0.4\n3, high\n', {}, "line 4: high is no number"),
    (friction, f"v [m/s], mu\n1, {'3' * 140_000}\n", {}, "is no number (column cof)"),
    (friction, f'v [m/s], mu\n1, "{"3" * 140_000}"\n', {}, "is no number (column cof)"),
    (record, "sep=\t,\nt [s]\ta [g]\n0\tx\n", {}, "line 3: x is no number"),
    # headers
    (friction, "", {}, "holds no table; a header such as v_0 [mm/s], cof, and a row a measurement"),
    (friction, "1, 0.3\n2, 0.4\n", {}, "there is no header, which names no v_0 and no cof; write v_0 [mm/s], cof"),
    (friction, "v [m/s], mu [N]\n1, 0.3\n", {}, "cof is a pure number, got the unit 'N'"),
    (friction, "v [m/s], y\n1, 0.3\n", {}, "the header names no cof; write v_0 [mm/s], cof"),
    (friction, "v, mu\n1, 0.3\n", {}, "v_0 needs a unit in its header, one of m/s, cm/s, mm/s, um/s"),
    (friction, "v [km/h], mu\n1, 0.3\n", {}, "the unit 'km/h' of v_0 is none of m/s"),
    (friction, "v [m/s], v [mm/s], mu\n1, 1, 0.3\n", {}, "the header names v_0 twice"),
    (record, "t [s], a [mV]\n0, 1\n", {}, "none of m/s2", "a voltage, which needs", 'columns={"a_z": ""}'),
    (record, "t, a\nms, g\n0, 1\n", {"units": {"t": "s", "a_z": "g"}}, "t in ms, units= in s"),
    (record, "Zeit (s);Beschl. Z (g);Beschl. X (g)\n0;1;0\n", {}, '"a_x": "Beschl. X", "a_z": "Beschl. Z"'),
    (record, "t [s], b [V]\n0, 1\n", {},
     "the header names a time, and nothing else by a name known here; write t [s], a [m/s²], or"),
    (profile, f"Weg in um;Hoehe in um\n{SCAN.replace(',', ';')}", {}, "no r and no f", "Weg in um", 'columns={"r"'),
    (profile, f"r [um], f\n{SCAN}", {"units": {"f": "yard"}}, "units: f = 'yard' is none of m, cm"),
    (profile, f"r [um], f\n{SCAN}", {"units": {"r": "mm", "f": "nm"}}, "gives r in um, units= in mm; give one"),
    (profile, f"r [um], f\n{SCAN}", {"columns": {"f": "Z"}}, "the header names no Z; columns= must name one of these"),
    (moduli, "f [Hz], E' [mPa], E'' [mPa]\n1, 3, 0.3\n", {}, "'mPa' of storage is none of Pa, kPa, MPa, GPa"),
    (moduli, "f [Hz], E' [MPa]\n1, 3\n", {}, "neither loss modulus, tan delta nor phase"),
    (moduli, "f [Hz], G' [MPa], G'' [MPa]\n1, 3, 0.3\n", {}, "needs Poisson's ratio, as E = 2 (1 + nu) G"),
    (relaxation, "t [s], Er [MPa]\n1, 1\n", {}, 'columns={"E": ...}'),
    (relaxation, "t [s], E [MPa], G [MPa]\n1, 1, 1\n", {}, 'leave one out, columns={"G": ""}'),
    (creep, "t [s], J [1/MPa]\n1, 1\n", {}, "of shear and needs Poisson's ratio: give nu=; if it is one in"),
    # rows
    (moduli, "f [Hz], E' [MPa], E'' [MPa]\n1, 3, 1\n2, 3, -0.1\n", {}, "line 3: loss must not be negative"),
    (moduli, ISOTHERMS, {}, "-10, 20, 50 degC", "temperature=-10"),
    (moduli, "f [Hz], E' [MPa], E'' [MPa]\n1, 40, 8\n10, 50, 8\n1, 8, 1\n10, 9, 1\n", {},
     "lines 2 and 4", "several temperatures", 'columns={"T": ...}'),
    (moduli, "f [Hz], E' [MPa], E'' [Pa], tan delta\n1, 3, 0.3, 0.1\n", {},
     "line 2: loss/storage is 1e-07, and tan_delta 0.1", 'columns={"tan_delta": ""}'),
    (relaxation, "t [s], E [MPa]\n1, 0\n", {}, "line 2: E must be positive"),
    (creep, "t [s], D [1/MPa]\n-1, 2\n", {}, "t counts from the step"),
    (arms, "E_j, tau_j\n0.3, 0.01\n0.2, 1\n0.5, inf\n", {}, "shares of the instantaneous", "E_0="),
    (arms, "g_i, k_i, tau_i\n0.3, 0, 0.01\n", {"nu": 0.3, "E_0": 2e6}, "k_j must equal g_j at nu = 0.3"),
    (arms, "E_j, tau_j\n3e6, 0.01\n2e6, inf\n", {"E_0": 5e6}, "leave E_0 out"),
    (arms, "E_inf = 0.5\narms = [[0.3, 0.01], [0.2, 1]]\n", {}, 'E_0 = "3 MPa"'),
    (profile, f"r [um], f [nm]\n{SCAN}10.0, 90\n", {}, "lines 3 and 9 both have r = 1e-05 m; give one, or their mean"),
    (profile, f"r [um], f [nm]\n{SCAN[4:]}", {}, "no point at the tip, r = 0 m; the nearest is at 1e-05 m"),
    (profile, "r [um], f [nm]\n" + SCAN.replace(",", ",-"), {}, "heights fall away from the tip; of a tip that was"),
    (force, "d [nm], F [uN]\n" + CURVE.replace(",", ",-"), {}, "compression must be positive, turn the sign of F"),
    (force, "d [um], F [mN]\n1001, 1\n1002, 2\n1003, 4\n1004, 7\n1005, 11\n1006, 16\n", {},
     "far from 0; give the depth"),
    (force, "d [um], F [mN]\n-10, 0\n0, 1\n10, 3\n", {}, "m, above the surface; give the depth of the first touch"),
    (force, f"d [nm], F [uN]\n{CURVE}80, 40\n", {}, "F must rise more and more steeply"),
]  # fmt: skip
#: reader, text, and words of the one line that warns of it
WARNED = {
    "a footer": (
        record, "t [s],a [g]\n0,1\n1,2\nend of data\nbye\n", "line 4, end of data, and what follows is left out"),
    "letters": (record, "t [s],a [m/s²]\n0,1\n".encode("latin-1"), "line 1 is not UTF-8: letters are read as Latin-1"),
    "a unit": (record, "Zeit [s],Kanal [g]\n0,1\n", "Zeit [s] is read as t; Kanal [g] is read as a_z"),
    "rounded times": (
        record, "t [s],a [g]\n" + "".join(f"{n / 300:.3f},1\n" for n in range(50)), "t is rounded to 0.001 s"),
    "moduli in MPa": (
        moduli, "f [Hz], E' [Pa], E'' [Pa]\n1, 3, 1\n", "storage, read in Pa, is at most 3 Pa, below 200 Pa"),
    "moduli in Pa": (moduli, "f [Hz], E' [MPa], tan delta\n1, 3e7, 1\n", "above 2000 GPa"),
    "an angle in degrees": (moduli, "f [Hz], E' [MPa], tan delta\n1, 3, 12\n", "tan_delta is at most 12, above 5"),
    "arms in MPa": (arms, "E_j, tau_j\n3, 1\n2, inf\n", "the sum of the moduli is at most 5 Pa"),
    "degrees under K": (moduli, "f [Hz], T [K], E' [MPa], tan delta\n1, 20, 3, 0.1\n", "T, read in K, is at most 20 K"),
    "g for m/s²": (record, "t [ms], a [m/s²]\n0, 0.99\n1, 1.01\n", "is it in g and not m/s²?"),
    "m/s² for g": (record, "t [ms], a [g]\n0, 9.7\n1, 9.9\n", "is it in m/s² and not g?"),
    "a count of samples": (
        record, "t [s], a [g]\n0, 1\n1, -2\n2, 3\n", "is the time in ms, or the number of the sample?"),
    "millimetres for metres": (record, "t [s], u_z [m]\n0, 1\n1, 2\n", "u_z, read in m, is at most 2 m, above 10 mm"),
    "a scan in metres": (profile, f"r [m], f [m]\n{SCAN}", "r, read in m, is at most 60 m, above 1 m"),
    "friction in per cent": (friction, "v [m/s], mu\n1, 30\n", "is it in per cent"),
    "an error by another name": (
        friction, "v [mm/s], mu, Streuung\n1, 0.3, 0.01\n", 'columns={"error": "Streuung"}'),
    "velocities in mm/s": (friction, "v [m/s], mu\n500, 0.3\n", "v_0, read in m/s, is at most 500 m/s"),
}  # fmt: skip


def written(folder, text):
    """A file of a text, or of bytes."""
    is_toml = isinstance(text, str) and " = " in text.partition("\n")[0]
    path = folder / ("arms.toml" if is_toml else "data.csv")
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def agree(found, expected):
    columns = found if isinstance(found, dict) else {name: getattr(found, name) for name in expected}
    assert "u_z" not in columns or "u_z" in expected
    for name, values in expected.items():
        assert_allclose(columns[name], values, rtol=1e-14, err_msg=name)


@pytest.mark.parametrize(("read", "text", "given", "expected"), READ.values(), ids=READ)
def test_a_file_is_read_at_first_try(tmp_path, read, text, given, expected):
    agree(read(written(tmp_path, text), **given), expected)


@pytest.mark.parametrize(("read", "text", "given", "expected", "words"), WITH_A_WORD.values(), ids=WITH_A_WORD)
def test_a_file_that_says_too_little_is_read_with_a_word(tmp_path, read, text, given, expected, words):
    path = written(tmp_path, text)
    agree(read(path, **given), expected)
    needed = {name: value for name, value in given.items() if name in ("E_0", "nu")}
    with pytest.raises(ValueError, match=r"data\.csv: ") as refused:
        read(path, **needed)
    assert words in str(refused.value)


@pytest.mark.parametrize(
    ("read", "text", "given", "words"), [(*one[:3], one[3:]) for one in REFUSED], ids=[one[3][:40] for one in REFUSED]
)
def test_what_is_wrong_is_told_with_what_to_write(tmp_path, read, text, given, words):
    path = written(tmp_path, text)
    with pytest.raises(ValueError, match=f"{path.name}: ") as refused:
        read(path, **given)
    told = str(refused.value)
    assert [one for one in words if one not in told] == []
    assert not told.removesuffix("by ;").endswith((":", ";", ","))
    assert all(line.isprintable() and len(line) < 500 for line in told.splitlines())


@pytest.mark.parametrize(("read", "text", "words"), WARNED.values(), ids=WARNED)
def test_a_guess_and_a_size_that_is_hardly_meant_are_told_in_one_line(tmp_path, read, text, words):
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        read(written(tmp_path, text))
    assert [str(one.message).count("\n") for one in told if words in str(one.message)] == [0]
    assert all(issubclass(one.category, mdr.PlausibilityWarning) for one in told)


def test_numbers_of_runs_and_words_are_no_errors(tmp_path):
    path = written(tmp_path, "Run, v [mm/s], mu, n, remark\n1, 1, 0.3, 10, dry\n2, 2, 0.4, 12, dry\n")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert mdr.read_friction_data(path).error is None


@pytest.mark.parametrize("rate", [1600.0, 300.0, 100.0])
def test_times_that_are_even_but_for_rounding_are_even(tmp_path, rate):
    n = np.arange(500)
    told = rows(np.round(n / rate, 3), np.ones(n.size))
    t = mdr.read_record(written(tmp_path, "t [s],a [g]\n" + told))["t"]
    assert_allclose(t, n / rate, atol=5.1e-4)
    assert_allclose(np.diff(t), 1 / rate, rtol=1e-3 * rate / n.size)  # a decimal place over the whole record


@pytest.mark.parametrize("kind", ["jitter", "a lost sample", "three lost ones"])
def test_other_times_are_left_as_they_are(tmp_path, kind):
    n = np.arange(500)
    n = np.delete(n, {"jitter": [], "a lost sample": [250], "three lost ones": [100, 120, 300]}[kind])
    off = np.random.default_rng(2).uniform(-1e-3, 1e-3, n.size) if kind == "jitter" else 0.0
    told = np.round(n / 200 + off, 3)
    assert_allclose(mdr.read_record(written(tmp_path, "t [s],a [g]\n" + rows(told, told)))["t"], told, rtol=1e-14)


def test_blanks_that_may_be_cut_in_two_ways_are_not_cut(tmp_path):
    """Four words of a header above three numbers: none of them is taken for another."""
    path = written(tmp_path, "Time (s) Accel X (g) T (C)\n0 1 20\n1 2 20\n")
    with pytest.raises(ValueError, match="the header names no t"):
        mdr.read_record(path)
    found = mdr.read_record(path, columns={"t": 1, "a_x": 2}, units={"t": "s", "a_x": "g"})
    assert_allclose(found["a_x"], [G, 2 * G])


def dialect(rng, heads, units, numbers):
    """A table in a separator, decimal mark, order, coding and place that are drawn, and the line of its header."""
    by = rng.choice(["\t", ";", ",", "|", "  "])
    mark = "." if by == "," else rng.choice([".", ","])
    order = rng.permutation(len(heads))
    lines = ["Device,7;a", "Rate,1000,Hz", "", "Made: 1.2.2024 12:00"][: rng.integers(5)]
    above, form = len(lines), rng.integers(4)
    cells = [
        [heads[k], f"{heads[k]} [{units[k]}]", f"{heads[k]} ({units[k]})", f"{heads[k]}/{units[k]}"][form]
        for k in order
    ]
    lines.append(by.join(cells))
    if form == 0:
        brackets = rng.choice(["", "[]", "()"])
        lines.append(by.join(f"{brackets[:1]}{units[k]}{brackets[1:]}" for k in order))
    lines += [by.join(f"{row[k]:.6e}".replace(".", mark) for k in order) for row in numbers]
    lines += ["end of file"] * rng.integers(2)
    end = rng.choice(["\n", "\r\n"])
    return end.join([*lines, ""]).encode(rng.choice(["utf-8", "utf-8-sig", "utf-16", "cp1252"])), above


@pytest.mark.parametrize("seed", range(60))
def test_a_table_is_the_same_in_every_dialect(tmp_path, seed):
    """Three columns and two that nobody asked for; no dialect may change a number."""
    rng = np.random.default_rng(seed)
    numbers = rng.normal(size=(rng.integers(1, 9), 5)) * 10.0 ** rng.integers(-3, 4, 5)
    numbers[:, 0] = 0.001 * np.arange(len(numbers)) + 0.5
    units = ["s", rng.choice(["µm", "mm", "microns"]), rng.choice(["g", "m/s^2", "m/s/s", "ms-2"]), "V", "°C"]
    text, above = dialect(rng, ["Time", "u_x", "a_z", "Drive", "T"], units, numbers)
    scales = [1, {"µm": 1e-6, "mm": 1e-3, "microns": 1e-6}[units[1]], G if units[2] == "g" else 1]
    skip = {"skip": above} if rng.integers(2) else {}
    found = mdr.read_record(written(tmp_path, text), **skip)
    assert found.keys() == {"t", "u_x", "a_z"}
    for k, name in enumerate(("t", "u_x", "a_z")):
        assert_allclose(found[name], scales[k] * np.array([float(f"{row[k]:.6e}") for row in numbers]), rtol=1e-12)


def test_a_rate_beside_times_that_say_another_is_told(tmp_path):
    """A date and a clock, which are no times in seconds, are passed over in silence."""
    forms = {
        "Time (s)": ("{:.4f}", 5e-4, True),
        "Stamp": ("2024-05-01 12:00:{:06.3f}", 5e-4, False),
        "Time [s]": ("{:.3f}", 1.04e-3, False),  # rounded
        "t [s]": ("{:.0f}", 1e-3, False),  # to whole seconds
    }
    for head, (stamp, step, told) in forms.items():
        rows = "".join(f"{stamp.format(step * k)};{k % 3}\n" for k in range(9))
        path = written(tmp_path, f"{head};Ch 1 (g)\n{rows}")
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            record = mdr.read_record(path, rate=1000.0, columns={"a_z": "Ch 1"})
        assert_allclose(np.diff(record["t"]), 1e-3)
        if head == "Stamp":
            with pytest.raises(ValueError, match="but a time of day: write seconds, or of even steps give rate="):
                mdr.read_record(path, columns={"t": "Stamp"}, units={"t": "s"})
        words = "its t goes over 4 ms, at this rate over 8 ms: the rate is taken"
        assert [words in str(one.message) for one in said] == [True] * told


def test_a_refusal_shows_the_lines_all_faults_and_what_to_give(tmp_path):
    path = written(tmp_path, "Logger 3\nTime;Ch 1;Ch 2\n0,0;0,1;x\n0,1;0,2;y\n")
    with pytest.raises(ValueError, match=r"data\.csv: ") as refused:
        mdr.FromForce.read(path, E_star=1e6, columns={"d": "Ch 1", "F": "Ch 3"})
    assert str(refused.value).replace(str(path), "data.csv").splitlines() == [
        "data.csv: the header names no Ch 3; columns= must name one of these",
        "data.csv: d needs a unit in its header, one of m, cm, mm, um, nm, Å, inch",
        "  line 2: Time | Ch 1 | Ch 2",
        "  line 3: 0,0 | 0,1 | x",
        "  line 4: 0,1 | 0,2 | y",
        '  to read it as it is: columns={"d": "Ch 1", "F": ...}, units={"d": ...}',
    ]
    with pytest.raises(ValueError, match=r"line 3: x is .*\n.*line 4: y is no number"):
        mdr.read_record(path, columns={"t": "Time", "a_x": 2, "a_z": 3}, units={"t": "s", "a_x": "g", "a_z": "g"})
