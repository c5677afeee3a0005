#include "unit/hal_linux/support/pwm_kernel.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <optional>

#include "unit/hal_linux/support/system_calls.hpp"

namespace supercoil::test {

namespace {

constexpr const char* chip = "devices/soc/i2c-1/1-0040/pwm/pwmchip3";

bool is_valid(const PwmState& state) {
  return state.period_ns > 0 && state.duty_ns <= state.period_ns;
}

/// As kstrtou64: no sign, no spaces.
std::optional<std::int64_t> unsigned_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 0) return {};
  return value;
}

std::optional<PwmState> changed(PwmState state, std::string_view attribute, std::string_view text) {
  if (attribute == "polarity") {
    if (text != "normal" && text != "inversed") return {};
    // Documentation/driver-api/pwm.rst: only while disabled.
    if (state.enabled && state.inversed != (text == "inversed")) return {};
    state.inversed = text == "inversed";
    return state;
  }
  const auto number = unsigned_number(text);
  if (!number) return {};
  if (attribute == "period") state.period_ns = *number;
  if (attribute == "duty_cycle") state.duty_ns = *number;
  if (attribute == "enable") {
    if (*number > 1) return {};
    state.enabled = *number == 1;
  }
  return state;
}

}  // namespace

double PwmState::on() const {
  if (!enabled || period_ns == 0) return 0.0;
  const double duty = std::min(1.0, static_cast<double>(duty_ns) / static_cast<double>(period_ns));
  return inversed ? 1.0 - duty : duty;
}

PwmKernel::PwmKernel(const PwmState& left, bool exported, Rules rules, int number)
    : state(left), rules_(rules), output_(std::string(chip) + "/pwm" + std::to_string(number)) {
  tree.write(std::string(chip) + "/npwm", "16\n");
  tree.write(std::string(chip) + "/export", "");
  tree.write("devices/soc/i2c-1/1-0040/name", "pca9685\n");
  tree.link(std::string(chip) + "/device", "devices/soc/i2c-1/1-0040");
  tree.link("class/pwm/pwmchip3", chip);
  if (exported) show_all();
  set_driver([this](const std::string& path, std::string_view text) { return write(path, text); });
}

PwmKernel::~PwmKernel() {
  reset_calls();
}

void PwmKernel::show(std::string_view attribute) const {
  const std::string path = output_ + "/" + std::string(attribute);
  if (attribute == "period") tree.write(path, std::to_string(state.period_ns) + "\n");
  if (attribute == "duty_cycle") tree.write(path, std::to_string(state.duty_ns) + "\n");
  if (attribute == "enable") tree.write(path, state.enabled ? "1\n" : "0\n");
  if (attribute == "polarity") tree.write(path, state.inversed ? "inversed\n" : "normal\n");
}

void PwmKernel::show_all() const {
  for (const char* attribute : {"period", "duty_cycle", "enable", "polarity"})
    show(attribute);
}

long PwmKernel::write(const std::string& path, std::string_view text) {
  const std::string attribute = path.substr(path.rfind('/') + 1);
  const std::string what = attribute + " " + std::string(text);
  writes.push_back(what);
  const auto written = static_cast<long>(text.size());
  if (attribute == "export") {
    show_all();
    return written;
  }
  const auto wanted = changed(state, attribute, text);
  const long error = wanted ? apply(*wanted) : -EINVAL;
  if (error == 0) show(attribute);
  if (error != 0) refusals.push_back(what);
  return error != 0 ? error : written;
}

long PwmKernel::apply(const PwmState& wanted) {
  const bool judged = rules_ != Rules::enabled_only || wanted.enabled;
  const bool from_bad_to_bad = rules_ == Rules::since_6_8 && !is_valid(state);
  if (judged && !is_valid(wanted) && !from_bad_to_bad) return -EINVAL;
  state = wanted;
  max_on = std::max(max_on, state.on());
  return 0;
}

}  // namespace supercoil::test
