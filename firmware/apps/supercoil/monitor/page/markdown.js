// Renders Markdown as docs/faults uses it: headings, paragraphs, lists, tables, code, strong, links. Uses only text
// nodes, so that nothing from the server can become a script.

import { element } from "./dom.js";

const INLINE = /`([^`]+)`|\*\*([^*]+)\*\*|\*([^*]+)\*|\[([^\]]+)\]\(([^)]+)\)/g;

/** link: makes a link's element from text and target. */
function inline(text, link) {
  const parts = [];
  let end = 0;
  for (const match of text.matchAll(INLINE)) {
    parts.push(text.slice(end, match.index));
    const [, code, strong, emphasis, label, target] = match;
    if (code) parts.push(element("code", {}, code));
    else if (strong) parts.push(element("strong", {}, ...inline(strong, link)));
    else if (emphasis) parts.push(element("em", {}, ...inline(emphasis, link)));
    else parts.push(link(label, target));
    end = match.index + match[0].length;
  }
  return [...parts, text.slice(end)];
}

const cells = (line) => line.replace(/^\||\|\s*$/g, "").split("|").map((cell) => cell.trim());

function table(lines, link) {
  const row = (line, kind) => element("tr", {}, ...cells(line).map((cell) => element(kind, {}, ...inline(cell, link))));
  return element("table", {}, element("thead", {}, row(lines[0], "th")), element("tbody", {}, ...lines.slice(2).map((line) => row(line, "td"))));
}

function list(lines, kind, link) {
  const items = [];
  for (const line of lines) {
    const begun = /^\s*(?:[-*]|\d+\.)\s+(.*)$/.exec(line);
    if (begun) items.push(begun[1]);
    else items[items.length - 1] += ` ${line.trim()}`;
  }
  return element(kind, {}, ...items.map((item) => element("li", {}, ...inline(item, link))));
}

const KINDS = [["heading", /^#{1,4} /], ["pre", /^```/], ["table", /^\|/], ["ul", /^[-*] /], ["ol", /^\d+\. /]];

/** Splits a text where another kind of paragraph begins: [kind, lines]. */
function blocks(text) {
  const found = [];
  let kind = null; // null: the next line begins a block
  for (const line of text.split("\n")) {
    const fenced = kind === "pre" && found.at(-1)[1].length > 1 && found.at(-1)[1].at(-1).startsWith("```");
    if (fenced || (line.trim() === "" && kind !== "pre")) kind = null;
    if (line.trim() === "" && kind !== "pre") continue;
    const begins = kind === "pre" ? "pre" : KINDS.find(([, pattern]) => pattern.test(line))?.[0];
    // An indented line continues a list, a plain one a paragraph.
    const here = begins ?? (kind === "ul" || kind === "ol" ? kind : "p");
    if (here !== kind || here === "heading") found.push([here, []]);
    found.at(-1)[1].push(line);
    kind = here;
  }
  return found;
}

/** The elements of a text; link(label, target) makes the element of a link. */
export function markdown(text, link) {
  return blocks(text).map(([kind, lines]) => {
    const [, level, title] = /^(#+) (.*)$/.exec(lines[0]) ?? [];
    if (kind === "heading") return element(`h${level.length + 1}`, {}, ...inline(title, link));
    if (kind === "pre") return element("pre", {}, lines.filter((line) => !line.startsWith("```")).join("\n"));
    if (kind === "table") return table(lines, link);
    if (kind === "p") return element("p", {}, ...inline(lines.join(" "), link));
    return list(lines, kind, link);
  });
}
