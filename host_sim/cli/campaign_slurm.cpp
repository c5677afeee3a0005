#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "campaign/readable.hpp"
#include "cli/campaign_results.hpp"

namespace supercoil::host_sim {

namespace {

namespace fs = std::filesystem;

constexpr const char* submit_name = "submit.sh";

struct Jobs {
  fs::path program;
  std::string study;  ///< a name, or a whole path
  std::int64_t runs;
  int parts;
};

std::string command(const Jobs& jobs) {
  return campaign::shell_word(jobs.program.string()) + " campaign " +
         campaign::shell_word(jobs.study) + " --runs " + std::to_string(jobs.runs);
}

std::string part_script(const Jobs& jobs) {
  return "#!/bin/sh\n"
         "# One part of the study. It resumes up to twice after it is killed (137, e.g. out of "
         "memory),\n"
         "# and whenever its job is queued again.\n"
         "for attempt in 1 2 3; do\n"
         "  status=0\n"
         "  " +
         command(jobs) + " --shard \"$SLURM_ARRAY_TASK_ID\"/" + std::to_string(jobs.parts) +
         " --out \"part-$SLURM_ARRAY_TASK_ID\" --jobs \"${SLURM_CPUS_PER_TASK:-1}\" --no-plot "
         "--quiet || status=$?\n"
         "  [ \"$status\" -eq 137 ] || exit \"$status\"\n"
         "done\n"
         "exit \"$status\"\n";
}

std::string merge_script(const Jobs& jobs) {
  return "#!/bin/sh\n# Merges all parts into the tables.\nexec " + command(jobs) +
         " --merge part-*/runs.csv --out .\n";
}

std::string submit_script(const Jobs& jobs) {
  return "#!/bin/sh\n"
         "# Submits the parts, and the job that merges them when all are done. Arguments go to "
         "sbatch\n"
         "# for the parts: sh submit.sh --cpus-per-task=8 --time=2:00:00\n"
         "set -eu\n"
         "cd \"$(dirname \"$0\")\"\n"
         "parts=$(sbatch --parsable --requeue --array=1-" +
         std::to_string(jobs.parts) +
         " --output=part-%a.log --open-mode=append \"$@\" part.sbatch)\n"
         "parts=${parts%%;*}  # without the cluster's name\n"
         "merge=$(sbatch --parsable --dependency=afterok:\"$parts\" --kill-on-invalid-dep=yes "
         "--output=merge.log merge.sbatch)\n"
         "echo \"job $parts runs the parts, job ${merge%%;*} merges them\"\n";
}

}  // namespace

int submit_campaign(const campaign::Study& study, const CampaignOptions& options) {
  // As in read_study(), a built-in name takes precedence over a file.
  const auto names = names_of(campaign::builtin_studies());
  const bool builtin = std::ranges::find(names, options.study) != names.end();
  const Jobs jobs{fs::read_symlink("/proc/self/exe"),
                  builtin ? options.study : fs::absolute(options.study).string(), study.runs,
                  options.slurm};
  auto folder = OutputFolder::open(options.out);
  if (!folder) return fail(exit_wrong_input, folder.error().text());
  for (const auto& [name, text] : {std::pair{"part.sbatch", part_script(jobs)},
                                   {"merge.sbatch", merge_script(jobs)},
                                   {submit_name, submit_script(jobs)}}) {
    if (const auto written = folder->write(name, text); !written)
      return fail(exit_failed, written.error().text());
  }
  if (const auto done = folder->commit(); !done) return fail(exit_failed, done.error().text());
  const fs::path script = folder->path() / submit_name;
  if (!options.submit) {
    std::printf("scripts written; to submit them: sh %s\n", script.c_str());
    return exit_done;
  }
  std::fflush(stdout);
  // The path is passed in the environment: no shell interprets it.
  setenv("SUPERCOIL_SUBMIT", script.c_str(), 1);
  if (std::system(R"(sh "$SUPERCOIL_SUBMIT")") == 0) return exit_done;  // NOLINT(cert-env33-c)
  return fail(exit_failed, script.string() +
                               ": could not be submitted; on a machine with sbatch, run: sh " +
                               script.string());
}

}  // namespace supercoil::host_sim
