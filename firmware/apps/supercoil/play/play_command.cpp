// supercoil play: plays motions from a file, on one or several nodes in step.
#include <chrono>
#include <cstdio>
#include <thread>

#include <nlohmann/json.hpp>

#include "apps/common/progress.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/interrupted.hpp"
#include "apps/supercoil/play/player.hpp"

namespace supercoil::operating {

namespace {

constexpr auto step_period = std::chrono::milliseconds(20);

/// Repeats the step until it is done, there is a problem, or Ctrl-C.
template <class Step, class Done>
Player::Problem repeat(const Step& step, const Done& done) {
  while (interrupted == 0 && !done()) {
    if (auto problem = step()) return problem;
    std::this_thread::sleep_for(step_period);
  }
  return std::nullopt;
}

Player::Problem play(Player& player, const PlayOptions& options, Progress& progress) {
  if (auto problem = player.go_to_start()) return problem;
  const auto settled =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(options.settle_s);
  if (auto problem = repeat([&] { return player.renew(); },
                            [&] { return std::chrono::steady_clock::now() >= settled; }))
    return problem;
  if (auto problem = repeat([&] { return player.load(); }, [&] { return player.loaded(); }))
    return problem;
  if (interrupted != 0) return std::nullopt;
  if (auto problem = player.start()) return problem;
  const auto go_on = [&] {
    progress.show(player.progress(), "");
    return player.continue_playing();
  };
  if (auto problem = repeat(go_on, [&] { return player.ended(); })) return problem;
  if (!options.hold) return std::nullopt;
  return repeat([&] { return player.renew(); }, [] { return false; });
}

}  // namespace

int play_command(const PlayOptions& options) {
  auto motions = read_motions(options.file, static_cast<std::uint8_t>(options.node));
  if (!motions) return refuse(options.json, exit_wrong_input, motions.error().text());
  auto player = options.can.empty() ? Player::open_local(options.socket, std::move(*motions))
                                    : Player::open(options.can, std::move(*motions));
  if (!player) return refuse(options.json, exit_failed, player.error().text());
  watch_for_interrupts();
  Progress progress("play", false);
  const auto problem = play(*player, options, progress);
  progress.end();
  player->rest();
  if (problem) return refuse(options.json, exit_failed, *problem);
  if (interrupted != 0 && !options.hold)
    return refuse(options.json, exit_failed, "interrupted; the muscle rests");
  if (options.json) {
    const nlohmann::json report{{"played", true}};
    std::printf("%s\n", report.dump().c_str());
  }
  return exit_done;
}

}  // namespace supercoil::operating
