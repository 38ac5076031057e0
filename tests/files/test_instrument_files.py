"""Files as instruments, loggers, spreadsheets and people write them, with made-up rows: read right at first try or as a
refusal says, refused in words, or read with a warning.
"""

import contextlib
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
FLOWS = {**ARMS, "E_inf": 0.0}
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
    "phone app, tabs and decimal commas": (
        record, PHONE.replace(",", "\t") + "\n0\t0,1\t0,3\t0,5\n0,01\t0,2\t0,4\t0,6\n", {}, ACCELERATED),
    "German spreadsheet": (
        record, "sep=;\nZeit [s];Beschleunigung [m/s²]\n0,000;0,12\n0,001;-1,5\n".encode("cp1252"), {},
        {"t": [0, 1e-3], "a_z": [0.12, -1.5]}),
    "spreadsheet, Unicode text": (
        record, "Time [ms]\tDisplacement [µm]\tDrive [V]\n0\t1\t5\n1\t2\t5\n".encode("utf-16"),
        {"columns": {"u_z": "Displacement"}},
        {"t": [0, 1e-3], "u_z": [1e-6, 2e-6]}),
    "shaker, times rounded to ms": (
        record, "t [s],a [g]\n" + rows(np.round(np.arange(400) / 1600, 3), np.ones(400)), {}, {"a_z": np.full(400, G)}),
    "logger, letters for axes": (
        record, "time [s],x [g],y [g],z [g]\n0,0.1,0.2,1\n", {}, {"a_x": [0.1 * G], "a_y": [0.2 * G], "a_z": [G]}),
    "finite elements, g_i": (arms, "g_i, k_i, tau_i\n0.3, 0.3, 0.01\n0.2, 0.2, 1\n", {"E_0": 2e6}, ARMS),
    "arms, decimal commas": (arms, "E_j [MPa];tau_j [s]\n0,6;0,01\n0,4;1\n1,0;inf\n", {}, ARMS),
    "arms, blanks": (
        arms, "Shear modulus (kPa)  Relaxation time (ms)\n200  10\n133.33333333333334  1000\n"
        "333.3333333333333  inf\n", {}, ARMS),
    "tribometer, decimal commas": (
        friction, "Probe 7\nDatum;1.2.2024\nv (mm/s);COF\n0,5;0,31\n1,0;0,35\n", {}, FRICTION),
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
    "one isotherm": (moduli, ISOTHERMS, {"temperature": 20}, AT_20),
    "isotherms in K": (moduli, "f [Hz], Temperature [K], E' [MPa], tan delta\n1, 263, 40, 0.2\n1, 293.2, 8, 0.2\n",
                       {"temperature": 20}, {"storage": [8e6]}),
    "master curve": (moduli, "f [Hz], T [C], E' [MPa], E'' [MPa]\n1, 50, 4, 1\n1e3, 20, 8, 2\n", {"columns": {"T": ""}},
                     {"storage": [4e6, 8e6]}),
    "relaxation": (relaxation, "t [s], E [MPa]\n0.1, 3\n1, 2\n10, 1.5\n", {}, RELAXED),
    "relaxation, units below": (
        relaxation, "Probe 3\nTime;E(t)\nms;kPa\n100,0;3000,0\n1000,0;2000,0\n10000,0;1500,0\n", {}, RELAXED),
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
    "profile, slashes alone": (profile, f"x/um,z/nm\n{SCAN}", {}, SHAPE),
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
    "forces beside a COF are not looked at": (
        friction, "v [mm/s],mu,Fx [V],Fz [N],normal force [N]\n1,0.3,,,\n", {}, {"v_0": [1e-3], "cof": [0.3]}),
    "forces without units": (
        friction, "v [mm/s],Ft,Fn\n1,3,10\n", {"units": {"F_t": "N", "F_n": "N"}}, {"v_0": [1e-3], "cof": [0.3]}),
    "friction in per cent": (friction, "v [mm/s], mu [%], V [V]\n1, 30, 2\n", {}, {"v_0": [1e-3], "cof": [0.3]}),
}  # fmt: skip
#: the same for forms that say too little; the words are those of the refusal without what is given
WITH_A_WORD = {
    "phone app without units": (
        record, "time,gFx,gFy,gFz,TgF\n0,0.1,0.2,1,1.02\n0.01,0.2,0.1,1,1.02\n",
        {"columns": {"a_x": "gFx", "a_y": "gFy", "a_z": "gFz"}, "units": {"t": "s", **AXES}},
        {"a_x": [0.1 * G, 0.2 * G], "a_z": [G, G]}, "columns={"),
    "number of the sample": (
        record, "Sample,Accel (g)\n1,0.1\n2,0.2\n3,0.3\n", {"rate": 1e3},
        {"t": [0, 1e-3, 2e-3], "a_z": [0.1 * G, 0.2 * G, 0.3 * G]}, "rate="),
    "moduli in other words": (
        moduli, "Frequenz [Hz];Speichermodul [MPa];Verlustmodul [MPa]\n1,0;3,0;0,3\n10,0;4,0;0,8\n",
        {"columns": {"storage": "Speichermodul", "loss": "Verlustmodul"}}, MODULI,
        'columns={"storage": ..., "loss": ...}'),
    "friction without units": (
        friction, "velocity,mu\n0.5,0.31\n1.0,0.35\n", {"units": {"v_0": "mm/s"}}, FRICTION, 'units={"v_0": '),
}  # fmt: skip


