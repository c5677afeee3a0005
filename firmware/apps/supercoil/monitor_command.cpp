// supercoil monitor: shows a bus or a log on a page.
#include <cstdio>
#include <filesystem>
#include <thread>

#include <sys/resource.h>

#include "apps/supercoil/bus/bus_name.hpp"
#include "apps/supercoil/bus/listener.hpp"
#include "apps/supercoil/bus/log_file.hpp"
#include "apps/supercoil/bus/terminal.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/interrupted.hpp"
#include "apps/supercoil/monitor/api.hpp"
#include "apps/supercoil/monitor/server_thread.hpp"
#include "apps/supercoil/monitor/stop.hpp"
#include "apps/supercoil/setup/board_file.hpp"
#include "apps/supercoil/setup/setup_session.hpp"

namespace supercoil::operating {

namespace {

constexpr int page_threads = 40;

/// What is watched: a log that was read, or a listener on a bus.
struct Source {
  std::unique_ptr<FrameHistory> frame_history;
  std::unique_ptr<Listener> listener;
  bool log = false;
};

Result<Source> open_source(const MonitorOptions& options) {
  Source source;
  std::error_code ignored;
  source.log =
      !is_socketcand_name(options.source) && std::filesystem::exists(options.source, ignored);
  source.frame_history =
      std::make_unique<FrameHistory>(source.log ? 0.0 : options.keep_s, options.bit_rate);
  if (source.log) {
    auto log = read_can_log(options.source);
    if (!log) return tl::unexpected(log.error());
    if (log->damaged_lines > 0) {
      std::fprintf(stderr, "supercoil: %s\n", log->damage_text().c_str());
    }
    if (!log->goes_back.empty()) {
      std::fprintf(stderr,
                   "supercoil: %s; what follows is shown at one time: split the log there\n",
                   log->goes_back.c_str());
    }
    source.frame_history->add(log->frames);
    return source;
  }
  auto bus = open_bus(options.source);
  if (!bus && !is_socketcand_name(options.source)) {
    // An interface's name has no slash, and hardly ever a dot.
    const bool file = options.source.find_first_of("./") != std::string::npos;
    return failure(file ? options.source + ": no such log"
                        : bus.error().text() + "; nor is there a log of that name");
  }
  if (!bus) return tl::unexpected(bus.error());
  source.listener = std::make_unique<Listener>(std::move(*bus), *source.frame_history);
  return source;
}

/// Connections to the page are not limited: a thousand of them must not take the descriptors that
/// STOP's own port needs.
void allow_many_connections() {
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  files.rlim_cur = files.rlim_max;
  setrlimit(RLIMIT_NOFILE, &files);
}

int serve_page(const MonitorOptions& options, Source& source) {
  allow_many_connections();
  Access access{options.listen, options.port, new_token(), is_loopback(options.listen),
                options.read_only};
  httplib::Server server;
  server.new_task_queue = [] { return new httplib::ThreadPool(page_threads); };
  bind_exclusively(server);
  server.set_payload_max_length(4096);
  server.set_read_timeout(5);
  server.set_write_timeout(5);
  server.set_keep_alive_timeout(2);
  server.set_tcp_nodelay(true);
  if (access.port == 0) {
    access.port = server.bind_to_any_port(access.host);
  } else if (!server.bind_to_port(access.host, access.port)) {
    access.port = -1;
  }
  if (access.port <= 0) {
    return fail(exit_failed,
                "port " + std::to_string(options.port) + " of " + access.host +
                    " is not available: another program uses it, or the address is not "
                    "this machine's; choose another with --port");
  }

  const auto open_for = [&](const std::vector<std::uint16_t>& listen) -> ManualControl::OpenBus {
    return [name = options.source, listen] { return open_bus(name, listen); };
  };
  ManualControls controls(
      [&](std::uint8_t node) { return open_for(can_client::answer_ids(node)); });
  std::unique_ptr<SetupSession> setup;
  if (!options.setup.empty()) {
    SetupOptions setup_options;
    setup_options.config = options.setup;
    setup_options.channel = options.channel;
    setup_options.can = options.source;
    setup = std::make_unique<SetupSession>(setup_options,
                                           [&] { controls.release_hold("setup took over"); });
  }
  std::unique_ptr<StopServer> stop;
  if (!source.log && !access.read_only) {
    auto started =
        StopServer::start(access, open_for(StopServer::received_ids()), *source.frame_history, [&] {
          controls.release_hold("stopped");
          if (setup) setup->end("STOP");
        });
    if (!started) return fail(exit_failed, started.error().text());
    stop = std::move(*started);
  }
  Api api(access, *source.frame_history, controls,
          {options.source, source.log, stop ? stop->port() : 0, setup != nullptr});
  api.serve_with(server);
  if (setup) setup->serve_with(server, access);
  const bool token = !source.log && !access.read_only;
  std::printf("http://%s:%d/%s%s\n", access.host.c_str(), access.port,
              token || !access.loopback ? "#token=" : "",
              token || !access.loopback ? access.token.c_str() : "");
  std::fflush(stdout);
  const ServerThread thread(server);
  while (interrupted == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  api.end();
  return exit_done;
}

}  // namespace

int monitor_command(const MonitorOptions& options) {
  if (options.listen.find(':') != std::string::npos) {
    return fail(exit_wrong_input, "--listen " + options.listen +
                                      ": must be an IPv4 address or a name, such as 0.0.0.0");
  }
  const std::string missing =
      options.setup.empty() ? "" : missing_channel(options.setup, options.channel);
  if (!missing.empty()) return fail(exit_wrong_input, missing);
  auto source = open_source(options);
  if (!source) return fail(exit_wrong_input, source.error().text());
  if (!options.setup.empty() && source->log)
    return fail(exit_wrong_input, options.source + " is a log: --setup needs a board on a bus");
  watch_for_interrupts();
  if (!options.text) return serve_page(options, *source);
  return show_on_terminal(*source->frame_history, source->log, [] { return interrupted != 0; });
}

}  // namespace supercoil::operating
