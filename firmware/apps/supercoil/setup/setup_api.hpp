// What the page asks of setup.
#pragma once

#include "apps/supercoil/monitor/access.hpp"
#include "apps/supercoil/setup/setup_session.hpp"

namespace supercoil::operating {

/// GET /api/setup: SetupSession::state(); whoever may command watches by it. POST /api/setup
/// {"do": "begin", "step": …}, {"do": "answer", "text": …}, {"do": "end"} or {"do": "undo"}: the
/// state after it, or {"error": …}. All outlive the server.
void serve_setup(httplib::Server& server, const Access& access, SetupSession& session);

}  // namespace supercoil::operating
