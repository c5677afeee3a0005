// Markdown as docs/faults uses it, to elements: headings, paragraphs, lists, tables, code, strong, links. Made of text
// nodes only: what the server sends can be no script.

import { element } from "./dom.js";

const INLINE = /`([^`]+)`|\*\*([^*]+)\*\*|\*([^*]+)\*|\[([^\]]+)\]\(([^)]+)\)/g;

/** link: makes the element of a link from text and target. */
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

/** The elements of a text; link(label, target) makes the element of a link. */
export function markdown(text, link) {
  return text.trim().split(/\n\s*\n/).flatMap((paragraph) => {
    const lines = paragraph.split("\n");
    const heading = /^(#{1,4}) (.*)$/.exec(lines[0]);
    if (heading) {
      const rest = lines.slice(1).join("\n");
      return [element(`h${heading[1].length + 1}`, {}, ...inline(heading[2], link)), ...(rest.trim() ? markdown(rest, link) : [])];
    }
    if (/^```/.test(lines[0])) return element("pre", {}, lines.slice(1, -1).join("\n"));
    if (/^\|/.test(lines[0])) return table(lines, link);
    if (/^[-*] /.test(lines[0])) return list(lines, "ul", link);
    if (/^\d+\. /.test(lines[0])) return list(lines, "ol", link);
    return element("p", {}, ...inline(lines.join(" "), link));
  });
}
