"""Sphinx's configuration for the site of README.md, CHANGELOG.md, docs/ and its manual pages: toolchain/docs."""

import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))

project = "supercoil"
author = "supercoil's contributors"
release = re.search(r"project\(supercoil VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
html_title = f"supercoil {release}"

extensions = ["myst_parser", "site_parts"]
root_doc = "README"
include_patterns = ["README.md", "CHANGELOG.md", "docs/*.md", "docs/api/*.md", "docs/faults/*.md", "docs/man/*.[1-8]"]
# site_parts.adapt() converts manual pages to Markdown.
source_suffix = dict.fromkeys([".md", ".1", ".8"], "markdown")
exclude_patterns = sorted(entry.name for entry in ROOT.iterdir() if entry.is_dir() and entry.name != "docs")

# Links, anchors of headings and formulas work as on a Git host.
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 6
myst_fence_as_directive = ["mermaid"]
myst_dmath_allow_space = False
myst_dmath_double_inline = False
html_math_renderer = "mathml"

html_theme = "furo"
html_static_path = ["site.css", "diagrams.js", "node_modules/@mermaid-js/tiny/dist/mermaid.tiny.js"]
html_css_files = ["site.css"]
html_favicon = "icon.svg"
html_copy_source = False
html_show_sourcelink = False
html_show_copyright = False
