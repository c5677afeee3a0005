// Who may look, and who may command.
#pragma once

#include <string>

#include "apps/supercoil/monitor/httplib.hpp"

namespace supercoil::operating {

struct Access {
  std::string host;        ///< that it listens on
  int port = 0;            ///< of the page
  std::string token;       ///< 32 hexadecimal digits
  bool loopback = true;    ///< whoever is on this machine may look without it
  bool read_only = false;  ///< nobody may command
};

/// Sets the server up so that a port that another program has is refused: the library's own way
/// shares it, and half of the requests would go to the other.
void bind_exclusively(httplib::Server& server);

/// From a source of true randomness.
std::string new_token();
bool is_loopback(const std::string& host);

/// The request names this server as its host: another name that leads here is somebody else's page
/// that wants to read ours (DNS rebinding).
bool is_own_host(const Access& access, const httplib::Request& request, int port);
/// The token that came with it, as a header (below) or as ?token=, is right.
bool has_token(const Access& access, const httplib::Request& request);
/// The same as header X-Supercoil-Token or Authorization: Bearer.
bool has_token_header(const Access& access, const httplib::Request& request);
/// The page that sent it is ours.
bool is_same_origin(const Access& access, const httplib::Request& request);

/// {"error": why} with a status.
void refuse(httplib::Response& response, int status, const std::string& why);
/// {…}, uncompressed: the library's Brotli needs 5 s for 2 MB.
void answer_json(httplib::Response& response, const std::string& json);
/// The handler for those who may look, and for those who may command; others are refused with 403.
/// access outlives it.
httplib::Server::Handler shown(const Access& access, httplib::Server::Handler handler);
httplib::Server::Handler commanded(const Access& access, httplib::Server::Handler handler);

/// Why it is refused; empty: it is not.
std::string refuse_to_show(const Access& access, const httplib::Request& request);
std::string refuse_to_command(const Access& access, const httplib::Request& request);
/// A muscle may be stopped without the token from this machine.
std::string refuse_to_stop(const Access& access, const httplib::Request& request, int port);

}  // namespace supercoil::operating
