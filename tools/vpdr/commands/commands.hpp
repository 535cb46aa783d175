#pragma once
// The subcommands of vpdr, one file each. add_X() declares X's options; what it does runs as the
// subcommand's callback and throws vpdr::Fault.
namespace CLI {
class App;
}

namespace vpdr::tool {

void add_run(CLI::App& app);
void add_simulate(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_report(CLI::App& app);
void add_up(CLI::App& app);
void add_listen(CLI::App& app);
void add_vanishing_points(CLI::App& app);
void add_calibrate(CLI::App& app);
void add_monitor(CLI::App& app);

// The subcommands of `vpdr calibrate` and `vpdr monitor`.
void add_calibrate_camera(CLI::App& calibrate);
void add_calibrate_imu(CLI::App& calibrate);
void add_calibrate_mag(CLI::App& calibrate);
void add_calibrate_mount(CLI::App& calibrate);
void add_monitor_imu(CLI::App& monitor);

/// Parses and runs one subcommand; returns the exit code. Usage errors are printed with their
/// remedy and give ExitCode::kUsage; faults are thrown.
int run_command_line(int argc, char** argv);

}  // namespace vpdr::tool
