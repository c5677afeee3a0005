#include "apps/supercoil/setup/channel_now.hpp"

namespace supercoil::operating {

std::optional<Promise> ChannelNow::promise(const control::ControllerSettings& controller,
                                           const BoardSettings& board,
                                           const FirstMotion& motion) const {
  if (in_joint() || !is_promised_for(controller, settings, board.step_s())) return std::nullopt;
  return promise_error(controller.learned_ff, settings, board, motion);
}

Result<ChannelNow> channel_now(BoardLink& board, const std::string& channel,
                               const ChannelSettings& configured) {
  const auto known = board.muscle(channel);
  if (!known) return tl::unexpected(known.error());
  const auto senses = board.senses(channel);
  if (!senses) return tl::unexpected(senses.error());
  board::StoredValues in_use;
  for (std::size_t i = 0; i < in_use.values.size(); ++i) {
    if (!control::tunables()[i].controllers_have()) continue;
    const auto value = board.tuning(channel, 0, i, TuningSet::in_use);
    if (!value) return tl::unexpected(value.error());
    if (!std::isnan(*value)) in_use.values[i] = *value;
  }
  ChannelNow now{with_known(configured, *known)};
  now.settings.senses = *senses;
  in_use.apply_to(now.settings.controllers.front());
  return now;
}

}  // namespace supercoil::operating
