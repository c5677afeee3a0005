#include <cmath>
#include <numeric>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "apps/supercoild/latency/histogram.hpp"
#include "apps/supercoild/latency/inert_board.hpp"
#include "apps/supercoild/latency/report.hpp"

using namespace supercoil;
using namespace supercoil::daemon;
using namespace std::chrono_literals;

namespace {

Histogram microseconds(const std::vector<hal::Duration>& times) {
  Histogram histogram(1us, 1000);
  for (const hal::Duration time : times)
    histogram.add(time);
  return histogram;
}

std::uint64_t sum(const std::vector<Bar>& all) {
  return std::accumulate(all.begin(), all.end(), std::uint64_t{0},
                         [](std::uint64_t n, const Bar& bar) { return n + bar.count; });
}

}  // namespace

TEST_GROUP(LatencyHistogram){};

TEST(LatencyHistogram, HoldsExactEndsAndMeanBesideItsBins) {
  const Histogram histogram = microseconds({1500ns, 500ns, 1999ns});
  CHECK(histogram.min() == 500ns);
  CHECK(histogram.max() == 1999ns);
  DOUBLES_EQUAL(3999.0 / 3.0, histogram.mean_ns(), 1e-9);
  LONGS_EQUAL(1, histogram.bins()[0]);
  LONGS_EQUAL(2, histogram.bins()[1]);
}

TEST(LatencyHistogram, QuantileIsTheEndOfItsBin) {
  Histogram histogram(1us, 1000);
  for (int i = 0; i < 100; ++i)
    histogram.add(i * 1us + 300ns);
  CHECK(histogram.quantile(0.0) == 1us);
  CHECK(histogram.quantile(0.5) == 50us);
  CHECK(histogram.quantile(0.99) == 99us);
  CHECK(histogram.quantile(1.0) == 99us + 300ns);  // never above the measured maximum
}

TEST(LatencyHistogram, CountsLongTimesInTheLastBinAndNegativeTimesInTheFirst) {
  const Histogram histogram = microseconds({1h, 1us, -5us});
  LONGS_EQUAL(1, histogram.bins().back());
  LONGS_EQUAL(1, histogram.bins().front());
  CHECK(histogram.quantile(0.5) == 2us);
  CHECK(histogram.quantile(0.9999) == 1h);
  CHECK(histogram.min() == 0us);
}

TEST(LatencyHistogram, IsAllZeroWithoutTimes) {
  const Histogram histogram = microseconds({});
  CHECK(histogram.min() == 0us);
  CHECK(histogram.quantile(0.99) == 0us);
  DOUBLES_EQUAL(0.0, histogram.mean_ns(), 0.0);
  CHECK(bars(histogram).empty());
}

