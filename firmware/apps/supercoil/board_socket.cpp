#include "apps/supercoil/board_socket.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

namespace supercoil::operating {

namespace {

constexpr time_t max_answer_s = 2;
constexpr std::size_t max_answer = 8192;

/// A signal such as Ctrl-C interrupts a call that has a timeout, SA_RESTART or not.
template <class Call>
ssize_t uninterrupted(const Call& call) {
  for (;;) {
    const ssize_t result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

std::string reason() {
  return std::generic_category().message(errno);
}

std::string remedy(int error) {
  if (error == ENOENT || error == ECONNREFUSED) return "; is supercoild running?";
  return error == EACCES ? "; who commands a board must be in its group supercoil" : "";
}

}  // namespace

Result<BoardSocket> BoardSocket::open(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof(address.sun_path)) {
    return failure(path + ": path too long for a socket");
  }
  std::memcpy(address.sun_path, path.data(), path.size());
  BoardSocket socket(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  if (socket.file_ < 0) return failure("cannot create a socket: " + reason());
  const timeval patience{max_answer_s, 0};
  ::setsockopt(socket.file_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  if (::connect(socket.file_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    const std::string hint = remedy(errno);
    return failure(path + ": " + reason() + hint);
  }
  return socket;
}

BoardSocket::~BoardSocket() {
  if (file_ >= 0) ::close(file_);
}

Result<std::string> BoardSocket::ask(const std::string& line) const {
  const auto sent =
      uninterrupted([&] { return ::send(file_, line.data(), line.size(), MSG_NOSIGNAL); });
  // A rejected client is told why before the connection closes, but send() fails first.
  if (sent < 0 && errno != EPIPE) return failure("supercoild is not listening: " + reason());
  std::array<char, max_answer> answer{};
  const auto receive = [&] {
    return uninterrupted([&] { return ::recv(file_, answer.data(), answer.size(), 0); });
  };
  ssize_t size = receive();
  if (size < 0 && errno == ECONNRESET) size = receive();
  if (size == 0) return failure("supercoild has ended");
  if (size < 0) return failure("supercoild does not answer: " + reason());
  return std::string(answer.data(), static_cast<std::size_t>(size));
}

}  // namespace supercoil::operating