SHEAR = {"omega": HZ * np.array([1.0, 10, 100]), "storage": [9e6, 12e6, 15e6], "loss": [9e5, 2.4e6, 4.5e6]}  # nu = 0.5
TENSION = {name: SHEAR["omega"] if name == "omega" else np.array(SHEAR[name]) / 3 for name in SHEAR}
HERTZ, W, STORAGE, LOSS = SHEAR["omega"] / HZ, SHEAR["omega"], 1e-6 * TENSION["storage"], 1e-6 * TENSION["loss"]  # MPa
TAN, n, o, N = LOSS / STORAGE, np.arange(1.0, 4), np.ones(3), {"nu": 0.5}
TIMES, A = 1e-3 * np.arange(4), np.array([0.1, -0.2, 0.3, 0.1])
ACC, MS2 = {"t": TIMES, "a_z": A * G}, {"t": TIMES, "a_z": A}
X, H, D, P = 1e6 * RADII, 1e6 * HEIGHTS, 1e9 * DEPTHS, 1e6 * FORCES  # um, um, nm, uN
V, MU = np.array([0.5, 1.0, 2.0]), np.array([0.31, 0.35, 0.4])
COF = {"v_0": V * 1e-3, "cof": MU}
tabs, curve = partial(rows, by="\t"), mdr.read_force_curve
STEPS = "".join(
    f"[step]\nFrequency sweep - {k}\nAngular frequency\tStorage modulus\tLoss modulus\tOscillation torque\n"
    "rad/s\tMPa\tMPa\tuN.m\n" + tabs(W, k * STORAGE, LOSS, o) + "\n"
    for k in (1, 2)
)
#: forms of instruments, with made-up rows: reader, text, what is given, what is right at once, or with what the refusal
#: prints to be copied; None where the file says too little: it is refused, and what is printed has `...`
INSTRUMENTS = {
    # --- rheometers and DMA
    "TA Trios, rheometer": (moduli, ("Filename\tPDMS 10k\nInstrument name\tDHR-2\n\n[step]\nFrequency sweep - 1\n"
        "Angular frequency\tStorage modulus\tLoss modulus\tTan(delta)\tOscillation torque\tTemperature\n"
        "rad/s\tMPa\tMPa\t\tN.m\t°C\n") + tabs(W, STORAGE, LOSS, TAN, 1e-5 * o, 25 * o), N, SHEAR),
    "TA Trios, DMA850": (moduli, ("Filename\tbar 3\nInstrument name\tDMA850\nGeometry name\tDual cantilever\n[step]\n"
        "Frequency sweep\nFrequency\tStorage modulus\tLoss modulus\tTan delta\tTemperature\n" "Hz\tMPa\tMPa\t\t°C\n")
        + tabs(HERTZ, STORAGE, LOSS, TAN, 25 * o), {}, TENSION),
    "TA Trios, two steps": (moduli, STEPS, N, None),
    "TA Trios, two steps, the first": (moduli, STEPS, {**N, "table": "sweep - 1"}, SHEAR),
    "RheoCompass": (moduli, ("Project:\tPDMS\nTest:\tSweep\nResult:\t\nInterval and data points:\t1\t3\n\n"
        "Interval data:\tPoint No.\tAngular Frequency\tStorage Modulus\tLoss Modulus\tLoss Factor\tTorque\n"
        "\t\t[rad/s]\t[Pa]\t[Pa]\t[1]\t[mN·m]\n") + "".join("\t" + line + "\n" for line in tabs(n, W, 1e6 * STORAGE,
        1e6 * LOSS, TAN, o).splitlines()), N, SHEAR),
    "RheoCompass, 1/s": (moduli, ("Point No.\tAngular Frequency\tStorage Modulus\tLoss Modulus\tTorque\n"
        "\t[1/s]\t[Pa]\t[Pa]\t[mN·m]\n") + tabs(n, W, 1e6 * STORAGE, 1e6 * LOSS, o), N, None),
    "Rheoplus, semicolons": (moduli, (
        "Meas. Pts.;Frequency;Storage Modulus;Loss Modulus;Viscosity\n;[Hz];[Pa];[Pa];[Pa·s]\n") + tabs(n, HERTZ, 1e6
        * STORAGE, 1e6 * LOSS, o, by=";", mark=","), N, SHEAR),
    "RheoWin": (moduli, "f in Hz;ω in rad/s;G' in Pa;G'' in Pa;|G*| in Pa;tan(δ) in -;δ in °\n" + tabs(HERTZ, W, 1e6 *
        STORAGE, 1e6 * LOSS, 1e6 * np.hypot(STORAGE, LOSS), TAN, np.degrees(np.arctan(TAN)), by=";", mark=","), {**N,
        "columns": {"omega": "f"}}, SHEAR),
    "Reptate": (moduli, ("T=-30;Mw=13.5;chem=PI;\nw\tG'\tG''\tTemp\tg\td\th*\nrad/s\tPa\tPa\tC\t%\tdeg\tPa-s\n") +
        tabs(W, 1e6 * STORAGE, 1e6 * LOSS, -30 * o, o, 9 * o, 5 * o), N, SHEAR),
    "Reptate, fewer cells": (moduli, ("T=-30;Mw=13.5;\nw\tG'\tG\"\tTemp\tg\td\th*\nrad/s\tPa\tPa\tC\t%\tdeg\tPa-s\n")
        + tabs(W, 1e6 * STORAGE, 1e6 * LOSS, -30 * o, o, by=" "), N, SHEAR),
    "Mettler STARe": (moduli, ("Curve Name:\n  Sample 3\nCurve Values:\n"
        "    Index           Frequency              E'             E''\n"
        "                         [Hz]           [MPa]           [MPa]\n") + "".join(
        f"        {k}         {a:.5f}         {b:.5f}       {c:.5f}\n" for k, a, b, c in zip(range(3), HERTZ, STORAGE,
        LOSS, strict=True)), {}, None),
    "Netzsch Proteus": (moduli, ("#EXPORTTYPE:DATA ALL\n#DECIMAL:COMMA\n#SEPARATOR:SEMICOLON\n"
        "##Temp./°C;f/Hz;E'/MPa;E''/MPa;tan d\n") + tabs(20 * o, HERTZ, STORAGE, LOSS, TAN, by=";", mark=","), {},
        TENSION),
    "Gabo Eplexor": (moduli, "No.;Freq. [Hz];Temp [°C];|E*| [MPa];E' [MPa];E'' [MPa];tan delta\n" + tabs(n, HERTZ, 20
        * o, np.hypot(STORAGE, LOSS), STORAGE, LOSS, TAN, by=";"), {}, TENSION),
    "|E*| and phase": (moduli, "Frequency (Hz),|E*| (MPa),Phase (deg)\n" + tabs(HERTZ, np.hypot(STORAGE, LOSS), np.
        degrees(np.arctan2(LOSS, STORAGE)), by=","), {}, TENSION),
    "|G*| and phase angle": (moduli, "Frequency (Hz)\tComplex shear modulus (Pa)\tPhase angle (°)\n" + tabs(HERTZ, 1e6
        * np.hypot(STORAGE, LOSS), np.degrees(np.arctan2(LOSS, STORAGE))), N, SHEAR),
    "asphalt: dynamic modulus": (moduli, "Frequency (Hz),Dynamic modulus (MPa),Phase angle (deg)\n" + tabs(HERTZ, np.
        hypot(STORAGE, LOSS), np.degrees(np.arctan2(LOSS, STORAGE)), by=","), {}, None),
    "name / unit": (moduli, "Frequency / Hz\tE' / MPa\tE'' / MPa\n" + tabs(HERTZ, STORAGE, LOSS), {}, TENSION),
    "names over / units": (moduli, "Frequency,E',E''\n/ Hz,/ MPa,/ MPa\n" + tabs(HERTZ, STORAGE, LOSS, by=","), {},
        TENSION),
    "units over names": (moduli, "Hz,MPa,MPa\nf,E',E''\n" + tabs(HERTZ, STORAGE, LOSS, by=","), {}, TENSION),
    "Origin: long name, units, comments": (moduli, "Frequency\tE'\tE''\nHz\tMPa\tMPa\nrun 3\trun 3\trun 3\n" + tabs(
        HERTZ, STORAGE, LOSS), {}, TENSION),
    "units at the ends": (moduli, "freq_Hz,E'_MPa,tan_delta\n" + tabs(HERTZ, STORAGE, TAN, by=","), {}, TENSION),
    "R: dots": (moduli, "Frequency..Hz.,Storage.modulus..MPa.,Loss.modulus..MPa.\n" + tabs(HERTZ, STORAGE, LOSS, by=
        ","), {}, None),
    "pandas, an index": (moduli, ",f [Hz],E' [MPa],E'' [MPa]\n" + tabs(np.arange(3.0), HERTZ, STORAGE, LOSS, by=","),
        {}, TENSION),
    "R, names of rows": (moduli, "f,E1,E2\n" + tabs(n, HERTZ, STORAGE, LOSS, by=","), {"columns": {"omega": "f",
        "storage": "E1", "loss": "E2"}, "units": {"omega": "Hz", "storage": "MPa", "loss": "MPa"}}, None),
    "logarithms": (moduli, ("log f [Hz],log E' [Pa],log E'' [Pa]\n" "0.5,6.31,5.3\n" "1,6.35,5.5\n"), {}, None),
    "logarithms, by number": (moduli, "log f [Hz],log E' [Pa],log E'' [Pa]\n0.5,6.31,5.3\n", {"columns": {"omega": 1,
        "storage": 2, "loss": 3}}, None),
    "log10(ω)": (moduli, "log10(ω),log10(G'),log10(G'')\n0.5,6.31,5.3\n1,6.35,5.5\n", N, None),
    "storage modulus alone": (moduli, "Frequency (Hz),Storage modulus (MPa),Loss modulus (MPa)\n" + tabs(HERTZ,
        STORAGE, LOSS, by=","), {}, None),
    "comments, numpy": (moduli, "# DMA of sheet 4\n# f [Hz], E' [MPa], E'' [MPa]\n" + tabs(HERTZ, STORAGE, LOSS, by=
        " "), {}, TENSION),
    "BOM, CRLF, commas in quotes": (moduli, ("\ufeff\"f [Hz]\",\"E' [MPa]\",\"E'' [MPa]\"\r\n" + tabs(HERTZ, STORAGE,
        LOSS, by='","').replace("\n", '"\r\n').replace("\n", '\n"').join(['"', ""]).rstrip('"')).encode(), {},
        TENSION),
    "a table of tan delta in degrees": (moduli, "f [Hz],E' [MPa],tan delta [deg]\n" + tabs(HERTZ, STORAGE, np.degrees(
        np.arctan(TAN)), by=","), {}, None),
    # --- arms
    "Abaqus, keyword": (arms, ("*MATERIAL, NAME=RUBBER\n*VISCOELASTIC, TIME=PRONY\n0.3, 0.3, 0.01\n0.2, 0.2, 1.\n"), {
        "E_0": 2e6}, None),
    "Abaqus CAE": (arms, ("g_i Prony, k_i Prony, tau_i Prony\n0.3, 0.3, 0.01\n0.2, 0.2, 1\n"), {"E_0": 2e6}, None),
    "Ansys, workbench": (arms, ("Index\tRelative Moduli\tRelaxation Time (s)\n1\t0.3\t0.01\n2\t0.2\t1\n"), {"E_0": 2e6
        }, ARMS),
    "COMSOL": (arms, ("Branch,Gm (MPa),taum (s)\n" "1,0.2,0.01\n" "2,0.13333333333333333,1\n"), {}, FLOWS),
    "shear, suffixes": (arms, ("G_i_MPa,tau_i_ms\n0.2,10\n0.13333333333333333,1000\n0.3333333333333333,inf\n"), {},
        ARMS),
    "arms, rates": (arms, "G_i [MPa],beta_i [1/s]\n0.2,100\n0.13333333333333333,1\n", {}, FLOWS),
    "arms, rates of other times": (arms, "E_i [MPa],beta_i [1/s],tau_i [s]\n0.2,100,0.02\n", {}, None),
    # --- records
    "phyphox": (record,
        PHONE + ',"Absolute acceleration (m/s^2)"\n'
        + tabs(TIMES, A, A, A, A, by=","), {}, {**MS2, "a_x": A, "a_y": A}),
    "Polytec, velocity": (record, ("Vibrometer\nSource File Name\tscan.svd\nPoint Index\t1\n\nTime\tVelocity\n"
        "[ s ]\t[ m/s ]\n") + tabs(TIMES, A), {}, None),
    "Polytec, displacement": (record, (
        "Source File Name\tscan.svd\nSignal\tTime Signal\n\nTime\tDisplacement\n[ s ]\t[ m ]\n") + tabs(TIMES, 1e-6 *
        A), {"columns": {"u_z": "Displacement"}}, {"t": TIMES, "u_z": 1e-6 * A}),
    "PCB logger": (record, ("PCB 352C33,SN 1234\nDate,1/2/2024\nSample rate,1000,Hz\nSensitivity,100,mV/g\n\n"
        "Time (s),Channel 1 (g)\n") + tabs(TIMES, A, by=","), {}, ACC),
    "a voltage": (record, "Time (s),Ch1 (mV)\n" + tabs(TIMES, 100 * A, by=","), {}, None),
    "PicoScope": (record, "Time,Channel A\n(ms),(mV)\n\n" + tabs(1e3 * TIMES, A, by=","), {}, None),
    "LabVIEW, one channel": (record, ("LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\n"
        "Decimal_Separator\t.\nMulti_Headings\tNo\nX_Columns\tOne\n***End_of_Header***\t\n\t\n"
        "Channels\t1\t\nSamples\t4\t\nDate\t2024/02/01\t\nTime\t12:00:00.5\t\n"
        "Y_Unit_Label\tm/s^2\t\nX_Dimension\tTime\t\nX0\t0.0000000000000000E+0\t\n"
        "Delta_X\t0.001000\t\n***End_of_Header***\t\t\nX_Value\tAcceleration\tComment\n") + "".join(
        f"{a:.6f}\t{b:.6f}\n" for a, b in zip(TIMES, A, strict=True)),
        {"columns": {"t": "X_Value"}, "units": {"t": "s"}}, MS2),
    "LabVIEW, two channels": (record, ("LabVIEW Measurement\t\n***End_of_Header***\t\nChannels\t2\t\t\n"
        "Y_Unit_Label\tg\tVolts\t\nX_Dimension\tTime\tTime\t\nX0\t0.0E+0\t0.0E+0\t\n"
        "Delta_X\t0.001000\t0.001000\t\n***End_of_Header***\t\t\t\n" "X_Value\tTip\tDrive\tComment\n") + "".join(
        f"{a:.6f}\t{b:.6f}\t5.000\t\n" for a, b in zip(TIMES, A, strict=True)),
        {"columns": {"t": "X_Value", "a_z": "Tip"}, "units": {"t": "s"}}, ACC),
    "NI SignalExpress": (record, "Channel name,Time,Accel\nUnit,s,g\n" + "".join(f"{k},{a:g},{b:g}\n" for k, a, b in
        zip(range(4), TIMES, A, strict=True)), {}, ACC),
    "Testlab": (record, ("Frequency response\nX unit:,s\nY unit:,g\n\nTime,Tip:+Z\ns,g\n") + tabs(TIMES, A, by=","), {
        }, ACC),
    "oscilloscope, second,Volt": (record, "x-axis,1\nsecond,Volt\n" + tabs(TIMES, A, by=","), {}, None),
    "MATLAB writetable": (record, "Time_s,Acc_g\n" + tabs(TIMES, A, by=","), {}, ACC),
    "pandas, time first": (record, "time,acc_x,acc_y,acc_z\n" + tabs(TIMES, A, A, A, by=","), {"units": dict.fromkeys(
        ("a_x", "a_y", "a_z"), "g") | {"t": "s"}}, {**ACC, "a_x": A * G}),
    "enDAQ": (record, '"Time","X (2000g)","Y (2000g)","Z (2000g)"\n' + tabs(TIMES, A, A, A, by=","), {}, None),
    "axis in brackets": (record, "Time [s],Accel (g) X,Accel (g) Z\n" + tabs(TIMES, A, A, by=","), {}, {**ACC, "a_x":
        A * G}),
    "cut by tabs with padded blanks": (record, "Time (s)  \t  Acc Z (g)\n" + "".join(f"  {a:.4f} \t {b:9.4f} \n" for
        a, b in zip(TIMES, A, strict=True)), {}, ACC),
    "a table of stamps": (record, "Stamp;Acc Z (g)\n" + "".join(f"2024-05-01 12:00:00.{k:03d};{b:g}\n" for k, b in
        enumerate(A)), {"rate": 1e3}, ACC),
    "fretting": (record, "Time [s],Displacement [um],Friction force [mN]\n" + tabs(TIMES, A, A, by=","), {},
                 {"u_x": 1e-6 * np.array(A)}),
    # --- profiles
    "Keyence, Shift-JIS": (profile, ('"Horizontal distance","Height"\n"μm","μm"\n' + "".join(f'"{a:.3f}","{b:.4f}"\n'
        for a, b in zip(X, H, strict=True))).encode("shift_jis"), {}, SHAPE),
    "Keyence, with a preamble": (profile, ('"Profile graph"\n"Measurement length","60.0","um"\n"Points","7"\n\n'
        '"No.","Horiz. distance","Height"\n"","um","um"\n') + "".join(f'"{k}","{a:.3f}","{b:.4f}"\n' for k, (a, b) in
        enumerate(zip(X, H, strict=True), 1)), {}, SHAPE),
    "Dektak": (profile, ("DATE,2/1/2024\nSclen,60.0,um\nUnits,um,A\n\nLateral um,Raw A\n") + "".join(
        f"{a:.3f},{1e4 * b:.4f},\n" for a, b in zip(X, H, strict=True)), {}, None),
    "Dektak, brackets": (profile, ("Scan Length, 60 um\nMeas Type, Hills\nLateral(µm),Total Profile(Å)\n") + tabs(X,
        1e4 * H, by=","), {}, SHAPE),
    "Zygo XYZ, No Data": (profile, "".join(f"{k} 0 {'No Data' if k in (3, 5) else f'{b:.4f}'}\n" for k, b in enumerate
        (H)), {"columns": {"r": 1, "f": 3}, "units": {"r": "um", "f": "um"}}, None),
    "Gwyddion": (profile, "# x [m] y [m]\n" + tabs(1e-6 * X, 1e-6 * H, by=" "), {}, None),
    "Gwyddion, z": (profile, "x [m]  z [m]\n" + tabs(1e-6 * X, 1e-6 * H, by="  "), {}, SHAPE),
    "Mitutoyo": (profile, "// Formtracepak\nSample,ball\nX(mm),Z(um)\n" + tabs(1e-3 * X, H, by=","), {}, SHAPE),
    "MarSurf": (profile, "Profile;R\nx[mm];z[µm]\n" + tabs(1e-3 * X, H, by=";", mark=","), {}, SHAPE),
    "no header": (profile, tabs(X, H), {}, None),
    "two lengths": (profile, "Weg [um];Hoehe [um]\n" + tabs(X, H, by=";"), {}, None),
    # --- force curves
    "JPK": (curve, ('# xPosition: 1e-5\n# springConstant: 0.05\n' '# columns: indentation vDeflection height\n'
        '# fancyNames: "Indentation" "Vertical deflection" "Height (measured)"\n' '# units: m N m\n') + tabs(1e-9 * D,
        1e-6 * P, -1e-9 * D, by=" "), {}, PRESS),
    "Hysitron": (curve, ("Number of Points = 8\n\nDepth (nm)\tLoad (µN)\tTime (s)\tDepth (V)\tLoad (V)\n") + tabs(D,
        P, D, D, P), {}, PRESS),
    "units at the ends, force": (curve, "depth_nm,load_uN\n" + tabs(D, P, by=","), {}, PRESS),
    "Bruker": (curve, "Calc_Ramp_Ex_nm\tCalc_Ramp_Rt_nm\tDefl_pN_Ex\tDefl_pN_Rt\n" + tabs(D, D, 1e6 * P, 1e6 * P), {},
        None),
    "Optics11": (curve, ("Date\t1/2/2024\nTip radius (um)\t50.0\n\n"
        "Time (s)\tLoad (uN)\tIndentation (nm)\tCantilever (nm)\tPiezo (nm)\n") + tabs(D, P, D, D, D), {}, PRESS),
    "Instron": (curve, '"Time","Extension","Load"\n"(s)","(mm)","(N)"\n' + "".join(
        f'"{t:g}","{1e-6 * a:g}","{1e-6 * b:.17g}"\n' for t, a, b in zip(D, D, P, strict=True)),
        {"columns": {"d": "Extension"}}, PRESS),
    "G200, a footer": (curve, ("Displacement Into Surface,Load On Sample,Time On Sample\nnm,mN,s\n") + tabs(D, 1e-3 *
        P, D, by=",") + "END\n", {"columns": {"d": "Displacement Into Surface", "F": "Load On Sample"}}, PRESS),
    "a piezo's height": (curve, "Height (nm)\tForce (nN)\n" + tabs(D, 1e3 * P), {"columns": {"d": "Height"}}, PRESS),
    # --- friction
    "CETR": (friction, "Speed (mm/s)\tFx (N)\tFz (N)\tCOF\n" + tabs(V, MU, o, MU), {}, COF),
    "Rtec": (friction, "Step,Velocity,Fz,Fx,COF\n,mm/s,N,N,\n" + tabs(n, V, o, MU, MU, by=","), {}, COF),
    "TriboLab": (friction, ("Test: run 3\nUnits: mm/s\tN\t\nVelocity\tFz\tCOF\nmm/s\tN\t-\n") + tabs(V, o, MU), {},
        COF),
    "rpm": (friction, "Speed [rpm],Friction coefficient\n1,0.32\n10,0.43\n", {}, None),
    "torque": (friction, "velocity_rad_s,torque_Nm\n-1,-1.07\n1,1.07\n", {}, None),
    "MTM": (friction, "Rolling Speed (mm/s);Traction Coeff (-)\n" + tabs(V, MU, by=";", mark=","), {"columns": {"cof":
        "Traction Coeff"}}, COF),
    "forces": (friction, "v [mm/s],Ft [N],Fn [N]\n" + tabs(V, MU, o, by=","), {}, COF),
    "a short row": (friction, "v [mm/s],n,mu\n0.5,3,0.31\n1,4\n2,3,0.4\n", {}, None),
    "a mean below": (friction, "v [mm/s],mu\n" + tabs(V, MU, by=",") + "Mean,0.35\n", {}, None),
    "an index of pandas, whole numbers for names": (moduli, ",0,1,2\n" + tabs(np.arange(3.0), HERTZ, STORAGE, LOSS, by
        =","), {"columns": {"omega": 2, "storage": 3, "loss": 4}, "units": {"omega": "Hz", "storage": "MPa", "loss":
        "MPa"}}, None),
    "Kinexus": (moduli, "Frequency(Hz),Shear modulus (elastic component)(Pa),Shear modulus (viscous component)(Pa)\n"
        + tabs(HERTZ, 1e6 * STORAGE, 1e6 * LOSS, by=","), {**N, "columns": {"G'": 2, "G''": 3}}, SHEAR),
    "relaxation of a rheometer": (relaxation, ("[step]\nStress relaxation\nStep time\tG(t)\tStrain\ns\tkPa\t%\n") +
        tabs(np.array([0.1, 1, 10]), np.array([1000.0, 700, 500]), o), N, {"t": [0.1, 1, 10], "modulus": [3e6, 2.1e6,
        1.5e6]}),
    "nu of a modulus in tension": (relaxation, "t [s],E [MPa]\n0.1,3\n1,2\n", N, None),
    "nu of E'": (moduli, "f [Hz],E' [MPa],tan delta\n" + tabs(HERTZ, STORAGE, TAN, by=","), N, None),
    "E' and G'": (moduli, "f [Hz],E' [MPa],E'' [MPa],G' [MPa],G'' [MPa]\n" + tabs(HERTZ, STORAGE, LOSS, STORAGE / 3,
        LOSS / 3, by=","), {}, None),
    "a header again amid the rows": (friction, "v [mm/s],mu\n0.5,0.31\nv [mm/s],mu\n1,0.35\n", {}, None),
    "UTF-16 without a mark": (record, ("Time [ms]\tAcc Z [g]\n" + tabs(1e3 * TIMES, A)).encode("utf-16-le"), {}, ACC),
    "thousands by apostrophes": (record, "t [us],a_z [g]\n0,0.1\n1'000,-0.2\n2'000,0.3\n3'000,0.1\n", {}, None),
    "a column of times of day": (record, "Time,Acc Z (g)\n12:00:00.000,0.1\n12:00:00.001,-0.2\n", {}, None),
    "percent": (friction, "Speed (mm/s),mu (%)\n" + tabs(V, 100 * MU, by=","), {}, COF),
    "Polytec, velocity, named": (record, "Time\tVelocity\n[ s ]\t[ mm/s ]\n" + tabs(TIMES, 1e3 * A), {"columns": {
        "v_z": "Velocity"}}, {"t": TIMES, "v_z": A}),
    "a workbook": (record, b"PK\x03\x04\x14\x00\x06\x00" + bytes(range(256)), {}, None),
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
     "b [V] is a voltage: say of which quantity", "sensitivity="),
    (profile, f"Weg in um;Hoehe in um\n{SCAN.replace(',', ';')}", {}, "no r and no f", "Weg in um", 'columns={"r"'),
    (profile, f"r [um], f\n{SCAN}", {"units": {"f": "yard"}}, "units: f = 'yard' is none of m, cm"),
    (profile, f"r [um], f\n{SCAN}", {"units": {"r": "mm", "f": "nm"}}, "gives r in um, units= in mm; give one"),
    (profile, f"r [um], f\n{SCAN}", {"columns": {"f": "Z"}}, "the header names no Z; columns= must name one of these"),
    (moduli, "f [Hz], E' [mPa], E'' [mPa]\n1, 3, 0.3\n", {}, "'mPa' of storage is none of Pa, kPa, MPa, GPa"),
    (moduli, "f [Hz], E' [MPa]\n1, 3\n", {}, "neither loss modulus, tan delta nor phase"),
    (moduli, "f [Hz], G' [MPa], G'' [MPa]\n1, 3, 0.3\n", {}, "G' is of shear and needs Poisson's ratio: give nu="),
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


