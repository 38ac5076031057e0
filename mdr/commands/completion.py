"""`mdr completion`: a script for bash, zsh or fish that completes commands, options and files."""

from __future__ import annotations

import argparse
import shlex
from collections.abc import Iterator

from mdr.commands.output import Exit

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
complete -o default -F _mdr mdr"""
ZSH = "autoload -U +X compinit && compinit\nautoload -U +X bashcompinit && bashcompinit\n"


def add_options_of_completion(command: argparse.ArgumentParser) -> None:
    """The shell."""
    command.add_argument("shell", choices=tuple(USE), help="the shell that reads the script")
    command.epilog = "\n".join(["how each shell takes it:", *(f"  {shell}: {how}" for shell, how in USE.items())])
    command.formatter_class = argparse.RawDescriptionHelpFormatter


def completion(args: argparse.Namespace, _: None) -> int:
    """Print the script, made of the options that the parser knows."""
    found = next(one.choices for one in args.top._actions if isinstance(one, argparse._SubParsersAction))
    commands = {name: command.fill() for name, command in found.items()}
    lines = _fish(commands) if args.shell == "fish" else _bash({**commands, "": args.top}, "|".join(commands))
    print((ZSH if args.shell == "zsh" else "") + "\n".join(lines))
    return Exit.DONE


def _bash(parsers: dict[str, argparse.ArgumentParser], names: str) -> Iterator[str]:
    """Lines of the script for bash; "" is the parser before a command is given."""
    words = {name: [word for one in parser._actions for word in one.option_strings or one.choices or ()]
             for name, parser in parsers.items()}  # fmt: skip
    cases = [f"        {shlex.quote(name)}) words={shlex.quote(' '.join(own))} ;;" for name, own in words.items()]
    yield BASH.format(names=names, cases="\n".join(cases))


def _fish(commands: dict[str, argparse.ArgumentParser]) -> Iterator[str]:
    """Lines of the script for fish."""
    for name, parser in commands.items():
        yield f"complete -c mdr -n __fish_use_subcommand -f -a {name} -d {shlex.quote(parser.description or '')}"
        here = f"complete -c mdr -n '__fish_seen_subcommand_from {name}'"
        for one in parser._actions:
            kinds = {word: "l" if word.startswith("--") else "s" for word in one.option_strings}  # long and short
            spelt = " ".join(f"-{kind} {word.lstrip('-')}" for word, kind in kinds.items())
            value, meaning = "" if one.nargs == 0 else " -r", shlex.quote((one.help or "").replace("%%", "%"))
            if spelt:
                yield f"{here} {spelt}{value} -d {meaning}"
            elif one.choices:
                yield f"{here} -f -a '{' '.join(one.choices)}'"
