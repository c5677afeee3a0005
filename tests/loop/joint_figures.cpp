// How well joints track: two `real` muscles that differ by 20 %, with the board's beliefs up to
// 50 % off, before and after identify; and one such muscle with a spring:
//   joint_figures [SEEDS [MOTION [CONTROLLER]]]
// MOTION, CONTROLLER: a part of a name. The motion `identify` only identifies, and prints how far
// off the result is: θ2 to θ4 against the linear muscle that moves nearest to the muscle in the
// joint. Runs that fault, or that heat holds back beside a spring, are printed but not among the
// figures. The tables of docs/joints.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include "loop/support/best_linear.hpp"
#include "runner/simulation.hpp"
#include "scenario/read_scenario.hpp"

namespace {

using namespace supercoil;
using host_sim::Simulation;
using host_sim::TickRecord;

constexpr double lever_m = 0.015;
constexpr double degree_m = lever_m * std::numbers::pi / 180.0;
constexpr double noise_deg = 0.02;
constexpr std::array<const char*, 4> varied{"thermal_mass_J_per_K", "heat_transfer_W_per_K",
                                            "stiffness_N_per_m", "force_per_kelvin_N_per_K"};

class Drawn {
 public:
  explicit Drawn(int seed) : source_(static_cast<unsigned>(seed)) {}
  /// -1 to 1.
  double uniform() { return uniform_(source_); }
  /// Each varied parameter is 10 % above or below its default.
  control::PhysicalParameters muscle() {
    control::PhysicalParameters m;
    for (const char* name : varied)
      member(m, name) *= uniform() > 0.0 ? 1.1 : 0.9;
    return m;
  }
  static double& member(control::PhysicalParameters& m, const std::string& name) {
    const auto found =
        std::find_if(control::physical_ranges.begin(), control::physical_ranges.end(),
                     [&](const control::PhysicalRange& range) { return name == range.name; });
    return m.*found->member;
  }

