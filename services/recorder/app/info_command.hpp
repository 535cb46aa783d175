#pragma once
// `recorder info FILE`.

namespace vpdr::recorder {

/// `argv[0]` is "info". Returns the exit code: 6 for a file that is no recording.
int run_info_command(int argc, char** argv);

}  // namespace vpdr::recorder
