#include "apps/supercoil/setup/setup_session.hpp"

#include <algorithm>
#include <utility>

#include "apps/supercoil/setup/board_file.hpp"
#include "apps/supercoil/setup/file_steps.hpp"
#include "apps/supercoil/setup/record.hpp"
#include "apps/supercoil/setup/setup_board.hpp"
#include "apps/supercoil/setup/steps.hpp"
#include "config/board_config.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

bool is_step(const std::string& name) {
  return std::ranges::any_of(setup_steps, [&](const SetupStep& s) { return s.name == name; });
}

}  // namespace

SetupSession::SetupSession(SetupOptions options, std::function<void()> before)
    : options_(std::move(options)), before_(std::move(before)) {}

SetupSession::~SetupSession() {
  end("the monitor ends");
  if (thread_.joinable()) thread_.join();
}

void SetupSession::serve_with(httplib::Server& server, const Access& access) {
  server.Get("/api/setup", with_view_access(access, [&](const auto& request, auto& response) {
               if (has_token(access, request)) page_.alive();
               answer_json(response, state().dump());
             }));
  server.Post("/api/setup",
              with_command_access(access, [this](const auto& request, auto& response) {
                const Json command = Json::parse(request.body, nullptr, false);
                if (!command.is_object())
                  return refuse(response, 400, "the request is not a JSON object");
                const auto done = execute(command);
                if (!done) return refuse(response, 400, done.error().text());
                Json now = state();
                now["done"] = *done;
                answer_json(response, now.dump());
              }));
}

Json SetupSession::state() const {
  Json state{{"file", options_.config}, {"channel", options_.channel}};
  const auto record = SetupRecord::open(options_.config, options_.channel);
  Json steps = Json::array();
  const auto config = config::read_board_config(options_.config);
  const auto channel = static_cast<std::size_t>(options_.channel) - 1;
  for (const SetupStep& step : setup_steps) {
    const bool known = config && channel < config->settings.channels.size();
    if (known && !left_out(step, config->settings, channel).empty()) continue;
    steps.push_back({{"name", step.name},
                     {"does", step.does},
                     {"optional", step.optional},
                     {"found", record ? record->found(std::string(step.name)) : Json()}});
  }
  state["steps"] = std::move(steps);
  page_.add_to(state);
  if (!record) state["error"] = record.error().text();
  return state;
}

Result<std::string> SetupSession::execute(const Json& command) {
  const auto text_of = [&](const char* key) {
    const auto found = command.find(key);
    return found != command.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const std::string what = text_of("do");
  const auto without_words = [](const Done& done) {
    return done.map([] { return std::string(); });
  };
  if (what == "begin") return without_words(begin(text_of("step")));
  if (what == "answer") return without_words(page_.answer(text_of("text")));
  if (what == "undo") return undo();
  if (what != "end") return failure("do must be begin, answer, end or undo");
  end("ended on the page");
  return {};
}

SetupSession::Done SetupSession::begin(const std::string& step) {
  if (!is_step(step)) return failure("there is no step '" + step + "'");
  const std::lock_guard lock(beginning_);
  if (!page_.begin(step)) return failure("another step is under way");
  if (thread_.joinable()) thread_.join();
  before_();
  thread_ = std::thread([this, step] { page_.conclude(run(step)); });
  return {};
}

StepResult SetupSession::run(const std::string& step) {
  auto record = SetupRecord::open(options_.config, options_.channel);
  if (!record) return tl::unexpected(record.error());
  SetupBoard board(options_, page_);
  auto found = step == setup_steps.front().name ? describe_step(options_, page_) : board.run(step);
  if (!found) return found;
  if (auto kept = record->add(step, *found); !kept) return tl::unexpected(kept.error());
  return found;
}

Result<std::string> SetupSession::undo() {
  const std::lock_guard lock(beginning_);
  if (page_.busy()) return failure("a step is under way");
  const auto undone = undo_setup(options_, [](const std::string&) { return false; });
  if (!undone) return tl::unexpected(undone.error());
  return undone_text(options_.config, *undone);
}

}  // namespace supercoil::operating
