// vpdr: the command people type. Faults end here: one line on standard error, their exit code.
#include <exception>
#include <iostream>

#include "core/errors.hpp"
#include "vpdr/commands/commands.hpp"

int main(int argc, char** argv) {
  try {
    return vpdr::tool::run_command_line(argc, argv);
  } catch (const vpdr::Fault& fault) {
    std::cerr << "vpdr: " << fault.what() << "\n";
    return static_cast<int>(fault.code());
  } catch (const std::exception& error) {
    std::cerr << "vpdr: internal error, please report: " << error.what() << "\n";
    return static_cast<int>(vpdr::ExitCode::kInternal);
  }
}
