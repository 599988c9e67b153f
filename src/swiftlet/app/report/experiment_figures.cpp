// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "swiftlet/app/report/experiment_report.hpp"
#include "swiftlet/file/text_output.hpp"

namespace swiftlet::app {
namespace {

using eval::Curve;
using eval::Figure;

namespace fs = std::filesystem;

/// Lines that can be told apart on white and on black (Okabe and Ito 2008, without the black).
constexpr std::array kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

std::string csv_of(const Figure& figure) {
  std::string csv;
  if (figure.voxels.empty()) {
    csv = fmt::format("curve,{},{}\n", figure.x_label, figure.y_label);
    for (const Curve& curve : figure.curves) {
      for (const auto& [x, y] : curve.points) csv += fmt::format("{},{},{}\n", curve.name, x, y);
    }
    return csv;
  }
  csv = fmt::format("{},{},belief\n", figure.x_label, figure.y_label);
  for (std::size_t j = 0; j < figure.voxels.size(); ++j) {
    for (std::size_t i = 0; i < figure.voxels[j].size(); ++i)
      csv += fmt::format("{:.3f},{:.3f},{}\n", figure.x0 + figure.voxel * static_cast<double>(i),
                         figure.y0 + figure.voxel * static_cast<double>(j), figure.voxels[j][i]);
  }
  return csv;
}

std::string plots_of(const Figure& figure, std::string& data) {
  if (!figure.voxels.empty()) {
    for (const auto& row : figure.voxels) data += fmt::format("{}\n", fmt::join(row, " "));
    return fmt::format(
        "set size ratio -1\nset cbrange [0:255]\nset cblabel 'belief'\n"
        "set palette defined (0 '#f0e442', 127 '#ffffff', 180 '#56b4e9', 255 '#0072b2')\n"
        "plot $data matrix using ({}+$1*{}):({}+$2*{}):3 with image pixels notitle\n",
        figure.x0, figure.voxel, figure.y0, figure.voxel);
  }
  std::string plots;
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    const Curve& curve = figure.curves[i];
    for (const auto& [x, y] : curve.points) data += fmt::format("{} {}\n", x, y);
    data += "\n\n";
    plots +=
        fmt::format("{} $data index {} with {} lw 2 lc rgb '{}' title '{}'", i == 0 ? "plot" : ",",
                    i, curve.is_measured ? "points pt 7 ps 0.9" : "lines",
                    kColours[i % kColours.size()], curve.name);
  }
  return plots + "\n";
}

/// The SVG, and the same as PNG where this gnuplot can.
std::string script_of(const Figure& figure, const std::string& base) {
  std::string data;
  const std::string plots = plots_of(figure, data);
  return fmt::format(
      "set terminal svg size 720,440 dynamic font 'sans-serif,13' background rgb 'white'\n"
      "set output '{0}.svg'\nset title '{1}'\nset xlabel '{2}'\nset ylabel '{3}'\nset grid lc rgb "
      "'#a0a0a0'\nset key outside bottom center horizontal\nset bmargin 5.5\nset border 3\nset "
      "tics nomirror\n"
      "$data << END_OF_DATA\n{4}END_OF_DATA\n{5}"
      "if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {{\n"
      "set terminal pngcairo size 1440,880 fontscale 1.9 linewidth 1.6 background rgb 'white'\n"
      "set output '{0}.png'\nreplot\n}}\n",
      base, figure.title, figure.x_label, figure.y_label, data, plots);
}

/// Runs gnuplot on a script; false if there is none or it fails.
bool plot(const std::string& script) {
  std::string program = "gnuplot";
  std::string argument = script;
  char* const arguments[]{program.data(), argument.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, "gnuplot", nullptr, nullptr, arguments, environ) != 0) return false;
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

Expected<std::string> draw_figure(const Figure& figure, const std::string& folder) {
  const fs::path base = fs::path(folder) / figure.name;
  if (auto written = write_text(base.string() + ".csv", csv_of(figure)); !written)
    return forward_error(std::move(written));
  const std::string svg = base.string() + ".svg", script = base.string() + ".gp";
  if (auto written = write_text(script, script_of(figure, base.string())); !written)
    return forward_error(std::move(written));
  if (!plot(script)) return std::string{};
  std::ifstream file(svg, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  std::string drawn = std::move(text).str();
  const auto start = drawn.find("<svg");
  if (start == std::string::npos) return std::string{};
  drawn.erase(0, start);
  return drawn;
}

}  // namespace swiftlet::app
