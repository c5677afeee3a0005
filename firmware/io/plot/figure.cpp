#include "plot/figure.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

namespace supercoil {

namespace {

/// Okabe and Ito's colours, which colour-blind readers can tell apart.
constexpr const char* line_styles = R"(
set linetype 1 lc rgb "#0072B2" lw 1.6
set linetype 2 lc rgb "#D55E00" lw 1.6
set linetype 3 lc rgb "#009E73" lw 1.6
set linetype 4 lc rgb "#CC79A7" lw 1.6
set linetype 5 lc rgb "#E69F00" lw 1.6
set linetype 6 lc rgb "#56B4E9" lw 1.6
set linetype 7 lc rgb "#444444" lw 1.2
)";

/// In single quotes: in double quotes, gnuplot runs text between backquotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    if (c != '\n') result += c;
  }
  return result + "'";
}

void write_data(std::ostream& out, const Figure& figure) {
  std::size_t block = 0;
  for (const Panel& panel : figure.panels) {
    for (const Curve& curve : panel.curves) {
      out << "$d" << block++ << " << EOD\n";
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        if (std::isfinite(curve.y[i])) {
          out << curve.x[i] << ' ' << curve.y[i];
          if (!curve.bars_to.empty()) out << ' ' << curve.y[i] << ' ' << curve.bars_to[i];
          out << '\n';
        } else {
          out << '\n';
        }
      }
      if (curve.x.empty()) out << "0 NaN\n";
      out << "EOD\n";
    }
  }
}

/// "name" 0, "name" 1, …
void write_names(std::ostream& out, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i)
    out << (i > 0 ? ", " : "(") << quoted(names[i]) << " " << i;
  out << ")\n";
}

/// Numbers along x, or names.
void write_x_tics(std::ostream& out, const Panel& panel) {
  if (panel.x_names.empty()) {
    if (panel.x_low < panel.x_high) {
      out << "set xrange [" << panel.x_low << ":" << panel.x_high << "]\n";
    } else {
      out << "set xrange [*:*]\nset autoscale xfix\n";  // drops the range of the panel before
    }
    out << "set xtics norotate autofreq\n";
    return;
  }
  out << "set logscale y\nset xrange [-0.7:" << static_cast<double>(panel.x_names.size()) - 0.3
      << "]\nset xtics rotate by 30 right ";
  write_names(out, panel.x_names);
}

bool has_data(const Panel& panel) {
  for (const Curve& curve : panel.curves) {
    if (std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); }))
      return true;
  }
  return false;
}

void write_y_range(std::ostream& out, const Panel& panel) {
  out << "unset label\nset ytics ";
  if (panel.y_names.empty()) {
    out << "autofreq\n";
  } else {
    write_names(out, panel.y_names);
  }
  if (panel.y_low < panel.y_high) {
    out << "set yrange [" << panel.y_low << ":" << panel.y_high << "]\n";
  } else if (has_data(panel)) {
    out << "set autoscale y\n";
  } else {
    // If gnuplot cannot choose a panel's range, it abandons the whole figure.
    out << "set yrange [1:10]\nset label 'no value to draw' at graph 0.5,0.5 center\n";
  }
}

const char* style_of(const Curve& curve) {
  if (!curve.bars_to.empty()) return " with yerrorbars pt 7 ps 0.5 lt ";
  return curve.points ? " with points pt 7 ps 0.3 lt " : " with lines lt ";
}

void write_panel(std::ostream& out, const Panel& panel, std::size_t& block) {
  out << "set title " << quoted(panel.title) << "\n"
      << "set xlabel " << quoted(panel.x_label) << " offset 0,0.8\n"
      << "set ylabel " << quoted(panel.y_label) << "\n"
      << "set format y '%g'\n"
      << (panel.x_logarithmic ? "set" : "unset") << " logscale x\n"
      << (panel.y_logarithmic ? "set" : "unset") << " logscale y\n";
  write_x_tics(out, panel);
  write_y_range(out, panel);
  out << "plot ";
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const Curve& curve = panel.curves[i];
    out << (i > 0 ? ", " : "") << "$d" << block++ << style_of(curve) << curve.colour + 1
        << (curve.dashed ? " dt 2" : "") << " title " << quoted(curve.label);
  }
  out << "\n";
}

/// When the disk is full, gnuplot reports no error and exits with status 0.
bool complete(const std::filesystem::path& svg) {
  constexpr std::string_view end = "</svg>";
  std::ifstream in(svg, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return text.find(end, text.size() - std::min(text.size(), 2 * end.size())) != std::string::npos;
}

}  // namespace

std::string gnuplot_script(const Figure& figure, const std::filesystem::path& svg) {
  const auto count = static_cast<int>(figure.panels.size());
  const int rows = (count + figure.columns - 1) / figure.columns;
  std::ostringstream out;
  out.precision(6);
  write_data(out, figure);
  out << "set terminal svg size " << figure.width_px << "," << rows * figure.panel_height_px
      << " noenhanced font 'sans-serif,12' background '#ffffff'\n"
      << "set output " << quoted(svg.string()) << "\n"
      << line_styles
      << "set grid lc rgb '#dddddd'\nset border 3 lc rgb '#888888'\nset tics nomirror\n"
      << "set key bmargin center horizontal samplen 2\n"
      << "set lmargin 12\nset rmargin 5\n"
      << "set multiplot layout " << rows << "," << figure.columns << "\n";
  std::size_t block = 0;
  for (const Panel& panel : figure.panels)
    write_panel(out, panel, block);
  out << "unset multiplot\nunset output\n";
  return out.str();
}

Result<void> draw(const Figure& figure, const std::filesystem::path& svg) {
  const std::filesystem::path script = svg.string() + ".gnuplot";
  const std::filesystem::path log = svg.string() + ".log";
  std::error_code ignored;
  std::ofstream out(script);
  if (!out) return failed_call(script.string() + ": cannot be written", errno);
  out << gnuplot_script(figure, svg);
  out.close();
  if (!out) {
    std::filesystem::remove(script, ignored);
    return failure(script.string() + ": cannot be written: is the disk full?");
  }
  // The paths are passed through the environment, so that the shell does not interpret them.
  constexpr const char* command = R"(gnuplot "$SUPERCOIL_PLOT" 2>"$SUPERCOIL_PLOT_LOG")";
  setenv("SUPERCOIL_PLOT", script.c_str(), 1);
  setenv("SUPERCOIL_PLOT_LOG", log.c_str(), 1);
  const int status = std::system(command);  // NOLINT(cert-env33-c)
  std::ifstream log_lines(log);
  std::string complaint;
  for (std::string line; std::getline(log_lines, line);) {
    if (!line.empty() && line.find("arning:") == std::string::npos) complaint = line;
  }
  std::filesystem::remove(script, ignored);
  std::filesystem::remove(log, ignored);
  if (status == 0 && complete(svg)) return {};
  if (status == 0)
    return failure(svg.string() + ": gnuplot could not write all of it: is the disk full?");
  constexpr int not_found = 127 << 8;
  if (status == not_found) {
    return failure(std::string("gnuplot is not installed (Debian: apt install gnuplot-nox)"));
  }
  return failure("gnuplot failed: " + complaint);
}

}  // namespace supercoil
