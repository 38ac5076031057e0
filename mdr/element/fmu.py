"""The contact as a co-simulation unit of FMI 2.0, which most hosts know: a ZIP file of description, code and sources.

The unit is C code around the header of c_header.py, compiled by what CC names, or by a compiler of the machine.
"""

from __future__ import annotations

import os
import shlex
import struct
import subprocess
import sys
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from shutil import which
from tempfile import TemporaryDirectory
from xml.etree import ElementTree
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from mdr.element.c_header import filled, header
from mdr.element.contact_element import ContactElement
from mdr.tools.version import __version__

COMPILERS = ("cc", "gcc", "clang")  #: where CC names none
FLAGS = ("-std=c99", "-O2", "-fPIC", "-shared", "-fvisibility=hidden")
ENDS = {"linux": "so", "darwin": "dylib", "win": "dll"}  #: of libraries
#: name, unit, meaning and causality of what hosts see; value references count from zero
VARIABLES = (
    ("u_x", "m", "position of the indenter", "input"),
    ("u_y", "m", "position across", "input"),
    ("u_z", "m", "depth; at zero and below nothing touches", "input"),
    ("F_x", "N", "force against the motion of the indenter", "output"),
    ("F_y", "N", "the same across", "output"),
    ("F_z", "N", "force that presses it into the half-space", "output"),
    ("lost", "J", "energy that friction and material have turned into heat", "local"),
)
UNITS = {"m": {"m": "1"}, "N": {"kg": "1", "m": "1", "s": "-2"}, "J": {"kg": "1", "m": "2", "s": "-2"}}


class NoCompiler(RuntimeError):
    """No C compiler, or one that fails."""


def sources(element: ContactElement, name: str, told: str) -> dict[str, str]:
    """The texts of header and unit, by the names of their files."""
    text = header(element, name, told)
    unit = filled("fmu.c.in", {"NAME": name, "VERSION": __version__, "GUID": guid(text)}, {}, name)
    return {f"{name}.h": text, f"{name}_fmu.c": unit}


def fmu(texts: dict[str, str], name: str) -> bytes:
    """The unit made of its sources. Raises NoCompiler."""
    system, packed = platform_of(), BytesIO()
    described = {"modelDescription.xml": description(name, guid(texts[f"{name}.h"])).encode()}
    described |= {f"sources/{file}": text.encode() for file, text in texts.items()}
    described[f"binaries/{system}/{name}.{library_end(system)}"] = library(texts, name)
    with ZipFile(packed, "w") as archive:
        for file, content in described.items():  # one date, so that equal contacts make equal files
            entry = ZipInfo(file)
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content, ZIP_DEFLATED)
    return packed.getvalue()


def library(texts: dict[str, str], name: str) -> bytes:
    """The compiled unit for this machine. Raises NoCompiler."""
    with TemporaryDirectory() as folder:
        for file, text in texts.items():
            (Path(folder) / file).write_text(text, encoding="utf-8")
        command = [*compiler(), *FLAGS, f"{name}_fmu.c", "-o", "made", "-lm"]
        try:
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace", check=False)
        except OSError as fault:
            raise NoCompiler(f"{command[0]} cannot be run: {fault.strerror}; let CC name a C compiler") from None
        if done.returncode != 0:
            raise NoCompiler(f"{shlex.join(command)} failed:\n{done.stderr.strip()}")
        return (Path(folder) / "made").read_bytes()


def compiler() -> list[str]:
    """The command of a C compiler: what CC says, or what the machine has. Raises NoCompiler."""
    if said := shlex.split(os.environ.get("CC", "")):
        return said
    for one in COMPILERS:
        if found := which(one):
            return [found]
    raise NoCompiler("there is no C compiler: install gcc or clang, or let the environment variable CC name one")


def platform_of() -> str:
    """What FMI 2.0 calls this machine, such as linux64."""
    system = {"win32": "win", "cygwin": "win"}.get(sys.platform, sys.platform)
    return f"{system}{8 * struct.calcsize('P')}"


def library_end(system: str) -> str:
    """How libraries end there."""
    return ENDS.get(system.rstrip("0123456789"), "so")


def guid(text: str) -> str:
    """A mark of this header that the unit and its description share."""
    return f"{{{sha256(text.encode()).hexdigest()[:32]}}}"


def description(name: str, mark: str) -> str:
    """The text of modelDescription.xml."""
    top = ElementTree.Element(
        "fmiModelDescription", fmiVersion="2.0", modelName=name, guid=mark, variableNamingConvention="flat",
        generationTool=f"mdr-friction {__version__}",
        description="A contact as a force element with memory: in a step it goes to the inputs that are set before it",
    )  # fmt: skip
    can = (
        "canHandleVariableCommunicationStepSize", "canGetAndSetFMUstate", "canSerializeFMUstate",
        "providesDirectionalDerivative",
    )  # fmt: skip
    unit = ElementTree.SubElement(top, "CoSimulation", {"modelIdentifier": name, **dict.fromkeys(can, "true")})
    files = ElementTree.SubElement(unit, "SourceFiles")
    ElementTree.SubElement(files, "File", name=f"{name}_fmu.c")
    units = ElementTree.SubElement(top, "UnitDefinitions")
    for in_unit, powers in UNITS.items():
        ElementTree.SubElement(ElementTree.SubElement(units, "Unit", name=in_unit), "BaseUnit", powers)
    variables = ElementTree.SubElement(top, "ModelVariables")
    for k, (variable, in_unit, meaning, causality) in enumerate(VARIABLES):
        one = ElementTree.SubElement(
            variables, "ScalarVariable", name=variable, valueReference=str(k), description=meaning,
            causality=causality, variability="continuous",
        )  # fmt: skip
        ElementTree.SubElement(one, "Real", {"unit": in_unit, **({"start": "0"} if causality == "input" else {})})
    structure = ElementTree.SubElement(top, "ModelStructure")
    for group in ("Outputs", "InitialUnknowns"):
        unknown = ElementTree.SubElement(structure, group)
        for k, (*_, causality) in enumerate(VARIABLES):
            if causality == "output":
                ElementTree.SubElement(unknown, "Unknown", index=str(k + 1))
    ElementTree.indent(top)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(top, encoding="unicode") + "\n"
