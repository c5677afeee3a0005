"""Manual pages (docs/man, in mdoc) as Markdown pages for Sphinx: each option is an entry with its own anchor."""

import re

from reference import inline

OPTION = re.compile(r"(?<![\w-])--?[a-z][\w-]*")
# The simulator's package has no pages of its own.
DOCUMENT = re.compile(r"/usr/share/doc/supercoil(?:/|-doc/html/docs/)(\S+)\.(?:md|html)")


def plain(text):
    return text.replace("\\-", "-").replace("\\&", "").replace("\\e", "\\")


def prose(text):
    """Formats options as code, because in text two hyphens would become a dash."""
    found, at = [], 0
    for option in OPTION.finditer(text):
        found += [inline(text[at:option.start()]), f"`{option[0]}`"]
        at = option.end()
    return "".join([*found, inline(text[at:])])


def styled(macro, words, name):
    """A macro in running text."""
    text = " ".join(words)
    if macro == "Xr":
        return f"[{words[0]}({words[1]})]({words[0]}.{words[1]})"
    if macro == "Pa" and (document := DOCUMENT.fullmatch(text)):
        return f"[{document[1]}.md](../{document[1]}.md)"
    if macro == "Fl":
        return f"`-{text.replace('Fl ', '-')}`"
    if macro == "Nm":
        return f"`{text or name}`"
    if macro in ("Pa", "Ql", "Cm", "Sy"):
        return f"`{text}`"
    raise ValueError(f".{macro} of a manual page, which is not shown: {text}")


def head(words):
    """The head of an option or a positional, as it is typed."""
    text = re.sub(r"Fl (\S+)", r"-\1", " ".join(words)).replace("Ar ", "")
    return text.replace(" ,", ",")


class Manual:
    """One manual page, line by line."""

    def __init__(self, source):
        self.lines = [plain(line) for line in source.splitlines()]
        self.name = self.all_of("Nm")[0]
        synopses = list(dict.fromkeys(self.all_of("Nm")[1:]))
        self.program = synopses[0] if len(synopses) == 1 else self.name
        self.out, self.paragraph, self.entry, self.literal, self.section = [], [], None, [], ""

    def all_of(self, macro):
        return [line.removeprefix(f".{macro} ") for line in self.lines if line.startswith(f".{macro} ")]

    def flush(self):
        text = " ".join(self.paragraph)
        if self.entry and self.entry[0] == "option":
            self.out += [f"```{{option}} {self.entry[1]}", text, "```", ""]
        elif self.entry:
            self.out += [f"- {self.entry[1]}: {text}"]
        elif text:
            self.out += [text, ""]
        if self.literal:
            self.out += ["", "```sh", *self.literal, "```", ""]
        self.paragraph, self.entry, self.literal = [], None, []

    def heading(self, marks, text, program):
        self.flush()
        self.section = text
        if text != "Name":
            self.out += ["", f"{marks} {text}", ""]
        if text == "Options" or marks == "###":
            self.out += [f"```{{program}} {program}", "```", ""]

    def item(self, words):
        self.flush()
        if words[0] in ("Fl", "Ar"):
            self.entry = ("option", head(words))
        else:
            self.entry = ("item", styled(words[0], words[1:], self.name) if len(words) > 1 else f"`{words[0]}`")

    def synopsis(self, macro, words):
        if macro == "Nm":
            self.literal.append(" ".join(words))
        else:
            self.literal[-1] += f" [{words[1]}]" if macro == "Op" else f" {' '.join(words)}"

    def macro(self, macro, words):
        if macro == "Sh":
            self.heading("##", " ".join(words).capitalize(), self.program)
        elif macro == "Ss":
            self.heading("###", " ".join(words), " ".join(words))
        elif macro == "It":
            self.item(words)
        elif macro == "Dl":
            self.literal.append(" ".join(words))
        elif macro in ("Pp", "Bl", "El"):
            self.flush()
            self.out += [""]
        elif self.section == "Synopsis":
            self.synopsis(macro, words)
        elif self.section != "Name":
            end = words.pop() if words and words[-1] in ",.;:" else ""
            self.paragraph.append(styled(macro, words, self.name) + end)

    def page(self):
        section = re.search(r"\d", self.all_of("Dt")[0])[0]
        self.out = [f"# {self.name}({section})", "", inline(self.all_of("Nd")[0].capitalize()) + ".", ""]
        for line in self.lines:
            if line.startswith(".") and line[1:3] not in ("Dd", "Dt", "Os", "Nd"):
                macro, *words = line[1:].split()
                self.macro(macro, words)
            elif not line.startswith("."):
                self.paragraph.append(prose(line))
        self.flush()
        return "\n".join(self.out)
