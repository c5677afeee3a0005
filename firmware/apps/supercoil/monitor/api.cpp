#include "apps/supercoil/monitor/api.hpp"

#include <algorithm>
#include <charconv>
#include <thread>
#include <utility>

#include <nlohmann/json.hpp>

#include "apps/supercoil/identified_deviations.hpp"
#include "apps/supercoil/monitor/assets.hpp"
#include "apps/supercoil/monitor/batch.hpp"
#include "apps/supercoil/monitor/command_request.hpp"
#include "apps/supercoil/monitor/trajectory_request.hpp"
#include "apps/supercoil/monitor/tuning_request.hpp"
#include "loop/feasibility.hpp"
#include "telemetry/opcodes.hpp"
#include "text/program_version.hpp"
#include "text/refusal_words.hpp"
#include "text/result_words.hpp"

namespace supercoil::operating {

namespace {

using nlohmann::json;

constexpr auto stream_every = std::chrono::milliseconds(50);
constexpr auto stream_retry_after = std::chrono::milliseconds(1000);
constexpr int beat_after = 20;  // quiet pieces: a second

/// A time in seconds from a query; the fallback when the query has none.
std::optional<hal::Time> time_of(const httplib::Request& request, const std::string& name,
                                 hal::Time fallback) {
  if (!request.has_param(name)) return fallback;
  const std::string text = request.get_param_value(name);
  double time_s = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), time_s);
  constexpr double max_s = 4e9;
  const bool right = read.ec == std::errc{} && read.ptr == text.data() + text.size();
  if (!right || !(std::abs(time_s) < max_s)) return std::nullopt;
  return hal::duration_from(time_s);
}

/// The limits, and how long without a break one must last, that show a reference was infeasible.
json infeasible_json() {
  json limits = json::array();
  for (std::size_t i = 0; i < limit_names.size(); ++i) {
    if (is_infeasible(static_cast<LimitedBy>(i))) limits.push_back(limit_names.at(i));
  }
  return {{"limits", limits}, {"lasts_s", infeasible_lasts_s}};
}

/// Origins to which the page may post STOP: this server's other port, under the name by which the
/// page was requested.
std::string stop_origins(const Access& access, int stop_port) {
  const std::string port = ":" + std::to_string(stop_port);
  if (!access.loopback) return "http://*" + port;
  return "http://" + access.host + port + " http://localhost" + port;
}

void add_headers(httplib::Server& server, const Access& access, int stop_port) {
  server.set_default_headers(
      {{"Content-Security-Policy",
        "default-src 'self'; connect-src 'self' " + stop_origins(access, stop_port) +
            "; style-src 'self' 'unsafe-inline'; img-src 'self' data:; frame-ancestors 'none'"},
       {"X-Content-Type-Options", "nosniff"},
       {"Referrer-Policy", "no-referrer"},
       {"Cache-Control", "no-store"}});
}

/// Content from a provider is not compressed either.
void answer_with(httplib::Response& response, const Asset& file, const std::string& type) {
  response.set_content_provider(
      file.text.size(), type,
      [&file](std::size_t from, std::size_t length, httplib::DataSink& sink) {
        return sink.write(file.text.data() + from, length);
      });
}

void serve_files(httplib::Server& server) {
  for (const Asset& file : page_files()) {
    const std::string path = "/" + std::string(file.name == "index.html" ? "" : file.name);
    server.Get(path, [&file](const httplib::Request&, httplib::Response& response) {
      answer_with(response, file, std::string(media_type(file.name)));
    });
  }
}

json muscle_json(const KnownMuscle& known) {
  json result;
  for (std::size_t i = 0; i < known.size(); ++i)
    result[std::string(known_quantities[i])] = known[i];
  for (const auto& [name, ratio] : named_deviations(identified_deviations(known)))
    result[name] = ratio;
  return result;
}

json refusals_json() {
  json result;
  for (std::size_t i = 1; i < refusal_names.size(); ++i)
    result[std::string(refusal_names[i])] = refusal_words(static_cast<Refusal>(i));
  return result;
}

json results_json() {
  json result;
  for (std::size_t i = 0; i < mode_result_names.size(); ++i)
    result[std::string(mode_result_names[i])] = result_words[i];
  return result;
}

/// In the order of their bits, the lowest first.
json notes_json() {
  json result = json::array();
  for (std::size_t i = 0; i < identify_note_names.size(); ++i)
    result.push_back({{"name", identify_note_names[i]}, {"words", note_words[i]}});
  return result;
}

}  // namespace

ManualControl& ManualControls::of(std::uint8_t node) {
  const std::lock_guard lock(mutex_);
  auto& control = controls_[node];
  if (!control) control = std::make_unique<ManualControl>(node, bus_of_(node));
  return *control;
}

