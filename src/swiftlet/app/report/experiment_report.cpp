// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/report/experiment_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "swiftlet/app/report/bench_report.hpp"
#include "swiftlet/file/text_output.hpp"

namespace swiftlet::app {
namespace {

using eval::Check;
using eval::ExperimentResult;
using eval::ExperimentRun;
using eval::Figure;
using eval::Machine;

/// Self-contained: no script, no font, no picture from elsewhere; light and dark, narrow and wide.
constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>Swiftlet</title>
<style>
:root { --paper: #fff; --ink: #1a1d21; --soft: #5b6470; --line: #d9dee4; --card: #f6f8fa;
  --good: #116329; --bad: #a40e26; }
@media (prefers-color-scheme: dark) { :root { --paper: #12161b; --ink: #e6e9ed; --soft: #9aa4b0;
  --line: #2d343c; --card: #1a2027; --good: #57c878; --bad: #ff8182; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 62rem; padding: 2rem 1.2rem 4rem; background: var(--paper);
  color: var(--ink); font: 16px/1.55 system-ui, sans-serif; }
h1 { font-size: 1.7rem; margin: 0; } h2 { font-size: 1.2rem; margin: 3rem 0 .2rem; }
p { margin: .3rem 0 1rem; color: var(--soft); }
.table { overflow-x: auto; } table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .45rem .9rem .45rem 0;
  border-bottom: 1px solid var(--line); } td.what { overflow-wrap: anywhere; }
th { font-weight: 600; color: var(--soft); font-size: .85rem; }
td.verdict { white-space: nowrap; font-weight: 600; }
.passed { color: var(--good); } .failed { color: var(--bad); }
figure { margin: 1.4rem 0 0; padding: .8rem; background: var(--card); border-radius: .5rem;
  border: 1px solid var(--line); }
figure svg { display: block; width: 100%; height: auto; border-radius: .3rem; }
figcaption { font-size: .85rem; color: var(--soft); margin-top: .4rem; }
a { color: inherit; }
@media (max-width: 34rem) { body { font-size: 15px; } figure { padding: .3rem; }
  tr:has(th) { display: none; } tr, td { display: block; } td { border: 0; padding: .1rem 0; }
  tr { border-bottom: 1px solid var(--line); padding: .5rem 0; } td:first-child { font-weight: 600; }
  td.expected::before { content: "expected: "; color: var(--soft); }
  td.got::before { content: "got: "; color: var(--soft); } }
</style></head><body>
)";

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '&')
      safe += "&amp;";
    else
      safe += c;
  }
  return safe;
}

std::string verdict(bool is_passed) {
  return is_passed ? R"(<td class="verdict passed">&#10003; passed</td>)"
                   : R"(<td class="verdict failed">&#10007; failed</td>)";
}

std::string overview(std::span<const ExperimentRun> runs, const std::string& column) {
  const bool is_timed =
      std::ranges::any_of(runs, [](const ExperimentRun& run) { return run.seconds > 0.0; });
  std::string html = fmt::format(
      R"(<div class="table"><table><tr><th>{}</th><th>what it shows</th><th></th><th>{}</th></tr>)",
      column, is_timed ? "took" : "");
  for (const ExperimentRun& run : runs) {
    const std::string took = is_timed ? fmt::format("{:.1f} s", run.seconds) : "";
    html += fmt::format(
        R"(<tr><td><a href="#{0}">{0}</a></td><td class="what">{1}</td>{2}<td class="verdict">{3}</td></tr>)",
        run.name, escaped(run.summary), verdict(run.result.is_passed()), took);
  }
  return html + "</table></div>\n";
}

std::string checks_table(const ExperimentResult& result) {
  std::string html =
      R"(<div class="table"><table><tr><th>result</th><th>expected</th><th>got</th><th></th></tr>)";
  for (const Check& check : result.checks) {
    html += fmt::format(
        R"(<tr><td>{}</td><td class="expected">{}</td><td class="got">{}</td>{}</tr>)",
        escaped(check.what), escaped(check.expected), escaped(check.got), verdict(check.is_passed));
  }
  return html + "</table></div>\n";
}

}  // namespace

Status write_report(std::span<const ExperimentRun> runs, const std::string& folder,
                    const ReportHead& head) {
  const auto passed =
      std::ranges::count_if(runs, [](const ExperimentRun& r) { return r.result.is_passed(); });
  const Machine machine = eval::this_machine();
  std::string html = kHead;
  html += fmt::format("<h1>{}</h1>\n<p>{} of {} {}; swiftlet {}, {}, {} cores</p>\n",
                      escaped(head.title), passed, runs.size(), escaped(head.verdict),
                      machine.swiftlet, escaped(machine.cpu), machine.cores);
  html += overview(runs, head.column);
  bool has_figures = true;
  for (const ExperimentRun& run : runs) {
    html += fmt::format("<h2 id=\"{0}\">{0}</h2>\n<p>{1}</p>\n", run.name, escaped(run.summary));
    html += checks_table(run.result);
    for (const Figure& figure : run.result.figures) {
      auto svg = draw_figure(figure, folder);
      if (!svg) return forward_error(std::move(svg));
      has_figures = has_figures && !svg->empty();
      html += fmt::format(
          "<figure>{}<figcaption>{} (numbers: {}.csv)</figcaption></figure>\n",
          svg->empty() ? "Not drawn: install gnuplot and run the experiment again." : *svg,
          escaped(figure.title), figure.name);
    }
  }
  html += "</body></html>\n";
  if (!has_figures)
    std::fputs("figures are not drawn: install gnuplot (Debian: gnuplot-nox)\n", stderr);
  return write_text(std::filesystem::path(folder) / "report.html", html);
}

nlohmann::ordered_json experiments_json(std::span<const ExperimentRun> runs) {
  auto all = nlohmann::ordered_json::array();
  for (const ExperimentRun& run : runs) {
    for (const Check& check : run.result.checks) {
      all.push_back({{"name", run.name + ": " + check.what},
                     {"passed", check.is_passed},
                     {"expected", check.expected},
                     {"got", check.got}});
    }
  }
  return {{"experiments", std::move(all)}};
}

}  // namespace swiftlet::app
