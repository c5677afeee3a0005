"""Features of a Git host, for Sphinx: navigation from lists of links, Mermaid diagrams, formulas in MathML."""

import pathlib
import posixpath
import re

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml  # not a documented interface: docutils is pinned
from manual import Manual
from pygments.lexers.special import TextLexer
from reference import Reference, headers
from sphinx.util.docutils import SphinxDirective

INDEX = "docs/README"
FAULTS = "docs/faults/README"
PAGE_OR_GROUP = re.compile(r"^(?:## (?P<group>.+)|- \[(?P<name>[^\]]+)\]\((?P<page>[^)#]+)\.(?:md|[1-8])\).*)$", re.M)
FILE_NAME = re.compile(r"\[(?:docs/)?([\w-]+)\.md\]\((?P<path>(?:[\w./-]*/)?\1)\.md")
API = "docs/api/README"
MANUAL = "docs/man"
API_PAGE = re.compile(r"^- \[(\w+)\]\(\1\.md\)", re.M)
FAULT = re.compile(r"^\| *\d+ *\| \[(\w+)\]", re.M)


def groups(index):
    """(heading, [(name, page)]) of the index: each of its items begins with a page."""
    found = []
    for match in PAGE_OR_GROUP.finditer(index):
        if match["group"]:
            found.append((match["group"], []))
        elif found:
            found[-1][1].append((match["name"], posixpath.normpath(f"docs/{match['page']}")))
    return found


def toctree(caption, pages):
    lines = [f"{name} </{page}>" for name, page in pages]
    options = [":hidden:", f":caption: {caption}"] if caption else [":hidden:"]
    return "\n".join(["", "", "```{toctree}", *options, "", *lines, "```", ""])


def adapt(app, page, source):
    """Adds the navigation, and names pages as it does in links whose text is a file name."""
    if posixpath.dirname(page) == MANUAL:
        source[0] = Manual(source[0]).page()
    index = (pathlib.Path(app.srcdir) / f"{INDEX}.md").read_text()
    names = {page: name for _, pages in groups(index) for name, page in pages}

    def named(link):
        target = posixpath.normpath(posixpath.join(posixpath.dirname(page), link["path"]))
        return f"[{names[target]}]({link['path']}.md" if target in names else link[0]

    source[0] = FILE_NAME.sub(named, source[0])
    if page == app.config.root_doc:
        source[0] += toctree("", [("All pages", INDEX)])
        source[0] += "".join(toctree(group, pages) for group, pages in groups(index))
    elif page == API:
        source[0] += toctree("", [(name, f"docs/api/{name}") for name in API_PAGE.findall(source[0])])
    elif posixpath.dirname(page) == posixpath.dirname(API):
        reference = Reference(app.config.doxygen)
        listed = headers(pathlib.Path(app.srcdir), posixpath.basename(page))
        source[0] += "\n" + "".join(map(reference.section, listed))
    elif page == FAULTS:
        source[0] += toctree("", [(name, f"docs/faults/{name}") for name in FAULT.findall(source[0])])


class Mermaid(SphinxDirective):
    has_content = True

    def run(self):
        # Without scripts the diagram's text is shown.
        return [nodes.literal_block(text="\n".join(self.content), language="text", classes=["diagram"])]


def add_diagrams(app, _page, _template, _context, doctree):
    if doctree and any("diagram" in block["classes"] for block in doctree.findall(nodes.literal_block)):
        app.add_js_file("mermaid.tiny.js")
        app.add_js_file("diagrams.js")


def math(as_block):
    def visit(self, node):
        tex = re.sub(r"\\dots\b", r"\\ldots", node.astext())
        formula = tex2mathml(tex, as_block=as_block)
        element = "div" if as_block else "span"
        self.body.append(f'<{element} class="formula">{formula}</{element}>')
        raise nodes.SkipNode
    return visit


def setup(app):
    app.add_config_value("doxygen", "", "env")  # the folder of its XML
    app.connect("source-read", adapt)
    app.connect("html-page-context", add_diagrams)
    app.add_directive("mermaid", Mermaid)
    app.add_lexer("csv", TextLexer)
    app.add_html_math_renderer("mathml", (math(as_block=False), None), (math(as_block=True), None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
