#include <algorithm>
#include <cstdio>

#include "apps/supercoil/bus_dbc.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/user_file.hpp"
#include "storage/posix_files.hpp"

namespace supercoil::operating {

int dbc_command(const DbcOptions& options) {
  std::vector<int> nodes = options.nodes;
  std::sort(nodes.begin(), nodes.end());
  const auto twice = std::adjacent_find(nodes.begin(), nodes.end());
  if (twice != nodes.end()) {
    return fail(exit_wrong_input, "--nodes: " + std::to_string(*twice) + " is named twice");
  }
  const std::string text =
      nodes.empty() ? std::string(node_1_dbc) : bus_dbc(node_1_dbc, options.nodes);
  if (options.out.empty()) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return exit_done;
  }
  storage::PosixFiles files;
  auto file = OutputFile::open(options.out, files);
  if (!file) return fail(exit_wrong_input, file.error().text());
  auto written = file->write(text);
  if (written) written = file->commit();
  return written ? exit_done : fail(exit_failed, written.error().text());
}

}  // namespace supercoil::operating
