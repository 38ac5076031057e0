"""What a command says to people and to machines."""

import json

import mdr
from mdr.__main__ import main


def file_of(case, path):
    """Write a case to a file; the name of the file, as a command line has it."""
    path.write_text(mdr.write_case(case), encoding="utf-8")
    return str(path)


def words_of(capsys, command, status=0):
    """Standard output and standard error of a command that ends with this status: .out and .err."""
    assert main(command) == status
    return capsys.readouterr()


def json_of(capsys, command, status=0):
    """The answer of a command with --json; JSON has neither NaN nor infinity."""

    def refuse(literal):
        raise AssertionError(literal)

    return json.loads(words_of(capsys, command, status).out, parse_constant=refuse)
