#include "cli/campaign_results.hpp"

#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "apps/common/keys_json.hpp"
#include "batch/kept_lines.hpp"
#include "campaign/tables.hpp"
#include "cli/kept_runs.hpp"
#include "cli/results_json.hpp"
#include "cli/run_results.hpp"
#include "cli/tables.hpp"

namespace supercoil::host_sim {

std::string replay(const campaign::Study& study, const campaign::Draws& draws,
                   const std::vector<double>& drawn, const campaign::Key& key) {
  std::ostringstream text;
  const auto document = draws.document(drawn, key.contender, key.run);
  text << "# Run " << key.run + 1 << " of " << study.name << ", "
       << study.contenders[key.contender].name << "; tracking from " << study.window.from_s
       << " to " << study.window.to_s << " s\n";
  if (document) text << *document << "\n";
  return text.str();
}

int conclude_campaign(const campaign::Study& study, const campaign::Draws& draws,
                      const campaign::Outcomes& outcomes, OutputFolder& folder,
                      const CampaignOptions& options) {
  const auto table = table_of(study, draws, outcomes);
  const std::string markdown = to_markdown(study, table, outcomes);
  std::string svg;
  if (options.plot) {
    const Figure figure = figure_of(study, draws, outcomes, table);
    if (!figure.panels.empty()) svg = write_svg(folder, figure, "campaign.svg");
  }
  const campaign::Lines lines(study, draws);
  const auto kept = folder.write(runs_name, [&](std::ostream& out) { lines.write(out, outcomes); });
  if (!kept) return fail(exit_failed, kept.error().text());
  const std::string csv = to_csv(table);
  Tables tables{{{"campaign.csv", csv},
                 {"campaign.md", markdown},
                 {"report.html", to_html(study, table, outcomes, svg)}},
                markdown,
                outcomes.size(),
                rows_json(csv, {"controller", "quantity"})};
  for (const campaign::ContenderRow& row : table) {
    for (std::size_t i = 0; i < row.worst.size(); ++i) {
      const campaign::Key& key = row.worst[i];
      tables.files.emplace_back(campaign::worst_name(row.name, i + 1),
                                replay(study, draws, draws.of_run(key.run), key));
    }
  }
  return conclude_tables(tables, folder, {options.json, options.quiet});
}

int merge_campaign(const campaign::Study& study, const campaign::Draws& draws,
                   const CampaignOptions& options) {
  campaign::Outcomes outcomes;
  const campaign::Lines lines(study, draws);
  const auto added = batch::add_parts(
      options.merge, std::filesystem::path(options.out) / runs_name,
      [&](const std::filesystem::path& part) { return lines.read(part, outcomes); });
  if (!added) return refuse(options.json, exit_wrong_input, added.error().text());
  const auto all = static_cast<std::size_t>(study.runs) * study.contenders.size();
  if (outcomes.size() < all) {
    std::fprintf(stderr, "supercoil-sim: the parts have %zu of the study's %zu runs\n",
                 outcomes.size(), all);
  }
  auto folder = OutputFolder::open(options.out);
  if (!folder) return refuse(options.json, exit_wrong_input, folder.error().text());
  return conclude_campaign(study, draws, outcomes, *folder, options);
}

int print_keys(const config::KeyList& keys, bool json) {
  if (json) {
    std::puts(keys_json(keys).dump(2).c_str());
  } else {
    std::fputs(config::to_text(keys).c_str(), stdout);
  }
  return exit_done;
}

int print_study(const campaign::Study& study, const CampaignOptions& options) {
  if (!options.json) {
    std::printf("%s: in order, %" PRId64 " runs, controllers: %zu, draws: %zu\n",
                options.study.c_str(), study.runs, study.contenders.size(), study.draws.size());
    return exit_done;
  }
  nlohmann::ordered_json controllers = nlohmann::ordered_json::array();
  for (const compare::Document& one : study.contenders)
    controllers.push_back(one.name);
  nlohmann::ordered_json draws = nlohmann::ordered_json::array();
  for (const campaign::Draw& one : study.draws)
    draws.push_back(one.name);
  nlohmann::ordered_json goals = nlohmann::ordered_json::object();
  for (const campaign::Goal& one : study.goals)
    goals[std::string(campaign::quantity(one.quantity).name)] = one.max;
  print_results(
      {{"runs", study.runs}, {"controllers", controllers}, {"draws", draws}, {"goals", goals}});
  return exit_done;
}

int list_studies(bool json) {
  if (json) {
    nlohmann::ordered_json quantities = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < campaign::quantity_count; ++i) {
      const campaign::Quantity one = campaign::quantity(i);
      quantities.push_back({{"name", one.name}, {"description", one.meaning}});
    }
    print_results(
        {{"studies", entries_json(campaign::builtin_studies())}, {"quantities", quantities}});
    return exit_done;
  }
  for (const BuiltinScenario& study : campaign::builtin_studies()) {
    const auto what = description(study);
    std::printf("%-16.*s %.*s\n", static_cast<int>(study.name.size()), study.name.data(),
                static_cast<int>(what.size()), what.data());
  }
  std::puts("\nQuantities, for [goals]:");
  for (std::size_t i = 0; i < campaign::quantity_count; ++i) {
    const campaign::Quantity one = campaign::quantity(i);
    std::printf("  %-22.*s %.*s\n", static_cast<int>(one.name.size()), one.name.data(),
                static_cast<int>(one.meaning.size()), one.meaning.data());
  }
  return exit_done;
}

}  // namespace supercoil::host_sim
