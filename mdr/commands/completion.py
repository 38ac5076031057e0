"""`mdr completion`: a script for bash, zsh or fish that completes commands, options and files."""

from __future__ import annotations

import argparse
import shlex
from typing import NamedTuple

from mdr.commands.output import DONE

USE = {
    "bash": 'source <(mdr completion bash)        # in ~/.bashrc: eval "$(mdr completion bash)"',
    "zsh": 'source <(mdr completion zsh)         # in ~/.zshrc, behind compinit: eval "$(mdr completion zsh)"',
    "fish": "mdr completion fish | source         # kept: mdr completion fish > ~/.config/fish/completions/mdr.fish",
}  #: how each shell takes its script
BASH = """\
_mdr() {{
    local word command= words i
    for ((i = 1; i < COMP_CWORD; i++)); do
        case ${{COMP_WORDS[i]}} in {names}) command=${{COMP_WORDS[i]}}; break ;; esac
    done
    case $command in
{cases}
    esac
    COMPREPLY=($(compgen -W "$words" -- "${{COMP_WORDS[COMP_CWORD]}}"))
}}
complete -o default -F _mdr mdr
"""
ZSH = "autoload -U +X compinit && compinit\nautoload -U +X bashcompinit && bashcompinit\n"


class Option(NamedTuple):
    """An option of a command."""

    names: tuple[str, ...]
    takes_value: bool
    meaning: str


def add_options(command: argparse.ArgumentParser, top: argparse.ArgumentParser) -> None:
    """The shell."""
    command.add_argument("shell", choices=tuple(USE), help="the shell that reads the script")
    command.epilog = "\n".join(["how each shell takes it:", *(f"  {shell}: {how}" for shell, how in USE.items())])
    command.formatter_class = argparse.RawDescriptionHelpFormatter
    command.set_defaults(top=top)


def completion(args: argparse.Namespace, _: None) -> int:
    """Print the script, made of the options that the parser knows."""
    commands = {name: (parser.description or "", _options(parser)) for name, parser in _commands(args.top).items()}
    commands["completion"][1].append(Option(tuple(USE), False, "shell"))
    script = _fish(commands) if args.shell == "fish" else _bash(commands, _options(args.top))
    print((ZSH if args.shell == "zsh" else "") + script, end="")
    return DONE


def _commands(top: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    """The parsers of the commands by their names."""
    found = next(one.choices for one in top._actions if isinstance(one, argparse._SubParsersAction))
    return dict(found)


def _options(parser: argparse.ArgumentParser) -> list[Option]:
    return [
        Option(tuple(one.option_strings), one.nargs != 0, (one.help or "").replace("%%", "%"))
        for one in parser._actions
        if one.option_strings
    ]


def _words(options: list[Option]) -> str:
    return " ".join(name for one in options for name in one.names)


def _bash(commands: dict[str, tuple[str, list[Option]]], top: list[Option]) -> str:
    lines = {name: _words(options) for name, (_, options) in commands.items()} | {
        "": f"{' '.join(commands)} {_words(top)}"
    }
    cases = "\n".join(f"        {name or chr(39) * 2}) words={shlex.quote(words)} ;;" for name, words in lines.items())
    return BASH.format(names="|".join(commands), cases=cases)


def _fish(commands: dict[str, tuple[str, list[Option]]]) -> str:
    lines = [f"complete -c mdr -n __fish_use_subcommand -f -a {name} -d {shlex.quote(what)}"
             for name, (what, _) in commands.items()]  # fmt: skip
    for name, (_, options) in commands.items():
        here = f"complete -c mdr -n '__fish_seen_subcommand_from {name}'"
        for one in options:
            if not one.names[0].startswith("-"):
                lines.append(f"{here} -f -a '{' '.join(one.names)}'")
                continue
            spelt = " ".join(f"-l {word[2:]}" if word.startswith("--") else f"-s {word[1:]}" for word in one.names)
            lines.append(f"{here} {spelt}{' -r' if one.takes_value else ''} -d {shlex.quote(one.meaning)}")
    return "\n".join(lines) + "\n"
