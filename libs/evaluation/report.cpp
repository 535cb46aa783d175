#include "evaluation/report.hpp"

#include "evaluation/evaluation.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/headline.hpp"
#include "evaluation/output_file.hpp"
#include "evaluation/plot.hpp"
#include "evaluation/report_scene.hpp"
#include "evaluation/report_style.hpp"

namespace vpdr::evaluation {
namespace {

std::string cell(const std::string& text) { return "<td>" + escaped(text) + "</td>"; }
std::string number_cell(const std::string& text) {
  return "<td class=\"n\">" + escaped(text) + "</td>";
}
std::string number_cell(std::uint64_t value) { return number_cell(std::to_string(value)); }

std::string section(const std::string& title, const std::string& caption,
                    const std::string& content) {
  std::string html = "<section>\n<h2>" + escaped(title) + "</h2>\n";
  if (!caption.empty()) html += "<p>" + escaped(caption) + "</p>\n";
  return html + content + "</section>\n";
}

std::string figure_section(const std::string& title, const std::string& caption,
                           const std::optional<Svg>& figure) {
  if (!figure) return {};
  return section(title, caption, "<div class=\"scroll\">" + figure->inline_element() + "</div>\n");
}

std::string header(const std::string& name, const RunInfo& info, const Summary& summary) {
  const std::string title = info.title.empty() ? "vpdr" : info.title;
  return "<header>\n<h1>" + escaped(name) + "</h1>\n<p>" + escaped(title) + " \u00b7 " +
         fixed_number(summary.duration_s, 1) + " s of sensor time</p>\n</header>\n";
}

std::string headline_cards(const std::vector<Headline>& list) {
  std::string html = "<div class=\"figures\">\n";
  for (const Headline& figure : list) {
    html += "<div class=\"figure\"><div class=\"name\">" + escaped(figure.name) +
            "</div><div class=\"value\">" + escaped(figure.value);
    if (!figure.unit.empty()) html += "<small>" + escaped(figure.unit) + "</small>";
    html += "</div><div class=\"more\">" + escaped(figure.more) + "</div></div>\n";
  }
  return html + "</div>\n";
}

std::string latency_section(const RunInfo& info) {
  if (info.latencies.empty()) return {};
  std::string html =
      "<div class=\"scroll\"><table>\n<tr><th>path</th><th class=\"n\">samples</th>"
      "<th class=\"n\">lost</th><th class=\"n\">p50</th><th class=\"n\">p99</th>"
      "<th class=\"n\">p99.9</th><th class=\"n\">largest</th></tr>\n";
  for (const LatencyReport& latency : info.latencies) {
    html += "<tr>" + cell(latency.name) + number_cell(latency.count) + number_cell(latency.lost);
    for (const double us : {latency.p50_us, latency.p99_us, latency.p999_us, latency.max_us}) {
      html += number_cell(duration_label(us));
    }
    html += "</tr>\n";
  }
  html += "</table></div>\n";
  if (const auto figure = latency_figure(info.latencies.front())) {
    html += "<div class=\"scroll\">" + figure->inline_element() + "</div>\n";
  }
  return section("Latency", "Histogram: " + info.latencies.front().name + ".", html);
}

std::string topic_section(const RunInfo& info) {
  if (info.topics.empty()) return {};
  std::string html =
      "<div class=\"scroll\"><table>\n<tr><th>topic</th><th>type</th><th class=\"n\">received</th>"
      "<th class=\"n\">lost</th><th class=\"n\">written</th></tr>\n";
  for (const TopicCount& topic : info.topics) {
    html += "<tr>" + cell(topic.topic) + cell(topic.type) + number_cell(topic.received) +
            number_cell(topic.lost) + number_cell(topic.written) + "</tr>\n";
  }
  return section("Topics", "What the recorder received, lost and wrote.",
                 html + "</table></div>\n");
}

std::string service_section(const RunInfo& info) {
  if (info.services.empty()) return {};
  std::string html =
      "<div class=\"scroll\"><table>\n<tr><th>service</th><th>version</th><th>last state</th>"
      "</tr>\n";
  for (const ServiceInfo& service : info.services) {
    html += "<tr>" + cell(service.name) + cell(service.version) + cell(service.state) + "</tr>\n";
  }
  html += "</table></div>\n";
  for (const ServiceInfo& service : info.services) {
    if (service.config.empty()) continue;
    html += "<details><summary>configuration of " + escaped(service.name) + "</summary><pre>" +
            escaped(service.config) + "</pre></details>\n";
  }
  return section("Services", "", html);
}

std::string note_section(const dataset::Recording* recording) {
  if (recording == nullptr) return {};
  std::string items;
  for (const std::string& line : recording->report.lines()) {
    items += "<li>" + escaped(line) + "</li>\n";
  }
  if (items.empty()) return {};
  return section("Notes on the recording", "", "<ul>\n" + items + "</ul>\n");
}

constexpr const char* kFooter =
    "<footer>Position errors are horizontal, from the true start, unless said otherwise. ATE: root "
    "mean square after the best rotation about the vertical and the best translation. RPE: "
    "displacement error over segments of the path, in percent of their length. Attitude RMSE: as "
    "the BROAD benchmark defines it. World axes: x east, y north; yaw 0 is east, "
    "counter-clockwise.</footer>\n";

std::string error_caption(const ReportScene& scene) {
  const std::string where =
      scene.truth.size() >= 2 ? "Horizontal distance to the truth." : "Distance at each waypoint.";
  return where + " " + scene.alignment;
}

std::string figure_sections(const ReportScene& scene) {
  std::string html = figure_section("Map", scene.alignment, map_figure(scene));
  if (html.empty()) {
    html = section("Map", "The run has no trajectory: nothing to draw.", "");
  }
  html += figure_section("Position error", error_caption(scene), error_figure(scene));
  html += figure_section("Heading", "Yaw of the body; 0 is east, 90 north.", heading_figure(scene));
  html += figure_section("Steps", "Cadence and length of each step.", step_figure(scene));
  return html;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.close();
}

std::string name_of(const RunDirectory& run, const dataset::Recording* recording) {
  if (recording != nullptr) return recording->name;
  const std::string named = run.info.recording.filename().string();
  return named.empty() ? run.folder.filename().string() : named;
}

Evaluation evaluation_of(const RunDirectory& run, const dataset::Recording* recording) {
  if (recording != nullptr) return evaluate(run, *recording);
  Evaluation evaluation;
  evaluation.summary = run.summary;
  return evaluation;
}

}  // namespace

std::string report_html(const RunDirectory& run, const dataset::Recording* recording) {
  const std::string name = name_of(run, recording);
  const ReportScene scene = make_scene(run, recording);
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>";
  html += escaped(name) + " \u00b7 vpdr report</title>\n<style>";
  html += kFigureStyle;
  html += kPageStyle;
  html += "</style>\n</head>\n<body>\n<main>\n";
  html += header(name, run.info, run.summary);
  html += headline_cards(headlines(evaluation_of(run, recording), run.info));
  html += figure_sections(scene);
  html += latency_section(run.info) + topic_section(run.info) + service_section(run.info);
  html += note_section(recording);
  html += kFooter;
  return html + "</main>\n</body>\n</html>\n";
}

void write_report(const RunDirectory& run, const dataset::Recording* recording) {
  const ReportScene scene = make_scene(run, recording);
  const auto map = map_figure(scene);
  const Svg empty(kFigureWidth, 60.0, "No trajectory");
  write_text(run.folder / "trajectory.svg", (map ? *map : empty).document(kFigureStyle));
  write_text(run.folder / "report.html", report_html(run, recording));
}

void write_report(const std::filesystem::path& folder) {
  const RunDirectory run = RunDirectory::read(folder);
  if (run.info.recording.empty() || !std::filesystem::is_directory(run.info.recording)) {
    write_report(run, nullptr);
    return;
  }
  const dataset::Recording recording = dataset::read_recording(run.info.recording);
  write_report(run, &recording);
}

}  // namespace vpdr::evaluation