@pytest.mark.parametrize(("read", "text", "given", "right"), INSTRUMENTS.values(), ids=INSTRUMENTS)
def test_no_form_of_an_instrument_is_read_or_copied_wrong(tmp_path, read, text, given, right):
    found = as_copied(read, written(tmp_path, text), given)
    assert (found is None) == (right is None)
    agree(found or {}, right or {})


def as_copied(read, path, given):
    """What is read at once, or by copying what refusals print; None where nothing complete is printed."""
    for _ in range(3):
        with contextlib.suppress(ValueError):
            return read(path, **given)
        with pytest.raises(ValueError, match=r"data\.csv: ") as refused:
            read(path, **given)
        said = eval(f"dict({str(refused.value).partition('to read it as it is: ')[2]})", {})  # as its reader types it
        cells = [one for one in said.get("columns", {}).values() if one not in ("", ...)]
        assert len(set(cells)) == len(cells)
        if not said or any(... in ([one] if one is ... else one.values()) for one in said.values()):
            return None
        given = {**given, **{key: {**given.get(key, {}), **one} for key, one in said.items()}}
    return None


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


@pytest.mark.parametrize(("by", "mark"), [(",", "."), ("\t", ","), (" ", ".")])
def test_a_long_table_is_that_of_its_rows(tmp_path, by, mark):
    """Parsed at once; one row with a fault in the midst is found, and one that is lost is not passed over."""
    t, a = 1e-3 * np.arange(3000), np.random.default_rng(0).normal(size=3000)
    lines = (f"t [s]{by}a_z[g]\n" + rows(t, a, by=by, mark=mark)).splitlines(keepends=True)
    record = mdr.read_record(written(tmp_path, "".join(lines)))
    assert_allclose([record["t"], record["a_z"] / G], [t, a], rtol=1e-14)
    for fault in (f"2{mark}5\n", f"2{mark}5{by}No Data\n", f"2{mark}5{by}1{by}1\n"):
        path = written(tmp_path, "".join([*lines[:2501], fault, *lines[2502:]]))
        with pytest.raises(ValueError, match=r"data\.csv: line 2502: "):
            mdr.read_record(path)


def test_one_of_several_tables_is_chosen_by_its_number_or_by_words_above_it(tmp_path):
    text = "".join(f"Run {k}\nv [mm/s];mu\n1;0,{k}\n2;0,{k + 1}\n" for k in (3, 5))
    path = written(tmp_path, text)
    for table, cof in ((1, [0.3, 0.4]), (2, [0.5, 0.6]), ("run 5", [0.5, 0.6])):
        assert_allclose(mdr.read_friction_data(path, table=table).cof, cof)
    for table, words in ((None, "holds 2 tables"), (3, "names none of 2 tables"), ("run", "names several of 2 tables")):
        with pytest.raises(ValueError, match=f'{words}, choose one: table=1, lines 3 to 4, below "Run 3"; table=2'):
            mdr.read_friction_data(path, table=table)
