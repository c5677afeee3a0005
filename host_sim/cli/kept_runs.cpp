#include "cli/kept_runs.hpp"

#include <cstdio>

#include "cli/run_results.hpp"

namespace supercoil::host_sim {

KeptRuns::KeptRuns(const std::string& what, const Count& count, OutputFolder& folder, bool quiet)
    : progress_(what, quiet),
      count_(count),
      folder_(&folder),
      path_(folder.path() / runs_name),
      quiet_(quiet) {}

int KeptRuns::begin(const std::string& content) {
  return begin([&](std::ostream& out) { out << content; });
}

int KeptRuns::begin(const std::function<void(std::ostream&)>& content) {
  if (count_.torn) {
    std::fprintf(stderr, "supercoil-sim: %s: its last line is incomplete; that run is repeated\n",
                 path_.c_str());
  }
  if (!quiet_ && count_.todo < count_.all) {
    std::fprintf(stderr, "supercoil-sim: %zu of %zu runs are already in %s\n",
                 count_.all - count_.todo, count_.all, path_.c_str());
  }
  if (const auto kept = folder_->write(runs_name, content); !kept)
    return fail(exit_failed, kept.error().text());
  if (const auto kept = folder_->commit(); !kept) return fail(exit_failed, kept.error().text());
  file_.open(path_, std::ios::binary | std::ios::app);
  catch_interrupts();
  return exit_done;
}

void KeptRuns::add(const std::string& line) {
  file_ << line << std::flush;
  ++ended_;
}

bool KeptRuns::stop() {
  progress_.show(static_cast<double>(ended_) / static_cast<double>(count_.todo),
                 std::to_string(ended_) + " of " + std::to_string(count_.todo) + " runs");
  return interrupted() || !file_;
}

int KeptRuns::end() {
  progress_.end();
  if (!file_) return fail(exit_failed, path_.string() + ": cannot be written");
  if (ended_ == count_.todo) return exit_done;
  return fail(exit_interrupted, "interrupted; " + std::to_string(count_.before + ended_) +
                                    " runs are kept in " + path_.string() +
                                    "; the same command resumes from there");
}

}  // namespace supercoil::host_sim
