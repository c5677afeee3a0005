#include "report/reproduction_table.hpp"

#include <algorithm>

namespace supercoil::host_sim {

namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text)
    result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

/// Characters, not bytes: the table holds Greek letters.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string padded(const std::string& text, std::size_t columns) {
  const std::size_t used = width(text);
  return text + std::string(columns > used ? columns - used : 1, ' ');
}

}  // namespace

std::string to_csv(const std::vector<paper::Part>& parts) {
  std::string csv = "id,case,quantity,unit,paper,measured,remark\n";
  for (const paper::Part& part : parts) {
    for (const paper::ReproductionRow& r : part.rows) {
      for (const std::string* field :
           {&r.id, &r.case_name, &r.quantity, &r.unit, &r.paper, &r.measured}) {
        csv += csv_field(*field) + ",";
      }
      csv += csv_field(r.remark) + "\n";
    }
  }
  return csv;
}

std::string to_terminal(const std::vector<paper::Part>& parts) {
  std::string text;
  for (const paper::Part& part : parts) {
    text += "\n" + part.title + "\n";
    text += padded("  id", 36) + padded("case", 22) + padded("paper", 17) + padded("ours", 22) +
            "unit\n";
    for (const paper::ReproductionRow& r : part.rows) {
      text += padded("  " + r.id, 36) + padded(r.case_name, 22) + padded(r.paper, 17) +
              padded(r.measured, 22) + r.unit + "\n";
    }
  }
  return text;
}

}  // namespace supercoil::host_sim
