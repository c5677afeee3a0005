#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "campaign/slurm.hpp"
#include "cli/campaign_results.hpp"

namespace supercoil::host_sim {

int submit_campaign(const campaign::Study& study, const CampaignOptions& options) {
  namespace fs = std::filesystem;
  // As read_study() takes it: a built-in name before a file.
  const auto names = names_of(campaign::builtin_studies());
  const bool builtin = std::ranges::find(names, options.study) != names.end();
  const campaign::Jobs jobs{fs::read_symlink("/proc/self/exe"),
                            builtin ? options.study : fs::absolute(options.study).string(),
                            study.runs, options.slurm};
  auto folder = OutputFolder::open(options.out);
  if (!folder) return fail(exit_wrong_input, folder.error());
  for (const auto& [name, text] :
       {std::pair{campaign::part_script_name, campaign::part_script(jobs)},
        {campaign::merge_script_name, campaign::merge_script(jobs)},
        {campaign::submit_script_name, campaign::submit_script(jobs)}}) {
    if (const auto written = folder->write(name, text); !written)
      return fail(exit_failed, written.error());
  }
  if (const auto done = folder->commit(); !done) return fail(exit_failed, done.error());
  const fs::path script = folder->path() / campaign::submit_script_name;
  if (!options.submit) {
    std::printf("written; to submit it: sh %s\n", script.c_str());
    return exit_done;
  }
  std::fflush(stdout);
  // The path goes in by the environment: no shell reads it.
  setenv("SUPERCOIL_SUBMIT", script.c_str(), 1);
  if (std::system(R"(sh "$SUPERCOIL_SUBMIT")") == 0) return exit_done;  // NOLINT(cert-env33-c)
  return fail(exit_failed, script.string() +
                               ": could not be submitted; on a machine that has sbatch: sh " +
                               script.string());
}

}  // namespace supercoil::host_sim