Result<ReadTunable> ManualControls::tunable_reader(std::uint8_t node) {
  auto bus = bus_of_(node)();
  if (!bus) return tl::unexpected(bus.error());
  return [reader = std::make_shared<Commander>(std::move(*bus), node)](
             int place, std::size_t tunable, TuningSet set) -> Result<double> {
    const auto tuned = reader->read_tuning(
        {static_cast<std::uint8_t>(place), static_cast<std::uint8_t>(tunable), set});
    if (!tuned) return tl::unexpected(tuned.error());
    return tuned->value;
  };
}

Result<TunedChannel> ManualControls::read_tuning(std::uint8_t node) {
  const auto reader = tunable_reader(node);
  if (!reader) return tl::unexpected(reader.error());
  return operating::read_tuning(*reader);
}

Result<nlohmann::ordered_json> ManualControls::read_kinds(std::uint8_t node) {
  const auto reader = tunable_reader(node);
  if (!reader) return tl::unexpected(reader.error());
  return operating::read_kinds(*reader);
}

Result<KnownMuscle> ManualControls::read_muscle(std::uint8_t node) {
  auto bus = bus_of_(node)();
  if (!bus) return tl::unexpected(bus.error());
  return Commander(std::move(*bus), node).muscle();
}

void ManualControls::release_hold(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  for (const auto& [node, control] : controls_)
    control->release_hold(reason);
}

Api::Api(Access access, const FrameHistory& frame_history, ManualControls& controls, About about)
    : access_(std::move(access)),
      frame_history_(&frame_history),
      controls_(&controls),
      about_(std::move(about)) {}

template <class Read>
void Api::answer_from_node(const Request& request, Response& response, Read read) {
  if (about_.log) return refuse(response, 404, "a log has no board to ask");
  const auto node = parse_node("{\"node\":" + request.matches[1].str() + "}");
  if (!node) return refuse(response, 400, node.error().text());
  const auto result = read(*node);
  if (!result) return refuse(response, 504, result.error().text());
  answer_json(response, result->dump());
}

void Api::serve_with(httplib::Server& server) {
  add_headers(server, access_, about_.stop_port);
  serve_files(server);
  const auto with_view_access = [this](auto handler) {
    return operating::with_view_access(access_, handler);
  };
  const auto with_command_access =
      [this](httplib::Server::Handler handler) -> httplib::Server::Handler {
    if (!about_.log) return operating::with_command_access(access_, std::move(handler));
    return [](const Request&, Response& response) {
      refuse(response, 403, "a log cannot be commanded");
    };
  };
  server.Get("/api/about", with_view_access([this](const auto& q, auto& a) { about(q, a); }));
  server.Get("/api/history", with_view_access([this](const auto& q, auto& a) { history(q, a); }));
  server.Get("/api/stream", with_view_access([this](const auto& q, auto& a) { stream(q, a); }));
  server.Get(R"(/api/fault/([a-z_]+))", [](const Request& request, Response& response) {
    const Asset* text = find_asset(fault_pages(), request.matches[1].str());
    if (text == nullptr) return refuse(response, 404, "there is no such fault");
    answer_with(response, *text, "text/markdown; charset=utf-8");
  });
  server.Post("/api/command",
              with_command_access([this](const auto& q, auto& a) { command(q, a); }));
  server.Post("/api/trajectory",
              with_command_access([this](const auto& q, auto& a) { play(q, a); }));
  const auto from_node = [this](auto read) {
    // this->, because clang 14 otherwise reports the captured this as unused.
    return operating::with_view_access(
        access_, [this, read](const auto& q, auto& a) { this->answer_from_node(q, a, read); });
  };
  server.Get(R"(/api/tuning/(\d+))", from_node([this](std::uint8_t node) {
               return controls_->read_tuning(node).map(tuning_json);
             }));
  server.Get(R"(/api/kinds/(\d+))",
             from_node([this](std::uint8_t node) { return controls_->read_kinds(node); }));
  server.Get(R"(/api/muscle/(\d+))", from_node([this](std::uint8_t node) {
               return controls_->read_muscle(node).map(muscle_json);
             }));
  server.Post("/api/tuning", with_command_access([this](const auto& q, auto& a) { tune(q, a); }));
  server.Post("/api/alive", with_command_access([this](const auto& q, auto& a) { alive(q, a); }));
}

