// Writes a recording as a board does, for the tests of `supercoil log`: write_sample FOLDER.
// Two channels at 100 Hz; channel 2 gets too hot at 20 s, channel 1 is stopped 0.5 s later, and
// the ticks from 15.5 s to 16 s are lost.
#include <cmath>
#include <cstdio>

#include "recorder/flight_recorder.hpp"
#include "storage/posix_files.hpp"
#include "unit/firmware/io/recorder/support/rows.hpp"

namespace {

using namespace supercoil;

Row sample(std::int64_t tick, int channel) {
  const bool hot = channel == 1;
  const std::int64_t fault_tick = hot ? 2000 : 2050;
  const bool faulty = tick >= fault_tick;
  const Fault cause = hot ? Fault::over_temperature : Fault::emergency_stop;
  Row row = test::row(tick * test::tick_ns, channel, faulty ? cause : Fault::none);
  row.mode = static_cast<std::uint8_t>(faulty ? Mode::rest : Mode::position);
  row.flags = row_trusted | row_proof_off;
  row.reference = 0.011F;
  row.applied_W = faulty ? 0.0F : hot ? 4.0F : 1.0F;
  row.demanded_W = row.applied_W;
  row.supply_V = 12.0F;
  row.resistance_Ohm = faulty ? NAN : 10.0F;
  const std::int64_t hot_C = 60 + tick / 20;
  row.hottest_C = hot ? static_cast<float>(hot_C) : 40.0F;
  const Fault detectors[] = {Fault::over_temperature, Fault::over_travel, Fault::under_voltage};
  row.margin_selector = static_cast<std::uint8_t>(detectors[tick % 3]);
  row.margin_limit = tick % 3 == 0 ? 160.0F : 1.0F;
  row.margin_measured = tick % 3 == 0 ? row.hottest_C : 0.25F * static_cast<float>(tick % 3);
  row.margin_used = row.margin_measured / row.margin_limit;
  return row;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  storage::PosixFiles files;
  recorder::FlightRecorder recorder(arguments[1], 2, test::rate_Hz, files);
  for (std::int64_t tick = 0; tick < 2200; ++tick) {
    if (tick >= 1550 && tick < 1600) continue;
    for (const int channel : {0, 1})
      recorder.add(sample(tick, channel));
  }
  bool failed = false;
  for (const auto& note : recorder.take_notes()) {
    std::puts(note.text.c_str());
    failed = failed || note.problem;
  }
  return failed ? 1 : 0;
}
