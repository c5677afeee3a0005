// The page for a reader of the paper.
#include "report/html_text.hpp"
#include "report/reproduction_table.hpp"

namespace supercoil::host_sim {

namespace {

constexpr const char* introduction = R"(<h1>The paper, repeated</h1>
<p>The paper models a super-coiled polymer muscle &ndash; a coil of silver-plated nylon that contracts
when it is heated &ndash; by two equations: heating, &psi;&nbsp;d&phi;/dt = &minus;&eta;&phi; + P, and
motion, m&#770;&nbsp;d&sup2;x/dt&sup2; = &minus;&rho;x &minus; &mu;&nbsp;dx/dt + &gamma;&phi;. It learns
the parameters while the muscle moves, and makes it follow a position by model reference adaptive
control. Below, every figure of its Section&nbsp;5 is shown beside the result of running its
equations. Where the text allows several readings, each is a row of its own. Nothing on this page is
copied from a table: the program computed every value while writing the page.</p>
)";

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
  return "<figure>" + embedded_svg(svg, figure.title + ". " + figure.caption) + "<figcaption><b>" +
         escaped(figure.title) + ".</b> " + escaped(figure.caption) + "</figcaption></figure>\n";
}

}  // namespace

std::string to_html(const std::vector<paper::Part>& parts, const std::vector<std::string>& svg_of) {
  std::string html = page_begin("supercoil: the paper, repeated") + introduction;
  std::size_t next = 0;
  for (const paper::Part& part : parts) {
    html += "<h2>" + escaped(part.title) + "</h2>\n<p>" + escaped(part.introduction) + "</p>\n";
    for (const paper::NamedFigure& figure : part.figures) {
      if (next < svg_of.size() && !svg_of[next].empty()) html += picture(figure, svg_of[next]);
      ++next;
    }
    html += table(part);
  }
  return html + page_end();
}

}  // namespace supercoil::host_sim
