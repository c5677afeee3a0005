#include "apps/supercoild/latency/report.hpp"

#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace supercoil::daemon {

namespace {

using nlohmann::ordered_json;

struct Percentile {
  const char* name;
  double fraction;
};
constexpr std::array<Percentile, 4> percentiles{
    {{"p50", 0.5}, {"p99", 0.99}, {"p99.9", 0.999}, {"p99.99", 0.9999}}};

double us(hal::Duration time) {
  return 1e-3 * static_cast<double>(time.count());
}

/// Like printf, plus a newline.
template <class... Values>
void add_line(std::string& text, const char* format, Values... values) {
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  text += line.data();
  text += '\n';
}

void add_histogram(std::string& text, const char* title, const Histogram& histogram) {
  // Five signs per decade, so that a single late tick is visible beside a million others.
  constexpr double signs_per_decade = 5.0;
  add_line(text, "%s, us", title);
  add_line(text, "%10s %10s %10s", "from", "to", "ticks");
  for (const Bar& bar : bars(histogram)) {
    const double decades = std::log10(static_cast<double>(bar.count));
    const std::string signs(1 + static_cast<std::size_t>(signs_per_decade * decades), '#');
    add_line(text, "%10.4g %10.4g %10llu %s", us(bar.from), us(bar.to),
             static_cast<unsigned long long>(bar.count), signs.c_str());
  }
  add_line(text, "  min %.4g, mean %.4g", us(histogram.min()), 1e-3 * histogram.mean_ns());
  for (const Percentile& p : percentiles)
    add_line(text, "  %s %.5g", p.name, us(histogram.quantile(p.fraction)));
  add_line(text, "  max %.5g", us(histogram.max()));
}

ordered_json json_of(const Histogram& histogram) {
  ordered_json json;
  json["min_us"] = us(histogram.min());
  json["mean_us"] = 1e-3 * histogram.mean_ns();
  for (const Percentile& p : percentiles)
    json[std::string(p.name) + "_us"] = us(histogram.quantile(p.fraction));
  json["max_us"] = us(histogram.max());
  json["bin_us"] = us(histogram.width());
  json["histogram"] = ordered_json::array();
  for (std::size_t i = 0; i < histogram.bins().size(); ++i) {
    if (histogram.bins()[i] == 0) continue;
    json["histogram"].push_back(
        {us(static_cast<std::int64_t>(i) * histogram.width()), histogram.bins()[i]});
  }
  return json;
}

/// The outline of the histogram: each bin that is not empty is a horizontal line, without gaps.
Panel panel_of(const char* title, const Histogram& histogram) {
  // Stands for 0 on logarithmic axes.
  constexpr double none = 0.5;
  Panel panel{title, "us", "ticks", {{"", {}, {}}}, none, 1.0, true, true};
  Curve& curve = panel.curves.front();
  const auto add = [&](double bin, std::uint64_t count) {
    curve.x.push_back(us(histogram.width()) * std::fmax(bin, none));
    curve.y.push_back(std::fmax(static_cast<double>(count), none));
    panel.y_high = std::fmax(panel.y_high, 2.0 * curve.y.back());
  };
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < histogram.bins().size(); ++i) {
    const std::uint64_t count = histogram.bins()[i];
    if (count != before) {
      add(static_cast<double>(i), before);
      add(static_cast<double>(i), count);
    }
    before = count;
  }
  add(static_cast<double>(histogram.bins().size()), before);
  // Omit the drop to 0 after the last bin.
  if (before == 0) {
    curve.x.pop_back();
    curve.y.pop_back();
  }
  return panel;
}

std::string conditions_text(const LatencyConditions& conditions) {
  if (conditions.priority == 0) return "as an ordinary thread";
  return "with priority " + std::to_string(conditions.priority) + " of SCHED_FIFO";
}

}  // namespace

std::string latency_text(const Latency& latency, const LatencyConditions& conditions) {
  std::string text;
  add_line(text, "%llu ticks at %g Hz, %zu channel%s, %s; overruns: %" PRId64,
           static_cast<unsigned long long>(latency.late.count()), conditions.rate_Hz,
           conditions.channels, conditions.channels == 1 ? "" : "s",
           conditions_text(conditions).c_str(), latency.overruns);
  add_histogram(text, "\nwoke after its time", latency.late);
  add_histogram(text, "\na tick took", latency.tick);
  return text;
}

std::string latency_json(const Latency& latency, const LatencyConditions& conditions) {
  ordered_json json;
  json["rate_Hz"] = conditions.rate_Hz;
  json["channels"] = conditions.channels;
  json["priority"] = conditions.priority;
  json["set_up"] = ordered_json::array();
  for (const hal_linux::SetupStep& step : conditions.steps)
    json["set_up"].push_back({{"step", step.step}, {"worked", step.succeeded}});
  json["ticks"] = latency.late.count();
  json["overruns"] = latency.overruns;
  json["late"] = json_of(latency.late);
  json["tick"] = json_of(latency.tick);
  return json.dump(1, ' ') + "\n";
}

Figure latency_figure(const Latency& latency, const LatencyConditions& conditions) {
  Figure figure;
  std::array<char, 120> title{};
  std::snprintf(title.data(), title.size(), "Woke after its time: %llu ticks at %g Hz, %s",
                static_cast<unsigned long long>(latency.late.count()), conditions.rate_Hz,
                conditions_text(conditions).c_str());
  figure.panels = {panel_of(title.data(), latency.late), panel_of("A tick took", latency.tick)};
  return figure;
}

}  // namespace supercoil::daemon
