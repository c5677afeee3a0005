// A study as an array of jobs for Slurm, and one that merges its parts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace supercoil::host_sim::campaign {

struct Jobs {
  std::filesystem::path program;
  std::string study;  ///< a name, or a whole path
  std::int64_t runs;
  int parts;
};

/// Scripts of one folder, which they are run in.
inline constexpr const char* part_script_name = "part.sbatch";
inline constexpr const char* merge_script_name = "merge.sbatch";
inline constexpr const char* submit_script_name = "submit.sh";
std::string part_script(const Jobs& jobs);
std::string merge_script(const Jobs& jobs);
std::string submit_script(const Jobs& jobs);

}  // namespace supercoil::host_sim::campaign