void Api::about(const Request& request, Response& response) const {
  // Requests for data have no Origin header to check.
  const bool may = !about_.log && !access_.read_only && has_token(access_, request);
  const json result{
      {"version", program_version()},
      {"source", about_.source},
      {"kind", about_.log ? "log" : "live"},
      {"read_only", access_.read_only},
      {"may_command", may},
      {"stop_port", about_.stop_port},
      {"setup", about_.setup},
      {"page_timeout_s", std::chrono::duration<double>(ManualControl::page_timeout).count()},
      {"protocol", json::parse(protocol_json())},
      {"protocol_version", telemetry::protocol_version},
      {"refusals", refusals_json()},
      {"results", results_json()},
      {"notes", notes_json()},
      {"infeasible", infeasible_json()}};
  answer_json(response, result.dump());
}

void Api::history(const Request& request, Response& response) const {
  const auto from = time_of(request, "from_s", hal::Time::zero());
  const auto to = time_of(request, "to_s", hal::Time::max());
  if (!from || !to) return refuse(response, 400, "from_s and to_s must be seconds");
  answer_json(response, to_batch(frame_history_->between(*from, *to), *frame_history_));
}

std::uint64_t Api::first_frame(const Request& request) const {
  const std::uint64_t end = frame_history_->end();
  const std::string id = request.get_header_value("Last-Event-ID");
  if (request.get_param_value("resume") == "no" || !id.starts_with(run_ + "-")) return end;
  std::uint64_t next = 0;
  const char* const number_end = id.data() + id.size();
  const auto read = std::from_chars(id.data() + run_.size() + 1, number_end, next);
  return read.ec == std::errc{} && read.ptr == number_end ? std::min(next, end) : end;
}

std::string Api::event_id(const Reader& reader) const {
  return "id: " + run_ + "-" + std::to_string(reader.next) + "\n";
}

bool Api::stream_piece(httplib::DataSink& sink, Reader& reader) {
  const auto send = [&](const std::string& text) { return sink.write(text.data(), text.size()); };
  if (!reader.begun) {
    reader.begun = true;
    return send("retry: " + std::to_string(stream_retry_after.count()) + "\n" + event_id(reader) +
                "\n");
  }
  for (int quiet = 0; quiet < beat_after && !ending_; ++quiet) {
    std::this_thread::sleep_for(stream_every);
    const std::string lost = frame_history_->lost();
    if (lost.empty() == reader.was_lost) {
      reader.was_lost = !reader.was_lost;
      const json result{{"reason", lost}};
      return send((reader.was_lost ? "event: lost\ndata: " : "event: found\ndata: ") +
                  result.dump() + "\n\n");
    }
    FrameHistory::Part part = frame_history_->since(reader.next);
    reader.next = part.next;
    if (!part.frames.empty()) {
      return send(event_id(reader) + "data: " + to_batch(part.frames, *frame_history_) + "\n\n");
    }
  }
  if (ending_) return false;
  return send(": beat\n\n");
}

void Api::stream(const Request& request, Response& response) {
  if (streams_.fetch_add(1) >= max_streams) {
    --streams_;
    return refuse(response, 503, "too many pages are watching: close some");
  }
  response.set_chunked_content_provider(
      "text/event-stream",
      [this, reader = Reader{first_frame(request)}](std::size_t, httplib::DataSink& sink) mutable {
        return stream_piece(sink, reader);
      },
      [this](bool) { --streams_; });
}

void Api::command(const Request& request, Response& response) {
  const auto order = parse_command_request(request.body);
  if (!order) return refuse(response, 400, order.error().text());
  const auto answer = controls_->of(order->node).ask(order->verb, order->value);
  if (!answer) return refuse(response, 504, answer.error().text());
  answer_json(response, json{{"refusal", name(*answer)}}.dump());
}

void Api::tune(const Request& request, Response& response) {
  const auto parsed = parse_tuning_request(request.body);
  if (!parsed) return refuse(response, 400, parsed.error().text());
  const auto answer = operating::tune(controls_->of(parsed->node), *parsed);
  if (!answer) return refuse(response, 504, answer.error().text());
  answer_json(response, json{{"refusal", name(*answer)}}.dump());
}

void Api::play(const Request& request, Response& response) {
  const auto parsed = parse_trajectory_request(request.body);
  if (!parsed) return refuse(response, 400, parsed.error().text());
  const auto sent = controls_->of(parsed->node).play(parsed->knots, parsed->start);
  if (!sent) return refuse(response, 504, sent.error().text());
  answer_json(response, sent_json(*sent));
}

void Api::alive(const Request& request, Response& response) {
  const auto node = parse_node(request.body);
  if (!node) return refuse(response, 400, node.error().text());
  const ManualControl::Holding holding = controls_->of(*node).alive();
  json result{{"holding", holding.holding}};
  if (!holding.holding) result["reason"] = holding.reason;
  answer_json(response, result.dump());
}

}  // namespace supercoil::operating
