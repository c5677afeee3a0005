// Decides who may watch, and who may command.
#pragma once

#include <string>

#include "apps/supercoil/monitor/httplib.hpp"

namespace supercoil::operating {

struct Access {
  std::string host;        ///< the address that the server listens on
  int port = 0;            ///< of the page
  std::string token;       ///< 32 hexadecimal digits
  bool loopback = true;    ///< clients on this machine may watch without the token
  bool read_only = false;  ///< nobody may command
};

/// Makes the server refuse a port that another program uses. By default the library shares it, and
/// half of the requests would go to the other program.
void bind_exclusively(httplib::Server& server);

/// From a source of true randomness.
std::string new_token();
bool is_loopback(const std::string& host);

/// Whether the request names this server as its host. Any other name that leads here belongs to a
/// foreign page that wants to read ours (DNS rebinding).
bool is_own_host(const Access& access, const httplib::Request& request, int port);
/// Whether the request has the right token, as a header (below) or as ?token=.
bool has_token(const Access& access, const httplib::Request& request);
/// The same, but only as header X-Supercoil-Token or Authorization: Bearer.
bool has_token_header(const Access& access, const httplib::Request& request);
/// Whether our own page sent the request.
bool is_same_origin(const Access& access, const httplib::Request& request);

/// Answers {"error": why} with a status.
void refuse(httplib::Response& response, int status, const std::string& why);
/// Answers {…}, uncompressed: the library's Brotli needs 5 s for 2 MB.
void answer_json(httplib::Response& response, const std::string& json);
/// Wraps a handler: for clients that may watch, or may command. Others are refused with 403. access
/// outlives it.
httplib::Server::Handler with_view_access(const Access& access, httplib::Server::Handler handler);
httplib::Server::Handler with_command_access(const Access& access,
                                             httplib::Server::Handler handler);

/// Why it is refused; empty: it is allowed.
std::string refuse_to_show(const Access& access, const httplib::Request& request);
std::string refuse_to_command(const Access& access, const httplib::Request& request);
/// From this machine a muscle may be stopped without the token.
std::string refuse_to_stop(const Access& access, const httplib::Request& request, int port);

}  // namespace supercoil::operating