 private:
  boost::random::mt19937 source_;
  boost::random::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

std::string line(const std::string& key, double value) {
  return key + " = " + std::to_string(value) + "\n";
}

std::string table(const std::string& title, const control::PhysicalParameters& muscle) {
  std::string text = "[" + title + "]\n";
  for (const control::PhysicalRange& range : control::physical_ranges) {
    if (std::string(range.name) != "moving_mass_kg") text += line(range.name, muscle.*range.member);
  }
  return text;
}

struct Motion {
  const char* name;
  double duration_s;
  double (*reference_deg)(double time_s);
  bool (*counts)(double time_s);
  double pull_at_s;  ///< both muscles pull twice as hard from then on
};

constexpr double never_s = 1e9;

double set_points_deg(double time_s) {
  constexpr std::array<double, 6> levels{0.0, 20.0, -10.0, 10.0, -20.0, 5.0};
  return levels.at(static_cast<std::size_t>(time_s / 20.0) % levels.size());
}

const std::array<Motion, 3> motions{{
    // Counts the last 8 s of each 20 s, when the joint has settled.
    {"set points", 240.0, set_points_deg,
     [](double t) { return t > 120.0 && std::fmod(t, 20.0) > 12.0; }, never_s},
    {"sine of 20 deg at 0.1 Hz", 200.0,
     [](double t) { return 20.0 * std::sin(0.2 * std::numbers::pi * t); },
     [](double t) { return t > 160.0; }, never_s},
    {"pull doubled at 10 deg", 240.0, [](double) { return 10.0; },
     [](double t) { return t > 120.0; }, 120.0},
}};

enum class OpposedBy { muscle, spring };

/// A muscle only pulls, so a joint with a spring moves as far, but around this angle instead of 0.
double middle_deg(OpposedBy opposed_by) {
  return opposed_by == OpposedBy::spring ? 21.0 : 0.0;
}

/// With the same seed both kinds of joint have the same agonist; the spring is as stiff as a new,
/// cold muscle.
std::string scenario_of(int seed, const std::string& controller, OpposedBy opposed_by) {
  Drawn drawn(seed);
  const control::PhysicalParameters agonist = drawn.muscle();
  control::PhysicalParameters antagonist = drawn.muscle();
  const bool spring = opposed_by == OpposedBy::spring;
  if (spring) {
    antagonist = {};
    antagonist.damping_Ns_per_m = 0.0;
  }
  std::string text = "[simulation]\nseed = " + std::to_string(seed) +
                     "\nduration_s = 2000.0\n[operator]\naction = 'none'\n[controller]\nkind = '" +
                     controller + "'\n";
  text += "[power]\npwm_bits = 12\n[sensor.position]\n" +
          line("noise_rms_m", noise_deg * degree_m) +
          "[thermal]\nmass_ratio = [0.45, 2.5]\ntransfer_ratio = [0.3, 4.4]\n";
  text += table("plant", agonist) + "preset = 'real'\n[joint]\npretension_N = 0.4\n";
  if (spring) {
    text += "opposed_by = 'spring'\n" +
            line("spring_Nm_per_rad", antagonist.stiffness_N_per_m * lever_m * lever_m);
  } else {
    text += table("joint.antagonist", antagonist) + "preset = 'real'\n";
  }
  // Beliefs about the joint along its arc, each up to 50 % off; the force is the one at the middle
  // of the muscle's range.
  const std::array<std::pair<const char*, const control::PhysicalParameters*>, 2> beliefs{
      {{"muscle", &agonist}, {"joint.antagonist_muscle", &antagonist}}};
  for (const auto& [title, truth] : beliefs) {
    if (spring && truth == &antagonist) continue;
    control::PhysicalParameters believed = *truth;
    believed.stiffness_N_per_m = agonist.stiffness_N_per_m + antagonist.stiffness_N_per_m;
    believed.damping_Ns_per_m = agonist.damping_Ns_per_m + antagonist.damping_Ns_per_m;
    for (const control::PhysicalRange& range : control::physical_ranges)
      believed.*range.member *= 1.0 + 0.5 * drawn.uniform();
    text += table(title, believed);
  }
  return text;
}

struct Found {
  double rms_deg = 0.0;
  double max_deg = 0.0;
  double hottest_C = 0.0;
  long outside = 0;
  Fault fault = Fault::none;
  bool held_back = false;  ///< by temperature or `unproven`, while the motion counts
};

/// What an operator does with a joint.
class Operated {
 public:
  Operated(const host_sim::Scenario& scenario, OpposedBy opposed_by)
      : simulation_(scenario),
        middle_deg_(middle_deg(opposed_by)),
        channels_(opposed_by == OpposedBy::spring ? 1U : 2U) {}

  void arm() {
    while (state(0) != State::armed) {
      send(0, Verb::arm);
      run(1.0);
    }
  }
  /// All muscles in one run; false when one was not found.
  bool identify() {
    send(0, Verb::identify);
    did_ = {};
    do {
      note(tick());
      send(0, Verb::renew);
    } while (state(0) == State::active);
    for (std::size_t channel = 0; channel < channels_; ++channel) {
      const Snapshot& ended = simulation_.loop().channel(channel).snapshot();
      if (ended.result == ModeResult::found) continue;
      std::printf("  channel %zu: %s\n", channel + 1, describe_notes(ended.identify_notes).c_str());
      return false;
    }
    run(15.0);
    return true;
  }
  Found follow(const Motion& motion) {
    double squares = 0.0;
    double count = 0.0;
    bool pulls = false;
    const long ticks = std::lround(motion.duration_s * 1e3);
    for (long i = 0; i < ticks; ++i) {
      const double time_s = 1e-3 * static_cast<double>(i);
      send(0, Verb::position, (middle_deg_ + motion.reference_deg(time_s)) * degree_m);
      if (!pulls && time_s >= motion.pull_at_s) {
        send(1, Verb::power, 2.0 * simulation_.loop().channel(1).snapshot().reference);
        pulls = true;
      }
      const TickRecord now = tick();
      if (!motion.counts(time_s)) continue;
      found_.held_back = found_.held_back || now.limited_by == LimitedBy::temperature ||
                         now.limited_by == LimitedBy::unproven;
      const double error_deg = (now.position_m - now.model_m) / degree_m;
      squares += error_deg * error_deg;
      count += 1.0;
      found_.max_deg = std::max(found_.max_deg, std::abs(error_deg));
    }
    found_.rms_deg = std::sqrt(squares / count);
    return found_;
  }
  const Found& found() const { return found_; }
  std::size_t channels() const { return channels_; }
  /// Relative errors of θ2 to θ4 of a muscle that identify found.
  control::Vector<double, 3> error_ratio(std::size_t channel) const {
    const control::PhysicalParameters& muscle = simulation_.learned(channel)->muscle;
    const Did& did = did_.at(channel);
    const control::Theta nearest =
        test::best_linear(did.position_m, did.power_W, muscle.moving_mass_kg);
    return (control::theta_from(muscle).cwiseQuotient(nearest) - control::Theta::Ones()).tail<3>();
  }
  /// The standard deviations that the board reports for them.
  control::Vector<double, 3> deviation_ratio(std::size_t channel) const {
    const Channel& of = simulation_.loop().channel(channel);
    return {of.known(known_theta1_deviation + 1), of.known(known_theta1_deviation + 2),
            of.known(known_theta1_deviation + 3)};
  }

