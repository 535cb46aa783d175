// What the declarations give besides parsing: --print-config and the README's table.
#include <sstream>

#include "config/binder.hpp"

namespace vpdr::config {
namespace {

std::vector<std::string> split(const std::string& key) {
  std::vector<std::string> parts;
  std::istringstream in(key);
  for (std::string part; std::getline(in, part, '.');) parts.push_back(part);
  return parts;
}

}  // namespace

std::string Binder::print_yaml() const {
  std::string out = root_ + ":\n";
  std::vector<std::string> open;
  for (const Entry& entry : entries_) {
    std::vector<std::string> parts = split(entry.key);
    const std::string leaf = parts.back();
    parts.pop_back();
    std::size_t shared = 0;
    while (shared < open.size() && shared < parts.size() && open[shared] == parts[shared]) ++shared;
    for (std::size_t i = shared; i < parts.size(); ++i) {
      out += std::string(2 * (i + 1), ' ') + parts[i] + ":\n";
    }
    open = parts;
    const std::string indent(2 * (parts.size() + 1), ' ');
    const std::string unit = entry.unit.empty() ? "" : " [" + entry.unit + "]";
    out += indent + leaf + ": " + entry.print() + "  # " + entry.help + unit + "; " + entry.range +
           "\n";
  }
  return out;
}

std::string Binder::markdown_table() const {
  std::string out = "| key | default | unit | allowed | meaning |\n|---|---|---|---|---|\n";
  for (const Entry& entry : entries_) {
    out += "| `" + root_ + "." + entry.key + "` | `" + entry.default_text + "` | " + entry.unit +
           " | " + entry.range + " | " + entry.help + " |\n";
  }
  return out;
}

}  // namespace vpdr::config
