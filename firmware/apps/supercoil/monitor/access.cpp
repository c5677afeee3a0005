#include "apps/supercoil/monitor/access.hpp"

#include <array>
#include <cstdio>
#include <random>
#include <utility>

#include <nlohmann/json.hpp>

namespace supercoil::operating {

namespace {

/// Takes constant time, whatever the difference.
bool same(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return difference == 0;
}

/// "HOST:PORT" of this server, as a browser would name it.
bool names_this_server(const Access& access, const std::string& host_and_port, int port) {
  const std::string end = ":" + std::to_string(port);
  if (host_and_port == access.host + end) return true;
  if (access.loopback) return host_and_port == "localhost" + end;
  // A server on every address cannot know by which one it is reached; the token decides.
  return access.host == "0.0.0.0";
}

/// Whether no browser sent it. Browsers name the page that sends a request, or at least its
/// relation to this server, and let no other server's page set the token's headers.
bool is_from_no_browser(const httplib::Request& request) {
  return !request.has_header("Origin") && !request.has_header("Sec-Fetch-Site");
}

}  // namespace

void bind_exclusively(httplib::Server& server) {
  server.set_socket_options([](socket_t socket) {
    const int on = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
    // Per connection: otherwise megabytes may queue for a reader that takes nothing.
    const int waiting_bytes = 128 * 1024;
    setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &waiting_bytes, sizeof(waiting_bytes));
  });
}

std::string new_token() {
  std::random_device random;
  std::string token;
  std::array<char, 16> part{};
  for (int i = 0; i < 4; ++i) {
    std::snprintf(part.data(), part.size(), "%08x", random());
    token += part.data();
  }
  return token;
}

bool is_loopback(const std::string& host) {
  return host == "localhost" || host.starts_with("127.");
}

bool is_own_host(const Access& access, const httplib::Request& request, int port) {
  return names_this_server(access, request.get_header_value("Host"), port);
}

bool has_token(const Access& access, const httplib::Request& request) {
  return has_token_header(access, request) ||
         (!request.has_header("X-Supercoil-Token") &&
          same(access.token, request.get_param_value("token")));
}

bool has_token_header(const Access& access, const httplib::Request& request) {
  return same(access.token, request.get_header_value("X-Supercoil-Token")) ||
         same("Bearer " + access.token, request.get_header_value("Authorization"));
}

bool is_same_origin(const Access& access, const httplib::Request& request) {
  const std::string origin = request.get_header_value("Origin");
  const std::string scheme = "http://";
  return origin.starts_with(scheme) &&
         names_this_server(access, origin.substr(scheme.size()), access.port);
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  answer_json(response, nlohmann::json{{"error", why}}.dump());
}

void answer_json(httplib::Response& response, const std::string& json) {
  // With a parameter, so that the library does not treat it as a type to compress.
  response.set_content(json, "application/json; charset=utf-8");
}

httplib::Server::Handler with_view_access(const Access& access, httplib::Server::Handler handler) {
  return [&access, handler = std::move(handler)](const auto& request, auto& response) {
    const std::string refused = refuse_to_show(access, request);
    if (!refused.empty()) return refuse(response, 403, refused);
    handler(request, response);
  };
}

httplib::Server::Handler with_command_access(const Access& access,
                                             httplib::Server::Handler handler) {
  return [&access, handler = std::move(handler)](const auto& request, auto& response) {
    const std::string refused = refuse_to_command(access, request);
    if (!refused.empty()) return refuse(response, 403, refused);
    handler(request, response);
  };
}

std::string refuse_to_show(const Access& access, const httplib::Request& request) {
  if (!is_own_host(access, request, access.port)) return "the request names another host";
  if (!access.loopback && !has_token(access, request)) return "needs the token that was printed";
  return {};
}

std::string refuse_to_command(const Access& access, const httplib::Request& request) {
  if (access.read_only) return "this monitor is read-only";
  if (!is_own_host(access, request, access.port)) return "the request names another host";
  if (is_from_no_browser(request)) {
    return has_token_header(access, request)
               ? ""
               : "needs the token that was printed, as header Authorization: Bearer TOKEN";
  }
  if (!is_same_origin(access, request)) return "the request does not come from this monitor's page";
  if (!has_token(access, request)) return "needs the token that was printed";
  return {};
}

std::string refuse_to_stop(const Access& access, const httplib::Request& request, int port) {
  if (access.read_only) return "this monitor is read-only";
  if (!is_own_host(access, request, port)) return "the request names another host";
  if (!is_from_no_browser(request) && !is_same_origin(access, request))
    return "the request does not come from this monitor's page";
  if (!access.loopback && !same(access.token, request.body) && !has_token_header(access, request))
    return "needs the token that was printed";
  return {};
}

}  // namespace supercoil::operating