 private:
  /// A muscle during identify, sampled at 100 Hz.
  struct Did {
    std::vector<double> position_m;
    std::vector<double> power_W;
  };

  void note(const TickRecord& now) {
    if (simulation_.tick() % 10 != 0) return;
    const bool second =
        channels_ > 1 && simulation_.loop().channel(1).snapshot().result == ModeResult::running;
    Did& did = did_.at(second ? 1 : 0);
    did.position_m.push_back(second ? -now.measured_m : now.measured_m);
    did.power_W.push_back(second ? now.antagonist->applied_power_W : now.applied_power_W);
  }
  State state(std::size_t channel) const {
    return simulation_.loop().channel(channel).state().state();
  }
  void send(std::uint8_t channel, Verb verb, double value = 0.0) {
    simulation_.loop().send({channel, verb, value});
  }
  void run(double time_s) {
    for (long i = std::lround(time_s * 1e3); i > 0; --i)
      tick();
  }
  TickRecord tick() {
    const TickRecord now = simulation_.step();
    if (found_.fault == Fault::none) found_.fault = now.fault;
    watch(now.temperature_rise_K, now.coldest_K, now.hottest_K);
    if (const auto& other = now.antagonist)
      watch(other->temperature_rise_K, other->coldest_K, other->hottest_K);
    return now;
  }
  void watch(double rise_K, double coldest_K, double hottest_K) {
    found_.hottest_C = std::max(found_.hottest_C, 25.0 + rise_K);
    found_.outside += rise_K < coldest_K - 1e-9 || rise_K > hottest_K + 1e-9 ? 1 : 0;
  }

