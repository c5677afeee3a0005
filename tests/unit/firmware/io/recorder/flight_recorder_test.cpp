// What is recorded, and when.
#include <CppUTest/TestHarness.h>

#include "text/program_version.hpp"
#include "unit/firmware/io/recorder/support/recorder_on_a_disk.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP_BASE(FlightRecorder, RecorderOnADisk){};

TEST(FlightRecorder, WithoutAFaultTouchesNoFile) {
  ticks.until(40.0);
  recorder.poll(std::chrono::seconds(100));
  recorder.finish();
  LONGS_EQUAL(0, files.calls());
  STRCMP_EQUAL("", notes().c_str());
}

TEST(FlightRecorder, WritesTenSecondsBeforeAndOneSecondAfterTheFault) {
  ticks.until(19.99);
  ticks.fault(1);
  ticks.until(21.0);
  LONGS_EQUAL_TEXT(0, recordings(), "the second has not passed");
  ticks.until(21.01);
  LONGS_EQUAL(1, recordings());
  const auto written = recording(1);
  check_rows(written.rows, 10.0, 21.0);
  LONGS_EQUAL(2, written.header.channels);
  CHECK(written.header.rate_Hz == rate_Hz);
  LONGS_EQUAL(30, written.header.fault);
  STRCMP_EQUAL("over_temperature", written.header.fault_name.c_str());
  LONGS_EQUAL(1, written.header.fault_channel);
  CHECK(written.header.fault_time_ns == 20 * second_ns);
  CHECK(written.header.program == program_version());
  STRCMP_EQUAL("/d/flight-1.scfr: over_temperature (30) of channel 2 is recorded\n",
               notes().c_str());
  STRCMP_EQUAL("", notes().c_str());
}

TEST(FlightRecorder, SoonAfterTheStartRecordsTheAvailableRows) {
  ticks.until(2.99);
  ticks.fault(0);
  ticks.until(5.0);
  check_rows(recording(1).rows, 0.0, 4.0);
}

TEST(FlightRecorder, RecordsAFaultPresentInTheFirstRow) {
  ticks.fault(0, Fault::self_test_failed);
  ticks.until(2.0);
  check_rows(recording(1).rows, 0.0, 1.0);
}

TEST(FlightRecorder, IsCompleteWhereverTheRingBufferWraps) {
  // The memory holds 16 s and two ticks: faults 11.37 s apart end up at every place in it.
  for (int i = 1; i <= 40; ++i) {
    const double at_s = 12.0 + i * 11.37;
    ticks.until(at_s - 0.01);
    ticks.fault(i % 2);
    ticks.until(at_s + 1.01);
    check_rows(recording(i).rows, at_s - 10.0, at_s + 1.0);
    ticks.reset();
  }
  LONGS_EQUAL(20, recordings());
}

TEST(FlightRecorder, FaultsOfSeveralChannelsShareARecordingWithoutExtendingIt) {
  ticks.until(19.99);
  ticks.fault(1);
  ticks.until(20.99);
  ticks.fault(0, Fault::emergency_stop);  // at the last tick that is recorded
  ticks.until(40.0);
  LONGS_EQUAL(1, recordings());
  const auto written = recording(1);
  check_rows(written.rows, 10.0, 21.0);
  LONGS_EQUAL(1, written.header.fault_channel);
  LONGS_EQUAL(63, (written.rows.end() - 2)->fault);
  LONGS_EQUAL(0, (written.rows.end() - 4)->fault);
}

TEST(FlightRecorder, AFaultInTheTickAfterARecordingStartsAnother) {
  ticks.until(19.99);
  ticks.fault(1);
  ticks.until(21.0);
  ticks.fault(0, Fault::emergency_stop);
  ticks.until(23.0);
  LONGS_EQUAL(2, recordings());
  check_rows(recording(1).rows, 10.0, 21.0);
  check_rows(recording(2).rows, 11.01, 22.01);
}

TEST(FlightRecorder, AFaultIsRecordedAgainOnlyAfterAReset) {
  ticks.fault(0);
  ticks.until(30.0);
  LONGS_EQUAL(1, recordings());
  ticks.reset();
  ticks.until(30.01);
  ticks.fault(0);
  ticks.until(40.0);
  LONGS_EQUAL(2, recordings());
}

TEST(FlightRecorder, AResetAndTripWithinATickIsANewFault) {
  ticks.fault(0);
  ticks.until(30.0);
  ticks.fault(0, Fault::heater_open);
  ticks.until(40.0);
  STRCMP_EQUAL("heater_open", recording(2).header.fault_name.c_str());
}

TEST(FlightRecorder, LostRowsAreAGapInTheTimes) {
  ticks.until(18.0);
  ticks.time_ns = 19 * second_ns;
  ticks.until(19.99);
  ticks.fault(0);
  ticks.until(22.0);
  const auto rows = recording(1).rows;
  LONGS_EQUAL(2 * (1101 - 99), rows.size());
  CHECK(rows.front().time_ns == 10 * second_ns);
  const std::size_t gap = 1600;  // after 8 s of two channels
  CHECK(rows[gap + 1].time_ns == 18 * second_ns);
  CHECK(rows[gap + 2].time_ns == 19 * second_ns);
}

TEST(FlightRecorder, RowsOfUnknownChannelsAreIgnored) {
  recorder.add(row(0, 2, Fault::over_travel));
  recorder.add(row(0, 255, Fault::over_travel));
  ticks.fault(0);
  ticks.until(2.0);
  check_rows(recording(1).rows, 0.0, 1.0);
}

TEST(FlightRecorder, PollWritesWhenTheLoopHasStalled) {
  ticks.until(19.99);
  ticks.fault(0);
  ticks.until(20.2);
  recorder.poll(std::chrono::milliseconds(22'000));
  LONGS_EQUAL_TEXT(0, recordings(), "rows may still be on their way");
  recorder.poll(std::chrono::milliseconds(22'001));
  check_rows(recording(1).rows, 10.0, 20.2);
  recorder.poll(std::chrono::seconds(60));
  LONGS_EQUAL(1, recordings());
}

TEST(FlightRecorder, FinishWritesARecordingBeforeItIsDue) {
  ticks.until(19.99);
  ticks.fault(0);
  ticks.until(20.2);
  recorder.finish();
  check_rows(recording(1).rows, 10.0, 20.2);
  ticks.until(30.0);
  LONGS_EQUAL(1, recordings());
}
