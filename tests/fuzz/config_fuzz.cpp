// libFuzzer target: any text as a service's YAML file and as one --set. A mistake is a
// ConfigurationFault, and nothing else.
#include <cstddef>
#include <cstdint>
#include <string>

#include "config/binder.hpp"

namespace {

enum class Kind { kOne, kTwo };

struct Settings {
  double number = 1.0;
  int integer = 2;
  bool flag = false;
  std::string text = "text";
  std::vector<std::string> list;
  double three[3] = {1.0, 2.0, 3.0};
  Kind kind = Kind::kOne;
};

void bind(vpdr::config::Binder& binder, Settings& s) {
  binder.number("part.number", s.number, vpdr::config::above(0.0), "s", "a number");
  binder.integer("part.integer", s.integer, vpdr::config::between(0.0, 9.0), "", "an integer");
  binder.flag("flag", s.flag, "a flag");
  binder.text("text", s.text, "a text");
  binder.text_list("list", s.list, "a list");
  binder.numbers("three", s.three, 3, "m", "three numbers");
  binder.choice("kind", s.kind, {{"one", Kind::kOne}, {"two", Kind::kTwo}}, "a choice");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  Settings settings;
  vpdr::config::Binder binder("service");
  bind(binder, settings);
  try {
    binder.load_text(text, "service.yaml");
    // What was taken is printed so that it is taken again.
    Settings again;
    vpdr::config::Binder reader("service");
    bind(reader, again);
    reader.load_text(binder.print_yaml(), "printed.yaml");
  } catch (const vpdr::ConfigurationFault&) {
  }
  try {
    binder.assign(text);
  } catch (const vpdr::ConfigurationFault&) {
  }
  return 0;
}
