#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>

#include <unistd.h>

#include "supercoil/identification/units.hpp"

#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/identify/findings.hpp"
#include "apps/supercoil/identify/input.hpp"
#include "apps/supercoil/user_file.hpp"
#include "storage/posix_files.hpp"

namespace supercoil::operating {

namespace {

using identification::Parts;
using identification::Samples;
using identification::Span;

std::optional<double> seconds_in(std::string_view text, double absent) {
  if (text.empty()) return absent;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "FROM:TO"; either may be omitted. The span must contain enough of the recording.
Result<Span> span_in(const char* option, const std::string& text, const Samples& samples) {
  constexpr std::size_t min_samples = 50;
  const std::size_t colon = text.find(':');
  const std::string_view whole(text);
  const auto from = seconds_in(whole.substr(0, colon), samples.start_s);
  const auto to = colon == std::string::npos ? std::nullopt
                                             : seconds_in(whole.substr(colon + 1), samples.end_s());
  std::size_t measured = 0;
  for (std::size_t k = 0; from && to && k < samples.size(); ++k)
    if (Span{*from, *to}.holds(samples.time_s(k)) && samples.measured(k)) ++measured;
  if (measured >= min_samples) return Span{*from, *to};
  return failure(std::string(option) + " " + text +
                 ": must be FROM:TO in seconds, 50 samples or more within " +
                 identification::time_text(samples.start_s) + " to " +
                 identification::time_text(samples.end_s()));
}

Result<Parts> parts_in(const IdentifyOptions& o, const Samples& samples) {
  Parts parts = identification::default_parts(samples);
  if (!o.fit.empty()) {
    const auto fitted = span_in("--fit", o.fit, samples);
    if (!fitted) return tl::unexpected(fitted.error());
    parts.fitted = *fitted;
    // The rest of the recording after the fitted part, or else the part before it.
    parts.unseen = fitted->to_s < samples.end_s() ? Span{fitted->to_s, samples.end_s()}
                                                  : Span{samples.start_s, fitted->from_s};
  }
  if (!o.judge.empty()) {
    const auto unseen = span_in("--judge", o.judge, samples);
    if (!unseen) return tl::unexpected(unseen.error());
    parts.unseen = *unseen;
    if (o.fit.empty()) {
      parts.fitted = unseen->from_s > samples.start_s ? Span{samples.start_s, unseen->from_s}
                                                      : Span{unseen->to_s, samples.end_s()};
    }
  }
  const bool apart =
      parts.fitted.to_s <= parts.unseen.from_s || parts.unseen.to_s <= parts.fitted.from_s;
  if (!apart) return failure("--fit and --judge must not overlap");
  return parts;
}

Findings find(const IdentifyOptions& o, std::size_t rows, Samples samples, const Parts& parts) {
  Findings f;
  f.file = std::filesystem::path(o.file).filename().string();
  f.rows = rows;
  f.samples = std::move(samples);
  f.comparison = identification::compare(f.samples, parts);
  const Span all{f.samples.start_s, f.samples.end_s()};
  const auto& best = f.comparison.best().fit;
  const auto& linear = f.comparison.models.front().fit;
  const auto effects = identification::linear_effects(best.effects);
  f.whole = identification::refit(best.muscle, best.effects, f.samples, all);
  f.linear_first = identification::refit(linear.muscle, effects, f.samples, parts.fitted);
  f.linear = identification::refit(f.linear_first.muscle, effects, f.samples, all);
  f.thermal_mass_assumed = !o.thermal_mass_J_per_K;
  f.stiffness_assumed = !o.stiffness_N_per_m && !o.moving_mass_kg;
  if (o.thermal_mass_J_per_K) f.assumed.thermal_mass_J_per_K = *o.thermal_mass_J_per_K;
  if (o.stiffness_N_per_m) f.assumed.stiffness_N_per_m = *o.stiffness_N_per_m;
  f.assumed.moving_mass_kg = o.moving_mass_kg;
  return f;
}

}  // namespace

int identify_command(const IdentifyOptions& options) {
  for (const std::string& path : {options.muscle, options.plot}) {
    if (!path.empty() && would_replace(path, options.file)) {
      return refuse(options.json, exit_wrong_input,
                    path + ": would replace " + options.file + " itself");
    }
  }
  const auto recording = read_input(options);
  if (!recording) return refuse(options.json, exit_wrong_input, recording.error().text());
  for (const identification::Problem& warning : recording->warnings)
    std::fprintf(stderr, "supercoil: %s\n", to_text(options.file, warning).c_str());
  Samples samples = identification::resample(*recording);
  const auto parts = parts_in(options, samples);
  if (!parts) return refuse(options.json, exit_wrong_input, parts.error().text());
  const Findings found = find(options, recording->size(), std::move(samples), *parts);

  std::string text = options.json ? json_report(found) : report(found);
  const bool accepted = found.comparison.rejection_reason.empty();
  Result<std::string> table = failure("no [muscle] table is written: no model is accepted");
  if (accepted) table = muscle_table(found);
  if (table && options.muscle.empty() && !options.json) text += "\n" + *table;
  storage::PosixFiles files;
  if (const auto written = files.write({STDOUT_FILENO, "standard output"}, text); !written)
    return refuse(options.json, exit_failed, written.error().text());
  int status = table ? exit_done : fail(exit_failed, table.error().text());
  if (table && !options.muscle.empty()) {
    if (const auto written = write_file(options.muscle, *table); !written)
      status = fail(exit_failed, written.error().text());
  }
  // Last: without gnuplot only the figure is missing.
  if (!options.plot.empty()) {
    if (const auto drawn = draw(identify_figure(found), options.plot); !drawn)
      status = fail(exit_failed, drawn.error().text());
  }
  return status;
}

}  // namespace supercoil::operating
