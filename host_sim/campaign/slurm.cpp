#include "campaign/slurm.hpp"

namespace supercoil::host_sim::campaign {

namespace {

/// One word for a shell, whatever is in it.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text)
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string command(const Jobs& jobs) {
  return quoted(jobs.program.string()) + " campaign " + quoted(jobs.study) + " --runs " +
         std::to_string(jobs.runs);
}

}  // namespace

std::string part_script(const Jobs& jobs) {
  return "#!/bin/sh\n"
         "# One part of the study. Killed (137: out of memory, for one) it goes on, twice; a job "
         "that\n"
         "# is queued again goes on too.\n"
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
  return "#!/bin/sh\n# The tables of all parts.\nexec " + command(jobs) +
         " --merge part-*/runs.csv --out .\n";
}

std::string submit_script(const Jobs& jobs) {
  return "#!/bin/sh\n"
         "# Submits the parts, and what merges them when all are done. More for sbatch: its\n"
         "# environment, as SBATCH_PARTITION and SBATCH_TIMELIMIT.\n"
         "set -eu\n"
         "cd \"$(dirname \"$0\")\"\n"
         "parts=$(sbatch --parsable --requeue --array=1-" +
         std::to_string(jobs.parts) + " --output=part-%a.log --open-mode=append " +
         part_script_name +
         ")\n"
         "merge=$(sbatch --parsable --dependency=afterok:\"$parts\" --output=merge.log " +
         merge_script_name +
         ")\n"
         "echo \"job $parts runs the parts, job $merge merges them\"\n";
}

}  // namespace supercoil::host_sim::campaign
