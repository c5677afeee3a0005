#include "report/html_text.hpp"

#include <algorithm>

namespace supercoil::host_sim {

namespace {

constexpr std::string_view style = R"(<style>
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; overflow-wrap: anywhere; }
h1 { font-size: 1.7rem; } h2 { font-size: 1.25rem; margin-top: 2.5rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .88rem; width: 100%; }
th, td { text-align: left; padding: .25rem .6rem; border-bottom: 1px solid #8884; vertical-align: top; overflow-wrap: normal; }
td.n { font-variant-numeric: tabular-nums; white-space: nowrap; }
td.id, code, pre { font-family: ui-monospace, monospace; font-size: .8rem; }
td.id, td code { white-space: nowrap; }
pre { overflow-x: auto; }
figure { margin: 1.5rem 0; } figure img { width: 100%; height: auto; background: #fff; }
figure.wide img { min-width: 44rem; }
figcaption { font-size: .9rem; opacity: .8; }
</style>
)";

/// RFC 4648
std::string base64(std::string_view bytes) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      result += k <= count ? digits[group >> (18U - 6U * static_cast<unsigned>(k)) & 63U] : '=';
    }
  }
  return result;
}

bool is_control(char c) {
  return (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += is_control(c) ? std::string("\uFFFD") : std::string(1, c);
    }
  }
  return result;
}

std::string page_begin(std::string_view title) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
         escaped(title) + "</title>\n" + std::string(style) + "</head>\n<body>\n<main>\n";
}

std::string page_end() {
  return "</main>\n</body>\n</html>\n";
}

std::string embedded_svg(std::string_view svg, std::string_view alt) {
  return "<img alt=\"" + escaped(alt) + "\" src=\"data:image/svg+xml;base64," + base64(svg) +
         "\"/>";
}

}  // namespace supercoil::host_sim
