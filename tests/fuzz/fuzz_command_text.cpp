// A command as text, from a socket that every program on the board may write to.
#include <cmath>

#include "fuzz/fuzz.hpp"
#include "text/command_text.hpp"

using namespace supercoil;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t channels = 4;
  const auto text = fuzz::text(data, size);
  const auto of_trajectory = parse_trajectory_command(text, channels);
  const auto command = of_trajectory ? *of_trajectory : parse_command(text, channels);
  if (!command) {
    fuzz::require(!command.error().text().empty(), "what is refused is refused with a reason");
    return 0;
  }
  fuzz::require(command->channel < channels, "a command is for a channel of the board");
  fuzz::require(command->verb != Verb::none && !name(command->verb).empty(), "it has a verb");
  fuzz::require(std::isfinite(command->value), "its value is a number");
  fuzz::require(std::isfinite(command->after_s) && std::isfinite(command->velocity_m_per_s),
                "so are a knot's time and velocity");
  fuzz::require(command->source == Source::local, "its answer goes back to the socket");
  return 0;
}
