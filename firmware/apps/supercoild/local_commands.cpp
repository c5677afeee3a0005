#include "apps/supercoild/local_commands.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <iomanip>
#include <iterator>
#include <sstream>

#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "apps/supercoild/local_tuning.hpp"
#include "text/command_text.hpp"

namespace supercoil::daemon {

namespace {

/// As many as a board may have channels, each with its own player, and some more.
constexpr std::size_t max_clients = 20;
constexpr int backlog = 4;
/// Longer lines are refused.
constexpr std::size_t max_line = 200;

void answer(int client, const std::string& text) {
  // A client that does not read its answers loses them.
  if (client >= 0) {
    static_cast<void>(::send(client, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL) < 0);
  }
}

/// Creates the socket with its permissions, which bind() takes from the descriptor less the umask.
/// A later chmod() of the path would follow a link that the folder's owner may have put there.
int bind_for_group(const hal_linux::Descriptor& listener, const sockaddr_un& address) {
  if (::fchmod(listener.number(), 0660) != 0) return -1;
  const mode_t usual = ::umask(0);
  const int result =
      ::bind(listener.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  const int error = errno;
  ::umask(usual);
  errno = error;
  return result;
}

/// A line for each channel, "1 1.02 0.985 0.021": gains of supply and current, and the error that
/// remains after a comparison with a meter.
std::string senses_text(const Loop& loop) {
  std::ostringstream text;
  text.precision(9);
  for (std::size_t i = 0; i < loop.channels(); ++i) {
    const board::SenseComparison s = loop.channel(i).senses();
    text << i + 1 << ' ' << s.supply_gain << ' ' << s.current_gain << ' ' << s.error_ratio << '\n';
  }
  return text.str();
}

/// A line for each channel: its number, and the known_quantities in their order.
std::string muscle_text(const Loop& loop) {
  std::ostringstream text;
  text.precision(9);
  for (std::size_t i = 0; i < loop.channels(); ++i) {
    text << i + 1;
    for (std::size_t quantity = 0; quantity < known_quantities.size(); ++quantity)
      text << ' ' << loop.channel(i).known(quantity);
    text << '\n';
  }
  return text.str();
}

/// A line for each channel, "1 loaded 61 0.04 1234.567890123": number, playback, room for knots,
/// seconds until the last one, and the board's time in s at its newest tick.
std::string playback_text(const Loop& loop, double board_s) {
  std::ostringstream text;
  for (std::size_t i = 0; i < loop.channels(); ++i) {
    const PlaybackStatus s = loop.channel(i).playback();
    text << i + 1 << ' ' << playback_state_names[static_cast<std::size_t>(s.state)] << ' '
         << int{s.room} << ' ' << s.buffered_s << ' ' << std::fixed << std::setprecision(9)
         << board_s << std::defaultfloat << std::setprecision(6) << '\n';
  }
  return text.str();
}

}  // namespace

Result<LocalCommands> LocalCommands::open(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const auto fail = [&](const char* what) { return failed_call(path + ": " + what, errno); };
  if (path.size() >= sizeof(address.sun_path)) {
    return failure(path + ": the path of a socket has at most " +
                   std::to_string(sizeof(address.sun_path) - 1) + " bytes");
  }
  std::memcpy(address.sun_path, path.data(), path.size());
  hal_linux::Descriptor listener(
      ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!listener.is_open()) return fail("cannot create a socket for commands");
  ::unlink(path.c_str());
  if (bind_for_group(listener, address) != 0) return fail("cannot be created");
  if (::listen(listener.number(), backlog) != 0) return fail("cannot listen on it");
  return LocalCommands(std::move(listener));
}

void LocalCommands::serve(Loop& loop, const NewestRows& rows, int max_ms) {
  std::array<pollfd, max_clients + 1> watched{};
  watched[0] = {listener_.number(), POLLIN, 0};
  const std::size_t count = clients_.size();
  for (std::size_t i = 0; i < count; ++i)
    watched[i + 1] = {clients_[i].number(), POLLIN, 0};
  ::poll(watched.data(), count + 1, max_ms);
  for (std::size_t i = count; i-- > 0;) {
    if (watched[i + 1].revents == 0 || take_packet(clients_[i], loop, rows)) continue;
    std::erase_if(waiting_,
                  [&](const auto& request) { return request.second == clients_[i].number(); });
    clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (watched[0].revents != 0) accept_one();
}

void LocalCommands::accept_one() {
  hal_linux::Descriptor client(
      ::accept4(listener_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!client.is_open()) return;
  if (clients_.size() == max_clients) {
    answer(client.number(), "refused: too many clients");
    return;
  }
  clients_.push_back(std::move(client));
}

/// Returns false when the client is gone.
bool LocalCommands::take_packet(const hal_linux::Descriptor& client, Loop& loop,
                                const NewestRows& rows) {
  std::array<char, max_line> line{};
  const ssize_t size = ::recv(client.number(), line.data(), line.size(), MSG_DONTWAIT | MSG_TRUNC);
  if (size <= 0) return size < 0 && (errno == EAGAIN || errno == EINTR);
  const auto length = static_cast<std::size_t>(size);
  if (length > line.size()) {
    // The rest may change what the beginning says, such as an exponent.
    answer(client.number(), "wrong: longer than " + std::to_string(max_line) + " bytes");
    return true;
  }
  std::string_view text(line.data(), length);
  while (!text.empty() && (text.back() == '\n' || text.back() == ' '))
    text.remove_suffix(1);
  if (text == "state") {
    answer(client.number(), rows.describe(loop));
    return true;
  }
  if (text == "status") {
    answer(client.number(), rows.describe_status());
    return true;
  }
  if (text == "senses") {
    answer(client.number(), senses_text(loop));
    return true;
  }
  if (text == "muscle") {
    answer(client.number(), muscle_text(loop));
    return true;
  }
  if (const auto tuning_answer = answer_tuning_request(text, loop)) {
    answer(client.number(), *tuning_answer);
    return true;
  }
  if (text == "playback") {
    answer(client.number(), playback_text(loop, rows.newest_s()));
    return true;
  }
  const auto of_trajectory = parse_trajectory_command(text, loop.channels());
  auto command = of_trajectory ? *of_trajectory : parse_command(text, loop.channels());
  if (!command) {
    answer(client.number(), "wrong: " + command.error().text());
    return true;
  }
  command->id = ++last_id_;
  if (loop.send(*command)) {
    waiting_[command->id] = client.number();
  } else {
    answer(client.number(), "refused: too many commands");
  }
  return true;
}

void LocalCommands::pass(const Answer& given, const Loop& loop) {
  const auto request = waiting_.find(given.command.id);
  if (request == waiting_.end()) return;  // from a client that is gone, or not from this socket
  std::string text = answer_text(given.refusal, given.nearest);
  if (given.refusal == Refusal::unsuitable && given.command.verb == Verb::tune)
    text += ": " + loop.channel(given.command.channel).tuner().problem();
  answer(request->second, text);
  // The loop answers in order: earlier commands that still wait have lost their answers.
  waiting_.erase(waiting_.begin(), std::next(request));
}

}  // namespace supercoil::daemon
