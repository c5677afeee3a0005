#include "apps/supercoil/setup/setup_api.hpp"

#include <string>

#include <nlohmann/json.hpp>

namespace supercoil::operating {

namespace {

using nlohmann::json;

SetupSession::Done obey(SetupSession& session, const json& asked) {
  const auto text_of = [&](const char* key) {
    const auto found = asked.find(key);
    return found != asked.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const std::string what = text_of("do");
  if (what == "begin") return session.begin(text_of("step"));
  if (what == "answer") return session.answer(text_of("text"));
  if (what == "undo") return session.undo();
  if (what != "end") return tl::unexpected<std::string>("do: begin, answer, end or undo");
  session.end("ended on the page");
  return {};
}

}  // namespace

void serve_setup(httplib::Server& server, const Access& access, SetupSession& session) {
  server.Get("/api/setup", shown(access, [&](const auto& request, auto& response) {
               if (!access.read_only && has_token(access, request)) session.alive();
               answer_json(response, session.state().dump());
             }));
  server.Post("/api/setup", commanded(access, [&](const auto& request, auto& response) {
                const json asked = json::parse(request.body, nullptr, false);
                if (!asked.is_object())
                  return refuse(response, 400, "the request is no JSON object");
                if (auto done = obey(session, asked); !done)
                  return refuse(response, 400, done.error());
                answer_json(response, session.state().dump());
              }));
}

}  // namespace supercoil::operating
