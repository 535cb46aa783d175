// reference.json of Mobilise-D recordings, as mobgap ships them: for each reference system a list
// of walking bouts ("MicroWB", a single one not in a list) with InitialContact_Event [s],
// Step_Length [m] (optical only) and Stride_Length [m]; stride k goes from contact k to contact k
// + 2.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "dataset/text_file.hpp"
#include "dataset/truth_tables.hpp"

namespace vpdr::dataset {
namespace {

using Json = nlohmann::json;

/// Python writes NaN, which JSON does not know; null stands for it here.
std::string without_nan_literals(std::string text) {
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"' && (i == 0 || text[i - 1] != '\\')) in_string = !in_string;
    if (in_string) continue;
    if (text.compare(i, 3, "NaN") == 0) text.replace(i, 3, "null");
  }
  return text;
}

double number_or_nan(const Json& values, std::size_t i) {
  if (!values.is_array() || i >= values.size() || !values[i].is_number()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return values[i].get<double>();
}

std::vector<Json> bouts_of(const Json& root, const char* system) {
  const Json bouts = root.value(system, Json::object()).value("MicroWB", Json::array());
  if (bouts.is_array()) return bouts.get<std::vector<Json>>();
  return {bouts};
}

void add_bout(const Json& bout, TimestampNs start_ns, Truth& truth) {
  const auto instant = [start_ns](double s) { return start_ns + to_ns(s); };
  const Json contacts = bout.value("InitialContact_Event", Json::array());
  const Json steps = bout.value("Step_Length", Json::array());
  const Json strides = bout.value("Stride_Length", Json::array());
  truth.walking_bouts->push_back(
      {instant(bout.at("Start").get<double>()), instant(bout.at("End").get<double>())});
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double contact_s = number_or_nan(contacts, i);
    if (!std::isfinite(contact_s)) continue;
    const double length_m =
        i > 0 ? number_or_nan(steps, i - 1) : std::numeric_limits<double>::quiet_NaN();
    truth.steps.push_back({instant(contact_s), length_m});
  }
  for (std::size_t i = 0; i + 2 < contacts.size(); ++i) {
    const double begin_s = number_or_nan(contacts, i);
    const double end_s = number_or_nan(contacts, i + 2);
    const double length_m = number_or_nan(strides, i);
    if (!std::isfinite(begin_s + end_s + length_m)) continue;
    truth.strides.push_back({instant(begin_s), instant(end_s), length_m});
  }
}

}  // namespace

void read_step_reference(const std::filesystem::path& file, TimestampNs start_ns, Truth& truth,
                         ReadReport& report) {
  try {
    const Json root = Json::parse(without_nan_literals(read_text_file(file).text));
    truth.walking_bouts.emplace();
    for (const char* system : {"Stereophoto", "INDIP"}) {
      const std::vector<Json> bouts = bouts_of(root, system);
      if (bouts.empty()) continue;
      for (const Json& bout : bouts) add_bout(bout, start_ns, truth);
      report.notes.push_back(file.string() + ": true steps are those of " + system +
                             ", inside its " + std::to_string(bouts.size()) + " walking bouts");
      return;
    }
    report.notes.push_back(file.string() + ": no reference system saw a walking bout");
    truth.walking_bouts.reset();
  } catch (const Json::exception& error) {
    throw fault_at(file, 0, 0, error.what(), "expected Mobilise-D's reference.json");
  }
}

}  // namespace vpdr::dataset
