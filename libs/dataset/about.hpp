#pragma once
// about.yaml of a recording.
#include <filesystem>

#include "dataset/recording.hpp"

namespace vpdr::dataset {

/// Reads about.yaml. Keys vpdr does not know are left alone: the file is a description for people.
/// Known keys of the wrong type or out of range throw FileFault `file:line:column: key: ...`.
About read_about(const std::filesystem::path& file);

}  // namespace vpdr::dataset
