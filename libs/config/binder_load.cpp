// Reading YAML into the bound fields. yaml-cpp keeps duplicate keys and NaN in silence, so every
// node is walked here by hand.
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <set>
#include <sstream>

#include "config/binder.hpp"

namespace vpdr::config {
namespace {

/// Listens to nothing: only the number of documents counts.
struct Deaf : YAML::EventHandler {
  using Mark = YAML::Mark;
  using Anchor = YAML::anchor_t;
  using Style = YAML::EmitterStyle::value;
  void OnDocumentStart(const Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const Mark&, Anchor) override {}
  void OnAlias(const Mark&, Anchor) override {}
  void OnScalar(const Mark&, const std::string&, Anchor, const std::string&) override {}
  void OnSequenceStart(const Mark&, const std::string&, Anchor, Style) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const Mark&, const std::string&, Anchor, Style) override {}
  void OnMapEnd() override {}
};

/// YAML::LoadAll would go on for ever where a text begins with a comma: each try to read it is one
/// more empty document.
bool has_several_documents(const std::string& yaml) {
  std::istringstream in(yaml);
  YAML::Parser parser(in);
  Deaf deaf;
  return parser.HandleNextDocument(deaf) && parser.HandleNextDocument(deaf);
}

}  // namespace

/// Walks one document and gathers its mistakes; fields are stored as they are found valid.
class Binder::Loader {
 public:
  Loader(Binder& binder, std::string origin) : binder_(binder), origin_(std::move(origin)) {}

  void load(const std::string& yaml) {
    try {
      if (has_several_documents(yaml)) mistakes_.push_back(origin_ + ": must hold one document");
      const YAML::Node document = YAML::Load(yaml);
      if (!document.IsNull()) visit_root(document);
    } catch (const YAML::ParserException& e) {
      mistakes_.push_back(place(e.mark) + ": not valid YAML: " + e.msg);
    }
    if (mistakes_.empty()) return;
    std::string all;
    for (const std::string& mistake : mistakes_) all += (all.empty() ? "" : "\n") + mistake;
    throw ConfigurationFault(all);
  }

 private:
  std::string place(const YAML::Mark& mark) const {
    return origin_ + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
  }

  void report(const YAML::Mark& mark, const std::string& key, const std::string& what) {
    mistakes_.push_back(place(mark) + ": " + key + ": " + what);
  }

  void visit_root(const YAML::Node& document) {
    if (!document.IsMap()) {
      report(document.Mark(), binder_.root_, "must be a map with the one key " + binder_.root_);
      return;
    }
    std::set<std::string> seen;
    for (const auto& pair : document) {
      const std::string name = pair.first.Scalar();
      if (name != binder_.root_) {
        report(pair.first.Mark(), name, "unknown key; the file's one key is " + binder_.root_);
      } else if (!seen.insert(name).second) {
        report(pair.first.Mark(), name, "stands twice");
      } else {
        visit(pair.second, "");
      }
    }
  }

  void visit(const YAML::Node& node, const std::string& section) {
    const std::string full = section.empty() ? binder_.root_ : binder_.root_ + "." + section;
    if (node.IsNull()) return;
    if (!node.IsMap()) {
      report(node.Mark(), full, "is a section, so it must be a map");
      return;
    }
    std::set<std::string> seen;
    for (const auto& pair : node) {
      const std::string key =
          section.empty() ? pair.first.Scalar() : section + "." + pair.first.Scalar();
      const std::string full_key = binder_.root_ + "." + key;
      if (!seen.insert(key).second) {
        report(pair.first.Mark(), full_key, "stands twice; keep one");
      } else if (const Entry* entry = binder_.find(key)) {
        visit_value(*entry, pair.second, full_key);
      } else if (binder_.is_section(key)) {
        visit(pair.second, key);
      } else {
        report(pair.first.Mark(), full_key, "unknown key" + binder_.nearest_hint(key));
      }
    }
  }

  void visit_value(const Entry& entry, const YAML::Node& value, const std::string& full_key) {
    Given given;
    given.is_sequence = value.IsSequence();
    if (value.IsScalar()) given.items.push_back(value.Scalar());
    if (given.is_sequence) {
      for (const auto& item : value) {
        if (!item.IsScalar()) {
          report(item.Mark(), full_key, "must be a flat list");
          return;
        }
        given.items.push_back(item.Scalar());
      }
    }
    if (!value.IsScalar() && !given.is_sequence) {
      report(value.Mark(), full_key, value.IsMap() ? "is a key, not a section" : "has no value");
      return;
    }
    if (const auto what = entry.store(given)) report(value.Mark(), full_key, *what);
  }

  Binder& binder_;
  std::string origin_;
  std::vector<std::string> mistakes_;
};

void Binder::load_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  if (!in || std::filesystem::is_directory(file)) {
    throw ConfigurationFault(file.string() + ": cannot be read; check the path given to --config");
  }
  load_text(content, file.string());
}

void Binder::load_text(const std::string& yaml, const std::string& origin) {
  Loader(*this, origin).load(yaml);
}

void Binder::assign(const std::string& assignment) {
  const std::string origin = "--set " + assignment;
  const auto equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw ConfigurationFault(origin + ": must be key=value");
  }
  std::string key = assignment.substr(0, equals);
  if (key.starts_with(root_ + ".")) key = key.substr(root_.size() + 1);
  const Entry* entry = find(key);
  if (entry == nullptr) {
    throw ConfigurationFault(origin + ": " + root_ + "." + key + ": unknown key" +
                             nearest_hint(key));
  }
  Given given;
  try {
    const YAML::Node value = YAML::Load(assignment.substr(equals + 1));
    given.is_sequence = value.IsSequence();
    if (given.is_sequence) given.items = value.as<std::vector<std::string>>();
    if (!given.is_sequence) given.items.push_back(value.IsScalar() ? value.Scalar() : "");
  } catch (const YAML::Exception& e) {
    throw ConfigurationFault(origin + ": not a valid value: " + e.msg);
  }
  if (const auto what = entry->store(given)) {
    throw ConfigurationFault(origin + ": " + root_ + "." + key + ": " + *what);
  }
}

}  // namespace vpdr::config
