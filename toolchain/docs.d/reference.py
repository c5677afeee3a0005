"""The API reference: Doxygen's XML for the headers, as Markdown pages for Sphinx."""

import pathlib
import re
import xml.etree.ElementTree as ET

ROOTS = tuple(map(pathlib.Path, ("control/include", "hal/include", "firmware/core", "firmware/io")))
WIDTH = 76  # of a code line in the site's text column
SPECIAL = re.compile(r"([\\`*_\[\]<>{}$#|~])")


def headers(root, part):
    """Each header of a part of the libraries (the name of a folder), as it is included."""
    for folder in ROOTS:
        for header in sorted((root / folder).glob(f"**/{part}/*.hpp")):
            yield header.relative_to(root / folder).as_posix()


def code(text):
    text = re.sub(r"< (?=\S)", "<", " ".join(text.split()))
    return re.sub(r"(?<=\S) >", ">", text).replace("<=>", " <=>")


def prose(element):
    """Paragraphs of a description, each on its own lines."""
    found = []
    for para in element.findall("para") if element is not None else []:
        parts = [inline(para.text)]
        for child in para:
            if child.tag == "computeroutput":
                parts.append(f"`{''.join(child.itertext())}`")
            elif child.tag in ("itemizedlist", "orderedlist"):
                items = [" ".join(prose(item)) for item in child.findall("listitem")]
                parts.append("\n\n" + "\n".join(f"- {item}" for item in items) + "\n\n")
            elif child.tag in ("verbatim", "preformatted"):
                parts.append(f"\n\n```text\n{''.join(child.itertext())}\n```\n\n")
            elif child.tag == "ref" and child.get("kindref") == "compound":
                parts.append(f"[{inline(''.join(child.itertext()))}](#{child.get('refid')})")
            elif child.tag == "emphasis":
                parts.append(f"*{inline(''.join(child.itertext()))}*")
            elif child.tag in ("ref", "ulink", "zwj"):
                parts.append(inline("".join(child.itertext())))
            else:
                raise ValueError(f"<{child.tag}> in a comment, which is not shown: {''.join(para.itertext())}")
            parts.append(inline(child.tail))
        found.append("".join(parts).strip())
    return [text for text in found if text]


def inline(text):
    return SPECIAL.sub(r"\\\1", re.sub(r"\s+", " ", text or ""))


def documentation(element):
    return [text for tag in ("briefdescription", "detaileddescription") for text in prose(element.find(tag))]


def template_of(element):
    parameters = []
    for parameter in element.findall("templateparamlist/param"):
        text = " ".join("".join(part.itertext()) for part in parameter if part.tag in ("type", "declname"))
        value = parameter.find("defval")
        parameters.append(code(text + (f" = {''.join(value.itertext())}" if value is not None else "")))
    # An explicit specialisation has an empty list.
    return f"template <{', '.join(parameters)}>\n" if element.find("templateparamlist") is not None else ""


def signature(member):
    kind = member.get("kind")
    if kind == "enum":
        values = ", ".join(value.findtext("name") for value in member.findall("enumvalue"))
        name = re.sub("@.*", "", member.findtext("name"))
        return code(f"enum {'class' if member.get('strong') == 'yes' else ''} {name} {{ {values} }};")
    if kind == "concept":
        return "".join(member.find("initializer").itertext())
    words = "".join(member.find("type").itertext())
    name = member.findtext("name")
    if kind == "typedef":
        return f"{template_of(member)}using {name} = {code(words)};"
    if kind == "friend" or re.search("= *(default|delete)$", member.findtext("argsstring") or ""):
        return ""
    prefix = "static " if member.get("static") == "yes" and not words.startswith("static") else ""
    prefix += "explicit " if member.get("explicit") == "yes" else ""
    prefix += "virtual " if member.get("virt") in ("virtual", "pure-virtual") and "virtual" not in words else ""
    initial = member.find("initializer")
    value = " " + "".join(initial.itertext()) if kind == "variable" and initial is not None else ""
    value = "" if value.count("\n") or len(value) > 60 else value
    arguments = code(member.findtext("argsstring") or "")
    declared = f"{code(prefix + words)} {name}".strip()
    if len(declared + arguments) > WIDTH:
        # One line per parameter. Commas inside a type's arguments do not separate parameters.
        arguments = re.sub(r",(?=[^<>]*(?:<[^<>]*>[^<>]*)*$)", ",\n   ", arguments).replace("(", "(\n    ", 1)
    return f"{template_of(member)}{declared}{arguments}{value};"


class Reference:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        index = ET.parse(self.folder / "index.xml")
        self.compounds = [self.load(item.get("refid")) for item in index.iter("compound") if item.get("kind") != "dir"]

    def load(self, identity):
        return ET.parse(self.folder / f"{identity}.xml").find("compounddef")

    def here(self, header, *kinds):
        return [compound for compound in self.compounds
                if compound.get("kind") in kinds and compound.find("location").get("file") == header]

    def section(self, header):
        """A header: its purpose, its types in the order of their lines, then its functions and values."""
        files = self.here(header, "file")
        lines = [f"({file.get('id')})=" for file in files]
        lines += [f"## {pathlib.PurePosixPath(header).name}", "", f'```cpp\n#include "{header}"\n```', ""]
        for file in files:
            lines += [text + "\n" for text in documentation(file)]
        classes = self.here(header, "class", "struct", "concept")
        for compound in sorted(classes, key=lambda found: int(found.find("location").get("line"))):
            if compound.get("prot", "public") == "public":
                lines += self.type(compound)
        members = [member for space in self.compounds if space.get("kind") == "namespace"
                   for member in space.iter("memberdef")
                   if member.find("location").get("file") == header]
        if members:
            lines += [f"### Of {pathlib.PurePosixPath(header).name} itself", ""] if classes else []
            for member in sorted(members, key=lambda found: int(found.find("location").get("line"))):
                lines += self.member(member)
        return "\n".join(lines) + "\n\n"

    def type(self, compound):
        name = re.sub(r"^(supercoil::)?(control::|hal::)?", "", code(compound.findtext("compoundname")))
        kind = compound.get("kind")
        first = f"{template_of(compound)}{kind} {name}"
        if kind == "concept":
            first = "".join(compound.find("initializer").itertext())
        lines = [f"({compound.get('id')})=", f"### {inline(name)}", "", f"```cpp\n{first}\n```", ""]
        lines += [text + "\n" for text in documentation(compound)]
        for member in compound.iter("memberdef"):
            if member.get("prot") == "public":
                lines += self.member(member)
        return lines

    def member(self, member):
        text = signature(member)
        if not text:
            return []
        about = documentation(member)
        if member.get("kind") == "enum":
            about += [f"`{value.findtext('name')}`: {' '.join(documentation(value))}"
                      for value in member.findall("enumvalue") if documentation(value)]
        if member.get("kind") == "variable":
            return [f"- `{text.removesuffix(';')}`" + (f": {' '.join(about)}" if about else ""), ""]
        return [f"```cpp\n{text}\n```", "", *(text + "\n" for text in about)]
