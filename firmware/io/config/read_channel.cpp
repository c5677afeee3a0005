#include "config/read_channel.hpp"

#include <cmath>
#include <sstream>

#include "config/read_control.hpp"
#include "config/read_lever.hpp"

namespace supercoil::config {

namespace {

/// Unit of the keys of [channel.position]: a length, or an angle for a joint's sensor.
struct PositionUnit {
  const char* name;
  double one_m;  ///< in metres
  double max_per_count;
  double max_reading;
  double max_noise_rms;

  std::string per_count() const { return std::string(name) + "_per_count"; }
  std::string key(const char* quantity) const { return std::string(quantity) + "_" + name; }
};

PositionUnit position_unit(Section& section, const BoardContext& context,
                           const PlaceInJoint& joint) {
  constexpr const char* deg_key = "deg_per_count";
  if (!section.has(deg_key)) return {"m", 1.0, 0.01, 10.0, 0.01};
  if (joint.direction == 0 && !context.joint_is_wrong) {
    section.wrong(deg_key,
                  "is for the sensor of a joint's angle, and this channel is in no [[joint]]: "
                  "write m_per_count");
  }
  return {"deg", metres_per_degree(joint.lever), 10.0, 360.0, 10.0};
}

/// [channel.position]: where the sensor is, what its counts mean, what it can read.
void read_position(Section section, const std::string& owner, const BoardContext& context,
                   ReadChannel& channel) {
  ChannelSupervision& s = channel.settings.supervision;
  InputSettings& input = channel.settings.position;
  channel.wiring.position = context.wiring.converter(section, owner + "'s position");
  const PositionUnit unit = position_unit(section, context, channel.settings.joint);
  channel.label.position_in_deg = unit.per_count() == "deg_per_count";
  const auto number = [&](const char* quantity, double fallback_m, Range range) {
    return unit.one_m * section.number(unit.key(quantity), fallback_m / unit.one_m, range);
  };
  const Range readings{-unit.max_reading, unit.max_reading};
  input.scaling.per_count =
      unit.one_m *
      section.required_number(unit.per_count(), {-unit.max_per_count, unit.max_per_count});
  if (input.scaling.per_count == 0.0) section.wrong(unit.per_count(), "must not be 0");
  input.scaling.offset = number("offset", 0.0, readings);
  input.max_age_s = context.wiring.max_age_s(section, channel.wiring.position);
  s.min_position_m = unit.one_m * section.required_number(unit.key("min"), readings);
  s.max_position_m = unit.one_m * section.required_number(unit.key("max"), readings);
  if (s.min_position_m >= s.max_position_m)
    section.wrong(unit.key("min"), "must be less than " + unit.key("max"));
  s.position_noise_rms_m = number("noise_rms", s.position_noise_rms_m, {0.0, unit.max_noise_rms});
  section.finish();
}

/// One sensor measures where a joint or a bundle is: the antagonist's position is the agonist's
/// with the opposite sign, at its own lever.
void take_position(Section& section, const PositionOwner& owner, ReadChannel& channel) {
  const ChannelSettings& from = owner.settings;
  ChannelSettings& c = channel.settings;
  const bool mirrored = c.joint.direction < 0;
  section.allow({"position"});
  if (section.has_own("position")) {
    section.wrong("position",
                  std::string(mirrored ? "is taken from its agonist" : "is taken from its bundle") +
                      ", channel " + std::to_string(owner.index + 1) +
                      (mirrored ? ", with the opposite sign" : "") +
                      ": leave it out, or move it there");
  }
  channel.label.position_in_deg = owner.label.position_in_deg;
  channel.wiring.position = owner.wiring.position;
  channel.wiring.position_of = owner.index;
  c.position = from.position;
  c.supervision.min_position_m = from.supervision.min_position_m;
  c.supervision.max_position_m = from.supervision.max_position_m;
  c.supervision.position_noise_rms_m = from.supervision.position_noise_rms_m;
  if (!mirrored) return;
  const double ratio = c.joint.lever.zero_radius_m() / from.joint.lever.zero_radius_m();
  c.position.scaling = {-ratio * from.position.scaling.per_count,
                        -ratio * from.position.scaling.offset};
  // Avoids -0.
  c.supervision.min_position_m = 0.0 - ratio * from.supervision.max_position_m;
  c.supervision.max_position_m = 0.0 - ratio * from.supervision.min_position_m;
  c.supervision.position_noise_rms_m *= ratio;
}

/// Without a position: nothing is compared with it.
void leave_position_out(Section& section, ChannelSettings& c) {
  section.allow({"position"});
  c.position.scaling.per_count = NAN;
  c.supervision.min_position_m = c.supervision.max_position_m = NAN;
}

/// [channel.current].
void read_current(Section section, const std::string& owner, const BoardContext& context,
                  ReadChannel& channel) {
  HeaterSettings& h = channel.settings.heater;
  channel.wiring.current = context.wiring.converter(section, owner + "'s current");
  h.current.scaling.per_count = section.required_number("A_per_count", {1e-9, 1.0});
  h.current.scaling.offset = section.number("offset_A", 0.0, {-100.0, 100.0});
  h.current.max_age_s = context.wiring.max_age_s(section, channel.wiring.current);
  h.sense_filter_s = 1e-3 * section.number("sense_filter_ms", 0.0, {0.0, 100.0});
  channel.settings.supervision.off_current_A =
      section.number("off_A", channel.settings.supervision.off_current_A, {1e-4, 10.0});
  section.finish();
}

/// [[channel.controller]], [[channel.estimator]], [channel.reference_model].
void read_control(Section& section, double step_s, ChannelSettings& c) {
  const auto model = read_reference_model(section.section("reference_model"));
  const auto tables = [&section](const char* key) {
    std::vector<Section> found = section.sections(key);
    if (found.empty()) found.push_back(section.section(key));
    return found;
  };
  c.controllers.clear();
  for (Section& table : tables("controller")) {
    const auto controller = read_controller(table, c.muscle, model, c.limiter.max_W);
    // Settings that contradict each other have been refused already.
    const bool contradicts = !contradictions(controller).empty();
    const auto problem = contradicts ? std::nullopt : check(controller, c, step_s);
    if (problem) table.wrong(problem->key, problem->message);
    c.controllers.push_back(controller);
  }
  c.estimators.clear();
  for (Section& table : tables("estimator")) {
    const auto estimator = read_estimator(table, c.muscle, c.limiter.max_W);
    refuse_misfit(table, control::check_fit(estimator, step_s, c.limiter.max_W));
    c.estimators.push_back(estimator);
  }
}

}  // namespace

ReadChannel read_channel(Section section, int number, const BoardContext& context,
                         const ReadGroup& group) {
  const std::string owner = "channel " + std::to_string(number);
  ReadChannel channel;
  ChannelSettings& c = channel.settings;
  c.joint = group.joint;
  c.supervision.command_timeout_s = context.command_timeout_s;
  c.supervision.damaged_in_a_row = context.damaged_in_a_row;
  c.supervision.refused_in_a_row = context.refused_in_a_row;
  channel.label.name = section.text("name", owner);
  channel.wiring.enable = context.wiring.line(section.section("enable"), owner + "'s enable");
  channel.wiring.pwm = context.wiring.pwm(section.section("pwm"), owner + "'s PWM");
  const bool group_is_wrong = context.joint_is_wrong || context.bundle_is_wrong;
  if (group.position_owner) {
    take_position(section, *group.position_owner, channel);
  } else if (group_is_wrong && !section.has_own("position")) {
    leave_position_out(section, c);
  } else {
    read_position(section.section("position"), owner, context, channel);
  }
  read_current(section.section("current"), owner, context, channel);
  read_heater(section.section("heater"), context, channel.wiring.pwm, c, channel.label);
  read_limits(section.section("limits"), context, c, channel.label, group.max_travel_m);
  read_muscle(section.section("muscle"), section.section("thermal"), context, c);
  read_detectors(section.section("detectors"), context, channel.wiring, c);
  channel.label.bundle = read_bundle(section.section("bundle"), c);
  read_control(section, context.board.step_s(), c);
  section.finish();
  return channel;
}

}  // namespace supercoil::config
