// The page for a reader of the paper.
#include "report/reproduction_table.hpp"

namespace supercoil::host_sim {

namespace {

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>supercoil: the paper, repeated</title>
<style>
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; } h2 { font-size: 1.25rem; margin-top: 2.5rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .88rem; width: 100%; }
th, td { text-align: left; padding: .25rem .6rem; border-bottom: 1px solid #8884; vertical-align: top; }
td.n { font-variant-numeric: tabular-nums; white-space: nowrap; }
td.id { font-family: ui-monospace, monospace; font-size: .8rem; white-space: nowrap; }
figure { margin: 1.5rem 0; } figure img { width: 100%; height: auto; background: #fff; }
figcaption { font-size: .9rem; opacity: .8; }
</style>
</head>
<body>
<h1>The paper, repeated</h1>
<p>The paper models a super-coiled polymer muscle &ndash; a coil of silver-plated nylon that contracts
when it is heated &ndash; by two equations: heating, &psi;&nbsp;d&phi;/dt = &minus;&eta;&phi; + P, and
motion, m&#770;&nbsp;d&sup2;x/dt&sup2; = &minus;&rho;x &minus; &mu;&nbsp;dx/dt + &gamma;&phi;. It learns
the parameters while the muscle moves, and makes it follow a position by model reference adaptive
control. Below, every figure of its Section&nbsp;5 stands beside what its equations give when they are
run. Where the text allows several readings, each is a row of its own. Nothing on this page is copied
from a table of ours: the program that wrote it computed it just before.</p>
)";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// RFC 4648; an SVG inside an <img> keeps its identifiers to itself.
std::string base64(const std::string& bytes) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      result += k <= count ? digits[group >> (18U - 6U * static_cast<unsigned>(k)) & 63U] : '=';
    }
  }
  return result;
}

std::string table(const paper::Part& part) {
  std::string html =
      "<div class=\"wide\"><table>\n<thead><tr><th>id</th><th>case</th><th>quantity</th>"
      "<th>paper</th><th>ours</th><th>unit</th><th>remark</th></tr></thead>\n<tbody>\n";
  for (const paper::ReproductionRow& r : part.rows) {
    html += "<tr><td class=\"id\">" + escaped(r.id) + "</td><td>" + escaped(r.case_name) +
            "</td><td>" + escaped(r.quantity) + "</td><td class=\"n\">" + escaped(r.paper) +
            "</td><td class=\"n\">" + escaped(r.measured) + "</td><td>" + escaped(r.unit) +
            "</td><td>" + escaped(r.remark) + "</td></tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string picture(const paper::NamedFigure& figure, const std::string& svg) {
  return "<figure><img alt=\"" + escaped(figure.title + ". " + figure.caption) +
         "\" src=\"data:image/svg+xml;base64," + base64(svg) + "\"><figcaption><b>" +
         escaped(figure.title) + ".</b> " + escaped(figure.caption) + "</figcaption></figure>\n";
}

}  // namespace

std::string to_html(const std::vector<paper::Part>& parts, const std::vector<std::string>& svg_of) {
  std::string html = head;
  std::size_t next = 0;
  for (const paper::Part& part : parts) {
    html += "<h2>" + escaped(part.title) + "</h2>\n<p>" + escaped(part.introduction) + "</p>\n";
    for (const paper::NamedFigure& figure : part.figures) {
      if (next < svg_of.size() && !svg_of[next].empty()) html += picture(figure, svg_of[next]);
      ++next;
    }
    html += table(part);
  }
  return html + "</body>\n</html>\n";
}

}  // namespace supercoil::host_sim
