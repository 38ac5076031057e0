"""What a command answers to machines."""

import json

from mdr.__main__ import main


def json_of(capsys, command, status=0):
    """The answer of a command with --json, which ends with this status; JSON has neither NaN nor infinity."""

    def refuse(literal):
        raise AssertionError(literal)

    assert main(command) == status
    return json.loads(capsys.readouterr().out, parse_constant=refuse)
