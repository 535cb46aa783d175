#include "app/command_line.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <map>

namespace vpdr::app {
namespace {

/// What the flags gave, even where that is empty, before it is checked by the binder like any other
/// value.
struct Flags {
  std::string config;
  std::vector<std::string> sets;
  std::optional<std::string> walker;
  std::optional<std::string> domain;
  std::string interfaces;
  std::optional<std::string> log_level;
  std::string wait_for;
  bool until_end = false;
  bool print_config = false;
  bool print_table = false;
  std::map<std::string, std::string> shortcuts;  ///< key to value
  std::map<std::string, bool> switches;          ///< key to whether it was given
};

void declare(CLI::App& cli, const ServiceEntry& entry, Flags& flags) {
  for (const Shortcut& s : entry.shortcuts) {
    cli.add_option(s.option, flags.shortcuts[s.key], s.help);
  }
  for (const Shortcut& s : entry.flags) cli.add_flag(s.option, flags.switches[s.key], s.help);
  cli.add_option("--config", flags.config, "YAML file; without one the defaults hold");
  cli.add_option("--set", flags.sets, "key=value over the file; may stand several times");
  cli.add_option("--walker", flags.walker, "name of the walker (VPDR_WALKER)");
  cli.add_option("--domain", flags.domain, "DDS domain, 0 to 232 (VPDR_DOMAIN)");
  cli.add_option("--interfaces", flags.interfaces,
                 "comma-separated interfaces to use, as 127.0.0.1 (VPDR_INTERFACES)");
  cli.add_option("--log-level", flags.log_level, "debug, info, warn, error (VPDR_LOG_LEVEL)");
  cli.add_option("--wait-for", flags.wait_for,
                 "comma-separated services that must be there before the walk begins");
  cli.add_flag("--until-end", flags.until_end, "end when the walk has ended");
  cli.add_flag("--print-config", flags.print_config, "print every key with its value, and leave");
  cli.add_flag("--print-table", flags.print_table,
               "print every key as a Markdown table, and leave");
}

void apply(const Flags& flags, config::Binder& binder) {
  if (!flags.config.empty()) binder.load_file(flags.config);
  apply_environment(binder);
  for (const std::string& assignment : flags.sets) binder.assign(assignment);
  if (flags.walker) binder.assign("service.walker=" + *flags.walker);
  if (flags.domain) binder.assign("service.domain=" + *flags.domain);
  if (!flags.interfaces.empty()) binder.assign("service.interfaces=[" + flags.interfaces + "]");
  if (flags.log_level) binder.assign("service.log_level=" + *flags.log_level);
  if (!flags.wait_for.empty()) binder.assign("service.wait_for=[" + flags.wait_for + "]");
  if (flags.until_end) binder.assign("service.until_end=true");
  for (const auto& [key, value] : flags.shortcuts) {
    if (!value.empty()) binder.assign(key + "=" + value);
  }
  for (const auto& [key, given] : flags.switches) {
    if (given) binder.assign(key + "=true");
  }
}

}  // namespace

CommandLineOutcome read_command_line(const ServiceEntry& entry, CommonSettings& common, int argc,
                                     char** argv) {
  config::Binder binder(entry.name);
  if (entry.bind) entry.bind(binder);
  bind(binder, common);
  CLI::App cli(entry.summary, entry.name);
  Flags flags;
  declare(cli, entry, flags);
  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool help = cli.exit(error) == 0;
    return {.exit = help ? 0 : static_cast<int>(ExitCode::kUsage)};
  }
  apply(flags, binder);
  if (flags.print_config) std::cout << binder.print_yaml();
  if (flags.print_table) std::cout << binder.markdown_table();
  if (flags.print_config || flags.print_table) return {.exit = 0};
  return {};
}

}  // namespace vpdr::app
