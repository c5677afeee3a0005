#include <algorithm>
#include <atomic>
#include <cstdio>
#include <utility>

#include "batch/in_parallel.hpp"
#include "campaign/results.hpp"
#include "campaign/statistics.hpp"
#include "cli/campaign_results.hpp"
#include "cli/commands.hpp"
#include "cli/kept_runs.hpp"
#include "cli/results_json.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

namespace {

/// Each contender's failure rate is checked after this many runs, whatever the jobs, so that a
/// study always ends at the same run.
constexpr std::int64_t check_every_runs = 100;

/// At the median of all draws, the study must give a valid scenario.
std::string check_medians(const campaign::Study& study, const campaign::Draws& draws) {
  std::string problems;
  for (std::size_t i = 0; i < study.contenders.size(); ++i) {
    const auto scenario = draws.scenario(draws.medians(), i, 0);
    if (!scenario) {
      problems += "at the median of all draws, with " + study.contenders[i].name + ":\n" +
                  config::to_text(scenario.error());
    }
  }
  return problems;
}

/// The shard's runs from `from` to before `to`, of all contenders, that have no outcome yet.
std::vector<campaign::Key> missing(const campaign::Study& study, const batch::Shard& shard,
                                   const campaign::Outcomes& outcomes, std::int64_t from,
                                   std::int64_t to) {
  std::vector<campaign::Key> runs;
  for (std::int64_t run = from; run < to; ++run) {
    if (run % shard.count != shard.number - 1) continue;
    for (std::size_t i = 0; i < study.contenders.size(); ++i) {
      const campaign::Key key{static_cast<std::size_t>(run), i};
      if (!outcomes.contains(key)) runs.push_back(key);
    }
  }
  return runs;
}

/// Each contender's share of failures, over the runs that were counted.
class Shares {
 public:
  explicit Shares(const campaign::Study& study)
      : study_(&study), runs_(study.contenders.size()), failures_(study.contenders.size()) {}

  void count(const campaign::Outcomes& outcomes, std::int64_t from, std::int64_t to) {
    const auto end = outcomes.lower_bound({static_cast<std::size_t>(to), 0});
    for (auto one = outcomes.lower_bound({static_cast<std::size_t>(from), 0}); one != end; ++one) {
      const auto& [key, outcome] = *one;
      if (!outcome.refused.empty()) continue;
      ++runs_[key.contender];
      failures_[key.contender] += severity(*study_, outcome) > 1.0 ? 1 : 0;
    }
  }
  bool known_to(double half_width) const {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (campaign::rate_of(failures_[i], runs_[i]).half_width() > half_width) return false;
    }
    return true;
  }

 private:
  const campaign::Study* study_;
  std::vector<std::int64_t> runs_;
  std::vector<std::int64_t> failures_;
};

void carry_out_all(const campaign::Study& study, const campaign::Draws& draws,
                   const CampaignOptions& options, campaign::Outcomes& outcomes, KeptRuns& kept) {
  const campaign::Lines lines(study, draws);
  Shares shares(study);
  bool stopped = false;
  const bool checks_precision = study.known_to > 0.0;
  const std::int64_t step = checks_precision ? check_every_runs : study.runs;
  for (std::int64_t from = 0; from < study.runs && !stopped; from += step) {
    const std::int64_t to = std::min(study.runs, from + step);
    const auto todo = missing(study, options.shard, outcomes, from, to);
    if (!todo.empty()) {
      batch::in_parallel(
          todo.size(), batch::threads_for(options.jobs),
          [&](std::size_t number, const std::atomic<bool>& stop) -> batch::Handover {
            const campaign::Key& key = todo[number];
            auto outcome = carry_out(study, draws, key, stop);
            if (!outcome) return {};
            return [&, key, done = std::move(*outcome)] {
              kept.add(lines.line(key, done));
              outcomes.emplace(key, done);
            };
          },
          [&] { return stopped = kept.stop(); });
    }
    if (stopped || !checks_precision) continue;
    shares.count(outcomes, from, to);
    if (shares.known_to(study.known_to)) return kept.stop_early();
  }
}

}  // namespace

int campaign_command(const CampaignOptions& given) {
  if (given.list) return list_studies(given.json);
  if (given.study.empty()) {
    return refuse(given.json, exit_wrong_input,
                  "campaign: no study given: name a TOML file or a study from --list");
  }
  config::KeyList keys;
  auto study = campaign::read_study(given.study, given.runs, given.keys ? &keys : nullptr);
  if (!study) return refuse_problems(given.json, study.error());
  CampaignOptions options = given;
  if (options.out.empty()) options.out = "supercoil-out/campaign-" + study->name;
  const batch::Shard& shard = options.shard;
  if (shard.number < 1 || shard.number > shard.count)
    return refuse(options.json, exit_wrong_input, "--shard: must be I/N with 1 <= I <= N");
  if ((shard.count > 1 || options.slurm > 0) && study->known_to > 0.0) {
    return refuse(options.json, exit_wrong_input,
                  given.study +
                      ": study.known_to: one part cannot tell when the whole study is known well "
                      "enough; remove it for --shard and --slurm");
  }
  const campaign::Draws draws(*study);
  if (const std::string problems = check_medians(*study, draws); !problems.empty())
    return refuse_lines(options.json, problems);
  if (options.slurm > 0) return submit_campaign(*study, options);
  if (options.search > 0 && study->draws.empty()) {
    return refuse(options.json, exit_wrong_input,
                  given.study + ": has no [[draw]]: nothing to search over");
  }
  if (options.keys) return print_keys(keys, options.json);
  if (options.check) return print_study(*study, options);
  if (options.search > 0) return search_campaign(*study, draws, options);
  if (!options.merge.empty()) return merge_campaign(*study, draws, options);

  auto folder = OutputFolder::open(options.out);
  if (!folder) return refuse(options.json, exit_wrong_input, folder.error().text());
  const campaign::Lines lines(*study, draws);
  campaign::Outcomes outcomes;
  const auto torn = lines.read(folder->path() / runs_name, outcomes);
  if (!torn) return refuse(options.json, exit_wrong_input, torn.error().text());
  const auto all = missing(*study, shard, {}, 0, study->runs).size();
  const auto todo = missing(*study, shard, outcomes, 0, study->runs).size();
  KeptRuns kept("campaign", {outcomes.size(), all, todo, *torn}, *folder, options.quiet);
  const auto begun = [&](std::ostream& out) { lines.write(out, outcomes); };
  if (const int failed = kept.begin(begun); failed != exit_done) return failed;
  if (todo > 0) carry_out_all(*study, draws, options, outcomes, kept);
  if (const int failed = kept.end(); failed != exit_done) return failed;
  return conclude_campaign(*study, draws, outcomes, *folder, options);
}

}  // namespace supercoil::host_sim
