"""Texts from the documentation, for the messages of the Python package."""

import re

LINK = re.compile(r"\[([^\]]*)\](?:\([^)]*\))?")


def plain(markdown):
    """The text without links and markup."""
    return LINK.sub(r"\1", markdown).replace("`", "").replace("**", "").replace('"', "'").strip()


def first_paragraph(page):
    """The first paragraph after the page's title."""
    return page.split("\n\n")[1]


def section(page, heading):
    found = re.search(rf"^## {heading}\n+(.*?)(?=^## |\Z)", page, re.M | re.S)
    return found[1] if found else ""


def table_cells(page, title):
    """For the table whose first column has this title: first cell -> the other cells. Names in one cell share them."""
    rows, inside = {}, False
    for line in page.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("| ")]
        if not line.startswith("|"):
            inside = False
        elif cells[0] == title:
            inside = True
        elif inside:
            for name in re.findall(r"`(\w+)`", cells[0]):
                rows[name] = [plain(cell) for cell in cells[1:]]
    return rows


def table_rows(page, title):
    """The same, but with the last cell only."""
    return {name: cells[-1] for name, cells in table_cells(page, title).items()}
