#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/commands.hpp"

namespace supercoil::host_sim {

namespace {

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// The program that serves pages: the one of the same build, beside this one, or that of the
/// simulator's package, which installs it where no other package has a file of that name.
std::string page_program(const std::filesystem::path& own) {
  for (const char* place : {"supercoil", "../libexec/supercoil-sim/supercoil"}) {
    const std::filesystem::path file = own.parent_path() / place;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return "";
}

int refuse_without_program(const std::filesystem::path& own) {
  return fail(exit_failed, "the program supercoil, which serves pages, was not found beside " +
                               own.string() + ": build or install it too");
}

/// Replaces this program.
int become(std::vector<std::string> words) {
  execv(words.front().c_str(), pointers_to(words).data());
  return fail(exit_failed, "cannot start " + words.front() + ": " + std::strerror(errno));
}

struct Board {
  pid_t process = 0;
  int output = -1;  ///< read end of its standard output
};

/// Starts a simulated board on its own bus; it ends with this program.
std::optional<Board> start_board(const std::filesystem::path& own, const PageOptions& options) {
  std::vector<std::string> words{own.string(), "run",   options.scenario, "--real-time",
                                 "--quiet",    "--can", "socketcand:0",   "--end-with-parent"};
  if (!options.out.empty()) words.insert(words.end(), {"--out", options.out});
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return std::nullopt;
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  for (const int end : ends)
    posix_spawn_file_actions_addclose(&actions, end);
  Board board{0, ends[0]};
  const int error = posix_spawn(&board.process, own.c_str(), &actions, nullptr,
                                pointers_to(words).data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  errno = error;
  return error == 0 ? std::optional(board) : std::nullopt;
}

/// The port of the board's bus, from the first line that it prints; 0: it has ended.
int bus_port(const Board& board) {
  constexpr std::string_view before = "127.0.0.1:";
  std::string line;
  for (char next = 0; read(board.output, &next, 1) == 1 && next != '\n';)
    line += next;
  const std::size_t at = line.find(before);
  int port = 0;
  if (at != std::string::npos)
    std::from_chars(line.data() + at + before.size(), line.data() + line.size(), port);
  return port;
}

}  // namespace

int page_command(const PageOptions& options) {
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe");
  const std::string page = page_program(own);
  if (page.empty()) return refuse_without_program(own);
  const auto board = start_board(own, options);
  if (!board) {
    return fail(exit_failed,
                std::string("cannot start a simulated board: ") + std::strerror(errno));
  }
  const int port = bus_port(*board);
  if (port == 0) {  // it has reported why
    int status = 0;
    waitpid(board->process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : exit_failed;
  }
  std::puts("Open the address below, arm, and move the muscle. Ctrl-C ends it.");
  std::fflush(stdout);
  // So that the board notices the page's end, however that comes. The pipe from the board stays
  // open: writing to it must not fail.
  return become({page, "monitor", "socketcand:" + std::to_string(port), "--port",
                 std::to_string(options.port)});
}

int docs_command(const DocsOptions& options) {
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe");
  const std::string program = page_program(own);
  if (program.empty()) return refuse_without_program(own);
  std::vector<std::string> words{program,        "docs",   "--folder",
                                 options.folder, "--port", std::to_string(options.port)};
  if (options.open) words.emplace_back("--open");
  return become(std::move(words));
}

}  // namespace supercoil::host_sim
