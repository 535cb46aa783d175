#include "recorder/app/info_command.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

#include "core/errors.hpp"
#include "recorder/app/recording_info.hpp"

namespace vpdr::recorder {

int run_info_command(int argc, char** argv) {
  CLI::App cli("Tells what a recording holds, and whether it is whole.", "recorder info");
  std::string file;
  bool json = false;
  cli.add_option("file", file, "recording (.mcap)")->required();
  cli.add_flag("--json", json, "as one JSON object");
  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return cli.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  try {
    const RecordingInfo info = inspect(file);
    std::cout << (json ? to_json(info) : to_text(info));
    return 0;
  } catch (const Fault& fault) {
    std::cerr << "recorder: " << fault.what() << "\n";
    return static_cast<int>(fault.code());
  } catch (const std::exception& error) {
    std::cerr << "recorder: internal error, please report: " << error.what() << "\n";
    return static_cast<int>(ExitCode::kInternal);
  }
}

}  // namespace vpdr::recorder
