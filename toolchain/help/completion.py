"""Completion of the programs' commands and options in bash, zsh and fish, from --help."""

import re
import subprocess
from dataclasses import dataclass, field

from help_text import PROGRAMS, entries, help_of, parts_of


@dataclass
class Option:
    names: list[str]
    text: str
    value: str  # its name in the help: FILE, INT; empty: it takes none
    values: list[str]  # allowed ones; empty: a file, or anything

    @property
    def may_be_file(self):
        return self.value not in {"ADDRESS", "BUS", "FLOAT", "INT", "PART", "UINT", "VALUE"}


@dataclass
class Command:
    name: str  # "" is the program itself
    text: str = ""
    options: list[Option] = field(default_factory=list)
    values: list[str] = field(default_factory=list)  # for its positionals, besides files


def positional_values(programs, command, name, text):
    if command == "supercoil command":
        verbs = text.split(" and ", 1)[1].split("; N is ")[0]
        words = (verb.split()[0] for verb in re.sub(r"\([^)]*\)", "", verbs).split(","))
        return list(dict.fromkeys(["state", *words]))
    if name.startswith("SCENARIO"):
        listed = subprocess.run([programs / "supercoil-sim", "list"], check=True, capture_output=True, text=True).stdout
        return re.findall(r"^  (\S+)", listed.split("\n\n")[0], re.M)
    return []


def commands_of(programs, program):
    """The program itself, then its subcommands."""
    found = [Command("")]
    for section, name, text in entries(help_of(programs, program)):
        if section == "Subcommands":
            found.append(Command(name, text))
    for command in found:
        typed = f"{program} {command.name}".strip()
        for section, name, text in entries(help_of(programs, typed)):
            if section == "Subcommands":
                continue
            parts = parts_of(name)
            if not name.startswith("-"):
                command.values += positional_values(programs, typed, name, text)
                continue
            allowed = re.fullmatch(r"\{(.*)\}", parts["range"] or "")
            command.options.append(Option(parts["names"].split(","), text, parts["value"] or "",
                                          allowed[1].split(",") if allowed else []))
    return found


def first(text):
    """Only the first sentence, because there is little room."""
    return re.split(r"(?<=[a-z)])[.;:] ", text)[0].rstrip(".")


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def bash(program, commands):
    function = "_" + program.replace("-", "_")
    yield f"""{function}() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} options='' values=''
  # --option=value is three words.
  if [ "$current" = = ]; then
    current=''
  elif [ "$before" = = ]; then
    before=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  COMPREPLY=()
  local command=''
  if [ "$COMP_CWORD" -gt 1 ]; then command=${{COMP_WORDS[1]}}; fi
  case $command in"""
    main, *others = commands
    for command in [*others, main]:
        pattern = command.name or "*"
        yield f"    {pattern})"
        yield f"      options={quoted(' '.join(name for option in command.options for name in option.names))}"
        offered = command.values or ([other.name for other in others] if command is main else [])
        if offered:
            yield f"      values={quoted(' '.join(offered))}"
        if takers := [option for option in command.options if option.value]:
            yield "      case $before in"
            for option in takers:
                if option.values:
                    yield f"        {'|'.join(option.names)}) options='' values={quoted(' '.join(option.values))} ;;"
            any_value = "|".join(name for option in takers if not option.values for name in option.names)
            yield f"        {any_value}) options='' values='' ;;"
            yield "      esac"
        yield "      ;;"
    yield f"""  esac
  if [[ $current == -* ]]; then values=$options; fi
  # Everything else is a file name.
  if [ -n "$values" ]; then mapfile -t COMPREPLY < <(compgen -W "$values" -- "$current"); fi
}}
complete -o bashdefault -o default -F {function} {program}"""


def zsh(program, commands):
    main, *others = commands

    def bracketed(text):
        return text.replace("\\", "\\\\").replace("[", "\\[").replace("]", "\\]").replace(":", "\\:")

    def specification(option, name):
        value = ""
        if option.value:
            offered = f"({' '.join(option.values)})" if option.values else "_files" if option.may_be_file else " "
            value = f":{option.value.lower()}:{offered}"
        return quoted(f"{name}[{bracketed(first(option.text))}]{value}")

    def arguments(command, last):
        yield "_arguments \\"
        for option in command.options:
            for name in option.names:
                yield f"  {specification(option, name)} \\"
        yield "  " + quoted(last)

    def last_of(command):
        # Both words and files.
        return "*:value:{_alternative \"values:value:(" + " ".join(command.values) + ")\" \"files:file:_files\"}" \
            if command.values else "*:file:_files"

    yield f"#compdef {program}"
    if not others:
        yield from arguments(main, last_of(main))
        return
    yield "if (( CURRENT == 2 )) && [[ $words[2] == -* ]]; then"
    for line in arguments(main, last_of(main)):
        yield "  " + line
    yield "  return"
    yield "elif (( CURRENT == 2 )); then"
    yield "  local -a commands=("
    for command in others:
        yield "    " + quoted(f"{command.name}:{first(command.text)}")
    yield "  )"
    yield "  _describe command commands"
    yield "  return"
    yield "fi"
    yield "local command=$words[2]"
    yield "shift words"
    yield "(( CURRENT-- ))"
    yield "case $command in"
    for command in others:
        yield f"  {command.name})"
        for line in arguments(command, last_of(command)):
            yield "    " + line
        yield "    ;;"
    yield "esac"


def fish(program, commands):
    main, *others = commands
    for command in commands:
        if command is not main:
            yield f"complete -c {program} -n __fish_use_subcommand -f -a {command.name} -d {quoted(first(command.text))}"
        when = f"'__fish_seen_subcommand_from {command.name}'" if command.name else ("__fish_use_subcommand" if others else "true")
        for option in command.options:
            names = " ".join(("-l " if name.startswith("--") else "-s ") + name.lstrip("-") for name in option.names)
            values = ""
            if option.values:
                values = f" -x -a {quoted(' '.join(option.values))}"
            elif option.value:
                values = " -r -F" if option.may_be_file else " -x"
            yield f"complete -c {program} -n {when} {names}{values} -d {quoted(first(option.text))}"
        if command.values:
            yield f"complete -c {program} -n {when} -a {quoted(' '.join(command.values))}"


def files(programs):
    """(name below firmware/apps/completion, text) of each."""
    note = "# Generated from --help by toolchain/generate-completion. Do not edit."
    for program in PROGRAMS:
        commands = commands_of(programs, program)
        for name, lines in ((f"bash/{program}", bash), (f"zsh/_{program}", zsh), (f"fish/{program}.fish", fish)):
            text = list(lines(program, commands))
            # zsh reads the first line.
            at = 1 if text[0].startswith("#compdef") else 0
            yield name, "\n".join([*text[:at], note, *text[at:]]) + "\n"