TEST(LatencyHistogram, BarsAreFewAndCountEveryTimeOnce) {
  Histogram histogram(1us, 1000);
  for (int i = 0; i < 100'000; ++i)
    histogram.add(50us + (i % 70) * 1us);
  histogram.add(700us);
  histogram.add(5s);
  const std::vector<Bar> all = bars(histogram);
  LONGS_EQUAL(100'002, sum(all));
  CHECK(all.size() <= 30);
  CHECK(all.front().from == 50us);
  CHECK(all.back().to == 5s);
  for (std::size_t i = 1; i < all.size(); ++i)
    CHECK(all[i].from >= all[i - 1].to);
}

TEST(LatencyHistogram, ASingleTimeGivesOneBar) {
  const std::vector<Bar> all = bars(microseconds({57us, 57us}));
  LONGS_EQUAL(1, all.size());
  CHECK(all[0].from == 57us && all[0].to == 58us && all[0].count == 2);
}

namespace {

/// A loop without devices, ticked by hand, 3 µs late each time.
struct MeasuredLoop {
  BoardSettings settings;
  InertBoard board;
  Loop loop{settings, board.devices(1)};
  hal_linux::MonotonicClock clock;

  /// Runs ticks as the executive does.
  void run(LatencyMeter& meter, int ticks, long skipped = 0) {
    for (int i = 0; i < ticks; ++i) {
      loop.health().telemetry_heartbeats.fetch_add(1);
      const hal::Time woke = meter.wait_until(clock.now());
      loop.tick(woke - 3us, woke, skipped);
    }
  }
};

}  // namespace

TEST_GROUP(LatencyMeter) {
  MeasuredLoop measured;
};

TEST(LatencyMeter, SkipsTheFirstTicksAndThenCountsAsManyAsRequested) {
  LatencyMeter meter(measured.loop, 5, 10);
  measured.run(meter, 6, 1);
  LONGS_EQUAL(0, meter.measured());
  measured.run(meter, 10, 1);
  LONGS_EQUAL(10, meter.measured());
  CHECK(meter.done());
  measured.run(meter, 10, 1);
  LONGS_EQUAL(10, meter.result().late.count());
  LONGS_EQUAL(10, meter.result().tick.count());
  LONGS_EQUAL(10, meter.result().overruns);
  CHECK(meter.latest() == 3us);
  CHECK(meter.result().late.min() == 3us);
}

TEST(LatencyMeter, MeasuresALoopThatCannotHeat) {
  LatencyMeter meter(measured.loop, 0, 2000);
  measured.run(meter, 2001);
  int rows = 0;
  for (Row row; measured.loop.take(row); ++rows) {
    LONGS_EQUAL(State::fault, row.state);
    LONGS_EQUAL(Fault::emergency_stop, row.fault);
    DOUBLES_EQUAL(0.0, row.duty, 0.0);
  }
  CHECK(rows > 900);
  CHECK_FALSE(measured.loop.self_test().passed());
}

TEST_GROUP(LatencyReport) {
  Latency latency;
  LatencyConditions conditions{500.0, 2, 80, {{"memory locked", true, "", ""}}};

  void setup() override {
    for (int i = 0; i < 999; ++i) {
      latency.late.add(60us + (i % 10) * 1us);
      latency.tick.add(1200ns);
    }
    latency.late.add(450us);
    latency.tick.add(3us);
    latency.overruns = 2;
  }
};

TEST(LatencyReport, TextHasConditionsAndResults) {
  const std::string text = latency_text(latency, conditions);
  STRCMP_CONTAINS("1000 ticks at 500 Hz, 2 channels, with priority 80 of SCHED_FIFO; overruns: 2\n",
                  text.c_str());
  STRCMP_CONTAINS("        60         61        100 ###########\n", text.c_str());
  STRCMP_CONTAINS("  p50 65\n  p99 70\n  p99.9 70\n  p99.99 450\n  max 450\n", text.c_str());
}

TEST(LatencyReport, JsonHoldsEveryNonEmptyBin) {
  const auto json = nlohmann::json::parse(latency_json(latency, conditions));
  LONGS_EQUAL(1000, json["ticks"].get<int>());
  CHECK(json["set_up"][0]["worked"].get<bool>());
  LONGS_EQUAL(11, json["late"]["histogram"].size());
  CHECK(json["late"]["histogram"][10] == nlohmann::json::array({450.0, 1}));
  DOUBLES_EQUAL(1.2, json["tick"]["histogram"][0][0].get<double>(), 1e-12);
}

TEST(LatencyReport, FigureOutlinesEveryBin) {
  const Figure figure = latency_figure(latency, conditions);
  LONGS_EQUAL(2, figure.panels.size());
  CHECK(figure.panels[0].x_logarithmic && figure.panels[0].y_logarithmic);
  const Curve& late = figure.panels[0].curves[0];
  // 100 times 60 to 68 µs, 99 times 69 µs; 450 µs once.
  CHECK((late.x == std::vector<double>{60, 60, 69, 69, 70, 70, 450, 450, 451, 451}));
  CHECK((late.y == std::vector<double>{0.5, 100, 100, 99, 99, 0.5, 0.5, 1, 1, 0.5}));
  DOUBLES_EQUAL(200.0, figure.panels[0].y_high, 0.0);
}
