"""A page with tables of keys, compared with what the programs say of them."""

import fnmatch
import re
import tomllib

from samples import boards, of_scenario, scenarios, studies

SEEN = {"configuration.md": boards, "scenarios.md": scenarios, "campaigns.md": studies}

HEADING = re.compile(r"^(##+) (.*)$")
TABLE = re.compile(r"^\[+([\w.]+)\]+")
QUOTED = re.compile(r"`([^`]+)`")
VALUE = re.compile(r'[-+\d.e]+|\[[-+\d.e, ]*\]|true|false|none|–|`".*"`')
TOML_LINE = re.compile(r"^(?P<key>\w+) = (?P<value>[^#]+?)\s*(?:#\s*(?:\[(?P<range>[^\]]*)\] ?)?(?P<comment>.*))?$")
COMMENT_COLUMN = 26  # at least two spaces after the value
CHOICES = ("kind", "preset")
VARIES = object()


def shown(value):
    """As an author writes it."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return "–" if value == "required" else f'`"{value}"`'
    if isinstance(value, list):
        return "[" + ", ".join(map(shown, value)) + "]"
    value = float(f"{value:.12g}")
    if value == int(value):
        short = f"{value:.0e}".replace("e+0", "e").replace("e+", "e")
        return short if abs(value) >= 1e6 and float(short) == value else str(int(value))
    return re.sub(r"e-0*", "e-", repr(value))


def only(values):
    """The one value that all are, or VARIES."""
    distinct = {str(value): value for value in values}
    return distinct.popitem()[1] if len(distinct) == 1 else VARIES


def parts_of(text, count):
    """Of a cell for several keys; one part may be for all of them."""
    parts = [text] if count == 1 else re.split(r", (?![^\[]*\])", text)
    return parts * count if len(parts) == 1 else parts


def joined(parts):
    return parts[0] if len(set(parts)) == 1 else ", ".join(parts)


def suits(seen, choices):
    return all(seen.choices.get(column) in allowed for column, allowed in choices.items())


class Known:
    """What the program says of one key, in all files that have it."""

    def __init__(self, seen, default_of=()):
        self.seen = seen
        self.defaults = [each.default for each in seen if not default_of or each.choices.get("preset") in default_of]
        self.default = only(self.defaults)
        self.min, self.max = only([each.min for each in seen]), only([each.max for each in seen])
        self.names = only([each.names for each in seen])
        self.type = seen[0].type

    def default_text(self):
        return VARIES if self.default is VARIES else shown(self.default)

    def is_free(self):
        """No range: the page may say what it likes."""
        return self.type in ("flag", "texts", "values") or (self.type == "text" and not self.names)

    def range_text(self, quote='`"{}"`', separator=", "):
        if self.names and self.names is not VARIES:
            return separator.join(quote.format(name) for name in self.names)
        counts = only([each.count for each in self.seen])
        types = only([each.type for each in self.seen])
        if VARIES in (self.min, self.max, counts, types) or self.is_free():
            return VARIES
        text = "" if self.min is None else shown(self.min) + (" or more" if self.max is None else f" to {shown(self.max)}")
        if self.type == "numbers":
            least, most = counts
            values = f"{least if least == most else f'{least} to {most}'} values"
            text = f"{values} of {text}" if text else values
        return text

    def fixed_ends(self):
        return [shown(end) for end in (self.min, self.max) if end not in (VARIES, None)]


class Page:
    def __init__(self, path, seen, programs):
        self.path, self.seen, self.programs = path, seen, programs
        self.lines = path.read_text().splitlines()
        self.written = list(self.lines)
        self.documented = {}  # key → for which kinds and presets
        self.problems, self.differences = [], []

    def fill(self):
        """Whether anything is not as the program says."""
        headings, number = {}, 0
        while number < len(self.lines):
            line = self.lines[number]
            if heading := HEADING.match(line):
                depth = len(heading[1])
                headings = {level: text for level, text in headings.items() if level < depth} | {depth: heading[2]}
            if line.startswith("| key"):
                number = self.fill_table(number, headings)
            elif line == "```toml" and re.match(r"\[\w", self.lines[number + 1]):
                number = self.fill_block(number + 1)
            else:
                number += 1
        self.find_undocumented()
        return self.find_differences()

    def find_differences(self):
        for number, (old, new) in enumerate(zip(self.lines, self.written), 1):
            if old != new:
                self.differences.append(f"{self.path.name}:{number}: is\n  {old}\nbut by the program\n  {new}")
        return self.written != self.lines

    def write(self):
        self.path.write_text("\n".join(self.written) + "\n")

    def wrong(self, number, message):
        self.problems.append(f"{self.path.name}:{number + 1}: {message}")

    def find_undocumented(self):
        missing = set()
        for path, seen in self.seen.items():
            for each in seen:
                if not any(suits(each, choices) for choices in self.documented.get(path, [])):
                    missing.add(path + "".join(f", {name} {choice}" for name, choice in each.choices.items() if choice))
        self.problems += [f"{self.path.name}: has no row for {path}" for path in sorted(missing)]

    # Tables

    def tables_of(self, header, headings):
        """The tables of the file that a table of the page is about."""
        if named := QUOTED.findall(header):
            return [name.strip("[]") for name in named]
        name = ""
        for _, text in sorted(headings.items()):
            bracketed = TABLE.match(text)
            name = bracketed[1] if bracketed else f"{name}.{text}" if name else text
        return [name]

    def fill_table(self, number, headings):
        columns = [cell.strip() for cell in self.lines[number].strip("|").split("|")]
        tables = self.tables_of(columns[0], headings)
        number += 2
        while number < len(self.lines) and self.lines[number].startswith("|"):
            cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", self.lines[number][1:-1])]
            if len(cells) != len(columns):
                self.wrong(number, f"has {len(cells)} cells, but the table has {len(columns)} columns")
                number += 1
                continue
            names = ["default" if name.startswith("default of") else name for name in columns[1:]]
            row = dict(zip(["key", *names], cells))
            self.fill_row(number, tables, row, QUOTED.findall(" ".join(columns[1:])))
            self.written[number] = re.sub(r"\|  (?=\|)", "| ", "| " + " | ".join(row.values()) + " |")
            number += 1
        return number

    def fill_row(self, number, tables, row, default_of):
        choices = {column: QUOTED.findall(row[column]) for column in CHOICES if row.get(column)}
        known = []
        for key in QUOTED.findall(row["key"]):
            paths = [path for table in tables for path in fnmatch.filter(self.seen, f"{table}.{key}")]
            seen = [each for path in paths for each in self.seen[path] if suits(each, choices)]
            if not seen:
                self.wrong(number, f"{key}: is not a key of {' or '.join(tables)}{choices or ''}")
                return
            for column, allowed in choices.items():
                for name in set(allowed) - {each.choices.get(column) for each in seen}:
                    self.wrong(number, f"{key}: is not a key of {column} {name}")
            for path in paths:
                self.documented.setdefault(path, []).append(choices)
            known.append(Known(seen, default_of))
        row["default"] = self.filled(number, row, "default", [each.default_text() for each in known], known)
        if "range" in row:
            row["range"] = self.filled(number, row, "range", [each.range_text() for each in known], known)
        elif not all(each.is_free() for each in known):
            self.wrong(number, f"{row['key']}: the table has no column for its range")

    def filled(self, number, row, column, texts, known):
        """The cell with what the program says, as far as that is the same in all files."""
        own, semicolon, by_hand = row[column].partition(";")
        parts = parts_of(own.strip(), len(known))
        if VARIES not in texts:
            return joined(texts) + semicolon + by_hand
        if len(parts) != len(known):
            self.wrong(number, f"{row['key']}: the {column} is for {len(parts)} keys, but there are {len(known)}")
            return row[column]
        for i, (text, each) in enumerate(zip(texts, known)):
            if text is not VARIES:
                parts[i] = text
            elif column == "default":
                self.compare_default(number, row["key"], parts[i], each)
            else:
                self.compare_range(number, row["key"], row[column], each)
        return joined(parts) + semicolon + by_hand

    def compare_default(self, number, key, stated, known):
        """Of a default that depends on other keys, what looks like a value must be one of them."""
        possible = {shown(default) for default in known.defaults}
        if not stated:
            self.wrong(number, f"{key}: the default depends on other keys: say how")
        elif VALUE.fullmatch(stated) and stated not in possible:
            self.wrong(number, f"{key}: the default is never {stated}, but {', '.join(sorted(possible))}")

    def compare_range(self, number, key, stated, known):
        """Of a range that depends on other keys, the end that does not must be there."""
        for end in known.fixed_ends():
            if end not in re.split(r"[\s,;]+", stated):
                self.wrong(number, f"{key}: the range [{stated}] does not say {end}")

    # Blocks of TOML

    def fill_block(self, start):
        """The values of a block are defaults, and the block is a valid file."""
        end = self.lines.index("```", start)
        block = "\n".join(self.lines[start:end])
        said = {}
        for entry in of_scenario(self.programs, block, f"{self.path.name}:{start + 1}"):
            said.setdefault(entry["key"], entry)
        table = ""
        for number in range(start, end):
            line = self.lines[number]
            if header := TABLE.match(line):
                table = header[1]
            elif parts := TOML_LINE.match(line):
                self.fill_line(number, f"{table}.{parts['key']}", parts, said)
        return end + 1

    def fill_line(self, number, path, parts, said):
        if path not in self.seen or path not in said:
            self.wrong(number, f"{path}: is not a key of this file")
            return
        known, entry = Known(self.seen[path]), said[path]
        self.documented.setdefault(path, []).append({})
        value, default = parts["value"].strip(), entry["default"]
        if default is not None and tomllib.loads(f"v = {value}")["v"] != default:
            value = shown(default).strip("`")
        text = known.range_text(quote="{}", separator=" | ")
        if text is VARIES:
            self.compare_range(number, path, parts["range"] or "", known)
        bracketed = parts["range"] if text is VARIES else text
        comment = " ".join(filter(None, [f"[{bracketed}]" if bracketed else "", parts["comment"]]))
        line = f"{parts['key']} = {value}"
        if comment:
            line = f"{line:{COMMENT_COLUMN - 2}}  # {comment}"
        self.written[number] = line
