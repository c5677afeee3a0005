// report.html. Every figure comes from the tables that campaign.csv is written from; <data> keeps
// all its digits.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "batch/kept_lines.hpp"
#include "campaign/readable.hpp"
#include "campaign/tables.hpp"
#include "report/html_text.hpp"
#include "text/nearest.hpp"

namespace supercoil::host_sim::campaign {

namespace {

/// A cell of HTML.
std::string cell(const std::string& html, const char* kind = "") {
  return "<td" + (*kind == '\0' ? "" : " class=\"" + std::string(kind) + "\"") + ">" + html +
         "</td>";
}

std::string data(const std::string& value, const std::string& text) {
  return "<data value=\"" + value + "\">" + escaped(text) + "</data>";
}
std::string data(std::int64_t count) {
  return data(std::to_string(count), std::to_string(count));
}
std::string data(const Goal& goal, double value) {
  return data(batch::number(value), shown(goal, value));
}
std::string data(double ratio) {
  return data(batch::number(ratio), brief(ratio));
}

/// Failures, their share, and its interval.
std::string cells_of(const Rate& rate) {
  const auto in_percent = [](double share) {
    std::ostringstream text;
    text.precision(2);
    text << std::fixed << 100.0 * share << " %";
    return data(batch::number(share), text.str());
  };
  return cell(data(rate.failures), "n") + cell(in_percent(rate.rate()), "n") +
         cell(in_percent(rate.low), "n") + cell(in_percent(rate.high), "n");
}

/// id: the table's. rows: as HTML.
std::string table_of(const std::string& id, const std::vector<std::string>& head,
                     const std::string& rows) {
  std::string html = R"(<div class="wide" tabindex="0" role="region" aria-label=")" + id +
                     R"("><table id=")" + id + "\">\n<thead><tr>";
  for (const std::string& name : head)
    html += "<th>" + escaped(name) + "</th>";
  return html + "</tr></thead>\n<tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string row_of(const std::string& cells) {
  return "<tr>" + cells + "</tr>\n";
}

std::string definition(const Study& study) {
  const auto row = [](const char* label, const std::string& text) {
    return row_of("<th>" + std::string(label) + "</th>" + cell(escaped(text)));
  };
  std::vector<std::string> contenders;
  for (const compare::Document& contender : study.contenders)
    contenders.push_back(contender.name);
  std::ostringstream scenario;
  scenario << study.scenario;
  std::string html =
      "<h2>The study</h2>\n<div class=\"wide\"><table id=\"asked\">\n<tbody>\n" +
      row("made by", origin_of(study)) + row("scenario", study.base) +
      row("controllers", joined(contenders)) + row("runs", std::to_string(study.runs)) +
      row("sampling", std::string(control::name_of(sampling_names, study.sampling)) + ", seed " +
                          std::to_string(study.seed)) +
      row("tracking window",
          batch::number(study.window.from_s) + " to " + batch::number(study.window.to_s) + " s");
  if (study.known_to > 0.0) {
    const std::string share = brief(100.0 * study.known_to);
    html += row("ends", "when the share of failures is known to ± " + share + " %");
  }
  html +=
      "</tbody></table></div>\n<details><summary>The scenario, before the draws</summary>\n<pre "
      "tabindex=\"0\">" +
      escaped(scenario.str()) + "</pre></details>\n";
  if (study.draws.empty()) return html;
  std::string rows;
  for (const Draw& draw : study.draws) {
    rows += row_of(cell(escaped(draw.name), "id") + cell(escaped(described(draw))) +
                   cell(escaped(joined(draw.keys)), "id"));
  }
  return html + "<h2>What each run draws</h2>\n" +
         table_of("draws", {"draw", "distribution", "keys of the scenario"}, rows);
}

std::string shares(const std::vector<ContenderRow>& table) {
  std::string rows;
  std::string first_refusal;
  for (const ContenderRow& row : table) {
    const auto add_row = [&](const char* label, const Rate& rate) {
      rows += row_of(cell(escaped(row.name)) + cell(label) + cell(data(rate.runs), "n") +
                     cells_of(rate));
    };
    add_row("refused", row.refused);
    add_row("any", row.failures);
    if (!row.reason.empty() && first_refusal.empty())
      first_refusal = "<p>First refusal: " + escaped(row.reason) + "</p>\n";
  }
  return "<h2>How often runs failed</h2>\n<p>Refused: out of all runs. Any: runs that missed a "
         "goal, "
         "out of those that were not refused. 95 % confidence intervals (Clopper-Pearson).</p>\n" +
         table_of("shares", {"controller", "what", "runs", "failures", "share", "from", "to"},
                  rows) +
         first_refusal;
}

std::string goals(const Study& study, const std::vector<ContenderRow>& table) {
  std::string rows;
  for (const ContenderRow& row : table) {
    for (const GoalRow& one : row.goals) {
      const Goal& goal = one.goal;
      rows += row_of(cell(escaped(row.name)) +
                     cell(escaped(std::string(quantity(goal.quantity).name)), "id") +
                     cell("≤ " + data(goal, goal.max), "n") + cell(data(one.failures.runs), "n") +
                     cells_of(one.failures) + cell(data(goal, one.median), "n") +
                     cell(data(goal, one.percentile_95), "n") + cell(data(goal, one.worst), "n") +
                     cell(escaped(deciding(study, one))));
    }
  }
  return "<h2>Goals</h2>\n" +
         table_of("goals",
                  {"controller", "quantity", "goal", "runs", "missed", "share", "from", "to",
                   "median", "95 of 100", "worst", "correlates with"},
                  rows);
}

/// Of every draw that varies, with every goal; bold: more than by chance.
std::string correlations(const Study& study, const std::vector<ContenderRow>& table) {
  std::string rows;
  for (const ContenderRow& row : table) {
    for (const GoalRow& goal : row.goals) {
      const auto order = deciding_draws(goal);
      for (std::size_t i = 0; i < study.draws.size(); ++i) {
        if (std::isnan(goal.rank_correlations[i])) continue;
        const bool counts = std::ranges::find(order, i) != order.end();
        const std::string value = data(goal.rank_correlations[i]);
        rows += row_of(cell(escaped(row.name)) +
                       cell(escaped(std::string(quantity(goal.goal.quantity).name)), "id") +
                       cell(escaped(study.draws[i].name), "id") +
                       cell(counts ? "<strong>" + value + "</strong>" : value, "n"));
      }
    }
  }
  if (rows.empty()) return {};
  return "<h2>Correlations</h2>\n<p>Rank correlation (Spearman) of each quantity with each draw, "
         "before its times and over are applied. Bold: by chance alone, fewer than 3 draws in "
         "1000 reach this.</p>\n<details><summary>All correlations</summary>\n" +
         table_of("correlations", {"controller", "quantity", "draw", "correlation"}, rows) +
         "</details>\n";
}

std::string worst_runs(const Study& study, const std::vector<ContenderRow>& table,
                       const Outcomes& outcomes) {
  const std::string window =
      " --window " + batch::number(study.window.from_s) + ":" + batch::number(study.window.to_s);
  std::string rows;
  for (const ContenderRow& row : table) {
    for (std::size_t i = 0; i < row.worst.size(); ++i) {
      const Key& key = row.worst[i];
      const std::string command =
          "supercoil-sim run " + shell_word(worst_name(row.name, i + 1)) + window;
      rows +=
          row_of(cell(escaped(row.name)) + cell(data(static_cast<std::int64_t>(key.run) + 1), "n") +
                 cell(escaped(missed(study, outcomes.at(key)))) +
                 cell("<code>" + escaped(command) + "</code>"));
    }
  }
  if (rows.empty()) return "<h2>The worst runs</h2>\n<p>No run missed a goal.</p>\n";
  return "<h2>The worst runs</h2>\n<p>Each command, run in the folder of this page, repeats the "
         "run bit for bit.</p>\n" +
         table_of("worst", {"controller", "run", "missed", "command"}, rows);
}

}  // namespace

std::string to_html(const Study& study, const std::vector<ContenderRow>& table,
                    const Outcomes& outcomes, const std::string& svg) {
  std::string html =
      page_begin("supercoil: campaign " + study.name) + "<h1>" + escaped(study.name) + "</h1>\n";
  if (!study.about.empty()) html += "<p>" + escaped(study.about) + "</p>\n";
  html += shares(table) + goals(study, table);
  if (!svg.empty()) {
    html +=
        R"(<figure class="wide" tabindex="0">)" +
        embedded_svg(
            svg, "Each quantity's distribution, and its dependence on the draw it follows most") +
        "</figure>\n";
  }
  return html + correlations(study, table) + worst_runs(study, table, outcomes) +
         definition(study) + page_end();
}

}  // namespace supercoil::host_sim::campaign