  Simulation simulation_;
  double middle_deg_;
  std::size_t channels_;
  Found found_;
  std::array<Did, 2> did_;
};

/// Empty: a muscle was not identified.
std::optional<Found> run_one(const std::string& text, OpposedBy opposed_by, const Motion& motion,
                             bool identified) {
  const auto scenario = host_sim::parse_scenario(text, "joint.toml");
  if (!scenario) {
    std::fputs(config::to_text(scenario.error()).c_str(), stderr);
    std::exit(2);
  }
  Operated joint(*scenario, opposed_by);
  joint.arm();
  if (identified && !joint.identify()) return std::nullopt;
  return joint.follow(motion);
}

void print_row(const Motion& motion, const std::string& controller, OpposedBy opposed_by,
               bool identified, int seeds) {
  std::vector<double> rms;
  Found worst;
  int faults = 0;
  int not_identified = 0;
  int held_back = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto found =
        run_one(scenario_of(seed, controller, opposed_by), opposed_by, motion, identified);
    if (!found) {
      ++not_identified;
      continue;
    }
    worst.hottest_C = std::max(worst.hottest_C, found->hottest_C);
    worst.outside += found->outside;
    if (found->fault != Fault::none) {
      ++faults;
      std::printf("  seed %d: %s\n", seed, std::string(name(found->fault)).c_str());
      continue;
    }
    held_back += found->held_back ? 1 : 0;
    if (found->held_back && opposed_by == OpposedBy::spring) continue;
    rms.push_back(found->rms_deg);
    worst.max_deg = std::max(worst.max_deg, found->max_deg);
  }
  if (rms.empty()) rms.push_back(NAN);
  std::sort(rms.begin(), rms.end());
  std::printf(
      "%-25s %-11s %-6s %-10s rms %.4f (median), %.4f deg (worst), at most %.4f; %2.0f C, "
      "%ld ticks outside, %d faults, %d not identified, %d held back by their heat\n",
      motion.name, controller.c_str(), opposed_by == OpposedBy::spring ? "spring" : "muscle",
      identified ? "identified" : "known", rms[rms.size() / 2], rms.back(), worst.max_deg,
      worst.hottest_C, worst.outside, faults, not_identified, held_back);
  std::fflush(stdout);
}

void print_identified(OpposedBy opposed_by, int seeds) {
  int all_found = 0;
  std::array<control::Vector<double, 3>, 2> worst{};
  worst.fill(control::Vector<double, 3>::Zero());
  std::array<control::Vector<double, 3>, 2> reported = worst;
  std::array<control::Vector<double, 3>, 2> in_deviations = worst;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto scenario =
        host_sim::parse_scenario(scenario_of(seed, "learned_ff", opposed_by), "joint.toml");
    Operated joint(scenario.value(), opposed_by);
    joint.arm();
    if (!joint.identify()) {
      std::printf("  seed %d\n", seed);
      continue;
    }
    ++all_found;
    for (std::size_t i = 0; i < joint.channels(); ++i) {
      const control::Vector<double, 3> error = joint.error_ratio(i).cwiseAbs();
      worst.at(i) = worst.at(i).cwiseMax(error);
      reported.at(i) = reported.at(i).cwiseMax(joint.deviation_ratio(i));
      in_deviations.at(i) =
          in_deviations.at(i).cwiseMax(error.cwiseQuotient(joint.deviation_ratio(i)));
    }
  }
  std::printf("identify, %s: %d of %d joints\n",
              opposed_by == OpposedBy::spring ? "spring" : "muscle", all_found, seeds);
  for (std::size_t i = 0; i < (opposed_by == OpposedBy::spring ? 1U : 2U); ++i) {
    std::printf(
        "  channel %zu: θ2, θ3, θ4 at most %.2g / %.2g / %.2g %% off, published %.2g / %.2g / "
        "%.2g %%; %.1f / %.1f / %.1f deviations\n",
        i + 1, 100.0 * worst[i][0], 100.0 * worst[i][1], 100.0 * worst[i][2],
        100.0 * reported[i][0], 100.0 * reported[i][1], 100.0 * reported[i][2], in_deviations[i][0],
        in_deviations[i][1], in_deviations[i][2]);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 20;
    if (argc <= 2 || std::string("identify").find(argv[2]) == 0) {
      for (const OpposedBy opposed_by : {OpposedBy::muscle, OpposedBy::spring})
        print_identified(opposed_by, seeds);
    }
    for (const Motion& motion : motions) {
      if (argc > 2 && std::string(motion.name).find(argv[2]) == std::string::npos) continue;
      for (const bool identified : {false, true}) {
        for (const char* controller : {"learned_ff", "adaptive_ff", "pi", "mrac"}) {
          if (argc > 3 && std::string(controller).find(argv[3]) == std::string::npos) continue;
          print_row(motion, controller, OpposedBy::muscle, identified, seeds);
          if (motion.pull_at_s == never_s)
            print_row(motion, controller, OpposedBy::spring, identified, seeds);
        }
      }
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "joint_figures: %s\n", error.what());
    return 1;
  }
}
