// supercoil docs: serves the documentation to a browser on this machine.
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>

#include <spawn.h>
#include <unistd.h>

#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/interrupted.hpp"
#include "apps/supercoil/monitor/access.hpp"
#include "apps/supercoil/monitor/assets.hpp"
#include "apps/supercoil/monitor/server_thread.hpp"

namespace supercoil::operating {

namespace {

constexpr int not_allowed = 405;
constexpr int not_found = 404;
constexpr int forbidden = 403;

/// The file below folder for a request's path, already decoded: "/docs/can.html", or a folder's
/// index.html. None if there is no such file, or if it lies outside folder.
std::optional<std::filesystem::path> find_site_file(const std::filesystem::path& folder,
                                                    std::string_view path) {
  // The operating system would cut a path at a NUL.
  if (path.find('\0') != std::string_view::npos) return std::nullopt;
  std::error_code error;
  const auto site = std::filesystem::canonical(folder, error);
  if (error) return std::nullopt;
  auto wanted = site / std::filesystem::path(path).relative_path();
  if (std::filesystem::is_directory(wanted, error)) wanted /= "index.html";
  // Compared after ".." and links are resolved.
  auto found = std::filesystem::canonical(wanted, error);
  if (error || !std::filesystem::is_regular_file(found, error)) return std::nullopt;
  const auto ends = std::mismatch(site.begin(), site.end(), found.begin(), found.end());
  if (ends.first != site.end()) return std::nullopt;
  return found;
}

/// From a provider, as the library does not compress that: Brotli needs seconds for a script.
void answer_with(httplib::Response& response, const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  auto bytes = std::make_shared<const std::string>(std::istreambuf_iterator<char>(file),
                                                   std::istreambuf_iterator<char>());
  response.set_content_provider(
      bytes->size(), std::string(media_type(path.filename().string())),
      [bytes](std::size_t from, std::size_t length, httplib::DataSink& sink) {
        return sink.write(bytes->data() + from, length);
      });
}

void serve_site(httplib::Server& server, const std::filesystem::path& folder,
                const Access& access) {
  server.set_default_headers({{"Content-Security-Policy",
                               "default-src 'self'; script-src 'self' 'unsafe-inline'; style-src "
                               "'self' 'unsafe-inline'; img-src 'self' data:; frame-ancestors "
                               "'none'"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"}});
  using Handled = httplib::Server::HandlerResponse;
  server.set_pre_routing_handler(
      [&access](const httplib::Request& request, httplib::Response& response) {
        if (request.method != "GET" && request.method != "HEAD") {
          response.status = not_allowed;
          response.set_header("Allow", "GET, HEAD");
          return Handled::Handled;
        }
        if (is_own_host(access, request, access.port)) return Handled::Unhandled;
        response.status = forbidden;
        return Handled::Handled;
      });
  // Answers HEAD as well.
  server.Get(".*", [folder](const httplib::Request& request, httplib::Response& response) {
    const auto file = find_site_file(folder, request.path);
    if (file) return answer_with(response, *file);
    response.status = not_found;
    response.set_content("There is no such page.\n", "text/plain");
  });
}

void open_browser(std::string address) {
  std::string program = "xdg-open";
  std::array<char*, 3> arguments{program.data(), address.data(), nullptr};
  posix_spawnattr_t attributes{};
  posix_spawnattr_init(&attributes);
  // This program ignores SIGPIPE; a program that it starts would inherit that.
  sigset_t usual{};
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  const int error =
      posix_spawnp(&process, program.c_str(), nullptr, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) {
    std::fprintf(stderr, "supercoil: cannot start xdg-open (%s): open the address in a browser\n",
                 std::strerror(error));
  }
}

}  // namespace

int docs_command(const DocsOptions& options) {
  if (!find_site_file(options.folder, "/")) {
    return fail(exit_wrong_input,
                options.folder +
                    ": no documentation here (index.html); install the package supercoil-doc, or "
                    "build it from the sources with toolchain/docs and name its folder: "
                    "--folder build/docs/html");
  }
  watch_for_interrupts();
  httplib::Server server;
  bind_exclusively(server);
  Access access;
  access.host = "127.0.0.1";
  access.port = options.port;
  if (options.port == 0) {
    access.port = server.bind_to_any_port(access.host);
  } else if (!server.bind_to_port(access.host, access.port)) {
    access.port = -1;
  }
  if (access.port <= 0) {
    return fail(exit_failed, "port " + std::to_string(options.port) +
                                 " is in use by another program; choose another with --port");
  }
  serve_site(server, options.folder, access);
  const std::string address = "http://" + access.host + ":" + std::to_string(access.port) + "/";
  std::printf("%s\n", address.c_str());
  std::fflush(stdout);
  const ServerThread thread(server);
  if (options.open) open_browser(address);
  while (interrupted == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return exit_done;
}

}  // namespace supercoil::operating
