#include "apps/supercoil/setup/nameplate.hpp"

#include "config/toml_file.hpp"
#include "supervisor/limiter.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

/// Air temperature at which the muscle is rated.
constexpr double rated_air_C = 25.0;
/// The max that a person may state for their answers: suppliers' data are of similar muscles.
constexpr double uncertainty_percent = 60.0;
/// Power is derated over this fraction of the rise, up to the max temperature.
constexpr double derated_ratio = 0.2;
constexpr int temperature_digits = 4;

}  // namespace

std::string Nameplate::objection() const {
  const double max_C = of(Rated::max_C);
  if (!(max_C > 0.0 && max_C < min_rated_C)) return {};
  return "max_C = " + number_text(max_C, temperature_digits) +
         ": must be 0, if it is not given, or " +
         range_text({min_rated_C, nameplate_questions.back().allowed.max}) +
         ": no muscle moves below";
}

double Nameplate::suggested(QuestionId question) const {
  if (!present()) return NAN;
  const double stroke_mm = 1e-2 * of(Rated::stroke_percent) * of(Rated::length_mm);
  const bool rated_hot = of(Rated::max_C) >= min_rated_C;
  switch (question) {
    case QuestionId::cold_resistance_Ohm:
      return of(Rated::Ohm);
    case QuestionId::load_g:
      return of(Rated::stroke_load_g);
    case QuestionId::heated_W:
    case QuestionId::max_W:
      return of(Rated::power_W);
    case QuestionId::heated_mm:
    case QuestionId::max_travel_mm:
      return stroke_mm;
    case QuestionId::heated_K:
      return rated_hot ? of(Rated::max_C) - rated_air_C : NAN;
    case QuestionId::uncertainty_percent:
      return uncertainty_percent;
    default:
      return NAN;
  }
}

std::vector<Entry> Nameplate::limits(double trip_C) const {
  const double max_C = of(Rated::max_C);
  if (!(max_C >= min_rated_C && max_C < trip_C)) return {};
  const double derate_C = max_C - derated_ratio * (max_C - rated_air_C);
  return {{"limits.trip_C", number_text(max_C, temperature_digits), "max_C of the nameplate"},
          {"limits.derate_from_C", number_text(derate_C, temperature_digits),
           "a fifth of its rise below max_C"}};
}

double trip_in_file_C(const std::string& text, int channel) {
  const toml::table document = toml::parse(text);
  const std::string own = "channel[" + std::to_string(channel - 1) + "].limits.";
  const auto at = [&](const char* key) {
    const auto node = document.at_path(own + key);
    return node ? node : document.at_path(std::string("every_channel.limits.") + key);
  };
  if (at("preset").value_or(std::string()) == "skin") return 0.0;
  return at("trip_C").value_or(LimiterSettings().derate_to_C);
}

}  // namespace supercoil::operating
