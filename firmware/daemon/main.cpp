// supercoild: the firmware as a program.
#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>

#include "config/board_config.hpp"
#include "config/describe.hpp"

namespace {

using namespace supercoil;

constexpr int exit_done = 0;
constexpr int exit_failed = 1;
constexpr int exit_wrong_input = 2;

int check_file(const std::string& path) {
  const auto config = config::read_board_config(path);
  if (!config) {
    std::fputs(config::to_text(config.error()).c_str(), stderr);
    return exit_wrong_input;
  }
  std::fputs(config::describe(*config).c_str(), stdout);
  return exit_done;
}

int run_program(int count, char** arguments) {
  CLI::App app{"The firmware of a board that drives super-coiled polymer muscles.", "supercoild"};
  app.set_version_flag("--version", SUPERCOIL_VERSION);
  std::string file;
  app.add_option("--check", file, "Read a board's configuration and say what was understood")
      ->type_name("FILE");
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? exit_done : exit_wrong_input;
  }
  if (app.count("--check") > 0) return check_file(file);
  std::fputs(
      "supercoild: this build has no hardware layer yet and drives no board; it can only check a "
      "configuration: supercoild --check FILE. To run the firmware over a simulated muscle: "
      "supercoil-sim\n",
      stderr);
  return exit_wrong_input;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    const int status = run_program(count, arguments);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    std::fputs("supercoild: cannot write to standard output\n", stderr);
    return exit_failed;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "supercoild: %s\n", error.what());
    return exit_failed;
  }
}
