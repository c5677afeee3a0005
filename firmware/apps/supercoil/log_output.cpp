#include "apps/supercoil/log_output.hpp"

#include <unistd.h>

#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/output_file.hpp"
#include "storage/posix_files.hpp"

namespace supercoil::operating {

namespace {

int into_standard_output(const std::string& nothing, const Produce& produce) {
  storage::PosixFiles files;
  const auto count = produce([&](std::string_view part) -> tl::expected<void, std::string> {
    const auto written = files.write({STDOUT_FILENO, "standard output"}, part);
    if (!written) return tl::unexpected(written.error().text);
    return {};
  });
  if (!count) return fail(exit_failed, count.error());
  return *count > 0 ? exit_done : fail(exit_wrong_input, nothing);
}

}  // namespace

int write_output(const std::string& path, const std::string& nothing, const Produce& produce) {
  if (path.empty()) return into_standard_output(nothing, produce);
  storage::PosixFiles files;
  auto file = OutputFile::open(path, files);
  if (!file) return fail(exit_wrong_input, file.error());
  const auto count = produce([&](std::string_view part) { return file->write(part); });
  if (!count) return fail(exit_failed, count.error());
  if (*count == 0) return fail(exit_wrong_input, nothing);
  const auto kept = file->commit();
  return kept ? exit_done : fail(exit_failed, kept.error());
}

}  // namespace supercoil::operating
