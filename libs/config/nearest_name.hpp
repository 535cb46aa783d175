#pragma once
// Spelling help for unknown keys and options.
#include <string>
#include <vector>

namespace vpdr::config {

/// Smallest number of insertions, deletions and substitutions between two words.
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The candidate nearest to `word`, or "" when none is within a third of its length.
std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace vpdr::config
