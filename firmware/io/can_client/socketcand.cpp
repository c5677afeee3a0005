#include "can_client/socketcand.hpp"

#include "can_client/text.hpp"

namespace supercoil::can_client {

namespace {

/// Longer than any element of the protocol.
constexpr std::size_t max_bytes = 256;

std::optional<std::uint16_t> standard_id(std::string_view word) {
  const auto id = number<std::uint32_t>(word, 16);
  if (!id || *id >= standard_ids || word.size() > digits_of_standard_id) return std::nullopt;
  return static_cast<std::uint16_t>(*id);
}

}  // namespace

void ElementReader::put(std::string_view bytes) {
  text_ += bytes;
}

std::optional<std::string> ElementReader::take() {
  for (;;) {
    if (!inside_) {
      const std::size_t begin = text_.find('<');
      text_.erase(0, begin == std::string::npos ? begin : begin + 1);
      if (begin == std::string::npos) return std::nullopt;
      inside_ = true;
    }
    const std::size_t end = text_.find('>');
    if (std::min(end, text_.size()) > max_bytes) {
      inside_ = false;
      continue;
    }
    if (end == std::string::npos) return std::nullopt;
    std::string element = text_.substr(0, end);
    text_.erase(0, end + 1);
    inside_ = false;
    const std::size_t first = std::min(element.find_first_not_of(' '), element.size());
    const std::size_t last = element.find_last_not_of(' ');
    return element.substr(first, last == std::string::npos ? 0 : last + 1 - first);
  }
}

std::string send_text(const hal::CanFrame& frame) {
  std::string text = "< send ";
  add_number<16>(text, frame.id, digits_of_standard_id);
  text += ' ';
  add_number<16>(text, frame.length, 1);
  for (std::size_t i = 0; i < frame.length; ++i) {
    text += ' ';
    add_number<16>(text, frame.data.at(i), 2);
  }
  return text + " >";
}

std::optional<hal::CanFrame> parse_send(std::string_view element) {
  if (next_word(element) != "send") return std::nullopt;
  const auto id = standard_id(next_word(element));
  const auto length = number<std::uint8_t>(next_word(element), 16);
  hal::CanFrame frame;
  if (!id || !length || *length > frame.data.size()) return std::nullopt;
  frame.id = *id;
  frame.length = *length;
  for (std::size_t i = 0; i < frame.length; ++i) {
    const auto byte = number<std::uint8_t>(next_word(element), 16);
    if (!byte) return std::nullopt;
    frame.data.at(i) = *byte;
  }
  if (!next_word(element).empty()) return std::nullopt;
  return frame;
}

std::string frame_text(const hal::CanFrame& frame, hal::Time at) {
  std::string text = "< frame ";
  add_number<16>(text, frame.id, digits_of_standard_id);
  text += ' ';
  add_time(text, at);
  text += ' ';
  add_bytes(text, frame);
  return text + " >";
}

std::optional<hal::CanFrame> parse_frame(std::string_view element) {
  if (next_word(element) != "frame") return std::nullopt;
  const auto id = standard_id(next_word(element));
  const auto time = parse_time(next_word(element));
  hal::CanFrame frame;
  // A frame without data has no third word.
  if (!id || !time || !parse_bytes(next_word(element), frame)) return std::nullopt;
  if (!next_word(element).empty()) return std::nullopt;
  frame.id = *id;
  frame.received = *time;
  return frame;
}

}  // namespace supercoil::can_client
