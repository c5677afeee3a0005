// A master that commands a node: makes frames and reads the answers.
#pragma once

#include <supercoil.h>

#include "support/packed.hpp"
#include "telemetry/commands.hpp"
#include "telemetry/opcodes.hpp"

namespace supercoil::test {

struct Master {
  can::Node node = 1;
  std::uint16_t session = 0;
  std::uint8_t counter = 0;
  std::uint16_t name = 0x1234;  ///< identifies the answer to its claim

  hal::CanFrame frame(std::uint8_t opcode, float value = 0.0F) {
    supercoil_command_t m{};
    m.counter = next_counter();
    m.opcode = opcode;
    m.session = session;
    m.value = value;
    return test::sealed(SUPERCOIL_COMMAND_FRAME_ID, SUPERCOIL_COMMAND_LENGTH, node, m,
                        supercoil_command_pack);
  }
  hal::CanFrame setting(std::uint8_t setting, float value) {
    supercoil_setting_write_t m{};
    m.counter = next_counter();
    m.setting = setting;
    m.session = session;
    m.value = value;
    return test::sealed(SUPERCOIL_SETTING_WRITE_FRAME_ID, SUPERCOIL_SETTING_WRITE_LENGTH, node, m,
                        supercoil_setting_write_pack);
  }
  std::uint8_t next_counter() {
    const std::uint8_t now = counter;
    counter = static_cast<std::uint8_t>((counter + 1) % can::e2e::counters);
    return now;
  }
  hal::CanFrame frame(Verb verb, float value = 0.0F) {
    return frame(static_cast<std::uint8_t>(verb), value);
  }
};

inline supercoil_acknowledge_t read_answer(const hal::CanFrame& frame) {
  supercoil_acknowledge_t m{};
  supercoil_acknowledge_unpack(&m, frame.data.data(), frame.length);
  return m;
}

inline supercoil_setting_t read_setting(const hal::CanFrame& frame) {
  supercoil_setting_t m{};
  supercoil_setting_unpack(&m, frame.data.data(), frame.length);
  return m;
}

inline supercoil_refused_value_t read_refused_value(const hal::CanFrame& frame) {
  supercoil_refused_value_t m{};
  supercoil_refused_value_unpack(&m, frame.data.data(), frame.length);
  return m;
}

}  // namespace supercoil::test
