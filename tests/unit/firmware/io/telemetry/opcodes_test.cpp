#include "telemetry/opcodes.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using namespace supercoil::telemetry;

TEST_GROUP(Opcodes){};

TEST(Opcodes, EveryCommandRoundTrips) {
  for (std::size_t i = 1; i < plain_verb_names.size(); ++i) {
    const auto verb = static_cast<Verb>(i);
    const EncodedCommand on_the_wire = encode_command(verb, 0.25);
    CHECK(on_the_wire.opcode < Opcode::claim_of_version_3);
    CHECK(decode_command(on_the_wire.opcode, on_the_wire.value).verb == verb);
    DOUBLES_EQUAL(0.25, decode_command(on_the_wire.opcode, on_the_wire.value).value, 0.0);
  }
}

TEST(Opcodes, HaveTheNamesOfTheProtocol) {
  constexpr auto names = opcode_names();
  CHECK(names[Opcode::compare] == "compare");
  CHECK(names[static_cast<std::size_t>(Verb::store)] == "store");
  CHECK(names[Opcode::claim_of_version_3] == "claim_of_version_3");
  CHECK(names[Opcode::lease] == "lease");
}

TEST(Opcodes, AReadingWithTheWrongSignIsInvalid) {
  for (const Verb verb : {Verb::compare_supply, Verb::compare_current, Verb::compare_rise})
    CHECK(std::isnan(encode_command(verb, -0.25).value));
  // A current of 0 A does not forget the comparison, but 0 V does.
  CHECK(std::isnan(encode_command(Verb::compare_current, 0.0).value));
  DOUBLES_EQUAL(0.0, encode_command(Verb::compare_supply, 0.0).value, 0.0);
  // Volts are never taken for a rise.
  CHECK(std::isnan(encode_command(Verb::compare_supply, 1000.0).value));
  CHECK(decode_command(Opcode::compare, 1037.5).verb == Verb::compare_rise);
  DOUBLES_EQUAL(37.5, decode_command(Opcode::compare, 1037.5).value, 0.0);
}
