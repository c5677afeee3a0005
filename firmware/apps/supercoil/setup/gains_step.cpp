#include <optional>

#include <nlohmann/json.hpp>

#include "apps/supercoil/change_tuning.hpp"
#include "apps/supercoil/setup/channel_steps.hpp"
#include "apps/supercoil/setup/muscle_answers.hpp"
#include "apps/supercoil/tuning_table.hpp"
#include "config/describe.hpp"
#include "config/recommended_controller.hpp"

namespace supercoil::operating {

namespace {

using control::ControllerSettings;
using control::Tunable;
using control::TunableType;
using Json = nlohmann::ordered_json;

/// "learned_ff: bandwidth_rad_per_s = 8, …, reference_model = wm16". A named model needs no poles.
std::string values_text(const ControllerSettings& controller) {
  std::string text(control::name_of(control::controller_names, controller.kind));
  bool named = false;
  const char* before = ": ";
  for (const Tunable& tunable : control::tunables()) {
    const double value = tunable.get(controller);
    if (tunable.type == TunableType::model) named = value > 0.0;
    const bool shown =
        tunable.type != TunableType::kind && !(named && tunable.type == TunableType::pole);
    if (!shown || std::isnan(value)) continue;
    text +=
        before + std::string(tunable.name) + " = " + tuning_text(Tuned::controller, tunable, value);
    before = ", ";
  }
  return text;
}

/// The controller's margin, and what it promises.
std::string expected_text(const ControllerSettings& controller, const ChannelNow& now,
                          const BoardSettings& board, const FirstMotion& motion,
                          const std::optional<Promise>& promise) {
  std::string text = config::describe_margin(controller, now.settings, board.step_s());
  if (!text.empty()) text += "; ";
  return text + (promise ? "promises at most " + config::describe_promise(*promise, motion)
                         : "promises no error");
}

Json promised(const std::optional<Promise>& promise) {
  return promise ? Json(promise->error_m()) : Json(nullptr);
}

TuningDone take_over(BoardLink& board, const std::string& channel, const ControllerSettings& in_use,
                     const ControllerSettings& recommended) {
  std::vector<TuningChange> changes;
  const auto values = board::StoredValues::difference(recommended, in_use).values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i]) changes.push_back({i, *values[i]});
  }
  auto done = prepare_tuning(board, channel, 0, "in_use", changes);
  if (done) done = send_tuning_command(board, channel + " tune 0");
  if (done) done = send_tuning_command(board, channel + " store tuning");
  return done;
}

}  // namespace

StepResult choose_gains(BoardLink& board, const std::string& channel, const ChannelNow& now,
                        const BoardSettings& settings, Operator& user) {
  const ControllerSettings& in_use = now.settings.controllers.front();
  const config::RecommendedController suits =
      config::recommended_controller(now.settings, settings);
  const ControllerSettings recommended = suits.applied_to(in_use);
  const FirstMotion motion =
      plan_first_motion(feasibility(now.settings, settings), now.settings.unexplained_ratio);
  const auto promise = now.promise(in_use, settings, motion);
  const auto better = now.promise(recommended, settings, motion);
  Json found{{"in_use", control::name_of(control::controller_names, in_use.kind)},
             {"in_use_promised_m", promised(promise)},
             {"recommended", control::name_of(control::controller_names, recommended.kind)},
             {"recommended_bandwidth_rad_per_s", suits.bandwidth_rad_per_s},
             {"recommended_pole_rad_per_s", suits.pole_rad_per_s},
             {"recommended_promised_m", promised(better)},
             {"taken", false}};

  user.show("in use: controller 0, " + values_text(in_use));
  user.show("with it: " + expected_text(in_use, now, settings, motion, promise));
  user.show("recommended for this muscle: " + suits.literal() + ": " + suits.reason);
  user.show("with reference_model = " + suits.model_literal() + ": " + suits.model_reason);
  if (!suits.differs_from(in_use)) {
    user.show("it is in use already: nothing changes");
    return found;
  }
  if (const std::string problem = problem_of(suits, now.settings, settings.step_s());
      !problem.empty()) {
    user.show("it cannot run here: " + problem);
    return found;
  }
  user.show("with it: " + expected_text(recommended, now, settings, motion, better));
  const auto take = user.ask(take_gains, [] { return Operator::Done(); });
  if (!take && user.interrupted()) return tl::unexpected(take.error());
  if (!take || *take == 0.0) {
    user.show("kept as it is; the step gains asks again");
    return found;
  }
  if (auto taken = take_over(board, channel, in_use, recommended); !taken)
    return tl::unexpected(taken.error());
  user.show("taken over, and stored for the next start; supercoil tune " + channel +
            " --from configured --store" + board.words() + " goes back to the file's");
  found["taken"] = true;
  return found;
}

}  // namespace supercoil::operating
