#include "vpdr/run_recording_of.hpp"

#include "core/errors.hpp"

namespace vpdr::tool {

dataset::Recording recording_of(const evaluation::RunDirectory& run,
                                const std::optional<std::filesystem::path>& given) {
  const std::filesystem::path folder = given.value_or(run.info.recording);
  if (folder.empty()) {
    throw FileFault((run.folder / "run.json").string() +
                    ": the run does not say which recording it was made from; name its folder");
  }
  return dataset::read_recording(folder, {.images = false});
}

}  // namespace vpdr::tool
